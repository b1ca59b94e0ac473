// SPDX-License-Identifier: MIT
// Real models cut along maps that really separate them, level by level.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "sherd/baker/bake.h"
#include "sherd/formats/validate.h"
#include "support/models.h"
#include "support/plans.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

struct KnownMap {
    std::string file;
    uint32_t components;
};

/// Model -> its maps, coarse to fine, from the table of counts beside the maps.
std::map<std::string, std::vector<KnownMap>> knownMaps() {
    std::map<std::string, std::vector<KnownMap>> models;
    std::ifstream in(sharedDir() / "maps" / "COUNTS.md");
    for (std::string line; std::getline(in, line);) {
        std::istringstream cells(line);
        std::string empty, model, file, planes, components;
        std::getline(cells, empty, '|');
        std::getline(cells, model, '|');
        std::getline(cells, file, '|');
        std::getline(cells, planes, '|');
        std::getline(cells, components, '|');
        const auto trim = [](const std::string& s) {
            const size_t first = s.find_first_not_of(' ');
            return first == std::string::npos
                       ? ""
                       : s.substr(first, s.find_last_not_of(' ') - first + 1);
        };
        if (!trim(file).ends_with(".svg")) continue;
        models[trim(model)].push_back({trim(file), static_cast<uint32_t>(std::stoul(components))});
    }
    for (auto& [model, maps] : models) {
        std::sort(maps.begin(), maps.end(),
                  [](const KnownMap& a, const KnownMap& b) { return a.components < b.components; });
    }
    return models;
}

uint32_t mergedCount(const BakedObjectReport& report) {
    uint32_t count = 0;
    for (const BakeFinding& finding : report.findings)
        count += finding.code.starts_with("merged-") ? finding.count : 0;
    return count;
}

void bakeAndCheck(const std::string& name, const std::vector<KnownMap>& known) {
    CAPTURE(name);
    const Result<Model> model = importModel(sharedDir() / "models" / name, {});
    REQUIRE(model.has_value());
    std::vector<FractureMap> maps;
    for (const KnownMap& map : known) {
        Result<FractureMap> read = readFractureMap(sharedDir() / "maps" / map.file, {});
        REQUIRE(read.has_value());
        maps.push_back(std::move(*read));
    }
    const Result<BakedFile> baked = bakeModel(*model, stack(std::move(maps)), {});
    if (!baked) FAIL(baked.error().message);
    const BakedObjectReport& report = baked->report.objects.at(0);
    const uint32_t merged = mergedCount(report);
    for (size_t k = 0; k < known.size(); ++k) {
        const BakedLevelReport& level = report.levels.at(k + 1);
        CAPTURE(known[k].file);
        CHECK(level.components >= known[k].components);
        CHECK(level.fragments + merged >= level.components);
        CHECK(level.closed == level.fragments);
    }
    const Result<CheckReport> check = checkFractureSets(baked->glb, {});
    REQUIRE(check.has_value());
    for (const auto& finding : check->findings) {
        if (finding.severity == Severity::failure) MESSAGE(finding.message << " " << finding.where);
    }
    CHECK(check->passed());
    MESSAGE(name << ": " << report.levels.back().fragments << " fragments, " << merged
                 << " merged, volume " << report.levels.back().volumeShare << ", "
                 << baked->report.seconds << " s");
}

}  // namespace

TEST_CASE("a real model bakes to the same bytes with one thread and with four") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    // Large enough that every parallel stage hands work to several threads.
    const Result<Model> model = importModel(sharedDir() / "models/dev/skull_41k_atlas.glb", {});
    const Result<FractureMap> map =
        readFractureMap(sharedDir() / "maps/skull_41k_atlas_34.svg", {});
    REQUIRE((model.has_value() && map.has_value()));
    Recipe one;
    one.threads = 1;
    Recipe four;
    four.threads = 4;
    const Result<BakedFile> a = bakeModel(*model, planOf(*map), one);
    const Result<BakedFile> b = bakeModel(*model, planOf(*map), four);
    REQUIRE((a.has_value() && b.has_value()));
    CHECK(a->glb == b->glb);
}

TEST_CASE("every real model with maps gives at least the counted components, all closed") {
    if (!haveSharedModels()) {
        MESSAGE("skipped: no real models beside the checkout");
        return;
    }
    const auto models = knownMaps();
    REQUIRE(models.size() >= 12);
    for (const auto& [name, maps] : models) {
        // Instrumented builds take the small models; the large ones differ in size only.
        const bool instrumented = propertyCases(100) < 100;
        if (instrumented && std::filesystem::file_size(sharedDir() / "models" / name) > 400'000 &&
            name.find("barrel") == std::string::npos) {
            MESSAGE("left to the uninstrumented build: " << name);
            continue;
        }
        bakeAndCheck(name, maps);
    }
}
