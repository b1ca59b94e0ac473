// SPDX-License-Identifier: MIT
#include "map/bitmap_ink.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "map/bitmap_threshold.h"

namespace sherd {

namespace {

/// Lines cover less than half of a drawing: alpha says where they are if most of it is transparent.
bool alphaIsLines(const Picture& picture) {
    if (picture.alpha.empty()) return false;
    uint64_t sum = 0;
    uint8_t lowest = 255;
    uint8_t highest = 0;
    for (const uint8_t a : picture.alpha) {
        sum += a;
        lowest = std::min(lowest, a);
        highest = std::max(highest, a);
    }
    return lowest < highest && 2 * sum < 255 * static_cast<uint64_t>(picture.size());
}

Raster<uint8_t> darknessOf(const Picture& picture) {
    Raster<uint8_t> darkness(picture.width, picture.height);
    const bool lines = alphaIsLines(picture);
    size_t from = 0;
    for (int y = 0; y < picture.height; ++y) {
        size_t to = darkness.index(0, y);
        for (int x = 0; x < picture.width; ++x, ++from, ++to) {
            const int dark = 255 - picture.grey[from];
            if (picture.alpha.empty())
                darkness.values[to] = static_cast<uint8_t>(dark);
            else if (lines)
                darkness.values[to] = picture.alpha[from];
            else  // on white paper
                darkness.values[to] = static_cast<uint8_t>(dark * picture.alpha[from] / 255);
        }
    }
    return darkness;
}

template <class Visit>
void eachTexel(const Raster<uint8_t>& raster, const Visit& visit) {
    for (int y = 0; y < raster.height; ++y) {
        const size_t begin = raster.index(0, y);
        for (size_t i = begin; i < begin + static_cast<size_t>(raster.width); ++i) visit(i);
    }
}

void markInk(Ink& ink) {
    ink.texels = 0;
    eachTexel(ink.darkness, [&](size_t i) {
        ink.mask.values[i] = ink.darkness.values[i] > ink.threshold ? 1 : 0;
        ink.texels += ink.mask.values[i];
    });
}

void invert(Ink& ink) {
    eachTexel(ink.darkness, [&](size_t i) {
        ink.darkness.values[i] = static_cast<uint8_t>(255 - ink.darkness.values[i]);
    });
    ink.threshold = 255 - ink.threshold;
    markInk(ink);
}

/// Fills the 4-connected patch of ground at `start` if it is of at most `limit` texels. Looks at no
/// more than that many.
void fillPinhole(Ink& ink, size_t start, size_t limit, std::vector<size_t>& patch) {
    patch.assign(1, start);
    const Raster<uint8_t>& mask = ink.mask;
    for (size_t next = 0; next < patch.size(); ++next) {
        const int x = mask.xOf(patch[next]);
        const int y = mask.yOf(patch[next]);
        // Ground at the picture's border is open to the outside.
        if (x == 0 || y == 0 || x == mask.width - 1 || y == mask.height - 1) return;
        for (int k = 0; k < 8; k += 2) {
            const size_t i = patch[next] + mask.step(k);
            if (mask.values[i] != 0 || std::find(patch.begin(), patch.end(), i) != patch.end())
                continue;
            if (patch.size() == limit) return;
            patch.push_back(i);
        }
    }
    for (const size_t i : patch) {
        ink.mask.values[i] = 1;
        ink.darkness.values[i] = 255;
        ++ink.texels;
    }
}

void fillPinholes(Ink& ink, size_t limit) {
    if (limit == 0) return;
    std::vector<size_t> patch;
    eachTexel(ink.mask, [&](size_t i) {
        const std::vector<uint8_t>& ground = ink.mask.values;
        // Every patch has a texel with ink above it and to its left.
        if (ground[i] == 0 && ground[i - 1] != 0 && ground[i - ink.mask.stride()] != 0)
            fillPinhole(ink, i, limit, patch);
    });
}

}  // namespace

Result<Ink> findInk(const Picture& picture, std::optional<double> threshold, double pinhole,
                    const std::string& name) {
    Ink ink;
    ink.darkness = darknessOf(picture);
    ink.mask = Raster<uint8_t>(picture.width, picture.height);
    Histogram histogram{};
    eachTexel(ink.darkness, [&](size_t i) { ++histogram[ink.darkness.values[i]]; });
    if (threshold) {
        ink.threshold = std::floor((1 - *threshold) * 255) + 0.5;
    } else if (const std::optional<double> found = inkThreshold(histogram)) {
        ink.threshold = *found;
    } else {
        return fail(ErrorCode::emptyMap,
                    "the picture is of one shade, so that no threshold tells lines from ground; "
                    "draw dark lines on light, or opaque ones on transparent",
                    name);
    }
    markInk(ink);
    if (2 * ink.texels > picture.size()) {
        invert(ink);
        ink.warnings.push_back(name +
                               ": more than half of the picture is dark, so its light side was "
                               "taken for the lines; invert it, or set the threshold, if that is "
                               "wrong");
    }
    fillPinholes(ink, static_cast<size_t>(std::clamp(pinhole, 0.0, 64.0)));
    return ink;
}

}  // namespace sherd
