// SPDX-License-Identifier: MIT
#include "recipe_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "exit_codes.h"
#include "recipe_texts.h"

namespace sherd::cli {
namespace {

struct RecipeArguments {
    std::string example;
    bool schema = false;
};

int printRecipe(const RecipeArguments& arguments) {
    if (arguments.schema) {
        std::fputs(kRecipeSchema, stdout);
        return kExitOk;
    }
    const auto found =
        std::find_if(kRecipeExamples.begin(), kRecipeExamples.end(),
                     [&](const RecipeExample& e) { return arguments.example == e.name; });
    std::string known;
    for (const RecipeExample& e : kRecipeExamples)
        known.append("  ").append(e.name).append(": ").append(e.about).append("\n");
    if (found != kRecipeExamples.end()) {
        std::printf("// %s\n%s", found->about, found->text);
        return kExitOk;
    }
    if (arguments.example.empty()) {
        std::printf("Examples, for --example NAME:\n%s", known.c_str());
        return kExitOk;
    }
    std::fprintf(stderr, "sherd-bake: there is no example \"%s\"; there are\n%s",
                 arguments.example.c_str(), known.c_str());
    return kExitBadArgument;
}

}  // namespace

void addRecipeCommand(CLI::App& app, int& exitCode) {
    const auto arguments = std::make_shared<RecipeArguments>();
    CLI::App* command = app.add_subcommand(
        "recipe", "Print a commented example of a recipe, or the schema of all recipes");
    command->add_option("--example", arguments->example, "Which one; left out, they are listed");
    command->add_flag("--schema", arguments->schema,
                      "The JSON schema: editors complete and check recipes by it");
    command->footer(
        "Examples:\n"
        "  sherd-bake recipe --example wall > wall.json\n"
        "  sherd-bake bake wall.glb -o wall_baked.glb --recipe wall.json");
    command->callback([arguments, &exitCode] { exitCode = printRecipe(*arguments); });
}

}  // namespace sherd::cli
