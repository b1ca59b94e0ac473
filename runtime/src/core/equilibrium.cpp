// SPDX-License-Identifier: MIT
#include "core/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace sherd {
namespace {

constexpr double kTolerance = 1e-5;          // what may not balance, of the load
constexpr double kRoundingTolerance = 1e-3;  // where rounding forbids better

}  // namespace

void Equilibrium::reset(const ElasticNetwork& network) {
    network_ = &network;
    for (auto* values : {&load_, &motion_, &rest_, &preconditioned_, &direction_, &product_})
        values->assign(network.nodeCount(), {});
    multigrid_.reset(network);
    iterationCount_ = 0;
    loadNorm_ = 0;
    begin();
}

void Equilibrium::setLoad(std::span<const Screw> load) {
    std::copy(load.begin(), load.end(), load_.begin());
    loadNorm_ = std::sqrt(dot(load_, load_));
    begin();
}

void Equilibrium::begin() {
    state_ = State::starting;
    residual_ = 1;
    lastMeasured_ = HUGE_VAL;
}

bool Equilibrium::step(uint32_t maxIterations) {
    if (state_ == State::starting && !(loadNorm_ > 0)) {
        std::fill(motion_.begin(), motion_.end(), Screw{});
        residual_ = 0;
        state_ = State::converged;
    }
    for (uint32_t i = 0; i < maxIterations; ++i) {
        if (state_ == State::converged || state_ == State::stuck) break;
        ++iterationCount_;
        if (!multigrid_.isReady()) {
            multigrid_.prepare();
            continue;
        }
        if (state_ == State::starting) measure();
        if (state_ == State::iterating) iterate();
    }
    return isConverged();
}

/// The residual that iterations keep up to date drifts from the true one: only that one tells.
void Equilibrium::measure() {
    std::copy(load_.begin(), load_.end(), rest_.begin());
    subtractProduct(*network_, motion_, rest_);
    residual_ = std::sqrt(dot(rest_, rest_)) / loadNorm_;
    if (lastMeasured_ == HUGE_VAL && !(residual_ < 1)) {  // that start is worse than none
        std::fill(motion_.begin(), motion_.end(), Screw{});
        std::copy(load_.begin(), load_.end(), rest_.begin());
        residual_ = 1;
    }
    energy_ = 0;
    state_ = State::iterating;
    if (residual_ <= kTolerance) {
        state_ = State::converged;
    } else if (!(residual_ < 0.5 * lastMeasured_)) {
        stop();
    }
    lastMeasured_ = residual_;
}

/// Rounding, or a matrix no longer definite because of it, lets it get no further.
void Equilibrium::stop() {
    state_ = residual_ <= kRoundingTolerance ? State::converged : State::stuck;
}

// M. R. Hestenes, E. Stiefel, "Methods of conjugate gradients for solving linear systems", J. Res.
// NBS 49 (1952). The preconditioner is not quite the same linear one each time, hence Polak and
// Ribiere's step as in Y. Notay, "Flexible conjugate gradients", SIAM J. Sci. Comput. 22 (2000).
void Equilibrium::iterate() {
    multigrid_.apply(rest_, preconditioned_);
    const double energy = dot(rest_, preconditioned_);
    const double turn = energy_ > 0 ? -stride_ * dot(preconditioned_, product_) / energy_ : 0;
    for (size_t i = 0; i < direction_.size(); ++i) {
        direction_[i].linear = preconditioned_[i].linear + turn * direction_[i].linear;
        direction_[i].angular = preconditioned_[i].angular + turn * direction_[i].angular;
    }
    multiply(*network_, direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(energy > 0) || !(curvature > 0)) {
        stop();
        return;
    }
    energy_ = energy;
    stride_ = energy / curvature;
    addScaled(motion_, stride_, direction_);
    addScaled(rest_, -stride_, product_);
    residual_ = std::sqrt(dot(rest_, rest_)) / loadNorm_;
    if (residual_ <= 0.5 * kTolerance) state_ = State::starting;
}

}  // namespace sherd
