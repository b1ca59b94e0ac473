// SPDX-License-Identifier: MIT
#include "volume/edge_windings.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

namespace sherd {
namespace {

using Integer = ExactPlace::Integer;

/// grad(f_i - f_j) x grad(f_i - f_k): below 2^60.
std::array<Int128, 3> directionOf(const CellFunctions& functions,
                                  const std::array<uint32_t, 3>& cells) {
    const LinearFunction a = functions[cells[0]] - functions[cells[1]];
    const LinearFunction b = functions[cells[0]] - functions[cells[2]];
    return {Int128{a.y} * b.z - Int128{a.z} * b.y, Int128{a.z} * b.x - Int128{a.x} * b.z,
            Int128{a.x} * b.y - Int128{a.y} * b.x};
}

/// The order of vertices along an edge.
class AlongEdge {
  public:
    AlongEdge(const CutVertices& vertices, const std::array<uint32_t, 3>& cells)
        : vertices_(vertices), exact_(directionOf(vertices.input().functions, cells)) {
        direction_ = glm::normalize(glm::dvec3(static_cast<double>(exact_[0]),
                                               static_cast<double>(exact_[1]),
                                               static_cast<double>(exact_[2])));
    }

    /// -1, 0, 1
    int compare(uint32_t a, uint32_t b) const {
        const double along =
            glm::dot(direction_, vertices_.gridPosition(b) - vertices_.gridPosition(a));
        // Places are off by 2^-23 per axis.
        if (along > 0x1p-20) return -1;
        if (along < -0x1p-20) return 1;
        const ExactPlace p = vertices_.exactPlace(a), q = vertices_.exactPlace(b);
        const Integer difference = dot(p) * q.w - dot(q) * p.w;
        return difference.sign();
    }

  private:
    Integer dot(const ExactPlace& p) const {
        return Integer(exact_[0]) * p.x + Integer(exact_[1]) * p.y + Integer(exact_[2]) * p.z;
    }

    const CutVertices& vertices_;
    std::array<Int128, 3> exact_;
    glm::dvec3 direction_;
};

class Windings {
  public:
    Windings(const CellComplex& complex, std::vector<EdgeCrossing> crossings, CutVertices& vertices)
        : complex_(complex), crossings_(std::move(crossings)), vertices_(vertices) {
        sortCrossings();
    }

    std::optional<std::vector<InnerStretch>> run() {
        if (!carry()) return std::nullopt;
        std::vector<InnerStretch> stretches;
        for (uint32_t e = 0; e < complex_.edges().size(); ++e) addStretches(e, stretches);
        return stretches;
    }

  private:
    static constexpr int kUnknown = std::numeric_limits<int>::min();

    void sortCrossings() {
        std::sort(crossings_.begin(), crossings_.end(),
                  [](const EdgeCrossing& a, const EdgeCrossing& b) { return a.edge < b.edge; });
        first_.assign(complex_.edges().size() + 1, 0);
        for (const EdgeCrossing& c : crossings_) ++first_[c.edge + 1];
        for (size_t e = 0; e + 1 < first_.size(); ++e) first_[e + 1] += first_[e];
        for (uint32_t e = 0; e + 1 < first_.size(); ++e) {
            if (first_[e + 1] - first_[e] < 2) continue;
            const AlongEdge along(vertices_, complex_.edges()[e].cells);
            // Of crossings in one place what enters comes first: no stretch has a winding of -1
            // that a valid mesh would not.
            std::sort(crossings_.begin() + first_[e], crossings_.begin() + first_[e + 1],
                      [&](const EdgeCrossing& a, const EdgeCrossing& b) {
                          const int order = along.compare(a.vertex, b.vertex);
                          if (order != 0) return order < 0;
                          return a.leaves != b.leaves ? a.leaves < b.leaves : a.vertex < b.vertex;
                      });
        }
    }

    std::span<const EdgeCrossing> crossingsOf(uint32_t e) const {
        return std::span(crossings_).subspan(first_[e], first_[e + 1] - first_[e]);
    }

    int change(uint32_t e) const {
        int sum = 0;
        for (const EdgeCrossing& c : crossingsOf(e)) sum -= c.leaves;
        return sum;
    }

    /// Winding numbers of all vertices of the complex.
    bool carry() {
        const size_t n = complex_.vertices().size();
        std::vector<std::array<uint32_t, 4>> edgesAt(n);
        std::vector<uint8_t> degree(n, 0);
        for (uint32_t e = 0; e < complex_.edges().size(); ++e) {
            for (const uint32_t v : {complex_.edges()[e].from, complex_.edges()[e].to})
                edgesAt[v][degree[v]++] = e;
        }
        winding_.assign(n, kUnknown);
        std::vector<uint32_t> open;
        for (uint32_t v = 0; v < n; ++v) {
            if (!complex_.vertices()[v].onBox()) continue;
            winding_[v] = 0;
            open.push_back(v);
        }
        while (!open.empty()) {
            const uint32_t v = open.back();
            open.pop_back();
            for (size_t k = 0; k < degree[v]; ++k) {
                const CellComplex::Edge& edge = complex_.edges()[edgesAt[v][k]];
                const int step = change(edgesAt[v][k]);
                const uint32_t to = edge.from == v ? edge.to : edge.from;
                const int there = winding_[v] + (edge.from == v ? step : -step);
                if (winding_[to] == kUnknown) {
                    winding_[to] = there;
                    open.push_back(to);
                } else if (winding_[to] != there) {
                    return false;
                }
            }
        }
        return std::find(winding_.begin(), winding_.end(), kUnknown) == winding_.end();
    }

    uint32_t vertexAt(uint32_t v) {
        const CellComplex::Vertex& vertex = complex_.vertices()[v];
        return vertices_.atCells(vertex.cells, vertex.position);
    }

    void addStretches(uint32_t e, std::vector<InnerStretch>& stretches) {
        const CellComplex::Edge& edge = complex_.edges()[e];
        const auto crossings = crossingsOf(e);
        int winding = winding_[edge.from];
        for (size_t k = 0; k <= crossings.size(); ++k) {
            if (winding != 0) {
                const uint32_t from = k == 0 ? vertexAt(edge.from) : crossings[k - 1].vertex;
                const uint32_t to = k == crossings.size() ? vertexAt(edge.to) : crossings[k].vertex;
                stretches.push_back({e, from, to, winding});
            }
            if (k < crossings.size()) winding -= crossings[k].leaves;
        }
    }

    const CellComplex& complex_;
    std::vector<EdgeCrossing> crossings_;
    CutVertices& vertices_;
    std::vector<uint32_t> first_;  ///< per edge: its first crossing
    std::vector<int> winding_;     ///< per vertex of the complex
};

}  // namespace

std::optional<std::vector<InnerStretch>> innerStretches(const CellComplex& complex,
                                                        std::vector<EdgeCrossing> crossings,
                                                        CutVertices& vertices) {
    return Windings(complex, std::move(crossings), vertices).run();
}

}  // namespace sherd
