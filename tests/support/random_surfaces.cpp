// SPDX-License-Identifier: MIT
#include "support/random_surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <map>
#include <set>

namespace sherd::test {

namespace {

/// Positions and triangles; equal positions are one vertex.
class Shape {
  public:
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, bool otherDiagonal) {
        if (otherDiagonal) {
            triangle(b, c, d);
            triangle(b, d, a);
        } else {
            triangle(a, b, c);
            triangle(a, c, d);
        }
    }
    void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const std::array<uint32_t, 3> v{vertex(a), vertex(b), vertex(c)};
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) triangles.push_back(v);
    }
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

  private:
    uint32_t vertex(glm::vec3 p) {
        const auto [it, isNew] = ids_.try_emplace({p.x, p.y, p.z}, positions.size());
        if (isNew) positions.push_back(p);
        return it->second;
    }
    std::map<std::array<float, 3>, uint32_t> ids_;
};

/// The surface of the unit cells of a block that `solid` holds.
template <class Solid>
Shape blocks(Random& random, std::array<int, 3> size, Solid&& solid) {
    Shape shape;
    const auto full = [&](std::array<int, 3> c) {
        for (size_t i = 0; i < 3; ++i) {
            if (c[i] < 0 || c[i] >= size[i]) return false;
        }
        return static_cast<bool>(solid(c[0], c[1], c[2]));
    };
    for (int x = 0; x < size[0]; ++x) {
        for (int y = 0; y < size[1]; ++y) {
            for (int z = 0; z < size[2]; ++z) {
                if (!full({x, y, z})) continue;
                for (int face = 0; face < 6; ++face) {
                    const int axis = face / 2;
                    const int out = face % 2;
                    std::array<int, 3> beside{x, y, z};
                    beside[static_cast<size_t>(axis)] += out == 1 ? 1 : -1;
                    if (full(beside)) continue;
                    const auto corner = [&](int s, int t) {
                        glm::vec3 p(x, y, z);
                        p[axis] += static_cast<float>(out);
                        p[(axis + 1) % 3] += static_cast<float>(s);
                        p[(axis + 2) % 3] += static_cast<float>(t);
                        return p;
                    };
                    const bool other = random.oneIn(2);
                    if (out == 1)
                        shape.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1), other);
                    else
                        shape.quad(corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0), other);
                }
            }
        }
    }
    return shape;
}

Shape torusOrSphere(Random& random, int n, bool isTorus) {
    Shape shape;
    const int around = std::max(3, n), along = std::max(3, n);
    const auto at = [&](int i, int j) {
        const double a = 2 * M_PI * (i % around) / around;
        if (isTorus) {
            const double b = 2 * M_PI * (j % along) / along;
            const double r = 2 + std::cos(b);
            return glm::vec3(r * std::cos(a), r * std::sin(a), std::sin(b));
        }
        if (j == 0 || j == along) return glm::vec3(0, 0, j == 0 ? -1 : 1);
        const double b = M_PI * j / along;
        return glm::vec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j)
            shape.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), random.oneIn(2));
    }
    return shape;
}

Shape sheet(Random& random, int n) {
    Shape shape;
    const auto at = [](int x, int y) { return glm::vec3(x, y, 0); };
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            if (random.oneIn(8)) continue;
            shape.quad(at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1), random.oneIn(2));
        }
    }
    if (shape.triangles.empty()) shape.quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1), false);
    return shape;
}

Shape randomShape(Random& random, const SurfaceChoice& choice) {
    const int n = 1 + static_cast<int>(random.below(choice.cells));
    const auto all = [](int, int, int) { return true; };
    if (choice.nonManifold && random.oneIn(2)) {
        std::set<std::array<int, 3>> cells;
        for (int i = 0; i < 2 * n; ++i)
            cells.insert({static_cast<int>(random.below(3)), static_cast<int>(random.below(3)),
                          static_cast<int>(random.below(2))});
        Shape shape = blocks(random, {3, 3, 2}, [&](int x, int y, int z) {
            return cells.contains({x, y, z});
        });
        for (uint32_t i = random.below(3); i > 0; --i)  // fins
            shape.triangle(shape.positions[0], shape.positions[1],
                           glm::vec3(0.3F, 0.4F, 5.0F + static_cast<float>(i)));
        return shape;
    }
    switch (random.below(choice.open ? 6 : 5)) {
        case 0:
            return blocks(random, {n, 1 + static_cast<int>(random.below(choice.cells)), 1}, all);
        case 1:
            return torusOrSphere(random, n + 2, true);
        case 2:
            return torusOrSphere(random, n + 2, false);
        case 3:  // a plate with holes
            return blocks(random, {2 * std::min(n, 3) + 1, 3, 1},
                          [](int x, int y, int) { return x % 2 == 0 || y != 1; });
        case 4: {  // tori glued into each other: a cage
            return blocks(random, {3, 3, 3}, [](int x, int y, int z) {
                return (x == 1 ? 1 : 0) + (y == 1 ? 1 : 0) + (z == 1 ? 1 : 0) <= 1;
            });
        }
        default:
            return sheet(random, n + 1);
    }
}

/// Moves vertices about, some of them almost or exactly onto an edge beside them.
void deform(Random& random, Shape& shape, const SurfaceChoice& choice) {
    std::set<std::array<float, 3>> taken;
    for (const glm::vec3& p : shape.positions) taken.insert({p.x, p.y, p.z});
    const auto moveTo = [&](uint32_t v, glm::vec3 p) {
        if (taken.insert({p.x, p.y, p.z}).second) shape.positions[v] = p;
    };
    if (random.oneIn(2)) {
        const double far = random.oneIn(2) ? 0.2 : 1e-3;
        for (uint32_t v = 0; v < shape.positions.size(); ++v)
            moveTo(v, shape.positions[v] + glm::vec3(random.in(-far, far), random.in(-far, far),
                                                     random.in(-far, far)));
    }
    if (!choice.spoilt) return;
    for (uint32_t i = random.below(3); i > 0; --i) {
        const auto& t =
            shape.triangles[random.below(static_cast<uint32_t>(shape.triangles.size()))];
        const glm::vec3 a = shape.positions[t[0]];
        const glm::vec3 b = shape.positions[t[1]];
        const float share = random.oneIn(2) ? 0.5F : 1e-6F;
        moveTo(t[2], a + (b - a) * share);
    }
}

/// Parts of the surface, each with a UV of its own.
std::vector<uint32_t> randomCharts(Random& random, const Shape& shape, uint32_t& count) {
    const auto n = static_cast<uint32_t>(shape.triangles.size());
    count = random.oneIn(6) ? n : 1 + random.below(6);
    std::vector<uint32_t> chart(n, count);
    if (count == n) {
        for (uint32_t t = 0; t < n; ++t) chart[t] = t;
        return chart;
    }
    for (uint32_t c = 0; c < count; ++c) chart[random.below(n)] = c;
    // Triangles take the chart of a neighbour (one that shares two vertices) until all have one.
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> atEdge;
    for (uint32_t t = 0; t < n; ++t) {
        for (size_t k = 0; k < 3; ++k)
            atEdge[std::minmax(shape.triangles[t][k], shape.triangles[t][(k + 1) % 3])].push_back(
                t);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [edge, users] : atEdge) {
            for (const uint32_t t : users) {
                if (chart[t] != count) continue;
                const uint32_t other = users[random.below(static_cast<uint32_t>(users.size()))];
                if (chart[other] == count) continue;
                chart[t] = chart[other];
                changed = true;
            }
        }
        if (!changed) {
            const auto left = std::find(chart.begin(), chart.end(), count);
            if (left == chart.end()) break;
            // A component without a seed, or bad luck: begin again somewhere.
            *left = 0;
            changed = true;
        }
    }
    return chart;
}

/// How a chart looks at the object.
struct ChartView {
    enum class Kind : uint8_t { plane, line, point, scatter } kind = Kind::plane;
    int axis = 0;
    double angle = 0, size = 1, mirror = 1;
    glm::dvec2 at{0};
    double grain = 1;

    glm::dvec2 uv(const glm::vec3& p, Random& random) const {
        glm::dvec2 q(p[axis], p[(axis + 1) % 3]);
        if (kind == Kind::point) q = {0.3, 0.4};
        if (kind == Kind::line) q.y = 0.5 * q.x;
        if (kind == Kind::scatter) q = {random.unit(), random.unit()};
        q = glm::dvec2(q.x * mirror * std::cos(angle) - q.y * std::sin(angle),
                       q.x * mirror * std::sin(angle) + q.y * std::cos(angle)) *
                size +
            at;
        return {std::round(q.x * grain) / grain, std::round(q.y * grain) / grain};
    }
};

ChartView randomView(Random& random, double extent) {
    ChartView view;
    const uint32_t kind = random.below(10);
    if (kind == 0) view.kind = ChartView::Kind::point;
    if (kind == 1) view.kind = ChartView::Kind::line;
    if (kind == 2) view.kind = ChartView::Kind::scatter;
    view.axis = static_cast<int>(random.below(3));
    view.angle = random.oneIn(2) ? M_PI / 2 * random.below(4) : random.in(0, 2 * M_PI);
    view.mirror = random.oneIn(2) ? 1 : -1;
    view.size = random.oneIn(3) ? random.in(0.05, 1) / extent : 1.0 / 8;
    view.at = random.oneIn(2) ? glm::dvec2(0.5, 0.5)
                              : glm::dvec2(random.in(0.2, 0.8), random.in(0.2, 0.8));
    view.grain = std::exp2(random.oneIn(2) ? 3 + random.below(6) : 24);
    return view;
}

SurfaceMesh withAtlas(Random& random, const Shape& shape) {
    SurfaceMesh mesh;
    mesh.name = "random";
    mesh.positions = shape.positions;
    mesh.materials = {-1};
    mesh.uvSemantic = "TEXCOORD_0";
    Attribute uv{"TEXCOORD_0", 2, {}};
    uint32_t count = 0;
    const std::vector<uint32_t> chart = randomCharts(random, shape, count);
    double extent = 1;
    for (const glm::vec3& p : shape.positions)
        extent =
            std::max({extent, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    std::vector<ChartView> views;
    for (uint32_t c = 0; c <= count; ++c) views.push_back(randomView(random, extent));
    if (random.oneIn(3)) {  // charts over each other
        for (uint32_t c = 1; c <= count; c += 2) views[c] = views[0];
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> cornerOf;  // one per chart and vertex
    for (uint32_t t = 0; t < shape.triangles.size(); ++t) {
        std::array<uint32_t, 3> corners{};
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = shape.triangles[t][k];
            const auto next = static_cast<uint32_t>(uv.values.size() / 2);
            const auto [it, isNew] = cornerOf.try_emplace({chart[t], v}, next);
            if (isNew) {
                const glm::dvec2 p = views[chart[t]].uv(shape.positions[v], random);
                uv.values.insert(uv.values.end(),
                                 {static_cast<float>(p.x), static_cast<float>(p.y)});
            }
            corners[k] = it->second;
        }
        mesh.triangles.push_back(shape.triangles[t]);
        mesh.corners.push_back(corners);
        mesh.triangleMaterials.push_back(0);
    }
    mesh.attributes = {uv};
    return mesh;
}

/// A place a careful artist hits, or a careless one.
glm::dvec2 randomPlace(Random& random, const SurfaceMesh& mesh) {
    const auto& uv = mesh.attributes[0].values;
    const auto triangle = random.below(static_cast<uint32_t>(mesh.corners.size()));
    const auto corner = [&](size_t k) {
        const size_t c = mesh.corners[triangle][k];
        return glm::dvec2(uv[2 * c], uv[2 * c + 1]);
    };
    const uint32_t kind = random.below(20);
    if (kind < 7) return corner(random.below(3));
    if (kind < 8) {  // a near miss
        const auto unit = [&] { return (1.0 - random.below(3)) * 0x1p-24; };
        return corner(random.below(3)) + glm::dvec2(unit(), unit());
    }
    if (kind < 11) return (corner(0) + corner(1)) * 0.5;
    if (kind < 13) return corner(0) + (corner(1) - corner(0)) * (random.oneIn(2) ? 1.5 : -0.5);
    if (kind < 15) return (corner(0) + corner(1) + corner(2)) / 3.0;
    if (kind < 17) return {random.below(17) / 16.0, random.below(17) / 16.0};
    return {random.in(-0.1, 1.1), random.in(-0.1, 1.1)};
}

FractureMap::Line randomLine(Random& random, const SurfaceMesh& mesh) {
    FractureMap::Line line;
    const uint32_t points = 2 + random.below(random.oneIn(3) ? 5 : 1);
    for (uint32_t p = 0; p < points; ++p) line.points.push_back(randomPlace(random, mesh));
    if (random.oneIn(3)) line.points.push_back(line.points[0]);
    if (random.oneIn(20)) line.points = {line.points[0], line.points[0]};
    return line;
}

}  // namespace

SurfaceMesh randomSurface(Random& random, const SurfaceChoice& choice) {
    Shape shape = randomShape(random, choice);
    deform(random, shape, choice);
    SurfaceMesh mesh = withAtlas(random, shape);
    if (choice.spoilt && random.oneIn(6)) {
        const uint32_t t = random.below(static_cast<uint32_t>(mesh.triangles.size()));
        const auto& v = mesh.triangles[t];
        mesh.triangles.push_back({v[0], v[1], v[1]});
        mesh.corners.push_back(mesh.corners[t]);
        mesh.triangleMaterials.push_back(0);
    }
    for (glm::vec3& p : mesh.positions) p *= static_cast<float>(choice.scale);
    return mesh;
}

FractureMap randomMap(Random& random, const SurfaceMesh& mesh, uint32_t lines) {
    FractureMap map;
    const uint32_t levels = 1 + random.below(3);
    for (uint32_t i = 1 + random.below(lines); i > 0; --i) {
        FractureMap::Line line = randomLine(random, mesh);
        line.level = 1 + random.below(levels);
        line.source = "random";
        const uint32_t copies = random.oneIn(6) ? 1 + random.below(3) : 0;
        for (uint32_t c = 1; c <= copies; ++c) {  // nested, or the same again
            FractureMap::Line copy = line;
            copy.level = 1 + random.below(levels);
            const double size = random.oneIn(3) ? 1 : 1.0 / (c + 1);
            for (glm::dvec2& p : copy.points) p = line.points[0] + (p - line.points[0]) * size;
            if (random.oneIn(2)) std::reverse(copy.points.begin(), copy.points.end());
            map.lines.push_back(std::move(copy));
        }
        map.lines.push_back(std::move(line));
    }
    return map;
}

}  // namespace sherd::test
