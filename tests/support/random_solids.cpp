// SPDX-License-Identifier: MIT
#include "support/random_solids.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>
#include <utility>

namespace sherd::test {
namespace {

/// Quads over vertices that are named by three integers.
class Builder {
  public:
    using Name = std::array<int, 3>;

    uint32_t vertex(const Name& name, const glm::vec3& position) {
        const auto [it, isNew] =
            ids_.try_emplace(name, static_cast<uint32_t>(solid.positions.size()));
        if (isNew) solid.positions.push_back(position);
        return it->second;
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) solid.triangles.push_back({a, b, c});
    }
    void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
    Solid solid;

  private:
    std::map<Name, uint32_t> ids_;
};

float between(float a, float b, int k, int n) {
    return k == n ? b : a + (b - a) * (static_cast<float>(k) / static_cast<float>(n));
}

double quarter(double x) {
    return std::round(4 * x) / 4;
}

glm::vec3 randomPlace(Random& random, double reach, bool aligned) {
    glm::vec3 p;
    for (int k = 0; k < 3; ++k) {
        const double x = random.in(-reach, reach);
        p[k] = static_cast<float>(aligned ? quarter(x) : x);
    }
    return p;
}

Solid randomBox(Random& random, bool aligned) {
    const glm::vec3 low = randomPlace(random, 1, aligned);
    glm::vec3 size(0);
    for (int k = 0; k < 3; ++k)
        size[k] = static_cast<float>(aligned ? (1 + random.below(8)) / 4.0 : random.in(0.1, 2));
    return boxSolid(low, low + size, 1 + static_cast<int>(random.below(3)));
}

Solid randomPart(Random& random, bool aligned) {
    switch (random.below(4)) {
        case 0:
            return randomBox(random, aligned);
        case 1: {
            const glm::vec3 radii(static_cast<float>(random.in(0.3, 1)));
            return sphereSolid(randomPlace(random, 0.5, aligned), radii,
                               3 + static_cast<int>(random.below(8)),
                               2 + static_cast<int>(random.below(7)));
        }
        case 2: {
            Solid torus = torusSolid(1, static_cast<float>(random.in(0.2, 0.5)),
                                     3 + static_cast<int>(random.below(9)),
                                     3 + static_cast<int>(random.below(5)));
            const glm::vec3 place = randomPlace(random, 0.5, aligned);
            const int axis = static_cast<int>(random.below(3));
            torus.transform([&](const glm::vec3& p) {
                return place + glm::vec3(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
            });
            return torus;
        }
        default: {
            Solid block = blockSolid(
                random,
                {1 + static_cast<int>(random.below(3)), 1 + static_cast<int>(random.below(3)),
                 1 + static_cast<int>(random.below(3))},
                random.in(0.3, 1));
            block.transform([](const glm::vec3& p) { return p - glm::vec3(1); });
            return block;
        }
    }
}

/// A ball or box with another of the same kind hollowed out.
Solid hollow(Random& random) {
    const bool round = random.oneIn(2);
    Solid outer = round ? sphereSolid(glm::vec3(0), glm::vec3(1.5F), 8, 7)
                        : boxSolid(glm::vec3(-1), glm::vec3(1), 2);
    Solid inner = round ? sphereSolid(glm::vec3(0.25F, 0, 0), glm::vec3(0.5F), 6, 5)
                        : boxSolid(glm::vec3(-0.5F), glm::vec3(0.5F), 1);
    inner.turnInsideOut();
    outer.append(inner);
    outer.simple = true;
    return outer;
}

}  // namespace

void Solid::append(const Solid& other) {
    const auto base = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& t : other.triangles)
        triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    simple = false;
}

void Solid::turnInsideOut() {
    for (auto& t : triangles) std::swap(t[1], t[2]);
}

Solid boxSolid(const glm::vec3& low, const glm::vec3& high, int n) {
    Builder builder;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, far = face % 2;
        const auto corner = [&](int u, int v) {
            Builder::Name name{};
            name[static_cast<size_t>(axis)] = far == 1 ? n : 0;
            name[static_cast<size_t>((axis + 1) % 3)] = u;
            name[static_cast<size_t>((axis + 2) % 3)] = v;
            glm::vec3 p;
            for (int k = 0; k < 3; ++k)
                p[k] = between(low[k], high[k], name[static_cast<size_t>(k)], n);
            return builder.vertex(name, p);
        };
        for (int u = 0; u < n; ++u) {
            for (int v = 0; v < n; ++v) {
                const uint32_t a = corner(u, v), b = corner(u + 1, v), c = corner(u + 1, v + 1),
                               d = corner(u, v + 1);
                if (far == 1)
                    builder.quad(a, b, c, d);
                else
                    builder.quad(a, d, c, b);
            }
        }
    }
    return builder.solid;
}

Solid sphereSolid(const glm::vec3& centre, const glm::vec3& radii, int across, int along) {
    Builder builder;
    const auto corner = [&](int i, int j) {
        const double u = 2 * std::numbers::pi * (i % across) / across;
        const double v = std::numbers::pi * j / along;
        const glm::vec3 p(std::cos(u) * std::sin(v), std::sin(u) * std::sin(v), std::cos(v));
        const bool pole = j == 0 || j == along;
        return builder.vertex({pole ? 0 : i % across, j, 0}, centre + radii * p);
    };
    for (int i = 0; i < across; ++i) {
        for (int j = 0; j < along; ++j)
            builder.quad(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j));
    }
    return builder.solid;
}

Solid torusSolid(float major, float minor, int around, int across) {
    Builder builder;
    const auto corner = [&](int i, int j) {
        const double u = 2 * std::numbers::pi * (i % around) / around;
        const double v = 2 * std::numbers::pi * (j % across) / across;
        const double r = major + minor * std::cos(v);
        return builder.vertex({i % around, j % across, 0},
                              glm::vec3(r * std::cos(u), r * std::sin(u), minor * std::sin(v)));
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j)
            builder.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
    return builder.solid;
}

Solid blockSolid(Random& random, const std::array<int, 3>& size, double full) {
    std::vector<uint8_t> cubes(static_cast<size_t>(size[0]) * size[1] * size[2]);
    for (uint8_t& c : cubes) c = random.unit() < full ? 1 : 0;
    cubes[0] = 1;
    const auto isFull = [&](const Builder::Name& c) {
        for (size_t k = 0; k < 3; ++k)
            if (c[k] < 0 || c[k] >= size[k]) return false;
        return cubes[(static_cast<size_t>(c[2]) * size[1] + c[1]) * size[0] + c[0]] != 0;
    };
    Builder builder;
    for (int cube = 0; cube < static_cast<int>(cubes.size()); ++cube) {
        const Builder::Name at{cube % size[0], cube / size[0] % size[1],
                               cube / (size[0] * size[1])};
        if (!isFull(at)) continue;
        for (size_t face = 0; face < 6; ++face) {
            const size_t axis = face / 2;
            const bool far = face % 2 == 1;
            Builder::Name beside = at;
            beside[axis] += far ? 1 : -1;
            if (isFull(beside)) continue;
            const auto corner = [&](int u, int v) {
                Builder::Name name = at;
                name[axis] += far ? 1 : 0;
                name[(axis + 1) % 3] += u;
                name[(axis + 2) % 3] += v;
                return builder.vertex(name, glm::vec3(name[0], name[1], name[2]));
            };
            if (far)
                builder.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
            else
                builder.quad(corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0));
        }
    }
    builder.solid.simple = false;
    return builder.solid;
}

Solid randomSolid(Random& random) {
    const bool aligned = random.oneIn(2);
    if (random.oneIn(8)) return hollow(random);
    Solid solid = randomPart(random, aligned);
    for (uint32_t more = random.below(4); more > 1; --more) {
        const Solid other = randomPart(random, aligned);
        if (solid.triangles.size() + other.triangles.size() > 500) break;
        solid.append(other);
    }
    if (!aligned && random.oneIn(2)) {  // turned about a skew axis
        const double angle = random.in(0, 7);
        const double c = std::cos(angle), s = std::sin(angle);
        solid.transform([&](const glm::vec3& p) {
            const glm::dvec3 q(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
            return glm::vec3(q.x, c * q.y - s * q.z, s * q.y + c * q.z);
        });
    }
    return solid;
}

}  // namespace sherd::test
