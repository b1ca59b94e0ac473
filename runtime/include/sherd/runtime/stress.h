// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "sherd/runtime/damage.h"
#include "sherd/runtime/memory.h"

namespace sherd {

class Structure;

/// What one bond carries in equilibrium, in the object's frame.
struct BondForce {
    glm::vec3 force{0.0F};   ///< on leaf a, N: along the bond's normal in tension
    glm::vec3 moment{0.0F};  ///< on leaf a, about the bond's centroid, N m
};

struct OverloadedBond {
    uint32_t bond = 0;
    float overload = 0;  ///< > 1
};

/// Finds what the bonds of one anchored island carry under its weight and other loads, a few
/// iterations at a time. The standing fragments are rigid, the bonds elastic. What does not hang
/// together with the world, by bonds or pins, carries no static load: its bonds have no force and
/// no overload.
///
/// Where it has the numbers of an island or a load not yet, every force and overload is zero: an
/// unfinished solution overloads bonds that are sound. The same calls give the same bits, whatever
/// the pieces of `step`. Memory is taken by `reset`, and kept: `step` takes none.
class StressSolver {
  public:
    StressSolver();
    ~StressSolver();
    StressSolver(StressSolver&&) noexcept;
    StressSolver& operator=(StressSolver&&) noexcept;

    /// Takes up the island of these standing fragments as it is now; again after every change of
    /// the structure. Others, and those named twice, are left out, as are bonds to fragments that
    /// are not among these. Starts from the last solution where it was of the same asset: of a
    /// fragment, or of the one whose piece it is. Keeps gravity, forgets the forces.
    void reset(const Structure& structure, std::span<const uint32_t> fragments,
               const DamageOptions& options = {});

    /// m/s^2, in the object's frame. False, and nothing done, when a component is not finite.
    bool setGravity(const glm::vec3& acceleration);
    void clearForces();
    /// A force, N, at a fragment's centre of mass, or at a point, metres: on top of the others.
    /// False, and nothing done, when a component is not finite, or the fragment not one that hangs
    /// together with the world. Loads that come to the same as before start nothing anew.
    bool addForce(uint32_t fragment, const glm::vec3& force);
    bool addForce(uint32_t fragment, const glm::vec3& force, const glm::vec3& point);

    /// Goes on for at most this many iterations; the first few after `reset` are its preparations,
    /// of about the same price. Returns whether forces on every fragment balance: up to 1e-5 of the
    /// load, as a root of sums of squares; in very slender islands (cantilevers of some 500
    /// fragments and more) up to what rounding allows, but no more than 1e-3, and never where
    /// that is too much.
    bool step(uint32_t maxIterations);
    [[nodiscard]] bool isConverged() const;
    /// What does not balance yet, of the load.
    [[nodiscard]] double residual() const;
    /// Since `reset`.
    [[nodiscard]] uint32_t iterationCount() const;

    /// The largest of tension, shear and compression over what the bond holds of each. Bending adds
    /// to tension and compression, torsion to shear, as in a square of the bond's area. What a hit
    /// left of a bond is what it holds; the options' scales multiply it.
    [[nodiscard]] float overload(uint32_t bond) const;
    [[nodiscard]] BondForce force(uint32_t bond) const;
    /// Worst first. Until the next call that is not const.
    [[nodiscard]] std::span<const OverloadedBond> overloaded() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Breaks the worst of the overloaded bonds, so many at most: a crack leads the load elsewhere, so
/// solve again before more. `broken` is what broke now. Returns whether anything did.
bool breakOverloaded(Structure& structure, const StressSolver& solver, uint32_t maxBonds,
                     Vector<uint32_t>& broken);

}  // namespace sherd
