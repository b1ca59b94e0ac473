// SPDX-License-Identifier: MIT
#include "surface/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "geometry/triangle.h"
#include "pattern/page_patterns.h"
#include "surface/line_cutting.h"
#include "surface/page_cutting.h"
#include "surface/page_frames.h"
#include "surface/pattern_cutting.h"

namespace sherd {
namespace {

bool isUvGrid(const Pattern& pattern) {
    return pattern.kind == Pattern::Kind::grid && pattern.projection.kind == Projection::Kind::uv;
}

/// All lines of a plan in their order: drawings in UV, projected ones, lines over the surface,
/// patterns from the coarsest level on.
class PlanCutter {
  public:
    PlanCutter(const SurfaceMesh& mesh, const MeshTopology& topology, const FracturePlan& plan,
               const CutOptions& options)
        : topology_(topology), plan_(plan), work_(mesh, topology, options) {}

    Result<CutSurface> run() {
        numberLines();
        if (auto ok = cutDrawings(); !ok) return tl::unexpected(ok.error());
        if (auto ok = cutSurfaceLines(work_, surfaceLines_, surfaceMarks()); !ok)
            return tl::unexpected(ok.error());
        if (auto ok = growPatterns(); !ok) return tl::unexpected(ok.error());
        return std::move(work_.result);
    }

  private:
    /// Lines of drawings, lines over the surface, patterns: one mark each, in this order.
    void numberLines() {
        std::vector<LineTable::Line> lines;
        const auto add = [&lines](const auto& line) {
            lines.push_back({line.level, line.properties, line.source, false});
        };
        for (const FracturePlan::Drawing& drawing : plan_.drawings)
            for (const FractureMap::Line& line : drawing.map.lines) add(line);
        const auto addOverSurface = [&](const std::vector<FractureMap::SurfaceLine>& some) {
            for (const FractureMap::SurfaceLine& line : some) {
                add(line);
                surfaceLines_.push_back(&line);
            }
        };
        for (const FracturePlan::Drawing& drawing : plan_.drawings)
            addOverSurface(drawing.map.surfaceLines);
        addOverSurface(work_.mesh.lines);
        for (const FracturePlan::Grown& grown : plan_.patterns)
            lines.push_back({grown.level, {}, grown.pattern.text, !isUvGrid(grown.pattern)});
        marks_ = work_.result.lines.assign(std::move(lines));
    }

    std::span<const uint32_t> patternMarks() const {
        return std::span(marks_).last(plan_.patterns.size());
    }
    std::span<const uint32_t> surfaceMarks() const {
        return std::span(marks_)
            .last(plan_.patterns.size() + surfaceLines_.size())
            .first(surfaceLines_.size());
    }

    /// Drawings in UV share one frame and so one cut; every projected one has a frame of its own.
    Result<void> cutDrawings() {
        PageCutter cutter(work_);
        Page uv;
        uint32_t seamLine = 0;
        drawUvGrids(uv, seamLine);
        std::vector<std::pair<Page, const Projection*>> projected;
        size_t line = 0;
        for (const FracturePlan::Drawing& drawing : plan_.drawings) {
            Page page;
            page.map.lines = drawing.map.lines;
            for (size_t i = 0; i < page.map.lines.size(); ++i) page.marks.push_back(marks_[line++]);
            if (auto ok = cutter.closeGapsOf(page); !ok) return ok;
            if (drawing.projection.kind == Projection::Kind::uv) {
                std::move(page.map.lines.begin(), page.map.lines.end(),
                          std::back_inserter(uv.map.lines));
                uv.marks.insert(uv.marks.end(), page.marks.begin(), page.marks.end());
            } else if (!page.map.lines.empty()) {
                projected.emplace_back(std::move(page), &drawing.projection);
            }
        }
        // Charts alone are cells, too.
        if (!uv.map.lines.empty() || seamLine != 0) {
            if (auto ok = cutter.cutByUv(uv, seamLine); !ok) return ok;
        }
        for (auto& [page, projection] : projected) {
            const PageFrames frames =
                projectedFrames(work_.mesh, work_.result.surface, *projection);
            // Around an axis what sticks out of one side of the page comes in on the other.
            if (frames.tilesU > 1)
                tilePage(page, Wrap::repeat, Wrap::repeat, {-1, frames.tilesU - 1, 0, 0});
            if (auto ok = cutter.cutPage(page, frames.triangles, 0); !ok) return ok;
        }
        return {};
    }

    /// Grids in UV are drawings, and cut with them: their cells end at chart borders.
    void drawUvGrids(Page& uv, uint32_t& seamLine) {
        for (size_t i = 0; i < plan_.patterns.size(); ++i) {
            const Pattern& pattern = plan_.patterns[i].pattern;
            if (!isUvGrid(pattern)) continue;
            const uint32_t mark = patternMarks()[i];
            const PagePattern drawn = drawGrid(pattern);
            uv.map.lines.insert(uv.map.lines.end(), drawn.map.lines.begin(), drawn.map.lines.end());
            uv.marks.resize(uv.map.lines.size(), mark);
            seamLine = seamLine == 0 ? mark : std::min(seamLine, mark);
            CellLevel cells;
            cells.level = work_.result.lines.level(mark);
            cells.domain.assign(work_.mesh.triangles.size(), 0);
            cells.domains = 1;
            cells.asked = drawn.cells;
            cells.text = pattern.text;
            work_.result.cells.push_back(std::move(cells));
        }
    }

    /// Each pattern divides what the levels before it left.
    Result<void> growPatterns() {
        if (plan_.patterns.empty()) return {};
        work_.result.groups = groupParts(work_.mesh, topology_);
        std::vector<size_t> order(plan_.patterns.size());
        std::iota(order.begin(), order.end(), size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return patternMarks()[a] < patternMarks()[b]; });
        PatternCutter cutter(work_);
        for (const size_t i : order) {
            if (isUvGrid(plan_.patterns[i].pattern)) continue;
            if (auto ok = cutter.growPattern(plan_.patterns[i], patternMarks()[i]); !ok) return ok;
        }
        return {};
    }

    const MeshTopology& topology_;  ///< of the mesh before any cut
    const FracturePlan& plan_;
    CuttingSurface work_;
    std::vector<uint32_t> marks_;  ///< of all lines in the order of `numberLines`
    std::vector<const FractureMap::SurfaceLine*> surfaceLines_;
};

}  // namespace

Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FracturePlan& plan, const CutOptions& options) {
    return PlanCutter(mesh, topology, plan, options).run();
}

bool CutSurface::hasCells(uint32_t level) const {
    return std::any_of(cells.begin(), cells.end(), [level](const CellLevel& c) {
        return c.level == level && c.cellOf != nullptr;
    });
}

Components componentsOf(const CutSurface& cut, std::vector<CellReport>& reports) {
    return findPieces(cut.surface, cut.topology, cut.lines, cut.lines.levels(), cut.groups,
                      cut.cells, {cut.splitPatches}, reports);
}

bool isFaithfulSplit(const SurfaceMesh& mesh, const MeshTopology& before, const CutSurface& cut,
                     double tolerance) {
    std::vector<double> area(mesh.triangles.size(), 0);
    double total = 0;
    double reach = 0;  // a coordinate is off by 2^-24 of its size, an area by that times an edge
    for (const SplitTriangle& t : cut.surface.triangles)
        area[t.source] += triangleArea(cut.surface.positions, t.v);
    for (const glm::vec3& p : mesh.positions) {
        reach =
            std::max({reach, std::abs(double{p.x}), std::abs(double{p.y}), std::abs(double{p.z})});
    }
    for (size_t t = 0; t < area.size(); ++t) {
        if (before.degenerate[t] == 0) total += triangleArea(mesh.positions, mesh.triangles[t]);
    }
    for (size_t t = 0; t < area.size(); ++t) {
        if (before.degenerate[t] != 0) continue;
        const double whole = triangleArea(mesh.positions, mesh.triangles[t]);
        const double rounding = 1e-6 * reach * std::sqrt(total);
        if (std::abs(area[t] - whole) > tolerance * total + rounding) return false;
    }
    for (const VertexOrigin& origin : cut.surface.origins) {
        const glm::dvec3& w = origin.weights;
        if (w.x < 0 || w.y < 0 || w.z < 0 || std::abs(w.x + w.y + w.z - 1) > 1e-12) return false;
    }
    if (before.boundaryEdges + before.nonManifoldEdges > 0) return true;
    return cut.topology.boundaryEdges + cut.topology.nonManifoldEdges == 0;
}

}  // namespace sherd
