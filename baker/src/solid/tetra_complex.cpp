// SPDX-License-Identifier: MIT
#include "solid/tetra_complex.h"

#include <numeric>

#include "geometry/triangle.h"
#include "geometry/union_find.h"
#include "solid/cap_refinement.h"
#include "solid/star_core.h"
#include "volume/piece_builder.h"
#include "volume/voronoi_cells.h"

namespace sherd {
namespace {

/// Share of the diagonal: what is flatter is rounding.
constexpr double kRounding = 1e-6;

class ComplexBuilder {
  public:
    ComplexBuilder(MeshCut cut, CutSkin skin, double diagonal) : cut_(std::move(cut)) {
        result_.skin = std::move(skin);
        result_.rounding = kRounding * diagonal;
        numberVertices();
        result_.capSides.assign(cut_.capTriangles.size(), {kNone, kNone});
    }

    std::optional<TetraComplex> run() {
        std::vector<uint32_t> own(cut_.cells());
        std::iota(own.begin(), own.end(), 0U);
        PieceBuilder builder(cut_, own);
        for (uint32_t cell = 0; cell < cut_.cells(); ++cell)
            if (!addCell(cell, builder.build({cell}))) return std::nullopt;
        for (const auto& [low, high] : result_.capSides) {
            if (low != kNone) result_.tetras[low].across[3] = high;
            if (high != kNone) result_.tetras[high].across[3] = low;
            if ((low == kNone) != (high == kNone)) return std::nullopt;
        }
        return std::move(result_);
    }

  private:
    /// The skin's vertices first.
    void numberVertices() {
        result_.positions = result_.skin.positions;
        vertex_ = result_.skin.vertex;
        vertex_.resize(cut_.positions.size(), kNone);
        for (uint32_t v = 0; v < vertex_.size(); ++v) {
            if (vertex_[v] != kNone) continue;
            vertex_[v] = static_cast<uint32_t>(result_.positions.size());
            result_.positions.push_back(cut_.positions[v]);
        }
        result_.firstCore = static_cast<uint32_t>(result_.positions.size());
    }

    bool addCell(uint32_t cell, const BuiltPiece& built) {
        const PieceMesh& mesh = built.mesh;
        UnionFind hanging(mesh.triangles.size());
        for (uint32_t h = 0; h < built.twins.size(); ++h) {
            if (built.twins[h] == kNone) return false;  // open
            hanging.unite(h / 3, built.twins[h] / 3);
        }
        const auto first = static_cast<uint32_t>(result_.tetras.size());
        std::vector<std::vector<uint32_t>> lumps(mesh.triangles.size());
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            lumps[hanging.find(t)].push_back(t);
            addTetra(cell, mesh, t);
        }
        for (uint32_t h = 0; h < built.twins.size(); ++h)
            result_.tetras[first + h / 3].across[(h % 3 + 2) % 3] = first + built.twins[h] / 3;
        for (const auto& lump : lumps)
            if (!lump.empty()) coneLump(lump, first);
        return true;
    }

    void addTetra(uint32_t cell, const PieceMesh& mesh, uint32_t t) {
        const auto number = static_cast<uint32_t>(result_.tetras.size());
        TetraComplex::Tetra tetra;
        for (size_t k = 0; k < 3; ++k) tetra.v[k] = vertex_[mesh.vertices[mesh.triangles[t][k]]];
        const PieceMesh::Origin origin = mesh.origins[t];
        if (origin.cap) {
            result_.capSides[origin.index][isHigh(origin.index, cell) ? 1 : 0] = number;
        } else {
            tetra.skin = result_.skin.ofSkin[origin.index];
        }
        result_.tetras.push_back(tetra);
    }

    bool isHigh(uint32_t capTriangle, uint32_t cell) {
        if (capOf_.empty()) {
            capOf_.resize(cut_.capTriangles.size());
            for (uint32_t c = 0; c < cut_.caps.size(); ++c) {
                for (uint32_t i = 0; i < cut_.caps[c].count; ++i)
                    capOf_[cut_.caps[c].first + i] = c;
            }
        }
        return cut_.caps[capOf_[capTriangle]].high == cell;
    }

    void coneLump(const std::vector<uint32_t>& lump, uint32_t first) {
        std::vector<std::array<uint32_t, 3>> triangles;
        for (const uint32_t t : lump) {
            const auto& v = result_.tetras[first + t].v;
            triangles.push_back({v[0], v[1], v[2]});
        }
        const glm::vec3 core(starCore(result_.positions, triangles, result_.rounding));
        const auto vertex = static_cast<uint32_t>(result_.positions.size());
        result_.positions.push_back(core);
        const auto at = [&](uint32_t v) { return glm::dvec3(result_.positions[v]); };
        bool star = true;
        for (const uint32_t t : lump) {
            TetraComplex::Tetra& tetra = result_.tetras[first + t];
            tetra.v[3] = vertex;
            tetra.lump = static_cast<uint32_t>(result_.star.size());
            star = star && leastHeight(at(tetra.v[0]), at(tetra.v[1]), at(tetra.v[2]),
                                       at(vertex)) >= -result_.rounding;
        }
        result_.star.push_back(star ? 1 : 0);
    }

    MeshCut cut_;
    TetraComplex result_;
    std::vector<uint32_t> vertex_;  ///< per vertex of the cut
    std::vector<uint32_t> capOf_;   ///< per cap triangle
};

}  // namespace

std::optional<TetraComplex> fillWithTetras(const SplitSurface& surface,
                                           std::span<const glm::dvec3> sites) {
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> kept;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& v = surface.triangles[t].v;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        triangles.push_back(v);
        kept.push_back(t);
    }
    const auto grid = CutGrid::around(surface.positions, triangles);
    if (!grid) return std::nullopt;
    auto family = voronoiCells(sites, *grid);
    if (!family) return std::nullopt;
    std::vector<CellFamily> families;
    families.push_back(std::move(*family));
    auto cells = CellFunctions::of(std::move(families));
    if (!cells) return std::nullopt;
    auto cut = cutMesh(surface.positions, triangles, *grid, std::move(*cells));
    if (!cut) return std::nullopt;
    CutSkin skin = cutSkin(surface, *cut, kept);
    refineCaps(*cut);
    return ComplexBuilder(std::move(*cut), std::move(skin), boundsOf(surface).diagonal()).run();
}

}  // namespace sherd
