// SPDX-License-Identifier: MIT
// Surface nets (S. Gibson, "Constrained Elastic Surface Nets", 1998) with a vertex for each sheet
// in a cell (G. Nielson, "Dual Marching Cubes", 2004), a quadrilateral around each edge of the grid
// the surface crosses. Instead of relaxing within the cells we alternate smoothing and stepping
// back onto the surface, which spaces the vertices evenly and keeps the shape.
#include "surface_nets.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace sherd::samples {
namespace {

using Cell = std::array<int32_t, 3>;

class Net {
  public:
    Net(const ShapeFunction& shape, const BentGrid& grid) : shape_(shape), grid_(grid) {
        for (size_t a = 0; a < 3; ++a) count_[a] = static_cast<int32_t>(grid.planes[a].size());
        for (int32_t z = 0; z < count_[2]; ++z) {
            for (int32_t y = 0; y < count_[1]; ++y) {
                for (int32_t x = 0; x < count_[0]; ++x) values_.push_back(shape(place({x, y, z})));
            }
        }
    }

    Mesh build() {
        for (int32_t axis = 0; axis < 3; ++axis) addQuads(axis);
        for (uint32_t round = 0; round < kRounds; ++round) relax();
        Mesh mesh;
        for (const glm::dvec3& p : places_) mesh.positions.emplace_back(p);
        for (const std::array<uint32_t, 4>& quad : quads_) split(quad, mesh);
        return mesh;
    }

  private:
    static constexpr uint32_t kCellEdges = 12;
    static constexpr uint32_t kNone = kCellEdges;
    static constexpr uint32_t kRounds = 8;
    static constexpr uint32_t kSteps = 3;  ///< back onto the surface, each round

    [[nodiscard]] glm::dvec3 place(const Cell& i) const {
        return grid_.bend({grid_.planes[0][size_t(i[0])], grid_.planes[1][size_t(i[1])],
                           grid_.planes[2][size_t(i[2])]});
    }
    [[nodiscard]] double value(const Cell& i) const {
        return values_[(size_t(i[2]) * count_[1] + size_t(i[1])) * count_[0] + size_t(i[0])];
    }

    /// Which of the cell's edges the surface crosses, and for each the lowest of its sheet.
    [[nodiscard]] std::array<uint32_t, kCellEdges> sheets(const Cell& cell) const {
        std::array<uint32_t, kCellEdges> sheet{};
        for (uint32_t e = 0; e < kCellEdges; ++e) sheet[e] = crosses(cell, e) ? e : kNone;
        for (uint32_t face = 0; face < 6; ++face) {
            const std::array<uint32_t, 4> around = faceEdges(face);
            uint32_t crossed = 0;
            for (const uint32_t e : around) crossed += sheet[e] != kNone ? 1 : 0;
            for (uint32_t k = 0; k < 4; ++k) {
                const uint32_t a = around[k];
                const uint32_t b = around[(k + 1) % 4];
                if (sheet[a] == kNone || sheet[b] == kNone) continue;
                // Crossed four times, the face parts the corners inside the shape.
                if (crossed == 4 && value(commonCorner(cell, a, b)) >= 0) continue;
                join(sheet, a, b);
            }
            if (crossed == 2) {
                for (const uint32_t k : {0U, 1U}) {
                    if (sheet[around[k]] != kNone && sheet[around[k + 2]] != kNone)
                        join(sheet, around[k], around[k + 2]);
                }
            }
        }
        return sheet;
    }

    static void join(std::array<uint32_t, kCellEdges>& sheet, uint32_t a, uint32_t b) {
        const uint32_t low = std::min(sheet[a], sheet[b]);
        const uint32_t high = std::max(sheet[a], sheet[b]);
        for (uint32_t& s : sheet)
            if (s == high) s = low;
    }

    /// Edge 4 * axis + side runs along the axis; bit 0 and 1 of the side lead along the next axes.
    static Cell lowEnd(const Cell& cell, uint32_t edge) {
        Cell out = cell;
        out[(edge / 4 + 1) % 3] += static_cast<int32_t>(edge & 1);
        out[(edge / 4 + 2) % 3] += static_cast<int32_t>(edge >> 1 & 1);
        return out;
    }
    static Cell highEnd(const Cell& cell, uint32_t edge) {
        Cell out = lowEnd(cell, edge);
        ++out[edge / 4];
        return out;
    }
    static Cell commonCorner(const Cell& cell, uint32_t a, uint32_t b) {
        const Cell low = lowEnd(cell, a);
        return low == lowEnd(cell, b) || low == highEnd(cell, b) ? low : highEnd(cell, a);
    }
    [[nodiscard]] bool crosses(const Cell& cell, uint32_t edge) const {
        return (value(lowEnd(cell, edge)) < 0) != (value(highEnd(cell, edge)) < 0);
    }

    /// The face across `face / 2`, on its low or high side: its edges in a ring.
    static std::array<uint32_t, 4> faceEdges(uint32_t face) {
        const uint32_t axis = face / 2;
        const uint32_t high = face % 2;
        const uint32_t u = (axis + 1) % 3;
        const uint32_t v = (axis + 2) % 3;
        // Along u, the next axes are v and the face's own; along v, the face's own and u.
        return {4 * u + 2 * high, 4 * v + high + 2, 4 * u + 2 * high + 1, 4 * v + high};
    }

    /// The vertex of the sheet that crosses this edge of the cell: in the middle of its crossings.
    uint32_t vertex(const Cell& cell, uint32_t edge) {
        const std::array<uint32_t, kCellEdges> sheet = sheets(cell);
        const auto [found, added] =
            vertices_.emplace(std::pair(cell, sheet[edge]), static_cast<uint32_t>(places_.size()));
        if (!added) return found->second;
        glm::dvec3 sum(0);
        double count = 0;
        for (uint32_t e = 0; e < kCellEdges; ++e) {
            if (sheet[e] != sheet[edge]) continue;
            const Cell a = lowEnd(cell, e);
            const Cell b = highEnd(cell, e);
            sum += glm::mix(place(a), place(b), value(a) / (value(a) - value(b)));
            ++count;
        }
        places_.push_back(sum / count);
        return found->second;
    }

    /// Around the edges of the grid along `axis`.
    void addQuads(int32_t axis) {
        const int32_t u = (axis + 1) % 3;
        const int32_t v = (axis + 2) % 3;
        Cell at{};
        for (at[axis] = 0; at[axis] + 1 < count_[axis]; ++at[axis]) {
            for (at[u] = 1; at[u] + 1 < count_[u]; ++at[u]) {
                for (at[v] = 1; at[v] + 1 < count_[v]; ++at[v]) {
                    Cell next = at;
                    ++next[axis];
                    const bool inside = value(at) < 0;
                    if (inside == (value(next) < 0)) continue;
                    const auto cell = [&](int32_t du, int32_t dv) {
                        Cell c = at;
                        c[u] -= du;
                        c[v] -= dv;
                        return vertex(c, static_cast<uint32_t>(4 * axis + du + 2 * dv));
                    };
                    std::array<uint32_t, 4> quad{cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)};
                    if (!inside) std::swap(quad[1], quad[3]);
                    quads_.push_back(quad);
                }
            }
        }
    }

    void relax() {
        std::vector<glm::dvec3> sums(places_.size(), glm::dvec3(0));
        std::vector<double> counts(places_.size(), 0);
        for (const std::array<uint32_t, 4>& quad : quads_) {
            for (size_t k = 0; k < 4; ++k) {
                sums[quad[k]] += places_[quad[(k + 1) % 4]] + places_[quad[(k + 3) % 4]];
                counts[quad[k]] += 2;
            }
        }
        for (size_t i = 0; i < places_.size(); ++i) {
            glm::dvec3 p = glm::mix(places_[i], sums[i] / counts[i], 0.5);
            for (uint32_t step = 0; step < kSteps; ++step) {
                const glm::dvec3 up = gradient(shape_, p, 1e-4);
                p -= up * (shape_(p) / std::max(glm::dot(up, up), 0.25));
            }
            places_[i] = p;
        }
    }

    /// Along the shorter diagonal.
    void split(const std::array<uint32_t, 4>& quad, Mesh& mesh) const {
        const bool even = glm::distance(places_[quad[0]], places_[quad[2]]) <=
                          glm::distance(places_[quad[1]], places_[quad[3]]);
        const auto add = [&](size_t a, size_t b, size_t c) {
            mesh.triangles.push_back(
                {Corner{quad[a], {}, {}}, Corner{quad[b], {}, {}}, Corner{quad[c], {}, {}}});
        };
        add(0, 1, even ? 2 : 3);
        add(even ? 0 : 1, 2, 3);
    }

    const ShapeFunction& shape_;
    const BentGrid& grid_;
    std::array<int32_t, 3> count_{};
    std::vector<double> values_;
    std::map<std::pair<Cell, uint32_t>, uint32_t> vertices_;  ///< by cell and sheet
    std::vector<glm::dvec3> places_;
    std::vector<std::array<uint32_t, 4>> quads_;
};

}  // namespace

Mesh meshShape(const ShapeFunction& shape, const BentGrid& grid) {
    return Net(shape, grid).build();
}

}  // namespace sherd::samples
