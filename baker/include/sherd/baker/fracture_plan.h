// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sherd/baker/cluster.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/pattern.h"
#include "sherd/baker/projection.h"
#include "sherd/baker/volume_cut.h"

namespace sherd {

/// All fracture lines of a bake, whatever their sources, each with the level from which it cuts,
/// and what cuts their pieces further.
struct FracturePlan {
    struct Drawing {
        FractureMap map;
        Projection projection;
        PieceChoice only = {};   ///< pieces of the level before that its lines divide
        std::string where = {};  ///< its level's pointer in a recipe, for messages; may be empty
    };
    struct Grown {
        Pattern pattern;
        uint32_t level = 1;
        std::shared_ptr<const GreyImage> density = {};  ///< the picture `pattern.density` names
        PieceChoice only = {};   ///< pieces of the level before that it divides
        std::string where = {};  ///< as a drawing's
    };
    struct Grouped {
        Cluster cluster;
        uint32_t lines = 0;                 ///< lines up to this level are coarser
        std::optional<uint32_t> cuts = {};  ///< the cut that follows, by its number; none where
                                            ///< lines do
    };
    std::vector<Drawing> drawings;
    std::vector<Grown> patterns;
    std::vector<VolumeCut> cuts;  ///< a level each, in their order
    /// Per cut: it comes behind the lines up to this level, before those of deeper ones. Cuts
    /// beyond the end of the list come behind all lines.
    std::vector<uint32_t> cutsBehind;
    std::vector<Grouped> clusters;  ///< a level each, coarse to fine
};

/// Several plans as one, the levels of each behind those of the one before. Where several have
/// lines, those of the k-th cut from level k, whatever their layers say; the layers of a plan that
/// alone has lines are levels of their own, from level k on.
FracturePlan stackLevels(std::vector<FracturePlan> levels);

}  // namespace sherd
