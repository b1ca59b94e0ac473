// SPDX-License-Identifier: MIT
#include "core/structure_bytes.h"

namespace sherd {

void writeStructure(const Structure& structure, ByteWriter& to) {
    const Asset& asset = structure.asset();
    const BondGraph& graph = structure.graph();
    to.u64(asset.bakeHash());
    std::vector<uint32_t> opened, weak, pinned, gone;
    for (uint32_t f = 0; f < asset.fragmentCount(); ++f) {
        // A fragment was opened that lies above what stands for its first leaf.
        if (structure.fragmentAt(graph.leavesOf(f).first) > f) opened.push_back(f);
    }
    for (uint32_t b = 0; b < graph.bonds().size(); ++b)
        if (structure.health(b) < 1) weak.push_back(b);
    for (uint32_t leaf = 0; leaf < graph.leafCount(); ++leaf)
        if (structure.isPinned(leaf)) pinned.push_back(leaf);
    for (uint32_t leaf = 0; leaf < graph.leafCount();) {
        const uint32_t f = structure.fragmentAt(leaf);
        if (structure.isGone(leaf)) gone.push_back(f);
        leaf += graph.leavesOf(f).count;
    }
    to.u32(uint32_t(opened.size()));
    for (const uint32_t f : opened) to.u32(f);
    to.u32(uint32_t(weak.size()));
    for (const uint32_t b : weak) {
        to.u32(b);
        to.f32(structure.lost(b));
    }
    to.u32(uint32_t(pinned.size()));
    for (const uint32_t leaf : pinned) to.u32(leaf);
    to.u32(uint32_t(gone.size()));
    for (const uint32_t f : gone) to.u32(f);
}

const char* readStructure(const std::shared_ptr<const Asset>& asset, ByteReader& from,
                          std::optional<Structure>& structure) {
    if (from.u64() != asset->bakeHash() || from.isShort())
        return "it was written of another bake of the object";
    structure.emplace(asset);
    const BondGraph& graph = asset->graph();
    for (uint32_t n = from.count(4); n > 0; --n) {
        const uint32_t f = from.u32();
        if (f >= asset->fragmentCount() || asset->fragment(f).children.count == 0 ||
            !structure->stands(f))
            return "it opens a fragment that does not stand or has no children";
        structure->open(f);
    }
    for (uint32_t n = from.count(8); n > 0; --n) {
        const uint32_t b = from.u32();
        const float lost = from.f32();
        if (b >= graph.bonds().size() || !(lost > 0 && lost <= 1))
            return "it weakens a bond that does not exist, or by a share that is none";
        const BondGraph::Bond& bond = graph.bond(b);
        if (lost == 1 && bond.b != BondGraph::kWorld &&
            structure->fragmentAt(bond.a) == structure->fragmentAt(bond.b))
            return "it breaks a bond within a fragment that stands whole";
        if (lost == 1)
            structure->breakBond(b);
        else
            structure->weaken(b, lost);
    }
    for (uint32_t n = from.count(4); n > 0; --n) {
        const uint32_t leaf = from.u32();
        if (leaf >= graph.leafCount()) return "it pins a leaf that does not exist";
        structure->pin(leaf, true);
    }
    for (uint32_t n = from.count(4); n > 0; --n) {
        const uint32_t f = from.u32();
        if (f >= asset->fragmentCount() || !structure->stands(f))
            return "it removes a fragment that does not stand";
        structure->discard(f);
    }
    return from.isShort() ? "it ends too early" : nullptr;
}

}  // namespace sherd
