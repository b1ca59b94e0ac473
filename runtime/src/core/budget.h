// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "sherd/runtime/damage.h"
#include "sherd/runtime/memory.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// Makes fewer and larger islands of what a hit has parted, where there would be too many. Keeps
/// its memory from one hit to the next.
class IslandMerger {
  public:
    /// Leaves at most `most` (>= 1) of the groups into which `hit` parted these fragments. The
    /// smallest is joined first, to the neighbour with which it shared the largest area; to what is
    /// anchored only where there is no other, so that little is left hanging. Bonds that hold after
    /// all keep next to nothing: the next hit parts them for next to no energy. Fragments whose
    /// children have no bonds are closed again. Both are taken out of `hit`; what it consumed stays
    /// consumed. Returns whether it changed anything: then `fragments` have to be found and grouped
    /// anew.
    bool limit(Structure& structure, const IslandFinder& groups, uint32_t most, HitResult& hit);

  private:
    struct Shared {
        uint32_t from, to;  ///< roots
        float area;         ///< m^2
    };
    struct Group {
        uint32_t root;
        double mass;  ///< kg, of a root
        bool anchored;
        bool grown = false;  ///< in this round
        Range shared{};      ///< with its neighbours, into shared_
    };

    uint32_t rootOf(uint32_t group);
    bool join(uint32_t a, uint32_t b);
    bool joinRound(const Structure& structure, const HitResult& hit, uint32_t most);
    void findShared(const Structure& structure, const HitResult& hit);
    [[nodiscard]] uint32_t neighbourOf(uint32_t group, bool alsoGrown);
    void closeOpened(Structure& structure, uint32_t most, HitResult& hit);

    Vector<Group> groups_;
    Vector<uint32_t> groupOf_;  ///< per fragment of the asset
    Vector<Shared> shared_;
    Vector<uint32_t> order_;
    uint32_t count_ = 0;  ///< of groups left
};

}  // namespace sherd
