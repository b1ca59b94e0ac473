// SPDX-License-Identifier: MIT
// What cutting a mesh ends in, whatever the cells are: parts of its skin by cell, caps, and the
// vertices in one place made one.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/union_find.h"
#include "sherd/formats/result.h"
#include "volume/cap_space.h"
#include "volume/cut_grid.h"
#include "volume/face_caps.h"
#include "volume/mesh_cut.h"

namespace sherd {

/// Whether it has an inside: closed over vertex ids, facing outwards. Errors: noTriangles,
/// openMesh, invalidData.
Result<void> checkCuttable(std::span<const glm::vec3> positions,
                           std::span<const std::array<uint32_t, 3>> triangles);

/// Per position its place on the grid; what no triangle uses stays in the middle.
std::vector<CutGridPoint> snapped(const CutGrid& grid, std::span<const glm::vec3> positions,
                                  std::span<const std::array<uint32_t, 3>> triangles);

/// Filled while a mesh is cut; the vertices must outlive it.
class CutResult {
  public:
    explicit CutResult(const CapSpace& vertices) : vertices_(vertices), merged_(vertices.count()) {}

    void addSkin(uint32_t cell, const MeshCut::SkinTriangle& triangle) {
        skin_.push_back(triangle);
        cellOfSkin_.push_back(cell);
    }
    /// A part of the mesh's triangle `source`.
    void addPart(uint32_t cell, uint32_t source, const std::array<uint32_t, 3>& part,
                 const MeshCut::CornerWeights& weights) {
        addSkin(cell, {part, source, static_cast<uint32_t>(cut_.weights.size())});
        cut_.weights.push_back(weights);
    }

    /// After vertices were made, before any of them is united.
    void grow() { merged_.grow(vertices_.count()); }
    /// Where a tie was broken, edges may have no length: their ends become one vertex.
    void uniteIfSame(uint32_t a, uint32_t b);
    UnionFind& merged() { return merged_; }

    void addCap(CapBuilder& builder, uint32_t low, uint32_t high, std::span<const CapEdge> border);
    /// When all caps are made.
    void takeReport(const CapBuilder& builder);

    MeshCut finish(uint32_t cells, std::span<const std::array<uint32_t, 3>> triangles);

  private:
    void sortSkin(uint32_t cells);
    void replaceUnited(std::span<const std::array<uint32_t, 3>> triangles);

    const CapSpace& vertices_;
    UnionFind merged_;
    std::vector<MeshCut::SkinTriangle> skin_;
    std::vector<uint32_t> cellOfSkin_;
    MeshCut cut_;
};

}  // namespace sherd
