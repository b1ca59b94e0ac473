// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sherd {

/// A run of `count` items starting at `first`.
struct Range {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// Where the object stands at rest in its scene. Fragment coordinates are relative to it.
struct RigidPose {
    glm::vec3 translation{0.0F};                 ///< metres
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit quaternion (w, x, y, z)
};

/// One float vertex attribute, named as in glTF: "NORMAL", "TANGENT", "TEXCOORD_0", "COLOR_0",
/// "_HEAT". NORMAL has 3 components, TANGENT 4, TEXCOORD_n 2, COLOR_n 4; custom ones 1 to 4.
struct Attribute {
    std::string semantic;
    uint32_t components = 0;
    std::vector<float> values;  ///< `components` floats per vertex
};

/// Triangles of one material that become visible at one level.
/// exposedFrom 0: the outer surface. k >= 1: hidden until the object is broken to level k.
struct Primitive {
    uint32_t material = 0;     ///< index into FractureSet::materials
    uint32_t exposedFrom = 0;  ///< level
    Range indices;             ///< into FractureGeometry::indices; both numbers are multiples of 3
    bool sheet = false;        ///< a piece of the medial surface, not a wall or a cut
};

/// One vertex and one index buffer for all fragments of all levels.
struct FractureGeometry {
    std::vector<glm::vec3>
        positions;  ///< metres, in the object's frame (FractureSet::restPose removed)
    std::vector<Attribute> attributes;
    std::vector<uint32_t> indices;  ///< triangles, counter-clockwise seen from outside
    std::vector<Primitive> primitives;
};

/// One closed piece, a node of the fracture hierarchy. SI units, object frame.
struct Fragment {
    int32_t parent = -1;   ///< -1 for the object itself (fragment 0)
    Range children;        ///< fragment indices; count 0: not divided further
    uint32_t level = 0;    ///< the level at which it first appears
    std::string name;      ///< may be empty
    std::string material;  ///< physical material, a word for the game ("oak"); may be empty
    float mass = 0;        ///< kg
    float volume = 0;      ///< m^3
    glm::vec3 centerOfMass{0.0F};
    glm::vec3 inertiaDiagonal{0.0F};                       ///< kg m^2, about the centre of mass
    glm::quat inertiaOrientation{1.0F, 0.0F, 0.0F, 0.0F};  ///< principal axes in the object frame
    Range hulls;                                           ///< into FractureSet::hulls
    float density = 1000;                                  ///< kg/m^3
    float friction = 0.5F;                                 ///< static and dynamic
    float restitution = 0.05F;
    float strength = 1e6F;  ///< Pa
    float toughness = 50;   ///< J/m^2
};

/// A convex collider: points already shrunk inwards by `margin`.
struct ConvexHull {
    Range points;      ///< into FractureSet::hullPoints
    float margin = 0;  ///< metres: the collision margin to set on the shape
};

/// The shared hidden area between two neighbouring leaves.
struct Bond {
    int32_t a = -1;  ///< fragment index of a leaf
    int32_t b = -1;  ///< fragment index of a leaf, or -1: anchored to the world
    float area = 0;  ///< m^2
    glm::vec3 centroid{0.0F};
    glm::vec3 normal{0.0F, 1.0F, 0.0F};  ///< unit, from a to b
    float strength = 1e6F;               ///< Pa
    float toughness = 50;                ///< J/m^2
};

/// The fragments that first appear at one level: a run of indices.
/// Drawing "level k" shows these plus every undivided fragment of a shallower level.
struct FractureLevel {
    Range fragments;
    std::string name;
};

/// Everything baked for one object: fragments of all levels, meshes, colliders, bonds, masses.
///
/// Invariants (`validate.h` proves them): fragment 0 is the object; fragments are ordered level by
/// level and each one's children are contiguous; every fragment owns one contiguous range of each
/// primitive, and a parent's ranges are the concatenation of its children's in primitives exposed
/// no later than the parent's own level.
struct FractureSet {
    std::string name;
    int32_t node = -1;  ///< glTF node that carries the intact mesh; restPose is its pose
    /// Further nodes, above `node`, that show the same mesh at the same scale; each stands in its
    /// own rigid pose.
    std::vector<int32_t> sameNodes;
    /// Further nodes whose meshes are part of the intact object: to be hidden with it. An object of
    /// several nodes has no sameNodes.
    std::vector<int32_t> joinedNodes;
    int32_t mesh = -1;       ///< glTF mesh of the intact object
    std::string sourceHash;  ///< hash of the source mesh, to notice a stale set
    RigidPose restPose;
    std::vector<int32_t> materials;  ///< glTF material index each, -1: the default material
    std::vector<FractureLevel> levels;
    std::vector<Fragment> fragments;
    /// fragmentRanges[f * primitives.size() + p]: the indices fragment f owns in primitive p.
    /// Absolute into FractureGeometry::indices. A fragment shows those with exposedFrom <= its
    /// level.
    std::vector<Range> fragmentRanges;
    std::vector<ConvexHull> hulls;
    std::vector<glm::vec3> hullPoints;
    std::vector<Bond> bonds;
    FractureGeometry geometry;
};

/// The triangles (three vertex indices each) that fragment f shows when it is a body of its own.
std::vector<std::array<uint32_t, 3>> fragmentTriangles(const FractureSet& set, uint32_t fragment);

/// The fragments that make up the object at `level`: its own and undivided shallower ones,
/// ascending.
std::vector<uint32_t> fragmentsAtLevel(const FractureSet& set, uint32_t level);

}  // namespace sherd
