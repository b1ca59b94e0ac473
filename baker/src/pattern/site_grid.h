// SPDX-License-Identifier: MIT
// Positions on one integer grid, so that distances compare exactly.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// A point of the grid; 0 <= coordinate <= 2^26.
struct SitePoint {
    int64_t x = 0, y = 0, z = 0;
    friend bool operator==(const SitePoint&, const SitePoint&) = default;
};

/// Below 2^54.
inline int64_t squaredDistance(const SitePoint& a, const SitePoint& b) {
    const int64_t x = a.x - b.x;
    const int64_t y = a.y - b.y;
    const int64_t z = a.z - b.z;
    return x * x + y * y + z * z;
}

/// Space drawn together along an axis, then laid on a grid of 2^-26 of its extent. Steps are powers
/// of two, so the same object at twice the size has the same grid points.
class SiteGrid {
  public:
    /// stretch: distances along `axis` (unit length) count 1 / stretch of what they are; axis 0:
    /// plain space.
    SiteGrid(std::span<const glm::vec3> positions, const glm::dvec3& axis, double stretch);

    SitePoint snap(const glm::dvec3& position) const;
    /// Where a position lies in the grid's space, in steps, before it is snapped: a linear map.
    glm::dvec3 place(const glm::dvec3& position) const;

  private:
    glm::dvec3 drawn(const glm::dvec3& p) const;

    glm::dvec3 axis_;
    double shrink_;
    glm::dvec3 low_{0.0};
    double scale_ = 1;
};

/// Which site is nearest, exactly; of equally near ones the first (a perturbation of weights that
/// grow with the index). A kd-tree (Bentley 1975).
class SiteTree {
  public:
    explicit SiteTree(std::span<const SitePoint> sites);

    uint32_t nearest(const SitePoint& point) const;
    /// The `count` nearest to a site, itself left out, nearest first.
    std::vector<uint32_t> nearestTo(uint32_t site, size_t count) const;
    std::span<const SitePoint> sites() const { return sites_; }

  private:
    void build(uint32_t first, uint32_t last);
    template <class Visit>
    void visit(uint32_t first, uint32_t last, const SitePoint& point, Visit&& visit) const;

    std::vector<SitePoint> sites_;
    std::vector<uint32_t> order_;  ///< a median in the middle of every range
    std::vector<uint8_t> axis_;    ///< per place in the order: the axis it splits along
};

}  // namespace sherd
