// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/inside_test.h"

namespace sherd {

/// Answers an InsideTest's question for many points: space is divided into cubes, and those that no
/// triangle comes near are known as a whole. Gives the test's answer for every point, bit by bit.
class InsideCells {
  public:
    /// `test` was built from the same triangles and outlives this.
    InsideCells(const InsideTest& test, std::span<const glm::vec3> positions,
                std::span<const std::array<uint32_t, 3>> triangles);

    bool inside(const glm::dvec3& point) const {
        const uint8_t state = stateAt(point);
        return state == kUnknown ? test_.inside(point) : state == kInside;
    }

  private:
    enum State : uint8_t { kUnseen, kUnknown, kInside, kOutside };
    using Cell = std::array<uint32_t, 3>;

    uint8_t stateAt(const glm::dvec3& point) const;
    uint32_t along(int axis, double x) const;
    size_t indexOf(const Cell& c) const {
        return (size_t{c[2]} * size_[1] + c[1]) * size_[0] + c[0];
    }
    struct CellBox {
        Cell first{}, last{};
        double cells() const {
            return (last[0] - first[0] + 1.0) * (last[1] - first[1] + 1.0) *
                   (last[2] - first[2] + 1.0);
        }
    };
    void chooseSize(double cells);
    std::vector<CellBox> cellBoxes(std::span<const glm::vec3> positions,
                                   std::span<const std::array<uint32_t, 3>> triangles) const;
    void mark(const CellBox& box);
    void fillFrom(size_t seed, std::vector<size_t>& stack);

    const InsideTest& test_;
    glm::dvec3 low_{0}, high_{0};
    double perUnit_ = 0;
    Cell size_{1, 1, 1};
    std::vector<uint8_t> states_;  ///< empty: every point is asked for
};

}  // namespace sherd
