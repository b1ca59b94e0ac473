// SPDX-License-Identifier: MIT
#include "level_arguments.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "sherd/baker/fracture_map.h"

namespace sherd::cli {
namespace {

/// The levels that the command line names.
Result<void> takeLevels(const LevelArguments& arguments, Recipe& recipe) {
    const Result<Projection> projection = parseProjection(arguments.projection);
    if (!projection) return tl::unexpected(projection.error());
    recipe.levels = arguments.levels;
    for (RecipeLevel& level : recipe.levels) level.projection = *projection;
    return {};
}

/// What options say in words of their own.
Result<void> readTexts(const LevelArguments& arguments, Recipe& recipe) {
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

/// How lines are taken from their sources.
void addLineOptions(CLI::App& command, LevelArguments& arguments) {
    command
        .add_option("--projection", arguments.projection,
                    "How drawings lie on the object: uv, planar[:AXIS], cylindrical[:AXIS] or box")
        ->capture_default_str();
    command.add_option("--wrap", arguments.wrap,
                       "Lines for texture coordinates outside [0, 1]: texture (as its sampler "
                       "says), none, repeat, mirror or clamp");
    command
        .add_option("--close-gaps", arguments.closeGaps,
                    "Lead dangling line ends on to the nearest line within this distance: UV units "
                    "in drawings, shares of the diagonal for lines over the surface")
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
        .add_option("--tolerance", arguments.curveTolerance,
                    "Largest distance between a curve and the line that replaces it, in UV units "
                    "(default 0.0001)")
        ->check(inRange(1e-7, 0.1));
    command
        .add_option("--seam-join,--across-seams", arguments.seamJoinShare,
                    "Join line ends across a chart border that are nearer than this share of the "
                    "object's diagonal (default 0.005)")
        ->check(inRange(0.0, 0.1));
}

void addBitmapOptions(CLI::App& command, LevelArguments& arguments) {
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

void addLevelOptions(CLI::App& command, const std::string& drawingOption,
                     const std::string& drawingHelp, LevelArguments& arguments) {
    arguments.drawingOption = drawingOption;
    arguments.drawing =
        command.add_option(drawingOption, arguments.maps, drawingHelp)->allow_extra_args(false);
    arguments.pattern =
        command
            .add_option("--pattern", arguments.patterns,
                        "A generated level: voronoi:N[:SEED], grid:NxM, radial:NxM or wood:N, with "
                        "options below; takes its place among " +
                            drawingOption + " as it stands")
            ->allow_extra_args(false);
    arguments.cut =
        command
            .add_option(
                "--cut", arguments.cuts,
                "A level that cuts every piece of the one before through its volume: "
                "voronoi:N[:SEED], grid:N, slices:NxMxK, wood:N, points:X,Y,Z;..., "
                "bricks:NxMxK, glass:NxM or map:FILE[:axis=z] (a drawing, straight through), and "
                ":larger=SHARE, :smaller=SHARE, "
                ":near=X,Y,Z, :within=METRES or :name=NAME to choose pieces; takes its "
                "place among " +
                    drawingOption + " and --pattern as it stands")
            ->allow_extra_args(false);
    arguments.cluster =
        command
            .add_option("--cluster", arguments.clusters,
                        "A level that groups the pieces of the next finer one, N in each piece of "
                        "the one before: N, and :evenness=0..1 (0.5) or what chooses pieces for "
                        "--cut; takes its place among the others as it stands")
            ->allow_extra_args(false);
    command.add_option(
        "--recipe", arguments.recipe,
        "Levels and settings as JSON; its levels win over " + drawingOption +
            ", other options win over it. Recipes that the scene's nodes carry are left out");
    addLineOptions(command, arguments);
    addBitmapOptions(command, arguments);
}

Result<void> orderLevels(const CLI::App& command, LevelArguments& arguments) {
    size_t maps = 0;
    size_t patterns = 0;
    size_t cuts = 0;
    size_t clusters = 0;
    for (const CLI::Option* option : command.parse_order()) {
        if (option == arguments.drawing) {
            arguments.levels.emplace_back().map = arguments.maps[maps++];
        } else if (option == arguments.pattern) {
            Result<Pattern> parsed = parsePattern(arguments.patterns[patterns++]);
            if (!parsed) return tl::unexpected(parsed.error());
            arguments.levels.emplace_back().pattern = std::move(*parsed);
        } else if (option == arguments.cut) {
            Result<VolumeCut> parsed = parseVolumeCut(arguments.cuts[cuts++]);
            if (!parsed) return tl::unexpected(parsed.error());
            arguments.levels.emplace_back().cut = std::move(*parsed);
        } else if (option == arguments.cluster) {
            Result<Cluster> parsed = parseCluster(arguments.clusters[clusters++]);
            if (!parsed) return tl::unexpected(parsed.error());
            arguments.levels.emplace_back().cluster = std::move(*parsed);
        }
    }
    return {};
}

Result<Recipe> recipeOf(const LevelArguments& arguments) {
    Recipe recipe;
    if (!arguments.recipe.empty()) {
        Result<Recipe> read = readRecipe(arguments.recipe);
        if (!read) return read;
        recipe = std::move(*read);
    }
    if (recipe.levels.empty()) {
        if (auto ok = takeLevels(arguments, recipe); !ok) return tl::unexpected(ok.error());
    } else if (!arguments.levels.empty()) {
        std::fprintf(stderr,
                     "sherd-bake: the recipe names its own levels; those of %s, --pattern, "
                     "--cut and --cluster are left out\n",
                     arguments.drawingOption.c_str());
    }
    if (const Result<void> done = adjustLines(arguments, recipe); !done)
        return tl::unexpected(done.error());
    return recipe;
}

Result<void> adjustLines(const LevelArguments& arguments, Recipe& recipe) {
    if (auto read = readTexts(arguments, recipe); !read) return read;
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
    return {};
}

Result<void> adjustOwnRecipe(const LevelArguments& arguments, Recipe& recipe) {
    if (!arguments.levels.empty()) {
        if (auto ok = takeLevels(arguments, recipe); !ok) return ok;
    }
    return adjustLines(arguments, recipe);
}

namespace {

MapReadOptions mapOptions(const Recipe& recipe) {
    MapReadOptions options;
    options.tolerance = recipe.curveTolerance;
    options.levelOfColor = recipe.levelOfColor;
    options.bitmap = recipe.bitmap;
    return options;
}

}  // namespace

Result<FracturePlan> readPlan(const Recipe& recipe) {
    std::vector<FracturePlan> levels;
    if (endsInCluster(recipe.levels)) {
        return fail(ErrorCode::badArgument,
                    "has nothing to group: a finer level must come behind it",
                    "cluster \"" + recipe.levels.back().cluster->text + "\"");
    }
    for (const RecipeLevel& level : recipe.levels) {
        FracturePlan& plan = levels.emplace_back();
        if (level.cluster) {
            plan.clusters.push_back({*level.cluster});
            continue;
        }
        if (level.cut) {
            plan.cuts.push_back(*level.cut);
            if (level.cut->map.empty()) continue;
            Result<FractureMap> map = readFractureMap(level.cut->map, mapOptions(recipe));
            if (!map) return tl::unexpected(map.error());
            plan.cuts.back().drawing = std::make_shared<FractureMap>(std::move(*map));
            continue;
        }
        if (level.pattern) {
            FracturePlan::Grown& grown = plan.patterns.emplace_back();
            grown.pattern = *level.pattern;
            grown.only = level.only;
            grown.where = level.where;
            const std::string& density = grown.pattern.density;
            if (!density.empty() && density != "color") {
                Result<GreyImage> picture = readGreyImage(density);
                if (!picture) return tl::unexpected(picture.error());
                grown.density = std::make_shared<GreyImage>(std::move(*picture));
            }
            continue;
        }
        Result<FractureMap> map = readFractureMap(level.map, mapOptions(recipe));
        if (!map) return tl::unexpected(map.error());
        plan.drawings.push_back({std::move(*map), level.projection, level.only, level.where});
    }
    return stackLevels(std::move(levels));
}

bool chooseLines(const Recipe& recipe, Model& model) {
    bool modelled = false;
    for (SurfaceMesh& mesh : model.meshes) {
        if (!recipe.modelLines) mesh.lines.clear();
        modelled = modelled || !mesh.lines.empty();
    }
    return modelled || !recipe.levels.empty();
}

}  // namespace sherd::cli
