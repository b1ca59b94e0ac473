// SPDX-License-Identifier: MIT
#include "bullet/collider_set.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

namespace sherd {

ColliderSet::ColliderSet(size_t capacity, bool withTree)
    : btCompoundShape(withTree, int(capacity)) {
    setMargin(0);
}

ColliderSet::ColliderSet(const ColliderSet& from)
    : ColliderSet(size_t(from.m_children.size()), from.m_dynamicAabbTree != nullptr) {
    struct Linker final : btDbvt::IClone {
        explicit Linker(btAlignedObjectArray<btCompoundShapeChild>& all) : children(all) {}
        void CloneLeaf(btDbvtNode* leaf) override { children[leaf->dataAsInt].m_node = leaf; }
        btAlignedObjectArray<btCompoundShapeChild>& children;
    };
    for (int i = 0; i < from.m_children.size(); ++i) m_children.push_back(from.m_children[i]);
    m_localAabbMin = from.m_localAabbMin;
    m_localAabbMax = from.m_localAabbMax;
    if (!m_dynamicAabbTree || !from.m_dynamicAabbTree) return;
    Linker linker(m_children);
    from.m_dynamicAabbTree->clone(*m_dynamicAabbTree, &linker);
    m_dynamicAabbTree->m_leaves = from.m_dynamicAabbTree->m_leaves;
}

void ColliderSet::recalculateLocalAabb() {
    if (!m_dynamicAabbTree || !m_dynamicAabbTree->m_root) {
        btCompoundShape::recalculateLocalAabb();
        return;
    }
    m_localAabbMin = m_dynamicAabbTree->m_root->volume.Mins();
    m_localAabbMax = m_dynamicAabbTree->m_root->volume.Maxs();
}

}  // namespace sherd
