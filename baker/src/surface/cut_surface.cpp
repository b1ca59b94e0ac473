// SPDX-License-Identifier: MIT
#include "surface/cut_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <numeric>

#include "geometry/triangle.h"
#include "map/page_tiling.h"
#include "pattern/grow.h"
#include "pattern/page_patterns.h"
#include "surface/chords.h"
#include "surface/components.h"
#include "surface/page_frames.h"
#include "surface/surface_path.h"
#include "surface/surface_point.h"
#include "surface/thesis_pairing.h"
#include "surface/triangulation.h"

namespace sherd {
namespace {

/// One object's cutting: the surface as cut so far, and what there is to say.
class SurfaceCutter {
  public:
    SurfaceCutter(const SurfaceMesh& mesh, const MeshTopology& topology, const FracturePlan& plan,
                  const CutOptions& options)
        : mesh_(mesh), plan_(plan), options_(options) {
        result_.surface = uncutSurface(mesh);
        result_.topology = topology;
    }

    Result<CutSurface> run() {
        numberLines();
        if (auto ok = cutDrawings(); !ok) return tl::unexpected(ok.error());
        if (auto ok = cutSurfaceLines(); !ok) return tl::unexpected(ok.error());
        if (auto ok = growPatterns(); !ok) return tl::unexpected(ok.error());
        return std::move(result_);
    }

  private:
    /// Lines of one page and their marks.
    struct Page {
        FractureMap map;
        std::vector<uint32_t> marks;
    };

    /// Lines of drawings, lines over the surface, patterns: one mark each, in this order.
    void numberLines() {
        std::vector<LineTable::Line> lines;
        const auto add = [&lines](const auto& line) {
            lines.push_back({line.level, line.properties, line.source});
        };
        for (const FracturePlan::Drawing& drawing : plan_.drawings)
            for (const FractureMap::Line& line : drawing.map.lines) add(line);
        for (const FracturePlan::Drawing& drawing : plan_.drawings)
            for (const FractureMap::SurfaceLine& line : drawing.map.surfaceLines) {
                add(line);
                surfaceLines_.push_back(&line);
            }
        for (const FractureMap::SurfaceLine& line : mesh_.lines) {
            add(line);
            surfaceLines_.push_back(&line);
        }
        for (const FracturePlan::Grown& grown : plan_.patterns)
            lines.push_back({grown.level, {}, grown.pattern.text});
        marks_ = result_.lines.assign(std::move(lines));
    }

    /// Drawings in UV share one frame and so one cut; every projected one has a frame of its own.
    Result<void> cutDrawings() {
        Page uv;
        uint32_t seamLine = 0;
        drawUvGrids(uv, seamLine);
        std::vector<std::pair<Page, const Projection*>> projected;
        size_t line = 0;
        for (const FracturePlan::Drawing& drawing : plan_.drawings) {
            Page page;
            page.map.lines = drawing.map.lines;
            for (size_t i = 0; i < page.map.lines.size(); ++i) page.marks.push_back(marks_[line++]);
            if (auto ok = closePageGaps(page); !ok) return ok;
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
            if (auto ok = cutByUv(uv, seamLine); !ok) return ok;
        }
        for (auto& [page, projection] : projected) {
            const PageFrames frames = projectedFrames(mesh_, result_.surface, *projection);
            // Around an axis what sticks out of one side of the page comes in on the other.
            if (frames.tilesU > 1)
                tile(page, Wrap::repeat, Wrap::repeat, {-1, frames.tilesU - 1, 0, 0});
            if (auto ok = cutPage(page, frames.triangles); !ok) return ok;
        }
        return {};
    }

    static bool isUvGrid(const Pattern& pattern) {
        return pattern.kind == Pattern::Kind::grid &&
               pattern.projection.kind == Projection::Kind::uv;
    }

    /// Grids in UV are drawings, and cut with them: their cells end at chart borders.
    void drawUvGrids(Page& uv, uint32_t& seamLine) {
        const size_t first = marks_.size() - plan_.patterns.size();
        for (size_t i = 0; i < plan_.patterns.size(); ++i) {
            const Pattern& pattern = plan_.patterns[i].pattern;
            if (!isUvGrid(pattern)) continue;
            const uint32_t mark = marks_[first + i];
            const PagePattern drawn = drawGrid(pattern);
            uv.map.lines.insert(uv.map.lines.end(), drawn.map.lines.begin(), drawn.map.lines.end());
            uv.marks.resize(uv.map.lines.size(), mark);
            seamLine = seamLine == 0 ? mark : std::min(seamLine, mark);
            result_.cells.push_back({result_.lines.level(mark),
                                     std::vector<uint32_t>(mesh_.triangles.size(), 0),
                                     1,
                                     {},
                                     false,
                                     drawn.cells,
                                     pattern.text});
        }
    }

    Result<void> closePageGaps(Page& page) {
        if (!(options_.closeGaps > 0) || page.map.lines.empty()) return {};
        std::vector<uint32_t> lineOf;
        const Result<std::vector<ClosedGap>> closed =
            closeGaps(page.map, options_.closeGaps, lineOf);
        if (!closed) return tl::unexpected(closed.error());
        for (const uint32_t of : lineOf) page.marks.push_back(uint32_t{page.marks[of]});
        result_.closedGaps.insert(result_.closedGaps.end(), closed->begin(), closed->end());
        return {};
    }

    Result<void> cutByUv(Page& page, uint32_t seamLine) {
        const Result<std::vector<UvTriangle>> frames = snapUv(mesh_);
        if (!frames) return tl::unexpected(frames.error());
        const auto [wrapU, wrapV, repeats] = wrapping();
        if (repeats) tile(page, wrapU, wrapV, tilesOf(*frames));
        return cutPage(page, *frames, seamLine);
    }

    struct Wrapping {
        Wrap u = Wrap::repeat, v = Wrap::repeat;
        bool repeats = true;
    };
    /// What the picture of most triangles does outside its page, or what was asked for.
    Wrapping wrapping() {
        switch (options_.wrap) {
            case PageWrap::none:
                return {Wrap::repeat, Wrap::repeat, false};
            case PageWrap::repeat:
                return {Wrap::repeat, Wrap::repeat, true};
            case PageWrap::mirror:
                return {Wrap::mirror, Wrap::mirror, true};
            case PageWrap::clamp:
                return {Wrap::clamp, Wrap::clamp, true};
            case PageWrap::texture:
                break;
        }
        std::vector<size_t> uses(mesh_.placements.size(), 0);
        for (const uint32_t slot : mesh_.triangleMaterials)
            if (slot < uses.size()) ++uses[slot];
        const auto most = std::max_element(uses.begin(), uses.end());
        if (most == uses.end()) return {};
        const TexturePlacement& chosen = mesh_.placements[static_cast<size_t>(most - uses.begin())];
        for (size_t slot = 0; slot < uses.size(); ++slot) {
            const TexturePlacement& other = mesh_.placements[slot];
            if (uses[slot] == 0 || (other.wrapU == chosen.wrapU && other.wrapV == chosen.wrapV))
                continue;
            result_.warnings.emplace_back(
                "its pictures differ in what they show outside [0, 1]; lines follow the one that "
                "most triangles have (--wrap says otherwise)");
            break;
        }
        return {chosen.wrapU, chosen.wrapV, true};
    }

    static TileRange tilesOf(std::span<const UvTriangle> frames) {
        GridPoint low{kGridLimit, kGridLimit};
        GridPoint high{-kGridLimit, -kGridLimit};
        for (const UvTriangle& frame : frames) {
            for (const GridPoint& p : frame.corner) {
                low = {std::min(low.u, p.u), std::min(low.v, p.v)};
                high = {std::max(high.u, p.u), std::max(high.v, p.v)};
            }
        }
        const auto first = [](int32_t x) { return x >> 24; };  // rounds down
        const auto last = [](int32_t x) { return (x - 1) >> 24; };
        return {std::min(0, first(low.u)), std::max(0, last(high.u)), std::min(0, first(low.v)),
                std::max(0, last(high.v))};
    }

    static void tile(Page& page, Wrap wrapU, Wrap wrapV, const TileRange& range) {
        if (range.onlyPage()) return;
        TiledLines tiled = tileLines(page.map.lines, wrapU, wrapV, range);
        std::vector<uint32_t> marks;
        for (const uint32_t of : tiled.lineOf) marks.push_back(page.marks[of]);
        page.map.lines = std::move(tiled.lines);
        page.marks = std::move(marks);
    }

    Result<void> cutPage(const Page& page, std::span<const UvTriangle> frames,
                         uint32_t seamLine = 0) {
        Result<PlanarMap> planar = planarise(page.map);
        if (!planar) return tl::unexpected(planar.error());
        result_.warnings.insert(result_.warnings.end(), planar->warnings.begin(),
                                planar->warnings.end());
        std::vector<Cut> cuts = matchAll(*planar, page.marks, frames, result_.topology.degenerate);
        noteLinesOffCharts(page, *planar, cuts);
        const Pass pass{*planar, frames, true, seamLine};
        if (!options_.seams.thesisPairing) return cutAlong(pass, cuts);

        const std::vector<Cut> unmoved = cuts;
        const uint32_t averaged =
            averageSeamPairs(result_.topology, result_.surface.triangles, frames, cuts);
        if (cutAlong(pass, cuts)) {
            result_.seams.averaged += averaged;
            return {};
        }
        // A moved end may drag its line over another.
        result_.warnings.emplace_back(
            "averaging line ends at seams made lines cross; it was left out");
        return cutAlong(pass, unmoved);
    }

    /// Lines that lie wholly outside every chart.
    void noteLinesOffCharts(const Page& page, const PlanarMap& map, std::span<const Cut> cuts) {
        std::vector<uint8_t> touches(result_.lines.size() + 1, 0);
        for (const Cut& cut : cuts) touches[cut.line] = 1;
        // A line all of which another covers has no edge here and is not off the charts.
        for (const MapEdge& edge : map.edges) {
            const uint32_t mark = page.marks[edge.line];
            if (touches[mark] != 0) continue;
            touches[mark] = 1;
            result_.offCharts.push_back(
                {std::nullopt, nodeUv(map, edge.from), result_.lines.line(mark).source});
        }
    }

    struct Pass {
        const PlanarMap& map;
        std::span<const UvTriangle> frames;
        bool seams;         ///< frames have seams, over which line ends are joined
        uint32_t seamLine;  ///< mark that all seams get; 0: none
    };

    Result<void> cutAlong(const Pass& pass, std::span<const Cut> cuts) {
        ResolvedEdges edges = resolveEdges(result_.topology, result_.surface, cuts);
        SeamReport seams;
        if (pass.seamLine != 0) markSeams(pass, edges);
        if (pass.seams)
            seams = joinAcrossSeams(result_.topology, result_.surface, pass.frames, cuts,
                                    result_.lines, options_.seams, edges);
        std::vector<uint32_t> from;
        const SplitInput input{
            result_.surface, result_.topology, pass.frames, pass.map, cuts, edges};
        Result<SplitSurface> split = splitSurface(input, result_.cells.empty() ? nullptr : &from);
        if (!split) return tl::unexpected(split.error());
        findDeadEnds(pass, cuts);
        result_.surface = std::move(*split);
        result_.topology =
            buildTopology(result_.surface.positions, vertexTriangles(result_.surface));
        for (CellLevel& cells : result_.cells) {
            std::vector<uint32_t> domain;
            domain.reserve(from.size());
            for (const uint32_t t : from) domain.push_back(cells.domain[t]);
            cells.domain = std::move(domain);
        }
        result_.seams.joined += seams.joined;
        result_.seams.loose.insert(result_.seams.loose.end(), seams.loose.begin(),
                                   seams.loose.end());
        return {};
    }

    void markSeams(const Pass& pass, ResolvedEdges& edges) const {
        for (uint32_t h = 0; h < result_.topology.opposite.size(); ++h) {
            if (!isUvSeam(result_.topology, pass.frames, h)) continue;
            const uint32_t edge = result_.topology.halfEdgeEdge[h];
            for (uint32_t p = 0; p <= edges.pointCount(edge); ++p)
                edges.markPiece(edges.firstPiece(edge) + p, pass.seamLine);
        }
    }

    /// Where lines end in the middle of the surface.
    void findDeadEnds(const Pass& pass, std::span<const Cut> cuts) {
        std::vector<uint32_t> degree(pass.map.nodes.size(), 0);
        for (const MapEdge& edge : pass.map.edges) {
            ++degree[edge.from];
            ++degree[edge.to];
        }
        std::map<uint32_t, const Cut*> cutOfNode;
        std::optional<MapIndex> index;
        for (const Cut& cut : cuts) {
            for (const CutEnd& end : {cut.from, cut.to}) {
                if (end.where == CutEnd::Where::inside && degree[end.node] == 1)
                    cutOfNode.try_emplace(end.node, &cut);
            }
        }
        for (const auto& [node, cut] : cutOfNode) {
            const glm::dvec3 position =
                positionAt(cut->triangle, pass.frames[cut->triangle], nodeUv(pass.map, node));
            std::string note = result_.lines.line(cut->line).source;
            if (pass.seams) {
                if (!index) index.emplace(pass.map);
                const auto ahead = lineNear(pass.map, *index, node, cut->mapEdge, kSmallGap);
                if (ahead) note += gapNote(glm::distance(*ahead, nodeUv(pass.map, node)));
            }
            result_.deadEnds.push_back({position, uvAt(cut->triangle, position), note});
        }
    }

    /// A line that ends this near another, in page units, was most likely meant to reach it.
    static constexpr double kSmallGap = 0.02;
    static std::string gapNote(double distance) {
        std::array<char, 96> text{};
        std::snprintf(text.data(), text.size(),
                      ", %.2g short of a line: --close-gaps %.2g leads it there", distance,
                      1.2 * distance);
        return text.data();
    }

    /// The place of the frame's point on the triangle.
    glm::dvec3 positionAt(uint32_t triangle, const UvTriangle& frame, const glm::dvec2& uv) const {
        const auto at = [&](size_t k) {
            return glm::dvec2(frame.corner[k].u, frame.corner[k].v) / double{kGridOne};
        };
        const auto area = [](glm::dvec2 x, glm::dvec2 y) { return x.x * y.y - x.y * y.x; };
        const double whole = area(at(1) - at(0), at(2) - at(0));
        const double b = whole == 0 ? 0 : area(uv - at(0), at(2) - at(0)) / whole;
        const double c = whole == 0 ? 0 : area(at(1) - at(0), uv - at(0)) / whole;
        const auto& v = result_.surface.triangles[triangle].v;
        return glm::dvec3(result_.surface.positions[v[0]]) * (1 - b - c) +
               glm::dvec3(result_.surface.positions[v[1]]) * b +
               glm::dvec3(result_.surface.positions[v[2]]) * c;
    }

    std::optional<glm::dvec2> uvAt(uint32_t triangle, const glm::dvec3& position) const {
        return uvOf(mesh_, result_.surface.triangles[triangle].source, position);
    }

    /// All lines over the surface in one cut.
    Result<void> cutSurfaceLines() {
        if (surfaceLines_.empty()) return {};
        std::vector<UvTriangle> uv;
        if (auto frames = snapUv(mesh_)) uv = std::move(*frames);
        const PlaceFinder finder(mesh_, result_.surface, result_.topology.degenerate, uv);
        const PathTracer tracer(result_.surface, result_.topology);
        const size_t first = marks_.size() - plan_.patterns.size() - surfaceLines_.size();
        std::vector<Chord> chords;
        for (size_t i = 0; i < surfaceLines_.size(); ++i)
            traceLine(*surfaceLines_[i], marks_[first + i], finder, tracer, chords);
        return cutChords(chords);
    }

    void traceLine(const FractureMap::SurfaceLine& line, uint32_t mark, const PlaceFinder& finder,
                   const PathTracer& tracer, std::vector<Chord>& chords) {
        std::optional<SurfacePoint> previous;
        for (const SurfacePlace& place : line.places) {
            const std::optional<SurfacePoint> point = finder.find(place);
            if (!point || point->distance > options_.snapDistance) {
                BakePlace spot{std::nullopt, std::nullopt, line.source};
                if (place.in3d)
                    spot.position = place.point;
                else
                    spot.uv = glm::dvec2(place.point);
                result_.offSurface.push_back(std::move(spot));
                previous.reset();
                continue;
            }
            if (previous) tracePiece(*previous, *point, line, mark, tracer, chords);
            previous = point;
        }
    }

    void tracePiece(const SurfacePoint& from, const SurfacePoint& to,
                    const FractureMap::SurfaceLine& line, uint32_t mark, const PathTracer& tracer,
                    std::vector<Chord>& chords) {
        const std::optional<SurfacePath> path = tracer.trace(from, to, mark);
        const auto spot = [&] {
            const glm::dvec3 position = positionOf(result_.surface, to);
            return BakePlace{position, uvAt(to.triangle, position), line.source};
        };
        if (!path) {
            result_.gaps.push_back(spot());
            return;
        }
        if (path->alongEdges) result_.alongEdges.push_back(spot());
        chords.insert(chords.end(), path->chords.begin(), path->chords.end());
    }

    Result<void> cutChords(std::span<const Chord> chords) {
        const Result<ChordCuts> cuts = cutsOfChords(chords);
        if (!cuts) return tl::unexpected(cuts.error());
        const std::vector<UvTriangle> frames(result_.surface.triangles.size(), unitFrame());
        return cutAlong({cuts->map, frames, false, 0}, cuts->cuts);
    }

    /// Patterns from the coarsest level on: each divides what the levels before it left.
    Result<void> growPatterns() {
        if (plan_.patterns.empty()) return {};
        result_.groups = groupParts(mesh_, originalTopology());
        std::vector<size_t> order(plan_.patterns.size());
        std::iota(order.begin(), order.end(), size_t{0});
        const size_t first = marks_.size() - plan_.patterns.size();
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return marks_[first + a] < marks_[first + b]; });
        for (const size_t i : order) {
            if (isUvGrid(plan_.patterns[i].pattern)) continue;
            if (auto ok = growPattern(plan_.patterns[i].pattern, marks_[first + i]); !ok) return ok;
        }
        return {};
    }

    MeshTopology originalTopology() const {
        return buildTopology(mesh_.positions, mesh_.triangles);
    }

    Result<void> growPattern(const Pattern& pattern, uint32_t mark) {
        const uint32_t level = result_.lines.level(mark);
        GrowthInput input{result_.surface, result_.topology, result_.groups, piecesBefore(level)};
        if (pattern.kind == Pattern::Kind::grid || pattern.kind == Pattern::Kind::radial)
            return growPage(pattern, level, mark, findDomains(input));
        if (pattern.kind == Pattern::Kind::wood)
            input.grain =
                pattern.axis == glm::dvec3(0.0) ? longestAxis(result_.surface) : pattern.axis;
        input.density = densityOf(pattern);
        Growth growth = growCells(input, pattern, level, mark);
        result_.cells.push_back(std::move(growth.cells));
        return cutChords(growth.chords);
    }

    std::vector<uint32_t> piecesBefore(uint32_t level) const {
        if (level == 1) return std::vector<uint32_t>(result_.surface.triangles.size(), 0);
        std::vector<CellReport> ignored;
        const Components components =
            findPieces(result_.surface, result_.topology, result_.lines, level - 1, result_.groups,
                       result_.cells, {options_.splitPatches}, ignored);
        return components.leaf;
    }

    Density densityOf(const Pattern& pattern) const {
        if (!pattern.around.empty()) {
            double sigma = pattern.spread * diagonal();
            std::vector<glm::dvec3> places;
            const auto& pose = mesh_.restPose;
            for (const glm::dvec3& p : pattern.around)
                places.push_back(glm::inverse(glm::dquat(pose.rotation)) *
                                 (p - glm::dvec3(pose.translation)));
            return [this, places, sigma](uint32_t triangle, const glm::dvec3& w) {
                const auto& v = result_.surface.triangles[triangle].v;
                const glm::dvec3 p = glm::dvec3(result_.surface.positions[v[0]]) * w[0] +
                                     glm::dvec3(result_.surface.positions[v[1]]) * w[1] +
                                     glm::dvec3(result_.surface.positions[v[2]]) * w[2];
                double sum = 0.01;  // a few everywhere, so that no cell is endless
                for (const glm::dvec3& place : places) {
                    const double d = glm::distance(p, place) / sigma;
                    sum += std::exp(-0.5 * d * d);
                }
                return std::min(1.0, sum);
            };
        }
        const auto found = options_.densities.find(pattern.density);
        if (found == options_.densities.end()) return {};
        return [this, density = found->second](uint32_t triangle, const glm::dvec3& weights) {
            // Told in weights of the mesh's own triangle.
            const SplitTriangle& t = result_.surface.triangles[triangle];
            const auto& corners = mesh_.triangles[t.source];
            glm::dvec3 whole(0.0);
            for (int k = 0; k < 3; ++k) {
                const VertexOrigin& origin = result_.surface.origins[t.v[static_cast<size_t>(k)]];
                for (int j = 0; j < 3; ++j) {
                    const auto at = std::find(corners.begin(), corners.end(),
                                              origin.vertices[static_cast<size_t>(j)]);
                    if (at != corners.end())
                        whole[static_cast<int>(at - corners.begin())] +=
                            weights[k] * origin.weights[j];
                }
            }
            return density(t.source, whole);
        };
    }

    /// Of what triangles use.
    std::pair<glm::dvec3, glm::dvec3> extent() const {
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (const SplitTriangle& t : result_.surface.triangles) {
            for (const uint32_t v : t.v) {
                low = glm::min(low, glm::dvec3(result_.surface.positions[v]));
                high = glm::max(high, glm::dvec3(result_.surface.positions[v]));
            }
        }
        return {low, high};
    }
    double diagonal() const {
        const auto [low, high] = extent();
        return glm::distance(low, high);
    }

    /// A pattern drawn on a page: on a plane its cells go through the object, and so do those of a
    /// radial one; on a box they end at its edges; around an axis patches are pieces.
    Result<void> growPage(const Pattern& pattern, uint32_t level, uint32_t mark,
                          const Domains& domains) {
        const bool radial = pattern.kind == Pattern::Kind::radial;
        using Kind = Projection::Kind;
        const Kind kind = radial ? Kind::planar : pattern.projection.kind;
        PagePlane plane;
        double reach = 1;
        if (radial) {
            plane = radialPlane(pattern);
            reach = 0;
            for (const SplitTriangle& t : result_.surface.triangles)
                for (const uint32_t v : t.v)
                    reach = std::max(reach, glm::length(plane.at(result_.surface.positions[v])));
            constexpr double kFarthest = 4;  // beyond, all the object lies within a sector or two
            if (!(reach <= kFarthest))
                return fail(ErrorCode::badArgument,
                            "the radial pattern's centre lies more than 4 diagonals of the object "
                            "beside it; move it (at=X,Y,Z) onto the object or near it",
                            "pattern \"" + pattern.text + "\"");
        } else if (kind == Kind::planar) {
            plane = fitPage(result_.surface, pattern.projection.axis);
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
            result_.cells.push_back(std::move(cells));
            return cutPage(page, framesOnPlane(result_.surface, plane).triangles);
        }
        if (kind == Kind::box) {
            // What faces another side for a moment (a groove, a rivet) strays to its neighbours.
            cells.wholeCells = false;
            cells.asked = 6 * drawn.cells;
            // Asked after this cutter is gone: the sides are found now.
            std::vector<uint8_t> sides;
            for (uint32_t t = 0; t < mesh_.triangles.size(); ++t)
                sides.push_back(boxSide(mesh_, t));
            cells.cellOf = [sides = std::move(sides), planes = boxPlanes(result_.surface),
                            cellAt = drawn.cellAt, count = drawn.cells](
                               uint32_t, uint32_t source, const glm::dvec3& position) {
                const uint8_t side = sides[source];
                return side * count + cellAt(planes[side].at(position));
            };
        }
        result_.cells.push_back(std::move(cells));
        const PageFrames frames = projectedFrames(mesh_, result_.surface, pattern.projection);
        tile(page, Wrap::repeat, Wrap::repeat, {0, frames.tilesU - 1, 0, 0});
        return cutPage(page, frames.triangles, mark);
    }

    /// Around the point that was hit, looked at along the normal; a unit is the diagonal.
    PagePlane radialPlane(const Pattern& pattern) const {
        PagePlane plane = fitPage(result_.surface, pattern.axis);
        const double scale = 1 / diagonal();
        plane.right = glm::normalize(plane.right) * scale;
        plane.down = glm::normalize(plane.down) * scale;
        if (pattern.centre) {
            const auto& pose = mesh_.restPose;
            plane.origin = glm::inverse(glm::dquat(pose.rotation)) *
                           (*pattern.centre - glm::dvec3(pose.translation));
        } else {
            const auto [low, high] = extent();
            plane.origin = (low + high) * 0.5;
        }
        return plane;
    }

    const SurfaceMesh& mesh_;
    const FracturePlan& plan_;
    const CutOptions& options_;
    std::vector<uint32_t> marks_;  ///< of all lines in the order of `numberLines`
    std::vector<const FractureMap::SurfaceLine*> surfaceLines_;
    CutSurface result_;
};

}  // namespace

Result<CutSurface> cutSurface(const SurfaceMesh& mesh, const MeshTopology& topology,
                              const FracturePlan& plan, const CutOptions& options) {
    return SurfaceCutter(mesh, topology, plan, options).run();
}

bool CutSurface::hasCells(uint32_t level) const {
    return std::any_of(cells.begin(), cells.end(), [level](const CellLevel& c) {
        return c.level == level && c.cellOf != nullptr;
    });
}

Components componentsOf(const CutSurface& cut, bool splitPatches,
                        std::vector<CellReport>& reports) {
    return findPieces(cut.surface, cut.topology, cut.lines, cut.lines.levels(), cut.groups,
                      cut.cells, {splitPatches}, reports);
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
