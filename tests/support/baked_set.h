// SPDX-License-Identifier: MIT
// Bakes small meshes and reads what was written, for tests that judge the written file.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sherd/baker/bake.h"
#include "sherd/formats/fracture_set.h"
#include "sherd/formats/glb_read.h"
#include "sherd/formats/validate.h"

namespace sherd::test {

/// A model of one mesh. Its document shows a point instead: only materials are looked up in it.
inline Model modelAround(const SurfaceMesh& mesh, const std::vector<std::string>& materials = {}) {
    Model model;
    model.meshes.push_back(mesh);
    model.meshes[0].node = 0;
    model.meshes[0].mesh = 0;
    std::string list;
    for (const std::string& name : materials) {
        list += list.empty() ? R"("materials":[)" : ",";
        list += name.empty() ? "{}" : R"({"name":")" + name + R"("})";
    }
    if (!list.empty()) list += "],";
    model.document.json =
        R"({"asset":{"version":"2.0"},)" + list +
        R"("buffers":[{"byteLength":36}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
        R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],)"
        R"("scenes":[{"nodes":[0]}],"scene":0})";
    model.document.bin.assign(36, 0);
    return model;
}

/// The set of the model's first mesh as read from the written bytes, which also pass the check.
inline FractureSet writtenSet(const Model& model, const FracturePlan& plan,
                              const Recipe& recipe = {}) {
    const Result<BakedFile> baked = bakeModel(model, plan, recipe);
    if (!baked) FAIL(baked.error().message);
    const Result<CheckReport> report = checkFractureSets(baked->glb, {});
    REQUIRE(report.has_value());
    for (const Finding& f : report->findings)
        if (f.severity == Severity::failure && f.code != "stale")
            FAIL_CHECK(f.message << " " << f.where);
    Result<std::vector<FractureSet>> sets = readFractureSets(baked->glb);
    REQUIRE(sets.has_value());
    return sets->at(0);
}

/// Of the fragments at a level, from the smallest up.
inline std::vector<double> volumesAt(const FractureSet& set, uint32_t level) {
    std::vector<double> volumes;
    for (const uint32_t f : fragmentsAtLevel(set, level))
        volumes.push_back(set.fragments[f].volume);
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

}  // namespace sherd::test
