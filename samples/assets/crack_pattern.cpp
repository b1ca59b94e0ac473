// SPDX-License-Identifier: MIT
// Restricted Voronoi diagram: each triangle is clipped by the bisector planes of the sites near it
// (D. Yan et al., "Isotropic Remeshing with Fast and Exact Computation of Restricted Voronoi
// Diagram", 2009). We clip in a bent copy of space that is linear on each small triangle, so the
// borders stay straight there and neighbours agree on their common edge.
#include "crack_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "noise.h"

namespace sherd::samples {
namespace {

glm::dvec3 bend(const glm::dvec3& p, const CrackOptions& options) {
    const glm::dvec3 moved =
        p + options.bend * fractalNoise3(p / options.bendSize, options.octaves, options.seed);
    return moved * options.stretch;
}

struct Vertex {
    glm::dvec3 bent{0.0};
    glm::dvec3 position{0.0};
    glm::dvec2 uv{0.0};
};

Vertex mixVertices(const Vertex& a, const Vertex& b, double t) {
    return {glm::mix(a.bent, b.bent, t), glm::mix(a.position, b.position, t),
            glm::mix(a.uv, b.uv, t)};
}

/// What the edge from a polygon's vertex to the next one lies on.
struct EdgeTag {
    enum class Kind { triangle, bisector, parent };
    Kind kind = Kind::triangle;
    uint32_t index = 0;  ///< triangle: edge number; bisector: the other site
};

struct Polygon {
    std::vector<Vertex> vertices;
    std::vector<EdgeTag> tags;
};

/// A traced triangle: the corners, and the rim normal of each edge that lies on a chart's rim.
struct SmallTriangle {
    std::array<Vertex, 3> corners;
    std::array<glm::dvec2, 3> outward{};
};

/// The part of the polygon nearer to `mine` than to `other`.
Polygon clip(const Polygon& in, const glm::dvec3& mine, const glm::dvec3& other,
             uint32_t otherIndex) {
    const auto side = [&](const Vertex& v) {
        return glm::dot(other - mine, v.bent) - glm::dot(other - mine, (other + mine) * 0.5);
    };
    Polygon out;
    for (size_t i = 0; i < in.vertices.size(); ++i) {
        const Vertex& a = in.vertices[i];
        const Vertex& b = in.vertices[(i + 1) % in.vertices.size()];
        const double sa = side(a);
        const double sb = side(b);
        if (sa <= 0) {
            out.vertices.push_back(a);
            out.tags.push_back(in.tags[i]);
        }
        if ((sa <= 0) == (sb <= 0)) continue;
        out.vertices.push_back(mixVertices(a, b, sa / (sa - sb)));
        out.tags.push_back(sa <= 0 ? EdgeTag{EdgeTag::Kind::bisector, otherIndex} : in.tags[i]);
    }
    if (out.vertices.size() < 3) return {};
    return out;
}

/// The sites that may be nearest somewhere in the polygon, ascending.
std::vector<uint32_t> candidates(const Polygon& polygon, const std::vector<glm::dvec3>& sites) {
    glm::dvec3 center(0);
    for (const Vertex& v : polygon.vertices) center += v.bent / double(polygon.vertices.size());
    double reach = 0;
    for (const Vertex& v : polygon.vertices) reach = std::max(reach, glm::distance(center, v.bent));
    double nearest = std::numeric_limits<double>::max();
    for (const glm::dvec3& site : sites) nearest = std::min(nearest, glm::distance(center, site));
    std::vector<uint32_t> near;
    for (uint32_t i = 0; i < sites.size(); ++i) {
        if (glm::distance(center, sites[i]) <= nearest + 2 * reach) near.push_back(i);
    }
    return near;
}

struct CellPart {
    uint32_t site = 0;
    Polygon polygon;
};

std::vector<CellPart> divide(const Polygon& polygon, const std::vector<glm::dvec3>& sites) {
    std::vector<CellPart> parts;
    const std::vector<uint32_t> near = candidates(polygon, sites);
    for (const uint32_t i : near) {
        CellPart part{i, polygon};
        for (const uint32_t j : near) {
            if (j != i && !part.polygon.vertices.empty()) {
                part.polygon = clip(part.polygon, sites[i], sites[j], j);
            }
        }
        if (!part.polygon.vertices.empty()) parts.push_back(std::move(part));
    }
    return parts;
}

glm::dvec2 outwardAt(const SmallTriangle& triangle, const EdgeTag& tag) {
    return tag.kind == EdgeTag::Kind::triangle ? triangle.outward[tag.index] : glm::dvec2(0);
}

/// The borders between this cell and cells of higher number, so that each is taken once.
void collectBorders(const SmallTriangle& triangle, const CellPart& part,
                    std::vector<CrackSegment>& segments) {
    const size_t n = part.polygon.vertices.size();
    for (size_t i = 0; i < n; ++i) {
        const EdgeTag& tag = part.polygon.tags[i];
        if (tag.kind != EdgeTag::Kind::bisector || tag.index < part.site) continue;
        segments.push_back({part.polygon.vertices[i].uv, part.polygon.vertices[(i + 1) % n].uv,
                            outwardAt(triangle, part.polygon.tags[(i + n - 1) % n]),
                            outwardAt(triangle, part.polygon.tags[(i + 1) % n])});
    }
}

double polygonArea(const Polygon& polygon) {
    glm::dvec3 twice(0);
    for (size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
        twice += glm::cross(polygon.vertices[i].position - polygon.vertices[0].position,
                            polygon.vertices[i + 1].position - polygon.vertices[0].position);
    }
    return glm::length(twice) / 2;
}

/// Connected pieces of surface: parts of one cell that share a stretch of a small triangle's edge.
class PieceCounter {
  public:
    void add(const Polygon& polygon, uint32_t cell) {
        const auto part = static_cast<uint32_t>(parent_.size());
        parent_.push_back(part);
        areas_.push_back(polygonArea(polygon));
        for (size_t i = 0; i < polygon.vertices.size(); ++i) {
            if (polygon.tags[i].kind != EdgeTag::Kind::triangle) continue;
            const glm::dvec3& a = polygon.vertices[i].position;
            const glm::dvec3& b = polygon.vertices[(i + 1) % polygon.vertices.size()].position;
            if (glm::distance(a, b) < 1e-9) continue;
            // On an edge shared by two small triangles, the cell's stretch has the same middle.
            join(part, cell, (a + b) * 0.5);
        }
    }

    std::vector<double> areas() {
        std::map<uint32_t, double> sums;
        for (uint32_t i = 0; i < parent_.size(); ++i) sums[root(i)] += areas_[i];
        std::vector<double> out;
        out.reserve(sums.size());
        for (const auto& [piece, area] : sums) out.push_back(area);
        std::sort(out.begin(), out.end());
        return out;
    }

  private:
    static constexpr double kGrid = 1e-6;      ///< metres
    static constexpr double kRounding = 1e-9;  ///< metres, by which two computed middles may differ
    using Key = std::array<int64_t, 4>;

    static Key keyOf(const glm::dvec3& p, uint32_t cell) {
        const glm::dvec3 grid = glm::floor(p / kGrid);
        return {int64_t(grid.x), int64_t(grid.y), int64_t(grid.z), cell};
    }

    void join(uint32_t part, uint32_t cell, const glm::dvec3& middle) {
        const Key low = keyOf(middle - kRounding, cell);
        const Key high = keyOf(middle + kRounding, cell);
        for (int64_t x = low[0]; x <= high[0]; ++x) {
            for (int64_t y = low[1]; y <= high[1]; ++y) {
                for (int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = middles_.find({x, y, z, cell});
                    if (found != middles_.end()) parent_[root(part)] = root(found->second);
                }
            }
        }
        middles_.emplace(low, part);
    }

    uint32_t root(uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    std::vector<uint32_t> parent_;
    std::vector<double> areas_;
    std::map<Key, uint32_t> middles_;
};

/// Outward normals, in UV, of the triangle's edges that are seams.
std::array<glm::dvec2, 3> rimNormals(const Triangle& triangle, const std::array<bool, 3>& seams) {
    std::array<glm::dvec2, 3> outward{};
    for (uint32_t k = 0; k < 3; ++k) {
        if (!seams[k]) continue;
        const glm::dvec2 a = triangle[k].uv;
        const glm::dvec2 along = glm::dvec2(triangle[(k + 1) % 3].uv) - a;
        const glm::dvec2 inward = glm::dvec2(triangle[(k + 2) % 3].uv) - a;
        glm::dvec2 normal(along.y, -along.x);
        if (glm::dot(normal, inward) > 0) normal = -normal;
        outward[k] = glm::normalize(normal);
    }
    return outward;
}

/// The triangle cut into n^2 small ones. Points on an edge are computed from its lower position to
/// its higher one, so that both neighbours get the same bits.
std::vector<SmallTriangle> subdivide(const Mesh& mesh, const Triangle& triangle,
                                     const std::array<bool, 3>& seams,
                                     const CrackOptions& options) {
    const auto n = static_cast<int32_t>(options.subdivision);
    const std::array<glm::dvec2, 3> rims = rimNormals(triangle, seams);
    std::array<uint32_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return triangle[a].position < triangle[b].position; });
    const auto vertex = [&](int32_t i, int32_t j) {
        const std::array<int32_t, 3> steps{n - i - j, i, j};
        Vertex out;
        for (const uint32_t k : order) {
            const double weight = double(steps[k]) / n;
            out.position += glm::dvec3(mesh.positions[triangle[k].position]) * weight;
            out.uv += glm::dvec2(triangle[k].uv) * weight;
        }
        out.bent = bend(out.position, options);
        return out;
    };
    std::vector<SmallTriangle> small;
    for (int32_t j = 0; j < n; ++j) {
        for (int32_t i = 0; i + j < n; ++i) {
            SmallTriangle up{{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)}, {}};
            if (j == 0) up.outward[0] = rims[0];
            if (i + j + 1 == n) up.outward[1] = rims[1];
            if (i == 0) up.outward[2] = rims[2];
            small.push_back(up);
            if (i + j + 1 < n) {
                small.push_back({{vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, {}});
            }
        }
    }
    return small;
}

std::vector<glm::dvec3> scaledPositions(const std::vector<CrackSite>& sites,
                                        const CrackOptions& options) {
    std::vector<glm::dvec3> out;
    out.reserve(sites.size());
    for (const CrackSite& site : sites) out.push_back(site.position * options.stretch);
    return out;
}

std::vector<std::vector<glm::dvec3>> sitesByCell(const CrackPattern& pattern) {
    std::vector<std::vector<glm::dvec3>> out(pattern.level1.size());
    for (const CrackSite& site : pattern.level2) {
        out[site.cell].push_back(site.position * pattern.options.stretch);
    }
    return out;
}

uint32_t nearestSite(const glm::dvec3& bent, const std::vector<glm::dvec3>& sites) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < sites.size(); ++i) {
        if (glm::distance(bent, sites[i]) < glm::distance(bent, sites[best])) best = i;
    }
    return best;
}

/// Places spread over the surface with even density, `depth` below it.
std::vector<glm::dvec3> samplePlaces(const Mesh& mesh, uint32_t count, double depth,
                                     uint32_t seed) {
    std::vector<double> cumulative;
    const auto corner = [&](const Triangle& t, uint32_t k) {
        return glm::dvec3(mesh.positions[t[k].position]);
    };
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 a = corner(t, 0);
        cumulative.push_back(area += glm::length(glm::cross(corner(t, 1) - a, corner(t, 2) - a)));
    }
    std::vector<glm::dvec3> places;
    for (uint32_t s = 0; s < count; ++s) {
        const auto at = static_cast<int32_t>(s);
        const double pick = area * (s + hash01(at, 0, 0, seed)) / count;
        const auto found = std::lower_bound(cumulative.begin(), cumulative.end(), pick);
        const Triangle& t =
            mesh.triangles[std::min<size_t>(found - cumulative.begin(), cumulative.size() - 1)];
        const double root = std::sqrt(hash01(at, 1, 0, seed));
        const double along = hash01(at, 2, 0, seed);
        places.push_back(corner(t, 0) * (1 - root) + corner(t, 1) * (root * (1 - along)) +
                         corner(t, 2) * (root * along) - glm::dvec3(t[0].normal) * depth);
    }
    return places;
}

/// Farthest-point sampling: each next site is the place farthest from the chosen ones, distances
/// counting for more near the impact.
void scatterCell(const std::vector<glm::dvec3>& places, uint32_t cell,
                 const ScatterOptions& scatter, std::vector<CrackSite>& sites) {
    double extent = 1e-9;
    for (const glm::dvec3& p : places) extent = std::max(extent, glm::distance(p, scatter.impact));
    std::vector<double> gap(places.size(), std::numeric_limits<double>::max());
    size_t next = hash(static_cast<int32_t>(cell), 7, 0, scatter.seed) % places.size();
    for (uint32_t chosen = 0; chosen < scatter.counts[cell]; ++chosen) {
        sites.push_back({places[next], cell});
        for (size_t i = 0; i < places.size(); ++i) {
            const double local = 0.45 + glm::distance(places[i], scatter.impact) / extent;
            gap[i] = std::min(gap[i], glm::distance(places[i], sites.back().position) / local);
        }
        next = std::max_element(gap.begin(), gap.end()) - gap.begin();
    }
}

}  // namespace

std::vector<CrackSite> scatterSites(const Mesh& mesh, const CrackPattern& pattern,
                                    const ScatterOptions& scatter) {
    const std::vector<glm::dvec3> cells = scaledPositions(pattern.level1, pattern.options);
    std::vector<std::vector<glm::dvec3>> places(cells.size());
    for (const glm::dvec3& p : samplePlaces(mesh, 6000, scatter.depth, scatter.seed)) {
        places[nearestSite(bend(p, pattern.options), cells)].push_back(p);
    }
    std::vector<CrackSite> sites;
    for (uint32_t cell = 0; cell < cells.size(); ++cell) {
        if (!places[cell].empty()) scatterCell(places[cell], cell, scatter, sites);
    }
    return sites;
}

TracedCracks traceCracks(const Mesh& mesh, const CrackPattern& pattern) {
    const std::vector<glm::dvec3> cells = scaledPositions(pattern.level1, pattern.options);
    const std::vector<std::vector<glm::dvec3>> children = sitesByCell(pattern);
    const EdgeFlags seams = findSeams(mesh);
    TracedCracks traced;
    PieceCounter pieces1;
    PieceCounter pieces2;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const SmallTriangle& small :
             subdivide(mesh, mesh.triangles[t], seams[t], pattern.options)) {
            const Polygon whole{{small.corners.begin(), small.corners.end()},
                                {{EdgeTag::Kind::triangle, 0},
                                 {EdgeTag::Kind::triangle, 1},
                                 {EdgeTag::Kind::triangle, 2}}};
            for (CellPart& cell : divide(whole, cells)) {
                collectBorders(small, cell, traced.level1);
                pieces1.add(cell.polygon, cell.site);
                for (EdgeTag& tag : cell.polygon.tags) {
                    if (tag.kind == EdgeTag::Kind::bisector) tag.kind = EdgeTag::Kind::parent;
                }
                for (const CellPart& leaf : divide(cell.polygon, children[cell.site])) {
                    collectBorders(small, leaf, traced.level2);
                    pieces2.add(leaf.polygon, cell.site * 1000 + leaf.site);
                }
            }
        }
    }
    traced.areas1 = pieces1.areas();
    traced.areas2 = pieces2.areas();
    return traced;
}

}  // namespace sherd::samples
