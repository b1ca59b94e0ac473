// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

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
    std::vector<uint32_t> triangleMaterials;         ///< into materials
    std::vector<int32_t> materials;                  ///< glTF material index, -1: default material
    std::vector<std::array<uint32_t, 3>> corners;  ///< per triangle: into the attributes' vertices
    std::vector<Attribute> attributes;  ///< NORMAL always present (flat if the file has none)
    std::string uvSemantic;             ///< the UV set lines are drawn in; "" if the mesh has none
    std::vector<std::string> warnings;  ///< what the importer mended or dropped, a sentence each
};

/// The attribute of that name, or null.
const Attribute* findAttribute(const std::vector<Attribute>& attributes,
                               const std::string& semantic);

}  // namespace sherd
