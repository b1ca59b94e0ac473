// SPDX-License-Identifier: MIT
#include "layout_command.h"

#include <cstdio>
#include <memory>

#include "command_files.h"
#include "exit_codes.h"
#include "level_arguments.h"
#include "print_finding.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/import.h"
#include "sherd/baker/layout.h"
#include "sherd/formats/glb_write.h"

namespace sherd::cli {

namespace {

struct LayoutArguments {
    std::string model, output;
    ImportOptions import;
    LevelArguments lines;
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

Result<void> checkOutput(const LayoutArguments& arguments, const Recipe& recipe) {
    std::vector<std::filesystem::path> inputs = {arguments.model, arguments.lines.recipe};
    for (const RecipeLevel& level : recipe.levels) inputs.push_back(level.map);
    for (const std::filesystem::path& input : inputs) {
        if (input.empty() || !isSameFile(arguments.output, input)) continue;
        return fail(ErrorCode::badArgument,
                    "the template would overwrite what it is made from; choose another name",
                    arguments.output);
    }
    if (auto writable = checkWritable(arguments.output); !writable) return writable;
    if (!hasKind(arguments.output, ".svg")) {
        return fail(ErrorCode::badArgument, "a template is written as .svg; name the output so",
                    arguments.output);
    }
    return arguments.force ? Result<void>() : checkNothingDrawn(arguments.output);
}

/// What became of lines on each object, told as a bake tells it.
Result<std::vector<LayoutOverlay>> inspectModel(const Recipe& recipe, Model& model) {
    std::vector<LayoutOverlay> overlays;
    if (!chooseLines(recipe, model)) return overlays;
    const Result<FracturePlan> plan = readPlan(recipe);
    if (!plan) return tl::unexpected(plan.error());
    for (const FracturePlan::Drawing& drawing : plan->drawings)
        for (const std::string& warning : drawing.map.warnings)
            std::fprintf(stderr, "warning: %s\n", warning.c_str());
    for (const SurfaceMesh& mesh : model.meshes) {
        Result<LayoutOverlay> overlay = inspectLines(mesh, *plan, recipe);
        if (!overlay) return tl::unexpected(overlay.error());
        overlays.push_back(std::move(*overlay));
    }
    return overlays;
}

void printLayout(const LayoutArguments& arguments, const Model& model, const LayoutOptions& options,
                 const Layout& layout) {
    std::printf("%s: %zu chart border edges, %zu inner edges, %s", arguments.output.c_str(),
                layout.borderEdges, layout.innerEdges,
                options.texture.empty() ? "no texture" : "texture included");
    if (layout.seamLabels > 0) std::printf(", %zu seam numbers", layout.seamLabels);
    if (!options.overlays.empty()) std::printf(", %zu places to look at", layout.spots);
    std::printf("\n");
    for (size_t i = 0; i < options.overlays.size(); ++i) {
        if (options.overlays[i].findings.empty()) continue;
        std::printf("%s\n", model.meshes[i].name.c_str());
        for (const BakeFinding& finding : options.overlays[i].findings) printFinding(finding);
    }
}

Result<void> layOut(const LayoutArguments& arguments) {
    const Result<Recipe> recipe = recipeOf(arguments.lines);
    if (!recipe) return tl::unexpected(recipe.error());
    if (auto ok = checkOutput(arguments, *recipe); !ok) return ok;
    ImportOptions import = arguments.import;
    import.unitScale = recipe->unitScale;
    Result<Model> model = importModel(arguments.model, import);
    if (!model) return tl::unexpected(model.error());

    std::vector<std::string> warnings;
    LayoutOptions options = arguments.layout;
    for (const SurfaceMesh& mesh : model->meshes) {
        if (!arguments.texture || !options.texture.empty()) break;
        options.texture = baseColorTexture(model->document, mesh, warnings);
    }
    Result<std::vector<LayoutOverlay>> overlays = inspectModel(*recipe, *model);
    if (!overlays) return tl::unexpected(overlays.error());
    options.overlays = std::move(*overlays);
    const Result<Layout> layout = makeLayoutSvg(model->meshes, options);
    if (!layout) {
        Error error = layout.error();
        error.where = arguments.model + (error.where.empty() ? "" : ", ") + error.where;
        return tl::unexpected(std::move(error));
    }

    const auto* bytes = reinterpret_cast<const uint8_t*>(layout->svg.data());
    if (auto written = writeFileWhole(arguments.output, {bytes, layout->svg.size()}); !written)
        return written;
    warnings.insert(warnings.end(), layout->warnings.begin(), layout->warnings.end());
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    printLayout(arguments, *model, options, *layout);
    return {};
}

int runLayout(const LayoutArguments& arguments) {
    const Result<void> done = layOut(arguments);
    return done ? kExitOk : printError(done.error());
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
    command->add_flag("!--no-seam-labels", arguments->layout.seamLabels,
                      "Leave out the numbers that show which chart borders belong together");
    addLevelOptions(*command, "--lines",
                    "Lines drawn before (.svg, .json, .png or .jpg), to show what becomes of them; "
                    "may be repeated as --map of bake, coarse to fine",
                    arguments->lines);
    command->add_flag("--force", arguments->force,
                      "Overwrite the output even if fracture lines are drawn in it");
    command->footer(
        "Examples:\n"
        "  sherd-bake layout vase.glb -o vase_cracks.svg\n"
        "  sherd-bake layout town.glb --node Wall --node Gate -o wall_cracks.svg\n"
        "  sherd-bake layout vase.glb -o look.svg --lines vase_cracks.svg\n"
        "\n"
        "Draw lines into the layers \"level 1\" to \"level 3\" (coarse to fine), then\n"
        "  sherd-bake bake vase.glb --map vase_cracks.svg -o vase_baked.glb\n"
        "The layers \"sherd guide ...\" are for orientation and never become cracks. With --lines "
        "or\n"
        "--pattern, and for lines modelled on the object, they show the lines as they cut (dashed "
        "where\n"
        "nothing comes off) and rings around line ends, idle lines and tiny components.");
    command->callback([arguments, command, &exitCode] {
        if (const auto ok = orderLevels(*command, arguments->lines); !ok) {
            exitCode = printError(ok.error());
            return;
        }
        exitCode = runLayout(*arguments);
    });
}

}  // namespace sherd::cli
