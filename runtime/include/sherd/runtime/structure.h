// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// How far one object is broken: which fragments stand for it, and what is left of each bond. Knows
/// no physics engine and no motion. Memory is taken at the first damage, none for a whole object.
class Structure {
  public:
    explicit Structure(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {}

    /// As new, of this asset, or null until the next call; keeps its memory.
    void renew(std::shared_ptr<const Asset> asset);

    [[nodiscard]] const Asset& asset() const { return *asset_; }
    [[nodiscard]] const BondGraph& graph() const { return asset_->graph(); }

    /// The standing fragment that holds a leaf.
    [[nodiscard]] uint32_t fragmentAt(uint32_t leaf) const {
        return standing_.empty() ? 0 : standing_[leaf];
    }
    [[nodiscard]] bool stands(uint32_t fragment) const {
        const uint32_t leaf = graph().leavesOf(fragment).first;
        return fragmentAt(leaf) == fragment && !isGone(leaf);
    }
    /// Whether what holds a leaf was removed.
    [[nodiscard]] bool isGone(uint32_t leaf) const { return !gone_.empty() && gone_[leaf] != 0; }
    /// What is left of a bond: 1 sound, 0 broken.
    [[nodiscard]] float health(uint32_t bond) const { return lost_.empty() ? 1 : 1 - lost_[bond]; }
    /// What it has lost, to the bit: 0 sound, 1 broken.
    [[nodiscard]] float lost(uint32_t bond) const { return lost_.empty() ? 0 : lost_[bond]; }
    [[nodiscard]] bool isBroken(uint32_t bond) const { return !lost_.empty() && lost_[bond] >= 1; }
    /// Whether anything but sound bonds and the intact object was ever seen.
    [[nodiscard]] bool isDamaged() const { return !lost_.empty(); }

    /// Takes `share` of the sound bond's energy from it, but never so much that it breaks.
    void weaken(uint32_t bond, float share) {
        prepare();
        float& lost = lost_[bond];
        if (lost < kAlmostAll) lost = std::min(lost + share, kAlmostAll);
    }
    void breakBond(uint32_t bond);
    /// Gives `share` of its energy back to a bond that is not broken.
    void strengthen(uint32_t bond, float share);
    /// What was just broken holds after all, by next to nothing.
    void hold(uint32_t bond);
    /// Puts a fragment's children in its place. It must stand and have some.
    void open(uint32_t fragment);
    /// Opens what stands for a divided fragment, the coarsest first, and the fragment itself.
    /// Appends those opened.
    void openDownTo(uint32_t fragment, Vector<uint32_t>& opened);
    /// Puts a fragment back in the place of all that has come out of it.
    void close(uint32_t fragment);

    /// Removes a standing fragment for good. Its bonds to others must be broken.
    void discard(uint32_t fragment);

    /// Holds a leaf to the world, or lets it go: an anchor that no hit breaks.
    void pin(uint32_t leaf, bool pinned);
    [[nodiscard]] bool isPinned(uint32_t leaf) const { return !pins_.empty() && pins_[leaf] != 0; }

  private:
    static constexpr float kAlmostAll = 1 - 0x1p-20F;  ///< that a bond can lose without breaking

    void prepare() {
        if (lost_.empty()) makeRoom();
    }
    void makeRoom();

    std::shared_ptr<const Asset> asset_;
    Vector<uint32_t> standing_;  ///< per leaf
    Vector<float> lost_;         ///< per bond
    Vector<uint8_t> pins_;       ///< per leaf
    Vector<uint8_t> gone_;       ///< per leaf
};

/// The connected groups that standing fragments form. Keeps its memory from one search to the next.
class IslandFinder {
  public:
    /// Its fragments hold together by bonds that are not broken.
    struct Island {
        Range fragments;        ///< into the finder's list
        bool anchored = false;  ///< by a bond to the world that is not broken, or a pin
        double mass = 0;        ///< kg
    };
    /// Of these, all standing, ascending; bonds to others do not count.
    void find(const Structure& structure, std::span<const uint32_t> fragments);
    /// The same of fragments that held together before something broke. `disturbed`: those at the
    /// ends of bonds broken since, and what has come out of fragments opened since. Searches from
    /// all of them at once until all but one have met or come to an end, so that the work goes with
    /// the size of what comes off, but for listing (after Even and Shiloach, "An On-Line
    /// Edge-Deletion Problem", 1981).
    void findAround(const Structure& structure, std::span<const uint32_t> fragments,
                    std::span<const uint32_t> disturbed);

    /// In the order of their first fragments.
    [[nodiscard]] std::span<const Island> islands() const { return islands_; }
    /// Ascending.
    [[nodiscard]] std::span<const uint32_t> fragmentsOf(const Island& island) const {
        return std::span(fragments_).subspan(island.fragments.first, island.fragments.count);
    }

  private:
    static constexpr uint32_t kNone = UINT32_MAX;

    struct Search {
        uint32_t root;  ///< the search it has become part of, or itself
        uint32_t next;  ///< the first that was reached and not looked at, or kNone
        uint32_t last;  ///< of these
    };

    void begin(const Structure& structure);
    void flood(const Structure& structure, uint32_t start, uint32_t group);
    void advance(const Structure& structure, uint32_t search);
    void append(Search& search, uint32_t first, uint32_t last);
    uint32_t rootOf(uint32_t search);
    template <class GroupOf>
    void shareOut(const Structure& structure, std::span<const uint32_t> fragments, uint32_t groups,
                  const GroupOf& groupOf);
    [[nodiscard]] uint32_t sought() const { return round_ - 1; }
    [[nodiscard]] uint32_t found() const { return round_; }

    Vector<Island> islands_;
    Vector<uint32_t> fragments_;
    Vector<uint32_t> front_;  ///< those reached, in that order
    // Per fragment of the asset:
    Vector<uint32_t> state_;  ///< the round it is sought, or found
    Vector<uint32_t> label_;  ///< what it was found by, and then its island
    Vector<uint32_t> after_;  ///< the next that its search looks at
    Vector<Search> searches_;
    Vector<uint32_t> active_;    ///< searches
    Vector<uint32_t> numberOf_;  ///< per group: its island
    uint32_t round_ = 0;
};

}  // namespace sherd
