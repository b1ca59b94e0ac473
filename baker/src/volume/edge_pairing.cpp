// SPDX-License-Identifier: MIT
#include "volume/edge_pairing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace sherd {
namespace {

class Pairing {
  public:
    explicit Pairing(const PairingInput& input)
        : input_(input),
          pairs_{std::vector<uint32_t>(3 * input.triangles.size(), EdgePairs::kNone), {}} {}

    EdgePairs run() {
        sortUses();
        for (size_t v = 0; v + 1 < start_.size(); ++v) pairAt(start_[v], start_[v + 1]);
        return std::move(pairs_);
    }

  private:
    /// Of an edge, by the half edge that is it; `forward`: from the lower vertex to the higher.
    struct Use {
        uint32_t high, halfEdge;
        bool forward;
    };

    uint32_t corner(uint32_t halfEdge, uint32_t k) const {
        return input_.triangles[halfEdge / 3][(halfEdge % 3 + k) % 3];
    }

    /// By lower vertex: few each, so that sorting these is quick.
    void sortUses() {
        uint32_t count = 0;
        for (const auto& t : input_.triangles)
            count = std::max({count, t[0] + 1, t[1] + 1, t[2] + 1});
        start_.assign(size_t{count} + 1, 0);
        for (uint32_t h = 0; h < pairs_.twins.size(); ++h)
            ++start_[std::min(corner(h, 0), corner(h, 1)) + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
        uses_.resize(pairs_.twins.size());
        for (uint32_t h = 0; h < uses_.size(); ++h) {
            const uint32_t a = corner(h, 0), b = corner(h, 1);
            uses_[next[std::min(a, b)]++] = {std::max(a, b), h, a < b};
        }
    }

    void pairAt(size_t first, size_t last) {
        const auto begin = uses_.begin();
        std::sort(begin + static_cast<int64_t>(first), begin + static_cast<int64_t>(last),
                  [](const Use& a, const Use& b) {
                      return a.high != b.high ? a.high < b.high : a.halfEdge < b.halfEdge;
                  });
        for (size_t i = first; i < last;) {
            size_t end = i;
            while (end < last && uses_[end].high == uses_[i].high) ++end;
            if (end - i == 2)
                join(uses_[i], uses_[i + 1]);
            else
                pairMany({uses_.begin() + static_cast<int64_t>(i),
                          uses_.begin() + static_cast<int64_t>(end)});
            i = end;
        }
    }

    void join(const Use& a, const Use& b) {
        if (a.forward == b.forward) return;
        pairs_.twins[a.halfEdge] = b.halfEdge;
        pairs_.twins[b.halfEdge] = a.halfEdge;
    }

    void pairMany(std::vector<Use> uses) {
        for (const Use& u : uses)
            if (u.forward) pairs_.repeated.push_back(u.halfEdge);
        for (const uint64_t mask : {UINT64_MAX, uint64_t{UINT32_MAX}}) {
            for (size_t i = 0; i < uses.size(); ++i) {
                for (size_t j = 0; j < i && isFree(uses[i]); ++j) {
                    const uint64_t sheet = input_.sheet(uses[i].halfEdge / 3) & mask;
                    const bool same = (input_.sheet(uses[j].halfEdge / 3) & mask) == sheet;
                    if (sheet != 0 && same && isFree(uses[j])) join(uses[i], uses[j]);
                }
            }
        }
        std::erase_if(uses, [this](const Use& u) { return !isFree(u); });
        if (!uses.empty()) pairAround(uses);
    }
    bool isFree(const Use& u) const { return pairs_.twins[u.halfEdge] == EdgePairs::kNone; }

    /// Going round the edge against the clock, seen against its direction, the inside begins after
    /// a backward use and ends at a forward one.
    void pairAround(const std::vector<Use>& uses) {
        std::vector<std::pair<double, Use>> placed;
        placed.reserve(uses.size());
        for (const Use& u : uses) placed.emplace_back(angleOf(u, uses[0]), u);
        std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first < b.first : a.second.forward > b.second.forward;
        });
        std::vector<Use> begun;
        for (int round = 0; round < 2; ++round) {  // what begins last may end first
            for (const auto& [angle, use] : placed) {
                if (!isFree(use)) continue;
                if (!use.forward) {
                    if (round == 0) begun.push_back(use);
                } else if (!begun.empty()) {
                    join(begun.back(), use);
                    begun.pop_back();
                }
            }
        }
    }

    /// Of a triangle around its edge, counted from another's.
    double angleOf(const Use& use, const Use& from) const {
        const uint32_t a = corner(use.halfEdge, 0), b = corner(use.halfEdge, 1);
        const glm::dvec3 low = input_.position(std::min(a, b));
        const glm::dvec3 along = glm::dvec3(input_.position(std::max(a, b))) - low;
        const double length2 = std::max(glm::dot(along, along), 1e-300);
        const auto across = [&](const Use& u) {
            const glm::dvec3 apex = glm::dvec3(input_.position(corner(u.halfEdge, 2))) - low;
            return apex - along * (glm::dot(apex, along) / length2);
        };
        const glm::dvec3 right = across(from);
        const glm::dvec3 up = glm::cross(along, right) / std::sqrt(length2);
        const glm::dvec3 d = across(use);
        return std::atan2(glm::dot(d, up), glm::dot(d, right));
    }

    const PairingInput& input_;
    EdgePairs pairs_;
    std::vector<uint32_t> start_;  ///< per vertex: its first use
    std::vector<Use> uses_;
};

}  // namespace

EdgePairs pairEdges(const PairingInput& input) {
    return Pairing(input).run();
}

}  // namespace sherd
