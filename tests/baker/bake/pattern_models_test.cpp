// SPDX-License-Identifier: MIT
// Every real model breaks by a pattern into just as many pieces as were asked for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <set>

#include "sherd/baker/bake.h"
#include "sherd/formats/validate.h"
#include "support/models.h"
#include "support/property.h"
#include "surface/cut_surface.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturePlan pattern(const std::string& text) {
    FracturePlan plan;
    plan.patterns.push_back({*parsePattern(text), 1, nullptr});
    return plan;
}

std::vector<std::filesystem::path> models() {
    std::set<std::filesystem::path> found;
    for (const char* folder : {"dev", "ladder"}) {
        for (const auto& entry :
             std::filesystem::directory_iterator(sharedDir() / "models" / folder)) {
            const std::string kind = entry.path().extension().string();
            if (kind == ".glb" || kind == ".obj") found.insert(entry.path());
        }
    }
    return {found.begin(), found.end()};
}

void cutInto(const Model& model, uint32_t count) {
    for (const SurfaceMesh& mesh : model.meshes) {
        const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
        const Result<CutSurface> cut =
            cutSurface(mesh, topology, pattern("voronoi:" + std::to_string(count)), {});
        if (!cut) FAIL(cut.error().message);
        std::vector<CellReport> reports;
        CHECK(componentsOf(*cut, reports).count.at(0) == count);
    }
}

void breakInto(const Model& model, uint32_t count) {
    Recipe recipe;
    recipe.allowOpen = true;
    const Result<BakedFile> baked =
        bakeModel(model, pattern("voronoi:" + std::to_string(count)), recipe);
    if (!baked) FAIL(baked.error().message);
    for (const BakedObjectReport& object : baked->report.objects) {
        CAPTURE(object.name);
        const BakedLevelReport& level = object.levels.at(1);
        CHECK(level.closed == level.fragments);
        CHECK(level.fragments == count);
    }
    // What the report says is what the file holds, proven from the file alone.
    const Result<CheckReport> check = checkFractureSets(baked->glb, {});
    REQUIRE(check.has_value());
    for (const auto& finding : check->findings)
        CHECK_MESSAGE(finding.severity != Severity::failure, finding.message);
}

}  // namespace

TEST_CASE("every real model is broken into 12 and into 50 pieces, whatever its charts and parts") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    for (const std::filesystem::path& path : models()) {
        // The largest are cut only, unless time is given: interiors take minutes there.
        const bool large = std::filesystem::file_size(path) > 1'000'000 &&
                           path.string().find("ladder") != std::string::npos;
        const bool medium = std::filesystem::file_size(path) > 400'000;
        if (medium && propertyCases(100) < 100) {
            MESSAGE("left to the uninstrumented build: " << path.filename().string());
            continue;
        }
        const Result<Model> model = importModel(path, {});
        REQUIRE(model.has_value());
        for (const uint32_t count : {12U, 50U}) {
            CAPTURE(path.filename().string());
            CAPTURE(count);
            if (large && propertyCases(100) <= 100)
                cutInto(*model, count);
            else
                breakInto(*model, count);
        }
    }
}

TEST_CASE("the pieces of every closed model are closed, fill it, and stick out of it nowhere") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    const bool all = propertyCases(100) > 100;
    for (const std::filesystem::path& path : models()) {
        if (std::filesystem::file_size(path) > 400'000 && propertyCases(100) < 100) {
            MESSAGE("left to the uninstrumented build: " << path.filename().string());
            continue;
        }
        const Result<Model> model = importModel(path, {});
        REQUIRE(model.has_value());
        const SurfaceMesh& mesh = model->meshes.at(0);
        const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
        const bool open = topology.boundaryEdges + topology.nonManifoldEdges > 0;
        if (open || (mesh.triangles.size() > 100'000 && !all)) continue;
        for (const uint32_t count : {13U, 58U}) {
            CAPTURE(path.filename().string());
            CAPTURE(count);
            const Result<BakedFile> baked =
                bakeModel(*model, pattern("voronoi:" + std::to_string(count) + ":1"), {});
            if (!baked) FAIL(baked.error().message);
            CheckOptions options;
            options.coverage = true;
            const Result<CheckReport> check = checkFractureSets(baked->glb, options);
            REQUIRE(check.has_value());
            CHECK(check->passed());
            for (const ObjectReport& object : check->objects) {
                const LevelReport& level = object.levels.at(1);
                CHECK(level.closed == level.fragments);
                CHECK(object.protrusion <= 1e-5 * object.diagonal);
                CHECK(level.coverageNone <= 0.02);
                CHECK(level.coverageDouble <= 0.01);
                MESSAGE(path.filename().string()
                        << ", " << count << " pieces: none " << 100 * level.coverageNone
                        << " %, double " << 100 * level.coverageDouble << " %, protrusion "
                        << object.protrusion / object.diagonal << " of the diagonal");
            }
        }
    }
}

TEST_CASE("one closed curve drawn right around the bunny, over its charts, makes two components") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    for (const char* name : {"bunny_30k.glb", "bunny_xatlas_30k.glb"}) {
        CAPTURE(name);
        const Result<Model> model = importModel(sharedDir() / "models/ladder" / name, {});
        REQUIRE(model.has_value());
        glm::dvec3 low(1e300);
        glm::dvec3 high(-1e300);
        for (const glm::vec3& p : model->meshes[0].positions) {
            low = glm::min(low, glm::dvec3(p));
            high = glm::max(high, glm::dvec3(p));
        }
        FractureMap::SurfaceLine ring;
        ring.source = "ring";
        const glm::dvec3 middle = (low + high) * 0.5;
        const double radius = std::max(high.x - low.x, high.z - low.z) / 2;
        constexpr int kPlaces = 24;
        for (int i = 0; i <= kPlaces; ++i) {
            const double angle = 2 * M_PI * (i % kPlaces) / kPlaces;
            ring.places.push_back(
                {true,
                 {middle.x + radius * std::cos(angle), low.y + 0.4 * (high.y - low.y),
                  middle.z + radius * std::sin(angle)}});
        }
        FracturePlan plan;
        plan.drawings.emplace_back().map.surfaceLines.push_back(ring);
        Recipe recipe;
        recipe.snapShare = 1;
        const Result<BakedFile> baked = bakeModel(*model, plan, recipe);
        if (!baked) FAIL(baked.error().message);
        const BakedObjectReport& object = baked->report.objects.at(0);
        CHECK(object.levels.at(1).components == 2);
        CHECK(object.levels.at(1).fragments == 2);
    }
}
