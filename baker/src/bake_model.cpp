// SPDX-License-Identifier: MIT
// A whole model: its meshes baked one after another, hung on its document.
#include <algorithm>
#include <chrono>
#include <map>

#include "appearance/interior_materials.h"
#include "recipe_use.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd {
namespace {

/// The meshes that one recipe breaks, by their number in the model.
struct RecipeUse {
    const Recipe* recipe;
    std::vector<size_t> meshes;
    InteriorMaterials interior;
};

class ModelBake {
  public:
    ModelBake(const Model& model, const std::vector<BakeOrder>& orders) : model_(model) {
        for (size_t i = 0; i < orders.size(); ++i) {
            const auto known = std::find_if(uses_.begin(), uses_.end(), [&](const RecipeUse& use) {
                return use.recipe == orders[i].recipe;
            });
            RecipeUse& use = known != uses_.end()
                                 ? *known
                                 : uses_.emplace_back(RecipeUse{orders[i].recipe, {}, {}});
            use.meshes.push_back(i);
        }
        orders_ = orders;
    }

    Result<BakedFile> run(const Progress& progress, const GeometryPacking& packing) {
        for (RecipeUse& use : uses_)
            if (auto ok = prepare(use); !ok) return tl::unexpected(ok.error());
        for (size_t i = 0; i < model_.meshes.size(); ++i)
            if (auto ok = bake(i, progress); !ok) return tl::unexpected(ok.error());
        for (const RecipeUse& use : uses_)
            if (auto ok = judge(use); !ok) return tl::unexpected(ok.error());
        if (progress) progress("writing", 0.97);
        Result<std::vector<uint8_t>> glb =
            attachFractureSets(model_.document, sets_, added_, packing);
        if (!glb) return tl::unexpected(glb.error());
        file_.glb = std::move(*glb);
        return std::move(file_);
    }

  private:
    Result<void> prepare(RecipeUse& use) {
        std::vector<MeshUse> meshes;
        std::vector<const SurfaceMesh*> surfaces;
        for (const size_t i : use.meshes) {
            meshes.push_back({&model_.meshes[i], orders_[i].plan});
            surfaces.push_back(&model_.meshes[i]);
        }
        Result<ChosenMaterials> chosen =
            chooseInteriorMaterials(model_.document, surfaces, *use.recipe);
        if (!chosen) return tl::unexpected(chosen.error());
        use.interior = std::move(chosen->materials);
        if (auto ok = judgeRecipe(*use.recipe, meshes, use.interior.names); !ok) return ok;
        // Whichever recipe asks for it, the neutral material is the same.
        if (chosen->added && added_.empty()) added_.push_back(*chosen->added);
        return {};
    }

    Result<void> bake(size_t i, const Progress& progress) {
        const SurfaceMesh& mesh = model_.meshes[i];
        const BakeOrder& order = orders_[i];
        const auto use = std::find_if(uses_.begin(), uses_.end(),
                                      [&](const RecipeUse& u) { return u.recipe == order.recipe; });
        Result<BakedObject> object =
            bakeObject(mesh, *order.plan, *order.recipe, use->interior, progress);
        if (!object) return tl::unexpected(object.error());
        object->set.sameNodes = mesh.sameNodes;
        object->set.joinedNodes = mesh.joinedNodes;
        sets_.push_back(std::move(object->set));
        file_.report.objects.push_back(std::move(object->report));
        return {};
    }

    Result<void> judge(const RecipeUse& use) const {
        std::vector<const BakedObjectReport*> reports;
        for (const size_t i : use.meshes) reports.push_back(&file_.report.objects[i]);
        return judgeAnchors(*use.recipe, reports);
    }

    const Model& model_;
    std::vector<BakeOrder> orders_;  ///< per mesh
    std::vector<RecipeUse> uses_;
    std::vector<FractureSet> sets_;
    std::vector<NewMaterial> added_;
    BakedFile file_;
};

}  // namespace

Result<BakedFile> bakeModel(const Model& model, const std::vector<BakeOrder>& orders,
                            const Progress& progress, const GeometryPacking& packing) {
    const auto start = std::chrono::steady_clock::now();
    Result<BakedFile> file = ModelBake(model, orders).run(progress, packing);
    if (file)
        file->report.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return file;
}

Result<BakedFile> bakeModel(const Model& model, const FracturePlan& plan, const Recipe& recipe,
                            const Progress& progress) {
    return bakeModel(model, std::vector<BakeOrder>(model.meshes.size(), {&plan, &recipe}),
                     progress);
}

}  // namespace sherd
