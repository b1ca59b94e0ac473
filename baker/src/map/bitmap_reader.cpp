// SPDX-License-Identifier: MIT
// A drawing in texels to a fracture map: ink, its width, its centre lines as a graph, that graph
// mended where the width of the lines distorts it, then simplified.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "map/bitmap_curves.h"
#include "map/bitmap_distance.h"
#include "map/bitmap_ends.h"
#include "map/bitmap_ink.h"
#include "map/bitmap_junctions.h"
#include "map/bitmap_prune.h"
#include "map/bitmap_refine.h"
#include "map/bitmap_simplify.h"
#include "map/bitmap_thinning.h"
#include "map/bitmap_trace.h"
#include "map/map_limits.h"
#include "message_text.h"

namespace sherd {

namespace {

constexpr size_t kMaxBitmapLines = 500'000;  ///< before pruning: more is noise, not a drawing
constexpr double kBlobShare = 1.0 / 8;       ///< of the picture's shorter side: wider is no line

class BitmapReader {
  public:
    BitmapReader(const Picture& picture, const std::string& name, const MapReadOptions& options)
        : picture_(picture), name_(name), options_(options) {}

    Result<FractureMap> read() {
        Result<Ink> ink = findInk(picture_, options_.bitmap.threshold, options_.bitmap.spur, name_);
        if (!ink) return tl::unexpected(ink.error());
        map_.warnings = std::move(ink->warnings);
        threshold_ = options_.bitmap.threshold.value_or(ink->optionThreshold());
        std::optional<CentreGraph> graph = trace(*ink);
        if (!graph)
            return fail(ErrorCode::limitExceeded,
                        "the picture holds more than " + std::to_string(kMaxBitmapLines) +
                            " lines at the threshold " + text("%.3f", threshold_) +
                            "; it is noise, not a drawing: set another threshold, or smooth it",
                        name_);
        warnOfPruned(pruneSpurs(*graph, options_.bitmap.spur));
        warnOfBlobs(*graph);
        const InkField field(*ink);
        mend(*graph, field);
        if (Result<void> added = addLines(*graph, field); !added)
            return tl::unexpected(added.error());
        if (map_.lines.empty()) return tl::unexpected(emptyError(ink->texels));
        return std::move(map_);
    }

  private:
    static std::optional<CentreGraph> trace(const Ink& ink) {
        const InkRadius radius(ink.mask);
        Raster<uint8_t> thinned = ink.mask;
        thin(thinned);
        return traceLines(thinned, radius, kMaxBitmapLines);
    }

    void mend(CentreGraph& graph, const InkField& field) const {
        for (CentreLine& line : graph.lines)
            if (!line.dead) refineLine(line, field);
        mergeJunctions(graph);
        removeCornerTips(graph, options_.bitmap.spur);
        placeJunctions(graph);
        extendEnds(graph, field);
    }

    glm::dvec2 size() const { return {picture_.width, picture_.height}; }
    glm::dvec2 toUv(glm::dvec2 texel) const {
        return glm::clamp(texel / size(), glm::dvec2(0.0), glm::dvec2(1.0));
    }
    std::string place(glm::dvec2 texel) const {
        const glm::dvec2 uv = toUv(texel);
        return "(" + text("%.4g", uv.x) + ", " + text("%.4g", uv.y) + ")";
    }

    void warnOfPruned(const Pruned& pruned) {
        if (pruned.spurs > 0 && pruned.longest > 1.5)
            map_.warnings.push_back(name_ + ": " + std::to_string(pruned.spurs) +
                                    " dead branches taken for noise and left out, the longest of " +
                                    text("%.1f", pruned.longest) + " texels at UV " +
                                    place(pruned.spurAt));
        if (pruned.specks > 0)
            map_.warnings.push_back(name_ + ": " + std::to_string(pruned.specks) +
                                    " specks without length left out, the first at UV " +
                                    place(pruned.speckAt));
    }

    void warnOfBlobs(const CentreGraph& graph) {
        const CentrePoint* widest = nullptr;
        for (const CentreLine& line : graph.lines) {
            if (line.dead) continue;
            for (const CentrePoint& point : line.points)
                if (widest == nullptr || point.radius > widest->radius) widest = &point;
        }
        const double limit = kBlobShare * std::min(picture_.width, picture_.height);
        if (widest == nullptr || 2 * widest->radius < limit) return;
        map_.warnings.push_back(name_ + ": the ink is " + text("%.0f", 2 * widest->radius) +
                                " texels wide at UV " + place(widest->at) +
                                "; it is followed as if it were a line: draw lines, not areas");
    }

    Result<void> addLines(CentreGraph& graph, const InkField& field) {
        for (CentreLine& line : graph.lines) {
            if (line.dead || line.points.size() < 2) continue;
            const std::optional<std::vector<glm::dvec2>> points = finish(line, field);
            if (!points || (points_ += points->size()) > kMaxMapPoints)
                return fail(ErrorCode::limitExceeded,
                            "the traced map needs more than " + std::to_string(kMaxMapPoints) +
                                " points; raise the bitmap's tolerance",
                            name_);
            addLine(*points);
        }
        return {};
    }

    /// In texels, simplified or as flattened curves.
    std::optional<std::vector<glm::dvec2>> finish(CentreLine& line, const InkField& field) const {
        const std::vector<size_t> corners = sharpenCorners(line, field);
        std::vector<glm::dvec2> points;
        points.reserve(line.points.size());
        for (const CentrePoint& point : line.points) points.push_back(point.at);
        const double tolerance = options_.bitmap.tolerance;
        if (!options_.bitmap.curves) return simplify(points, tolerance);
        Outline outline;
        outline.start = points.front();
        size_t first = 0;
        for (const size_t corner : corners) {
            fitCurves(std::span(points).subspan(first, corner - first + 1), tolerance, outline);
            first = corner;
        }
        fitCurves(std::span(points).subspan(first), tolerance, outline);
        const double fine = options_.tolerance * std::min(picture_.width, picture_.height);
        return flatten(outline, {}, fine, kMaxMapPoints - points_);
    }

    void addLine(const std::vector<glm::dvec2>& points) {
        FractureMap::Line line;
        for (const glm::dvec2 p : points) {
            const glm::dvec2 uv = toUv(p);
            if (line.points.empty() || line.points.back() != uv) line.points.push_back(uv);
        }
        if (line.points.size() < 2) return;
        line.level = options_.level;
        line.source = name_ + ": line " + std::to_string(map_.lines.size()) + " from (" +
                      text("%.2f", line.points.front().x) + ", " +
                      text("%.2f", line.points.front().y) + ")";
        map_.lines.push_back(std::move(line));
    }

    Error emptyError(size_t ink) const {
        return {ErrorCode::emptyMap,
                "no line found at the threshold " + text("%.3f", threshold_) +
                    (options_.bitmap.threshold ? " (given)" : " (found by Otsu's method)") + ": " +
                    std::to_string(ink) +
                    " texels are darker, none of them in a line; set another threshold, or draw "
                    "dark lines on light",
                name_};
    }

    const Picture& picture_;
    const std::string& name_;
    const MapReadOptions& options_;
    FractureMap map_;
    double threshold_ = 0;
    size_t points_ = 0;
};

Result<void> checkBitmapOptions(const BitmapOptions& options, const std::string& name) {
    if (options.threshold && !(*options.threshold > 0 && *options.threshold < 1))
        return fail(ErrorCode::badArgument, "a bitmap's threshold must be between 0 and 1", name);
    if (!(options.tolerance >= 0 && options.tolerance <= 1000))
        return fail(ErrorCode::badArgument, "a bitmap's tolerance must be from 0 to 1000 texels",
                    name);
    if (!(options.spur >= 0 && options.spur <= 1000))
        return fail(ErrorCode::badArgument, "a bitmap's spur length must be from 0 to 1000 texels",
                    name);
    return {};
}

}  // namespace

Result<FractureMap> readBitmapMap(std::span<const uint8_t> bytes, const std::string& name,
                                  const MapReadOptions& options) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (const Result<void> fine = checkMapInput(text, name, options); !fine)
        return tl::unexpected(fine.error());
    if (const Result<void> fine = checkBitmapOptions(options.bitmap, name); !fine)
        return tl::unexpected(fine.error());
    const Result<Picture> picture = decodePicture(bytes, name);
    if (!picture) return tl::unexpected(picture.error());
    return BitmapReader(*picture, name, options).read();
}

}  // namespace sherd
