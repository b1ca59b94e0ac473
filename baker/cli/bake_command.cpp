// SPDX-License-Identifier: MIT
#include "bake_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

#include "command_files.h"
#include "exit_codes.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd::cli {
namespace {

struct BakeArguments {
    std::filesystem::path model, output, recipe, report;
    std::vector<std::string> maps, patterns;
    std::vector<RecipeLevel> levels;  ///< maps and patterns in the order they were named
    std::string projection = "uv";
    std::string wrap;
    std::vector<std::string> levelColors;
    ImportOptions import;
    std::string interior = "medial";
    std::optional<double> density;
    std::optional<double> curveTolerance;
    std::optional<double> seamJoinShare;
    std::optional<double> closeGaps;
    std::optional<double> minimumComponentShare;
    std::optional<double> snapShare;
    std::optional<double> bitmapThreshold, bitmapTolerance, bitmapSpur;
    bool bitmapCurves = false;
    bool noModelLines = false;
    bool splitParts = false;
    std::optional<unsigned> threads;
    bool thesis = false;
    bool allowOpen = false;
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

/// What options say in words of their own.
Result<void> readTexts(const BakeArguments& arguments, Recipe& recipe) {
    const Result<Projection> projection = parseProjection(arguments.projection);
    if (!projection) return tl::unexpected(projection.error());
    if (arguments.recipe.empty())
        for (RecipeLevel& level : recipe.levels) level.projection = *projection;
    for (const std::string& text : arguments.levelColors) {
        const size_t equals = text.rfind('=');
        uint32_t level = 0;
        if (equals == std::string::npos ||
            !CLI::detail::lexical_cast(text.substr(equals + 1), level) || level < 1 || level > 64)
            return fail(ErrorCode::badArgument,
                        "\"" + text + "\" is not COLOR=LEVEL, like \"#ff0000=2\" or red=2",
                        "--level-color");
        recipe.levelOfColor.emplace_back(text.substr(0, equals), level);
    }
    if (arguments.wrap.empty()) return {};
    const Result<PageWrap> wrap = parsePageWrap(arguments.wrap);
    if (!wrap) return tl::unexpected(wrap.error());
    recipe.wrap = *wrap;
    return {};
}

Result<Recipe> gatherRecipe(const BakeArguments& arguments) {
    Recipe recipe;
    if (!arguments.recipe.empty()) {
        Result<Recipe> read = readRecipe(arguments.recipe);
        if (!read) return read;
        recipe = std::move(*read);
    }
    if (recipe.levels.empty()) {
        recipe.levels = arguments.levels;
    } else if (!arguments.levels.empty()) {
        std::fprintf(stderr,
                     "sherd-bake: the recipe names its own levels; those of --map and --pattern "
                     "are left out\n");
    }
    if (const Result<void> read = readTexts(arguments, recipe); !read)
        return tl::unexpected(read.error());
    if (arguments.density) recipe.physics.density = *arguments.density;
    if (arguments.curveTolerance) recipe.curveTolerance = *arguments.curveTolerance;
    if (arguments.seamJoinShare) recipe.seamJoinShare = *arguments.seamJoinShare;
    if (arguments.closeGaps) recipe.closeGaps = *arguments.closeGaps;
    if (arguments.minimumComponentShare)
        recipe.minimumComponentShare = *arguments.minimumComponentShare;
    if (arguments.snapShare) recipe.snapShare = *arguments.snapShare;
    if (arguments.bitmapThreshold) recipe.bitmap.threshold = *arguments.bitmapThreshold;
    if (arguments.bitmapTolerance) recipe.bitmap.tolerance = *arguments.bitmapTolerance;
    if (arguments.bitmapSpur) recipe.bitmap.spur = *arguments.bitmapSpur;
    recipe.bitmap.curves = recipe.bitmap.curves || arguments.bitmapCurves;
    recipe.modelLines = recipe.modelLines && !arguments.noModelLines;
    recipe.splitParts = recipe.splitParts || arguments.splitParts;
    if (arguments.threads) recipe.threads = *arguments.threads;
    recipe.interior.thesis = recipe.interior.thesis || arguments.thesis;
    recipe.allowOpen = recipe.allowOpen || arguments.allowOpen;
    return recipe;
}

Result<FracturePlan> readPlan(const Recipe& recipe) {
    std::vector<FracturePlan> levels;
    for (const RecipeLevel& level : recipe.levels) {
        FracturePlan& plan = levels.emplace_back();
        if (level.pattern) {
            plan.patterns.push_back({*level.pattern, 1});
            continue;
        }
        MapReadOptions options;
        options.tolerance = recipe.curveTolerance;
        options.levelOfColor = recipe.levelOfColor;
        options.bitmap = recipe.bitmap;
        Result<FractureMap> map = readFractureMap(level.map, options);
        if (!map) return tl::unexpected(map.error());
        plan.drawings.push_back({std::move(*map), level.projection});
    }
    return stackLevels(std::move(levels));
}

void printTable(const BakeReport& report) {
    std::printf("%-24s %5s %10s %11s %8s %9s\n", "object", "level", "fragments", "components",
                "closed", "volume");
    for (const BakedObjectReport& object : report.objects) {
        for (size_t k = 0; k < object.levels.size(); ++k) {
            const BakedLevelReport& level = object.levels[k];
            std::printf("%-24.24s %5zu %10u %11u %7.4g%% %8.5g%%\n",
                        k == 0 ? object.name.c_str() : "", k, level.fragments, level.components,
                        100.0 * level.closed / std::max(level.fragments, 1U),
                        100 * level.volumeShare);
        }
        std::printf("  %u triangles, %u after cutting, %u bonds;", object.triangles,
                    object.splitTriangles, object.bonds);
        for (const StageTime& stage : object.stages)
            std::printf(" %s %.0f ms,", stage.name.c_str(), stage.seconds * 1e3);
        std::printf(" in all %.2f s\n", report.seconds);
        for (const BakeFinding& finding : object.findings) {
            std::printf(
                "  note %s: %s%s%s%s\n", finding.code.c_str(), finding.message.c_str(),
                finding.count > 1 ? (" (" + std::to_string(finding.count) + ")").c_str() : "",
                finding.where.empty() ? "" : ": ", finding.where.c_str());
        }
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
    std::vector<std::filesystem::path> inputs = {arguments.recipe};
    for (const RecipeLevel& level : recipe.levels)
        if (!level.map.empty()) inputs.push_back(level.map);
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
    std::string kind = arguments.output.extension().string();
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    std::error_code ignored;
    const bool device = std::filesystem::exists(arguments.output, ignored) &&
                        !std::filesystem::is_regular_file(arguments.output, ignored);
    if (kind != ".glb" && !device) {
        return fail(ErrorCode::badArgument, "a bake is written as one .glb; name the output so",
                    arguments.output.string());
    }
    return {};
}

/// Lines may also be modelled on the objects.
Result<void> checkAnyLines(const Recipe& recipe, Model& model) {
    bool modelled = false;
    for (SurfaceMesh& mesh : model.meshes) {
        if (!recipe.modelLines) mesh.lines.clear();
        modelled = modelled || !mesh.lines.empty();
    }
    if (modelled || !recipe.levels.empty()) return {};
    return fail(ErrorCode::badArgument,
                "there is nothing to cut along: draw lines and name them with --map, take a "
                "--pattern (voronoi:12), model lines on the object, or give a recipe with levels");
}

Result<BakedFile> bakeFiles(const BakeArguments& arguments, const Progress& progress) {
    const Result<Recipe> recipe = gatherRecipe(arguments);
    if (!recipe) return tl::unexpected(recipe.error());
    if (auto writable = checkOutputs(arguments, *recipe); !writable)
        return tl::unexpected(writable.error());
    progress("reading", 0);
    Result<Model> model = importModel(arguments.model, arguments.import);
    if (!model) return tl::unexpected(model.error());
    if (auto ok = checkAnyLines(*recipe, *model); !ok) return tl::unexpected(ok.error());
    const Result<FracturePlan> plan = readPlan(*recipe);
    if (!plan) return tl::unexpected(plan.error());
    Result<BakedFile> baked = bakeModel(*model, *plan, *recipe, progress);
    if (!baked) {
        Error error = baked.error();
        error.where = arguments.model.string() + (error.where.empty() ? "" : ", ") + error.where;
        return tl::unexpected(std::move(error));
    }
    baked->report.source = arguments.model.string();
    return baked;
}

Result<void> writeFiles(const BakeArguments& arguments, const BakedFile& baked) {
    ReportFile report(arguments.report);
    if (auto staged = report.stage(toJson(baked.report)); !staged) return staged;
    if (auto written = writeFileWhole(arguments.output, baked.glb); !written) return written;
    return report.commit();
}

/// CLI::Range lets NaN pass.
CLI::Validator inRange(double low, double high) {
    const std::string range = CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high);
    const auto check = [low, high, range](const std::string& text) -> std::string {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        if (number && value >= low && value <= high) return {};
        return text + " is not a number from " + range;
    };
    return {check, "FLOAT from " + range};
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

/// Levels in the order in which --map and --pattern stand on the command line.
Result<void> orderLevels(const CLI::App& command, const CLI::Option* map,
                         const CLI::Option* pattern, BakeArguments& arguments) {
    size_t maps = 0;
    size_t patterns = 0;
    for (const CLI::Option* option : command.parse_order()) {
        if (option == map) {
            arguments.levels.push_back({arguments.maps[maps++], "", {}, std::nullopt});
        } else if (option == pattern) {
            Result<Pattern> parsed = parsePattern(arguments.patterns[patterns++]);
            if (!parsed) return tl::unexpected(parsed.error());
            arguments.levels.push_back({{}, "", {}, std::move(*parsed)});
        }
    }
    return {};
}

/// How lines are taken from their sources.
void addLineOptions(CLI::App& command, BakeArguments& arguments) {
    command
        .add_option("--projection", arguments.projection,
                    "How drawings lie on the object: uv, planar[:AXIS], cylindrical[:AXIS] or box")
        ->capture_default_str();
    command.add_option("--wrap", arguments.wrap,
                       "Lines for texture coordinates outside [0, 1]: texture (as its sampler "
                       "says), none, repeat, mirror or clamp");
    command
        .add_option("--close-gaps", arguments.closeGaps,
                    "Lead dangling line ends on to the nearest line within this distance, in UV "
                    "units")
        ->check(inRange(0.0, 1.0));
    command
        .add_option(
            "--min-component", arguments.minimumComponentShare,
            "Components below this share of the surface join the neighbour with the longest "
            "common border (default 1e-5)")
        ->check(inRange(0.0, 0.5));
    command
        .add_option("--snap-distance", arguments.snapShare,
                    "Places in 3D may be this share of the object's diagonal off the surface "
                    "(default 0.05)")
        ->check(inRange(0.0, 10.0));
    command.add_flag("--no-model-lines", arguments.noModelLines,
                     "Lines modelled on the object (LINES primitives, OBJ l) do not cut");
    command.add_flag("--split-parts", arguments.splitParts,
                     "Every patch of a pattern's cell is a piece of its own");
    command
        .add_option("--level-color", arguments.levelColors,
                    "A stroke colour that chooses the level: COLOR=LEVEL; may be repeated")
        ->allow_extra_args(false);
    command
        .add_option("--bitmap-threshold", arguments.bitmapThreshold,
                    "What is darker than this is a line, 0 to 1 (default: found)")
        ->check(inRange(0.0, 1.0));
    command
        .add_option("--bitmap-tolerance", arguments.bitmapTolerance,
                    "Largest distance of a simplified line from the drawn one, texels (default "
                    "0.5)")
        ->check(inRange(0.0, 1000.0));
    command
        .add_option("--bitmap-spur", arguments.bitmapSpur,
                    "Shorter dead branches are left out, texels (default 4)")
        ->check(inRange(0.0, 1000.0));
    command.add_flag("--bitmap-curves", arguments.bitmapCurves,
                     "Fit curves through lines traced from a bitmap");
}

}  // namespace

void addBakeCommand(CLI::App& app, int& exitCode) {
    const auto arguments = std::make_shared<BakeArguments>();
    const Recipe defaults;
    CLI::App* command = app.add_subcommand(
        "bake", "Cut a model along drawn lines, level by level, into closed fragments");
    command->add_option("MODEL", arguments->model, "The model: .glb, .gltf or .obj")->required();
    command->add_option("-o,--output", arguments->output, "The baked .glb to write")->required();
    CLI::Option* map =
        command
            ->add_option("--map", arguments->maps,
                         "A fracture map (.svg, .json, .png or .jpg); repeat it for each deeper "
                         "level, coarse to fine. With one map its layers \"level 1..n\" choose the "
                         "level")
            ->allow_extra_args(false);
    CLI::Option* pattern =
        command
            ->add_option(
                "--pattern", arguments->patterns,
                "A generated level: voronoi:N[:SEED], grid:NxM, radial:NxM or wood:N, with "
                "options below; takes its place among --map as it stands")
            ->allow_extra_args(false);
    addLineOptions(*command, *arguments);
    command->add_option(
        "--recipe", arguments->recipe,
        "Levels and settings as JSON; its levels win over --map, other options win over it");
    command->add_option("--report", arguments->report, "Write what was done and found as JSON");
    command
        ->add_option("--node", arguments->import.nodes,
                     "Only this mesh node (name or index); may be repeated")
        ->allow_extra_args(false);
    command->add_option("--uv", arguments->import.uvSet, "The UV set the lines are drawn in")
        ->capture_default_str();
    command->add_flag("--join", arguments->import.join,
                      "Take the chosen nodes for parts of one object, named after the first");
    command->add_option("--interior", arguments->interior, "How pieces are closed inside")
        ->check(CLI::IsMember({"medial"}))
        ->capture_default_str();
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
        ->add_option("--tolerance", arguments->curveTolerance,
                     "Largest distance between a curve and the line that replaces it, in UV units "
                     "(default 0.0001)")
        ->check(inRange(1e-7, 0.1));
    command
        ->add_option("--across-seams,--seam-join", arguments->seamJoinShare,
                     "Join line ends across a chart border that are nearer than this share of the "
                     "object's diagonal (default 0.005)")
        ->check(inRange(0.0, 0.1));
    command->add_flag(
        "--allow-open", arguments->allowOpen,
        "Bake open and non-manifold meshes too; their pieces get a rim along the border");
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
        "  sherd-bake bake plank.glb -o plank_baked.glb --map cracks.png --projection planar:z\n"
        "  sherd-bake bake town.glb --node Wall -o town_baked.glb --recipe wall.json --report "
        "report.json");
    command->callback([arguments, command, map, pattern, &exitCode] {
        if (const auto ok = orderLevels(*command, map, pattern, *arguments); !ok) {
            exitCode = printError(ok.error());
            return;
        }
        exitCode = runBake(*arguments);
    });
}

}  // namespace sherd::cli
