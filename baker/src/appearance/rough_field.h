// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace sherd {

/// A seeded random field of vectors with flat facets and sharp creases, as stone breaks: space is
/// folded like paper, along planes of all directions at uneven distances. Folding never moves two
/// points apart, and hardly anywhere nearer: so the slope is known exactly and is the same all
/// over. Smooth noise (tried: vectors on a lattice, blended by B-splines) is ten times as steep in
/// the worst place as on the whole, and has to be that much weaker if nothing may fold over.
class RoughField {
  public:
    /// bumpSize: metres from one bump to the next.
    RoughField(double bumpSize, uint32_t seed);

    struct Value {
        glm::dvec3 vector{0.0};  ///< at most 1 long
        glm::dmat3 slope{0.0};   ///< its derivative, column by column
    };
    Value at(const glm::dvec3& p) const;

    /// The vectors at p and q differ by no more than steepest() * |p - q|, for all p and q.
    double steepest() const { return steepest_; }

  private:
    /// Planes across an axis, one in each stretch of `spacing` metres, somewhere in its middle
    /// part.
    struct Fold {
        glm::dvec3 axis;  ///< unit
        double spacing;
        uint64_t seed;

        double planeIn(double stretch) const;
        void fold(Value& value) const;
    };
    /// Two times three folds along axes at right angles; the last three bound the result.
    struct Layer {
        std::array<Fold, 6> folds;
        double strength;

        double extent() const;  ///< of the result along each of the last axes, metres
        Value at(const glm::dvec3& p) const;
    };
    std::array<Layer, 2> layers_;
    double steepest_ = 0;
};

}  // namespace sherd
