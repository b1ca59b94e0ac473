// SPDX-License-Identifier: MIT
// No rounding can make a cell's answer wrong: points and triangles are brought into the grid by one
// and the same monotone function, so that a point whose cell no triangle's box reaches lies in no
// triangle's box; and so does the whole way from it to a point in a cell beside it that is as free.
#include "geometry/inside_cells.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"

namespace sherd {
namespace {

/// Finer grids leave less to ask, coarser ones are sooner made.
constexpr double kCellsPerTriangle = 32;
constexpr double kMostCells = 1 << 26;
/// Large triangles among small ones reach many cells: then the cells are made larger.
constexpr double kMostMarksPerTriangle = 64;

}  // namespace

InsideCells::InsideCells(const InsideTest& test, std::span<const glm::vec3> positions,
                         std::span<const std::array<uint32_t, 3>> triangles)
    : test_(test) {
    const Bounds bounds = boundsOf(positions, triangles);
    // An open surface has no inside of its own: what the test says changes anywhere.
    if (bounds.empty() || !test.closed()) return;
    low_ = bounds.low;
    high_ = bounds.high;
    const double wanted =
        std::min(kMostCells, kCellsPerTriangle * static_cast<double>(triangles.size()));
    std::vector<CellBox> boxes;
    for (double cells = wanted;; cells /= 8) {
        chooseSize(cells);
        boxes = cellBoxes(positions, triangles);
        double marks = 0;
        for (const CellBox& box : boxes) marks += box.cells();
        if (marks <= kMostMarksPerTriangle * static_cast<double>(triangles.size())) break;
    }
    states_.assign(size_t{size_[0]} * size_[1] * size_[2], kUnseen);
    for (const CellBox& box : boxes) mark(box);
    std::vector<size_t> stack;
    for (size_t cell = 0; cell < states_.size(); ++cell)
        if (states_[cell] == kUnseen) fillFrom(cell, stack);
}

/// About so many cubes; a single one in the end.
void InsideCells::chooseSize(double cells) {
    const glm::dvec3 extent = high_ - low_;
    const double longest = std::max({extent.x, extent.y, extent.z});
    glm::dvec3 shape(1);
    if (longest > 0) shape = glm::max(extent / longest, glm::dvec3(1e-3));
    perUnit_ = longest > 0 ? std::cbrt(cells / (shape.x * shape.y * shape.z)) / longest : 0;
    for (int k = 0; k < 3; ++k)
        size_[k] = static_cast<uint32_t>(std::clamp(std::ceil(extent[k] * perUnit_), 1.0, 65536.0));
}

uint32_t InsideCells::along(int axis, double x) const {
    return static_cast<uint32_t>(std::clamp((x - low_[axis]) * perUnit_, 0.0, size_[axis] - 1.0));
}

uint8_t InsideCells::stateAt(const glm::dvec3& p) const {
    if (states_.empty()) return kUnknown;
    for (int k = 0; k < 3; ++k)
        if (!(p[k] >= low_[k] && p[k] <= high_[k])) return kOutside;
    return states_[indexOf({along(0, p.x), along(1, p.y), along(2, p.z)})];
}

std::vector<InsideCells::CellBox> InsideCells::cellBoxes(
    std::span<const glm::vec3> positions,
    std::span<const std::array<uint32_t, 3>> triangles) const {
    std::vector<CellBox> boxes;
    boxes.reserve(triangles.size());
    for (const auto& t : triangles) {
        const glm::vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
        CellBox box;
        for (int k = 0; k < 3; ++k) {
            box.first[k] = along(k, std::min({a[k], b[k], c[k]}));
            box.last[k] = along(k, std::max({a[k], b[k], c[k]}));
        }
        boxes.push_back(box);
    }
    return boxes;
}

void InsideCells::mark(const CellBox& box) {
    for (uint32_t z = box.first[2]; z <= box.last[2]; ++z)
        for (uint32_t y = box.first[1]; y <= box.last[1]; ++y) {
            const auto row = states_.begin() + static_cast<std::ptrdiff_t>(indexOf({0, y, z}));
            std::fill(row + box.first[0], row + box.last[0] + 1, static_cast<uint8_t>(kUnknown));
        }
}

/// Gives a cell's answer to all free cells that can be reached from it.
void InsideCells::fillFrom(size_t seed, std::vector<size_t>& stack) {
    const std::array<size_t, 3> stride{1, size_[0], size_t{size_[0]} * size_[1]};
    glm::dvec3 middle;
    for (int k = 0; k < 3; ++k) middle[k] = static_cast<double>(seed / stride[k] % size_[k]) + 0.5;
    const uint8_t state = test_.inside(low_ + middle / perUnit_) ? kInside : kOutside;
    states_[seed] = state;
    stack.push_back(seed);
    while (!stack.empty()) {
        const size_t cell = stack.back();
        stack.pop_back();
        for (int k = 0; k < 3; ++k) {
            const size_t at = cell / stride[k] % size_[k];
            if (at > 0 && states_[cell - stride[k]] == kUnseen) {
                states_[cell - stride[k]] = state;
                stack.push_back(cell - stride[k]);
            }
            if (at + 1 < size_[k] && states_[cell + stride[k]] == kUnseen) {
                states_[cell + stride[k]] = state;
                stack.push_back(cell + stride[k]);
            }
        }
    }
}

}  // namespace sherd
