// SPDX-License-Identifier: MIT
#include "assembly/hidden_vertices.h"

namespace sherd {

HiddenVertices::HiddenVertices(const HiddenLooks& looks, std::string depthAttribute,
                               FractureGeometry& out)
    : looks_(looks),
      depthAttribute_(std::move(depthAttribute)),
      out_(out),
      made_(looks.vertices.size(), kNone) {}

std::array<uint32_t, 3> HiddenVertices::vertices(uint32_t face) {
    std::array<uint32_t, 3> result{};
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t vertex = looks_.ofCorner[3 * face + k];
        uint32_t& made = made_[vertex];
        if (made == kNone) made = newVertex(looks_.vertices[vertex]);
        result[k] = made;
    }
    return result;
}

uint32_t HiddenVertices::newVertex(const HiddenLooks::Vertex& vertex) {
    for (Attribute& attribute : out_.attributes) {
        std::vector<float>& values = attribute.values;
        if (attribute.semantic == "NORMAL") {
            const glm::vec3& n = vertex.normal;
            values.insert(values.end(), {n.x, n.y, n.z});
        } else if (attribute.semantic == "TANGENT") {
            const glm::vec3& t = vertex.tangent;
            values.insert(values.end(), {t.x, t.y, t.z, 1.0F});
        } else if (attribute.semantic.starts_with("TEXCOORD_")) {
            values.insert(values.end(), {vertex.uv.x, vertex.uv.y});
        } else {
            const bool color = attribute.semantic.starts_with("COLOR_");
            const bool depth = attribute.semantic == depthAttribute_;
            const float value = depth ? looks_.depths[vertex.position] : (color ? 1.0F : 0.0F);
            values.insert(values.end(), attribute.components, value);
            if (color && attribute.components == 4) values.back() = 1;  // opaque
        }
    }
    out_.positions.push_back(looks_.mesh.positions[vertex.position]);
    return static_cast<uint32_t>(out_.positions.size() - 1);
}

}  // namespace sherd
