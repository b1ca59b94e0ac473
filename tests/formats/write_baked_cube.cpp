// SPDX-License-Identifier: MIT
// write_baked_cube FILE: a small baked file for the tools that judge files from outside.
#include "support/fractured_cube.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    sherd::test::FracturedCubeOptions options;
    options.size = {1.0F, 0.4F, 0.7F};
    options.splits = {{2, 1, 1}, {1, 2, 2}, {2, 1, 1}};
    options.anchorBottom = true;
    options.restPose.translation = {0.0F, 1.0F, 0.0F};
    const std::vector<uint8_t> glb = sherd::test::makeBakedCube(options);
    return !glb.empty() && sherd::writeFileWhole(argv[1], glb) ? 0 : 1;
}
