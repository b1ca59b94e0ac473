// SPDX-License-Identifier: MIT
#include "split_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace sherd::test {

namespace {

using EdgeKey = std::pair<uint32_t, uint32_t>;

EdgeKey keyOf(uint32_t a, uint32_t b) {
    return std::minmax(a, b);
}

bool isDegenerate(const std::array<uint32_t, 3>& v) {
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

std::string at(const char* what, uint32_t triangle) {
    return std::string(what) + ", triangle " + std::to_string(triangle);
}

/// How often an edge is used from its low to its high vertex, and back.
using Uses = std::map<EdgeKey, std::array<uint32_t, 2>>;

template <class Triangles>
Uses countUses(const Triangles& triangles) {
    Uses uses;
    for (const std::array<uint32_t, 3>& v : triangles) {
        if (isDegenerate(v)) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = v[k];
            const uint32_t b = v[(k + 1) % 3];
            ++uses[keyOf(a, b)][a < b ? 0 : 1];
        }
    }
    return uses;
}

/// Per split vertex: whether it lies inside its source triangle, that is, all edges at it are used
/// in both directions by pieces of one triangle.
std::vector<uint8_t> innerVertices(const SplitSurface& surface) {
    std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> uses;  // source, from, to
    for (const SplitTriangle& t : surface.triangles) {
        for (size_t k = 0; k < 3; ++k) uses.emplace_back(t.source, t.v[k], t.v[(k + 1) % 3]);
    }
    std::sort(uses.begin(), uses.end());
    std::vector<uint8_t> inner(surface.positions.size(), 1);
    std::fill(inner.begin(), inner.begin() + surface.meshVertices, 0);
    for (const auto& [source, from, to] : uses) {
        if (!std::binary_search(uses.begin(), uses.end(), std::tuple(source, to, from)))
            inner[from] = inner[to] = 0;
    }
    return inner;
}

/// The vertices of the split surface on each mesh edge: low, points in the order of ids, high.
std::map<EdgeKey, std::vector<uint32_t>> chainsOf(const Uses& before, const CutSurface& cut) {
    std::map<EdgeKey, std::vector<uint32_t>> chains;
    for (const auto& [edge, uses] : before) chains[edge] = {edge.first};
    const std::vector<uint8_t> inner = innerVertices(cut.surface);
    for (uint32_t v = cut.surface.meshVertices; v < inner.size(); ++v) {
        if (inner[v] != 0) continue;
        const auto& named = cut.surface.origins[v].vertices;
        const auto [low, high] = std::minmax({named[0], named[1], named[2]});
        if (const auto chain = chains.find({low, high}); chain != chains.end())
            chain->second.push_back(v);
    }
    for (auto& [edge, chain] : chains) chain.push_back(edge.second);
    return chains;
}

double weightOf(const VertexOrigin& origin, uint32_t vertex) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        if (origin.vertices[static_cast<size_t>(k)] == vertex) sum += origin.weights[k];
    }
    return sum;
}

std::array<double, 3> weightsIn(const CutSurface& cut, const std::array<uint32_t, 3>& source,
                                uint32_t vertex) {
    const VertexOrigin& o = cut.surface.origins[vertex];
    return {weightOf(o, source[0]), weightOf(o, source[1]), weightOf(o, source[2])};
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

}  // namespace

std::string brokenConformity(const SurfaceMesh& mesh, const CutSurface& cut) {
    const Uses before = countUses(mesh.triangles);
    const auto triangles = vertexTriangles(cut.surface);
    Uses after = countUses(triangles);
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (isDegenerate(triangles[t])) return at("a vertex twice", t);
    }
    uint32_t borders = 0, uneven = 0, several = 0;
    for (const auto& [edge, uses] : after) {
        if (uses[0] + uses[1] == 1)
            ++borders;
        else if (uses[0] != uses[1])
            ++uneven;
        else if (uses[0] > 1)
            ++several;
    }
    const MeshTopology& topology = cut.topology;
    if (topology.boundaryEdges != borders || topology.nonManifoldEdges != uneven ||
        topology.pinchedEdges != several)
        return "the topology is another surface's";
    for (const auto& [edge, chain] : chainsOf(before, cut)) {
        const auto& uses = before.at(edge);
        for (size_t i = 1; i < chain.size(); ++i) {
            const bool forward = chain[i - 1] < chain[i];
            const auto piece = after.find(keyOf(chain[i - 1], chain[i]));
            if (piece == after.end()) return "a piece of a mesh edge is nobody's";
            if (piece->second[forward ? 0 : 1] != uses[0] ||
                piece->second[forward ? 1 : 0] != uses[1])
                return "a piece of a mesh edge is used otherwise than the edge was";
            after.erase(piece);
        }
    }
    for (const auto& [edge, uses] : after) {
        if (uses[0] != 1 || uses[1] != 1) return "a new edge is not used once each way";
    }
    return "";
}

std::string brokenArea(const SurfaceMesh& mesh, const CutSurface& cut) {
    double reach = 0;
    for (const glm::vec3& p : mesh.positions)
        reach =
            std::max({reach, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    const auto area = [](const std::vector<glm::vec3>& p, const std::array<uint32_t, 3>& v) {
        const glm::dvec3 a = p[v[0]];
        return 0.5 * glm::length(glm::cross(glm::dvec3(p[v[1]]) - a, glm::dvec3(p[v[2]]) - a));
    };
    // A corner off by d changes a triangle's area by no more than d times half its perimeter.
    const auto perimeter = [](const std::vector<glm::vec3>& p, const std::array<uint32_t, 3>& v) {
        return glm::distance(glm::dvec3(p[v[0]]), glm::dvec3(p[v[1]])) +
               glm::distance(glm::dvec3(p[v[1]]), glm::dvec3(p[v[2]])) +
               glm::distance(glm::dvec3(p[v[2]]), glm::dvec3(p[v[0]]));
    };
    std::vector<double> sum(mesh.triangles.size(), 0);
    std::vector<double> slack(mesh.triangles.size(), 0);
    const double off = 1.8 * reach * 0x1p-24;
    for (const SplitTriangle& t : cut.surface.triangles) {
        if (t.source >= sum.size()) return "a triangle of no source";
        sum[t.source] += area(cut.surface.positions, t.v);
        slack[t.source] += off * (perimeter(cut.surface.positions, t.v) + off);
    }
    for (uint32_t t = 0; t < sum.size(); ++t) {
        if (isDegenerate(mesh.triangles[t])) continue;
        const double whole = area(mesh.positions, mesh.triangles[t]);
        if (slack[t] == 0) return at("lost", t);
        if (std::abs(sum[t] - whole) > slack[t] + 1e-9 * whole) return at("another area", t);
    }
    return "";
}

std::string brokenPlaces(const SurfaceMesh& mesh, const CutSurface& cut) {
    double reach = 0;
    for (const glm::vec3& p : mesh.positions)
        reach =
            std::max({reach, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    const SplitSurface& s = cut.surface;
    if (s.origins.size() != s.positions.size()) return "not one origin a vertex";
    for (uint32_t v = 0; v < s.origins.size(); ++v) {
        const VertexOrigin& o = s.origins[v];
        glm::dvec3 place(0.0);
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            if (!(o.weights[k] >= 0)) return "a negative weight";
            sum += o.weights[k];
            place += o.weights[k] * glm::dvec3(mesh.positions[o.vertices[static_cast<size_t>(k)]]);
        }
        if (std::abs(sum - 1) > 1e-12) return "weights that do not add up to 1";
        if (v < s.meshVertices && s.positions[v] != mesh.positions[v])
            return "a vertex of the mesh has moved";
        const glm::dvec3 off = glm::abs(place - glm::dvec3(s.positions[v]));
        if (std::max({off.x, off.y, off.z}) > reach * 0x1p-23)
            return "a vertex is not where its weights say";
    }
    for (const SplitTriangle& t : s.triangles) {
        const auto& source = mesh.triangles[t.source];
        for (const uint32_t v : t.v) {
            const auto w = weightsIn(cut, source, v);
            if (std::abs(w[0] + w[1] + w[2] - 1) > 1e-12)
                return at("a vertex outside its source triangle", t.source);
        }
    }
    return "";
}

std::string brokenMarks(const CutSurface& cut) {
    std::map<EdgeKey, uint32_t> marks;
    for (const SplitTriangle& t : cut.surface.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            if (t.line[k] > cut.lines.size()) return at("a mark of no line", t.source);
            const auto [mark, isNew] =
                marks.try_emplace(keyOf(t.v[k], t.v[(k + 1) % 3]), t.line[k]);
            if (mark->second != t.line[k])
                return at("an edge marked otherwise on its two sides", t.source);
        }
    }
    return "";
}

std::string brokenComponents(const CutSurface& cut, const Components& components) {
    const auto n = static_cast<uint32_t>(cut.surface.triangles.size());
    std::map<uint32_t, uint32_t> above;  // component of the level before, by this one's
    for (uint32_t level = 1; level <= components.levels; ++level) {
        std::vector<uint32_t> parent(n);
        std::iota(parent.begin(), parent.end(), 0U);
        const auto find = [&](uint32_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (uint32_t h = 0; h < 3 * n; ++h) {
            const uint32_t o = cut.topology.opposite[h];
            const uint32_t line = cut.surface.triangles[h / 3].line[h % 3];
            if (o != 0xFFFFFFFFU && (line == 0 || cut.lines.level(line) > level))
                parent[find(h / 3)] = find(o / 3);
        }
        std::map<uint32_t, uint32_t> there, back;
        std::map<uint32_t, uint32_t> within;
        for (uint32_t t = 0; t < n; ++t) {
            const uint32_t own = components.at(level, components.leaf[t]);
            if (there.try_emplace(own, find(t)).first->second != find(t) ||
                back.try_emplace(find(t), own).first->second != own)
                return "components of level " + std::to_string(level) +
                       " are not what is connected";
            const uint32_t parentComponent =
                level == 1 ? 0 : components.at(level - 1, components.leaf[t]);
            if (within.try_emplace(own, parentComponent).first->second != parentComponent)
                return "levels do not nest";
        }
        if (components.count[level - 1] != there.size()) return "a wrong count of components";
    }
    return "";
}

namespace {

double extentOf(const CutOracle::Triangle& triangle) {
    int64_t most = 0;
    for (const exact::Grid& a : triangle.corner) {
        for (const exact::Grid& b : triangle.corner)
            most = std::max({most, std::abs(a.x - b.x), std::abs(a.y - b.y)});
    }
    return static_cast<double>(most);
}

/// So thin in UV that rounded weights say little about the places within.
bool isThin(const CutOracle::Triangle& triangle) {
    if (triangle.kind != CutOracle::Kind::area) return false;
    const auto& c = triangle.corner;
    const auto whole = static_cast<double>(exact::Line(c[0], c[1]).at(exact::Point(c[2])));
    return std::abs(whole) < 1e-5 * extentOf(triangle) * extentOf(triangle);
}

/// One source triangle's split vertices as exact points.
class ExactTriangle {
  public:
    ExactTriangle(const CutOracle::Triangle& oracle, const std::array<uint32_t, 3>& source)
        : oracle_(oracle), source_(source) {
        for (size_t k = 0; k < 3; ++k) point_.emplace(source[k], exact::Point(oracle.corner[k]));
    }

    /// The points of the mesh edge along half edge k, ids from low to high.
    void addEdge(size_t k, std::span<const uint32_t> chain, const CutOracle::Edge& edge) {
        std::array<exact::Grid, 2> ends{oracle_.corner[k], oracle_.corner[(k + 1) % 3]};
        if (source_[k] != chain.front()) std::swap(ends[0], ends[1]);
        for (size_t i = 0; i < edge.points.size(); ++i)
            point_.emplace(chain[i + 1], exact::pointAt(ends[0], ends[1], edge.points[i]));
    }

    /// Names the inner vertices: each is the inner end of a line nearest to it. False if that is
    /// not certain.
    bool addInner(const CutSurface& cut, std::span<const SplitTriangle> pieces,
                  std::string& wrong) {
        std::set<uint32_t> ids;
        for (const SplitTriangle& t : pieces) {
            for (const uint32_t v : t.v) {
                if (!point_.contains(v)) ids.insert(v);
            }
        }
        std::set<exact::Point> known;
        for (const auto& [id, p] : point_) known.insert(p);
        std::vector<exact::Point> inner;
        for (const CutOracle::Part& part : oracle_.parts) {
            for (const exact::Point& p : {part.from, part.to}) {
                if (known.insert(p).second) inner.push_back(p);
            }
        }
        if (ids.size() != inner.size()) wrong = "another number of points inside";
        if (!wrong.empty()) return true;
        std::vector<std::array<double, 3>> innerWeights;
        innerWeights.reserve(inner.size());
        for (const exact::Point& p : inner) innerWeights.push_back(weights(p));
        std::set<size_t> taken;
        for (const uint32_t id : ids) {
            const auto place = weightsIn(cut, source_, id);
            size_t nearest = 0;
            double least = HUGE_VAL, second = HUGE_VAL;
            for (size_t i = 0; i < inner.size(); ++i) {
                const double d = distance(place, innerWeights[i]);
                second = std::min(second, std::max(d, least));
                if (d < least) nearest = i;
                least = std::min(d, least);
            }
            const bool certain = second > 1e3 * std::max(least, 1e-15);
            if (!certain || least > 1e-6) {
                if (isThin(oracle_) || !certain) return false;
                wrong = "a point inside where no line ends or crosses";
                return true;
            }
            if (!taken.insert(nearest).second) return false;
            point_.emplace(id, inner[nearest]);
        }
        return true;
    }

    std::string check(std::span<const SplitTriangle> pieces, const LineTable& lines) const {
        std::map<std::pair<exact::Point, exact::Point>, uint32_t> wanted, found;
        for (const CutOracle::Part& part : oracle_.parts) {
            uint32_t& level =
                wanted.try_emplace(std::minmax(part.from, part.to), part.level).first->second;
            level = std::min(level, part.level);
        }
        double area = 0;
        for (const SplitTriangle& t : pieces) {
            std::array<exact::Point, 3> p;
            for (size_t k = 0; k < 3; ++k) p[k] = point_.at(t.v[k]);
            if (exact::turn(p[0], p[1], p[2]) != oracle_.turn)
                return "a triangle turned over or flat in UV";
            area += areaOf({p[0].u(), p[0].v()}, {p[1].u(), p[1].v()}, {p[2].u(), p[2].v()});
            for (size_t k = 0; k < 3; ++k) {
                if (t.line[k] == 0 || isAlongEdge(p[k], p[(k + 1) % 3])) continue;
                found[std::minmax(p[k], p[(k + 1) % 3])] = lines.level(t.line[k]);
            }
        }
        if (wanted != found) return "marked edges inside are not the lines";
        const auto& c = oracle_.corner;
        const auto grid = [](const exact::Grid& g) {
            return glm::dvec2(static_cast<double>(g.x), static_cast<double>(g.y));
        };
        const double whole = areaOf(grid(c[0]), grid(c[1]), grid(c[2]));
        if (std::abs(area - whole) > 1e-9 * whole + 64.0 * 0x1p-24 * extentOf(oracle_))
            return "another area in UV";
        return "";
    }

  private:
    static double areaOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
        return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    bool isAlongEdge(const exact::Point& p, const exact::Point& q) const {
        for (size_t k = 0; k < 3; ++k) {
            const exact::Line line(oracle_.corner[k], oracle_.corner[(k + 1) % 3]);
            if (line.at(p) == 0 && line.at(q) == 0) return true;
        }
        return false;
    }
    std::array<double, 3> weights(const exact::Point& p) const {
        std::array<double, 3> w{};
        const auto& c = oracle_.corner;
        const auto whole = static_cast<double>(exact::Line(c[0], c[1]).at(exact::Point(c[2])));
        for (size_t k = 0; k < 3; ++k) {
            const exact::Line line(c[(k + 1) % 3], c[(k + 2) % 3]);
            w[k] = static_cast<double>(line.at(p)) / static_cast<double>(p.w) / whole;
        }
        return w;
    }

    const CutOracle::Triangle& oracle_;
    std::array<uint32_t, 3> source_;
    std::map<uint32_t, exact::Point> point_;
};

std::string brokenEdges(const std::map<EdgeKey, std::vector<uint32_t>>& chains,
                        const CutSurface& cut, const CutOracle& oracle) {
    std::map<EdgeKey, uint32_t> marks;
    for (const SplitTriangle& t : cut.surface.triangles) {
        for (size_t k = 0; k < 3; ++k) marks[keyOf(t.v[k], t.v[(k + 1) % 3])] = t.line[k];
    }
    for (const auto& [key, edge] : oracle.edges) {
        const auto& chain = chains.at(key);
        if (chain.size() != edge.points.size() + 2) return "another number of points on an edge";
        for (size_t i = 0; i < edge.points.size(); ++i) {
            const double t = weightOf(cut.surface.origins[chain[i + 1]], key.second);
            if (std::abs(t - edge.points[i].value()) > 1e-14)
                return "a point elsewhere on its edge";
        }
        for (size_t i = 1; i < chain.size(); ++i) {
            const uint32_t mark = marks[keyOf(chain[i - 1], chain[i])];
            if ((mark == 0 ? 0 : cut.lines.level(mark)) != edge.pieceLevels[i - 1])
                return "a piece of an edge has another level";
        }
    }
    return "";
}

}  // namespace

std::string brokenGeometry(const SurfaceMesh& mesh, const CutSurface& cut, const CutOracle& oracle,
                           uint32_t& undecided) {
    const auto chains = chainsOf(countUses(mesh.triangles), cut);
    if (std::string wrong = brokenEdges(chains, cut, oracle); !wrong.empty()) return wrong;
    const std::span<const SplitTriangle> all = cut.surface.triangles;
    for (size_t first = 0; first < all.size();) {
        const uint32_t source = all[first].source;
        size_t end = first;
        while (end < all.size() && all[end].source == source) ++end;
        const auto pieces = all.subspan(first, end - first);
        first = end;
        if (oracle.triangles[source].kind != CutOracle::Kind::area) continue;
        ExactTriangle triangle(oracle.triangles[source], mesh.triangles[source]);
        for (size_t k = 0; k < 3; ++k) {
            const EdgeKey key =
                keyOf(mesh.triangles[source][k], mesh.triangles[source][(k + 1) % 3]);
            triangle.addEdge(k, chains.at(key), oracle.edges.at(key));
        }
        std::string wrong;
        if (!triangle.addInner(cut, pieces, wrong)) {
            ++undecided;
            continue;
        }
        if (wrong.empty()) wrong = triangle.check(pieces, cut.lines);
        if (!wrong.empty()) return at(wrong.c_str(), source);
    }
    return "";
}

namespace {

/// Whether a place surely lies in a piece of its triangle, by their weights of the corners.
bool surelyHolds(const std::array<std::array<double, 3>, 3>& piece,
                 const std::array<double, 3>& place) {
    constexpr double kSure = 1e-10;
    const auto turn = [](const auto& a, const auto& b, const auto& c) {
        return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    };
    return turn(piece[0], piece[1], place) > kSure && turn(piece[1], piece[2], place) > kSure &&
           turn(piece[2], piece[0], place) > kSure;
}

/// The piece that holds each sample, or -1.
std::vector<int64_t> holdersOf(const SurfaceMesh& mesh, const CutSurface& cut,
                               const CutOracle& oracle) {
    std::vector<std::vector<uint32_t>> pieces(mesh.triangles.size());
    for (uint32_t t = 0; t < cut.surface.triangles.size(); ++t)
        pieces[cut.surface.triangles[t].source].push_back(t);
    std::vector<int64_t> holders;
    for (const CutOracle::Sample& sample : oracle.samples) {
        holders.push_back(-1);
        if (isThin(oracle.triangles[sample.triangle])) continue;
        for (const uint32_t t : pieces[sample.triangle]) {
            std::array<std::array<double, 3>, 3> piece{};
            for (size_t k = 0; k < 3; ++k)
                piece[k] =
                    weightsIn(cut, mesh.triangles[sample.triangle], cut.surface.triangles[t].v[k]);
            if (surelyHolds(piece, sample.weights)) holders.back() = t;
        }
    }
    return holders;
}

}  // namespace

std::string brokenPartition(const SurfaceMesh& mesh, const CutSurface& cut,
                            const Components& components, const CutOracle& oracle,
                            uint32_t& samples) {
    if (components.count != oracle.counts) return "another number of components";
    const std::vector<int64_t> holders = holdersOf(mesh, cut, oracle);
    samples += static_cast<uint32_t>(
        std::count_if(holders.begin(), holders.end(), [](int64_t t) { return t >= 0; }));
    for (uint32_t level = 1; level <= oracle.levels; ++level) {
        std::map<uint32_t, uint32_t> there, back;
        for (size_t i = 0; i < holders.size(); ++i) {
            if (holders[i] < 0) continue;
            const uint32_t own =
                components.at(level, components.leaf[static_cast<size_t>(holders[i])]);
            const uint32_t wanted = oracle.components[level - 1][oracle.samples[i].cell];
            if (there.try_emplace(own, wanted).first->second != wanted)
                return "places together that lines keep apart";
            if (back.try_emplace(wanted, own).first->second != own)
                return "places apart that no line keeps apart";
        }
    }
    return "";
}

}  // namespace sherd::test
