// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/baker/fracture_map.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// What a texture does outside [0, 1] along one axis, as in glTF.
enum class Wrap : uint8_t { repeat, mirror, clamp };

/// How the texture of a material lies in the UV set lines are drawn in: a point uv of the mesh
/// shows the texture at transform * (u, v, 1) (KHR_texture_transform), wrapped.
struct TexturePlacement {
    glm::dmat3 transform{1.0};  ///< column-major as in glm; the last row is 0 0 1
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    friend bool operator==(const TexturePlacement&, const TexturePlacement&) = default;
};

/// The object to break: welded positions (topology) and per-corner attributes.
///
/// Corner c = 3 * triangle + k. Two corners of one position may use different attribute vertices:
/// that is a seam. Every attribute has the same vertex count.
struct SurfaceMesh {
    std::string name;
    int32_t node = -1;  ///< glTF node, -1 when not from glTF
    int32_t mesh = -1;  ///< glTF mesh
    RigidPose
        restPose;  ///< rigid part of the node's global transform; scale is applied to positions
    std::vector<glm::vec3> positions;                ///< distinct (bit-equal ones welded), finite
    std::vector<std::array<uint32_t, 3>> triangles;  ///< into positions; degenerate ones are kept
    uint32_t capTriangles = 0;  ///< so many of the last triangles close holes of the file's mesh:
                                ///< they are hidden until the object breaks
    std::vector<uint32_t> triangleMaterials;       ///< into materials
    std::vector<int32_t> materials;                ///< glTF material index, -1: default material
    std::vector<TexturePlacement> placements;      ///< per material; empty: plain
    std::vector<std::array<uint32_t, 3>> corners;  ///< per triangle: into the attributes' vertices
    std::vector<Attribute> attributes;  ///< NORMAL always present (flat if the file has none)
    std::string uvSemantic;             ///< the UV set lines are drawn in; "" if the mesh has none
    /// Lines modelled on the object (LINES primitives of it and its child nodes, OBJ `l`), places
    /// in scene coordinates. A level that no name says is 1.
    std::vector<FractureMap::SurfaceLine> lines;
    std::vector<int32_t> sameNodes;  ///< other glTF nodes that show the very same mesh, same scale
    std::vector<int32_t> joinedNodes;   ///< other glTF nodes whose meshes are part of this object
    std::vector<std::string> warnings;  ///< what the importer mended or dropped, a sentence each

    bool isCap(uint32_t triangle) const { return triangle + capTriangles >= triangles.size(); }
};

/// A scene position in the frame of an object that rests so.
glm::dvec3 toObjectFrame(const RigidPose& restPose, const glm::dvec3& scene);

/// The attribute of that name, or null.
const Attribute* findAttribute(const std::vector<Attribute>& attributes,
                               const std::string& semantic);

}  // namespace sherd
