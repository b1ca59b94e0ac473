// SPDX-License-Identifier: MIT
#include "support/coverage.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <vector>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

struct Box {
    glm::vec3 low{INFINITY}, high{-INFINITY};

    explicit Box(const TriangleSoup& soup) {
        for (const auto& t : soup.triangles) {
            for (const uint32_t v : t) {
                low = glm::min(low, soup.positions[v]);
                high = glm::max(high, soup.positions[v]);
            }
        }
    }
    bool contains(const glm::vec3& p) const {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
               p.z <= high.z;
    }
};

/// Points inside the object, uniform over its volume. Gives up, with fewer, on an object that fills
/// less than a thousandth of its box.
std::vector<glm::vec3> samplesInside(const TriangleSoup& object, const CoverageOptions& options) {
    const InsideTest inside(object.positions, object.triangles);
    const Box box(object);
    std::mt19937 engine(options.seed);
    const auto unit = [&] { return engine() / 4294967296.0; };
    std::vector<glm::vec3> samples;
    const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
    if (!(glm::dot(size, size) > 0)) return samples;
    const uint64_t tries = 1000ULL * options.points;
    for (uint64_t i = 0; i < tries && samples.size() < options.points; ++i) {
        const double x = unit(), y = unit(), z = unit();  // in a fixed order
        const glm::vec3 p(glm::dvec3(box.low) + size * glm::dvec3(x, y, z));
        if (inside.inside(glm::dvec3(p))) samples.push_back(p);
    }
    return samples;
}

/// Whether any fragment has a face within `skin` of the point.
class SkinTest {
  public:
    SkinTest(std::span<const TriangleSoup> fragments, double skin) : skin_(skin) {
        for (const TriangleSoup& fragment : fragments) {
            boxes_.emplace_back(fragment);
            trees_.emplace_back(std::nullopt);
        }
        fragments_ = fragments;
    }
    bool operator()(const glm::vec3& p) {
        for (size_t f = 0; f < boxes_.size(); ++f) {
            const glm::dvec3 q(p);
            const glm::dvec3 outside = glm::max(
                glm::max(glm::dvec3(boxes_[f].low) - q, q - glm::dvec3(boxes_[f].high)), 0.0);
            if (glm::length(outside) > skin_) continue;
            if (!trees_[f]) trees_[f].emplace(fragments_[f].positions, fragments_[f].triangles);
            if (trees_[f]->closest(q, skin_).triangle != ClosestPoint::kNone) return true;
        }
        return false;
    }

  private:
    double skin_;
    std::span<const TriangleSoup> fragments_;
    std::vector<Box> boxes_;
    std::vector<std::optional<TriangleBvh>> trees_;  ///< built when first asked
};

}  // namespace

Coverage measureCoverage(const TriangleSoup& object, std::span<const TriangleSoup> fragments,
                         const CoverageOptions& options) {
    const std::vector<glm::vec3> samples = samplesInside(object, options);
    // in[f]: the samples inside fragment f.
    std::vector<std::vector<uint32_t>> in(fragments.size());
    parallelRuns(fragments.size(), 1, options.threads, [&](size_t f, size_t) {
        const Box box(fragments[f]);
        const InsideTest inside(fragments[f].positions, fragments[f].triangles);
        for (uint32_t i = 0; i < samples.size(); ++i) {
            if (box.contains(samples[i]) && inside.inside(glm::dvec3(samples[i])))
                in[f].push_back(i);
        }
    });
    std::vector<uint32_t> count(samples.size(), 0);
    for (const auto& list : in) {
        for (const uint32_t i : list) ++count[i];
    }
    const Box box(object);
    const double diagonal = glm::distance(glm::dvec3(box.low), glm::dvec3(box.high));
    SkinTest onFace(fragments, options.skin * diagonal);
    Coverage coverage;
    for (size_t i = 0; i < samples.size(); ++i) {
        // Only points that would be held against the fragments are worth the look.
        if (count[i] != 1 && options.skin > 0 && onFace(samples[i])) continue;
        ++coverage.points;
        if (count[i] == 0) ++coverage.none;
        if (count[i] > 1) ++coverage.several;
    }
    return coverage;
}

}  // namespace sherd
