// SPDX-License-Identifier: MIT
#include "map/segment_runs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

namespace sherd {

namespace {

/// A straight line in lowest terms: points with du * v - dv * u = offset. |offset| <= 2^56.
struct LineKey {
    int64_t du = 0, dv = 0, offset = 0;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const LineKey&, const LineKey&) = default;
};

struct Segment {
    LineKey key;
    GridPoint a, b;  ///< a < b
    uint32_t level = 1;
    uint32_t line = 0;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const Segment&, const Segment&) = default;
};

LineKey keyOf(GridPoint a, GridPoint b) {
    int64_t du = int64_t{b.u} - a.u;
    int64_t dv = int64_t{b.v} - a.v;
    const int64_t divisor = std::gcd(du, dv);
    du /= divisor;
    dv /= divisor;
    return {du, dv, du * a.v - dv * a.u};
}

std::string placeOf(const FractureMap::Line& line, size_t point) {
    const glm::dvec2 uv = line.points[point];
    return line.source + " point " + std::to_string(point) + " (UV " + std::to_string(uv.x) + ", " +
           std::to_string(uv.y) + ")";
}

Result<GridPoint> snap(const FractureMap::Line& line, size_t point) {
    const glm::dvec2 uv = line.points[point];
    if (const std::optional<GridPoint> grid = snapToGrid(uv.x, uv.y)) return *grid;
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
        return fail(ErrorCode::invalidData, "a fracture line has a coordinate that is not a number",
                    placeOf(line, point));
    return fail(ErrorCode::limitExceeded,
                "a fracture line leaves the UV range -8..8; move or scale it so that the drawing "
                "spans the texture",
                placeOf(line, point));
}

/// Snaps one line into `segments`; says whether anything of it is left.
Result<bool> addLine(const FractureMap::Line& line, uint32_t index,
                     std::vector<Segment>& segments) {
    bool any = false;
    GridPoint previous;
    for (size_t i = 0; i < line.points.size(); ++i) {
        const Result<GridPoint> point = snap(line, i);
        if (!point) return tl::unexpected(point.error());
        if (i > 0 && *point != previous) {
            const auto [a, b] = std::minmax(previous, *point);
            segments.push_back({keyOf(a, b), a, b, line.level, index});
            any = true;
        }
        previous = *point;
    }
    return any;
}

Result<std::vector<Segment>> snapLines(const FractureMap& map, std::vector<std::string>& warnings) {
    std::vector<Segment> segments;
    size_t vanished = 0;
    std::string example;
    for (size_t i = 0; i < map.lines.size(); ++i) {
        const Result<bool> any = addLine(map.lines[i], static_cast<uint32_t>(i), segments);
        if (!any) return tl::unexpected(any.error());
        if (!*any && ++vanished == 1) example = map.lines[i].source;
    }
    if (vanished > 0)
        warnings.push_back(std::to_string(vanished) + " line(s) without length dropped, first " +
                           example);
    return segments;
}

/// One run from the segments [first, last): sweeps their ends in order, keeping those that cover.
void addRun(const Segment* first, const Segment* last, SegmentRuns& out) {
    struct End {
        GridPoint point;
        bool opens;
        std::pair<uint32_t, uint32_t> cover;  ///< level, line
    };
    std::vector<End> ends;
    for (const Segment* s = first; s != last; ++s) {
        ends.push_back({s->a, true, {s->level, s->line}});
        ends.push_back({s->b, false, {s->level, s->line}});
    }
    std::sort(ends.begin(), ends.end(),
              [](const End& x, const End& y) { return x.point < y.point; });

    SegmentRun run{
        {ends.front().point, ends.back().point}, static_cast<uint32_t>(out.pieces.size()), 0};
    std::multiset<std::pair<uint32_t, uint32_t>> covering;
    for (size_t i = 0; i < ends.size();) {
        const GridPoint here = ends[i].point;
        std::vector<std::pair<uint32_t, uint32_t>> closing;
        for (; i < ends.size() && ends[i].point == here; ++i) {
            if (ends[i].opens)
                covering.insert(ends[i].cover);
            else
                closing.push_back(ends[i].cover);
        }
        for (const auto& cover : closing) covering.erase(covering.find(cover));
        if (i == ends.size()) break;
        const auto [level, line] = *covering.begin();
        out.pieces.push_back({here, ends[i].point, level, line});
        ++run.pieceCount;
    }
    out.runs.push_back(run);
}

}  // namespace

Result<SegmentRuns> collectRuns(const FractureMap& map) {
    SegmentRuns out;
    Result<std::vector<Segment>> segments = snapLines(map, out.warnings);
    if (!segments) return tl::unexpected(segments.error());
    std::sort(segments->begin(), segments->end());

    const Segment* const end = segments->data() + segments->size();
    for (const Segment* first = segments->data(); first != end;) {
        const Segment* last = first + 1;
        GridPoint reach = first->b;
        for (; last != end && last->key == first->key && last->a <= reach; ++last)
            reach = std::max(reach, last->b);
        addRun(first, last, out);
        first = last;
    }
    std::sort(out.runs.begin(), out.runs.end(), [](const SegmentRun& x, const SegmentRun& y) {
        return std::tie(x.support.a, x.support.b) < std::tie(y.support.a, y.support.b);
    });
    return out;
}

}  // namespace sherd
