// SPDX-License-Identifier: MIT
// The tree of fragments: which leaves each consists of, and in which order leaves are stored.
#pragma once

#include <cstdint>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "surface/components.h"

namespace sherd {

struct Hierarchy {
    std::vector<uint32_t> leafOrder;   ///< leaves depth first: every fragment's are a run
    std::vector<uint32_t> rankOfLeaf;  ///< inverse of leafOrder
    std::vector<Range> leaves;         ///< per fragment: a run of leafOrder
    std::vector<Range> levels;         ///< per level from 0: the fragments that first appear there
    std::vector<int32_t> parent;       ///< per fragment
    std::vector<Range> children;       ///< per fragment
    std::vector<uint32_t> level;       ///< per fragment
    std::vector<uint32_t> fragmentOfRank;  ///< per leaf in order: the undivided fragment it is
};

/// Fragment 0 is the object. A component that is not divided at a level makes no new fragment: the
/// shallower one stands for itself.
Hierarchy buildHierarchy(const Components& components);

}  // namespace sherd
