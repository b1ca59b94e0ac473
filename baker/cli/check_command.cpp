// SPDX-License-Identifier: MIT
#include "check_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "command_files.h"
#include "exit_codes.h"
#include "sherd/formats/validate.h"

namespace sherd::cli {

namespace {

void printObject(const ObjectReport& object) {
    const bool coverage = object.levels[0].coverageNone >= 0;
    const bool shapes = object.levels[0].selfIntersections >= 0;
    std::printf("%-20s %6s %10s %12s %10s %9s", "object", "level", "fragments", "closed", "volume",
                "hidden");
    if (coverage) std::printf(" %10s %10s", "none", "double");
    if (shapes) std::printf(" %10s %11s", "crossings", "thinnest");
    std::printf("\n");
    for (size_t k = 0; k < object.levels.size(); ++k) {
        const LevelReport& level = object.levels[k];
        const double closed = level.fragments > 0 ? 100.0 * level.closed / level.fragments : 0.0;
        std::printf("%-20s %6zu %10u %5u %5.4g%% %9.5g%% %8.3g%%", object.name.c_str(), k,
                    level.fragments, level.closed, closed, 100.0 * level.volumeShare,
                    100.0 * level.hiddenShare);
        if (coverage)
            std::printf(" %9.4g%% %9.4g%%", 100.0 * level.coverageNone,
                        100.0 * level.coverageDouble);
        if (shapes)
            std::printf(" %10lld %9.3g m", static_cast<long long>(level.selfIntersections),
                        std::max(level.thinnest, 0.0));
        std::printf("\n");
    }
    const double share = object.diagonal > 0 ? object.protrusion / object.diagonal : 0.0;
    std::printf(
        "  %u triangles, %u hidden vertices, %u of them outside; deepest protrusion %.3g m "
        "(%.3g of the diagonal)\n",
        object.triangles, object.hiddenVertices, object.verticesOutside, object.protrusion, share);
}

void printReport(const CheckReport& report) {
    for (const ObjectReport& object : report.objects) printObject(object);
    constexpr size_t kMost = 40;
    for (size_t i = 0; i < report.findings.size() && i < kMost; ++i) {
        const Finding& f = report.findings[i];
        const std::string& name = report.objects[static_cast<size_t>(f.object)].name;
        const std::string who =
            f.fragment < 0 ? name : name + ", fragment " + std::to_string(f.fragment);
        std::printf("%s %s: %s: %s [%s]\n",
                    f.severity == Severity::failure ? "FAILED" : nameOf(f.severity), f.code.c_str(),
                    who.c_str(), f.message.c_str(), f.where.c_str());
    }
    if (report.findings.size() > kMost)
        std::printf("... and %zu more; --json lists them all\n", report.findings.size() - kMost);
    std::printf(report.passed() ? "check passed\n" : "check FAILED\n");
}

}  // namespace

int runCheck(const CheckArguments& arguments) {
    const auto bytes = readBytes(arguments.input);
    if (!bytes) return printError(bytes.error());
    CheckOptions options;
    options.coverage = arguments.coverage || arguments.measure;
    options.shapes = arguments.measure;
    auto report = checkFractureSets(*bytes, options);
    if (!report) {
        Error error = report.error();
        error.where = arguments.input.string() + error.where;
        return printError(error);
    }
    if (report->objects.empty()) {
        std::fprintf(stderr, "sherd-bake: %s: the file holds no fracture set; bake it first\n",
                     arguments.input.c_str());
        return kExitNoFractureSet;
    }
    if (arguments.json)
        std::fputs(toJson(*report).c_str(), stdout);
    else
        printReport(*report);
    return report->passed() ? kExitOk : kExitCheckFailed;
}

void addCheckCommand(CLI::App& app, int& exitCode) {
    const auto arguments = std::make_shared<CheckArguments>();
    CLI::App* command = app.add_subcommand(
        "check", "Prove a baked file sound, from the file alone: closed, adding up, inside, fresh");
    command->add_option("BAKED", arguments->input, "The baked .glb")->required();
    command->add_flag("--json", arguments->json, "Print the whole report as JSON");
    command->add_flag("--coverage", arguments->coverage,
                      "Also measure which share of the object lies in no fragment or in several");
    command->add_flag(
        "--measure", arguments->measure,
        "Measure that, where fragments pass through themselves, and how thin they are");
    command->footer(
        "Examples:\n  sherd-bake check out/vase.glb\n"
        "  sherd-bake check out/vase.glb --json --measure > report.json");
    command->callback([arguments, &exitCode] { exitCode = runCheck(*arguments); });
}

}  // namespace sherd::cli
