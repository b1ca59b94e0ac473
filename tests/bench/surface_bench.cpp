// SPDX-License-Identifier: MIT
// Thesis steps 1 to 5 on their own, as tables like the thesis' 5.2 and 5.3: growing maps, growing
// meshes.
//
// usage: sherd_bench_surface [RUNS]
//
// Milliseconds of one core's CPU time, the smallest of RUNS (10) runs. `all` is cutSurface and
// floodFill, given the mesh's topology; the columns before it are its parts, run one by one. Memory
// is kept between the runs: what the system takes for handing out fresh pages is not counted.
#include <malloc.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <set>
#include <string>

#include "map/planar_map.h"
#include "process_heap.h"
#include "sherd/baker/import.h"
#include "support/models.h"
#include "support/plans.h"
#include "support/property.h"
#include "support/surface_meshes.h"
#include "surface/components.h"
#include "surface/cut_surface.h"
#include "surface/triangulation.h"

namespace {

using namespace sherd;
using namespace sherd::test;

struct Row {
    size_t crossed = 0;    ///< triangles that a line touches
    size_t crossings = 0;  ///< how often lines do so: a triangle counts once for each piece of line
    size_t split = 0;      ///< triangles afterwards
    size_t components = 0;
    double frames = HUGE_VAL, planar = HUGE_VAL, match = HUGE_VAL, resolve = HUGE_VAL,
           cut = HUGE_VAL, topology = HUGE_VAL, flood = HUGE_VAL, all = HUGE_VAL;
};

/// Calls `work` and keeps the shortest time in `best`, ms.
template <class Work>
auto timed(double& best, Work&& work) {
    const std::clock_t start = std::clock();
    auto result = work();
    best = std::min(best, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    return result;
}

template <class T>
T valueOf(Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s (%s)\n", result.error().message.c_str(), result.error().where.c_str());
    std::exit(1);
}

CutOptions optionsFor(const SurfaceMesh& mesh) {
    glm::vec3 low = mesh.positions[0], high = low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    CutOptions options;
    options.seams.joinDistance = 0.01 * glm::distance(glm::dvec3(low), glm::dvec3(high));
    return options;
}

void runWhole(const SurfaceMesh& mesh, const MeshTopology& topology, const FracturePlan& plan,
              Row& row) {
    const Components components = timed(row.all, [&] {
        const CutSurface cut = valueOf(cutSurface(mesh, topology, plan, optionsFor(mesh)));
        row.split = cut.surface.triangles.size();
        return floodFill(cut.surface, cut.topology, cut.lines, cut.lines.levels());
    });
    row.components = components.leafCount;
}

void runSteps(const SurfaceMesh& mesh, const MeshTopology& topology, const FractureMap& map,
              Row& row) {
    LineTable lines;
    std::vector<LineTable::Line> all;
    for (const FractureMap::Line& line : map.lines)
        all.push_back({line.level, line.properties, line.source});
    const std::vector<uint32_t> marks = lines.assign(std::move(all));
    const auto frames = timed(row.frames, [&] { return valueOf(snapUv(mesh)); });
    const auto planar = timed(row.planar, [&] { return valueOf(planarise(map)); });
    const SplitSurface uncut = uncutSurface(mesh);
    const auto cuts =
        timed(row.match, [&] { return matchAll(planar, marks, frames, topology.degenerate); });
    const auto edges = timed(row.resolve, [&] {
        ResolvedEdges result = resolveEdges(topology, uncut, cuts);
        joinAcrossSeams(topology, uncut, frames, cuts, lines, optionsFor(mesh).seams, result);
        return result;
    });
    const auto split = timed(row.cut, [&] {
        return valueOf(splitSurface({uncut, topology, frames, planar, cuts, edges}));
    });
    const auto after =
        timed(row.topology, [&] { return buildTopology(split.positions, vertexTriangles(split)); });
    timed(row.flood, [&] { return floodFill(split, after, lines, lines.levels()); });
    std::set<uint32_t> crossed;
    for (const Cut& cut : cuts) crossed.insert(cut.triangle);
    row.crossed = crossed.size();
    row.crossings = cuts.size();
}

void header() {
    std::printf("%-26s%10s%8s%9s%9s%6s%8s%8s%8s%9s%8s%9s%7s%8s%12s\n", "model", "triangles",
                "lines", "crossed", "split", "comp.", "frames", "planar", "match", "resolve", "cut",
                "topology", "flood", "all", "us/crossing");
}

void bench(const std::string& name, const SurfaceMesh& mesh, const FractureMap& map, int runs) {
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    const FracturePlan plan = planOf(map);
    Row row;
    for (int i = 0; i < runs; ++i) {
        runWhole(mesh, topology, plan, row);
        runSteps(mesh, topology, map, row);
    }
    std::printf("%-26s%10zu%8zu%9zu%9zu%6zu%8.2f%8.2f%8.2f%9.2f%8.2f%9.2f%7.2f%8.2f%12.3f\n",
                name.c_str(), mesh.triangles.size(), map.lines.size(), row.crossed, row.split,
                row.components, row.frames, row.planar, row.match, row.resolve, row.cut,
                row.topology, row.flood, row.all,
                1e3 * row.all / static_cast<double>(std::max<size_t>(row.crossings, 1)));
    std::fflush(stdout);
}

SurfaceMesh load(const std::string& model) {
    return std::move(valueOf(importModel(sharedDir() / "models" / model, {})).meshes.at(0));
}

/// Segments of one length in random places: the total length grows with their number.
FractureMap shortLines(uint32_t count) {
    Random random(1);
    FractureMap map;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 a(random.unit(), random.unit());
        const double angle = random.in(0, 2 * M_PI);
        map.lines.push_back(
            {{a, a + 0.02 * glm::dvec2(std::cos(angle), std::sin(angle))}, 1, "short line"});
    }
    return map;
}

/// `count` lines along u and as many along v.
FractureMap gridLines(uint32_t count) {
    FractureMap map;
    for (uint32_t i = 0; i < count; ++i) {
        const double at = (i + 0.47) / count;
        map.lines.push_back({{{-0.01, at}, {1.01, at + 0.003}}, 1, "along u"});
        map.lines.push_back({{{at, -0.01}, {at + 0.003, 1.01}}, 1, "along v"});
    }
    return map;
}

}  // namespace

int main(int argc, char** argv) {
    sherd::cli::keepFreedMemory();  // as sherd-bake does
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
    const bool real = haveSharedModels();
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    std::printf("steps 1-5, CPU ms, smallest of %d runs\n", runs);
    header();
    if (real) {
        const SurfaceMesh skull = load("dev/skull_41k_atlas.glb");
        for (const char* map : {"skull_41k_atlas_34", "skull_41k_atlas_61"})
            bench(map, skull,
                  valueOf(readFractureMap(sharedDir() / "maps" / (std::string(map) + ".svg"), {})),
                  runs);
    }
    std::printf("growing maps: random segments 0.02 long\n");
    const SurfaceMesh one = real ? load("ladder/bunny_30k.glb") : torus(150, 100);
    for (const uint32_t lines : {10U, 100U, 1000U, 10000U})
        bench(real ? "bunny_30k" : "torus", one, shortLines(lines), runs);
    std::printf("growing meshes: one grid of 10 x 10 lines\n");
    for (const int k : {10, 20, 50, 100, 200, 400}) {
        const std::string name = (real ? "bunny_" : "torus_") + std::to_string(k) + "k";
        bench(name, real ? load("ladder/" + name + ".glb") : torus(10 * k, 50), gridLines(10),
              k < 100 ? runs : std::max(1, runs / 3));
    }
}
