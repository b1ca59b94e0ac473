// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
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
    };
    struct Grown {
        Pattern pattern;
        uint32_t level = 1;
        std::shared_ptr<const GreyImage> density = {};  ///< the picture `pattern.density` names
    };
    struct Grouped {
        Cluster cluster;
        uint32_t lines = 0;                 ///< levels of lines that are coarser
        std::optional<uint32_t> cuts = {};  ///< cuts that are coarser; none where lines follow
    };
    std::vector<Drawing> drawings;
    std::vector<Grown> patterns;
    std::vector<VolumeCut> cuts;    ///< a level each, behind those of all lines
    std::vector<Grouped> clusters;  ///< a level each, coarse to fine
};

/// Several plans as one. With more than one, the lines of the k-th cut from level k, whatever their
/// layers say.
FracturePlan stackLevels(std::vector<FracturePlan> levels);

}  // namespace sherd
