// SPDX-License-Identifier: MIT
// The medial surface on its own: by tangent balls on one thread and on two, beside the Voronoi
// diagram of the vertices that Qhull makes. Spheres are the worst case of nearest-neighbour
// searches: everything is equally far.
//
// usage: sherd_bench_interior [RUNS [MESH]]
//
// Milliseconds of wall time and of CPU time, the smallest of RUNS (5) runs; of Qhull alone, and how
// many times the two threads' it is. MESH: only those whose name holds it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

#include "baker/interior/shapes.h"
#include "interior/medial.h"
#include "interior/pole_medial.h"
#include "process_heap.h"
#include "sherd/baker/import.h"
#include "support/models.h"

namespace {

using namespace sherd;
using namespace sherd::test;

struct Times {
    double wall = HUGE_VAL, cpu = HUGE_VAL;
};

template <class Work>
Times smallest(int runs, const Work& work) {
    Times best;
    for (int i = 0; i < runs; ++i) {
        const std::clock_t cpu = std::clock();
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now() - start;
        best.wall = std::min(best.wall, wall.count());
        best.cpu =
            std::min(best.cpu, 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    }
    return best;
}

/// Qhull's share of the medial surface by poles, the smallest of some runs.
double qhullTime(const SurfaceMesh& mesh, int runs) {
    double best = HUGE_VAL;
    for (int i = 0; i < runs; ++i) {
        const Result<PoleMedialSurface> poles = poleMedialSurface(mesh, {});
        if (poles) best = std::min(best, 1e3 * poles->qhullSeconds);
    }
    return best;
}

/// Qhull takes minutes for large spheres: there it is left out.
void row(const std::string& name, const SurfaceMesh& mesh, int runs, bool withQhull = true) {
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    const auto balls = [&](unsigned threads) {
        MedialOptions options;
        options.threads = threads;
        return smallest(runs, [&] { (void)medialSurface(mesh, topology, options); });
    };
    const Times one = balls(1), two = balls(2);
    const auto vertices = static_cast<double>(mesh.positions.size());
    std::printf("%-24s%10zu%12.1f%12.1f%12.1f%14.2f", name.c_str(), mesh.positions.size(), one.wall,
                two.wall, one.cpu, 1e3 * one.cpu / vertices);
    if (withQhull) {
        const double qhull = qhullTime(mesh, std::min(runs, 3));
        std::printf("%12.1f%10.1f\n", qhull, qhull / two.wall);
    } else {
        std::printf("%12s%10s\n", "-", "-");
    }
}

}  // namespace

int main(int argc, char** argv) {
    sherd::cli::keepFreedMemory();  // as sherd-bake does
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    const std::string_view only = argc > 2 ? argv[2] : "";
    const auto isWanted = [&](std::string_view name) {
        return name.find(only) != std::string_view::npos;
    };
    std::printf("%-24s%10s%12s%12s%12s%14s%12s%10s\n", "mesh", "vertices", "1 thread", "2 threads",
                "cpu", "us/vertex", "qhull", "ratio");
    for (const int n : {14, 29, 58, 116}) {
        if (!isWanted("sphere")) break;
        const SurfaceMesh mesh = sphere({0, 0, 0}, glm::vec3(1), n).mesh();
        row("sphere", mesh, runs, n < 50);
    }
    for (const uint32_t n : {50U, 100U})
        if (isWanted("torus")) row("torus", torusShape(2, 0.5F, 4 * n, n).mesh(), runs);
    if (!haveSharedModels()) {
        std::puts("no real models beside the checkout");
        return 0;
    }
    for (const char* name :
         {"ladder/bunny_10k.glb", "ladder/bunny_40k.glb", "ladder/bunny_100k.glb",
          "ladder/bunny_400k.glb", "dev/skull_41k_atlas.glb"}) {
        if (!isWanted(name)) continue;
        const Result<Model> model = importModel(sharedDir() / "models" / name, {});
        if (!model) {
            std::fprintf(stderr, "%s: %s\n", name, model.error().message.c_str());
            return 1;
        }
        row(name, model->meshes.front(), runs, model->meshes.front().positions.size() < 100'000);
    }
    return 0;
}
