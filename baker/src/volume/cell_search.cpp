// SPDX-License-Identifier: MIT
#include "volume/cell_search.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sherd {
namespace {

/// What corners' positions may be off by, and more, in grid steps.
constexpr double kSlack = 1e-3;

double atPlace(const LinearFunction& f, const glm::dvec3& p) {
    return static_cast<double>(f.x) * p.x + static_cast<double>(f.y) * p.y +
           static_cast<double>(f.z) * p.z + static_cast<double>(f.c);
}

}  // namespace

CellSearch::CellSearch(const CellFunctions& functions, const CutBox& box)
    : functions_(functions), box_(box) {
    const auto& families = functions.families();
    if (families.size() != 1 || families[0].sites.empty()) return;
    for (const glm::dvec3& s : families[0].sites) sites_.push_back(s * families[0].metric);
    shells_.emplace(sites_);
}

const ConvexCell& CellSearch::cell(uint32_t i) {
    cell_.start(i, box_);
    measure();
    if (shells_) {
        cutBySites(i);
    } else {
        cutByMembers(i);
        if (functions_.families().size() > 1 && !cell_.empty()) cutByOverlays(i);
    }
    return cell_;
}

void CellSearch::measure() {
    if (cell_.empty()) return;
    low_ = high_ = cell_.corners()[cell_.usedCorners()[0]].position;
    for (const uint32_t v : cell_.usedCorners()) {
        low_ = glm::min(low_, cell_.corners()[v].position);
        high_ = glm::max(high_, cell_.corners()[v].position);
    }
}

/// False if the plane is beyond doubt positive in all of the cell's bounds.
bool CellSearch::mayReach(const LinearFunction& plane) const {
    double lowest = static_cast<double>(plane.c);
    double size = std::abs(lowest);
    const auto add = [&](int64_t slope, double low, double high) {
        const auto s = static_cast<double>(slope);
        lowest += std::min(s * low, s * high);
        size += std::abs(s) * 0x1p26;
    };
    add(plane.x, low_.x, high_.x);
    add(plane.y, low_.y, high_.y);
    add(plane.z, low_.z, high_.z);
    return lowest <= kSlack * slopeOf(plane) + 0x1p-48 * size;
}

bool CellSearch::cutBy(uint32_t i, uint32_t l) {
    const LinearFunction plane = functions_[l] - functions_[i];
    if (!mayReach(plane) || !cell_.clip(plane, l)) return false;
    measure();
    return true;
}

/// A site cuts a corner off only if it is nearer to it than the cell's own: it is at most twice as
/// far from that as the farthest corner is. Weights, small as they are, and slack add to it.
void CellSearch::cutBySites(uint32_t i) {
    const glm::dvec3& metric = functions_.families()[0].metric;
    double reach = 0;
    const auto measureReach = [&] {
        double farthest = 0;
        for (const uint32_t v : cell_.usedCorners()) {
            const glm::dvec3 d = cell_.corners()[v].position * metric - sites_[i];
            farthest = std::max(farthest, glm::dot(d, d));
        }
        reach = cell_.empty() ? -1 : 2 * std::sqrt(farthest) * (1 + 1e-5) + 1;
    };
    measureReach();
    shells_->around(
        i, [&] { return reach; },
        [&](uint32_t l) {
            if (!cell_.empty() && cutBy(i, l)) measureReach();
        });
}

/// By the cells that differ in one family only, those of near numbers first.
void CellSearch::cutByMembers(uint32_t i) {
    for (size_t f = 0; f < functions_.families().size(); ++f) {
        const auto count = static_cast<int64_t>(functions_.families()[f].functions.size());
        const int64_t own = functions_.member(i, f);
        for (int64_t away = 1; away < count; ++away) {
            for (const int64_t m : {own - away, own + away}) {
                if (m < 0 || m >= count) continue;
                cutBy(i, static_cast<uint32_t>(i + (m - own) * functions_.stride(f)));
                if (cell_.empty()) return;
            }
        }
    }
}

std::vector<uint32_t> CellSearch::touching(uint32_t i, size_t f) const {
    std::vector<uint32_t> result;
    const std::vector<LinearFunction>& members = functions_.families()[f].functions;
    const uint32_t own = functions_.member(i, f);
    for (uint32_t m = 0; m < members.size(); ++m) {
        const LinearFunction plane = members[m] - members[own];
        if (m == own || !mayReach(plane)) continue;
        const double slack = kSlack * (slopeOf(plane) + 1);
        if (std::any_of(cell_.usedCorners().begin(), cell_.usedCorners().end(), [&](uint32_t v) {
                return atPlace(plane, cell_.corners()[v].position) <= slack;
            })) {
            result.push_back(m);
        }
    }
    return result;
}

/// By the cells that differ in several families. Where planes of several meet, more than four
/// cells do, and the tie may make neighbours of any two of them.
void CellSearch::cutByOverlays(uint32_t i) {
    struct Other {
        uint32_t cell;
        uint32_t differs;  ///< in how many families
    };
    std::vector<Other> others{{i, 0}};
    for (size_t f = 0; f < functions_.families().size(); ++f) {
        const uint32_t own = functions_.member(i, f);
        const size_t before = others.size();
        for (const uint32_t m : touching(i, f)) {
            for (size_t k = 0; k < before; ++k) {
                const uint32_t cell = others[k].cell - own * functions_.stride(f);
                others.push_back({cell + m * functions_.stride(f), others[k].differs + 1});
            }
        }
    }
    for (const Other& other : others) {
        if (other.differs > 1 && !cell_.empty()) cutBy(i, other.cell);
    }
}

}  // namespace sherd
