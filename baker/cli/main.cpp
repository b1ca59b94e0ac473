// SPDX-License-Identifier: MIT
// sherd-bake: thin over the libraries; each subcommand has its own file.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bake_command.h"
#include "check_command.h"
#include "exit_codes.h"
#include "export_command.h"
#include "layout_command.h"
#include "process_heap.h"
#include "recipe_command.h"

int main(int argc, char** argv) {
    using namespace sherd::cli;
    keepFreedMemory();
    CLI::App app(
        "Sherd: artist-driven destruction. Bakes fracture lines drawn on a model into a glTF "
        "file.");
    app.name("sherd-bake");
    app.set_version_flag("--version", SHERD_VERSION);
    app.require_subcommand(1);
    int exitCode = kExitOk;
    addLayoutCommand(app, exitCode);
    addBakeCommand(app, exitCode);
    addCheckCommand(app, exitCode);
    addExportCommand(app, exitCode);
    addRecipeCommand(app, exitCode);
    app.footer(
        "A first bake:\n"
        "  sherd-bake layout vase.glb -o cracks.svg      draw lines over the template\n"
        "  sherd-bake bake vase.glb -o vase_baked.glb --map cracks.svg\n"
        "  sherd-bake check vase_baked.glb               prove it sound\n"
        "  sherd-bake export vase_baked.glb -o pieces    look at the pieces\n"
        "\n"
        "Exit codes: 0 done, 1 internal error, 2 usage, 3 bad option value, 4 file not found, 5 "
        "cannot read,\n"
        "6 cannot write, 7 malformed file, 8 invalid data, 9 unsupported, 10 unsupported glTF "
        "extension,\n"
        "11 limit exceeded, 12 no triangles, 13 no texture coordinates, 14 skinned or morphed, 15 "
        "open mesh,\n"
        "16 non-manifold mesh, 17 empty map, 18 map separates nothing, 19 fragment not closed,\n"
        "20 check failed, 21 file holds no fracture set.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? kExitOk : kExitUsage;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "sherd-bake: out of memory\n");
        return kExitInternal;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "sherd-bake: internal error: %s\n", e.what());
        return kExitInternal;
    }
    // Results are written as they come; a reader that got half of them must not see success.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        std::fprintf(stderr, "sherd-bake: standard output: not everything could be written\n");
        if (exitCode == kExitOk) exitCode = kExitFileWrite;
    }
    return exitCode;
}
