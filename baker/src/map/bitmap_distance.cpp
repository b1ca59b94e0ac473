// SPDX-License-Identifier: MIT
// Exact Euclidean distance transform: P. Felzenszwalb, D. Huttenlocher, "Distance Transforms of
// Sampled Functions", Theory of Computing 8, 2012 (lower envelope of parabolas).
//
// Ground ends every run of ink in a row, and nothing beyond a run's ends is nearer than they are:
// each run is its own small transform, so that the time goes with the ink.
#include "map/bitmap_distance.h"

#include <algorithm>
#include <cmath>

namespace sherd {

namespace {

constexpr uint16_t kFar = 2 * kMaxBitmapSide;  ///< no ground in this column

/// Distance to the nearest ground in the same column.
Raster<uint16_t> columnDistance(const Raster<uint8_t>& mask) {
    Raster<uint16_t> distance(mask.width, mask.height);
    const size_t stride = mask.stride();
    const auto relax = [&](size_t i, size_t from, bool first) {
        if (mask.values[i] == 0) return;
        const uint16_t before = first ? kFar : distance.values[from];
        distance.values[i] = std::min<uint16_t>(kFar, before + 1);
    };
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const size_t i = mask.index(x, y);
            relax(i, i - stride, y == 0);
        }
    for (int y = mask.height - 2; y >= 0; --y)
        for (int x = 0; x < mask.width; ++x) {
            const size_t i = mask.index(x, y);
            if (mask.values[i] == 0) continue;
            distance.values[i] =
                std::min<uint16_t>(distance.values[i], distance.values[i + stride] + 1);
        }
    return distance;
}

class RowEnvelope {
  public:
    /// Adds the parabola height + (x - at)^2; `at` grows from call to call.
    void add(int at, double height) {
        double start = -HUGE_VAL;
        while (!parabolas_.empty()) {
            const Parabola& last = parabolas_.back();
            start = (height - last.height + double(at) * at - double(last.at) * last.at) /
                    (2.0 * (at - last.at));
            if (start > last.start) break;
            parabolas_.pop_back();
            start = -HUGE_VAL;
        }
        parabolas_.push_back({at, height, start});
    }
    /// The envelope's height at x; x grows from call to call.
    double at(int x) {
        while (next_ + 1 < parabolas_.size() && parabolas_[next_ + 1].start < x) ++next_;
        const Parabola& p = parabolas_[next_];
        return p.height + double(x - p.at) * (x - p.at);
    }
    void clear() {
        parabolas_.clear();
        next_ = 0;
    }

  private:
    struct Parabola {
        int at;
        double height;
        double start;  ///< from where it is the lowest
    };
    std::vector<Parabola> parabolas_;
    size_t next_ = 0;
};

}  // namespace

Raster<float> inkRadius(const Raster<uint8_t>& mask) {
    const Raster<uint16_t> column = columnDistance(mask);
    Raster<float> radius(mask.width, mask.height);
    const double largest = std::max(mask.width, mask.height);
    RowEnvelope envelope;
    for (int y = 0; y < mask.height; ++y) {
        const size_t row = mask.index(0, y);
        for (int begin = 0; begin < mask.width; ++begin) {
            if (mask.values[row + begin] == 0) continue;
            int end = begin;
            while (end < mask.width && mask.values[row + end] != 0) ++end;
            envelope.clear();
            if (begin > 0) envelope.add(begin - 1, 0);
            for (int x = begin; x < end; ++x)
                envelope.add(x, double(column.values[row + x]) * column.values[row + x]);
            if (end < mask.width) envelope.add(end, 0);
            for (int x = begin; x < end; ++x)
                radius.values[row + x] =
                    static_cast<float>(std::min(std::sqrt(envelope.at(x)), largest) - 0.5);
            begin = end;
        }
    }
    return radius;
}

}  // namespace sherd
