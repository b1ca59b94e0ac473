// SPDX-License-Identifier: MIT
// A slab of dressed stone blocks in running bond, with sunk mortar joints.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>

#include "noise.h"
#include "sample_object.h"

namespace sherd::samples {
namespace {

constexpr double kWidth = 2.0;
constexpr double kHeight = 1.2;
constexpr double kDepth = 0.25;
constexpr double kCourse = 0.3;   ///< height of a row of blocks
constexpr double kBlock = 0.5;    ///< length of a block
constexpr double kJoint = 0.011;  ///< half the width of a mortar joint
constexpr double kBevel = 0.020;  ///< rounding of the slab's and the blocks' edges
constexpr double kSunk = 0.010;   ///< depth of the joints

/// Distance to the nearest mortar joint's middle, and which block the place is in.
struct BlockPlace {
    double toJoint = 0;
    int32_t course = 0;
    int32_t block = 0;
};

BlockPlace blockAt(double x, double y) {
    BlockPlace place;
    place.course = std::clamp(static_cast<int32_t>(std::floor(y / kCourse)), 0, 3);
    const double shift = place.course % 2 == 0 ? 0 : kBlock / 2;
    // A place on the slab's end belongs to the block it closes.
    const double inside = std::clamp(x, 1e-6 - kWidth / 2, kWidth / 2 - 1e-6);
    const double along = (inside + kWidth / 2 + shift) / kBlock;
    place.block = static_cast<int32_t>(std::floor(along));
    const double toUpright = std::abs(along - std::round(along)) * kBlock;
    const double row = y / kCourse;
    const double toBed = std::round(row) < 0.5 || std::round(row) > 3.5
                             ? 1.0
                             : std::abs(row - std::round(row)) * kCourse;
    const bool end = std::abs(x) > kWidth / 2 - kBlock / 8;
    place.toJoint = std::min(toBed, end ? 1.0 : toUpright);
    return place;
}

/// Grid lines: the shoulders and the middle of every joint, the bevels, and one more between.
std::vector<double> gridLines(double length, double spacing) {
    std::vector<double> lines{0, kBevel};
    const auto joints = static_cast<int32_t>(std::lround(length / spacing));
    for (int32_t i = 0; i < joints; ++i) {
        lines.push_back((i + 0.5) * spacing);
        if (i + 1 == joints) break;
        const double joint = (i + 1) * spacing;
        for (const double offset : {-kJoint - kBevel / 2, 0.0, kJoint + kBevel / 2}) {
            lines.push_back(joint + offset);
        }
    }
    lines.insert(lines.end(), {length - kBevel, length});
    return lines;
}

/// The surface points of an integer box, moved into place.
class Slab {
  public:
    Slab() {
        xs_ = gridLines(kWidth, kBlock / 2);
        ys_ = gridLines(kHeight, kCourse);
        zs_ = {0, kBevel, kDepth / 2, kDepth - kBevel, kDepth};
    }

    Mesh build() {
        const auto nx = static_cast<int32_t>(xs_.size()) - 1;
        const auto ny = static_cast<int32_t>(ys_.size()) - 1;
        const auto nz = static_cast<int32_t>(zs_.size()) - 1;
        using Index = std::array<int32_t, 3>;
        const auto face = [&](auto lattice, int32_t na, int32_t nb, const std::vector<double>& as,
                              const std::vector<double>& bs, glm::dvec2 uvLow, glm::dvec2 uvHigh) {
            const auto corner = [&](int32_t a, int32_t b) {
                const glm::dvec2 share(as[a] / as.back(), bs[b] / bs.back());
                return Corner{vertex(lattice(a, b)), glm::mix(uvLow, uvHigh, share), {}};
            };
            for (int32_t b = 0; b < nb; ++b) {
                for (int32_t a = 0; a < na; ++a) {
                    addQuad(
                        {corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)},
                        (a + b) % 2 == 0);
                }
            }
        };
        face(
            [&](int32_t a, int32_t b) {
                return Index{a, b, nz};
            },
            nx, ny, xs_, ys_, {0.01, 0.41}, {0.86, 0.01});
        face(
            [&](int32_t a, int32_t b) {
                return Index{nx - a, b, 0};
            },
            nx, ny, xs_, ys_, {0.01, 0.83}, {0.86, 0.43});
        face(
            [&](int32_t a, int32_t b) {
                return Index{a, ny, nz - b};
            },
            nx, nz, xs_, zs_, {0.01, 0.915}, {0.86, 0.85});
        face(
            [&](int32_t a, int32_t b) {
                return Index{a, 0, b};
            },
            nx, nz, xs_, zs_, {0.01, 0.995}, {0.86, 0.93});
        face(
            [&](int32_t a, int32_t b) {
                return Index{nx, b, nz - a};
            },
            nz, ny, zs_, ys_, {0.88, 0.41}, {0.99, 0.01});
        face(
            [&](int32_t a, int32_t b) {
                return Index{0, b, a};
            },
            nz, ny, zs_, ys_, {0.88, 0.83}, {0.99, 0.43});
        return std::move(mesh_);
    }

  private:
    /// Joints are sunk and their shoulders rounded; the stone's face is rough-hewn. The slab's own
    /// edges are bevelled: its outermost lines stay on the box, less the bevel where faces meet.
    glm::dvec3 place(const std::array<int32_t, 3>& i) const {
        const glm::dvec3 p(xs_[i[0]] - kWidth / 2, ys_[i[1]], zs_[i[2]] - kDepth / 2);
        const bool onX = i[0] == 0 || i[0] + 1 == static_cast<int32_t>(xs_.size());
        const bool onY = i[1] == 0 || i[1] + 1 == static_cast<int32_t>(ys_.size());
        const bool onZ = i[2] == 0 || i[2] + 1 == static_cast<int32_t>(zs_.size());
        const double faces = double(onX) + double(onY) + double(onZ);
        const double inset = faces > 1 ? kBevel * 0.45 : 0;
        const double sunk =
            kSunk * (1 - smoothStep(kJoint * 0.5, kJoint + kBevel / 2, blockAt(p.x, p.y).toJoint));
        const double rough = 0.007 * fractalNoise(p * 7.0, 3, 42);
        glm::dvec3 moved = p;
        const double side = onY ? 0 : sunk;
        if (onX) moved.x -= std::copysign(inset + side, p.x);
        if (onY && p.y > kHeight / 2) moved.y -= inset - rough * 0.5;
        if (onY && p.y < kHeight / 2) moved.y += inset;
        if (onZ) moved.z -= std::copysign(inset + sunk - rough, p.z);
        return moved;
    }

    uint32_t vertex(const std::array<int32_t, 3>& index) {
        const auto [found, added] =
            vertices_.emplace(index, static_cast<uint32_t>(mesh_.positions.size()));
        if (added) mesh_.positions.emplace_back(place(index));
        return found->second;
    }

    void addQuad(const std::array<Corner, 4>& q, bool rising) {
        if (rising) {
            mesh_.triangles.push_back({q[0], q[1], q[2]});
            mesh_.triangles.push_back({q[0], q[2], q[3]});
        } else {
            mesh_.triangles.push_back({q[0], q[1], q[3]});
            mesh_.triangles.push_back({q[1], q[2], q[3]});
        }
    }

    std::vector<double> xs_, ys_, zs_;
    std::map<std::array<int32_t, 3>, uint32_t> vertices_;
    Mesh mesh_;
};

glm::dvec3 paintStone(const glm::dvec3& p, const BlockPlace& place) {
    // Each block has its own tint and its own bedding direction.
    const double tint = hash01(place.course, place.block, 3, 17);
    const double warmth = hash01(place.course, place.block, 4, 17);
    const glm::dvec3 base =
        glm::mix(glm::dvec3(0.52, 0.50, 0.47), glm::dvec3(0.66, 0.60, 0.50), warmth) *
        (0.80 + 0.34 * tint);
    const glm::dvec3 own(p.x + 3.7 * place.block, p.y + 5.1 * place.course, p.z);
    const double bedding =
        fractalNoise({own.x * 3, own.y * 26 + 2 * fractalNoise(own * 4.0, 2, 9), own.z * 3}, 4, 6);
    const double blotch = fractalNoise(own * 5.0, 4, 7);
    const double grain = fractalNoise(p * 55.0, 3, 8);
    const double pit = smoothStep(0.30, 0.42, fractalNoise(p * 28.0, 3, 12));
    return base * (1 + 0.22 * bedding + 0.30 * blotch + 0.28 * grain) * (1 - 0.35 * pit);
}

glm::dvec3 paintWall(const SurfacePoint& point) {
    const glm::dvec3& p = point.position;
    // The joints' rims waver a little, as laid by hand.
    const glm::dvec3 waver = 0.006 * fractalNoise3(p * 22.0, 3, 33);
    const BlockPlace place = blockAt(p.x + waver.x, p.y + waver.y);
    const double grain = fractalNoise(p * 90.0, 3, 14);
    const glm::dvec3 mortar = glm::dvec3(0.60, 0.575, 0.53) * (1 + 0.35 * grain);
    const double joint = 1 - smoothStep(kJoint * 0.8, kJoint * 1.25, place.toJoint);
    glm::dvec3 color = glm::mix(paintStone(p, place), mortar, joint);
    // Dirt gathers along the joints, and moss creeps up from the ground.
    const double dirt = std::exp(-std::abs(place.toJoint - kJoint * 1.2) / 0.012);
    color *= 1 - 0.38 * dirt;
    const double damp = smoothStep(0.10, 0.75, fractalNoise(p * 6.0, 4, 61) + 0.62 - p.y * 1.7);
    color = glm::mix(color, glm::dvec3(0.27, 0.31, 0.17) * (1 + 0.5 * grain), 0.55 * damp);
    return color;
}

CrackPattern wallCracks(const Mesh& mesh) {
    CrackPattern pattern;
    pattern.options = {{1, 1, 0.8}, 0.15, 0.34, 6, 6, 1};
    pattern.level1 = {{{-0.72, 0.85, 0}, 0}, {{-0.70, 0.28, 0}, 0}, {{-0.12, 0.98, 0}, 0},
                      {{-0.10, 0.32, 0}, 0}, {{0.32, 0.66, 0}, 0},  {{0.78, 0.95, 0}, 0},
                      {{0.70, 0.26, 0}, 0}};
    pattern.level2 =
        scatterSites(mesh, pattern, {{3, 3, 4, 4, 5, 3, 3}, {0.1, 0.65, 0.0}, 0.125, 1});
    for (CrackSite& site : pattern.level2) site.position.z *= 0.2;
    return pattern;
}

}  // namespace

SampleObject makeWall() {
    SampleObject wall;
    wall.name = "wall";
    wall.mesh = Slab().build();
    computeNormals(wall.mesh, 32);
    wall.texture = paintTexture(wall.mesh, kSampleTexture, paintWall);
    wall.roughness = 0.95;
    wall.stuff = {{0.33, 0.30, 0.26}, 2300};
    wall.cracks = wallCracks(wall.mesh);
    return wall;
}

}  // namespace sherd::samples
