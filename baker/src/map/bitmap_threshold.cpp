// SPDX-License-Identifier: MIT
// N. Otsu, "A Threshold Selection Method from Gray-Level Histograms", IEEE Trans. SMC 9(1), 1979.
//
// Deviation: where lines cover a thousandth of a noisy picture, the split of largest between-class
// variance runs through the noise of the ground. A split whose classes differ by less than a
// quarter of the picture's range is taken for that, and the search goes on among its darker class.
#include "map/bitmap_threshold.h"

namespace sherd {

namespace {

constexpr int kLeastRange = 16;  ///< of 255: less is one shade, compressed or scanned

struct Split {
    double threshold = 0;
    double contrast = 0;  ///< between the means of the two classes
};

/// The best split of the shades first..last, both of which occur.
Split otsu(const Histogram& histogram, int first, int last) {
    double count = 0;
    double sum = 0;
    for (int v = first; v <= last; ++v) {
        count += static_cast<double>(histogram[v]);
        sum += static_cast<double>(histogram[v]) * v;
    }
    double below = 0;
    double belowSum = 0;
    double best = -1;
    int bestFirst = first;
    int bestLast = first;
    Split split;
    for (int v = first; v < last; ++v) {
        below += static_cast<double>(histogram[v]);
        belowSum += static_cast<double>(histogram[v]) * v;
        const double contrast = (sum - belowSum) / (count - below) - belowSum / below;
        const double between = below * (count - below) * contrast * contrast;
        if (between > best) {
            best = between;
            bestFirst = v;
            split.contrast = contrast;
        }
        // Shades that do not occur leave the split as it was: the middle of the gap is the
        // threshold.
        if (between == best) bestLast = v;
    }
    const int middle = (bestFirst + bestLast) / 2;
    split.threshold = middle + 0.5;
    return split;
}

}  // namespace

std::optional<double> inkThreshold(const Histogram& darkness) {
    int first = 0;
    int last = 255;
    while (first < last && darkness[first] == 0) ++first;
    while (last > first && darkness[last] == 0) --last;
    const int range = last - first;
    if (range < kLeastRange) return std::nullopt;
    for (;;) {
        const Split split = otsu(darkness, first, last);
        if (4 * split.contrast >= range) return split.threshold;
        const int next = static_cast<int>(split.threshold) + 1;
        int occurring = next;
        while (occurring < last && darkness[occurring] == 0) ++occurring;
        if (occurring >= last) return split.threshold;
        first = occurring;
    }
}

}  // namespace sherd
