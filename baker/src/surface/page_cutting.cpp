// SPDX-License-Identifier: MIT
#include "surface/page_cutting.h"

#include <algorithm>

#include "map/gap_closing.h"
#include "message_text.h"
#include "surface/thesis_pairing.h"

namespace sherd {
namespace {

TileRange tilesOf(std::span<const UvTriangle> frames) {
    GridPoint low{kGridLimit, kGridLimit};
    GridPoint high{-kGridLimit, -kGridLimit};
    for (const UvTriangle& frame : frames) {
        for (const GridPoint& p : frame.corner) {
            low = {std::min(low.u, p.u), std::min(low.v, p.v)};
            high = {std::max(high.u, p.u), std::max(high.v, p.v)};
        }
    }
    const auto first = [](int32_t x) { return x >> 24; };  // rounds down
    const auto last = [](int32_t x) { return (x - 1) >> 24; };
    return {std::min(0, first(low.u)), std::max(0, last(high.u)), std::min(0, first(low.v)),
            std::max(0, last(high.v))};
}

}  // namespace

void tilePage(Page& page, Wrap wrapU, Wrap wrapV, const TileRange& range) {
    if (range.onlyPage()) return;
    TiledLines tiled = tileLines(page.map.lines, wrapU, wrapV, range);
    std::vector<uint32_t> marks;
    for (const uint32_t of : tiled.lineOf) marks.push_back(page.marks[of]);
    page.map.lines = std::move(tiled.lines);
    page.marks = std::move(marks);
}

Result<void> PageCutter::closeGapsOf(Page& page) {
    if (!(work_.options.closeGaps > 0) || page.map.lines.empty()) return {};
    std::vector<uint32_t> lineOf;
    const Result<std::vector<ClosedGap>> closed =
        closeGaps(page.map, work_.options.closeGaps, lineOf);
    if (!closed) return tl::unexpected(closed.error());
    for (const uint32_t of : lineOf) page.marks.push_back(uint32_t{page.marks[of]});
    for (const ClosedGap& gap : *closed)
        work_.result.closedGaps.push_back(
            {std::nullopt, gap.from, text("to UV (%.5g, %.5g)", gap.to.x, gap.to.y)});
    return {};
}

Result<void> PageCutter::cutByUv(Page& page, uint32_t seamLine) {
    const Result<std::vector<UvTriangle>> frames = snapUv(work_.mesh);
    if (!frames) return tl::unexpected(frames.error());
    const auto [wrapU, wrapV, repeats] = wrapping();
    if (repeats) tilePage(page, wrapU, wrapV, tilesOf(*frames));
    return cutPage(page, *frames, seamLine);
}

PageCutter::Wrapping PageCutter::wrapping() {
    switch (work_.options.wrap) {
        case PageWrap::none:
            return {Wrap::repeat, Wrap::repeat, false};
        case PageWrap::repeat:
            return {Wrap::repeat, Wrap::repeat, true};
        case PageWrap::mirror:
            return {Wrap::mirror, Wrap::mirror, true};
        case PageWrap::clamp:
            return {Wrap::clamp, Wrap::clamp, true};
        case PageWrap::texture:
            break;
    }
    std::vector<size_t> uses(work_.mesh.placements.size(), 0);
    for (const uint32_t slot : work_.mesh.triangleMaterials)
        if (slot < uses.size()) ++uses[slot];
    const auto most = std::max_element(uses.begin(), uses.end());
    if (most == uses.end()) return {};
    const TexturePlacement& chosen =
        work_.mesh.placements[static_cast<size_t>(most - uses.begin())];
    for (size_t slot = 0; slot < uses.size(); ++slot) {
        const TexturePlacement& other = work_.mesh.placements[slot];
        if (uses[slot] == 0 || (other.wrapU == chosen.wrapU && other.wrapV == chosen.wrapV))
            continue;
        work_.result.warnings.emplace_back(
            "its pictures differ in what they show outside [0, 1]; lines follow the one that "
            "most triangles have (--wrap says otherwise)");
        break;
    }
    return {chosen.wrapU, chosen.wrapV, true};
}

Result<void> PageCutter::cutPage(const Page& page, std::span<const UvTriangle> frames,
                                 uint32_t seamLine) {
    Result<PlanarMap> planar = planarise(page.map);
    if (!planar) return tl::unexpected(planar.error());
    work_.result.warnings.insert(work_.result.warnings.end(), planar->warnings.begin(),
                                 planar->warnings.end());
    std::vector<Cut> cuts = matchAll(*planar, page.marks, frames, work_.result.topology.degenerate);
    noteLinesOffCharts(page, *planar, cuts);
    const CuttingSurface::Pass pass{*planar, frames, true, seamLine};
    if (!work_.options.seams.thesisPairing) return work_.cutAlong(pass, cuts);

    const std::vector<Cut> unmoved = cuts;
    const uint32_t averaged =
        averageSeamPairs(work_.result.topology, work_.result.surface.triangles, frames, cuts);
    if (work_.cutAlong(pass, cuts)) {
        work_.result.seams.averaged += averaged;
        return {};
    }
    // A moved end may drag its line over another.
    work_.result.warnings.emplace_back(
        "averaging line ends at seams made lines cross; it was left out");
    return work_.cutAlong(pass, unmoved);
}

void PageCutter::noteLinesOffCharts(const Page& page, const PlanarMap& map,
                                    std::span<const Cut> cuts) {
    std::vector<uint8_t> touches(work_.result.lines.size() + 1, 0);
    for (const Cut& cut : cuts) touches[cut.line] = 1;
    // A line all of which another covers has no edge here and is not off the charts.
    for (const MapEdge& edge : map.edges) {
        const uint32_t mark = page.marks[edge.line];
        if (touches[mark] != 0) continue;
        touches[mark] = 1;
        work_.result.offCharts.push_back(
            {std::nullopt, nodeUv(map, edge.from), work_.result.lines.line(mark).source});
    }
}

}  // namespace sherd
