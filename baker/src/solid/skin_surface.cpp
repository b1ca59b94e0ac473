// SPDX-License-Identifier: MIT
#include "solid/skin_surface.h"

#include <algorithm>
#include <map>

#include "solid/edge_key.h"

namespace sherd {
namespace {

/// Notes where a corner of the skin lies on the triangle it is part of: in one of its corners,
/// which may have been united with another vertex, or on an edge.
void notePlace(const std::array<uint32_t, 3>& corners, const glm::dvec3& weights, uint32_t vertex,
               CutSkin& skin) {
    for (size_t k = 0; k < 3; ++k) {
        const size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const double wi = weights[static_cast<int>(i)], wj = weights[static_cast<int>(j)];
        if (wi == 0 && wj == 0) {
            skin.united[corners[k]] = vertex;
            return;
        }
        if (weights[static_cast<int>(k)] != 0 || wi == 0 || wj == 0) continue;
        const uint32_t a = corners[i], b = corners[j];
        skin.places.push_back(a < b ? CutSkin::OnEdge{a, b, wj, vertex}
                                    : CutSkin::OnEdge{b, a, wi, vertex});
    }
}

/// (1 - t) a + t b, for ends of one edge of the mesh or inside one triangle of it.
VertexOrigin between(const VertexOrigin& a, const VertexOrigin& b, double t) {
    std::map<uint32_t, double> sum;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<size_t>(i);
        if (a.weights[i] > 0) sum[a.vertices[k]] += (1 - t) * a.weights[i];
        if (b.weights[i] > 0) sum[b.vertices[k]] += t * b.weights[i];
    }
    VertexOrigin origin{{}, glm::dvec3(0.0)};
    int next = 0;
    for (const auto& [vertex, weight] : sum) {
        if (next == 3) break;
        origin.vertices[static_cast<size_t>(next)] = vertex;
        origin.weights[next++] = weight;
    }
    for (; next < 3; ++next) origin.vertices[static_cast<size_t>(next)] = origin.vertices[0];
    return origin;
}

class EdgeDivider {
  public:
    EdgeDivider(const SplitSurface& before, const CutSkin& skin, std::span<const uint8_t> wanted)
        : before_(before), skin_(skin), wanted_(wanted) {}

    DividedSurface run() {
        SplitSurface& surface = result_.surface;
        surface.meshVertices = before_.meshVertices;
        surface.positions = before_.positions;
        surface.origins = before_.origins;
        addVertices();
        for (uint32_t t = 0; t < before_.triangles.size(); ++t) {
            result_.firstOf.push_back(static_cast<uint32_t>(surface.triangles.size()));
            const SplitTriangle& triangle = before_.triangles[t];
            std::array<Points, 3> sides;
            for (size_t k = 0; k < 3; ++k)
                sides[k] = pointsOn(triangle.v[k], triangle.v[(k + 1) % 3]);
            SplitTriangle whole = triangle;
            for (uint32_t& v : whole.v) v = skin_.united[v];
            size_t flat = 0;
            while (flat < 3 && whole.v[flat] != whole.v[(flat + 1) % 3]) ++flat;
            if (flat < 3) {
                divideFlat(whole, flat, sides);
            } else {
                divide(whole, sides);
            }
            result_.parent.resize(surface.triangles.size(), t);
        }
        result_.firstOf.push_back(static_cast<uint32_t>(surface.triangles.size()));
        return std::move(result_);
    }

  private:
    using Points = std::vector<uint32_t>;

    void addVertices() {
        result_.vertexOfCut.assign(skin_.positions.size(), kNone);
        for (uint32_t v = 0; v < skin_.surfaceVertices; ++v) result_.vertexOfCut[v] = v;
        for (const CutSkin::OnEdge& place : skin_.places) {
            if (wanted_[place.vertex] == 0) continue;
            uint32_t& vertex = result_.vertexOfCut[place.vertex];
            if (vertex == kNone) {
                vertex = static_cast<uint32_t>(result_.surface.positions.size());
                result_.surface.positions.push_back(skin_.positions[place.vertex]);
                result_.surface.origins.push_back(
                    between(before_.origins[place.low], before_.origins[place.high], place.t));
            }
            onEdge_[edgeKey(place.low, place.high)].push_back(vertex);
        }
    }

    Points pointsOn(uint32_t from, uint32_t to) const {
        const auto found = onEdge_.find(edgeKey(from, to));
        if (found == onEdge_.end()) return {};
        Points points = found->second;
        if (from > to) std::reverse(points.begin(), points.end());
        return points;
    }

    /// A triangle that has no width left, since two of its corners, v[k] and the next, have been
    /// united: nothing, but where its two sides have different points.
    void divideFlat(const SplitTriangle& t, size_t k, const std::array<Points, 3>& sides) {
        const uint32_t foot = t.v[k], tip = t.v[(k + 2) % 3];
        Points there{foot}, back{foot};
        const Points& up = sides[(k + 1) % 3];
        const Points& down = sides[(k + 2) % 3];
        there.insert(there.end(), up.begin(), up.end());
        back.insert(back.end(), down.rbegin(), down.rend());
        there.push_back(tip);
        back.push_back(tip);
        size_t i = 0, j = 0;  // in both the same vertex
        while (i + 1 < there.size() && j + 1 < back.size()) {
            size_t m = i + 1;
            auto n = back.end();
            for (; m < there.size(); ++m) {
                n = std::find(back.begin() + static_cast<std::ptrdiff_t>(j) + 1, back.end(),
                              there[m]);
                if (n != back.end()) break;
            }
            if (n == back.end()) return;
            const auto end = static_cast<size_t>(n - back.begin());
            Points polygon(there.begin() + static_cast<std::ptrdiff_t>(i),
                           there.begin() + static_cast<std::ptrdiff_t>(m) + 1);
            for (size_t b = end; b-- > j + 1;) polygon.push_back(back[b]);
            for (size_t c = 1; c + 1 < polygon.size(); ++c) {
                result_.surface.triangles.push_back(
                    {{polygon[0], polygon[c], polygon[c + 1]}, t.source, {}});
            }
            i = m;
            j = end;
        }
    }

    /// A fan from the corner across a side with points; its first and last triangle may have points
    /// on the two other sides.
    void divide(const SplitTriangle& t, const std::array<Points, 3>& sides) {
        const auto side = std::find_if(sides.begin(), sides.end(),
                                       [](const Points& points) { return !points.empty(); });
        if (side == sides.end()) {
            const bool flat = t.v[0] == t.v[1] || t.v[1] == t.v[2] || t.v[2] == t.v[0];
            if (!flat) result_.surface.triangles.push_back(t);
            return;
        }
        const auto k = static_cast<size_t>(side - sides.begin());
        const size_t next = (k + 1) % 3, tip = (k + 2) % 3;
        Points chain{t.v[k]};
        chain.insert(chain.end(), side->begin(), side->end());
        chain.push_back(t.v[next]);
        for (size_t i = 0; i + 1 < chain.size(); ++i) {
            const bool first = i == 0, last = i + 2 == chain.size();
            divide({{chain[i], chain[i + 1], t.v[tip]},
                    t.source,
                    {t.line[k], last ? t.line[next] : 0, first ? t.line[tip] : 0}},
                   {Points{}, last ? sides[next] : Points{}, first ? sides[tip] : Points{}});
        }
    }

    const SplitSurface& before_;
    const CutSkin& skin_;
    std::span<const uint8_t> wanted_;
    std::map<uint64_t, Points> onEdge_;  ///< from the lower end
    DividedSurface result_;
};

}  // namespace

CutSkin cutSkin(const SplitSurface& surface, const MeshCut& cut, std::span<const uint32_t> kept) {
    CutSkin skin;
    skin.positions = surface.positions;
    skin.surfaceVertices = static_cast<uint32_t>(surface.positions.size());
    skin.vertex.assign(cut.positions.size(), kNone);
    for (uint32_t v = 0; v < skin.surfaceVertices; ++v) skin.vertex[v] = v;
    skin.united.assign(skin.vertex.begin(), skin.vertex.begin() + skin.surfaceVertices);
    skin.ofSkin.assign(cut.skin.size(), kNone);
    for (uint32_t s = 0; s < cut.skin.size(); ++s) {
        const MeshCut::SkinTriangle& t = cut.skin[s];
        CutSkin::Triangle triangle{{}, kept[t.source]};
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& vertex = skin.vertex[t.v[k]];
            if (vertex == kNone) {
                vertex = static_cast<uint32_t>(skin.positions.size());
                skin.positions.push_back(cut.positions[t.v[k]]);
            }
            triangle.v[k] = vertex;
            glm::dvec3 weights(0.0);
            weights[static_cast<int>(k)] = 1;
            if (t.weights != MeshCut::kWhole) weights = cut.weights[t.weights][k];
            notePlace(surface.triangles[triangle.parent].v, weights, vertex, skin);
        }
        const auto& v = triangle.v;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        skin.ofSkin[s] = static_cast<uint32_t>(skin.triangles.size());
        skin.triangles.push_back(triangle);
    }
    std::sort(skin.places.begin(), skin.places.end());
    skin.places.erase(std::unique(skin.places.begin(), skin.places.end()), skin.places.end());
    return skin;
}

DividedSurface divideEdges(const SplitSurface& before, const CutSkin& skin,
                           std::span<const uint8_t> wanted) {
    return EdgeDivider(before, skin, wanted).run();
}

}  // namespace sherd
