// SPDX-License-Identifier: MIT
#include "measures/protrusion.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "geometry/triangle_bvh.h"
#include "geometry/weld.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr size_t kTrianglesPerRun = 1024;

/// A point of a hidden triangle that is not inside.
struct Outsider {
    glm::dvec3 point;
    uint32_t triangle;
};

/// Which vertices lie outside. Those of the outer surface are on it, whatever rounding says.
class OutsideVertices {
  public:
    OutsideVertices(const ShownTriangles& shown, const InsideCells& inside, unsigned threads) {
        std::vector<glm::vec3> places;
        place_ = PositionWelder(places).add(shown.set().geometry.positions);
        outside_.assign(places.size(), 0);
        parallelRuns(places.size(), 4 * kTrianglesPerRun, threads, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i)
                outside_[i] = inside.inside(glm::dvec3(places[i])) ? 0 : 1;
        });
        for (const ShownTriangles::Triangle& t : shown.triangles())
            for (const uint32_t v : t.v)
                if (t.exposedFrom == 0) outside_[place_[v]] = 0;
    }
    bool operator()(uint32_t vertex) const { return outside_[place_[vertex]] != 0; }
    uint32_t placeOf(uint32_t vertex) const { return place_[vertex]; }

  private:
    std::vector<uint32_t> place_;
    std::vector<uint8_t> outside_;
};

std::vector<Outsider> findOutsiders(const ShownTriangles& shown, const InsideCells& inside,
                                    unsigned threads) {
    const OutsideVertices isOutside(shown, inside, threads);
    std::vector<Outsider> found;
    std::mutex mutex;
    parallelRuns(shown.triangles().size(), kTrianglesPerRun, threads,
                 [&](size_t first, size_t last) {
                     std::vector<Outsider> own;
                     for (auto t = static_cast<uint32_t>(first); t < last; ++t) {
                         if (shown.triangles()[t].exposedFrom == 0) continue;
                         const auto p = shown.places(t);
                         const auto& v = shown.triangles()[t].v;
                         for (size_t k = 0; k < 3; ++k) {
                             if (isOutside(v[k])) own.push_back({p[k], t});
                             // Inside a sheet the triangle beyond the edge has it the other way
                             // round; where a wall ends a sheet, the wall has it.
                             const size_t next = (k + 1) % 3;
                             if (shown.triangles()[t].sheet &&
                                 isOutside.placeOf(v[k]) < isOutside.placeOf(v[next]))
                                 continue;
                             const glm::dvec3 middle = 0.5 * (p[k] + p[(k + 1) % 3]);
                             if (!inside.inside(middle)) own.push_back({middle, t});
                         }
                         const glm::dvec3 centroid = (p[0] + p[1] + p[2]) / 3.0;
                         if (!inside.inside(centroid)) own.push_back({centroid, t});
                     }
                     const std::scoped_lock lock(mutex);
                     found.insert(found.end(), own.begin(), own.end());
                 });
    return found;  // in any order: only the largest distance counts
}

}  // namespace

std::vector<double> protrusions(const ShownTriangles& shown, const OriginalSolid& solid,
                                unsigned threads) {
    std::vector<double> result(shown.set().fragments.size(), 0);
    const std::vector<Outsider> outsiders = findOutsiders(shown, solid.inside, threads);
    if (outsiders.empty()) return result;
    const TriangleBvh tree(solid.positions, solid.triangles);
    std::vector<double> distance(outsiders.size());
    parallelRuns(outsiders.size(), kTrianglesPerRun, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i)
            distance[i] = std::sqrt(tree.closest(outsiders[i].point).distance2);
    });
    for (size_t i = 0; i < outsiders.size(); ++i) {
        shown.forEachShowing(outsiders[i].triangle,
                             [&](uint32_t f) { result[f] = std::max(result[f], distance[i]); });
    }
    return result;
}

}  // namespace sherd
