// SPDX-License-Identifier: MIT
// After L. Shapira, A. Shamir and D. Cohen-Or, "Consistent Mesh Partitioning and Skeletonisation
// using the Shape Diameter Function" (2008), with the one ray along the normal instead of a cone:
// a plate's thickness is to be the plate's thickness.
#include "measures/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <span>
#include <utility>

#include "geometry/box_tree.h"
#include "geometry/triangle.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

struct Sample {
    glm::dvec3 point;
    glm::dvec3 inwards;  ///< unit
    uint32_t triangle;
};

struct Crossing {
    double way = 0;    ///< along the ray; 0: there is none
    bool out = false;  ///< the ray leaves the solid
    /// What touches hangs together.
    bool operator<(const Crossing& other) const {
        return way < other.way || (way == other.way && !out && other.out);
    }
};

/// T. Moeller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997); in
/// doubles, so that a ray through an edge may slip through.
Crossing crossingOf(const glm::dvec3& from, const glm::dvec3& along,
                    const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(along, ac);
    const double det = glm::dot(ab, p);
    if (det == 0) return {};
    const glm::dvec3 s = from - corners[0];
    const double u = glm::dot(s, p) / det;
    if (u < 0 || u > 1) return {};
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(along, q) / det;
    if (v < 0 || u + v > 1) return {};
    return {std::max(0.0, glm::dot(ac, q) / det), det < 0};
}

class FragmentThickness {
  public:
    FragmentThickness(std::span<const glm::vec3> positions,
                      std::vector<std::array<uint32_t, 3>> triangles)
        : positions_(positions),
          triangles_(std::move(triangles)),
          tree_(boxesOf(positions, triangles_)) {}

    double thinnest(const ThicknessOptions& options, uint32_t seed) const {
        std::vector<double> lengths;
        for (const Sample& sample : samples(options.samples, seed))
            lengths.push_back(depthAt(sample));
        if (lengths.empty()) return 0;
        const auto count = static_cast<double>(lengths.size());
        const auto rank =
            static_cast<std::ptrdiff_t>(std::clamp(options.share, 0.0, 0.999) * count);
        std::nth_element(lengths.begin(), lengths.begin() + rank, lengths.end());
        return lengths[rank] < kMiss ? lengths[rank] : 0;
    }

  private:
    static constexpr double kMiss = 1e300;

    /// Evenly over the surface: one in each of as many equal shares of its area.
    std::vector<Sample> samples(uint32_t count, uint32_t seed) const {
        double whole = 0;
        for (size_t t = 0; t < triangles_.size(); ++t) whole += areaOf(t);
        std::vector<Sample> samples;
        if (!(whole > 0)) return samples;
        std::mt19937 engine(seed);
        const auto unit = [&engine] { return engine() / 4294967296.0; };
        double reached = 0;
        uint32_t next = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const double along = (i + unit()) / count * whole;
            const double x = unit(), y = unit();
            while (next + 1 < triangles_.size() && reached + areaOf(next) < along)
                reached += areaOf(next++);
            samples.push_back(sampleIn(next, std::sqrt(x), y));
        }
        return samples;
    }

    /// Evenly over the triangle if the square of `root` and y are even over [0, 1].
    Sample sampleIn(uint32_t triangle, double root, double y) const {
        const auto p = places(triangle);
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        return {p[0] * (1 - root) + p[1] * (root * (1 - y)) + p[2] * (root * y),
                length > 0 ? normal / -length : glm::dvec3(0), triangle};
    }

    /// To where the fragment ends: where it overlaps itself, sheets inside it are no end of it.
    double depthAt(const Sample& sample) const {
        if (sample.inwards == glm::dvec3(0)) return kMiss;
        std::vector<Crossing> crossings;
        int deep = 0;
        tree_.along(sample.point, sample.inwards, kMiss, [&](uint32_t triangle, double&) {
            if (triangle == sample.triangle) return;
            const Crossing c = crossingOf(sample.point, sample.inwards, places(triangle));
            if (!(c.way > 0)) return;
            crossings.push_back(c);
            deep += c.out ? 1 : -1;
        });
        std::sort(crossings.begin(), crossings.end());
        deep = std::max(deep, 1);
        for (const Crossing& c : crossings) {
            deep += c.out ? -1 : 1;
            if (deep == 0) return c.way;
        }
        return kMiss;
    }

    std::array<glm::dvec3, 3> places(uint32_t t) const {
        const auto& v = triangles_[t];
        return {glm::dvec3(positions_[v[0]]), glm::dvec3(positions_[v[1]]),
                glm::dvec3(positions_[v[2]])};
    }
    double areaOf(size_t t) const { return triangleArea(positions_, triangles_[t]); }

    std::span<const glm::vec3> positions_;
    std::vector<std::array<uint32_t, 3>> triangles_;
    BoxTree tree_;
};

}  // namespace

std::vector<double> thinnestParts(const FractureSet& set, const ThicknessOptions& options) {
    std::vector<double> result(set.fragments.size(), 0);
    parallelRuns(result.size(), 1, options.threads, [&](size_t f, size_t) {
        const auto fragment = static_cast<uint32_t>(f);
        // A tree for each fragment is sooner made than rays find their way among all others.
        result[f] = FragmentThickness(set.geometry.positions, fragmentTriangles(set, fragment))
                        .thinnest(options, options.seed + fragment);
    });
    return result;
}

}  // namespace sherd
