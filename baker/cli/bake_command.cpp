// SPDX-License-Identifier: MIT
#include "bake_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

#include "command_files.h"
#include "exit_codes.h"
#include "level_arguments.h"
#include "object_recipes.h"
#include "print_finding.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd::cli {
namespace {

struct BakeArguments {
    std::filesystem::path model, output, report;
    LevelArguments lines;
    ImportOptions import;
    std::string interior, interiorMaterial;
    std::string encoding = "none";
    GeometryPacking packing;
    std::optional<double> shellThickness;
    std::optional<double> density;
    std::optional<double> unitScale;
    std::optional<unsigned> threads;
    bool thesis = false;
    bool allowOpen = false;
    bool capHoles = false;
    bool measure = false;
    bool quiet = false;
};

/// One line on stderr, rewritten in place on a terminal and kept silent for bakes under a second.
class ProgressLine {
  public:
    explicit ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
    void show(const std::string& stage, double share) {
        const std::scoped_lock lock(mutex_);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        if (quiet_ || (!terminal_ && seconds < 1)) return;
        std::fprintf(stderr, terminal_ ? "\r\033[K%3.0f %%  %s" : "%3.0f %%  %s\n", share * 100,
                     stage.c_str());
        shown_ = true;
    }
    void finish() {
        if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
    }

  private:
    bool quiet_, terminal_, shown_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
};

/// Over a recipe, what the command line says of all but lines.
Result<void> adjustSettings(const BakeArguments& arguments, Recipe& recipe) {
    if (arguments.density) recipe.physics.density = *arguments.density;
    if (arguments.threads) recipe.threads = *arguments.threads;
    if (!arguments.interior.empty()) {
        const Result<InteriorType> type = parseInteriorType(arguments.interior);
        if (!type) return fail(type.error().code, "--interior: " + type.error().message);
        recipe.interior.type = *type;
    }
    if (arguments.shellThickness) recipe.interior.shell.thickness = *arguments.shellThickness;
    ShellSettings& shell = recipe.interior.shell;
    if (!shell.texture.empty()) {
        Result<GreyImage> picture = readGreyImage(shell.texture);
        if (!picture) return tl::unexpected(picture.error());
        shell.picture = std::make_shared<const GreyImage>(std::move(*picture));
    }
    recipe.interior.thesis = recipe.interior.thesis || arguments.thesis;
    recipe.allowOpen = recipe.allowOpen || arguments.allowOpen;
    recipe.capHoles = recipe.capHoles || arguments.capHoles;
    if (arguments.measure) recipe.measure = true;
    if (!recipe.measure) recipe.measure = !arguments.report.empty();
    if (!arguments.interiorMaterial.empty()) recipe.interior.material = arguments.interiorMaterial;
    return {};
}

Result<Recipe> gatherRecipe(const BakeArguments& arguments) {
    Result<Recipe> recipe = recipeOf(arguments.lines);
    if (!recipe) return recipe;
    if (auto ok = adjustSettings(arguments, *recipe); !ok) return tl::unexpected(ok.error());
    return recipe;
}

/// A measure in a column of the table, or nothing.
template <class Value>
std::string cell(const char* format, const std::optional<Value>& value, double scale = 1) {
    if (!value) return "";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, scale * static_cast<double>(*value));
    return text.data();
}

void printLevels(const BakedObjectReport& object) {
    for (size_t k = 0; k < object.levels.size(); ++k) {
        const BakedLevelReport& level = object.levels[k];
        std::printf("%-24.24s %5zu %10u %11u %7.4g%% %8.5g%% %7.3g%%",
                    k == 0 ? object.name.c_str() : "", k, level.fragments, level.components,
                    100.0 * level.closed / std::max(level.fragments, 1U), 100 * level.volumeShare,
                    100 * level.hiddenShare);
        if (level.protrusion)
            std::printf(" %8s %8s %9s %9s %9s", cell("%.3g%%", level.coverageNone, 100).c_str(),
                        cell("%.3g%%", level.coverageDouble, 100).c_str(),
                        cell("%.2g", level.protrusion, 1 / object.diagonal).c_str(),
                        cell("%.0f", level.selfIntersections).c_str(),
                        cell("%.3g m", level.thinnest).c_str());
        if (level.colliders)
            std::printf(" %6u %7.3g%% %9.2g", level.colliders->hulls,
                        100 * level.colliders->coverage,
                        level.colliders->overlap / object.diagonal);
        std::printf("\n");
    }
}

void printTable(const BakeReport& report) {
    std::printf("%-24s %5s %10s %11s %8s %9s %8s", "object", "level", "fragments", "components",
                "closed", "volume", "hidden");
    const bool measured = !report.objects.empty() && report.objects[0].levels[0].protrusion;
    if (measured)
        std::printf(" %8s %8s %9s %9s %9s %6s %8s %9s", "none", "double", "outside", "crossings",
                    "thinnest", "hulls", "filled", "overlap");
    std::printf("\n");
    for (const BakedObjectReport& object : report.objects) {
        printLevels(object);
        std::printf("  %u triangles, %u after cutting, %u bonds;", object.triangles,
                    object.splitTriangles, object.bonds);
        for (const StageTime& stage : object.stages)
            std::printf(" %s %.0f ms,", stage.name.c_str(), stage.seconds * 1e3);
        std::printf(" in all %.2f s\n", report.seconds);
        for (const BakeFinding& finding : object.findings) printFinding(finding);
    }
}

/// The report beside the bake: both files or neither, as far as the disk allows.
class ReportFile {
  public:
    explicit ReportFile(std::filesystem::path path) : path_(std::move(path)) {}
    ReportFile(const ReportFile&) = delete;
    ReportFile& operator=(const ReportFile&) = delete;
    ~ReportFile() {
        std::error_code ignored;
        if (!staged_.empty()) std::filesystem::remove(staged_, ignored);
    }

    Result<void> stage(std::string text) {
        text_ = std::move(text);
        if (path_.empty()) return {};
        if (isDevice()) return write(path_);
        std::error_code ignored;
        target_ = std::filesystem::weakly_canonical(path_, ignored);
        if (target_.empty()) target_ = path_;
        staged_ = target_.string() + ".part";
        if (auto written = write(staged_); !written)
            return fail(written.error().code, written.error().message, path_.string());
        return {};
    }

    Result<void> commit() {
        if (staged_.empty()) return {};
        std::error_code code;
        std::filesystem::rename(staged_, target_, code);
        if (code) return fail(ErrorCode::fileWrite, "the report: " + code.message(), path_);
        staged_.clear();
        return {};
    }

  private:
    bool isDevice() const {
        std::error_code ignored;
        return std::filesystem::exists(path_, ignored) &&
               !std::filesystem::is_regular_file(path_, ignored);
    }
    Result<void> write(const std::filesystem::path& path) const {
        return writeFileWhole(path, {reinterpret_cast<const uint8_t*>(text_.data()), text_.size()});
    }

    std::filesystem::path path_, target_, staged_;
    std::string text_;
};

/// A bake may take long: what cannot be written at its end, or would overwrite somebody's work, is
/// said at its start. The model itself may be the output: its document is kept.
Result<void> checkOutputs(const BakeArguments& arguments, const Recipe& recipe) {
    std::vector<std::filesystem::path> inputs = {arguments.lines.recipe};
    // A recipe that stands in the model is no file of its own.
    if (recipe.pointer.empty()) inputs.emplace_back(recipe.file);
    for (const RecipeLevel& level : recipe.levels) {
        if (!level.map.empty()) inputs.push_back(level.map);
        if (level.cut && !level.cut->map.empty()) inputs.push_back(level.cut->map);
    }
    for (const std::filesystem::path* output : {&arguments.output, &arguments.report}) {
        if (output->empty()) continue;
        for (const auto& input : inputs) {
            if (input.empty() || !isSameFile(*output, input)) continue;
            return fail(ErrorCode::badArgument,
                        "the output would overwrite an input of the bake; choose another name",
                        output->string());
        }
        if (auto writable = checkWritable(*output); !writable) return writable;
    }
    if (!arguments.report.empty() && (isSameFile(arguments.report, arguments.output) ||
                                      isSameFile(arguments.report, arguments.model))) {
        return fail(ErrorCode::badArgument,
                    "the report would overwrite the model or its bake; choose another name",
                    arguments.report.string());
    }
    // No other name: a model's own buffers and textures are inputs too.
    if (!hasKind(arguments.output, ".glb")) {
        return fail(ErrorCode::badArgument, "a bake is written as one .glb; name the output so",
                    arguments.output.string());
    }
    return {};
}

/// The scene as the command line wants it, with the recipes its objects bring unless one was given
/// for all.
Result<Model> readModel(const BakeArguments& arguments, const Recipe& common) {
    ImportOptions options = arguments.import;
    options.nodeRecipes = arguments.lines.recipe.empty();
    options.wholeScene = !arguments.lines.levels.empty();
    options.anchors = common.anchors;
    options.unitScale = arguments.unitScale ? arguments.unitScale : common.unitScale;
    Result<Model> model = importModel(arguments.model, options);
    if (model && model->unreadRecipes > 0)
        model->meshes.front().warnings.push_back(
            "the recipes that the scene carries (" + std::to_string(model->unreadRecipes) +
            ") were left out: --recipe says how everything breaks");
    return model;
}

Result<ObjectRecipes> gatherRecipes(const BakeArguments& arguments, const Recipe& common,
                                    Model& model) {
    const auto adjust = [&arguments](Recipe& recipe) {
        const Result<void> lines = adjustOwnRecipe(arguments.lines, recipe);
        return lines ? adjustSettings(arguments, recipe) : lines;
    };
    Result<ObjectRecipes> objects = recipesOfObjects(common, model, adjust);
    if (!objects) return objects;
    for (const Recipe& recipe : objects->recipes)
        if (auto ok = checkOutputs(arguments, recipe); !ok) return tl::unexpected(ok.error());
    return objects;
}

/// A shell's thickness that nothing needs.
void reportIdleThickness(const std::vector<BakeOrder>& orders, BakeReport& report) {
    for (size_t i = 0; i < orders.size(); ++i) {
        const Recipe& recipe = *orders[i].recipe;
        if (recipe.interior.type == InteriorType::shell || recipe.allowOpen) continue;
        report.objects[i].findings.push_back(
            {"shell-unused",
             "a shell's thickness was given, but nothing got a shell: ask for one with --interior "
             "shell",
             "", 1});
    }
}

/// A bake may take long: that it could not be written is said at its start.
Result<GeometryPacking> choosePacking(const BakeArguments& arguments) {
    GeometryPacking packing = arguments.packing;
    if (arguments.encoding == "draco") packing.encoding = GeometryPacking::Encoding::draco;
    if (packing.encoding == GeometryPacking::Encoding::draco && !hasDraco())
        return fail(ErrorCode::unsupported,
                    "--encoding draco: this build of Sherd has no Draco; configure it with "
                    "-DSHERD_DRACO=ON");
    return packing;
}

Result<BakedFile> bakeFiles(const BakeArguments& arguments, const Progress& progress) {
    const Result<GeometryPacking> packing = choosePacking(arguments);
    if (!packing) return tl::unexpected(packing.error());
    const Result<Recipe> common = gatherRecipe(arguments);
    if (!common) return tl::unexpected(common.error());
    if (auto writable = checkOutputs(arguments, *common); !writable)
        return tl::unexpected(writable.error());
    progress("reading", 0);
    Result<Model> model = readModel(arguments, *common);
    if (!model) return tl::unexpected(model.error());
    const Result<ObjectRecipes> objects = gatherRecipes(arguments, *common, *model);
    if (!objects) return tl::unexpected(objects.error());
    Result<BakedFile> baked = bakeModel(*model, objects->orders, progress, *packing);
    if (!baked) {
        Error error = baked.error();
        error.where = arguments.model.string() + (error.where.empty() ? "" : ", ") + error.where;
        return tl::unexpected(std::move(error));
    }
    baked->report.source = arguments.model.string();
    if (arguments.shellThickness) reportIdleThickness(objects->orders, baked->report);
    return baked;
}

Result<void> writeFiles(const BakeArguments& arguments, const BakedFile& baked) {
    ReportFile report(arguments.report);
    if (auto staged = report.stage(toJson(baked.report)); !staged) return staged;
    if (auto written = writeFileWhole(arguments.output, baked.glb); !written) return written;
    return report.commit();
}

int runBake(const BakeArguments& arguments) {
    ProgressLine line(arguments.quiet);
    const Result<BakedFile> baked = bakeFiles(
        arguments, [&line](const std::string& stage, double share) { line.show(stage, share); });
    line.finish();
    if (!baked) return printError(baked.error());
    if (const auto written = writeFiles(arguments, *baked); !written)
        return printError(written.error());
    if (!arguments.quiet) printTable(baked->report);
    return kExitOk;
}

}  // namespace

void addBakeCommand(CLI::App& app, int& exitCode) {
    const auto arguments = std::make_shared<BakeArguments>();
    const Recipe defaults;
    CLI::App* command = app.add_subcommand(
        "bake", "Cut a model along drawn lines, level by level, into closed fragments");
    command->add_option("MODEL", arguments->model, "The model: .glb, .gltf or .obj")->required();
    command->add_option("-o,--output", arguments->output, "The baked .glb to write")->required();
    addLevelOptions(*command, "--map",
                    "A fracture map (.svg, .json, .png or .jpg); repeat it for each deeper level, "
                    "coarse to fine. With one map its layers \"level 1..n\" choose the level",
                    arguments->lines);
    command->add_option("--report", arguments->report,
                        "Write what was done, found and measured as JSON");
    command->add_flag(
        "--measure", arguments->measure,
        "Measure how well the pieces fill the object, what sticks out, crosses itself "
        "or is thin; with --report this is done anyway");
    command
        ->add_option("--node", arguments->import.nodes,
                     "Only this mesh node (name or index); may be repeated")
        ->allow_extra_args(false);
    command->add_option("--uv", arguments->import.uvSet, "The UV set the lines are drawn in")
        ->capture_default_str();
    command->add_flag("--join", arguments->import.join,
                      "Take the chosen nodes for parts of one object, named after the first");
    command
        ->add_option("--interior", arguments->interior,
                     "How pieces are closed inside (default medial)")
        ->check(CLI::IsMember({"medial", "shell", "solid"}));
    command
        ->add_option("--shell-thickness", arguments->shellThickness,
                     "Metres from the surface to the inside of a shell (default 2 % of the "
                     "diagonal); never past the middle of the solid")
        ->check(inRange(1e-9, 1e9));
    command->add_option("--interior-material", arguments->interiorMaterial,
                        "The model's material for broken faces (default: a neutral grey is added)");
    command->add_flag(
        "--thesis", arguments->thesis,
        "Casella's thesis to the letter: the medial surface smoothed 10 steps before and "
        "after (loses more volume), line ends at seams paired in order and averaged");
    command
        ->add_option(
            "--density", arguments->density,
            "kg/m3 (default " + std::to_string(static_cast<int>(defaults.physics.density)) + ")")
        ->check(inRange(1e-6, 1e9));
    command
        ->add_option("--unit-scale", arguments->unitScale,
                     "Metres per unit of the model, 0.01 for centimetres (default 1, as glTF has "
                     "it): the baked scene is scaled to metres, by one node above all")
        ->check(inRange(1e-6, 1e6));
    command->add_flag("--cap-holes", arguments->capHoles,
                      "Close the holes of an open mesh by hidden faces; the intact object stays as "
                      "it is. At most 64 holes; with --allow-open those that cannot be stay open");
    command->add_flag(
        "--allow-open", arguments->allowOpen,
        "Bake open and non-manifold meshes too; their pieces get a rim along the border");
    command
        ->add_option("--encoding", arguments->encoding,
                     "How the pieces' geometry is stored: none, or draco, several times smaller "
                     "and slower to load; readers need a build with Draco, too")
        ->check(CLI::IsMember({"none", "draco"}))
        ->capture_default_str();
    command
        ->add_option("--position-bits", arguments->packing.positionBits,
                     "With --encoding draco: places lie on a grid of so many bits")
        ->check(CLI::Range(8U, 30U))
        ->capture_default_str();
    command
        ->add_option("--threads", arguments->threads,
                     "At most so many threads; the result is the same (default 2)")
        ->check(CLI::Range(1U, 256U));
    command->add_flag("-q,--quiet", arguments->quiet, "Say nothing unless something fails");
    command->footer(
        "Examples:\n"
        "  sherd-bake bake vase.glb -o vase_baked.glb --map cracks.svg\n"
        "  sherd-bake bake vase.glb -o vase_baked.glb --map coarse.svg --map fine.svg\n"
        "  sherd-bake bake vase.glb -o vase_baked.glb --pattern voronoi:12 --pattern "
        "voronoi:50:7\n"
        "  sherd-bake bake stone.glb -o stone_baked.glb --cut voronoi:8 --cut voronoi:6\n"
        "  sherd-bake bake plank.glb -o plank_baked.glb --map cracks.png --projection planar:z\n"
        "  sherd-bake bake scene.glb -o scene_baked.glb     (its nodes carry recipes: "
        "extras.sherd)\n"
        "  sherd-bake bake town.glb --node Wall -o town_baked.glb --recipe wall.json --report "
        "report.json");
    command->callback([arguments, command, &exitCode] {
        if (const auto ok = orderLevels(*command, arguments->lines); !ok) {
            exitCode = printError(ok.error());
            return;
        }
        exitCode = runBake(*arguments);
    });
}

}  // namespace sherd::cli
