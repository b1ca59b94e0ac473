// SPDX-License-Identifier: MIT
#include "physics/solid_chain.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/no_index.h"

namespace sherd {
namespace {

std::vector<double> heightsOf(std::span<const glm::dvec3> points, const HalfSpace& wall) {
    std::vector<double> heights;
    heights.reserve(points.size());
    for (const glm::dvec3& p : points) heights.push_back(glm::dot(wall.normal, p) - wall.offset);
    return heights;
}

}  // namespace

/// One side of a cut in the making.
class SolidChain::Half {
  public:
    /// sign: 1 for the side below the wall, -1 beyond it.
    Half(const SolidChain& whole, std::span<const double> heights, double sign)
        : whole_(whole), heights_(heights), sign_(sign), copied_(whole.points_.size(), kNone) {}

    SolidChain take() {
        for (const auto& t : whole_.skin_) clip(t, out_.skin_);
        out_.skinPoints_ = out_.points_.size();
        for (const auto& t : whole_.caps_) clip(t, out_.caps_);
        for (const auto& [from, to] : rim_)
            if (from != rim_[0].first && to != rim_[0].first)
                out_.caps_.push_back({rim_[0].first, to, from});
        return std::move(out_);
    }

  private:
    uint32_t copy(uint32_t v) {
        if (copied_[v] == kNone) copied_[v] = add(whole_.points_[v]);
        return copied_[v];
    }
    uint32_t add(const glm::dvec3& p) {
        out_.points_.push_back(p);
        return static_cast<uint32_t>(out_.points_.size()) - 1;
    }

    void clip(const std::array<uint32_t, 3>& t, std::vector<std::array<uint32_t, 3>>& to) {
        std::array<uint32_t, 4> loop{};
        size_t count = 0;
        uint32_t leaves = kNone, enters = kNone;  // where the outline goes out and comes back
        // One in the wall itself is part of the cap; one that touches it is not of this side.
        if (!(std::min({sign_ * heights_[t[0]], sign_ * heights_[t[1]], sign_ * heights_[t[2]]}) <
              0))
            return;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            const double ha = sign_ * heights_[a], hb = sign_ * heights_[b];
            if (ha <= 0) loop[count++] = copy(a);
            if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) {
                const uint32_t x = loop[count++] = add(
                    wallCrossing(whole_.points_[a], heights_[a], whole_.points_[b], heights_[b]));
                (hb > 0 ? leaves : enters) = x;
            } else {
                if (ha == 0 && hb >= 0) leaves = copy(a);
                if (ha >= 0 && hb == 0) enters = copy(b);
            }
        }
        for (size_t k = 2; k < count; ++k) to.push_back({loop[0], loop[k - 1], loop[k]});
        if (count > 2 && leaves != kNone && enters != kNone) rim_.emplace_back(leaves, enters);
    }

    const SolidChain& whole_;
    std::span<const double> heights_;
    double sign_;
    std::vector<uint32_t> copied_;
    std::vector<std::pair<uint32_t, uint32_t>> rim_;  ///< along the wall, as triangles go round
    SolidChain out_;
};

std::pair<SolidChain, SolidChain> SolidChain::split(const HalfSpace& wall) const {
    const std::vector<double> heights = heightsOf(points_, wall);
    return {Half(*this, heights, 1).take(), Half(*this, heights, -1).take()};
}

std::pair<std::vector<glm::dvec3>, std::vector<glm::dvec3>> SolidChain::splitPoints(
    const HalfSpace& wall) const {
    const std::vector<double> heights = heightsOf(skinPoints(), wall);
    std::pair<std::vector<glm::dvec3>, std::vector<glm::dvec3>> out;
    // What lies in the wall is of the sides on which its triangles are.
    constexpr uint8_t kBelow = 1, kBeyond = 2;
    std::vector<uint8_t> sides(skinPoints_, 0);
    for (const auto& t : skin_) {
        uint8_t side = 0;
        for (const uint32_t v : t) side |= heights[v] < 0 ? kBelow : (heights[v] > 0 ? kBeyond : 0);
        for (const uint32_t v : t) sides[v] |= side;
    }
    for (size_t i = 0; i < skinPoints_; ++i) {
        if (heights[i] < 0 || (heights[i] == 0 && (sides[i] & kBelow) != 0))
            out.first.push_back(points_[i]);
        if (heights[i] > 0 || (heights[i] == 0 && (sides[i] & kBeyond) != 0))
            out.second.push_back(points_[i]);
    }
    for (const auto& t : skin_) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            // Where the skin ends at a cap an edge is in one triangle only.
            if (!((heights[a] < 0 && heights[b] > 0) || (heights[a] > 0 && heights[b] < 0)))
                continue;
            const glm::dvec3 x = wallCrossing(points_[a], heights[a], points_[b], heights[b]);
            out.first.push_back(x);
            out.second.push_back(x);
        }
    }
    return out;
}

double SolidChain::volume() const {
    if (points_.empty()) return 0;
    const glm::dvec3 apex = points_[0];
    double sum = 0;
    for (const auto* triangles : {&skin_, &caps_})
        for (const auto& t : *triangles)
            sum += glm::dot(points_[t[0]] - apex,
                            glm::cross(points_[t[1]] - apex, points_[t[2]] - apex));
    return sum / 6;
}

}  // namespace sherd
