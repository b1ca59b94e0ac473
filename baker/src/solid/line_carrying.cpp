// SPDX-License-Identifier: MIT
#include "solid/line_carrying.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "solid/far_side.h"
#include "surface/cutting_surface.h"
#include "surface/surface_path.h"
#include "surface/surface_point.h"

namespace sherd {
namespace {

/// A piece of line along an edge of the split surface, by one of its half edges.
struct Link {
    uint32_t halfEdge = 0;
    bool carried = false;
};

/// An end of a link on the far side.
struct Image {
    SurfacePoint point;
    glm::dvec3 position{0.0};
    double thickness = 0;  ///< metres from where it was
};

class LineCarrier {
  public:
    explicit LineCarrier(CuttingSurface& work)
        : work_(work),
          surface_(work.result.surface),
          topology_(work.result.topology),
          lines_(work.result.lines),
          farSide_(surface_, topology_),
          finder_(work.mesh, surface_, topology_.degenerate, {}),
          tracer_(surface_, topology_) {}

    Result<CarriedLines> run() {
        findLinks();
        chooseLinks();
        findRims();
        pruneStubs();
        for (uint32_t link = 0; link < links_.size(); ++link) carry(link);
        for (const auto& [vertex, links] : linksAt_) joinImages(vertex, links);
        if (chords_.empty()) return result_;
        const std::vector<BakePlace> deadEnds = work_.result.deadEnds;
        if (auto ok = work_.cutChords(chords_); !ok) return tl::unexpected(ok.error());
        work_.result.deadEnds = deadEnds;  // those of carried lines are nobody's
        return result_;
    }

  private:
    uint32_t start(uint32_t h) const { return surface_.triangles[h / 3].v[h % 3]; }
    uint32_t end(uint32_t h) const { return start(nextCorner(h)); }
    glm::dvec3 at(uint32_t vertex) const { return surface_.positions[vertex]; }
    uint32_t markOf(uint32_t h) const { return surface_.triangles[h / 3].line[h % 3]; }

    void findLinks() {
        for (uint32_t h = 0; h < topology_.opposite.size(); ++h) {
            const uint32_t o = topology_.opposite[h];
            const uint32_t mark = markOf(h);
            if (o == kNone || o < h || mark == 0) continue;
            linksAt_[start(h)].push_back(static_cast<uint32_t>(links_.size()));
            linksAt_[end(h)].push_back(static_cast<uint32_t>(links_.size()));
            links_.push_back({h, false});
        }
    }

    /// Chains of links from node to node are carried as a whole: where most of one has nothing like
    /// it on the far side.
    void chooseLinks() {
        std::vector<std::array<uint32_t, 3>> segments;
        for (const Link& link : links_) {
            const uint32_t h = link.halfEdge;
            segments.push_back({start(h), end(h), end(h)});
        }
        const TriangleBvh lines(surface_.positions, segments);
        UnionFind chains(links_.size());
        for (const auto& [vertex, links] : linksAt_)
            if (links.size() == 2) chains.unite(links[0], links[1]);
        std::map<uint32_t, double> alone;  // length without a counterpart, less that with one
        std::vector<uint8_t> leads(links_.size(), 0);
        for (uint32_t l = 0; l < links_.size(); ++l) {
            const uint32_t h = links_[l].halfEdge;
            if (lines_.line(markOf(h)).cells || !leadsThrough(h)) continue;
            leads[l] = 1;
            alone[chains.find(l)] +=
                hasCounterpart(h, lines) ? -edgeLength(surface_, h) : edgeLength(surface_, h);
        }
        for (uint32_t l = 0; l < links_.size(); ++l)
            links_[l].carried = leads[l] != 0 && alone[chains.find(l)] > 0;
        dropScraps();
    }

    /// What hangs together must be longer than the wall is thick: of less one cannot say whether
    /// the far side has its like.
    void dropScraps() {
        UnionFind graphs(links_.size());
        for (const auto& [vertex, links] : linksAt_) {
            uint32_t first = kNone;
            for (const uint32_t link : links) {
                if (!links_[link].carried) continue;
                if (first != kNone) graphs.unite(first, link);
                first = link;
            }
        }
        std::map<uint32_t, double> length, thickness;
        for (uint32_t l = 0; l < links_.size(); ++l) {
            if (!links_[l].carried) continue;
            const uint32_t h = links_[l].halfEdge;
            const auto image = imageOf(l, true, true);
            length[graphs.find(l)] += edgeLength(surface_, h);
            double& thickest = thickness[graphs.find(l)];
            if (image) thickest = std::max(thickest, image->thickness);
        }
        constexpr double kLongEnough = 2;
        for (uint32_t l = 0; l < links_.size(); ++l) {
            const uint32_t g = graphs.find(l);
            if (links_[l].carried && length[g] < kLongEnough * thickness[g])
                links_[l].carried = false;
        }
    }

    /// Whether a line runs along where the link would arrive.
    bool hasCounterpart(uint32_t h, const TriangleBvh& lines) const {
        const auto far = farSide_.behind((at(start(h)) + at(end(h))) * 0.5, meanNormal(h));
        if (!far) return false;
        constexpr double kAbout = 0.7;     // of the thickness
        constexpr double kParallel = 0.7;  // cosine of 45 degrees
        constexpr double kFacing = -0.3;
        const glm::dvec3 middle = (at(start(h)) + at(end(h))) * 0.5;
        const glm::dvec3 along = glm::normalize(at(end(h)) - at(start(h)));
        const glm::dvec3 normal = meanNormal(h);
        const auto runsAlong = [&](uint32_t other) {
            const uint32_t o = links_[other].halfEdge;
            const glm::dvec3 way = at(end(o)) - at(start(o));
            return std::abs(glm::dot(way, along)) > kParallel * glm::length(way) &&
                   glm::dot(meanNormal(o), normal) < kFacing;
        };
        const double reach = kAbout * glm::distance(middle, far->position);
        return lines.closest(far->position, reach, runsAlong).triangle != ClosestPoint::kNone;
    }

    glm::dvec3 meanNormal(uint32_t h) const {
        const glm::dvec3 sum =
            farSide_.normalOf(h / 3) + farSide_.normalOf(topology_.opposite[h] / 3);
        const double length = glm::length(sum);
        return length > 0 ? sum / length : glm::dvec3(0.0);
    }

    /// Whether the surface on both sides of an edge, no crease, sees one place of the far side.
    bool leadsThrough(uint32_t h) const {
        const uint32_t a = h / 3, b = topology_.opposite[h] / 3;
        if (glm::dot(farSide_.normalOf(a), farSide_.normalOf(b)) < FarSide::kCrease) return false;
        const auto fromA = farSide_.acrossFrom(a);
        const auto fromB = farSide_.acrossFrom(b);
        if (!fromA || !fromB) return false;
        const double here = glm::distance(centroidOf(surface_, a), centroidOf(surface_, b));
        const double there = glm::distance(fromA->position, fromB->position);
        constexpr double kMostSpread = 4;  // the far side of a wall is about as large
        return there < kMostSpread * here && here < kMostSpread * there;
    }

    uint32_t carriedAt(uint32_t vertex) const {
        const auto& links = linksAt_.at(vertex);
        return static_cast<uint32_t>(std::count_if(
            links.begin(), links.end(), [this](uint32_t l) { return links_[l].carried; }));
    }

    /// The image of a link's end. At a rim it is taken a little before it: on the edge itself the
    /// surface looks both ways.
    std::optional<Image> imageOf(uint32_t link, bool atStart, bool beforeRim) const {
        const uint32_t h = links_[link].halfEdge;
        const glm::dvec3 normal = meanNormal(h);
        if (normal == glm::dvec3(0.0)) return std::nullopt;
        glm::dvec3 from = at(atStart ? start(h) : end(h));
        if (beforeRim) from += kBeforeRim * (at(atStart ? end(h) : start(h)) - from);
        const uint32_t corner = atStart ? h : nextCorner(h);
        const auto place = farSide_.behind(from, farSide_.smoothNormal(corner, normal));
        if (!place) return std::nullopt;
        const auto point = finder_.nearest(place->position);
        if (!point) return std::nullopt;
        return Image{*point, positionOf(surface_, *point), glm::distance(from, place->position)};
    }

    /// Line ends from which a short way leads over a rim to their image.
    void findRims() {
        for (const auto& [vertex, links] : linksAt_) {
            if (carriedAt(vertex) != 1) continue;
            const uint32_t link = *std::find_if(links.begin(), links.end(),
                                                [this](uint32_t l) { return links_[l].carried; });
            if (auto way = wayOverRim(vertex, link)) rims_[vertex] = std::move(*way);
        }
    }

    std::optional<std::vector<Chord>> wayOverRim(uint32_t vertex, uint32_t link) const {
        const uint32_t h = links_[link].halfEdge;
        const bool atStart = start(h) == vertex;
        const auto image = imageOf(link, atStart, true);
        if (!image) return std::nullopt;
        const uint32_t corner = atStart ? h : nextCorner(h);
        const SurfacePoint from{corner / 3, onHalfEdge(corner % 3, 0), 0};
        const auto path = tracer_.trace(from, image->point, markOf(h));
        if (!path || path->alongEdges) return std::nullopt;
        double length = 0;
        for (const Chord& chord : path->chords) {
            length += glm::distance(pointOn(surface_, chord.triangle, weightsOf(chord.a)),
                                    pointOn(surface_, chord.triangle, weightsOf(chord.b)));
        }
        constexpr double kMostWay = 3;  // a half circle has 1.6 of its diameter
        if (length > kMostWay * image->thickness) return std::nullopt;
        return path->chords;
    }

    /// What ends within the surface separates nothing, and is not carried.
    void pruneStubs() {
        std::vector<uint32_t> ends;
        const auto isStub = [this](uint32_t vertex) {
            return linksAt_.at(vertex).size() - pruned_[vertex] == 1 && !rims_.contains(vertex);
        };
        for (const auto& [vertex, links] : linksAt_)
            if (isStub(vertex)) ends.push_back(vertex);
        std::vector<uint8_t> gone(links_.size(), 0);
        while (!ends.empty()) {
            const uint32_t vertex = ends.back();
            ends.pop_back();
            for (const uint32_t link : linksAt_.at(vertex)) {
                if (gone[link] != 0) continue;
                gone[link] = 1;
                links_[link].carried = false;
                const uint32_t h = links_[link].halfEdge;
                const uint32_t other = start(h) == vertex ? end(h) : start(h);
                ++pruned_[vertex];
                ++pruned_[other];
                if (isStub(other)) ends.push_back(other);
            }
        }
    }

    void carry(uint32_t link) {
        if (!links_[link].carried) return;
        const uint32_t h = links_[link].halfEdge;
        const auto from = imageOf(link, true, rims_.contains(start(h)));
        const auto to = imageOf(link, false, rims_.contains(end(h)));
        if (!from || !to) {
            links_[link].carried = false;
            return;
        }
        images_[{link, true}] = *from;
        images_[{link, false}] = *to;
        if (draw(from->point, to->point, markOf(h))) ++result_.edges;
    }

    bool draw(const SurfacePoint& from, const SurfacePoint& to, uint32_t mark) {
        const auto path = tracer_.trace(from, to, mark);
        if (!path) return false;
        chords_.insert(chords_.end(), path->chords.begin(), path->chords.end());
        return true;
    }

    /// Images of one vertex by several links lie in one place, or are joined; that of a line's end
    /// is led over the rim, or on to what was drawn on the far side.
    void joinImages(uint32_t vertex, const std::vector<uint32_t>& links) {
        std::vector<std::pair<uint32_t, const Image*>> here;
        for (const uint32_t link : links) {
            const auto found = images_.find({link, start(links_[link].halfEdge) == vertex});
            if (found != images_.end()) here.emplace_back(link, &found->second);
        }
        if (here.empty()) return;
        const uint32_t mark = markOf(links_[here[0].first].halfEdge);
        for (size_t i = 1; i < here.size(); ++i) {
            const Image& a = *here[0].second;
            const Image& b = *here[i].second;
            if (glm::distance(a.position, b.position) < a.thickness) draw(a.point, b.point, mark);
        }
        if (here.size() > 1) return;
        if (const auto rim = rims_.find(vertex); rim != rims_.end()) {
            chords_.insert(chords_.end(), rim->second.begin(), rim->second.end());
            result_.rims.push_back({at(vertex), std::nullopt, lines_.line(mark).source});
        } else if (links.size() > 1) {
            leadOn(here[0].first, start(links_[here[0].first].halfEdge) == vertex);
        }
    }

    /// A line that ends on another, of which the far side has a line of its own: that one may lie
    /// farther on, by as much as the wall is thick.
    void leadOn(uint32_t link, bool atStart) {
        const Image& image = images_.at({link, atStart});
        const Image& before = images_.at({link, !atStart});
        const glm::dvec3 along = image.position - before.position;
        const double length = glm::length(along);
        if (!(length > 0)) return;
        const auto target = finder_.nearest(image.position + along * (image.thickness / length));
        if (!target) return;
        const auto path = tracer_.trace(image.point, *target, markOf(links_[link].halfEdge));
        if (!path || path->alongEdges) return;
        for (size_t i = 0; i < path->chords.size(); ++i) {
            if (!endsOnLine(path->chords[i])) continue;
            chords_.insert(chords_.end(), path->chords.begin(),
                           path->chords.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            return;
        }
    }

    bool endsOnLine(const Chord& chord) const {
        const auto& line = surface_.triangles[chord.triangle].line;
        return (chord.b.v == 0 && line[0] != 0) ||
               (chord.b.u + chord.b.v == kGridOne && line[1] != 0) ||
               (chord.b.u == 0 && line[2] != 0);
    }

    static constexpr double kBeforeRim = 0.01;  ///< of the link at the rim

    CuttingSurface& work_;
    const SplitSurface& surface_;
    const MeshTopology& topology_;
    const LineTable& lines_;
    FarSide farSide_;
    PlaceFinder finder_;
    PathTracer tracer_;
    std::vector<Link> links_;
    std::map<uint32_t, std::vector<uint32_t>> linksAt_;  ///< per vertex
    std::map<uint32_t, size_t> pruned_;                  ///< links at a vertex that are gone
    std::map<uint32_t, std::vector<Chord>> rims_;        ///< per vertex: the way to its image
    std::map<std::pair<uint32_t, bool>, Image> images_;  ///< per link, of its start and its end
    std::vector<Chord> chords_;
    CarriedLines result_;
};

}  // namespace

Result<CarriedLines> carryLines(const SurfaceMesh& mesh, const CutOptions& options,
                                CutSurface& cut) {
    CuttingSurface work(mesh, cut.topology, options);
    work.result = std::move(cut);
    Result<CarriedLines> carried = LineCarrier(work).run();
    cut = std::move(work.result);
    return carried;
}

}  // namespace sherd
