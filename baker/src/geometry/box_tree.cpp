// SPDX-License-Identifier: MIT
// C. Lauterbach et al., "Fast BVH Construction on GPUs" (2009): boxes sorted by the Morton code of
// their middles, nodes divided where the highest bit changes.
#include "geometry/box_tree.h"

#include <bit>

#include "geometry/morton_order.h"

namespace sherd {
namespace {

FloatBox around(const FloatBox& a, const FloatBox& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

}  // namespace

std::vector<FloatBox> boxesOf(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<FloatBox> boxes;
    boxes.reserve(triangles.size());
    for (const auto& t : triangles) {
        const glm::vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
        boxes.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    }
    return boxes;
}

BoxTree::BoxTree(std::vector<FloatBox> boxes) {
    if (boxes.empty()) return;
    std::vector<glm::vec3> middles;
    middles.reserve(boxes.size());
    for (const FloatBox& box : boxes) middles.push_back(0.5F * box.low + 0.5F * box.high);
    MortonOrder order = mortonOrder(middles);
    items_ = std::move(order.items);
    boxes_.reserve(boxes.size());
    for (const uint32_t i : items_) boxes_.push_back(boxes[i]);
    nodes_.reserve(boxes_.size());
    build(0, static_cast<uint32_t>(boxes_.size()), order.codes);
}

uint32_t BoxTree::build(uint32_t first, uint32_t last, const std::vector<uint32_t>& codes) {
    const auto self = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({boxes_[first], first, last, 0});
    if (last - first <= kLeafSize) {
        for (uint32_t i = first; i < last; ++i)
            nodes_[self].box = around(nodes_[self].box, boxes_[i]);
        leaves_.push_back(self);
        return self;
    }
    uint32_t middle = first + (last - first) / 2;
    if (const uint32_t changed = codes[first] ^ codes[last - 1]; changed != 0) {
        const uint32_t bit = std::bit_floor(changed);
        middle = static_cast<uint32_t>(
            std::partition_point(codes.begin() + first, codes.begin() + last,
                                 [bit](uint32_t code) { return (code & bit) == 0; }) -
            codes.begin());
    }
    build(first, middle, codes);
    const uint32_t right = build(middle, last, codes);
    nodes_[self].right = right;
    nodes_[self].box = around(nodes_[self + 1].box, nodes_[right].box);
    return self;
}

}  // namespace sherd
