// SPDX-License-Identifier: MIT
// Pieces turned inside out by prisms that cross the medial surface are mended or merged.
#pragma once

#include <span>
#include <vector>

#include "interior/sheet_containment.h"
#include "interior/stitching.h"
#include "surface/component_merging.h"

namespace sherd {

struct MendedPieces {
    uint32_t thinned = 0;            ///< pieces whose hidden points were moved towards the surface
    uint32_t shelled = 0;            ///< of these, pieces that got a shell instead
    std::vector<MergedLeaf> merged;  ///< pieces that had no volume even so
    Containment containment;         ///< hidden points that would have stuck out
    uint32_t empty = 0;              ///< pieces without volume that could not even be merged
    std::vector<HiddenFace> faces;   ///< the stitched hidden faces of the final leaves
    bool stale = false;  ///< leaves were merged and solid ones are to be found anew: mend again
};

/// First nothing may stick out of the object. For a piece of no positive volume its hidden points
/// go back towards the surface by halves, at most six times; failing that it gets a shell of even
/// thickness; failing that it is merged into the neighbour with the longest border. Changes the
/// sheet's points and `components`; what is left afterwards has positive volume, unless the whole
/// object has none. With solid leaves it stops after the first merging.
MendedPieces mendPieces(const SplitSurface& surface, const MeshTopology& topology,
                        const SolidTest& object, unsigned threads, HiddenSheet& sheet,
                        Components& components, const SolidLeaves& solid = {});

}  // namespace sherd
