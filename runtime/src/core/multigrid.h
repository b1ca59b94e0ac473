// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/aggregation.h"
#include "core/elastic_network.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Approximate inverses of an elastic network's K: a preconditioner. Keeps its memory.
class Multigrid {
  public:
    /// For a network that stays where it is and as it is.
    void reset(const ElasticNetwork& network);
    /// Gets ready, in a few calls of about the price of `apply`. They take no memory.
    void prepare();
    [[nodiscard]] bool isReady() const { return stage_ == Stage::ready; }

    /// z ~ K^-1 r. Nearly linear in r: the coarse solutions are conjugate gradients of two steps.
    void apply(std::span<const Screw> r, std::span<Screw> z) { cycle(0, r, z); }

  private:
    struct Level {
        const ElasticNetwork* network = nullptr;
        ElasticNetwork own;            ///< of the coarse levels
        Vector<Stiffness> inverse;     ///< of the diagonal blocks
        Vector<uint32_t> aggregateOf;  ///< per node, a node of the next level
        Vector<Screw> rest;
        // Of the coarse levels: what is to be solved there, and the two steps that do.
        Vector<Screw> load, motion, first, firstProduct, second, secondProduct;
    };
    enum class Stage { diagonal, pairs, fours, ready };

    void advance();
    void reserve(const ElasticNetwork& network);
    void factorCoarsest();

    void cycle(uint32_t l, std::span<const Screw> r, std::span<Screw> z);
    void solve(uint32_t l);
    void solveCoarsest(std::span<const Screw> r, std::span<Screw> z);
    void restrictTo(uint32_t l);
    void prolongFrom(uint32_t l, std::span<Screw> z) const;

    Vector<Level> levels_;
    uint32_t levelCount_ = 0;
    Stage stage_ = Stage::diagonal;
    Vector<double> factor_;  ///< of the coarsest level where it is small, else empty
    Vector<double> dense_;
    Aggregation aggregation_;
    ElasticNetwork pairs_;
    Vector<uint32_t> pairOf_;
};

}  // namespace sherd
