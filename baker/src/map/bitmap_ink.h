// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "map/bitmap_picture.h"

namespace sherd {

/// A value per texel with a rim of one texel around, so that every texel has eight neighbours.
template <class T>
struct Raster {
    int width = 0, height = 0;
    std::vector<T> values;

    Raster() = default;
    Raster(int w, int h) : width(w), height(h) {
        values.resize(static_cast<size_t>(w + 2) * (h + 2));
    }
    size_t stride() const { return static_cast<size_t>(width) + 2; }
    size_t index(int x, int y) const {
        return (static_cast<size_t>(y) + 1) * stride() + static_cast<size_t>(x) + 1;
    }
    int xOf(size_t index) const { return static_cast<int>(index % stride()) - 1; }
    int yOf(size_t index) const { return static_cast<int>(index / stride()) - 1; }
    /// Offset to neighbour k of 8: north first, then clockwise.
    ptrdiff_t step(int k) const {
        constexpr int dx[8] = {0, 1, 1, 1, 0, -1, -1, -1};
        constexpr int dy[8] = {-1, -1, 0, 1, 1, 1, 0, -1};
        return dy[k] * static_cast<ptrdiff_t>(stride()) + dx[k];
    }
};

/// What is drawn, told from what it is drawn on.
struct Ink {
    Raster<uint8_t> darkness;  ///< 255: ink; the rim is 0
    Raster<uint8_t> mask;      ///< 1: ink
    double threshold = 0;      ///< of `darkness`, above which it is ink
    size_t texels = 0;         ///< of ink
    std::vector<std::string> warnings;

    /// As the option counts: 0..1, darker is line.
    double optionThreshold() const { return 1 - threshold / 255; }
};

/// Tells ink from ground. `threshold` as BitmapOptions has it. Pinholes of at most `pinhole` texels
/// are filled. Error emptyMap: the picture is of one shade.
Result<Ink> findInk(const Picture& picture, std::optional<double> threshold, double pinhole,
                    const std::string& name);

}  // namespace sherd
