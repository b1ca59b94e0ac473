// SPDX-License-Identifier: MIT
#include "surface/line_cutting.h"

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

void traceLine(CuttingSurface& work, const FractureMap::SurfaceLine& line, uint32_t mark,
               const PlaceFinder& finder, const PathTracer& tracer, std::vector<Chord>& chords) {
    std::optional<SurfacePoint> previous;
    for (const SurfacePlace& place : line.places) {
        const std::optional<SurfacePoint> point = finder.find(place);
        if (!point || point->distance > work.options.snapDistance) {
            BakePlace spot{std::nullopt, std::nullopt, line.source};
            if (place.in3d)
                spot.position = place.point;
            else
                spot.uv = glm::dvec2(place.point);
            work.result.offSurface.push_back(std::move(spot));
            previous.reset();
            continue;
        }
        if (previous) tracePiece(work, *previous, *point, line, mark, tracer, chords);
        previous = point;
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
    std::vector<Chord> chords;
    for (size_t i = 0; i < lines.size(); ++i)
        traceLine(work, *lines[i], marks[i], finder, tracer, chords);
    return work.cutChords(chords);
}

}  // namespace sherd
