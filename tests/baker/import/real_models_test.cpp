// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "sherd/baker/import.h"
#include "support/models.h"

using namespace sherd;

namespace {

struct Expected {
    const char* file;
    size_t triangles;
    size_t welded;
};

// From the measures in the models' LICENSES.md.
constexpr Expected kDev[] = {
    {"Avocado.glb", 682, 363},
    {"BarramundiFish.glb", 3864, 1938},
    {"IridescenceAbalone.glb", 6036, 3012},
    {"Lantern.glb", 5394, 2737},
    {"SciFiHelmet.glb", 23358, 11879},
    {"WaterBottle.glb", 4510, 2385},
    {"barrel.glb", 1148, 576},
    {"egyptian_cat_statue.glb", 4622, 2309},
    {"kaykit_box_large.glb", 188, 96},
    {"kaykit_pillar_decorated.glb", 761, 421},
    {"kaykit_wall_window_closed.glb", 664, 464},
    {"cat_16k_atlas.glb", 15894, 7949},
    {"skull_41k_atlas.glb", 41000, 20498},
    {"nefertiti_30k_atlas.obj", 30000, 15002},
    {"cube_48.obj", 48, 26},
    {"spot_triangulated.obj", 5856, 2930},
};

constexpr Expected kLadder[] = {
    {"bunny_10k.glb", 10000, 5002},           {"bunny_15k.glb", 15000, 7502},
    {"bunny_20k.glb", 20000, 10002},          {"bunny_30k.glb", 30000, 15002},
    {"bunny_40k.glb", 40000, 20002},          {"bunny_50k.glb", 50000, 25002},
    {"bunny_59664.glb", 59664, 29834},        {"bunny_100k.glb", 100000, 50002},
    {"bunny_200k.glb", 200000, 100002},       {"bunny_400k.glb", 400000, 200002},
    {"bunny_xatlas_10k.glb", 10000, 5002},    {"bunny_xatlas_30k.glb", 30000, 15002},
    {"bunny_xatlas_59664.glb", 59664, 29834}, {"nefertiti_10k.glb", 10000, 5002},
    {"nefertiti_30k.glb", 30000, 15002},      {"nefertiti_70k.glb", 70000, 35002},
    {"nefertiti_100k.glb", 100000, 50002},    {"nefertiti_400k.glb", 400000, 200002},
};

void checkModel(const std::filesystem::path& path, const Expected& expected) {
    CAPTURE(path.string());
    auto model = importModel(path, {});
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    size_t triangles = 0;
    size_t welded = 0;
    for (const SurfaceMesh& mesh : model->meshes) {
        triangles += mesh.triangles.size();
        welded += mesh.positions.size();
        CHECK(mesh.corners.size() == mesh.triangles.size());
        CHECK(mesh.triangleMaterials.size() == mesh.triangles.size());
        CHECK(mesh.uvSemantic == "TEXCOORD_0");
        CHECK(findAttribute(mesh.attributes, "NORMAL") != nullptr);
    }
    CHECK(triangles == expected.triangles);
    CHECK(welded == expected.welded);
}

}  // namespace

TEST_CASE("the real models come in with the counts measured for them") {
    if (!test::haveSharedModels()) {
        MESSAGE("no real models beside the checkout");
        return;
    }
    for (const Expected& e : kDev) checkModel(test::sharedDir() / "models" / "dev" / e.file, e);
    for (const Expected& e : kLadder)
        checkModel(test::sharedDir() / "models" / "ladder" / e.file, e);
}

TEST_CASE("files that are missing, truncated or of another kind are told apart") {
    const auto folder = std::filesystem::temp_directory_path() / "sherd_import_test";
    std::filesystem::create_directories(folder);
    CHECK(importModel(folder / "none.obj", {}).error().code == ErrorCode::fileNotFound);
    CHECK(importModel(folder / "none.glb", {}).error().code == ErrorCode::fileNotFound);
    CHECK(importModel(folder / "scene.fbx", {}).error().code == ErrorCode::unsupported);
    std::ofstream(folder / "short.glb", std::ios::binary) << "glTF\2";
    CHECK(importModel(folder / "short.glb", {}).error().code == ErrorCode::malformed);
    std::ofstream(folder / "text.gltf") << "{\"asset\":";
    CHECK(importModel(folder / "text.gltf", {}).error().code == ErrorCode::malformed);
    std::filesystem::create_directories(folder / "folder.obj");
    CHECK(importModel(folder / "folder.obj", {}).error().code == ErrorCode::fileRead);
    std::filesystem::remove_all(folder);
}
