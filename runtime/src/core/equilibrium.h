// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/elastic_network.h"
#include "core/multigrid.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Solves K motion = load for an elastic network, to be interrupted at any iteration. Keeps its
/// memory.
class Equilibrium {
  public:
    /// For a network that stays where it is and as it is. The motion is zero, and so is the load.
    void reset(const ElasticNetwork& network);

    [[nodiscard]] std::span<const Screw> load() const { return load_; }
    /// Both start anew, from the motion there is.
    void setLoad(std::span<const Screw> load);
    void setMotion(uint32_t node, const Screw& motion) {
        motion_[node] = motion;
        begin();
    }

    /// At most so many iterations. Returns `isConverged`.
    bool step(uint32_t maxIterations);
    [[nodiscard]] bool isConverged() const { return state_ == State::converged; }
    [[nodiscard]] std::span<const Screw> motion() const { return motion_; }
    [[nodiscard]] double residual() const { return residual_; }
    [[nodiscard]] uint32_t iterationCount() const { return iterationCount_; }

  private:
    enum class State { starting, iterating, converged, stuck };

    void begin();
    void measure();
    void iterate();
    void stop();

    const ElasticNetwork* network_ = nullptr;
    Multigrid multigrid_;
    State state_ = State::stuck;
    uint32_t iterationCount_ = 0;
    double residual_ = 0;      ///< of the load
    double lastMeasured_ = 0;  ///< of the load
    double loadNorm_ = 0;
    double energy_ = 0;  ///< of the last iteration: residual . preconditioned residual; 0: none
    double stride_ = 0;  ///< along the last direction
    Vector<Screw> load_, motion_, rest_, preconditioned_, direction_, product_;
};

}  // namespace sherd
