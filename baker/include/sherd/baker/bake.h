// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/import.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Called as stages begin, possibly from another thread than the caller's; share is 0..1.
using Progress = std::function<void(const std::string& stage, double share)>;

struct BakedObject {
    /// Materials are glTF indices; the last one, of hidden faces, is `interiorMaterial`.
    FractureSet set;
    BakedObjectReport report;
};

/// Cuts one mesh along the lines of a plan (each says from which level it cuts), level by level,
/// into closed fragments with hulls, masses and bonds.
///
/// interiorMaterial: glTF index that hidden faces get.
/// Errors: noTextureCoordinates, limitExceeded, openMesh, nonManifoldMesh (unless allowOpen),
/// emptyMap, separatesNothing, notClosed, invalidData (inside out). Casella, Artist-Driven
/// Fracturing of Polyhedral Surface Meshes, 2013.
Result<BakedObject> bakeObject(const SurfaceMesh& mesh, const FracturePlan& plan,
                               const Recipe& recipe, int32_t interiorMaterial,
                               const Progress& progress = {});

struct BakedFile {
    std::vector<uint8_t> glb;
    BakeReport report;
};

/// Bakes every mesh of a model along the same plan and hangs the fracture sets on the model's
/// document. Hidden faces get the recipe's interior material, or a neutral one that is added.
Result<BakedFile> bakeModel(const Model& model, const FracturePlan& plan, const Recipe& recipe,
                            const Progress& progress = {});

}  // namespace sherd
