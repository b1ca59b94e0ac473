// SPDX-License-Identifier: MIT
// Voronoi cuts of closed meshes, as a table: pieces, how many are closed, what the volume is off
// by, and milliseconds of one core's CPU time, the smallest of RUNS (5) runs. `cut` is from
// positions and sites to caps, `pieces` from there to one closed mesh per piece.
//
// usage: sherd_bench_volume [RUNS] [--export FOLDER]
//
// --export writes each input as JSON ({name, positions, triangles, sites}) for `peers/run`, which
// cuts the same meshes into the same cells with other people's programs.
#include <malloc.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>

#include "geometry/closed_mesh.h"
#include "process_heap.h"
#include "sherd/baker/import.h"
#include "support/models.h"
#include "support/random_solids.h"
#include "volume/mesh_cut.h"
#include "volume/piece_mesh.h"
#include "volume/slab_cells.h"
#include "volume/volume_sites.h"
#include "volume/voronoi_cells.h"

namespace {

using namespace sherd;
using namespace sherd::test;

template <class T>
T valueOf(Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s (%s)\n", result.error().message.c_str(), result.error().where.c_str());
    std::exit(1);
}

double cpuMs() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Input {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

Input load(const std::string& name, const std::string& model) {
    SurfaceMesh mesh =
        std::move(valueOf(importModel(sharedDir() / "models" / model, {})).meshes.at(0));
    return {name, std::move(mesh.positions), std::move(mesh.triangles)};
}

/// How many of the faces between pieces have the same triangles, bit by bit, in both.
using Corners = std::array<std::array<float, 3>, 3>;
std::string sharedAlike(const MeshCut& cut, const CutPieces& pieces) {
    std::map<std::pair<uint32_t, Corners>, int> uses;
    for (size_t p = 0; p < pieces.pieces.size(); ++p) {
        const PieceMesh& piece = pieces.pieces[p];
        for (size_t t = 0; t < piece.triangles.size(); ++t) {
            if (!piece.origins[t].cap) continue;
            const uint32_t index = piece.origins[t].index;
            const auto cap = std::upper_bound(
                cut.caps.begin(), cut.caps.end(), index,
                [](uint32_t i, const MeshCut::Cap& c) { return i < c.first + c.count; });
            const bool high = pieces.pieceOfCell[cap->high] == p;
            Corners corners{};
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3& at =
                    cut.positions[piece.vertices[piece.triangles[t][high ? 2 - k : k]]];
                corners[k] = {at.x, at.y, at.z};
            }
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                        corners.end());
            uses[{static_cast<uint32_t>(cap - cut.caps.begin()), corners}] += high ? 1 : -1;
        }
    }
    std::map<uint32_t, bool> alike;
    for (const auto& [key, sum] : uses)
        alike[key.first] = (!alike.contains(key.first) || alike[key.first]) && sum == 0;
    const auto good =
        std::count_if(alike.begin(), alike.end(), [](const auto& a) { return a.second; });
    return std::to_string(good) + "/" + std::to_string(alike.size());
}

void header() {
    std::printf("%-22s%10s%7s%8s%8s%8s%14s%10s%12s%9s%9s%9s\n", "model", "triangles", "cells",
                "pieces", "lumps", "closed", "faces alike", "after", "volume off", "cut", "pieces",
                "all");
}

void bench(const Input& input, const std::string& what, int runs,
           const std::function<std::vector<CellFamily>(const CutGrid&)>& cells) {
    double bestCut = HUGE_VAL, bestPieces = HUGE_VAL;
    MeshCut cut;
    CutPieces pieces;
    for (int run = 0; run < runs; ++run) {
        const double start = cpuMs();
        const CutGrid grid = valueOf(CutGrid::around(input.positions, input.triangles));
        cut = valueOf(cutMesh(input.positions, input.triangles, grid,
                              valueOf(CellFunctions::of(cells(grid)))));
        const double middle = cpuMs();
        pieces = assemblePieces(cut);
        bestCut = std::min(bestCut, middle - start);
        bestPieces = std::min(bestPieces, cpuMs() - middle);
    }
    size_t closed = 0, lumps = 0, after = 0;
    double sum = 0;
    for (const PieceMesh& piece : pieces.pieces) {
        const std::vector<glm::vec3> positions = piece.positions(cut);
        const double volume = signedVolume(positions, piece.triangles, positions[0]);
        closed += proveByIds(piece.triangles).manifold() &&
                          proveByPositions(positions, piece.triangles).closed() && volume > 0
                      ? 1
                      : 0;
        lumps += piece.lumps;
        after += piece.triangles.size();
        sum += volume;
    }
    const double whole = signedVolume(input.positions, input.triangles, input.positions[0]);
    const std::string alike = sharedAlike(cut, pieces);
    std::printf("%-22s%10zu%7s%8zu%8zu%8zu%14s%10zu%12.1e%9.1f%9.1f%9.1f\n", input.name.c_str(),
                input.triangles.size(), what.c_str(), pieces.pieces.size(), lumps, closed,
                alike.c_str(), after, sum / whole - 1, bestCut, bestPieces, bestCut + bestPieces);
    std::fflush(stdout);
}

void writeJson(const std::filesystem::path& folder, const Input& input,
               const std::vector<glm::dvec3>& sites) {
    const std::string name = input.name + "_" + std::to_string(sites.size()) + ".json";
    std::FILE* file = std::fopen((folder / name).c_str(), "w");
    if (file == nullptr) {
        std::fprintf(stderr, "cannot write %s\n", (folder / name).c_str());
        std::exit(1);
    }
    std::fprintf(file, "{\"name\":\"%s\",\n\"positions\":[", input.name.c_str());
    const char* comma = "";
    for (const glm::vec3& p : input.positions) {
        std::fprintf(file, "%s%.9g,%.9g,%.9g", comma, p.x, p.y, p.z);
        comma = ",";
    }
    std::fprintf(file, "],\n\"triangles\":[");
    comma = "";
    for (const auto& t : input.triangles) {
        std::fprintf(file, "%s%u,%u,%u", comma, t[0], t[1], t[2]);
        comma = ",";
    }
    std::fprintf(file, "],\n\"sites\":[");
    comma = "";
    for (const glm::dvec3& s : sites) {
        std::fprintf(file, "%s%.17g,%.17g,%.17g", comma, s.x, s.y, s.z);
        comma = ",";
    }
    std::fprintf(file, "]}\n");
    std::fclose(file);
}

}  // namespace

int main(int argc, char** argv) {
    sherd::cli::keepFreedMemory();  // as sherd-bake does
    int runs = 5;
    std::filesystem::path folder;
    for (int a = 1; a < argc; ++a) {
        if (std::strcmp(argv[a], "--export") == 0 && a + 1 < argc)
            folder = argv[++a];
        else
            runs = std::max(1, std::atoi(argv[a]));
    }
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    const Solid ball = sphereSolid(glm::vec3(0), glm::vec3(1), 200, 101);
    std::vector<Input> inputs{{"sphere_40k", ball.positions, ball.triangles}};
    if (haveSharedModels()) {
        inputs.push_back(load("bunny_59664", "ladder/bunny_59664.glb"));
        inputs.push_back(load("skull_41k", "dev/skull_41k_atlas.glb"));
    }
    std::printf("Voronoi cells, CPU ms, smallest of %d runs\n", runs);
    header();
    for (const Input& input : inputs) {
        for (const uint32_t count : {13U, 50U, 200U, 2000U}) {
            VolumeSites options;
            options.count = count;
            const std::vector<glm::dvec3> sites =
                valueOf(volumeSites(input.positions, input.triangles, options));
            if (!folder.empty() && count <= 200) writeJson(folder, input, sites);
            bench(input, std::to_string(count), runs, [&](const CutGrid& grid) {
                return std::vector<CellFamily>{valueOf(voronoiCells(sites, grid))};
            });
        }
    }
    if (!folder.empty()) return 0;
    std::printf("4 x 4 x 4 and 10 x 10 x 10 slices, tilted\n");
    for (const Input& input : inputs) {
        for (const uint32_t n : {4U, 10U}) {
            SliceOptions options{{n, n, n}, 0.5, 0.1};
            bench(input, std::to_string(n * n * n), runs, [&](const CutGrid& grid) {
                const double reach = grid.extent() / 2;
                const glm::dvec3 middle = grid.toWorld(glm::dvec3(0));
                return valueOf(sliceCells(options, middle - reach, middle + reach, grid));
            });
        }
    }
    if (!haveSharedModels()) return 0;
    std::printf("growing meshes: 50 Voronoi cells\n");
    for (const int k : {10, 20, 50, 100, 200, 400}) {
        const std::string name = "bunny_" + std::to_string(k) + "k";
        const Input input = load(name, "ladder/" + name + ".glb");
        VolumeSites options;
        options.count = 50;
        const auto sites = valueOf(volumeSites(input.positions, input.triangles, options));
        bench(input, "50", runs, [&](const CutGrid& grid) {
            return std::vector<CellFamily>{valueOf(voronoiCells(sites, grid))};
        });
    }
}
