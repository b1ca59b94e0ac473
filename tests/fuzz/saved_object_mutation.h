// SPDX-License-Identifier: MIT
// Mutations that know what a saved object consists of: lists of what is open, weak, pinned and
// gone, and islands. One number is changed, or one item of a list dropped, doubled or moved; counts
// stay right most of the time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/byte_stream.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

namespace sherd::fuzz {

struct SavedParts {
    struct Weak {
        uint32_t bond = 0, lost = 0;
    };
    struct Island {
        std::vector<uint32_t> fragments;
        uint8_t flags = 0;
        uint64_t bornAt = 0, fadingSince = 0;
        std::array<uint32_t, 27> numbers{};  ///< two poses and the motion of the body
        std::array<uint8_t, 41> body{};      ///< Bullet's
    };
    uint32_t mark = 0;
    uint64_t savedAt = 0, bake = 0;
    std::vector<uint32_t> opened, pinned, gone;
    std::vector<Weak> weak;
    std::vector<Island> islands;
    uint32_t engine = 0;

    static std::optional<SavedParts> parse(std::span<const uint8_t> bytes) {
        ByteReader from(bytes);
        SavedParts parts;
        parts.mark = from.u32();
        parts.savedAt = from.u64();
        parts.bake = from.u64();
        for (uint32_t n = from.count(4); n > 0; --n) parts.opened.push_back(from.u32());
        for (uint32_t n = from.count(8); n > 0; --n) {
            const uint32_t bond = from.u32();
            parts.weak.push_back({bond, from.u32()});
        }
        for (uint32_t n = from.count(4); n > 0; --n) parts.pinned.push_back(from.u32());
        for (uint32_t n = from.count(4); n > 0; --n) parts.gone.push_back(from.u32());
        for (uint32_t n = from.count(100); n > 0; --n) {
            Island& island = parts.islands.emplace_back();
            for (uint32_t f = from.count(4); f > 0; --f) island.fragments.push_back(from.u32());
            island.flags = from.u8();
            island.bornAt = from.u64();
            island.fadingSince = from.u64();
            for (uint32_t& number : island.numbers) number = from.u32();
        }
        parts.engine = from.u32();
        if (from.count(1) != 41 * parts.islands.size()) return {};
        for (Island& island : parts.islands)
            for (uint8_t& byte : island.body) byte = from.u8();
        if (from.isShort() || !from.isAtEnd()) return {};
        return parts;
    }

    [[nodiscard]] std::vector<uint8_t> bytes() const {
        std::vector<uint8_t> out;
        ByteWriter to(out);
        to.u32(mark);
        to.u64(savedAt);
        to.u64(bake);
        to.u32(uint32_t(opened.size()));
        for (const uint32_t f : opened) to.u32(f);
        to.u32(uint32_t(weak.size()));
        for (const Weak& w : weak) {
            to.u32(w.bond);
            to.u32(w.lost);
        }
        to.u32(uint32_t(pinned.size()));
        for (const uint32_t leaf : pinned) to.u32(leaf);
        to.u32(uint32_t(gone.size()));
        for (const uint32_t f : gone) to.u32(f);
        to.u32(uint32_t(islands.size()));
        for (const Island& island : islands) {
            to.u32(uint32_t(island.fragments.size()));
            for (const uint32_t f : island.fragments) to.u32(f);
            to.u8(island.flags);
            to.u64(island.bornAt);
            to.u64(island.fadingSince);
            for (const uint32_t number : island.numbers) to.u32(number);
        }
        to.u32(engine);
        to.u32(uint32_t(41 * islands.size()));
        for (const Island& island : islands)
            for (const uint8_t byte : island.body) to.u8(byte);
        return out;
    }
};

class SavedObjectMutation {
  public:
    explicit SavedObjectMutation(unsigned seed) : engine_(seed) {}

    /// `starts`: what to begin with where there is nothing sound yet.
    size_t operator()(uint8_t* data, size_t size, size_t maxSize,
                      std::span<const std::vector<uint8_t>> starts) {
        auto parts = SavedParts::parse({data, size});
        if (!parts) parts = SavedParts::parse(starts[below(starts.size())]);
        for (uint32_t n = below(3) + 1; n > 0; --n) change(*parts);
        const std::vector<uint8_t> whole = parts->bytes();
        if (whole.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
        std::memcpy(data, whole.data(), whole.size());
        return below(16) == 0 ? LLVMFuzzerMutate(data, whole.size(), maxSize) : whole.size();
    }

  private:
    uint32_t below(size_t n) { return n == 0 ? 0 : uint32_t(engine_() % n); }

    uint32_t otherFloat(uint32_t old) {
        constexpr std::array<float, 9> kFloats{0.0F,
                                               1.0F,
                                               -1.0F,
                                               0.5F,
                                               std::numeric_limits<float>::quiet_NaN(),
                                               std::numeric_limits<float>::infinity(),
                                               std::numeric_limits<float>::max(),
                                               std::numeric_limits<float>::denorm_min(),
                                               1e12F};
        switch (below(4)) {
            case 0:
                return old + below(3) - 1;
            case 1:
                return std::bit_cast<uint32_t>(std::bit_cast<float>(old) * 1.0005F);
            case 2:
                return old ^ 1U << below(32);
            default:
                return std::bit_cast<uint32_t>(kFloats[below(kFloats.size())]);
        }
    }
    uint32_t otherIndex(uint32_t old) {
        return below(8) == 0 ? ~below(4) : below(2) == 0 ? old + below(3) - 1 : below(80);
    }
    uint64_t otherDouble(uint64_t old) {
        constexpr std::array<double, 6> kDoubles{0,
                                                 -1,
                                                 1e300,
                                                 std::numeric_limits<double>::quiet_NaN(),
                                                 std::numeric_limits<double>::infinity(),
                                                 -std::numeric_limits<double>::infinity()};
        return below(2) == 0 ? old ^ uint64_t { 1 } << below(64)
                             : std::bit_cast<uint64_t>(kDoubles[below(kDoubles.size())]);
    }

    template <class T, class Other>
    void changeList(std::vector<T>& list, const Other& other) {
        if (list.empty()) return;
        const uint32_t i = below(list.size());
        const T item = list[i];
        switch (below(4)) {
            case 0:
                list.erase(list.begin() + i);
                break;
            case 1:
                list.insert(list.begin() + below(list.size() + 1), item);
                break;
            case 2:
                std::swap(list[i], list[below(list.size())]);
                break;
            default:
                other(list[i]);
        }
    }

    void changeIsland(SavedParts& parts) {
        if (parts.islands.empty()) return;
        SavedParts::Island& island = parts.islands[below(parts.islands.size())];
        SavedParts::Island& another = parts.islands[below(parts.islands.size())];
        switch (below(8)) {
            case 7:
                island.fadingSince = otherDouble(island.fadingSince);
                break;
            case 0:  // some of its fragments go to another one
                if (&island == &another) break;
                while (!island.fragments.empty() && below(3) != 0) {
                    another.fragments.push_back(island.fragments.back());
                    island.fragments.pop_back();
                }
                std::sort(another.fragments.begin(), another.fragments.end());
                break;
            case 1:
                changeList(island.fragments, [&](uint32_t& f) { f = otherIndex(f); });
                break;
            case 2:
                island.flags = uint8_t(below(5));
                break;
            case 3:
                island.bornAt = otherDouble(island.bornAt);
                break;
            case 4:
                changeBody(island.body);
                break;
            default:
                uint32_t& number = island.numbers[below(island.numbers.size())];
                number = otherFloat(number);
        }
    }

    void changeBody(std::array<uint8_t, 41>& body) {
        const uint32_t which = below(11);
        if (which == 9) {
            body[36] = uint8_t(below(8));
            return;
        }
        uint8_t* word = body.data() + (which == 10 ? 37 : 4 * which);
        uint32_t value = 0;
        std::memcpy(&value, word, 4);
        value = otherFloat(value);
        std::memcpy(word, &value, 4);
    }

    void change(SavedParts& parts) {
        switch (below(10)) {
            case 0:
                changeList(parts.opened, [&](uint32_t& f) { f = otherIndex(f); });
                break;
            case 1:
                changeList(parts.weak, [&](SavedParts::Weak& w) {
                    if (below(2) == 0)
                        w.bond = otherIndex(w.bond);
                    else
                        w.lost = otherFloat(w.lost);
                });
                break;
            case 2:
                parts.pinned.push_back(below(40));
                changeList(parts.pinned, [&](uint32_t& leaf) { leaf = otherIndex(leaf); });
                break;
            case 3:
                changeList(parts.islands, [&](SavedParts::Island& island) { island = {}; });
                break;
            case 5:  // with or without the island that it was
                if (parts.islands.empty()) break;
                for (const uint32_t f : parts.islands.back().fragments) parts.gone.push_back(f);
                if (below(4) != 0) parts.islands.pop_back();
                changeList(parts.gone, [&](uint32_t& f) {
                    if (below(2) == 0) f = otherIndex(f);
                });
                break;
            case 4:
                if (below(4) == 0)
                    parts.savedAt = otherDouble(parts.savedAt);
                else if (below(8) == 0)
                    parts.engine = below(2) == 0 ? 0 : parts.engine + 1;
                else if (below(8) == 0)
                    parts.mark ^= 1U << below(32);
                else if (below(8) == 0)
                    parts.bake ^= uint64_t{1} << below(64);
                break;
            default:
                changeIsland(parts);
        }
    }

    std::mt19937 engine_;
};

}  // namespace sherd::fuzz
