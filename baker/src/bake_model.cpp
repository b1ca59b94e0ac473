// SPDX-License-Identifier: MIT
// A whole model: its meshes baked one after another, hung on its document.
#include <chrono>

#include "appearance/interior_materials.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd {

Result<BakedFile> bakeModel(const Model& model, const FracturePlan& plan, const Recipe& recipe,
                            const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const Result<ChosenMaterials> interior =
        chooseInteriorMaterials(model.document, model.meshes, recipe);
    if (!interior) return tl::unexpected(interior.error());
    BakedFile file;
    std::vector<FractureSet> sets;
    for (const SurfaceMesh& mesh : model.meshes) {
        Result<BakedObject> object = bakeObject(mesh, plan, recipe, interior->materials, progress);
        if (!object) return tl::unexpected(object.error());
        object->set.sameNodes = mesh.sameNodes;
        object->set.joinedNodes = mesh.joinedNodes;
        sets.push_back(std::move(object->set));
        file.report.objects.push_back(std::move(object->report));
    }
    if (progress) progress("writing", 0.97);
    std::vector<NewMaterial> added;
    if (interior->added) added.push_back(*interior->added);
    Result<std::vector<uint8_t>> glb = attachFractureSets(model.document, sets, added);
    if (!glb) return tl::unexpected(glb.error());
    file.glb = std::move(*glb);
    file.report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return file;
}

}  // namespace sherd
