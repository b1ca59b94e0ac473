// SPDX-License-Identifier: MIT
// Numbers for keys of four integers, in order of first appearance.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sherd {

class KeyTable {
  public:
    using Key = std::array<uint32_t, 4>;
    static constexpr uint32_t kNone = 0xFFFFFFFFU;

    /// The key's number, and whether it is new.
    std::pair<uint32_t, bool> add(const Key& key) {
        if (2 * (keys_.size() + 1) > slots_.size()) grow();
        uint32_t& slot = slots_[slotOf(key)];
        if (slot != kNone) return {slot, false};
        slot = static_cast<uint32_t>(keys_.size());
        keys_.push_back(key);
        return {slot, true};
    }
    /// kNone: never added.
    uint32_t find(const Key& key) const { return keys_.empty() ? kNone : slots_[slotOf(key)]; }
    const std::vector<Key>& keys() const { return keys_; }

  private:
    size_t slotOf(const Key& key) const {
        uint64_t h = 0;
        for (const uint32_t k : key) {
            h = (h ^ k) * 0x9E3779B97F4A7C15ULL;  // Fibonacci hashing, mixed downwards
            h ^= h >> 32;
        }
        size_t slot = h & (slots_.size() - 1);
        while (slots_[slot] != kNone && keys_[slots_[slot]] != key)
            slot = (slot + 1) & (slots_.size() - 1);
        return slot;
    }
    void grow() {
        slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), kNone);
        for (uint32_t i = 0; i < keys_.size(); ++i) slots_[slotOf(keys_[i])] = i;
    }

    std::vector<Key> keys_;
    std::vector<uint32_t> slots_;  ///< open addressing, size a power of two, at most half full
};

}  // namespace sherd
