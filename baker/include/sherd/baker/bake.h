// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/import.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/report.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/fracture_set.h"
#include "sherd/formats/geometry_packing.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Called as stages begin, possibly from another thread than the caller's; share is 0..1.
using Progress = std::function<void(const std::string& stage, double share)>;

/// The materials of a model and of hidden faces, as glTF indices; -1 is the default material.
struct InteriorMaterials {
    InteriorMaterials() = default;
    /// One for all.
    InteriorMaterials(int32_t all) : other(all) {}

    std::map<int32_t, int32_t> below;  ///< material of the outer surface -> of what lies below it
    int32_t other = -1;                ///< below all other materials
    /// What the model calls its materials, by their index; those without a name are left out.
    std::map<int32_t, std::string> names;

    int32_t under(int32_t outer) const {
        const auto it = below.find(outer);
        return it == below.end() ? other : it->second;
    }
};

struct BakedObject {
    /// Materials are glTF indices: those of the mesh, then those of hidden faces.
    FractureSet set;
    BakedObjectReport report;
};

/// Cuts one mesh along the lines of a plan (each says from which level it cuts), level by level,
/// into closed fragments with hulls, masses and bonds.
///
/// Errors: noTextureCoordinates, limitExceeded, openMesh, nonManifoldMesh (unless allowOpen),
/// emptyMap, separatesNothing, notClosed, invalidData (inside out). Casella, Artist-Driven
/// Fracturing of Polyhedral Surface Meshes, 2013.
Result<BakedObject> bakeObject(const SurfaceMesh& mesh, const FracturePlan& plan,
                               const Recipe& recipe, const InteriorMaterials& interior,
                               const Progress& progress = {});

struct BakedFile {
    std::vector<uint8_t> glb;
    BakeReport report;
};

/// How one mesh is broken. What it points to outlives the bake.
struct BakeOrder {
    const FracturePlan* plan = nullptr;
    const Recipe* recipe = nullptr;
};

/// Bakes a model, an order per mesh, and hangs the fracture sets on the model's document. Hidden
/// faces get the recipes' interior materials, or a neutral one that is added. Errors also:
/// badArgument for materials that the model has not, and for anchors that hold no object of their
/// recipe. `packing`: of the fragments' render geometry.
Result<BakedFile> bakeModel(const Model& model, const std::vector<BakeOrder>& orders,
                            const Progress& progress = {}, const GeometryPacking& packing = {});

/// The same order for every mesh.
Result<BakedFile> bakeModel(const Model& model, const FracturePlan& plan, const Recipe& recipe,
                            const Progress& progress = {});

}  // namespace sherd
