// SPDX-License-Identifier: MIT
#include "surface/line_cutting.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "surface/surface_path.h"
#include "surface/surface_point.h"

namespace sherd {
namespace {

void tracePiece(CuttingSurface& work, const SurfacePoint& from, const SurfacePoint& to,
                const FractureMap::SurfaceLine& line, uint32_t mark, const PathTracer& tracer,
                std::vector<Chord>& chords) {
    const std::optional<SurfacePath> path = tracer.trace(from, to, mark);
    const auto spot = [&] {
        const glm::dvec3 position = positionOf(work.result.surface, to);
        return BakePlace{position, work.uvAt(to.triangle, position), line.source};
    };
    if (!path) {
        work.result.gaps.push_back(spot());
        return;
    }
    if (path->alongEdges) work.result.alongEdges.push_back(spot());
    chords.insert(chords.end(), path->chords.begin(), path->chords.end());
}

/// A place of a line, found on the surface.
struct Found {
    SurfacePoint point;
    glm::dvec3 position;
};

/// What is left of a line: runs of places that lie on the surface.
struct Run {
    uint32_t line;
    std::vector<Found> places;
    bool closed() const {
        return places.size() > 2 && places.front().position == places.back().position;
    }
};

/// The runs of one line. Places off the surface are noted and end a run.
void findRuns(CuttingSurface& work, const FractureMap::SurfaceLine& line, uint32_t index,
              const PlaceFinder& finder, std::vector<Run>& runs) {
    Run run{index, {}};
    const auto finish = [&] {
        if (run.places.size() > 1) runs.push_back(run);
        run.places.clear();
    };
    for (const SurfacePlace& place : line.places) {
        const std::optional<SurfacePoint> point = finder.find(place);
        if (point && point->distance <= work.options.snapDistance) {
            run.places.push_back({*point, positionOf(work.result.surface, *point)});
            continue;
        }
        BakePlace spot{std::nullopt, std::nullopt, line.source};
        if (place.in3d)
            spot.position = place.point;
        else
            spot.uv = glm::dvec2(place.point);
        work.result.offSurface.push_back(std::move(spot));
        finish();
    }
    finish();
}

/// The nearest place of another run within reach of a run's end.
std::optional<glm::dvec3> nearestRun(const std::vector<Run>& runs, size_t own,
                                     const glm::dvec3& end, double reach) {
    std::optional<glm::dvec3> best;
    for (size_t r = 0; r < runs.size(); ++r) {
        const std::vector<Found>& places = runs[r].places;
        for (size_t i = 1; i < places.size() && r != own; ++i) {
            const glm::dvec3 a = places[i - 1].position;
            const glm::dvec3 ab = places[i].position - a;
            const double length = glm::dot(ab, ab);
            const double t =
                length > 0 ? std::clamp(glm::dot(end - a, ab) / length, 0.0, 1.0) : 0.0;
            const glm::dvec3 place = a + ab * t;
            if (glm::distance(place, end) > reach) continue;
            reach = glm::distance(place, end);
            best = place;
        }
    }
    return best;
}

/// Leads the open ends of runs on to the nearest other run, and a little over it: both follow the
/// surface, so they meet where they cross rather than in a point.
void closeGaps(CuttingSurface& work, const PlaceFinder& finder, std::vector<Run>& runs) {
    const double reach = work.options.closeGaps * boundsOf(work.result.surface).diagonal();
    if (!(reach > 0)) return;
    const std::vector<Run> drawn = runs;
    for (size_t r = 0; r < runs.size(); ++r) {
        if (drawn[r].closed()) continue;
        for (const bool atEnd : {false, true}) {
            const Found& end = atEnd ? drawn[r].places.back() : drawn[r].places.front();
            const std::optional<glm::dvec3> place = nearestRun(drawn, r, end.position, reach);
            if (!place || *place == end.position) continue;
            const glm::dvec3 beyond = *place + (*place - end.position) * 0.25;
            const std::optional<SurfacePoint> point = finder.nearest(beyond);
            if (!point) continue;
            std::vector<Found>& places = runs[r].places;
            places.insert(atEnd ? places.end() : places.begin(),
                          {*point, positionOf(work.result.surface, *point)});
            work.result.closedGaps.push_back({end.position, std::nullopt, ""});
        }
    }
}

}  // namespace

Result<void> cutSurfaceLines(CuttingSurface& work,
                             std::span<const FractureMap::SurfaceLine* const> lines,
                             std::span<const uint32_t> marks) {
    if (lines.empty()) return {};
    std::vector<UvTriangle> uv;
    if (auto frames = snapUv(work.mesh)) uv = std::move(*frames);
    const PlaceFinder finder(work.mesh, work.result.surface, work.result.topology.degenerate, uv);
    const PathTracer tracer(work.result.surface, work.result.topology);
    std::vector<Run> runs;
    for (uint32_t i = 0; i < lines.size(); ++i) findRuns(work, *lines[i], i, finder, runs);
    closeGaps(work, finder, runs);
    std::vector<Chord> chords;
    for (const Run& run : runs) {
        for (size_t i = 1; i < run.places.size(); ++i)
            tracePiece(work, run.places[i - 1].point, run.places[i].point, *lines[run.line],
                       marks[run.line], tracer, chords);
    }
    return work.cutChords(chords);
}

}  // namespace sherd
