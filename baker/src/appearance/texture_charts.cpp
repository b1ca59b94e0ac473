// SPDX-License-Identifier: MIT
#include "appearance/texture_charts.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

const double kGrow = std::cos(30 * M_PI / 180);   ///< from the mean of a chart's first faces
const double kBound = std::cos(40 * M_PI / 180);  ///< from its plane, in the end

/// So many faces around the seed say how its chart's plane lies.
constexpr size_t kSample = 256;

class Charter {
  public:
    Charter(const HiddenMesh& mesh, std::span<const uint32_t> opposite, const FaceShapes& shapes)
        : mesh_(mesh), opposite_(opposite), normals_(shapes.normals), areas_(shapes.areas) {
        charts_.ofFace.assign(mesh.faces.size(), kNone);
        seen_.assign(mesh.faces.size(), kNone);
    }

    TextureCharts run(double metresPerTile) {
        for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
            if (charts_.ofFace[f] != kNone || areas_[f] == 0) continue;
            const auto chart = static_cast<uint32_t>(charts_.frames.size());
            charts_.frames.push_back(frameAround(f, chart));
            fill(f, chart);
            place(chart, metresPerTile);
        }
        // Faces without area that no chart has reached.
        for (uint32_t& chart : charts_.ofFace) {
            if (chart != kNone) continue;
            chart = static_cast<uint32_t>(charts_.frames.size());
        }
        charts_.frames.push_back(frameOf({0, 1, 0}));
        return std::move(charts_);
    }

  private:
    /// visit(face) for faces around the seed that no chart has, from near to far, as long as it
    /// says so; beyond faces that accept(face) refuses it does not go.
    template <class Accept>
    void flood(uint32_t seed, uint32_t mark, size_t most, const Accept& accept) {
        queue_.assign(1, seed);
        seen_[seed] = mark;
        for (size_t i = 0; i < queue_.size() && queue_.size() < most; ++i) {
            for (uint32_t h = 3 * queue_[i]; h < 3 * queue_[i] + 3; ++h) {
                const uint32_t g = opposite_[h] == kNone ? kNone : opposite_[h] / 3;
                if (g == kNone || charts_.ofFace[g] != kNone || seen_[g] == mark) continue;
                if (!accept(g)) continue;
                seen_[g] = mark;
                queue_.push_back(g);
            }
        }
    }

    /// The plane of the faces around the seed that look much the same way.
    ChartFrame frameAround(uint32_t seed, uint32_t chart) {
        glm::dvec3 sum = normals_[seed] * areas_[seed];
        flood(seed, 2 * chart, kSample, [&](uint32_t g) {
            if (glm::dot(normals_[g], sum) < kGrow * glm::length(sum) && areas_[g] > 0)
                return false;
            sum += normals_[g] * areas_[g];
            return true;
        });
        const glm::dvec3 mean = glm::normalize(sum);
        return frameOf(glm::dot(mean, normals_[seed]) < kBound ? normals_[seed] : mean);
    }

    static ChartFrame frameOf(const glm::dvec3& normal) {
        ChartFrame frame;
        frame.normal = normal;
        const glm::dvec3 up = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0)
                                                       : glm::dvec3(0, 0, normal.y > 0 ? -1 : 1);
        frame.right = glm::normalize(glm::cross(up, normal));
        frame.up = glm::cross(normal, frame.right);
        return frame;
    }

    void fill(uint32_t seed, uint32_t chart) {
        const glm::dvec3 normal = charts_.frames[chart].normal;
        flood(seed, 2 * chart + 1, std::numeric_limits<size_t>::max(), [&](uint32_t g) {
            return areas_[g] == 0 || glm::dot(normals_[g], normal) >= kBound;
        });
        for (const uint32_t f : queue_) charts_.ofFace[f] = chart;
    }

    /// Scale and origin of the chart whose faces the queue holds: what leaning on the plane takes
    /// from texels is given back in the mean.
    void place(uint32_t chart, double metresPerTile) {
        ChartFrame& frame = charts_.frames[chart];
        double area = 0, projected = 0;
        for (const uint32_t f : queue_) {
            area += areas_[f];
            projected += areas_[f] * glm::dot(normals_[f], frame.normal);
        }
        frame.tilesPerMetre = std::sqrt(area / projected) / metresPerTile;
        glm::dvec2 low(std::numeric_limits<double>::max());
        for (const uint32_t f : queue_)
            for (const uint32_t v : mesh_.faces[f].v)
                low = glm::min(low, frame.uv(mesh_.positions[v]));
        frame.origin = glm::floor(low);
    }

    const HiddenMesh& mesh_;
    std::span<const uint32_t> opposite_;
    std::span<const glm::dvec3> normals_;
    std::span<const double> areas_;
    TextureCharts charts_;
    std::vector<uint32_t> seen_;   ///< per face: the last flood that met it
    std::vector<uint32_t> queue_;  ///< of the last flood: all its faces
};

}  // namespace

glm::dvec2 ChartFrame::uv(const glm::dvec3& p) const {
    return glm::dvec2(glm::dot(p, right), -glm::dot(p, up)) * tilesPerMetre - origin;
}

TextureCharts textureCharts(const HiddenMesh& mesh, std::span<const uint32_t> opposite,
                            const FaceShapes& shapes, double metresPerTile) {
    return Charter(mesh, opposite, shapes).run(metresPerTile);
}

}  // namespace sherd
