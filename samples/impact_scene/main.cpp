// SPDX-License-Identifier: MIT
// impact_scene: throws a ball at baked objects and films what happens.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "film.h"
#include "model_view.h"
#include "offscreen_context.h"
#include "picture.h"
#include "scene_renderer.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/runtime/asset.h"
#include "shot.h"
#include "video_writer.h"

namespace {

using namespace sherd;
using namespace sherd::samples;

constexpr std::string_view kUsage =
    "usage: impact_scene --headless --out DIR [options] BAKED.glb...\n"
    "\n"
    "Throws an iron ball at each baked object, one after another, and films it without a window:\n"
    "  DIR/impact.mp4   the film, with slow motion around each hit (needs the ffmpeg command)\n"
    "  DIR/impact.png   a contact sheet: a row for each object\n"
    "What broke is printed.\n"
    "\n"
    "options:\n"
    "  --size WxH     size of the film in pixels, even numbers (default 640x360)\n"
    "  --speed M/S    speed of the ball at the hit (default: from the object's size)\n"
    "  --no-video     write the contact sheet only\n"
    "  --help         show this\n"
    "\n"
    "exit codes: 0 everything broke; 1 a file or the graphics failed; 2 wrong usage; 3 something "
    "did not break\n"
    "\n"
    "examples:\n"
    "  impact_scene --headless --out out vase_baked.glb wall_baked.glb column_baked.glb\n"
    "  impact_scene --headless --out out --size 1280x720 --speed 12 skull_baked.glb\n";

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr int kExitUnbroken = 3;

struct Arguments {
    bool headless = false;
    bool help = false;
    bool video = true;
    std::filesystem::path out;
    std::vector<std::filesystem::path> models;
    RendererOptions renderer;
    ShotOptions shot;
};

bool parseSize(const std::string& text, RendererOptions& renderer) {
    unsigned width = 0;
    unsigned height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) != 2) return false;
    if (width < 64 || height < 64 || width > 4096 || height > 4096 || width % 2 != 0 ||
        height % 2 != 0)
        return false;
    renderer.width = width;
    renderer.height = height;
    return true;
}

Result<Arguments> parse(int argc, char** argv) {
    Arguments out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool takesValue = word == "--out" || word == "--size" || word == "--speed";
        if (takesValue && i + 1 == argc)
            return fail(ErrorCode::badArgument, "this option needs a value", word);
        const std::string value = takesValue ? argv[++i] : "";
        if (word == "--help" || word == "-h") {
            out.help = true;
        } else if (word == "--headless") {
            out.headless = true;
        } else if (word == "--no-video") {
            out.video = false;
        } else if (word == "--out") {
            out.out = value;
        } else if (word == "--size") {
            if (!parseSize(value, out.renderer)) {
                return fail(ErrorCode::badArgument,
                            "a size is like 640x360: even numbers from 64 to 4096", value);
            }
        } else if (word == "--speed") {
            out.shot.speed = std::strtof(value.c_str(), nullptr);
            if (!(out.shot.speed > 0 && out.shot.speed <= 100)) {
                return fail(ErrorCode::badArgument,
                            "a speed is a number of m/s, above 0, at most 100", value);
            }
        } else if (word.starts_with("-")) {
            return fail(ErrorCode::badArgument, "unknown option", word);
        } else {
            out.models.emplace_back(word);
        }
    }
    if (out.help) return out;
    if (!out.headless)
        return fail(ErrorCode::badArgument, "there is no window yet: pass --headless");
    if (out.out.empty()) return fail(ErrorCode::badArgument, "--out DIR is missing");
    if (out.models.empty())
        return fail(ErrorCode::badArgument, "name at least one baked .glb file");
    return out;
}

int report(const Error& error, int exitCode) {
    std::fprintf(stderr, "error: %s%s%s%s\n", error.message.c_str(),
                 error.where.empty() ? "" : " (", error.where.c_str(),
                 error.where.empty() ? "" : ")");
    return exitCode;
}

/// Prints the breaks; false, with the reason, when there were none.
bool describe(const Shot& shot, const Asset& asset) {
    const char* name = asset.name().c_str();
    if (shot.breaks().empty()) {
        std::fprintf(stderr,
                     "error: %s did not break: the ball brought %.1f J, breaking it takes %.1f J; "
                     "try a higher "
                     "--speed\n",
                     name, shot.ballEnergy(), asset.breakEnergy(0));
        return false;
    }
    for (const BreakEvent& event : shot.breaks()) {
        std::printf(
            "%s: %6.3f s  fragment %u: %u bonds broken down to level %u, %u bodies came off  "
            "%.2f N s, %.1f of %.1f J at (%.2f, %.2f, %.2f)\n",
            name, event.time, event.fragment, event.bonds, event.level, event.bodies, event.impulse,
            event.consumed, event.energy, event.point.x, event.point.y, event.point.z);
    }
    std::printf("%s: %zu breaks, %zu pieces\n", name, shot.breaks().size(), shot.poses().size());
    return true;
}

struct Output {
    std::unique_ptr<VideoWriter> video;
    std::vector<Picture> stills;
    bool allBroken = true;
};

Result<void> filmModel(const std::filesystem::path& path, const Arguments& arguments,
                       SceneRenderer& renderer, const BallView& ball, Output& output) {
    const Result<GltfDocument> document = loadGltfDocument(path);
    if (!document) return tl::unexpected(document.error());
    const auto assets = loadAssets(path);
    if (!assets) return tl::unexpected(assets.error());
    for (const std::shared_ptr<const Asset>& asset : *assets) {
        const auto start = std::chrono::steady_clock::now();
        const auto shot = Shot::create(asset, arguments.shot);
        if (!shot) return tl::unexpected(shot.error());
        const ModelView model(asset, *document, renderer);
        const Result<std::vector<Picture>> stills =
            film(**shot, model, ball, renderer, output.video.get(), FilmOptions{},
                 arguments.shot.hitTime);
        if (!stills) return tl::unexpected(stills.error());
        output.stills.insert(output.stills.end(), stills->begin(), stills->end());
        output.allBroken = describe(**shot, *asset) && output.allBroken;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        std::fprintf(stderr, "%s: filmed in %.1f s\n", asset->name().c_str(), took.count());
    }
    return {};
}

Result<bool> run(const Arguments& arguments) {
    std::error_code ignored;
    std::filesystem::create_directories(arguments.out, ignored);
    const auto context = OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    const auto renderer = SceneRenderer::create(arguments.renderer);
    if (!renderer) return tl::unexpected(renderer.error());
    const BallView ball = makeBall(**renderer);
    Output output;
    const std::filesystem::path videoPath = arguments.out / "impact.mp4";
    if (arguments.video) {
        auto video = VideoWriter::open(videoPath, arguments.renderer.width,
                                       arguments.renderer.height, FilmOptions{}.framesPerSecond);
        if (!video) return tl::unexpected(video.error());
        output.video = std::move(*video);
    }
    for (const std::filesystem::path& path : arguments.models) {
        const Result<void> filmed = filmModel(path, arguments, **renderer, ball, output);
        if (!filmed) return tl::unexpected(filmed.error());
    }
    if (output.video) {
        const Result<void> finished = output.video->finish();
        if (!finished) return tl::unexpected(finished.error());
        std::printf("wrote %s\n", videoPath.string().c_str());
    }
    const std::filesystem::path sheetPath = arguments.out / "impact.png";
    const Result<void> written = writePng(sheetPath, contactSheet(output.stills, kStillsPerShot));
    if (!written) return tl::unexpected(written.error());
    std::printf("wrote %s\n", sheetPath.string().c_str());
    return output.allBroken;
}

}  // namespace

int main(int argc, char** argv) {
    const Result<Arguments> arguments = parse(argc, argv);
    if (!arguments) {
        report(arguments.error(), kExitUsage);
        std::fprintf(stderr, "\n%s", kUsage.data());
        return kExitUsage;
    }
    if (arguments->help) {
        std::printf("%s", kUsage.data());
        return 0;
    }
    const Result<bool> broken = run(*arguments);
    if (!broken) return report(broken.error(), kExitFailed);
    return *broken ? 0 : kExitUnbroken;
}
