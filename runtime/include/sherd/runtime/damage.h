// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include "sherd/runtime/memory.h"

namespace sherd {

class Asset;
class Structure;

/// What decides whether a hit breaks something. World options and spawn options each carry one;
/// scales multiply, of minimum values and times the larger counts.
struct DamageOptions {
    float toughnessScale = 1.0F;     ///< times what breaking consumes, > 0
    float strengthScale = 1.0F;      ///< times the stress at which bonds start to fail, > 0
    float levelScale = 1.0F;         ///< and both times this for every level below the first, > 0
    float minimumImpulse = 0.05F;    ///< N s; a gentler contact never breaks anything, >= 0
    float minimumEnergy = 0.01F;     ///< J; likewise, and the price of children without bonds, >= 0
    float immunity = 0.0F;           ///< s in which what has just broken off takes no damage, >= 0
    uint32_t maxLevel = UINT32_MAX;  ///< pieces of this level do not break further; 0: unbreakable
};

/// An error's text, or nullptr when something can be spawned with these.
const char* whyRefused(const DamageOptions& options);

/// Both options as one.
DamageOptions combine(const DamageOptions& world, const DamageOptions& object);

/// One contact between two bodies in one substep, summed over its points.
struct Contact {
    float impulse = 0;        ///< along the normal, N s, >= 0
    float approachSpeed = 0;  ///< along the normal before the contact was solved, m/s, > 0: closing
    float effectiveMass = 0;  ///< of the two bodies at the contact point along the normal, kg
};

/// An error's text, or nullptr when the contact can be judged.
const char* whyRefused(const Contact& contact);

/// The energy a contact could spend on breaking, J: what a perfectly plastic impact would lose,
/// 1/2 m_eff v_n^2, limited by the impulse that really flowed. Supported weight and penetration
/// recovery have no approach speed and so no energy.
float contactEnergy(const Contact& contact);

/// The stress, Pa, that an impact sets up where it strikes: 1/2 rho c v of the elastic wave between
/// two bodies of the struck one's substance, three times that at the flaws and bends where cracks
/// start (W. Goldsmith, "Impact" (1960); G. Kirsch (1898) for the three).
float contactStress(const Asset& asset, uint32_t fragment, float approachSpeed);

/// Something that struck an object, in the object's frame.
struct Hit {
    uint32_t fragment = 0;  ///< standing, that was struck
    glm::vec3 point{0.0F};  ///< metres
    float energy = 0;       ///< J, at most what is consumed
    float stress = 0;       ///< Pa, at the point; bonds feel it fall with distance
};

struct HitResult {
    float consumed = 0;       ///< J
    float area = 0;           ///< of the bonds broken, m^2
    uint32_t level = 0;       ///< the deepest at which something broke
    uint32_t struck = 0;      ///< the standing fragment at the point now
    Vector<uint32_t> bonds;   ///< broken now
    Vector<uint32_t> opened;  ///< fragments their children stand for now, coarse ones first

    void clear() {
        consumed = area = 0;
        level = struck = 0;
        bonds.clear();
        opened.clear();
    }
    [[nodiscard]] bool brokeSomething() const { return !bonds.empty() || !opened.empty(); }
};

/// Spreads a hit over the bonds around it. Between fragments that stand (the struck one seen as its
/// children) bonds fail whose strength the stress exceeds at their distance; the energy flows to
/// them by their area over the square of the distance, and a bond breaks that gets its toughness x
/// area x dissipation: near and weak ones first. The others keep the damage. What is left descends
/// into the fragment at the point, level by level, as long as something breaks.
class HitSolver {
  public:
    HitSolver();
    ~HitSolver();
    HitSolver(HitSolver&&) noexcept;
    HitSolver& operator=(HitSolver&&) noexcept;

    void apply(Structure& structure, const Hit& hit, const DamageOptions& options,
               HitResult& result);

    struct Scratch;  ///< kept from hit to hit, so that they allocate nothing

  private:
    std::unique_ptr<Scratch> scratch_;
};

/// Breaks a standing fragment out of its neighbours and, unless it is to stay whole, into its
/// children, whatever it takes. `consumed` stays 0.
void shatter(Structure& structure, uint32_t fragment, bool whole, HitResult& result);

/// Whether a hit could still break anything off or within `fragment`.
bool isBreakable(const Asset& asset, uint32_t fragment, const DamageOptions& options);

}  // namespace sherd
