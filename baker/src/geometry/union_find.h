// SPDX-License-Identifier: MIT
// Disjoint sets (Tarjan 1975) with path halving. The representative of a set is its lowest member,
// so results do not depend on the order of unions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sherd {

class UnionFind {
  public:
    explicit UnionFind(size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    /// Adds sets of one up to `count` in all.
    void grow(size_t count) {
        for (size_t i = parent_.size(); i < count; ++i) parent_.push_back(static_cast<uint32_t>(i));
    }
    uint32_t find(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(uint32_t a, uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<uint32_t> parent_;
};

}  // namespace sherd
