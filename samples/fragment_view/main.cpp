// SPDX-License-Identifier: MIT
// fragment_view: pictures of baked objects pulled apart.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "camera.h"
#include "explode.h"
#include "model_view.h"
#include "offscreen_context.h"
#include "picture.h"
#include "scene_renderer.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/runtime/asset.h"

namespace {

using namespace sherd;
using namespace sherd::samples;

constexpr std::string_view kUsage =
    "usage: fragment_view -o PICTURE [options] BAKED.glb...\n"
    "\n"
    "Draws baked objects pulled apart, without a window: a row for each object, in it a picture "
    "of\n"
    "each level, the intact object first. Pieces move away from the object's middle.\n"
    "\n"
    "options:\n"
    "  -o PICTURE          a .png or .jpg file\n"
    "  --explode FACTOR    how far, as a share of their distance from the middle, 0 (at rest) to "
    "10\n"
    "                      (default 0.6)\n"
    "  --levels LIST       which levels, like 0,2 (default: all the object has)\n"
    "  --rows levels       a row for each level and a column for each object instead\n"
    "  --turn DEGREES      where to look from: 0 is from +z, 90 from +x (default 30)\n"
    "  --elevation DEGREES how high to look from, -80 to 80 (default 14)\n"
    "  --size WxH          of one level's picture in pixels, 64 to 2048 (default 480x480)\n"
    "  --samples N         per pixel and axis, 1 to 8 (default 3)\n"
    "  --quality N         of a .jpg, 1 to 100 (default 88)\n"
    "  --help              show this\n"
    "\n"
    "exit codes: 0 done; 1 a file or the graphics failed; 2 wrong usage\n"
    "\n"
    "examples:\n"
    "  fragment_view vase_baked.glb -o vase.png\n"
    "  fragment_view vase_baked.glb wall_baked.glb -o both.jpg --levels 1,2 --explode 1 --turn "
    "-40\n";

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

struct Arguments {
    bool help = false;
    std::filesystem::path out;
    std::vector<std::filesystem::path> models;
    std::vector<uint32_t> levels;  ///< empty: all
    bool rowsAreLevels = false;
    float explode = 0.6F;
    CameraOptions camera;
    RendererOptions renderer{480, 480, 2048, 3};
    int quality = 88;
};

/// The whole text as a number within the bounds.
Result<float> number(const std::string& text, float low, float high) {
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(value >= low && value <= high)) {
        return fail(ErrorCode::badArgument,
                    "a number from " + std::to_string(int(low)) + " to " +
                        std::to_string(int(high)) + " is needed here",
                    text);
    }
    return value;
}

Result<void> parseSize(const std::string& text, RendererOptions& renderer) {
    unsigned width = 0;
    unsigned height = 0;
    char rest = 0;
    const bool read = std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) == 2;
    if (!read || width < 64 || height < 64 || width > 2048 || height > 2048)
        return fail(ErrorCode::badArgument, "a size is like 480x360, from 64 to 2048", text);
    renderer.width = width;
    renderer.height = height;
    return {};
}

Result<void> parseLevels(const std::string& text, std::vector<uint32_t>& levels) {
    for (size_t at = 0; at <= text.size();) {
        const size_t end = std::min(text.find(',', at), text.size());
        const Result<float> level = number(text.substr(at, end - at), 0, 99);
        if (!level) return tl::unexpected(level.error());
        if (*level != std::floor(*level))
            return fail(ErrorCode::badArgument, "levels are whole numbers, like 0,2", text);
        levels.push_back(static_cast<uint32_t>(*level));
        at = end + 1;
    }
    return {};
}

Result<void> store(const Result<float>& value, float& to) {
    if (!value) return tl::unexpected(value.error());
    to = *value;
    return {};
}

Result<void> applyOption(const std::string& word, const std::string& value, Arguments& out) {
    float whole = 0;
    Result<void> done;
    if (word == "-o") {
        out.out = value;
    } else if (word == "--size") {
        done = parseSize(value, out.renderer);
    } else if (word == "--levels") {
        done = parseLevels(value, out.levels);
    } else if (word == "--rows") {
        out.rowsAreLevels = value == "levels";
        if (!out.rowsAreLevels && value != "objects")
            return fail(ErrorCode::badArgument, "--rows are levels or objects", value);
    } else if (word == "--explode") {
        done = store(number(value, 0, 10), out.explode);
    } else if (word == "--turn") {
        done = store(number(value, -360, 360), out.camera.turn);
    } else if (word == "--elevation") {
        done = store(number(value, -80, 80), out.camera.elevation);
    } else if (word == "--samples") {
        done = store(number(value, 1, 8), whole);
        out.renderer.samples = static_cast<uint32_t>(whole);
    } else if (word == "--quality") {
        done = store(number(value, 1, 100), whole);
        out.quality = static_cast<int>(whole);
    } else {
        return fail(ErrorCode::badArgument, "unknown option", word);
    }
    return done;
}

Result<Arguments> parse(int argc, char** argv) {
    Arguments out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--help" || word == "-h") {
            out.help = true;
            return out;
        }
        if (!word.starts_with("-")) {
            out.models.emplace_back(word);
            continue;
        }
        const Result<void> done = applyOption(word, i + 1 < argc ? argv[i + 1] : "", out);
        if (!done) return tl::unexpected(done.error());
        ++i;
    }
    const std::string kind = out.out.extension().string();
    if (kind != ".png" && kind != ".jpg" && kind != ".jpeg")
        return fail(ErrorCode::badArgument, "-o needs the name of a .png or .jpg file",
                    out.out.string());
    if (out.models.empty())
        return fail(ErrorCode::badArgument, "name at least one baked .glb file");
    out.camera.aspect = float(out.renderer.width) / float(out.renderer.height);
    return out;
}

Result<std::vector<uint32_t>> wantedLevels(const Asset& asset, const Arguments& arguments) {
    const size_t count = asset.set().levels.size();
    std::vector<uint32_t> levels = arguments.levels;
    for (uint32_t k = 0; arguments.levels.empty() && k < count; ++k) levels.push_back(k);
    for (const uint32_t level : levels) {
        if (level < count) continue;
        return fail(ErrorCode::badArgument,
                    "there is no level " + std::to_string(level) + ", only 0 to " +
                        std::to_string(count - 1),
                    asset.name());
    }
    return levels;
}

/// One row: all levels from the same camera, so that sizes can be compared.
Result<void> drawObject(const std::shared_ptr<const Asset>& asset, const GltfDocument& document,
                        const Arguments& arguments, SceneRenderer& renderer,
                        std::vector<Picture>& pictures) {
    const ModelView view(asset, document, renderer);
    const Result<std::vector<uint32_t>> levels = wantedLevels(*asset, arguments);
    if (!levels) return tl::unexpected(levels.error());
    std::vector<std::vector<FragmentPose>> states;
    std::vector<glm::vec3> places;
    for (const uint32_t level : *levels) {
        states.push_back(pullApart(*asset, level, arguments.explode));
        setDown(*asset, states.back());
        const std::vector<glm::vec3> shown = shownPlaces(*asset, states.back());
        places.insert(places.end(), shown.begin(), shown.end());
    }
    SceneFrame frame = frameAround(places, arguments.camera);
    for (const std::vector<FragmentPose>& pieces : states) {
        frame.items.clear();
        for (const FragmentPose& piece : pieces) view.append(piece, frame.items);
        pictures.push_back(renderer.render(frame));
    }
    return {};
}

using PictureRows = std::vector<std::vector<Picture>>;

PictureRows transposed(const PictureRows& rows) {
    PictureRows out;
    for (const std::vector<Picture>& row : rows) {
        out.resize(std::max(out.size(), row.size()));
        for (size_t i = 0; i < row.size(); ++i) out[i].push_back(row[i]);
    }
    return out;
}

/// Shorter rows are filled up with darkness.
Picture arrange(const PictureRows& rows) {
    size_t columns = 0;
    for (const std::vector<Picture>& row : rows) columns = std::max(columns, row.size());
    std::vector<Picture> pictures;
    for (const std::vector<Picture>& row : rows) {
        pictures.insert(pictures.end(), row.begin(), row.end());
        const Picture& like = rows.front().front();
        const Picture dark{like.width, like.height, std::vector<uint8_t>(like.pixels.size(), 24)};
        pictures.insert(pictures.end(), columns - row.size(), dark);
    }
    return contactSheet(pictures, static_cast<uint32_t>(columns));
}

Result<void> run(const Arguments& arguments) {
    const auto context = OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    const auto renderer = SceneRenderer::create(arguments.renderer);
    if (!renderer) return tl::unexpected(renderer.error());
    PictureRows rows;
    for (const std::filesystem::path& path : arguments.models) {
        const Result<GltfDocument> document = loadGltfDocument(path);
        if (!document) return tl::unexpected(document.error());
        const auto assets = loadAssets(path);
        if (!assets) return tl::unexpected(assets.error());
        for (const std::shared_ptr<const Asset>& asset : *assets) {
            rows.emplace_back();
            const Result<void> drawn =
                drawObject(asset, *document, arguments, **renderer, rows.back());
            if (!drawn) return tl::unexpected(drawn.error());
        }
    }
    const Picture sheet = arrange(arguments.rowsAreLevels ? transposed(rows) : rows);
    return arguments.out.extension() == ".png" ? writePng(arguments.out, sheet)
                                               : writeJpeg(arguments.out, sheet, arguments.quality);
}

int report(const Error& error, int exitCode) {
    std::fprintf(stderr, "error: %s%s%s%s\n", error.message.c_str(),
                 error.where.empty() ? "" : " (", error.where.c_str(),
                 error.where.empty() ? "" : ")");
    return exitCode;
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
    const Result<void> done = run(*arguments);
    if (!done) return report(done.error(), kExitFailed);
    std::printf("wrote %s\n", arguments->out.string().c_str());
    return 0;
}
