// SPDX-License-Identifier: MIT
#include "volume/volume_sites.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/bounds.h"
#include "geometry/closed_mesh.h"
#include "geometry/dice.h"
#include "geometry/inside_test.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

constexpr uint32_t kMostSites = 100'000;
constexpr int kTriesPerSite = 2000;
/// Of crowded sites, those that are anywhere.
constexpr double kLonelyShare = 0.1;

using Triangle = std::array<uint32_t, 3>;

class Sampler {
  public:
    Sampler(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
            const VolumeSites& options)
        : positions_(positions),
          triangles_(triangles),
          options_(options),
          inside_(positions, triangles),
          bounds_(boundsOf(positions, triangles)),
          dice_(options.seed) {}

    std::vector<glm::dvec3> run() {
        if (options_.kind == VolumeSites::Kind::lattice) return lattice();
        std::vector<glm::dvec3> sites;
        while (sites.size() < options_.count) sites.push_back(somewhere());
        return sites;
    }

  private:
    glm::dvec3 inBounds() {
        const double x = dice_.unit(), y = dice_.unit(), z = dice_.unit();
        return bounds_.low + bounds_.size() * glm::dvec3(x, y, z);
    }

    /// Normally distributed, nearly: the sum of three even ones per axis (no library's logarithm
    /// has a say in where sites are).
    glm::dvec3 inCrowd() {
        const auto crowd =
            static_cast<size_t>(dice_.unit() * static_cast<double>(options_.around.size()));
        glm::dvec3 p = options_.around[std::min(crowd, options_.around.size() - 1)];
        const double reach = options_.spread * bounds_.diagonal() / std::sqrt(2);
        for (int k = 0; k < 3; ++k)
            for (int n = 0; n < 3; ++n) p[k] += reach * dice_.signedUnit();
        return p;
    }

    glm::dvec3 somewhere() {
        const bool crowded =
            options_.kind == VolumeSites::Kind::crowded && dice_.unit() >= kLonelyShare;
        for (int n = 0; n < kTriesPerSite; ++n) {
            // A crowd around a point outside may be hard to hit.
            const glm::dvec3 p = crowded && n < kTriesPerSite / 2 ? inCrowd() : inBounds();
            if (inside_.inside(p)) return p;
        }
        return onSkin();
    }

    glm::dvec3 onSkin() {
        if (areas_.empty()) {
            double sum = 0;
            for (const Triangle& t : triangles_)
                areas_.push_back(sum += triangleArea(positions_, t));
        }
        const auto it =
            std::upper_bound(areas_.begin(), areas_.end(), dice_.unit() * areas_.back());
        const auto& [a, b, c] = triangles_[std::min<size_t>(
            static_cast<size_t>(it - areas_.begin()), triangles_.size() - 1)];
        double u = dice_.unit(), v = dice_.unit();
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const glm::dvec3 p = positions_[a];
        return p + u * (glm::dvec3(positions_[b]) - p) + v * (glm::dvec3(positions_[c]) - p);
    }

    /// As dense as `count` are in the volume; all that are in the bounds, for cells of those
    /// outside may reach in.
    std::vector<glm::dvec3> lattice() {
        const double volume =
            std::max(signedVolume(positions_, triangles_, bounds_.middle()), 1e-300);
        const double distance = std::max(std::cbrt(volume / options_.count), leastDistance());
        std::array<int64_t, 3> count{};
        for (int k = 0; k < 3; ++k) {
            const double along = bounds_.size()[k] / distance;
            count[static_cast<size_t>(k)] = std::max<int64_t>(std::llround(along), 1);
        }
        std::vector<glm::dvec3> sites;
        for (int64_t z = 0; z < count[2]; ++z) {
            for (int64_t y = 0; y < count[1]; ++y) {
                for (int64_t x = 0; x < count[0]; ++x) {
                    const double dx = dice_.signedUnit(), dy = dice_.signedUnit(),
                                 dz = dice_.signedUnit();
                    const glm::dvec3 cell =
                        bounds_.size() / glm::dvec3(static_cast<double>(count[0]),
                                                    static_cast<double>(count[1]),
                                                    static_cast<double>(count[2]));
                    const glm::dvec3 at(static_cast<double>(x), static_cast<double>(y),
                                        static_cast<double>(z));
                    sites.push_back(
                        bounds_.low +
                        cell * (at + 0.5 + 0.5 * options_.jitter * glm::dvec3(dx, dy, dz)));
                }
            }
        }
        return sites;
    }

    /// So that there are no more than can be.
    double leastDistance() const {
        const glm::dvec3 size = bounds_.size() + 1e-300;
        return std::cbrt(size.x * size.y * size.z / (0.5 * kMostSites));
    }

    std::span<const glm::vec3> positions_;
    std::span<const Triangle> triangles_;
    const VolumeSites& options_;
    InsideTest inside_;
    Bounds bounds_;
    Dice dice_;
    std::vector<double> areas_;  ///< summed up
};

}  // namespace

Result<std::vector<glm::dvec3>> volumeSites(std::span<const glm::vec3> positions,
                                            std::span<const Triangle> triangles,
                                            const VolumeSites& options) {
    if (triangles.empty()) return fail(ErrorCode::noTriangles, "there is nothing to cut");
    if (options.count < 1 || options.count > kMostSites)
        return fail(ErrorCode::badArgument, "there can be 1 to 100,000 sites");
    if (options.kind == VolumeSites::Kind::crowded) {
        if (options.around.empty())
            return fail(ErrorCode::badArgument, "there is no point to crowd around");
        if (!(options.spread > 0 && options.spread < 1e6))
            return fail(ErrorCode::badArgument, "the spread of crowds must be above 0");
    }
    if (!(options.jitter >= 0 && options.jitter <= 1))
        return fail(ErrorCode::badArgument, "jitter must be between 0 and 1");
    return Sampler(positions, triangles, options).run();
}

}  // namespace sherd
