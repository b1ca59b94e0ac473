// SPDX-License-Identifier: MIT
// A box cut into a grid of boxes, level by level: the smallest honest fracture set.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/glb_write.h"
#include "sherd/formats/gltf_document.h"

namespace sherd::test {

struct FracturedCubeOptions {
    glm::vec3 size{1.0F};  ///< metres, centred on the origin of the object's frame
    /// splits[k]: how each box of level k is divided along x, y, z to give level k + 1.
    std::vector<std::array<uint32_t, 3>> splits = {{2, 1, 1}, {2, 2, 2}};
    float density = 1000;       ///< kg/m^3
    float strength = 1e6F;      ///< Pa
    float toughness = 50;       ///< J/m^2
    float margin = 0.001F;      ///< metres; hull points are shrunk by it
    bool anchorBottom = false;  ///< bonds of the lowest boxes to the world
    RigidPose restPose;
    std::string name = "cube";
};

/// Builds the fracture set. Corners lie on one integer grid, so shared positions are the same bits.
class FracturedCube {
  public:
    explicit FracturedCube(FracturedCubeOptions options) : options_(std::move(options)) {
        for (const auto& split : options_.splits)
            for (int axis = 0; axis < 3; ++axis) cells_[axis] *= split[axis];
    }

    FractureSet build() {
        set_ = {};
        set_.name = options_.name;
        set_.node = 0;
        set_.mesh = 0;
        set_.restPose = options_.restPose;
        set_.materials = {0, 1};
        boxes_ = {{{0, 0, 0}, cells_}};
        addFragment(-1, 0, boxes_[0]);
        set_.levels.push_back({{0, 1}, "intact"});
        for (uint32_t level = 1; level <= options_.splits.size(); ++level) divide(level);
        addGeometry();
        addBonds();
        return std::move(set_);
    }

  private:
    using Cell = std::array<uint32_t, 3>;
    struct Box {
        Cell low;
        Cell high;
    };

    glm::vec3 corner(const Cell& cell) const {
        glm::vec3 p;
        for (int a = 0; a < 3; ++a)
            p[a] = options_.size[a] *
                   (static_cast<float>(cell[a]) / static_cast<float>(cells_[a]) - 0.5F);
        return p;
    }

    void addFragment(int32_t parent, uint32_t level, const Box& box) {
        const glm::vec3 low = corner(box.low);
        const glm::vec3 high = corner(box.high);
        const glm::vec3 d = high - low;
        Fragment f;
        f.parent = parent;
        f.level = level;
        f.name = level == 0 ? options_.name : "";
        f.volume = d.x * d.y * d.z;
        f.mass = f.volume * options_.density;
        f.centerOfMass = 0.5F * (low + high);
        f.inertiaDiagonal =
            f.mass / 12.0F *
            glm::vec3(d.y * d.y + d.z * d.z, d.x * d.x + d.z * d.z, d.x * d.x + d.y * d.y);
        f.density = options_.density;
        f.strength = options_.strength;
        f.toughness = options_.toughness;
        f.hulls = {static_cast<uint32_t>(set_.hulls.size()), 1};
        set_.hulls.push_back({{static_cast<uint32_t>(set_.hullPoints.size()), 8}, options_.margin});
        for (int i = 0; i < 8; ++i) {
            glm::vec3 p;
            for (int a = 0; a < 3; ++a)
                p[a] = (i >> a & 1) != 0 ? high[a] - options_.margin : low[a] + options_.margin;
            set_.hullPoints.push_back(p);
        }
        set_.fragments.push_back(f);
    }

    void divide(uint32_t level) {
        const Range parents = set_.levels.back().fragments;
        const std::array<uint32_t, 3> split = options_.splits[level - 1];
        const auto first = static_cast<uint32_t>(set_.fragments.size());
        for (uint32_t p = parents.first; p < parents.first + parents.count; ++p) {
            const Box parent = boxes_[p];
            set_.fragments[p].children = {static_cast<uint32_t>(set_.fragments.size()),
                                          split[0] * split[1] * split[2]};
            for (uint32_t i = 0; i < split[0] * split[1] * split[2]; ++i) {
                const Cell at = {i % split[0], i / split[0] % split[1], i / (split[0] * split[1])};
                Box box = parent;
                for (int a = 0; a < 3; ++a) {
                    const uint32_t width = (parent.high[a] - parent.low[a]) / split[a];
                    box.low[a] = parent.low[a] + at[a] * width;
                    box.high[a] = box.low[a] + width;
                }
                boxes_.push_back(box);
                addFragment(static_cast<int32_t>(p), level, box);
            }
        }
        const auto count = static_cast<uint32_t>(set_.fragments.size()) - first;
        set_.levels.push_back({{first, count}, "level " + std::to_string(level)});
    }

    /// The fragment of `level` that holds a cell.
    uint32_t owner(const Cell& cell, uint32_t level) const {
        const Range range = set_.levels[level].fragments;
        for (uint32_t f = range.first; f < range.first + range.count; ++f) {
            bool inside = true;
            for (int a = 0; a < 3; ++a)
                inside = inside && cell[a] >= boxes_[f].low[a] && cell[a] < boxes_[f].high[a];
            if (inside) return f;
        }
        return 0;
    }

    /// The neighbour cell across one face; false at the outside.
    bool neighbour(const Cell& cell, int axis, bool up, Cell& out) const {
        out = cell;
        if (up ? cell[axis] + 1 == cells_[axis] : cell[axis] == 0) return false;
        out[axis] += up ? 1U : ~0U;
        return true;
    }

    uint32_t exposedFrom(const Cell& cell, int axis, bool up) const {
        Cell other;
        if (!neighbour(cell, axis, up, other)) return 0;
        for (uint32_t level = 1; level < set_.levels.size(); ++level)
            if (owner(cell, level) != owner(other, level)) return level;
        return 0;
    }

    void addFace(const Cell& low, int axis, bool up) {
        FractureGeometry& g = set_.geometry;
        const auto base = static_cast<uint32_t>(g.positions.size());
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int i = 0; i < 4; ++i) {
            Cell at = low;
            at[axis] += up ? 1 : 0;
            at[u] += i == 1 || i == 2 ? 1 : 0;
            at[v] += i >= 2 ? 1 : 0;
            g.positions.push_back(corner(at));
            for (int a = 0; a < 3; ++a)
                g.attributes[0].values.push_back(a == axis ? (up ? 1.0F : -1.0F) : 0.0F);
            g.attributes[1].values.push_back(static_cast<float>(at[u]) /
                                             static_cast<float>(cells_[u]));
            g.attributes[1].values.push_back(static_cast<float>(at[v]) /
                                             static_cast<float>(cells_[v]));
        }
        constexpr std::array<uint32_t, 6> kOut = {0, 1, 2, 0, 2, 3};
        constexpr std::array<uint32_t, 6> kIn = {0, 2, 1, 0, 3, 2};
        for (const uint32_t i : up ? kOut : kIn) g.indices.push_back(base + i);
    }

    void addGeometry() {
        FractureGeometry& g = set_.geometry;
        g.attributes = {{"NORMAL", 3, {}}, {"TEXCOORD_0", 2, {}}};
        const auto primitives = static_cast<uint32_t>(set_.levels.size());
        set_.fragmentRanges.resize(set_.fragments.size() * primitives);
        for (uint32_t p = 0; p < primitives; ++p) {
            const auto first = static_cast<uint32_t>(g.indices.size());
            const Range leaves = set_.levels.back().fragments;
            for (uint32_t f = leaves.first; f < leaves.first + leaves.count; ++f) {
                const auto begin = static_cast<uint32_t>(g.indices.size());
                for (int axis = 0; axis < 3; ++axis)
                    for (const bool up : {false, true})
                        if (exposedFrom(boxes_[f].low, axis, up) == p)
                            addFace(boxes_[f].low, axis, up);
                set_.fragmentRanges[f * primitives + p] = {
                    begin, static_cast<uint32_t>(g.indices.size()) - begin};
            }
            g.primitives.push_back(
                {p == 0 ? 0U : 1U, p, {first, static_cast<uint32_t>(g.indices.size()) - first}});
        }
        for (size_t f = set_.fragments.size(); f-- > 0;) {
            const Range children = set_.fragments[f].children;
            for (uint32_t p = 0; p < primitives && children.count > 0; ++p) {
                Range sum = set_.fragmentRanges[children.first * primitives + p];
                for (uint32_t c = 1; c < children.count; ++c)
                    sum.count += set_.fragmentRanges[(children.first + c) * primitives + p].count;
                set_.fragmentRanges[f * primitives + p] = sum;
            }
        }
    }

    Bond bond(uint32_t leaf, int32_t other, int axis, bool up) const {
        Bond result;
        const glm::vec3 low = corner(boxes_[leaf].low);
        const glm::vec3 high = corner(boxes_[leaf].high);
        result.a = static_cast<int32_t>(leaf);
        result.b = other;
        result.area = (high - low)[(axis + 1) % 3] * (high - low)[(axis + 2) % 3];
        result.centroid = 0.5F * (low + high);
        result.centroid[axis] = up ? high[axis] : low[axis];
        result.normal = glm::vec3(0.0F);
        result.normal[axis] = up ? 1.0F : -1.0F;
        result.strength = options_.strength;
        result.toughness = options_.toughness;
        return result;
    }

    void addBonds() {
        const auto last = static_cast<uint32_t>(set_.levels.size()) - 1;
        const Range leaves = set_.levels[last].fragments;
        for (uint32_t f = leaves.first; f < leaves.first + leaves.count; ++f) {
            for (int axis = 0; axis < 3; ++axis) {
                Cell other;
                if (last > 0 && neighbour(boxes_[f].low, axis, true, other))
                    set_.bonds.push_back(
                        bond(f, static_cast<int32_t>(owner(other, last)), axis, true));
            }
            if (options_.anchorBottom && boxes_[f].low[1] == 0)
                set_.bonds.push_back(bond(f, -1, 1, false));
        }
    }

    FracturedCubeOptions options_;
    Cell cells_{1, 1, 1};
    std::vector<Box> boxes_;
    FractureSet set_;
};

/// A box divided level by level. Every box has the size of a multiple of the leaves'.
inline FractureSet makeFracturedCube(const FracturedCubeOptions& options = {}) {
    return FracturedCube(options).build();
}

/// The intact object of a set as an ordinary glTF document: node 0 shows mesh 0, material 0.
inline GltfDocument makeIntactDocument(const FractureSet& set) {
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    glm::vec3 low = set.geometry.positions[0];
    glm::vec3 high = low;
    for (const auto& triangle : fragmentTriangles(set, 0)) {
        for (const uint32_t v : triangle) {
            const glm::vec3 p = set.geometry.positions[v];
            indices.push_back(static_cast<uint32_t>(positions.size() / 3));
            for (int a = 0; a < 3; ++a) {
                positions.push_back(p[a]);
                low[a] = std::min(low[a], p[a]);
                high[a] = std::max(high[a], p[a]);
            }
        }
    }
    GltfDocument document;
    const size_t positionBytes = 4 * positions.size();
    document.bin.resize(positionBytes + 4 * indices.size());
    std::memcpy(document.bin.data(), positions.data(), positionBytes);
    std::memcpy(document.bin.data() + positionBytes, indices.data(), 4 * indices.size());
    const auto vector = [](const glm::vec3& v) {
        char text[64];
        std::snprintf(text, sizeof text, "[%.9g,%.9g,%.9g]", double{v.x}, double{v.y}, double{v.z});
        return std::string(text);
    };
    const auto count = [](size_t n) { return std::to_string(n); };
    const glm::quat& q = set.restPose.rotation;
    char rotation[80];
    std::snprintf(rotation, sizeof rotation, "[%.9g,%.9g,%.9g,%.9g]", double{q.x}, double{q.y},
                  double{q.z}, double{q.w});
    document.json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
        R"("nodes":[{"name":"cube","mesh":0,"translation":)" +
        vector(set.restPose.translation) + R"(,"rotation":)" + rotation +
        R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
        R"("materials":[{"name":"outside","pbrMetallicRoughness":{"metallicFactor":0}}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
        count(positions.size() / 3) + R"(,"type":"VEC3","min":)" + vector(low) + R"(,"max":)" +
        vector(high) + R"(},{"bufferView":1,"componentType":5125,"count":)" +
        count(indices.size()) + R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" +
        count(positionBytes) + R"(,"target":34962},{"buffer":0,"byteOffset":)" +
        count(positionBytes) + R"(,"byteLength":)" + count(4 * indices.size()) +
        R"(,"target":34963}],"buffers":[{"byteLength":)" + count(document.bin.size()) + "}]}";
    return document;
}

/// The whole file: intact cube and fracture set. Empty on failure (a bug: tests REQUIRE it).
inline std::vector<uint8_t> makeBakedCube(const FracturedCubeOptions& options = {}) {
    const FractureSet set = makeFracturedCube(options);
    const NewMaterial inside{"inside", {0.8F, 0.7F, 0.6F, 1.0F}, 0.0F, 1.0F};
    auto glb = attachFractureSets(makeIntactDocument(set), {&set, 1}, {&inside, 1});
    return glb ? std::move(*glb) : std::vector<uint8_t>();
}

}  // namespace sherd::test
