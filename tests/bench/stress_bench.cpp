// SPDX-License-Identifier: MIT
// What the stress of an island costs, as a table: fragments and bonds, milliseconds of the first
// `reset` of a solver, which takes the memory, and of a later one; iterations until the forces
// balance, and milliseconds of all of them and of the longest one; then the same after one bond is
// broken. CPU time, the smallest of RUNS (5) runs.
//
// usage: sherd_bench_stress [RUNS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

#include "sherd/runtime/stress.h"
#include "sherd/runtime/structure.h"
#include "support/box_fracture.h"

namespace {

using namespace sherd;

double cpuMs() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

struct Case {
    std::string name;
    glm::ivec3 count;
    bool sideways;  ///< anchored at x = 0 instead of y = 0
    float spread;   ///< areas differ by up to this factor
    bool undercut = false;
};

Structure make(const Case& what) {
    FractureSet set = test::makeBoxFracture({.size = glm::vec3(what.count), .level1 = what.count});
    std::mt19937 random(1);
    std::uniform_real_distribution<float> power(-1, 0);
    for (Bond& bond : set.bonds) bond.area *= std::pow(what.spread, power(random));
    for (int f = 1; f < int(set.fragments.size()); ++f) {
        const int x = (f - 1) % what.count.x, y = (f - 1) / what.count.x % what.count.y;
        if ((what.sideways ? x : y) != 0 || (what.undercut && x >= 10)) continue;
        Bond anchor;
        anchor.a = f;
        anchor.area = 1;
        anchor.normal = what.sideways ? glm::vec3(-1, 0, 0) : glm::vec3(0, -1, 0);
        anchor.centroid = set.fragments[size_t(f)].centerOfMass + 0.5F * anchor.normal;
        set.bonds.push_back(anchor);
    }
    Structure structure(Asset::fromFractureSet(std::move(set)).value());
    structure.open(0);
    return structure;
}

struct Figures {
    double reset = HUGE_VAL, solve = HUGE_VAL, longest = HUGE_VAL;
    uint32_t iterations = 0;
};

void measure(StressSolver& solver, const Structure& structure, Figures& best) {
    std::vector<uint32_t> fragments;
    for (uint32_t f = 1; f < structure.asset().fragmentCount(); ++f) fragments.push_back(f);
    double start = cpuMs();
    solver.reset(structure, fragments);
    best.reset = std::min(best.reset, cpuMs() - start);
    solver.setGravity({0, -10, 0});
    double longest = 0, all = 0;
    for (bool done = false; !done;) {
        start = cpuMs();
        done = solver.step(1);
        longest = std::max(longest, cpuMs() - start);
        all += cpuMs() - start;
        if (solver.iterationCount() > 20000) break;
    }
    best.longest = std::min(best.longest, longest);
    best.solve = std::min(best.solve, all);
    best.iterations = solver.iterationCount();
}

void print(const Figures& figures) {
    std::printf("%8.2f%6u%8.2f%8.2f", figures.reset, figures.iterations, figures.solve,
                figures.longest);
}

}  // namespace

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 5;
    std::printf("%-28s%8s%8s%8s%8s%6s%8s%8s%8s%6s%8s%8s\n", "", "pieces", "bonds", "first", "reset",
                "it", "ms", "longest", "reset", "it", "ms", "longest");
    const Structure nothing = make({"", {1, 1, 1}, false, 1});
    for (const Case& what :
         {Case{"chain", {200, 1, 1}, true, 1}, Case{"wall", {100, 50, 1}, false, 1},
          Case{"wall, areas 1:100", {100, 50, 1}, false, 100},
          Case{"wall, undercut", {100, 50, 1}, false, 1, true},
          Case{"wall of 2, areas 1:100", {50, 50, 2}, false, 100},
          Case{"block, areas 1:100", {17, 17, 17}, false, 100},
          Case{"tower, areas 1:100", {5, 200, 5}, false, 100}}) {
        Figures first, whole, broken;
        const Structure structure = make(what);
        StressSolver solver;
        measure(solver, structure, first);
        for (int run = 0; run < runs; ++run) {
            solver.reset(nothing, {});  // forgets the solution, keeps the memory
            measure(solver, structure, whole);
            Structure other = structure;
            other.breakBond(uint32_t(structure.graph().bonds().size() / 2));
            measure(solver, other, broken);
        }
        std::printf("%-28s%8d%8zu", what.name.c_str(), what.count.x * what.count.y * what.count.z,
                    structure.graph().bonds().size());
        std::printf("%8.2f", first.reset);
        print(whole);
        print(broken);
        std::printf("\n");
        std::fflush(stdout);
    }
}
