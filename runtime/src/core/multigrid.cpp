// SPDX-License-Identifier: MIT
// Aggregation multigrid with rigid aggregates, and the K-cycle that makes up for their being too
// stiff: Y. Notay, P. S. Vassilevski, "Recursive Krylov-based multigrid cycles", Numer. Linear
// Algebra Appl. 15 (2008). Aggregates come from the bonds, not from the baked hierarchy: many
// objects have one level only. Measured, iterations to 1e-5 under weight, areas 1:100 at random
// where "rough":
//                          diagonal blocks only    V-cycle    W-cycle    K-cycle
//   chain of 200, level                    1574        189        140         99
//   wall 100 x 50                           333         49         20         13
//   wall 100 x 50, rough                  >5000        489        182         70
//   tower 5 x 200 x 5, rough              >5000        306         99         35
// at 1, 4, 6 and 7 times the price of an iteration.
#include "core/multigrid.h"

#include <algorithm>

#include "core/cholesky.h"

namespace sherd {
namespace {

constexpr uint32_t kSmall = 12;      // nodes: solved directly
constexpr uint32_t kMaxLevels = 24;  // each has half the nodes at most, a quarter as a rule
constexpr double kDamping = 0.6;     // an edge has two ends, so D^-1 K has no eigenvalue above 2

void scale(std::span<Screw> x, double factor) {
    for (Screw& s : x) {
        s.linear *= factor;
        s.angular *= factor;
    }
}

/// One step of damped block Jacobi from z = 0.
void smoothFirst(std::span<const Stiffness> inverse, std::span<const Screw> r, std::span<Screw> z) {
    for (size_t i = 0; i < r.size(); ++i) z[i] = inverse[i] * r[i];
    scale(z, kDamping);
}

/// And one from any z.
void smooth(const ElasticNetwork& network, std::span<const Stiffness> inverse,
            std::span<const Screw> r, std::span<Screw> rest, std::span<Screw> z) {
    std::copy(r.begin(), r.end(), rest.begin());
    subtractProduct(network, z, rest);
    for (size_t i = 0; i < r.size(); ++i) {
        const Screw step = inverse[i] * rest[i];
        z[i].linear += kDamping * step.linear;
        z[i].angular += kDamping * step.angular;
    }
}

}  // namespace

void Multigrid::reset(const ElasticNetwork& network) {
    if (levels_.empty()) levels_.resize(kMaxLevels);
    levels_[0].network = &network;
    levelCount_ = 1;
    stage_ = Stage::diagonal;
    reserve(network);
}

void Multigrid::reserve(const ElasticNetwork& network) {
    size_t nodes = network.nodeCount(), edges = network.edges.size();
    aggregation_.reserve(nodes, edges);
    pairs_.centers.reserve(nodes);
    pairs_.edges.reserve(edges);
    pairOf_.reserve(nodes);
    factor_.reserve(36 * kSmall * kSmall);
    dense_.reserve(6 * kSmall);
    for (uint32_t l = 0; l < kMaxLevels && nodes > 0; ++l) {
        Level& level = levels_[l];
        level.inverse.reserve(nodes);
        level.aggregateOf.reserve(nodes);
        level.rest.reserve(nodes);
        if (l > 0) {
            level.own.centers.reserve(nodes);
            level.own.edges.reserve(edges);
            for (auto* scratch : {&level.load, &level.motion, &level.first, &level.second,
                                  &level.firstProduct, &level.secondProduct})
                scratch->reserve(nodes);
        }
        if (nodes <= kSmall) break;
        nodes /= 2;
        edges = edges - edges / 4;  // of grids a quarter is left, of Voronoi cells less than half
    }
}

void Multigrid::prepare() {
    // All the coarse levels together are no more than the first.
    do advance();
    while (levelCount_ > 1 && stage_ != Stage::ready);
}

void Multigrid::advance() {
    Level& fine = levels_[levelCount_ - 1];
    const ElasticNetwork& network = *fine.network;
    const uint32_t count = network.nodeCount();
    switch (stage_) {
        case Stage::diagonal:
            invertDiagonal(network, fine.inverse);
            fine.rest.assign(count, {});
            if (levelCount_ > 1) {
                for (auto* scratch : {&fine.load, &fine.motion, &fine.first, &fine.second,
                                      &fine.firstProduct, &fine.secondProduct})
                    scratch->assign(count, {});
            }
            stage_ = Stage::pairs;
            if (count <= kSmall || levelCount_ == kMaxLevels) factorCoarsest();
            break;
        case Stage::pairs:
            aggregation_.merge(network, pairOf_, aggregation_.pairUp(network, pairOf_), pairs_);
            stage_ = Stage::fours;
            break;
        case Stage::fours: {
            const uint32_t fours = aggregation_.pairUp(pairs_, fine.aggregateOf);
            if (fours > count / 2) {  // hardly anything holds together but with the ground
                factorCoarsest();
                break;
            }
            Level& coarse = levels_[levelCount_];
            aggregation_.merge(pairs_, fine.aggregateOf, fours, coarse.own);
            coarse.network = &coarse.own;
            for (uint32_t& pair : pairOf_) pair = fine.aggregateOf[pair];
            fine.aggregateOf.assign(pairOf_.begin(), pairOf_.end());
            ++levelCount_;
            stage_ = Stage::diagonal;
            break;
        }
        case Stage::ready:
            break;
    }
}

void Multigrid::factorCoarsest() {
    stage_ = Stage::ready;
    const ElasticNetwork& network = *levels_[levelCount_ - 1].network;
    const uint32_t count = network.nodeCount(), n = 6 * count;
    factor_.clear();
    if (count > kSmall) return;
    factor_.assign(size_t(n) * n, 0);
    dense_.assign(n, 0);
    addDense(network, factor_.data());
    factorCholesky(factor_.data(), n);
}

void Multigrid::solveCoarsest(std::span<const Screw> r, std::span<Screw> z) {
    if (factor_.empty()) {
        smoothFirst(levels_[levelCount_ - 1].inverse, r, z);
        return;
    }
    for (size_t i = 0; i < r.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            dense_[6 * i + size_t(k)] = r[i].linear[k];
            dense_[6 * i + 3 + size_t(k)] = r[i].angular[k];
        }
    }
    solveCholesky(factor_.data(), uint32_t(dense_.size()), dense_.data());
    for (size_t i = 0; i < r.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            z[i].linear[k] = dense_[6 * i + size_t(k)];
            z[i].angular[k] = dense_[6 * i + 3 + size_t(k)];
        }
    }
}

void Multigrid::cycle(uint32_t l, std::span<const Screw> r, std::span<Screw> z) {
    if (l + 1 == levelCount_) {
        solveCoarsest(r, z);
        return;
    }
    Level& level = levels_[l];
    smoothFirst(level.inverse, r, z);
    std::copy(r.begin(), r.end(), level.rest.begin());
    subtractProduct(*level.network, z, level.rest);
    restrictTo(l + 1);
    solve(l + 1);
    prolongFrom(l + 1, z);
    smooth(*level.network, level.inverse, r, level.rest, z);
}

/// The load of the level from what the finer one has left.
void Multigrid::restrictTo(uint32_t l) {
    const Level& fine = levels_[l - 1];
    Level& coarse = levels_[l];
    std::fill(coarse.load.begin(), coarse.load.end(), Screw{});
    for (uint32_t i = 0; i < fine.rest.size(); ++i) {
        const uint32_t c = fine.aggregateOf[i];
        const glm::dvec3 arm = fine.network->centers[i] - coarse.own.centers[c];
        const Screw wrench = wrenchFrom(fine.rest[i], arm);
        coarse.load[c].linear += wrench.linear;
        coarse.load[c].angular += wrench.angular;
    }
}

/// Adds the motion of the level to the finer one's.
void Multigrid::prolongFrom(uint32_t l, std::span<Screw> z) const {
    const Level& fine = levels_[l - 1];
    const Level& coarse = levels_[l];
    for (uint32_t i = 0; i < z.size(); ++i) {
        const uint32_t c = fine.aggregateOf[i];
        const glm::dvec3 arm = fine.network->centers[i] - coarse.own.centers[c];
        const Screw twist = twistAt(coarse.motion[c], arm);
        z[i].linear += twist.linear;
        z[i].angular += twist.angular;
    }
}

/// A coarse level's motion from its load: algorithm 3.2 of Notay (2010), at most two steps of
/// conjugate gradients with the cycle from here on as their preconditioner.
void Multigrid::solve(uint32_t l) {
    constexpr double kEnough = 0.25 * 0.25;  // of the load, squared, after the first step
    Level& level = levels_[l];
    if (l + 1 == levelCount_) {
        solveCoarsest(level.load, level.motion);
        return;
    }
    std::fill(level.motion.begin(), level.motion.end(), Screw{});
    cycle(l, level.load, level.first);
    multiply(*level.network, level.first, level.firstProduct);
    const double curvature = dot(level.first, level.firstProduct);
    if (!(curvature > 0)) return;
    const double before = dot(level.load, level.load);
    const double stride = dot(level.first, level.load) / curvature;
    addScaled(level.motion, stride, level.first);
    addScaled(level.load, -stride, level.firstProduct);
    if (dot(level.load, level.load) <= kEnough * before) return;

    cycle(l, level.load, level.second);
    multiply(*level.network, level.second, level.secondProduct);
    const double overlap = dot(level.second, level.firstProduct) / curvature;
    const double rest = dot(level.second, level.secondProduct) - overlap * overlap * curvature;
    if (!(rest > 0)) return;
    const double secondStride = dot(level.second, level.load) / rest;
    addScaled(level.motion, -secondStride * overlap, level.first);
    addScaled(level.motion, secondStride, level.second);
}

}  // namespace sherd
