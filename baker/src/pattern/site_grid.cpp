// SPDX-License-Identifier: MIT
#include "pattern/site_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <queue>

namespace sherd {
namespace {

int64_t along(const SitePoint& p, uint8_t axis) {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

constexpr uint32_t kLeaf = 8;

}  // namespace

SiteGrid::SiteGrid(std::span<const glm::vec3> positions, const glm::dvec3& axis, double stretch)
    : axis_(axis), shrink_(1 / stretch - 1) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(std::numeric_limits<double>::lowest());
    for (const glm::vec3& p : positions) {
        low = glm::min(low, drawn(p));
        high = glm::max(high, drawn(p));
    }
    low_ = low;
    const glm::dvec3 size = high - low;
    const double extent = std::max({size.x, size.y, size.z});
    int exponent = 0;
    std::frexp(extent, &exponent);  // extent < 2^exponent
    scale_ = extent > 0 ? std::ldexp(1.0, 26 - exponent) : 1;
}

glm::dvec3 SiteGrid::drawn(const glm::dvec3& p) const {
    return p + axis_ * (shrink_ * glm::dot(axis_, p));
}

glm::dvec3 SiteGrid::place(const glm::dvec3& position) const {
    return (drawn(position) - low_) * scale_;
}

SitePoint SiteGrid::snap(const glm::dvec3& position) const {
    const glm::dvec3 p = place(position);
    const auto round = [](double x) {
        return std::clamp<int64_t>(std::llround(x), 0, int64_t{1} << 26);
    };
    return {round(p.x), round(p.y), round(p.z)};
}

SiteTree::SiteTree(std::span<const SitePoint> sites)
    : sites_(sites.begin(), sites.end()), order_(sites.size()), axis_(sites.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0U);
    build(0, static_cast<uint32_t>(order_.size()));
}

void SiteTree::build(uint32_t first, uint32_t last) {
    if (last - first <= kLeaf) return;
    std::array<int64_t, 3> low{};
    std::array<int64_t, 3> high{};
    for (uint8_t a = 0; a < 3; ++a) {
        low[a] = high[a] = along(sites_[order_[first]], a);
        for (uint32_t i = first; i < last; ++i) {
            low[a] = std::min(low[a], along(sites_[order_[i]], a));
            high[a] = std::max(high[a], along(sites_[order_[i]], a));
        }
    }
    uint8_t axis = 0;
    for (uint8_t a = 1; a < 3; ++a)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](uint32_t x, uint32_t y) {
                         return std::pair(along(sites_[x], axis), x) <
                                std::pair(along(sites_[y], axis), y);
                     });
    axis_[middle] = axis;
    build(first, middle);
    build(middle + 1, last);
}

/// visit(site) returns the squared distance beyond which nothing matters any more.
template <class Visit>
void SiteTree::visit(uint32_t first, uint32_t last, const SitePoint& point, Visit&& visit) const {
    if (last - first <= kLeaf) {
        for (uint32_t i = first; i < last; ++i) visit(order_[i]);
        return;
    }
    const uint32_t middle = first + (last - first) / 2;
    const int64_t side = along(point, axis_[middle]) - along(sites_[order_[middle]], axis_[middle]);
    const bool lowFirst = side < 0;
    const auto low = std::pair(first, middle);
    const auto high = std::pair(middle + 1, last);
    const auto near = lowFirst ? low : high;
    const auto far = lowFirst ? high : low;
    this->visit(near.first, near.second, point, visit);
    // The other half may hold an equally near site with a lower index: hence <=.
    if (side * side <= visit(order_[middle])) this->visit(far.first, far.second, point, visit);
}

uint32_t SiteTree::nearest(const SitePoint& point) const {
    std::pair<int64_t, uint32_t> best{std::numeric_limits<int64_t>::max(), 0};
    visit(0, static_cast<uint32_t>(order_.size()), point, [&](uint32_t site) {
        best = std::min(best, {squaredDistance(sites_[site], point), site});
        return best.first;
    });
    return best.second;
}

std::vector<uint32_t> SiteTree::nearestTo(uint32_t site, size_t count) const {
    std::priority_queue<std::pair<int64_t, uint32_t>> nearest;  // the farthest on top
    count = std::min(count, sites_.size() - 1);
    if (count == 0) return {};
    visit(0, static_cast<uint32_t>(order_.size()), sites_[site], [&](uint32_t other) {
        if (other != site) {
            nearest.push({squaredDistance(sites_[other], sites_[site]), other});
            if (nearest.size() > count) nearest.pop();
        }
        return nearest.size() < count ? std::numeric_limits<int64_t>::max() : nearest.top().first;
    });
    std::vector<uint32_t> result(nearest.size());
    for (size_t i = result.size(); i-- > 0; nearest.pop()) result[i] = nearest.top().second;
    return result;
}

}  // namespace sherd
