// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <xsimd/xsimd.hpp>

#include "geometry/lanes.h"

namespace sherd {

/// Four numbers or points at once.
using Four = xsimd::make_sized_batch_t<float, Lanes::kWidth>;
using FourPoints = std::array<Four, 3>;

inline Four loaded(const Lanes& lanes) {
    return Four::load_aligned(lanes.at.data());
}

inline FourPoints loaded(const LanesOfPoints& v) {
    return {loaded(v[0]), loaded(v[1]), loaded(v[2])};
}

inline Lanes stored(const Four& x) {
    Lanes lanes;
    x.store_aligned(lanes.at.data());
    return lanes;
}

inline FourPoints fourTimes(const glm::vec3& p) {
    return {Four(p.x), Four(p.y), Four(p.z)};
}

inline FourPoints operator+(const FourPoints& a, const FourPoints& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline FourPoints operator-(const FourPoints& a, const FourPoints& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline FourPoints operator*(const FourPoints& a, const Four& x) {
    return {a[0] * x, a[1] * x, a[2] * x};
}

inline Four dot(const FourPoints& a, const FourPoints& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Condition>
FourPoints select(const Condition& condition, const FourPoints& a, const FourPoints& b) {
    return {xsimd::select(condition, a[0], b[0]), xsimd::select(condition, a[1], b[1]),
            xsimd::select(condition, a[2], b[2])};
}

/// How far |d| is beyond an extent.
inline FourPoints beyond(const FourPoints& d, const FourPoints& extent) {
    const Four zero(0.0F);
    return {xsimd::max(xsimd::abs(d[0]) - extent[0], zero),
            xsimd::max(xsimd::abs(d[1]) - extent[1], zero),
            xsimd::max(xsimd::abs(d[2]) - extent[2], zero)};
}

/// The numbers of four rows, first with first.
inline std::array<Four, 4> transposed(const std::array<const Lanes*, 4>& rows) {
    const Four a = loaded(*rows[0]), b = loaded(*rows[1]), c = loaded(*rows[2]),
               d = loaded(*rows[3]);
    const Four xyAC = xsimd::zip_lo(a, c), xyBD = xsimd::zip_lo(b, d);
    const Four zwAC = xsimd::zip_hi(a, c), zwBD = xsimd::zip_hi(b, d);
    return {xsimd::zip_lo(xyAC, xyBD), xsimd::zip_hi(xyAC, xyBD), xsimd::zip_lo(zwAC, zwBD),
            xsimd::zip_hi(zwAC, zwBD)};
}

}  // namespace sherd
