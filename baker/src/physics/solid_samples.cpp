// SPDX-License-Identifier: MIT
// Voxels of a solid by columns: every triangle tells the columns it covers where it crosses them.
#include "physics/solid_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "geometry/bounds.h"

namespace sherd {
namespace {

struct Crossing {
    uint32_t column;
    double z;
    int sign;  ///< 1: upwards leads out
};

/// Columns stand a little off the middles of their cells: meshes have edges in round places.
constexpr double kOffX = 0.4837, kOffY = 0.5261;

class Columns {
  public:
    Columns(const SolidChain& solid, uint32_t cells) {
        for (const glm::dvec3& p : solid.points()) box_.add(p);
        const glm::dvec3 size = box_.size();
        const double longest = std::max({size.x, size.y, size.z});
        for (int k = 0; k < 3; ++k) {
            const double share = longest > 0 ? size[k] / longest : 1;
            count_[k] =
                static_cast<uint32_t>(std::max(std::ceil(cells * share), std::ceil(cells / 4.0)));
            step_[k] = size[k] / count_[k];
        }
        for (const auto& t : solid.skin()) {
            const std::array<glm::dvec3, 3> p = {solid.points()[t[0]], solid.points()[t[1]],
                                                 solid.points()[t[2]]};
            cross(p);
        }
        std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
            return a.column != b.column ? a.column < b.column : a.z < b.z;
        });
    }

    std::vector<glm::dvec3> samples() const {
        std::vector<glm::dvec3> out;
        for (size_t first = 0; first < crossings_.size();) {
            size_t last = first;
            while (last < crossings_.size() && crossings_[last].column == crossings_[first].column)
                ++last;
            size_t next = last;
            int winding = 0;
            for (uint32_t k = count_[2]; k-- > 0;) {
                const double z = box_.low.z + (k + 0.5) * step_.z;
                while (next > first && crossings_[next - 1].z > z)
                    winding += crossings_[--next].sign;
                if (winding > 0)
                    out.emplace_back(x(column(first) % count_[0]), y(column(first) / count_[0]), z);
            }
            first = last;
        }
        return out;
    }

  private:
    uint32_t column(size_t crossing) const { return crossings_[crossing].column; }
    double x(uint32_t i) const { return box_.low.x + (i + kOffX) * step_.x; }
    double y(uint32_t j) const { return box_.low.y + (j + kOffY) * step_.y; }

    void cross(const std::array<glm::dvec3, 3>& p) {
        const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (n.z == 0) return;
        const double turn = n.z > 0 ? 1 : -1;
        const auto range = [&](int axis, double off, uint32_t& first, uint32_t& last) {
            const double low = std::min({p[0][axis], p[1][axis], p[2][axis]});
            const double high = std::max({p[0][axis], p[1][axis], p[2][axis]});
            const double scale = step_[axis] > 0 ? 1 / step_[axis] : 0;
            first = static_cast<uint32_t>(
                std::max(0.0, std::ceil((low - box_.low[axis]) * scale - off)));
            const double end = std::floor((high - box_.low[axis]) * scale - off) + 1;
            last = static_cast<uint32_t>(std::clamp(end, 0.0, double(count_[axis])));
        };
        uint32_t i0 = 0, i1 = 0, j0 = 0, j1 = 0;
        range(0, kOffX, i0, i1);
        range(1, kOffY, j0, j1);
        for (uint32_t j = j0; j < j1; ++j) {
            for (uint32_t i = i0; i < i1; ++i) {
                const glm::dvec2 q(x(i), y(j));
                bool within = true;
                for (size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 &a = p[k], &b = p[(k + 1) % 3];
                    within = within &&
                             turn * ((b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x)) > 0;
                }
                if (!within) continue;
                const double z = p[0].z - (n.x * (q.x - p[0].x) + n.y * (q.y - p[0].y)) / n.z;
                crossings_.push_back({j * count_[0] + i, z, n.z > 0 ? 1 : -1});
            }
        }
    }

    Bounds box_;
    std::array<uint32_t, 3> count_{};
    glm::dvec3 step_{0.0};
    std::vector<Crossing> crossings_;
};

}  // namespace

std::vector<glm::dvec3> solidSamples(const SolidChain& solid, uint32_t cells) {
    return Columns(solid, cells).samples();
}

}  // namespace sherd
