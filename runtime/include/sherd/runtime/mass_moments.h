// SPDX-License-Identifier: MIT
#pragma once

namespace sherd {

/// How mass lies about one point and along one set of axes, so that the parts of a body are summed
/// by adding: kg, kg m, kg m^2.
struct MassMoments {
    double mass = 0;
    double x = 0, y = 0, z = 0;
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

    MassMoments& operator+=(const MassMoments& other) {
        mass += other.mass;
        x += other.x;
        y += other.y;
        z += other.z;
        xx += other.xx;
        yy += other.yy;
        zz += other.zz;
        xy += other.xy;
        xz += other.xz;
        yz += other.yz;
        return *this;
    }
};

}  // namespace sherd
