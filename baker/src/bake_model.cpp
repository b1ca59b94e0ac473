// SPDX-License-Identifier: MIT
// A whole model: its meshes baked one after another, hung on its document.
#include <chrono>
#include <nlohmann/json.hpp>

#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd {
namespace {

struct InteriorMaterial {
    int32_t index = 0;
    std::vector<NewMaterial> added;
};

Result<InteriorMaterial> chooseInteriorMaterial(const GltfDocument& document,
                                                const std::string& name) {
    const auto json = nlohmann::json::parse(document.json, nullptr, false);
    const auto materials =
        json.is_object() && json.contains("materials") && json["materials"].is_array()
            ? json["materials"]
            : nlohmann::json::array();
    if (name.empty()) {
        NewMaterial neutral;
        neutral.name = "sherd interior";
        return InteriorMaterial{static_cast<int32_t>(materials.size()), {neutral}};
    }
    std::string known;
    for (size_t i = 0; i < materials.size(); ++i) {
        const bool named = materials[i].is_object() && materials[i].contains("name") &&
                           materials[i]["name"].is_string();
        const std::string here = named ? materials[i]["name"].get<std::string>() : "";
        if (here == name) return InteriorMaterial{static_cast<int32_t>(i), {}};
        known += (known.empty() ? "\"" : ", \"") + here + "\"";
    }
    return fail(ErrorCode::badArgument, "the model has no material named \"" + name +
                                            "\" for hidden faces; it has " +
                                            (known.empty() ? "none" : known));
}

}  // namespace

Result<BakedFile> bakeModel(const Model& model, const FracturePlan& plan, const Recipe& recipe,
                            const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const Result<InteriorMaterial> interior =
        chooseInteriorMaterial(model.document, recipe.interior.material);
    if (!interior) return tl::unexpected(interior.error());
    BakedFile file;
    std::vector<FractureSet> sets;
    for (const SurfaceMesh& mesh : model.meshes) {
        Result<BakedObject> object = bakeObject(mesh, plan, recipe, interior->index, progress);
        if (!object) return tl::unexpected(object.error());
        object->set.sameNodes = mesh.sameNodes;
        object->set.joinedNodes = mesh.joinedNodes;
        sets.push_back(std::move(object->set));
        file.report.objects.push_back(std::move(object->report));
    }
    if (progress) progress("writing", 0.97);
    Result<std::vector<uint8_t>> glb = attachFractureSets(model.document, sets, interior->added);
    if (!glb) return tl::unexpected(glb.error());
    file.glb = std::move(*glb);
    file.report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return file;
}

}  // namespace sherd
