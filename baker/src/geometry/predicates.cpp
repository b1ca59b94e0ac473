// SPDX-License-Identifier: MIT
// J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates" (1997). We keep his first filter and go straight to the exact value after it: the
// stages between pay off only where nearly all input is degenerate.
#include "geometry/predicates.h"

#include <array>

namespace sherd {
namespace {

/// A number as an exact sum of doubles, smallest first, that do not overlap; zeros are left out.
template <size_t Capacity>
class Expansion {
  public:
    /// Adds x without error (Shewchuk's GROW-EXPANSION).
    void add(double x) {
        size_t kept = 0;
        double sum = x;
        for (size_t i = 0; i < size_; ++i) {
            const double e = terms_[i];
            const double s = sum + e;
            const double eRounded = s - sum;
            const double error = (sum - (s - eRounded)) + (e - eRounded);
            if (error != 0) terms_[kept++] = error;
            sum = s;
        }
        if (sum != 0) terms_[kept++] = sum;
        size_ = kept;
    }

    /// Adds x * y without error.
    void addProduct(double x, double y) {
        const double product = x * y;
        add(std::fma(x, y, -product));
        add(product);
    }

    template <size_t A, size_t B>
    void addProduct(const Expansion<A>& a, const Expansion<B>& b, double sign) {
        for (size_t i = 0; i < a.size(); ++i) {
            for (size_t j = 0; j < b.size(); ++j) addProduct(sign * a[i], b[j]);
        }
    }

    size_t size() const { return size_; }
    double operator[](size_t i) const { return terms_[i]; }
    int sign() const { return size_ == 0 ? 0 : (terms_[size_ - 1] > 0 ? 1 : -1); }

  private:
    std::array<double, Capacity> terms_{};
    size_t size_ = 0;
};

Expansion<2> difference(double x, double y) {
    Expansion<2> e;
    e.add(x);
    e.add(-y);
    return e;
}

/// ax * by - ay * bx of exact differences: at most 8 terms each.
Expansion<16> cross(const Expansion<2>& ax, const Expansion<2>& ay, const Expansion<2>& bx,
                    const Expansion<2>& by) {
    Expansion<16> e;
    e.addProduct(ax, by, 1);
    e.addProduct(ay, bx, -1);
    return e;
}

}  // namespace

int detail::exactOrient2d(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return cross(difference(a.x, c.x), difference(a.y, c.y), difference(b.x, c.x),
                 difference(b.y, c.y))
        .sign();
}

int detail::exactOrient3d(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& d) {
    const auto ax = difference(a.x, d.x), ay = difference(a.y, d.y), az = difference(a.z, d.z);
    const auto bx = difference(b.x, d.x), by = difference(b.y, d.y), bz = difference(b.z, d.z);
    const auto cx = difference(c.x, d.x), cy = difference(c.y, d.y), cz = difference(c.z, d.z);
    Expansion<192> det;
    det.addProduct(cross(bx, by, cx, cy), az, 1);
    det.addProduct(cross(cx, cy, ax, ay), bz, 1);
    det.addProduct(cross(ax, ay, bx, by), cz, 1);
    return -det.sign();
}

}  // namespace sherd
