// SPDX-License-Identifier: MIT
#include "layout_command.h"

#include <cstdio>
#include <memory>

#include "command_files.h"
#include "exit_codes.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/import.h"
#include "sherd/baker/layout.h"
#include "sherd/formats/glb_write.h"

namespace sherd::cli {

namespace {

struct LayoutArguments {
    std::string model, output;
    ImportOptions import;
    LayoutOptions layout;
    bool texture = true;
    bool force = false;
};

/// The template and the drawing over it bear the same name: hours of drawing must not be lost to a
/// second call.
Result<void> checkNothingDrawn(const std::filesystem::path& output) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(output, ignored)) return {};
    const Result<FractureMap> drawn = readFractureMap(output, {});
    if (!drawn) return {};
    return fail(ErrorCode::fileWrite,
                "the drawing holds " + std::to_string(drawn->lines.size()) +
                    " fracture lines, which would be lost; choose another name, or --force",
                output.string());
}

int runLayout(const LayoutArguments& arguments) {
    if (auto writable = checkWritable(arguments.output); !writable)
        return printError(writable.error());
    if (!arguments.force) {
        if (auto free = checkNothingDrawn(arguments.output); !free) return printError(free.error());
    }
    const Result<Model> model = importModel(arguments.model, arguments.import);
    if (!model) return printError(model.error());

    std::vector<std::string> warnings;
    LayoutOptions options = arguments.layout;
    for (const SurfaceMesh& mesh : model->meshes) {
        if (!arguments.texture || !options.texture.empty()) break;
        options.texture = baseColorTexture(model->document, mesh, warnings);
    }
    const Result<Layout> layout = makeLayoutSvg(model->meshes, options);
    if (!layout) {
        Error error = layout.error();
        error.where = arguments.model + (error.where.empty() ? "" : ", ") + error.where;
        return printError(error);
    }

    const auto* bytes = reinterpret_cast<const uint8_t*>(layout->svg.data());
    const Result<void> written = writeFileWhole(arguments.output, {bytes, layout->svg.size()});
    if (!written) return printError(written.error());

    warnings.insert(warnings.end(), layout->warnings.begin(), layout->warnings.end());
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    std::printf("%s: %zu chart border edges, %zu inner edges, %s\n", arguments.output.c_str(),
                layout->borderEdges, layout->innerEdges,
                options.texture.empty() ? "no texture" : "texture included");
    return kExitOk;
}

}  // namespace

void addLayoutCommand(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand(
        "layout", "Write the model's UV layout as an SVG to draw fracture lines over");
    auto arguments = std::make_shared<LayoutArguments>();
    command->add_option("model", arguments->model, "The model: .glb, .gltf or .obj")->required();
    command->add_option("-o,--output", arguments->output, "The SVG to write")->required();
    command
        ->add_option("--node", arguments->import.nodes,
                     "Only this mesh node (name or index); may be repeated")
        ->allow_extra_args(false);
    command->add_option("--uv", arguments->import.uvSet, "The UV set to draw in")
        ->capture_default_str();
    command->add_flag("--join", arguments->import.join,
                      "Take the chosen nodes for parts of one object, named after the first");
    command
        ->add_option("--resolution", arguments->layout.resolution,
                     "Side of the drawing in user units, 16 to 65536")
        ->capture_default_str();
    command->add_flag("!--no-texture", arguments->texture, "Leave the base-colour texture out");
    command->add_flag("--force", arguments->force,
                      "Overwrite the output even if fracture lines are drawn in it");
    command->footer(
        "Examples:\n"
        "  sherd-bake layout vase.glb -o vase_cracks.svg\n"
        "  sherd-bake layout town.glb --node Wall --node Gate -o wall_cracks.svg\n"
        "\n"
        "Draw lines into the layers \"level 1\" to \"level 3\" (coarse to fine), then\n"
        "  sherd-bake bake vase.glb --map vase_cracks.svg -o vase_baked.glb\n"
        "The layer \"sherd guide\" is for orientation and never becomes cracks.");
    command->callback([arguments, &exitCode] { exitCode = runLayout(*arguments); });
}

}  // namespace sherd::cli
