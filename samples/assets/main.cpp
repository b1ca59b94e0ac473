// SPDX-License-Identifier: MIT
// sherd-sample-assets: writes the demo's models and their fracture maps.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "crack_drawing.h"
#include "glb_file.h"
#include "sample_object.h"
#include "sherd/formats/glb_write.h"

namespace {

using namespace sherd;
using namespace sherd::samples;

constexpr std::string_view kUsage =
    "usage: sherd-sample-assets OUTDIR\n"
    "\n"
    "Models, unwraps and paints a vase, a wall, a column and a statue, and draws two levels of\n"
    "cracks for each:\n"
    "  OUTDIR/<object>.glb          the intact model\n"
    "  OUTDIR/<object>_level1.svg   cracks into large pieces, drawn over the model's UV layout\n"
    "  OUTDIR/<object>_level2.svg   further cracks that divide those pieces\n"
    "  OUTDIR/<object>.recipe.json  how to bake it: both maps, inside material, density\n"
    "\n"
    "example:\n"
    "  sherd-sample-assets out\n"
    "  sherd-bake bake out/vase.glb --recipe out/vase.recipe.json -o out/vase_baked.glb\n";

bool write(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    const Result<void> done = writeFileWhole(path, bytes);
    if (!done) {
        std::fprintf(stderr, "error: %s (%s)\n", done.error().message.c_str(),
                     path.string().c_str());
        return false;
    }
    return true;
}

bool write(const std::filesystem::path& path, const std::string& text) {
    return write(path, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

bool isSound(const SampleObject& object, const TracedCracks& cracks) {
    if (!isClosedManifold(object.mesh) || signedVolume(object.mesh) <= 0) {
        std::fprintf(stderr, "error: the %s is not a closed surface facing outwards\n",
                     object.name.c_str());
        return false;
    }
    for (const std::vector<double>& areas : {cracks.areas1, cracks.areas2}) {
        // A sliver means that the noise has torn a flake off a cell: another seed avoids it.
        double total = 0;
        for (const double area : areas) total += area;
        if (areas.front() < 0.05 * total / double(areas.size())) {
            std::fprintf(stderr, "error: a crack tears a flake of %.1f mm2 off the %s\n",
                         areas.front() * 1e6, object.name.c_str());
            return false;
        }
    }
    return true;
}

bool writeObject(const SampleObject& object, const std::filesystem::path& folder) {
    const TracedCracks cracks = traceCracks(object.mesh, object.cracks);
    if (!isSound(object, cracks)) return false;
    const DrawOptions options;
    const std::vector<uint8_t> glb = toGlb(toGltf(object));
    if (!write(folder / (object.name + ".glb"), glb) ||
        !write(folder / (object.name + ".recipe.json"), toRecipe(object)) ||
        !write(folder / (object.name + "_level1.svg"), drawCracks(cracks.level1, 1, options)) ||
        !write(folder / (object.name + "_level2.svg"), drawCracks(cracks.level2, 2, options))) {
        return false;
    }
    std::printf("%-8s %6zu triangles  level 1: %2zu pieces of surface  level 2: %2zu\n",
                object.name.c_str(), object.mesh.triangles.size(), cracks.areas1.size(),
                cracks.areas2.size());
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view argument = argc == 2 ? argv[1] : "";
    if (argument == "--help" || argument == "-h") {
        std::fwrite(kUsage.data(), 1, kUsage.size(), stdout);
        return 0;
    }
    if (argument.empty() || argument.front() == '-') {
        std::fwrite(kUsage.data(), 1, kUsage.size(), stderr);
        return 2;
    }
    std::error_code error;
    std::filesystem::create_directories(argument, error);
    bool written = true;
    for (const auto make : {makeVase, makeWall, makeColumn, makeFigure})
        written = writeObject(make(), argument) && written;
    return written ? 0 : 1;
}
