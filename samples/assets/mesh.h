// SPDX-License-Identifier: MIT
// The modelled surface: welded positions, per-corner UV and normals.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd::samples {

struct Corner {
    uint32_t position = 0;  ///< into Mesh::positions
    glm::vec2 uv{0.0F};     ///< v down
    glm::vec3 normal{0.0F};
};

using Triangle = std::array<Corner, 3>;

/// Metres, y up, counter-clockwise seen from outside. Each place is one position, so corners on
/// the two sides of a UV seam share it bit for bit.
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
};

/// Corner k's edge runs to corner (k + 1) % 3. True where the triangle on the other side of the
/// edge places it elsewhere in UV.
using EdgeFlags = std::vector<std::array<bool, 3>>;
EdgeFlags findSeams(const Mesh& mesh);

/// Every edge is used once in each direction, and no triangle is degenerate.
bool isClosedManifold(const Mesh& mesh);

/// Positive when the triangles face outwards.
double signedVolume(const Mesh& mesh);

/// Angle-weighted normals, smoothed over neighbours whose faces differ by less than the crease
/// angle.
void computeNormals(Mesh& mesh, double creaseDegrees);

}  // namespace sherd::samples
