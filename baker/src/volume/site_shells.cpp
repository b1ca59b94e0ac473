// SPDX-License-Identifier: MIT
#include "volume/site_shells.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "geometry/bounds.h"

namespace sherd {
namespace {

constexpr double kSitesPerCube = 2;
constexpr double kMostCubes = 128;  ///< along an axis

}  // namespace

SiteShells::SiteShells(const std::vector<glm::dvec3>& sites) : sites_(sites) {
    Bounds bounds;
    for (const glm::dvec3& s : sites) bounds.add(s);
    low_ = bounds.low;
    const glm::dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z, 1.0});
    const double volume = std::max(size.x, longest / kMostCubes) *
                          std::max(size.y, longest / kMostCubes) *
                          std::max(size.z, longest / kMostCubes);
    side_ = std::max(std::cbrt(volume * kSitesPerCube / static_cast<double>(sites.size())),
                     longest / kMostCubes);
    count_ = {static_cast<int32_t>(size.x / side_) + 1, static_cast<int32_t>(size.y / side_) + 1,
              static_cast<int32_t>(size.z / side_) + 1};
    const auto index = [&](const glm::dvec3& p) {
        const Cube c = cubeOf(p);
        return (static_cast<size_t>(c.z) * count_.y + c.y) * count_.x + c.x;
    };
    start_.assign(static_cast<size_t>(count_.x) * count_.y * count_.z + 1, 0);
    for (const glm::dvec3& s : sites) ++start_[index(s) + 1];
    for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
    ordered_.resize(sites.size());
    for (uint32_t i = 0; i < sites.size(); ++i) ordered_[next[index(sites[i])]++] = i;
}

SiteShells::Cube SiteShells::cubeOf(const glm::dvec3& p) const {
    const auto along = [&](double x, double low, int32_t count) {
        return std::clamp(static_cast<int32_t>((x - low) / side_), 0, count - 1);
    };
    return {along(p.x, low_.x, count_.x), along(p.y, low_.y, count_.y),
            along(p.z, low_.z, count_.z)};
}

bool SiteShells::collect(uint32_t i, int32_t shell) {
    shell_.clear();
    const Cube c = cubeOf(sites_[i]);
    const auto beyond = [shell](int32_t at, int32_t count) {
        return at - shell < 0 && at + shell >= count;
    };
    if (beyond(c.x, count_.x) && beyond(c.y, count_.y) && beyond(c.z, count_.z)) return false;
    for (int32_t z = std::max(c.z - shell, 0); z <= std::min(c.z + shell, count_.z - 1); ++z) {
        for (int32_t y = std::max(c.y - shell, 0); y <= std::min(c.y + shell, count_.y - 1); ++y) {
            if (std::max(std::abs(z - c.z), std::abs(y - c.y)) == shell) {
                addRow(i, y, z, c.x - shell, c.x + shell);
            } else {
                addRow(i, y, z, c.x - shell, c.x - shell);
                addRow(i, y, z, c.x + shell, c.x + shell);
            }
        }
    }
    std::sort(shell_.begin(), shell_.end());
    return true;
}

void SiteShells::addRow(uint32_t i, int32_t y, int32_t z, int32_t fromX, int32_t toX) {
    fromX = std::max(fromX, 0);
    toX = std::min(toX, count_.x - 1);
    if (fromX > toX) return;
    const size_t row = (static_cast<size_t>(z) * count_.y + y) * count_.x;
    for (uint32_t k = start_[row + fromX]; k < start_[row + toX + 1]; ++k) {
        const uint32_t l = ordered_[k];
        if (l == i) continue;
        const glm::dvec3 d = sites_[l] - sites_[i];
        shell_.emplace_back(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), l);
    }
}

}  // namespace sherd
