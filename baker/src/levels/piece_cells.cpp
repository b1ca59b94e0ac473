// SPDX-License-Identifier: MIT
#include "levels/piece_cells.h"

#include <utility>

#include "geometry/bounds.h"
#include "volume/slab_cells.h"
#include "volume/volume_sites.h"
#include "volume/voronoi_cells.h"

namespace sherd {
namespace {

VolumeSites sitesOf(const VolumeCut& cut, uint64_t seed) {
    VolumeSites sites;
    sites.count = cut.count;
    sites.seed = seed;
    if (cut.kind == VolumeCut::Kind::grid) {
        sites.kind = VolumeSites::Kind::lattice;
        sites.jitter = cut.jitter;
    } else if (!cut.around.empty()) {
        sites.kind = VolumeSites::Kind::crowded;
        sites.around = cut.around;
        sites.spread = cut.spread;
    }
    return sites;
}

}  // namespace

Result<CellFunctions> pieceCells(const VolumeCut& cut, uint64_t seed,
                                 std::span<const glm::vec3> positions,
                                 std::span<const std::array<uint32_t, 3>> triangles,
                                 const CutGrid& grid) {
    if (cut.kind == VolumeCut::Kind::slices) {
        const Bounds box = boundsOf(positions, triangles);
        Result<std::vector<CellFamily>> slabs =
            sliceCells({cut.slabs, cut.jitter, cut.tilt, seed}, box.low, box.high, grid);
        if (!slabs) return tl::unexpected(slabs.error());
        return CellFunctions::of(std::move(*slabs));
    }
    const Result<std::vector<glm::dvec3>> sites =
        volumeSites(positions, triangles, sitesOf(cut, seed));
    if (!sites) return tl::unexpected(sites.error());
    glm::dvec3 stretch = cut.stretch;
    if (cut.kind == VolumeCut::Kind::wood) stretch[static_cast<int>(cut.axis)] = cut.elongation;
    Result<CellFamily> cells = voronoiCells(*sites, grid, stretch);
    if (!cells) return tl::unexpected(cells.error());
    std::vector<CellFamily> families;
    families.push_back(std::move(*cells));
    return CellFunctions::of(std::move(families));
}

}  // namespace sherd
