// SPDX-License-Identifier: MIT
#include "levels/piece_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/bounds.h"
#include "geometry/dice.h"
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

Result<PieceCells> around(std::span<const glm::dvec3> sites, const CutGrid& grid,
                          const glm::dvec3& stretch = glm::dvec3(1)) {
    Result<CellFamily> cells = voronoiCells(sites, grid, stretch);
    if (!cells) return tl::unexpected(cells.error());
    std::vector<CellFamily> families;
    families.push_back(std::move(*cells));
    Result<CellFunctions> functions = CellFunctions::of(std::move(families));
    if (!functions) return tl::unexpected(functions.error());
    return PieceCells{std::move(*functions), {}};
}

Result<PieceCells> slices(const SliceOptions& options, const Bounds& box, const CutGrid& grid) {
    Result<std::vector<CellFamily>> slabs = sliceCells(options, box.low, box.high, grid);
    if (!slabs) return tl::unexpected(slabs.error());
    Result<CellFunctions> functions = CellFunctions::of(std::move(*slabs));
    if (!functions) return tl::unexpected(functions.error());
    return PieceCells{std::move(*functions), {}};
}

/// Slabs of half a brick, two of which make one: in every other row another two.
Result<PieceCells> bricks(const VolumeCut& cut, uint64_t seed, const Bounds& box,
                          const CutGrid& grid) {
    const size_t length = cut.axis.value_or(box.size().x >= box.size().z ? 0 : 2);
    const size_t rows = length == 1 ? 0 : 1;
    const size_t deep = 3 - length - rows;
    SliceOptions options;
    options.counts[length] = 2 * cut.slabs[0];
    options.counts[rows] = cut.slabs[1];
    options.counts[deep] = cut.slabs[2];
    options.offsetJitter = cut.jitter;
    options.seed = seed;
    Result<PieceCells> cells = slices(options, box, grid);
    if (!cells) return cells;
    const CellFunctions& functions = cells->functions;
    for (uint32_t cell = 0; cell < functions.count(); ++cell) {
        const uint32_t half = functions.member(cell, length), row = functions.member(cell, rows);
        const uint32_t brick = (half + row % 2) / 2;
        cells->groups.push_back(brick + (cut.slabs[0] + 1) *
                                            (row + cut.slabs[1] * functions.member(cell, deep)));
    }
    return cells;
}

/// Points on rays and rings: their cells have straight sides along both. Rings are nearer to each
/// other near the centre, where it broke first. A ray and a ring move as a whole.
std::vector<glm::dvec3> glassSites(const VolumeCut& cut, uint64_t seed, const Bounds& box) {
    const glm::dvec3 size = box.size();
    int thin = 0;
    for (int k = 1; k < 3; ++k)
        if (size[k] < size[thin]) thin = k;
    const int axis = cut.axis ? static_cast<int>(*cut.axis) : thin;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::dvec3 centre = cut.centre.value_or(box.middle());
    double reach = 0;
    for (const double x : {box.low[u], box.high[u]})
        for (const double y : {box.low[v], box.high[v]})
            reach = std::max(reach, std::hypot(x - centre[u], y - centre[v]));
    Dice dice(seed);
    std::vector<double> angles, radii;
    for (uint32_t n = 0; n < cut.slabs[0]; ++n)
        angles.push_back(2 * M_PI * (n + 0.5 * cut.jitter * dice.signedUnit()) / cut.slabs[0]);
    for (uint32_t n = 0; n < cut.slabs[1]; ++n) {
        const double ring = (n + 1 + 0.5 * cut.jitter * dice.signedUnit()) / cut.slabs[1];
        radii.push_back(0.8 * reach * ring * std::sqrt(ring));
    }
    std::vector<glm::dvec3> sites;
    for (const double radius : radii) {
        for (const double angle : angles) {
            glm::dvec3 site = centre;
            site[axis] = box.middle()[axis];
            site[u] += radius * std::cos(angle);
            site[v] += radius * std::sin(angle);
            sites.push_back(site);
        }
    }
    return sites;
}

}  // namespace

uint32_t PieceCells::pieces() const {
    if (groups.empty()) return functions.count();
    std::vector<uint32_t> distinct = groups;
    std::sort(distinct.begin(), distinct.end());
    return static_cast<uint32_t>(std::unique(distinct.begin(), distinct.end()) - distinct.begin());
}

Result<PieceCells> pieceCells(const VolumeCut& cut, uint64_t seed,
                              std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles,
                              const CutGrid& grid) {
    using Kind = VolumeCut::Kind;
    const Bounds box = boundsOf(positions, triangles);
    switch (cut.kind) {
        case Kind::slices:
            return slices({cut.slabs, cut.jitter, cut.tilt, seed}, box, grid);
        case Kind::bricks:
            return bricks(cut, seed, box, grid);
        case Kind::glass:
            return around(glassSites(cut, seed, box), grid);
        case Kind::points:
            return around(cut.points, grid);
        case Kind::map:
            return fail(ErrorCode::internal, "a drawing's cells are no such ones");
        case Kind::voronoi:
        case Kind::grid:
        case Kind::wood:
            break;
    }
    const Result<std::vector<glm::dvec3>> sites =
        volumeSites(positions, triangles, sitesOf(cut, seed));
    if (!sites) return tl::unexpected(sites.error());
    glm::dvec3 stretch = cut.stretch;
    if (cut.kind == Kind::wood) stretch[static_cast<int>(cut.axis.value_or(1))] = cut.elongation;
    return around(*sites, grid, stretch);
}

}  // namespace sherd
