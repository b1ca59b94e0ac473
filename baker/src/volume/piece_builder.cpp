// SPDX-License-Identifier: MIT
#include "volume/piece_builder.h"

#include <algorithm>
#include <utility>

#include "geometry/no_index.h"
#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "volume/edge_pairing.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;
}  // namespace

PieceBuilder::PieceBuilder(const MeshCut& cut, std::vector<uint32_t> groupOf)
    : cut_(cut),
      groupOf_(std::move(groupOf)),
      capsOf_(cut.cells()),
      local_(cut.positions.size(), kNone) {
    for (uint32_t c = 0; c < cut.caps.size(); ++c) {
        const MeshCut::Cap& cap = cut.caps[c];
        if (groupOf_[cap.low] == groupOf_[cap.high]) continue;
        capsOf_[cap.low].push_back(c);
        capsOf_[cap.high].push_back(c);
    }
}

BuiltPiece PieceBuilder::build(const std::vector<uint32_t>& cells) {
    piece_ = {};
    sheets_.clear();
    for (const uint32_t cell : cells) {
        for (uint32_t s = cut_.skinStart[cell]; s < cut_.skinStart[cell + 1]; ++s)
            add(cut_.skin[s].v, {false, s}, sheetOf(cut_.skin[s]));
    }
    for (const uint32_t cell : cells)
        for (const uint32_t cap : capsOf_[cell]) addCap(cap, cell);
    for (const uint32_t v : piece_.mesh.vertices) local_[v] = kNone;
    EdgePairs pairs = pairEdges(
        {piece_.mesh.triangles, [&](uint32_t v) { return cut_.positions[piece_.mesh.vertices[v]]; },
         [&](uint32_t t) { return sheets_[t]; }});
    piece_.twins = std::move(pairs.twins);
    separateFans();
    findClashes(std::move(pairs.repeated));
    return std::move(piece_);
}

void PieceBuilder::addCap(uint32_t cap, uint32_t cell) {
    const MeshCut::Cap& c = cut_.caps[cap];
    for (uint32_t t = c.first; t < c.first + c.count; ++t) {
        const auto& [a, b, d] = cut_.capTriangles[t].v;
        const auto layer = static_cast<uint32_t>(cut_.capTriangles[t].layer);
        add(cell == c.low ? Triangle{a, b, d} : Triangle{d, b, a}, {true, t},
            layer == 0 ? 0 : uint64_t{cap} << 32 | layer);
    }
}

/// Parts of a triangle go together, then triangles of a part of the mesh. Layers of caps are
/// numbered from the other end.
uint64_t PieceBuilder::sheetOf(const MeshCut::SkinTriangle& t) const {
    if (cut_.parts.empty()) return 0;
    constexpr uint32_t kSkin = 0x40000000U;
    return uint64_t{t.source} << 32 | (kSkin + cut_.parts[t.source] % kSkin);
}

void PieceBuilder::add(const Triangle& t, PieceMesh::Origin origin, uint64_t sheet) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    Triangle v{};
    for (size_t k = 0; k < 3; ++k) {
        uint32_t& id = local_[t[k]];
        if (id == kNone) {
            id = static_cast<uint32_t>(piece_.mesh.vertices.size());
            piece_.mesh.vertices.push_back(t[k]);
        }
        v[k] = id;
    }
    piece_.mesh.triangles.push_back(v);
    piece_.mesh.origins.push_back(origin);
    sheets_.push_back(sheet);
}

/// Corners of a vertex that are joined over edges are a fan; each fan gets a vertex of its own.
void PieceBuilder::separateFans() {
    PieceMesh& mesh = piece_.mesh;
    UnionFind corners(piece_.twins.size());
    UnionFind triangles(mesh.triangles.size());
    for (uint32_t a = 0; a < piece_.twins.size(); ++a) {
        const uint32_t b = piece_.twins[a];
        if (b == EdgePairs::kNone) continue;
        corners.unite(a, nextCorner(b));
        triangles.unite(a / 3, b / 3);
    }
    std::vector<uint8_t> taken(mesh.vertices.size(), 0);  // the first fan keeps the vertex
    std::vector<uint32_t> vertexOfFan(piece_.twins.size(), kNone);
    for (uint32_t c = 0; c < vertexOfFan.size(); ++c) {
        uint32_t& ofFan = vertexOfFan[corners.find(c)];
        uint32_t& v = mesh.triangles[c / 3][c % 3];
        if (ofFan == kNone && taken[v] == 0) {
            taken[v] = 1;
            ofFan = v;
        } else if (ofFan == kNone) {
            ofFan = static_cast<uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(mesh.vertices[v]);
        }
        v = ofFan;
    }
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.lumps += triangles.find(t) == t ? 1 : 0;
}

void PieceBuilder::findClashes(std::vector<uint32_t> repeated) {
    const auto ends = [&](uint32_t h) {
        const Triangle& t = piece_.mesh.triangles[h / 3];
        return std::pair(t[h % 3], t[(h % 3 + 1) % 3]);
    };
    std::sort(repeated.begin(), repeated.end(), [&](uint32_t a, uint32_t b) {
        return std::pair(ends(a), a) < std::pair(ends(b), b);
    });
    for (size_t n = 1; n < repeated.size(); ++n)
        if (ends(repeated[n]) == ends(repeated[n - 1])) piece_.clashes.push_back(repeated[n]);
}

}  // namespace sherd
