// SPDX-License-Identifier: MIT
#include "geometry/weld.h"

#include <bit>

namespace sherd {
namespace {

constexpr uint32_t kEmpty = UINT32_MAX;

uint64_t hashOf(const glm::vec3& p) {
    uint64_t h = std::bit_cast<uint32_t>(p.x);
    h = (h ^ (h >> 15)) * 0x9E3779B97F4A7C15U + std::bit_cast<uint32_t>(p.y);
    h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9U + std::bit_cast<uint32_t>(p.z);
    h = (h ^ (h >> 32)) * 0x94D049BB133111EBU;
    return h ^ (h >> 31);
}

}  // namespace

void PositionWelder::grow(size_t expected) {
    const size_t needed = std::bit_ceil(2 * (positions_.size() + expected) + 2);
    if (needed <= slots_.size()) return;
    slots_.assign(needed, kEmpty);
    for (uint32_t i = 0; i < positions_.size(); ++i) {
        size_t slot = hashOf(positions_[i]) & (needed - 1);
        while (slots_[slot] != kEmpty) slot = (slot + 1) & (needed - 1);
        slots_[slot] = i;
    }
}

std::vector<uint32_t> PositionWelder::add(const std::vector<glm::vec3>& points) {
    grow(points.size());
    const size_t mask = slots_.size() - 1;
    std::vector<uint32_t> ids;
    ids.reserve(points.size());
    for (const glm::vec3& point : points) {
        const glm::vec3 p = point + glm::vec3(0.0F);  // -0 becomes +0
        size_t slot = hashOf(p) & mask;
        while (slots_[slot] != kEmpty && positions_[slots_[slot]] != p) slot = (slot + 1) & mask;
        if (slots_[slot] == kEmpty) {
            slots_[slot] = static_cast<uint32_t>(positions_.size());
            positions_.push_back(p);
        }
        ids.push_back(slots_[slot]);
    }
    return ids;
}

}  // namespace sherd
