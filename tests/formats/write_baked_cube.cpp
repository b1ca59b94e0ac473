// SPDX-License-Identifier: MIT
// write_baked_cube FILE [joined|draco]: a small baked file for the tools that judge files from
// outside; with `joined` one whose object consists of two nodes and has fragments of named
// materials, otherwise one whose object stands in two places.
#include <cstring>

#include "support/fractured_cube.h"

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) return 2;
    sherd::test::FracturedCubeOptions options;
    options.size = {1.0F, 0.4F, 0.7F};
    options.splits = {{2, 1, 1}, {1, 2, 2}, {2, 1, 1}};
    options.anchorBottom = true;
    options.restPose.translation = {0.0F, 1.0F, 0.0F};
    sherd::FractureSet set = sherd::test::makeFracturedCube(options);
    sherd::GltfDocument document = sherd::test::makeIntactDocument(set);
    document.json.insert(document.json.find("],\"meshes\""),
                         R"(,{"mesh":0,"translation":[4,0,0]})");
    const std::string roots = "\"nodes\":[0]";
    document.json.replace(document.json.find(roots), roots.size(), "\"nodes\":[0,1]");
    if (argc == 3 && std::strcmp(argv[2], "joined") == 0) {
        set.joinedNodes = {1};
        set.fragments[1].material = "oak";
    } else {
        set.sameNodes = {1};
    }
    const sherd::NewMaterial inside{"inside", {0.8F, 0.7F, 0.6F, 1.0F}, 0.0F, 1.0F};
    sherd::GeometryPacking packing;
    if (argc == 3 && std::strcmp(argv[2], "draco") == 0)
        packing.encoding = sherd::GeometryPacking::Encoding::draco;
    const auto glb = sherd::attachFractureSets(document, {&set, 1}, {&inside, 1}, packing);
    return glb && sherd::writeFileWhole(argv[1], *glb) ? 0 : 1;
}
