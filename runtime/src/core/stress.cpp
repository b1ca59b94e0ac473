// SPDX-License-Identifier: MIT
#include "sherd/runtime/stress.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/bond_network.h"
#include "core/bond_price.h"
#include "core/equilibrium.h"
#include "core/finite.h"
#include "sherd/runtime/material.h"
#include "sherd/runtime/structure.h"

namespace sherd {
namespace {

/// What a bond holds, Pa; infinite where the options forbid that it breaks.
struct Resistance {
    double tension, shear, compression;
};

Resistance resistanceOf(const Structure& structure, uint32_t b, const DamageOptions& options) {
    const Asset& asset = structure.asset();
    const BondGraph::Bond& bond = structure.graph().bond(b);
    const uint32_t level = asset.fragment(bond.parting).level;
    if (level >= options.maxLevel) return {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const auto materialOf = [&](uint32_t leaf) -> const Material& {
        return materialNamed(asset.fragment(structure.graph().fragmentOfLeaf(leaf)).material);
    };
    const Material& a = materialOf(bond.a);
    const Material& other = bond.b == BondGraph::kWorld ? a : materialOf(bond.b);
    const double strength = double(strengthOf(asset, bond, options)) * double(structure.health(b));
    return {strength, strength * double(std::min(a.shear, other.shear)),
            strength * double(std::min(a.compression, other.compression))};
}

/// How much of a load to what holds it, at most what a float can say.
float ratio(double stress, double held) {
    if (!(stress > 0)) return 0;
    return float(std::min(stress / std::max(held, DBL_MIN), double(FLT_MAX)));
}

/// A square of the area stands for the bond: section modulus a^3/6, and torsion of 0.208 a^3 (S. P.
/// Timoshenko, J. N. Goodier, "Theory of Elasticity" (1970), 109).
float overloadOf(const BondNetwork::Link& link, const Resistance& resistance, const Screw& onA) {
    const double area = link.area;
    const glm::dvec3& normal = link.normal;
    const double cube = area * std::sqrt(area);
    const double pull = glm::dot(onA.linear, normal);
    const double twist = glm::dot(onA.angular, normal);
    const double across = glm::length(onA.linear - pull * normal);
    const double bending = 6 * glm::length(onA.angular - twist * normal) / cube;
    return std::max({ratio(pull / area + bending, resistance.tension),
                     ratio(bending - pull / area, resistance.compression),
                     ratio(across / area + std::abs(twist) / (0.208 * cube), resistance.shear)});
}

}  // namespace

struct StressSolver::State {
    struct Body {
        double mass;  ///< kg
        glm::dvec3 center;
    };
    struct Carried {
        Screw onA;  ///< N and N m
        Resistance resistance;
        float overload;
    };
    struct Known {
        uint32_t fragment;
        Body body;
        Screw motion;
    };

    const Asset* asset = nullptr;
    BondNetwork bonds;
    Equilibrium equilibrium;
    glm::dvec3 gravity{0.0};
    Vector<Body> bodies;      ///< per node
    Vector<Screw> forces;     ///< per node, N and N m about its centre
    Vector<Screw> load;       ///< per node, in the network's units
    Vector<Carried> carried;  ///< per link
    Vector<uint32_t> linkOf;  ///< per bond of the asset
    Vector<OverloadedBond> overloaded;
    Vector<Known> known;  ///< of the structure before, by fragment
    bool loadChanged = false;
    bool isEvaluated = false;

    void keepMotion();
    void recallMotion();
    void updateLoad();
    void evaluate();
    const Carried* find(uint32_t bond) const {
        const bool isKnown = bond < linkOf.size() && linkOf[bond] != BondNetwork::kNone;
        return isKnown && isEvaluated ? &carried[linkOf[bond]] : nullptr;
    }
};

/// The motion there is, in newtons over metres of Young's modulus 1, by fragment.
void StressSolver::State::keepMotion() {
    known.clear();
    const double unit = bonds.unit();
    for (uint32_t node = 0; node < bodies.size(); ++node) {
        const Screw& motion = equilibrium.motion()[node];
        known.push_back({bonds.fragments()[node],
                         bodies[node],
                         {motion.linear / unit, motion.angular / (unit * unit)}});
    }
    std::sort(known.begin(), known.end(),
              [](const Known& x, const Known& y) { return x.fragment < y.fragment; });
}

void StressSolver::State::recallMotion() {
    const double unit = bonds.unit();
    for (uint32_t node = 0; node < bodies.size(); ++node) {
        for (auto f = int32_t(bonds.fragments()[node]); f >= 0;
             f = asset->fragment(uint32_t(f)).parent) {
            const auto found = std::lower_bound(
                known.begin(), known.end(), uint32_t(f),
                [](const Known& k, uint32_t fragment) { return k.fragment < fragment; });
            if (found == known.end() || found->fragment != uint32_t(f)) continue;
            const glm::dvec3 arm = bodies[node].center - found->body.center;
            const Screw motion = twistAt(found->motion, arm);
            equilibrium.setMotion(node, {motion.linear * unit, motion.angular * (unit * unit)});
            break;
        }
    }
}

void StressSolver::State::updateLoad() {
    if (!loadChanged) return;
    loadChanged = false;
    bool isSame = true;
    const auto isEqual = [](const Screw& x, const Screw& y) {
        return x.linear == y.linear && x.angular == y.angular;
    };
    for (size_t node = 0; node < bodies.size(); ++node) {
        load[node] = {bodies[node].mass * gravity + forces[node].linear,
                      forces[node].angular / bonds.unit()};
        isSame = isSame && isEqual(load[node], equilibrium.load()[node]);
    }
    if (isSame) return;
    equilibrium.setLoad(load);
    isEvaluated = false;
    overloaded.clear();
}

void StressSolver::State::evaluate() {
    isEvaluated = true;
    overloaded.clear();
    for (size_t l = 0; l < carried.size(); ++l) {
        const BondNetwork::Link& link = bonds.links()[l];
        Carried& at = carried[l];
        at.onA = bonds.wrenchOf(l, equilibrium.motion());
        at.onA.angular *= bonds.unit();
        at.overload = overloadOf(link, at.resistance, at.onA);
        if (at.overload > 1) overloaded.push_back({link.bond, at.overload});
    }
    std::sort(overloaded.begin(), overloaded.end(),
              [](const OverloadedBond& x, const OverloadedBond& y) {
                  return x.overload != y.overload ? x.overload > y.overload : x.bond < y.bond;
              });
}

StressSolver::StressSolver() : state_(std::make_unique<State>()) {}
StressSolver::~StressSolver() = default;
StressSolver::StressSolver(StressSolver&&) noexcept = default;
StressSolver& StressSolver::operator=(StressSolver&&) noexcept = default;

void StressSolver::reset(const Structure& structure, std::span<const uint32_t> fragments,
                         const DamageOptions& options) {
    State& s = *state_;
    if (s.asset == &structure.asset()) {
        s.keepMotion();
    } else {
        s.known.clear();
    }
    s.asset = &structure.asset();
    s.bonds.reset(structure, fragments);
    s.equilibrium.reset(s.bonds.network());
    s.bodies.clear();
    s.bodies.reserve(s.bonds.fragments().size());
    for (const uint32_t f : s.bonds.fragments()) {
        const Fragment& fragment = s.asset->fragment(f);
        s.bodies.push_back({double(fragment.mass), glm::dvec3(fragment.centerOfMass)});
    }
    s.forces.assign(s.bodies.size(), {});
    s.load.assign(s.bodies.size(), {});
    s.recallMotion();
    s.carried.clear();
    s.carried.reserve(s.bonds.links().size());
    s.linkOf.assign(structure.graph().bonds().size(), BondNetwork::kNone);
    for (const BondNetwork::Link& link : s.bonds.links()) {
        s.linkOf[link.bond] = uint32_t(s.carried.size());
        s.carried.push_back({{}, resistanceOf(structure, link.bond, options), 0});
    }
    s.overloaded.clear();
    s.overloaded.reserve(s.carried.size());
    s.known.reserve(s.bodies.size());  // for the next time
    s.loadChanged = true;
    s.isEvaluated = false;
}

bool StressSolver::setGravity(const glm::vec3& acceleration) {
    if (!isFinite(acceleration)) return false;
    state_->gravity = glm::dvec3(acceleration);
    state_->loadChanged = true;
    return true;
}

void StressSolver::clearForces() {
    std::fill(state_->forces.begin(), state_->forces.end(), Screw{});
    state_->loadChanged = true;
}

bool StressSolver::addForce(uint32_t fragment, const glm::vec3& force) {
    const uint32_t node = state_->bonds.nodeOf(fragment);
    if (node == BondNetwork::kNone || !isFinite(force)) return false;
    state_->forces[node].linear += glm::dvec3(force);
    state_->loadChanged = true;
    return true;
}

bool StressSolver::addForce(uint32_t fragment, const glm::vec3& force, const glm::vec3& point) {
    if (!isFinite(point) || !addForce(fragment, force)) return false;
    const uint32_t node = state_->bonds.nodeOf(fragment);
    const glm::dvec3 arm = glm::dvec3(point) - state_->bodies[node].center;
    state_->forces[node].angular += glm::cross(arm, glm::dvec3(force));
    return true;
}

bool StressSolver::step(uint32_t maxIterations) {
    state_->updateLoad();
    if (state_->equilibrium.step(maxIterations) && !state_->isEvaluated) state_->evaluate();
    return isConverged();
}

bool StressSolver::isConverged() const {
    return !state_->loadChanged && state_->isEvaluated;
}

double StressSolver::residual() const {
    return state_->equilibrium.residual();
}

uint32_t StressSolver::iterationCount() const {
    return state_->equilibrium.iterationCount();
}

float StressSolver::overload(uint32_t bond) const {
    const State::Carried* carried = state_->find(bond);
    return carried ? carried->overload : 0;
}

BondForce StressSolver::force(uint32_t bond) const {
    const State::Carried* carried = state_->find(bond);
    if (!carried) return {};
    return {glm::vec3(carried->onA.linear), glm::vec3(carried->onA.angular)};
}

std::span<const OverloadedBond> StressSolver::overloaded() const {
    return state_->overloaded;
}

bool breakOverloaded(Structure& structure, const StressSolver& solver, uint32_t maxBonds,
                     Vector<uint32_t>& broken) {
    broken.clear();
    for (const OverloadedBond& worst : solver.overloaded()) {
        if (broken.size() >= maxBonds) break;
        if (structure.isBroken(worst.bond)) continue;
        structure.breakBond(worst.bond);
        broken.push_back(worst.bond);
    }
    return !broken.empty();
}

}  // namespace sherd
