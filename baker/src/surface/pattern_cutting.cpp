// SPDX-License-Identifier: MIT
#include "surface/pattern_cutting.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "pattern/density.h"
#include "pattern/page_patterns.h"
#include "surface/page_cutting.h"

namespace sherd {

Result<void> PatternCutter::growPattern(const FracturePlan::Grown& grown, uint32_t mark) {
    const Pattern& pattern = grown.pattern;
    const uint32_t level = work_.result.lines.level(mark);
    GrowthInput input{work_.result.surface, work_.result.topology, work_.result.groups,
                      piecesBefore(level)};
    if (pattern.kind == Pattern::Kind::grid || pattern.kind == Pattern::Kind::radial)
        return growPage(pattern, level, mark, findDomains(input));
    if (pattern.kind == Pattern::Kind::wood)
        input.grain =
            pattern.axis == glm::dvec3(0.0) ? longestAxis(work_.result.surface) : pattern.axis;
    const Result<Density> density = densityOf(work_.mesh, work_.result.surface, grown);
    if (!density) return tl::unexpected(density.error());
    input.density = *density;
    Growth growth = growCells(input, pattern, level, mark);
    growth.cells.wholeCells = work_.options.wholeCells;
    work_.result.cells.push_back(std::move(growth.cells));
    return work_.cutChords(growth.chords);
}

std::vector<uint32_t> PatternCutter::piecesBefore(uint32_t level) const {
    if (level == 1) return std::vector<uint32_t>(work_.result.surface.triangles.size(), 0);
    std::vector<CellReport> ignored;
    const Components components =
        findPieces(work_.result.surface, work_.result.topology, work_.result.lines, level - 1,
                   work_.result.groups, work_.result.cells, {work_.options.splitPatches}, ignored);
    return components.leaf;
}

/// A pattern drawn on a page: on a plane its cells go through the object, and so do those of a
/// radial one; on a box they end at its edges; around an axis patches are pieces.
Result<void> PatternCutter::growPage(const Pattern& pattern, uint32_t level, uint32_t mark,
                                     const Domains& domains) {
    const bool radial = pattern.kind == Pattern::Kind::radial;
    using Kind = Projection::Kind;
    const Kind kind = radial ? Kind::planar : pattern.projection.kind;
    PagePlane plane;
    double reach = 1;
    if (radial) {
        plane = radialPlane(pattern);
        reach = 0;
        for (const SplitTriangle& t : work_.result.surface.triangles)
            for (const uint32_t v : t.v)
                reach = std::max(reach, glm::length(plane.at(work_.result.surface.positions[v])));
        constexpr double kFarthest = 4;  // beyond, all the object lies within a sector or two
        if (!(reach <= kFarthest))
            return fail(ErrorCode::badArgument,
                        "the radial pattern's centre lies more than 4 diagonals of the object "
                        "beside it; move it (at=X,Y,Z) onto the object or near it",
                        "pattern \"" + pattern.text + "\"");
    } else if (kind == Kind::planar) {
        plane = fitPage(work_.result.surface, pattern.projection.axis);
    }
    PagePattern drawn = radial ? drawRadial(pattern, reach) : drawGrid(pattern);
    Page page;
    page.map = std::move(drawn.map);
    page.marks.assign(page.map.lines.size(), mark);

    CellLevel cells;
    cells.level = level;
    cells.domain = domains.ofTriangle;
    cells.domains = static_cast<uint32_t>(domains.triangles.size());
    cells.wholeCells = true;
    cells.asked = drawn.cells;
    cells.text = pattern.text;
    if (kind == Kind::planar) {
        cells.cellOf = [plane, cellAt = drawn.cellAt](uint32_t, uint32_t,
                                                      const glm::dvec3& position) {
            return cellAt(plane.at(position));
        };
        work_.result.cells.push_back(std::move(cells));
        return PageCutter(work_).cutPage(page, framesOnPlane(work_.result.surface, plane).triangles,
                                         0);
    }
    if (kind == Kind::box) {
        // What faces another side for a moment (a groove, a rivet) strays to its neighbours.
        cells.wholeCells = false;
        cells.asked = 6 * drawn.cells;
        // Asked after this cutter is gone: the sides are found now.
        std::vector<uint8_t> sides;
        for (uint32_t t = 0; t < work_.mesh.triangles.size(); ++t)
            sides.push_back(boxSide(work_.mesh, t));
        cells.cellOf = [sides = std::move(sides), planes = boxPlanes(work_.result.surface),
                        cellAt = drawn.cellAt, count = drawn.cells](uint32_t, uint32_t source,
                                                                    const glm::dvec3& position) {
            const uint8_t side = sides[source];
            return side * count + cellAt(planes[side].at(position));
        };
    }
    work_.result.cells.push_back(std::move(cells));
    const PageFrames frames = projectedFrames(work_.mesh, work_.result.surface, pattern.projection);
    tilePage(page, Wrap::repeat, Wrap::repeat, {0, frames.tilesU - 1, 0, 0});
    return PageCutter(work_).cutPage(page, frames.triangles, mark);
}

/// Around the point that was hit, looked at along the normal; a unit is the diagonal.
PagePlane PatternCutter::radialPlane(const Pattern& pattern) const {
    PagePlane plane = fitPage(work_.result.surface, pattern.axis);
    const Bounds bounds = boundsOf(work_.result.surface);
    const double scale = 1 / bounds.diagonal();
    plane.right = glm::normalize(plane.right) * scale;
    plane.down = glm::normalize(plane.down) * scale;
    plane.origin =
        pattern.centre ? toObjectFrame(work_.mesh.restPose, *pattern.centre) : bounds.middle();
    return plane;
}

}  // namespace sherd
