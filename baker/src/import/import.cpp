// SPDX-License-Identifier: MIT
#include "sherd/baker/import.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <fstream>

#include "import/gltf_import.h"
#include "import/node_recipes.h"
#include "import/obj_import.h"
#include "import/unit_scale.h"

namespace sherd {
namespace {

Result<std::string> readText(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        return fail(ErrorCode::fileNotFound, "the file does not exist", path.string());
    }
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const auto size = in.tellg();
    if (!in || size < 0 || std::filesystem::is_directory(path, error)) {
        return fail(ErrorCode::fileRead, "the file cannot be read", path.string());
    }
    std::string text(static_cast<size_t>(size), '\0');
    in.seekg(0);
    in.read(text.data(), size);
    if (!in) return fail(ErrorCode::fileRead, "the file cannot be read", path.string());
    return text;
}

Result<Model> importByKind(const std::filesystem::path& path, const ImportOptions& options) {
    std::string kind = path.extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (kind == ".obj") {
        auto text = readText(path);
        if (!text) return tl::unexpected(text.error());
        return importObj(*text, path, options);
    }
    if (kind != ".glb" && kind != ".gltf") {
        return fail(ErrorCode::unsupported, "Sherd reads .glb, .gltf and .obj models",
                    path.string());
    }
    auto document = loadGltfDocument(path);
    if (!document) return tl::unexpected(document.error());
    Model model;
    model.document = std::move(*document);
    NodeRecipes recipes;
    if (options.nodeRecipes) {
        auto read = readNodeRecipes(model.document, path, options);
        if (!read) return tl::unexpected(read.error());
        recipes = std::move(*read);
    } else {
        model.unreadRecipes = countNodeRecipes(model.document);
    }
    const std::string name = path.filename().string();
    if (const auto unit = options.unitScale ? options.unitScale : recipes.unitScale) {
        if (auto ok = scaleScenes(model.document, name, *unit); !ok)
            return tl::unexpected(ok.error());
    }
    auto meshes = importGltf(model.document, name, options, recipes);
    if (!meshes) return tl::unexpected(meshes.error());
    model.meshes = std::move(*meshes);
    for (const SurfaceMesh& mesh : model.meshes)
        model.recipeOfMesh.push_back(recipes.of(mesh.node));
    model.recipes = std::move(recipes.recipes);
    return model;
}

}  // namespace

Result<Model> importModel(const std::filesystem::path& path, const ImportOptions& options) {
    try {
        return importByKind(path, options);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "the model does not fit in memory", path.string());
    } catch (const std::exception& exception) {
        return fail(ErrorCode::fileRead, exception.what(), path.string());
    }
}

}  // namespace sherd
