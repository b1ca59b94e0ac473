// SPDX-License-Identifier: MIT
// `sherd-bake export` and `check` as the shell sees them: files and exit codes.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "check_command.h"
#include "exit_codes.h"
#include "export_command.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::test;
using namespace sherd::cli;

namespace {

class Folder {
  public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "sherd_XXXXXX").string();
        path = ::mkdtemp(pattern.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

size_t filesIn(const std::filesystem::path& folder) {
    const std::filesystem::directory_iterator begin(folder);
    return static_cast<size_t>(std::distance(begin, std::filesystem::directory_iterator()));
}

std::filesystem::path writeCube(const Folder& folder, const FracturedCubeOptions& options) {
    const auto path = folder.path / "cube.glb";
    REQUIRE(writeFileWhole(path, makeBakedCube(options)));
    return path;
}

struct Obj {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> faces;
    std::vector<std::string> materials;
};

Obj readObj(const std::filesystem::path& path) {
    Obj obj;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            std::array<std::string, 3> n;
            words >> n[0] >> n[1] >> n[2];
            obj.positions.emplace_back(std::strtof(n[0].c_str(), nullptr),
                                       std::strtof(n[1].c_str(), nullptr),
                                       std::strtof(n[2].c_str(), nullptr));
        } else if (key == "f") {
            std::array<std::string, 3> n;
            words >> n[0] >> n[1] >> n[2];
            obj.faces.push_back({});
            for (int i = 0; i < 3; ++i)
                obj.faces.back()[i] = static_cast<uint32_t>(std::atoi(n[i].c_str())) - 1;
        } else if (key == "usemtl") {
            obj.materials.emplace_back();
            words >> obj.materials.back();
        }
    }
    return obj;
}

bool isClosedObj(const Obj& obj) {
    std::map<std::array<uint32_t, 2>, int> net;
    for (const auto& f : obj.faces)
        for (int i = 0; i < 3; ++i) {
            const uint32_t a = f[i];
            const uint32_t b = f[(i + 1) % 3];
            net[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    for (const auto& [edge, count] : net)
        if (count != 0) return false;
    return !net.empty();
}

}  // namespace

TEST_CASE("every fragment of every level is exported closed, with its positions unchanged") {
    const Folder folder;
    FracturedCubeOptions options;
    options.size = {0.3F, 0.1F, 0.7F};
    const auto out = folder.path / "a" / "b";
    REQUIRE(runExport({writeCube(folder, options), out}) == kExitOk);
    CHECK(filesIn(out) == 1 + 2 + 16);
    for (const char* name :
         {"level0_fragment0.obj", "level1_fragment1.obj", "level2_fragment15.obj"})
        CHECK(isClosedObj(readObj(out / name)));
    const FractureSet set = makeFracturedCube(options);
    const Obj obj = readObj(out / "level2_fragment15.obj");
    CHECK(obj.positions.size() == 8);
    for (const glm::vec3& p : obj.positions)
        CHECK(std::find(set.geometry.positions.begin(), set.geometry.positions.end(), p) !=
              set.geometry.positions.end());
    CHECK(obj.materials == std::vector<std::string>{"outside", "inside"});
}

TEST_CASE("fragments stand in the scene where the object stands") {
    const Folder folder;
    FracturedCubeOptions options;
    options.restPose.translation = {10.0F, 0.0F, 0.0F};
    options.restPose.rotation = glm::quat(std::sqrt(0.5F), 0.0F, 0.0F, std::sqrt(0.5F));
    options.size = {1.0F, 4.0F, 1.0F};
    const auto out = folder.path / "out";
    REQUIRE(runExport({writeCube(folder, options), out}) == kExitOk);
    const Obj obj = readObj(out / "level0_fragment0.obj");
    CHECK(isClosedObj(obj));
    float low = obj.positions[0].x;
    float high = low;
    for (const glm::vec3& p : obj.positions) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
    }
    CHECK(low == doctest::Approx(8.0F));
    CHECK(high == doctest::Approx(12.0F));
}

TEST_CASE("several objects get a directory each") {
    const Folder folder;
    FractureSet first = makeFracturedCube();
    FractureSet second = first;
    first.name = "a/b c";
    second.name = "..";
    second.node = 1;
    GltfDocument document = makeIntactDocument(first);
    const std::string nodes = "\"nodes\":[{\"name\"";
    document.json.replace(document.json.find(nodes), nodes.size(),
                          "\"nodes\":[{\"mesh\":0},{\"name\"");
    const std::vector<FractureSet> sets = {first, second};
    const NewMaterial inside{"in side"};
    const auto glb = attachFractureSets(document, sets, {&inside, 1});
    REQUIRE(glb);
    REQUIRE(writeFileWhole(folder.path / "two.glb", *glb));
    const auto out = folder.path / "out";
    REQUIRE(runExport({folder.path / "two.glb", out}) == kExitOk);
    CHECK(filesIn(out) == 2);
    CHECK(filesIn(out / "a_b_c") == 19);
    CHECK(filesIn(out / "object1") == 19);
    CHECK(readObj(out / "object1" / "level2_fragment0.obj").materials.back() == "in_side");
}

TEST_CASE("an export that cannot finish leaves nothing behind") {
    const Folder folder;
    const auto out = folder.path / "out";
    std::filesystem::create_directories(out / "level2_fragment9.obj" / "in the way");
    CHECK(runExport({writeCube(folder, {}), out}) == kExitFileWrite);
    CHECK(filesIn(out) == 1);
}

TEST_CASE("each kind of bad input has its own exit code") {
    const Folder folder;
    const auto cube = writeCube(folder, {});
    CheckArguments check;
    check.input = folder.path / "none.glb";
    CHECK(runCheck(check) == kExitFileNotFound);
    check.input = folder.path;
    CHECK(runCheck(check) == kExitFileRead);
    check.input = folder.path / "text.glb";
    std::ofstream(check.input) << "no model";
    CHECK(runCheck(check) == kExitMalformed);
    check.input = folder.path / "plain.glb";
    REQUIRE(writeFileWhole(check.input, toGlb(makeIntactDocument(makeFracturedCube()))));
    CHECK(runCheck(check) == kExitNoFractureSet);
    CHECK(runExport({check.input, folder.path / "out"}) == kExitNoFractureSet);
    CHECK_FALSE(std::filesystem::exists(folder.path / "out"));
    check.input = cube;
    CHECK(runCheck(check) == kExitOk);
    auto document = parseGlb(makeBakedCube(), "cube");
    REQUIRE(document);
    document->bin[40] ^= 1;
    REQUIRE(writeFileWhole(cube, toGlb(*document)));
    CHECK(runCheck(check) == kExitCheckFailed);
}
