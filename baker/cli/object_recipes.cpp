// SPDX-License-Identifier: MIT
#include "object_recipes.h"

#include <algorithm>

#include "level_arguments.h"

namespace sherd::cli {
namespace {

Result<void> checkLines(const ObjectRecipes& objects, const std::vector<size_t>& use,
                        const Model& model) {
    for (size_t r = 0; r < objects.recipes.size(); ++r) {
        const Recipe& recipe = objects.recipes[r];
        if (!recipe.levels.empty()) continue;
        bool used = false;
        bool modelled = false;
        for (size_t i = 0; i < use.size(); ++i) {
            used = used || use[i] == r;
            modelled = modelled || (use[i] == r && !model.meshes[i].lines.empty());
        }
        if (!used || modelled) continue;
        if (r > 0)
            return fail(ErrorCode::badArgument,
                        "the recipe has no levels, and no lines are modelled on its object: there "
                        "is nothing to cut along",
                        recipe.place("/levels"));
        return fail(ErrorCode::badArgument,
                    "there is nothing to cut along: draw lines and name them with --map, take a "
                    "--pattern (voronoi:12), model lines on the object, --cut through its volume "
                    "(voronoi:12), give a recipe with levels, or let the scene's nodes carry "
                    "recipes (extras.sherd)");
    }
    return {};
}

}  // namespace

Result<ObjectRecipes> recipesOfObjects(const Recipe& common, Model& model,
                                       const Adjustment& adjust) {
    ObjectRecipes objects;
    objects.recipes.push_back(common);
    for (const Recipe& own : model.recipes) {
        Recipe& recipe = objects.recipes.emplace_back(own);
        if (auto ok = adjust(recipe); !ok) return tl::unexpected(ok.error());
    }
    std::vector<size_t> use;
    for (size_t i = 0; i < model.meshes.size(); ++i) {
        const int32_t own = i < model.recipeOfMesh.size() ? model.recipeOfMesh[i] : -1;
        use.push_back(static_cast<size_t>(own + 1));
        if (!objects.recipes[use.back()].modelLines) model.meshes[i].lines.clear();
    }
    if (auto ok = checkLines(objects, use, model); !ok) return tl::unexpected(ok.error());
    for (size_t r = 0; r < objects.recipes.size(); ++r) {
        const bool used = std::find(use.begin(), use.end(), r) != use.end();
        Result<FracturePlan> plan = used ? readPlan(objects.recipes[r]) : FracturePlan();
        if (!plan) return tl::unexpected(plan.error());
        objects.plans.push_back(std::move(*plan));
    }
    for (const size_t r : use) objects.orders.push_back({&objects.plans[r], &objects.recipes[r]});
    return objects;
}

}  // namespace sherd::cli
