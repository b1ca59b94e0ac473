// SPDX-License-Identifier: MIT
#include "solid/fan_repair.h"

#include <algorithm>
#include <limits>

#include "solid/edge_key.h"

namespace sherd {
namespace {

using Tetra = TetraComplex::Tetra;

/// The face by which one comes from tetrahedron `from` over its face `out` into `other`.
size_t entryFace(const Tetra& from, uint32_t number, size_t out, const Tetra& other) {
    size_t entry = 4;
    for (size_t k = 0; k < 4; ++k) {
        if (other.across[k] != number) continue;
        const auto shared = std::find(from.v.begin(), from.v.end(), other.v[k]);
        const bool isOnFace =
            shared != from.v.end() && static_cast<size_t>(shared - from.v.begin()) != out;
        if (entry == 4 || !isOnFace) entry = k;
    }
    return entry;
}

}  // namespace

FanRepair::FanRepair(const TetraComplex& complex, const Components& pieces,
                     std::span<const uint8_t> fixed, std::span<uint32_t> piece)
    : complex_(complex),
      pieces_(pieces),
      fixed_(fixed),
      piece_(piece),
      ringsAt_(complex.tetras.size()) {
    findRings();
    for (uint32_t ring = 0; ring < rings_.size(); ++ring)
        for (const uint32_t t : ringOf(ring)) ringsAt_[t].push_back(ring);
}

uint32_t FanRepair::run() {
    constexpr int kSweeps = 30;
    uint32_t left = 0;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        left = 0;
        for (uint32_t ring = 0; ring < rings_.size(); ++ring)
            if (!repair(ringOf(ring))) ++left;
        if (left == 0) break;
    }
    return left;
}

void FanRepair::findRings() {
    std::vector<std::pair<uint64_t, uint32_t>> edges;
    edges.reserve(6 * complex_.tetras.size());
    for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
        const auto& v = complex_.tetras[t].v;
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = i + 1; j < 4; ++j) edges.emplace_back(edgeKey(v[i], v[j]), t);
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i].first == edges[i - 1].first) continue;
        follow(edges[i].second, static_cast<uint32_t>(edges[i].first >> 32),
               static_cast<uint32_t>(edges[i].first));
    }
}

/// Around the edge a b. What is on the skin has no ring: there pieces are as the surface has them.
void FanRepair::follow(uint32_t start, uint32_t a, uint32_t b) {
    constexpr size_t kLongest = 10'000;
    const size_t first = members_.size();
    uint32_t t = start;
    size_t came = 4;
    do {
        members_.push_back(t);
        const Tetra& tetra = complex_.tetras[t];
        size_t out = 4;
        for (size_t k = 0; k < 4 && out == 4; ++k)
            if (tetra.v[k] != a && tetra.v[k] != b && k != came) out = k;
        const uint32_t across = out < 4 ? tetra.across[out] : kNone;
        if (across == kNone) {
            members_.resize(first);
            return;
        }
        came = entryFace(tetra, t, out, complex_.tetras[across]);
        t = across;
    } while (t != start && members_.size() - first < kLongest);
    rings_.emplace_back(static_cast<uint32_t>(first),
                        static_cast<uint32_t>(members_.size() - first));
}

FanRepair::Ring FanRepair::ringOf(uint32_t number) const {
    return Ring(members_).subspan(rings_[number].first, rings_[number].second);
}

/// How many fans there are too many, over all levels: each fragment is to have one.
uint32_t FanRepair::excess(Ring ring) const {
    size_t turns = 0;
    for (size_t i = 0; i < ring.size(); ++i)
        turns += piece_[ring[i]] != piece_[ring[(i + 1) % ring.size()]] ? 1 : 0;
    if (turns < 4) return 0;
    uint32_t sum = 0;
    for (uint32_t level = pieces_.levels; level > 0; --level) sum += excessAt(level, ring);
    return sum;
}

uint32_t FanRepair::excessAt(uint32_t level, Ring ring) const {
    std::vector<uint32_t> starts;
    for (size_t i = 0; i < ring.size(); ++i) {
        const uint32_t here = pieces_.at(level, piece_[ring[i]]);
        const uint32_t before =
            pieces_.at(level, piece_[ring[(i + ring.size() - 1) % ring.size()]]);
        if (here != before) starts.push_back(here);
    }
    const size_t runs = starts.size();
    std::sort(starts.begin(), starts.end());
    const auto distinct = std::unique(starts.begin(), starts.end()) - starts.begin();
    return static_cast<uint32_t>(runs - static_cast<size_t>(distinct));
}

/// Whether the ring is good; if not, the best move is made: that which leaves least to repair
/// around, or of several a random one, lest moves go round in circles.
bool FanRepair::repair(Ring ring) {
    if (excess(ring) == 0) return true;
    int64_t least = std::numeric_limits<int64_t>::max();
    std::vector<Move> best;
    for (Move& move : movesOf(ring)) {
        const int64_t change = changeBy(move);
        if (change > least) continue;
        if (change < least) best.clear();
        least = change;
        best.push_back(std::move(move));
    }
    if (best.empty()) return false;
    const Move& chosen = best[random_() % best.size()];
    for (const uint32_t t : chosen.tetras) piece_[t] = chosen.to;
    return false;
}

/// Every run of one piece that may change hands, to the piece before or after it.
std::vector<FanRepair::Move> FanRepair::movesOf(Ring ring) const {
    std::vector<Move> moves;
    const size_t n = ring.size();
    const auto at = [&](size_t i) { return piece_[ring[i % n]]; };
    for (size_t i = 0; i < n; ++i) {
        if (at(i) == at(i + n - 1)) continue;
        Move move;
        bool free = true;
        size_t end = i;
        for (; at(end) == at(i); ++end) {
            free = free && fixed_[ring[end % n]] == 0;
            move.tetras.push_back(ring[end % n]);
        }
        if (!free) continue;
        for (const uint32_t to : {at(i + n - 1), at(end)}) {
            move.to = to;
            moves.push_back(move);
        }
    }
    return moves;
}

int64_t FanRepair::changeBy(const Move& move) {
    std::vector<uint32_t> near;
    for (const uint32_t t : move.tetras)
        near.insert(near.end(), ringsAt_[t].begin(), ringsAt_[t].end());
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    const auto sum = [&] {
        int64_t all = 0;
        for (const uint32_t ring : near) all += excess(ringOf(ring));
        return all;
    };
    const int64_t before = sum();
    std::vector<uint32_t> kept;
    for (const uint32_t t : move.tetras) {
        kept.push_back(piece_[t]);
        piece_[t] = move.to;
    }
    const int64_t after = sum();
    for (size_t i = 0; i < kept.size(); ++i) piece_[move.tetras[i]] = kept[i];
    return after - before;
}

}  // namespace sherd
