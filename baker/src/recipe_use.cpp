// SPDX-License-Identifier: MIT
#include "recipe_use.h"

#include <algorithm>
#include <set>
#include <string>

#include "assembly/anchors.h"
#include "recipe/recipe_reader.h"

namespace sherd {
namespace {

const char* const kIdleAnchor = "anchor-empty";

std::string quoted(const std::string& name) {
    return "\"" + name + "\"";
}

std::string listOf(const std::set<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + quoted(name);
    return list;
}

std::string nothingHeld(const SurfaceMesh& mesh) {
    return "the anchor holds nothing: " + quoted(mesh.name) + " " + extentsInScene(mesh);
}

std::string nothingNamed(const RecipeAnchor& anchor, const BakedObject& object) {
    std::set<std::string> names;
    for (const Fragment& fragment : object.set.fragments) names.insert(fragment.name);
    names.erase("");
    return "the anchor holds nothing: no piece of " + quoted(object.report.name) + " is called " +
           quoted(anchor.label) +
           (names.empty() ? "; labels in a drawing give names" : "; there are " + listOf(names));
}

Result<void> judgePlaces(const Recipe& recipe, std::span<const MeshUse> meshes) {
    for (const RecipeAnchor& anchor : recipe.anchors) {
        if (anchor.kind == RecipeAnchor::Kind::label) continue;
        const bool held = std::any_of(meshes.begin(), meshes.end(), [&](const MeshUse& use) {
            return holdsAnything(anchor, *use.mesh);
        });
        if (!held && !meshes.empty())
            return fail(ErrorCode::badArgument, nothingHeld(*meshes[0].mesh), anchor.where);
    }
    return {};
}

Result<void> judgeMaterials(const Recipe& recipe, std::span<const MeshUse> meshes,
                            const std::map<int32_t, std::string>& names) {
    std::set<std::string> known;
    for (const MeshUse& use : meshes) {
        for (const int32_t material : use.mesh->materials)
            if (const auto name = names.find(material); name != names.end())
                known.insert(name->second);
        for (const FracturePlan::Drawing& drawing : use.plan->drawings)
            for (const FractureMap::Label& label : drawing.map.labels) known.insert(label.material);
    }
    known.erase("");
    for (const auto& [name, material] : recipe.materials) {
        if (known.count(name) > 0) continue;
        return fail(
            ErrorCode::badArgument,
            "no object has a material " + quoted(name) + " on its surface, and no label " +
                "names it; " +
                (known.empty() ? "there is none with a name" : "there are " + listOf(known)),
            recipe.place(RecipeReader::below("/materials", name)));
    }
    return {};
}

}  // namespace

Result<void> judgeRecipe(const Recipe& recipe, std::span<const MeshUse> meshes,
                         const std::map<int32_t, std::string>& materialNames) {
    if (auto ok = judgePlaces(recipe, meshes); !ok) return ok;
    return judgeMaterials(recipe, meshes, materialNames);
}

void reportAnchors(const SurfaceMesh& mesh, const std::vector<RecipeAnchor>& anchors,
                   const std::vector<bool>& holds, BakedObject& object) {
    for (size_t i = 0; i < anchors.size(); ++i) {
        if (holds[i]) continue;
        const bool named = anchors[i].kind == RecipeAnchor::Kind::label;
        if (!named && holdsAnything(anchors[i], mesh)) {
            object.report.findings.push_back(
                {"anchor-hidden", "all that the anchor could hold is held by those before it",
                 anchors[i].where, 1});
            continue;
        }
        object.report.findings.push_back(
            {kIdleAnchor, named ? nothingNamed(anchors[i], object) : nothingHeld(mesh),
             anchors[i].where, 1});
    }
}

Result<void> judgeAnchors(const Recipe& recipe, std::span<const BakedObjectReport* const> objects) {
    for (const RecipeAnchor& anchor : recipe.anchors) {
        const BakeFinding* idle = nullptr;
        size_t count = 0;
        for (const BakedObjectReport* object : objects) {
            for (const BakeFinding& finding : object->findings) {
                if (finding.code != kIdleAnchor || finding.where != anchor.where) continue;
                if (idle == nullptr) idle = &finding;
                ++count;
            }
        }
        if (count > 0 && count == objects.size())
            return fail(ErrorCode::badArgument, idle->message, anchor.where);
    }
    return {};
}

}  // namespace sherd
