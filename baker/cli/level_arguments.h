// SPDX-License-Identifier: MIT
// Where lines come from and how they are taken: what every command that cuts asks for alike.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sherd/baker/fracture_plan.h"
#include "sherd/baker/import.h"
#include "sherd/baker/recipe.h"

namespace sherd::cli {

struct LevelArguments {
    std::string drawingOption;  ///< its name on the command line, "--map"
    const CLI::Option* drawing = nullptr;
    const CLI::Option* pattern = nullptr;
    const CLI::Option* cut = nullptr;
    const CLI::Option* cluster = nullptr;

    std::filesystem::path recipe;
    std::vector<std::string> maps, patterns, cuts, clusters;
    std::vector<RecipeLevel> levels;  ///< in the order they were named
    std::string projection = "uv";
    std::string wrap;
    std::vector<std::string> levelColors;
    std::optional<double> curveTolerance;
    std::optional<double> seamJoinShare;
    std::optional<double> closeGaps;
    std::optional<double> minimumComponentShare;
    std::optional<double> snapShare;
    std::optional<double> bitmapThreshold, bitmapTolerance, bitmapSpur;
    bool bitmapCurves = false;
    bool noModelLines = false;
    bool splitParts = false;
};

/// CLI::Range lets NaN pass.
CLI::Validator inRange(double low, double high);

/// Adds the option for drawings (`drawingOption`, with its help), --pattern, --recipe and how lines
/// are taken. `arguments` must outlive the command.
void addLevelOptions(CLI::App& command, const std::string& drawingOption,
                     const std::string& drawingHelp, LevelArguments& arguments);

/// Levels in the order in which drawings, patterns, cuts and clusters stand on the command line.
Result<void> orderLevels(const CLI::App& command, LevelArguments& arguments);

/// The recipe that was named, or the default one, with what the command line says of levels and
/// lines.
Result<Recipe> recipeOf(const LevelArguments& arguments);

/// Over a recipe's settings, what the command line says of how lines are taken.
Result<void> adjustLines(const LevelArguments& arguments, Recipe& recipe);

/// Over a recipe that an object brought, what the command line says of levels and lines.
Result<void> adjustOwnRecipe(const LevelArguments& arguments, Recipe& recipe);

/// Reads the drawings of a recipe's levels.
Result<FracturePlan> readPlan(const Recipe& recipe);

/// Whether there is anything to cut along. Lines modelled on the objects are taken out where the
/// recipe does not want them.
bool chooseLines(const Recipe& recipe, Model& model);

}  // namespace sherd::cli
