// SPDX-License-Identifier: MIT
// The medial surface of every real model there is: nothing outside, and how much it fills.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "interior/medial.h"
#include "sherd/baker/import.h"
#include "support/models.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<std::filesystem::path> realModels() {
    std::vector<std::filesystem::path> models;
    if (!haveSharedModels()) return models;
    for (const auto& entry : std::filesystem::directory_iterator(sharedDir() / "models" / "dev")) {
        const auto extension = entry.path().extension();
        if (extension == ".glb" || extension == ".obj") models.push_back(entry.path());
    }
    std::sort(models.begin(), models.end());
    return models;
}

double diagonal(const std::vector<glm::vec3>& points) {
    glm::vec3 low = points[0], high = points[0];
    for (const glm::vec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(glm::dvec3(low), glm::dvec3(high));
}

struct Filling {
    double none = 0, twice = 0, outside = 0;  ///< % of the object's volume
};

/// Share of the object's volume in no piece, in two, and of pieces outside of it, were every
/// triangle a piece of its own: the pieces' winding numbers add up to that of the object minus that
/// of the medial surface.
Filling fillingOf(const SurfaceMesh& mesh, const MedialSurface& medial) {
    std::vector<std::array<uint32_t, 3>> sheet;
    for (const auto& t : medial.triangles.triangles) sheet.push_back(t.v);
    const InsideTest outer(mesh.positions, mesh.triangles), inner(medial.points, sheet);
    glm::dvec3 low(mesh.positions[0]), high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    Random random(1);
    int in = 0, none = 0, twice = 0, outside = 0;
    for (int i = 0; i < 200000 && in < 4000; ++i) {
        const double x = random.unit(), y = random.unit(), z = random.unit();
        const glm::dvec3 p = low + (high - low) * glm::dvec3(x, y, z);
        const int around = outer.winding(p);
        const int hidden = inner.winding(p);
        if (around < 1) {
            if (hidden != 0) ++outside;
            continue;
        }
        ++in;
        if (hidden >= around) ++none;
        if (hidden < 0) ++twice;
    }
    const double percent = 100.0 / std::max(in, 1);
    return {percent * none, percent * twice, percent * outside};
}

}  // namespace

TEST_CASE("the medial surface of every real model is inside it and leaves little hollow") {
    for (const std::filesystem::path& path : realModels()) {
        const Result<Model> model = importModel(path, {});
        INFO(path.filename().string());
        REQUIRE(model.has_value());
        for (const SurfaceMesh& mesh : model->meshes) {
            const auto start = std::chrono::steady_clock::now();
            const Result<MedialSurface> medial =
                medialSurface(mesh, buildTopology(mesh.positions, mesh.triangles), {});
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            REQUIRE(medial.has_value());
            const InsideTest inside(mesh.positions, mesh.triangles);
            const TriangleBvh bvh(mesh.positions, mesh.triangles);
            const double skin = 1e-6 * diagonal(mesh.positions);
            uint32_t outside = 0;
            for (const glm::vec3& p : medial->points) {
                if (inside.inside(glm::dvec3(p))) continue;
                if (bvh.closest(glm::dvec3(p), skin).triangle == ClosestPoint::kNone) ++outside;
            }
            CHECK(outside == 0);
            const auto [none, twice, sticksOut] = fillingOf(mesh, *medial);
            MESSAGE(path.filename().string()
                    << ": " << mesh.triangles.size() << " triangles, "
                    << std::string(inside.closed() ? "closed" : "open") << ", hollow " << none
                    << " %, double " << twice << " %, outside " << sticksOut << " %, "
                    << medial->triangles.triangles.size() << " triangles of the sheet, "
                    << medial->covered << " covered, " << medial->outside << " outside, "
                    << medial->pulledBack << " pulled back, " << medial->onSurface
                    << " on the surface, " << 1e3 * seconds.count() << " ms");
            if (inside.closed()) CHECK(none < 2);
            if (inside.closed()) CHECK(twice < 1);
            if (inside.closed()) CHECK(sticksOut < 0.2);
        }
    }
}
