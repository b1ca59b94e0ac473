// SPDX-License-Identifier: MIT
#include "levels/wall_matching.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>

#include "levels/leaf_cut.h"
#include "levels/side_split.h"
#include "levels/wall_fold.h"
#include "levels/wall_overlay.h"

namespace sherd {
namespace {

constexpr int32_t kSide = WallOverlayInput::kSide;

GridPoint onSide(size_t k, int32_t n) {
    return k == 0 ? GridPoint{n, 0} : k == 1 ? GridPoint{kSide - n, n} : GridPoint{0, kSide - n};
}

/// Where points of a side lie on the grid, in their order and apart however near they are.
std::vector<int32_t> stepsOf(const std::vector<EdgePoints::Point>& side) {
    std::vector<int32_t> steps;
    const auto count = static_cast<int32_t>(side.size());
    for (const EdgePoints::Point& p : side) {
        const auto n = static_cast<int32_t>(steps.size());
        const int32_t least = n == 0 ? 1 : steps.back() + 1;
        const auto at = static_cast<int32_t>(std::lround(std::clamp(p.share, 0.0, 1.0) * kSide));
        steps.push_back(std::clamp(at, least, std::max(least, kSide - (count - n))));
    }
    return steps;
}

bool isFlat(const std::array<uint32_t, 3>& v) {
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

/// One wall in its own frame.
class WallFrame {
  public:
    WallFrame(const WallPair& pair, const PieceModel& model, const std::vector<uint32_t>& places)
        : pair_(pair), model_(model), places_(places) {
        const glm::dvec3 a = at(pair.v[0]);
        ab_ = at(pair.v[1]) - a;
        ac_ = at(pair.v[2]) - a;
        normal_ = glm::cross(ab_, ac_);
    }

    /// Nothing if two points are one on the grid.
    std::optional<WallOverlayInput> input() {
        if (!(glm::dot(normal_, normal_) > 0)) return std::nullopt;
        WallOverlayInput input;
        const std::array<GridPoint, 3> corners = {GridPoint{0, 0}, GridPoint{kSide, 0},
                                                  GridPoint{0, kSide}};
        bool distinct = true;
        for (size_t k = 0; k < 3; ++k)
            distinct = add(places_[pair_.v[k]], corners[k], input) && distinct;
        for (size_t k = 0; k < 3; ++k) {
            const std::vector<int32_t> steps = stepsOf(pair_.onSides[k]);
            for (size_t n = 0; n < steps.size(); ++n)
                distinct = add(places_[pair_.onSides[k][n].vertex], onSide(k, steps[n]), input) &&
                           distinct;
        }
        for (size_t side = 0; side < 2; ++side) {
            for (const uint32_t f : pair_.faces[side]) {
                std::array<uint32_t, 3> t = model_.hidden.faces[f].v;
                for (uint32_t& v : t) v = places_[v];
                if (isFlat(t)) continue;
                if (side == 1) std::swap(t[1], t[2]);
                for (uint32_t& v : t) {
                    const uint32_t place = v;
                    if (!local_.contains(place))
                        distinct = add(place, inner(place), input) && distinct;
                    v = local_[place];
                }
                input.cuts[side].push_back(t);
                faceOf_[side].push_back(f);
            }
        }
        if (!distinct) return std::nullopt;
        return input;
    }

    const std::vector<uint32_t>& placeOf() const { return placeOf_; }
    /// Of the input's triangles the hidden faces: those that have an area.
    const std::vector<uint32_t>& facesOf(size_t side) const { return faceOf_[side]; }

  private:
    glm::dvec3 at(uint32_t v) const { return model_.hidden.positions[v]; }

    glm::dvec2 weightsAt(uint32_t place) const {
        const glm::dvec3 ap = at(place) - at(pair_.v[0]);
        const double area2 = glm::dot(normal_, normal_);
        return {glm::dot(glm::cross(ap, ac_), normal_) / area2,
                glm::dot(glm::cross(ab_, ap), normal_) / area2};
    }

    GridPoint inner(uint32_t place) const {
        const glm::dvec2 w = weightsAt(place);
        const auto round = [](double x, int32_t most) {
            return std::clamp(static_cast<int32_t>(std::lround(std::clamp(x, 0.0, 1.0) * kSide)), 1,
                              most);
        };
        const int32_t u = round(w.x, kSide - 2);
        return {u, round(w.y, kSide - 1 - u)};
    }

    bool add(uint32_t place, GridPoint p, WallOverlayInput& input) {
        const auto [it, isNew] =
            local_.try_emplace(place, static_cast<uint32_t>(input.points.size()));
        if (!isNew) return false;
        const bool distinct =
            std::find(input.points.begin(), input.points.end(), p) == input.points.end();
        input.points.push_back(p);
        const glm::dvec2 w = weightsAt(place);
        const double length = glm::length(ab_);
        input.shape.emplace_back(w.x * length + w.y * glm::dot(ab_, ac_) / length,
                                 w.y * glm::length(normal_) / length);
        placeOf_.push_back(place);
        return distinct;
    }

    const WallPair& pair_;
    const PieceModel& model_;
    const std::vector<uint32_t>& places_;
    glm::dvec3 ab_, ac_, normal_;
    std::map<uint32_t, uint32_t> local_;  ///< by place
    std::vector<uint32_t> placeOf_;       ///< per local point
    std::array<std::vector<uint32_t>, 2> faceOf_;
};

class WallMatcher {
  public:
    explicit WallMatcher(const PieceModel& model)
        : model_(model), places_(placesOf(model)), faces_(model.hidden.faces) {
        for (HiddenMesh::Face& face : faces_)
            for (uint32_t& v : face.v) v = places_[v];
        replaced_.assign(faces_.size(), 0);
    }

    MatchedWalls run(const std::vector<WallPair>& pairs) {
        uint32_t apart = 0;
        for (const WallPair& pair : pairs)
            if (!matches(pair) && !match(pair) && !fold(pair)) ++apart;
        store();
        return {folded_, apart};
    }

  private:
    /// Whether both sides have the same triangles already.
    bool matches(const WallPair& pair) const {
        std::array<std::vector<std::array<uint32_t, 3>>, 2> sides;
        for (size_t side = 0; side < 2; ++side) {
            for (const uint32_t f : pair.faces[side]) {
                auto t = faces_[f].v;
                if (isFlat(t)) continue;
                if (side == 1) std::swap(t[1], t[2]);
                std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
                sides[side].push_back(t);
            }
            std::sort(sides[side].begin(), sides[side].end());
        }
        return sides[0] == sides[1];
    }

    bool fold(const WallPair& pair) {
        const std::optional<WallFold> fold = foldWall(faces_, pair.faces, model_);
        if (!fold) return false;
        added_.insert(added_.end(), fold->added.begin(), fold->added.end());
        for (const uint32_t f : fold->dropped) replaced_[f] = 1;
        for (const uint32_t f : fold->inner) faces_[f].exposedFrom = fold->exposedFrom;
        ++folded_;
        return true;
    }

    bool match(const WallPair& pair) {
        WallFrame frame(pair, model_, places_);
        const std::optional<WallOverlayInput> input = frame.input();
        if (!input) return false;
        const std::optional<WallOverlay> overlay = overlayWall(*input);
        if (!overlay) return false;
        std::vector<uint32_t> vertices = frame.placeOf();
        const auto made = static_cast<uint32_t>(model_.hidden.positions.size());
        for (uint32_t n = 0; n < overlay->crossings.size(); ++n) vertices.push_back(made + n);
        if (!takeEdges(waysOf(*overlay, vertices))) return false;
        for (const WallOverlay::OnEdge& p : overlay->crossings) {
            const glm::dvec3 a = model_.hidden.positions[vertices[p.a]];
            const glm::dvec3 b = model_.hidden.positions[vertices[p.b]];
            model_.hidden.positions.emplace_back(a + (b - a) * p.share);
        }
        for (const WallOverlay::Part& part : overlay->parts) {
            for (size_t side = 0; side < 2; ++side) {
                HiddenMesh::Face face = faces_[frame.facesOf(side)[part.of[side]]];
                for (size_t k = 0; k < 3; ++k) face.v[k] = vertices[part.v[k]];
                if (side == 1) std::swap(face.v[1], face.v[2]);
                added_.push_back(face);
            }
        }
        for (const std::vector<uint32_t>& side : pair.faces)
            for (const uint32_t f : side) replaced_[f] = 1;
        return true;
    }

    using Edge = std::pair<uint32_t, uint32_t>;  ///< ascending
    using Ways = std::map<Edge, std::vector<uint32_t>>;

    /// What lies on edges, from their lower end to their higher.
    static Ways waysOf(const WallOverlay& overlay, const std::vector<uint32_t>& vertices) {
        Ways ways;
        for (const WallOverlay::OnEdge& p : overlay.onEdges) {
            const uint32_t a = vertices[p.a], b = vertices[p.b];
            std::vector<uint32_t>& way = ways[std::minmax(a, b)];
            way.insert(a < b ? way.end() : way.begin(), vertices[p.point]);
        }
        return ways;
    }

    /// What a wall gains on an edge inside it, the caps that meet it there gain, too. Where two
    /// walls, or a wall and the skin, have an edge in one place each would have to gain what the
    /// other does, and that in turn: only the first gains anything.
    bool takeEdges(const Ways& ways) {
        if (skin_.empty()) findSkin();
        std::vector<Edge> parts;
        for (const auto& [edge, way] : ways) {
            if (skin_.contains(edge) || taken_.contains(edge)) return false;
            for (size_t n = 0; n <= way.size(); ++n) {
                const uint32_t from = n == 0 ? edge.first : way[n - 1];
                const uint32_t to = n == way.size() ? edge.second : way[n];
                parts.emplace_back(std::minmax(from, to));
                if (ways_.contains(parts.back())) return false;
            }
        }
        taken_.insert(parts.begin(), parts.end());
        for (const auto& [edge, way] : ways) taken_.insert(edge);
        ways_.insert(ways.begin(), ways.end());
        return true;
    }

    void findSkin() {
        for (const SplitTriangle& t : model_.surface.triangles)
            for (size_t k = 0; k < 3; ++k)
                skin_.insert(std::minmax(places_[t.v[k]], places_[t.v[(k + 1) % 3]]));
    }

    void store() {
        std::vector<HiddenMesh::Face>& out = model_.hidden.faces;
        out.clear();
        const auto add = [&](HiddenMesh::Face face) {
            SideSplit split{face.v, {}, {}};
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t from = split.v[k], to = split.v[(k + 1) % 3];
                const auto way = ways_.find(std::minmax(from, to));
                if (way == ways_.end()) continue;
                split.inner[k] = way->second;
                if (from > to) std::reverse(split.inner[k].begin(), split.inner[k].end());
            }
            subdivide(split, [&](const SideSplit& part) {
                face.v = part.v;
                out.push_back(face);
            });
        };
        for (uint32_t f = 0; f < faces_.size(); ++f)
            if (replaced_[f] == 0) add(faces_[f]);
        for (const HiddenMesh::Face& face : added_) add(face);
    }

    const PieceModel& model_;
    std::vector<uint32_t> places_;
    std::vector<HiddenMesh::Face> faces_;  ///< over places
    std::vector<uint8_t> replaced_;
    std::vector<HiddenMesh::Face> added_;
    uint32_t folded_ = 0;
    std::set<Edge> skin_;   ///< edges of outer faces
    std::set<Edge> taken_;  ///< edges that walls have points on, and the parts of these
    Ways ways_;
};

}  // namespace

MatchedWalls matchWalls(const std::vector<WallPair>& pairs, const PieceModel& model) {
    if (pairs.empty()) return {};
    return WallMatcher(model).run(pairs);
}

}  // namespace sherd
