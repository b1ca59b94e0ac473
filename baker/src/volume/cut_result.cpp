// SPDX-License-Identifier: MIT
#include "volume/cut_result.h"

#include <glm/common.hpp>
#include <utility>

#include "geometry/closed_mesh.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

}  // namespace

Result<void> checkCuttable(std::span<const glm::vec3> positions,
                           std::span<const Triangle> triangles) {
    if (triangles.empty()) return fail(ErrorCode::noTriangles, "there is nothing to cut");
    if (!edgesCancel(triangles)) {
        return fail(ErrorCode::openMesh, "only closed meshes can be cut: there are open edges");
    }
    if (!(signedVolume(positions, triangles, positions[triangles[0][0]]) > 0)) {
        return fail(ErrorCode::invalidData,
                    "the mesh encloses no volume, or its triangles face inwards");
    }
    return {};
}

std::vector<CutGridPoint> snapped(const CutGrid& grid, std::span<const glm::vec3> positions,
                                  std::span<const Triangle> triangles) {
    std::vector<CutGridPoint> points(positions.size());
    for (const Triangle& t : triangles)
        for (const uint32_t v : t) points[v] = grid.snap(positions[v]);
    return points;
}

void CutResult::uniteIfSame(uint32_t a, uint32_t b) {
    const glm::dvec3 d = glm::abs(vertices_.gridPosition(a) - vertices_.gridPosition(b));
    if (d.x > 0x1p-20 || d.y > 0x1p-20 || d.z > 0x1p-20) return;
    if (merged_.find(a) != merged_.find(b) && vertices_.exactPlace(a) == vertices_.exactPlace(b))
        merged_.unite(a, b);
}

void CutResult::addCap(CapBuilder& builder, uint32_t low, uint32_t high,
                       std::span<const CapEdge> border) {
    const auto first = static_cast<uint32_t>(cut_.capTriangles.size());
    builder.build(low, high, border, cut_.capTriangles);
    const auto count = static_cast<uint32_t>(cut_.capTriangles.size()) - first;
    if (count > 0) cut_.caps.push_back({low, high, first, count});
}

void CutResult::takeReport(const CapBuilder& builder) {
    cut_.report.crossedCaps = builder.report().crossed;
    cut_.report.fans = builder.report().fans;
}

MeshCut CutResult::finish(uint32_t cells, std::span<const Triangle> triangles) {
    sortSkin(cells);
    replaceUnited(triangles);
    return std::move(cut_);
}

void CutResult::sortSkin(uint32_t cells) {
    cut_.skinStart.assign(size_t{cells} + 1, 0);
    for (const uint32_t cell : cellOfSkin_) ++cut_.skinStart[cell + 1];
    for (size_t c = 1; c < cut_.skinStart.size(); ++c) cut_.skinStart[c] += cut_.skinStart[c - 1];
    std::vector<uint32_t> next(cut_.skinStart.begin(), cut_.skinStart.end() - 1);
    cut_.skin.resize(skin_.size());
    for (size_t s = 0; s < skin_.size(); ++s) cut_.skin[next[cellOfSkin_[s]]++] = skin_[s];
}

/// United vertices get one number; triangles that lose their area by it stay, for they are
/// somebody's skin, and are dropped when pieces are put together.
void CutResult::replaceUnited(std::span<const Triangle> triangles) {
    grow();
    cut_.positions.resize(vertices_.count());
    for (uint32_t v = 0; v < vertices_.count(); ++v) {
        cut_.positions[v] = vertices_.position(v);
        cut_.report.united += merged_.find(v) != v ? 1 : 0;
    }
    if (cut_.report.united == 0) return;
    for (MeshCut::SkinTriangle& t : cut_.skin)
        for (uint32_t& v : t.v) v = merged_.find(v);
    for (CapTriangle& t : cut_.capTriangles)
        for (uint32_t& v : t.v) v = merged_.find(v);
    UnionFind parts(vertices_.count());
    for (const Triangle& t : triangles) {
        parts.unite(t[0], t[1]);
        parts.unite(t[0], t[2]);
    }
    for (const Triangle& t : triangles) cut_.parts.push_back(parts.find(t[0]));
}

}  // namespace sherd
