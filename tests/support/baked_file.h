// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include "sherd/baker/bake.h"
#include "sherd/formats/validate.h"

namespace sherd::test {

/// Wraps a mesh and its set into a GLB whose intact mesh is the same positions, for the file check.
inline CheckReport checkBaked(const SurfaceMesh& mesh, const FracturePlan& plan,
                              const Recipe& recipe = {}) {
    Model model;
    model.meshes.push_back(mesh);
    model.meshes[0].node = 0;
    model.meshes[0].mesh = 0;
    model.document.json =
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
        R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[0,0,0]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],)"
        R"("scenes":[{"nodes":[0]}],"scene":0})";
    model.document.bin.assign(36, 0);
    const Result<BakedFile> baked = bakeModel(model, plan, recipe);
    if (!baked) FAIL(baked.error().message);
    Result<CheckReport> report = checkFractureSets(baked->glb, {});
    REQUIRE(report.has_value());
    for (const auto& f : report->findings) {
        if (f.severity == Severity::failure) MESSAGE(f.message << " " << f.where);
    }
    return *report;
}

}  // namespace sherd::test
