// SPDX-License-Identifier: MIT
// What breaking costs beside plain Bullet that does the same by hand, in the same process: the
// same shapes made beforehand, one removal, the same additions, the next step.
//
// usage: sherd_bench_runtime [RUNS]
//
// Milliseconds, the smallest of RUNS (5) runs; of steps with whole objects the median of 200 RUNS.
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "impact/bullet_world.h"
#include "impact/by_hand.h"
#include "process_heap.h"
#include "sherd/runtime/structure.h"
#include "support/counting_memory.h"

namespace {

using namespace sherd;
using namespace sherd::test;

template <class Work>
double milliseconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

template <class Run>
double smallest(int runs, const Run& run) {
    double best = HUGE_VAL;
    for (int i = 0; i < runs; ++i) best = std::min(best, run());
    return best;
}

std::shared_ptr<const Asset> cubes(glm::ivec3 counts) {
    return makeBox({.size = glm::vec3(counts) * 0.1F, .level1 = counts, .toughness = 1});
}

/// Damage and split without physics.
double damageAndSplit(const std::shared_ptr<const Asset>& asset, HitSolver& solver,
                      IslandFinder& finder, HitResult& result, float energy, size_t* islands) {
    Structure structure(asset);
    structure.open(0);
    std::vector<uint32_t> all;
    for (uint32_t f = 1; f < asset->fragmentCount(); ++f) all.push_back(f);
    Hit hit;
    hit.fragment = 1;
    hit.point = asset->fragment(1).centerOfMass;
    hit.energy = energy;
    hit.stress = 1e12F;
    std::vector<uint32_t> ends;
    ends.reserve(2 * structure.graph().bonds().size());
    const double time = milliseconds([&] {
        solver.apply(structure, hit, {}, result);
        for (const uint32_t b : result.bonds)
            for (const uint32_t leaf : {structure.graph().bond(b).a, structure.graph().bond(b).b})
                ends.push_back(structure.fragmentAt(leaf));
        finder.findAround(structure, all, ends);
    });
    *islands = finder.islands().size();
    return time;
}

double breakBySherd(const std::shared_ptr<const Asset>& asset) {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId object = destruction.spawn(asset, at(0, 0, 0)).value();
    bullet.step();
    return milliseconds([&] {
        (void)destruction.breakFragment(object);
        bullet.step();
    });
}

double breakByHand(const std::shared_ptr<const Asset>& asset) {
    BulletWorld bullet;
    const FragmentShapes shapes(asset);
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    const auto add = [&](uint32_t f) {
        bodies.push_back(bodyByHand(shapes, f));
        bullet.world.addRigidBody(bodies.back().get());
    };
    add(0);
    bullet.step();
    const double time = milliseconds([&] {
        bullet.world.removeRigidBody(bodies[0].get());
        bodies.reserve(asset->fragmentCount());
        for (uint32_t f = 1; f < asset->fragmentCount(); ++f) add(f);
        bullet.step();
    });
    for (size_t b = 1; b < bodies.size(); ++b) bullet.world.removeRigidBody(bodies[b].get());
    return time;
}

/// A thousand objects that nothing hits; without Sherd, the bodies are the game's.
class IntactObjects {
  public:
    IntactObjects(bool withSherd, bool asleep)
        : asset_(makeBox({.size = glm::vec3(0.2F)})),  // tough: none may crack as it settles
          shapes_(asset_),
          bullet_(btVector3(0, -10, 0)) {
        bullet_.addGround(0);
        if (withSherd) destruction_ = std::make_unique<DestructionWorld>(bullet_.world);
        for (int i = 0; i < 1000; ++i) {
            const int row = i / 32;
            const float x = 0.5F * float(i % 32) - 8, z = 0.5F * float(row) - 8;
            btRigidBody& body = add(at(x, 0.1F, z));
            if (!asleep) body.setActivationState(DISABLE_DEACTIVATION);
        }
        for (int i = 0; i < (asleep ? 240 : 60); ++i) bullet_.step();
    }
    ~IntactObjects() {
        for (const auto& body : bodies_) bullet_.world.removeRigidBody(body.get());
    }
    IntactObjects(const IntactObjects&) = delete;
    IntactObjects& operator=(const IntactObjects&) = delete;

    double timeStep() {
        return milliseconds([&] { bullet_.step(); });
    }

  private:
    btRigidBody& add(const RigidPose& pose) {
        if (destruction_) return *destruction_->body(destruction_->spawn(asset_, pose).value());
        bodies_.push_back(bodyByHand(shapes_, 0));
        btRigidBody& body = *bodies_.back();
        const glm::vec3& place = pose.translation;
        body.setWorldTransform(
            btTransform(btQuaternion::getIdentity(), btVector3(place.x, place.y, place.z)));
        bullet_.world.addRigidBody(&body);
        return body;
    }

    std::shared_ptr<const Asset> asset_;
    FragmentShapes shapes_;
    BulletWorld bullet_;
    std::unique_ptr<DestructionWorld> destruction_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// Of steps with Sherd and without, which are made in turns. `more`: of two steps one after the
/// other, while the machine is as fast for both.
struct Overhead {
    double ours, without, more;
};
Overhead stepWithIntact(bool asleep, int steps) {
    IntactObjects sherd(true, asleep), plain(false, asleep);
    std::vector<double> ours, without, more;
    for (int i = 0; i < steps; ++i) {
        ours.push_back(sherd.timeStep());
        without.push_back(plain.timeStep());
        more.push_back(ours.back() - without.back());
    }
    return {median(ours), median(without), median(more)};
}

/// Parts knocked off a wall of ten thousand fragments, one hit after the other: the first, which
/// opens it, and the longest of the others, without the step that follows.
struct Swaps {
    double first = 0, longest = 0, median = 0;
    uint32_t bodies = 0;
    std::vector<uint32_t> kept, off;  ///< fragments, after the first
};
/// The first by hand: the whole body gives way to one of what is kept, in a compound that has to be
/// made, and one for each piece.
double openByHand(const FragmentShapes& shapes, const Swaps& swaps) {
    BulletWorld bullet;
    const auto whole = bodyByHand(shapes, 0);
    bullet.world.addRigidBody(whole.get());
    bullet.step();
    btCompoundShape compound(true, int(swaps.kept.size()));
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    bodies.reserve(swaps.off.size() + 1);
    const double time = milliseconds([&] {
        bullet.world.removeRigidBody(whole.get());
        for (const uint32_t f : swaps.kept)
            compound.addChildShape(shapes.bodyFrame(f), shapes.shape(f));
        btVector3 inertia;
        compound.calculateLocalInertia(1, inertia);
        bodies.push_back(std::make_unique<btRigidBody>(1, nullptr, &compound, inertia));
        for (const uint32_t f : swaps.off) bodies.push_back(bodyByHand(shapes, f));
        for (const auto& body : bodies) bullet.world.addRigidBody(body.get());
    });
    for (const auto& body : bodies) bullet.world.removeRigidBody(body.get());
    return time;
}

Swaps knockOff(const std::shared_ptr<const Asset>& asset, int hits) {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const ObjectId object = destruction.spawn(asset, at(0, 0, 0)).value();
    bullet.step();
    Swaps swaps;
    std::vector<double> times;
    for (int i = 0; i < hits; ++i) {
        const Asset::Box& box = asset->box(0);
        const float along = (float(i) + 0.5F) / float(hits);
        AreaDamage damage;
        damage.a = {box.high.x, box.low.y + along * (box.high.y - box.low.y), 0.13F};
        damage.radius = 0.15F;
        damage.fluence = 1e9F;
        times.push_back(milliseconds([&] { (void)destruction.damage(object, damage); }));
        bullet.step();
        if (i > 0) continue;
        const btRigidBody* keeps = destruction.body(object, asset->fragmentCount() / 2);
        for (uint32_t f = 1; f < asset->fragmentCount(); ++f)
            (destruction.body(object, f) == keeps ? swaps.kept : swaps.off).push_back(f);
    }
    swaps.first = times.front();
    std::sort(times.begin() + 1, times.end());
    swaps.longest = times.back();
    swaps.median = times[times.size() / 2];
    swaps.bodies = destruction.bodyCount() - 1;
    return swaps;
}

enum class Pieces { apart, heaped, besideWall };

/// Per step, what Sherd does after Bullet's own work, with 5,000 pieces that move: sliding apart on
/// the ground, or a heap that has just come apart, beside a wall that may break or none.
double stepWithPieces(Pieces pieces) {
    constexpr int kSteps = 20;
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world, drivenByHand());
    const bool apart = pieces == Pieces::apart;
    const auto asset = cubes(apart ? glm::ivec3(50, 1, 100) : glm::ivec3(10, 20, 25));
    const ObjectId object = destruction.spawn(asset, at(0, apart ? 0.05F : 1, 0)).value();
    (void)destruction.breakAll(object);
    for (uint32_t f = 1; apart && f < asset->fragmentCount(); ++f) {
        const glm::vec3& place = asset->fragment(f).centerOfMass;
        destruction.body(object, f)->setLinearVelocity(btVector3(place.x, 0, place.z) * 2);
    }
    if (pieces == Pieces::besideWall) {
        const auto wall = makeBox({.size = {4, 2, 0.2F}, .level1 = {16, 8, 1}});
        const ObjectId standing = destruction.spawn(wall, at(0, 1, 2.7F)).value();
        (void)destruction.anchorInBox(standing, {-9, -1, -9}, {9, 0.1F, 9});
    }
    double time = 0;
    for (int i = -5; i < kSteps; ++i) {
        bullet.step();
        const double after = milliseconds([&] { destruction.afterStep(kStep); });
        if (i >= 0) time += after;
    }
    return time / kSteps;
}

/// Per step, of a heap beside which a ball never stops turning, as a whole.
double stepOfQuietHeap(bool freezes) {
    constexpr int kSteps = 20;
    BulletWorld bullet(btVector3(0, -10, 0));
    bullet.addGround(0);
    WorldOptions options;
    options.damage.minimumImpulse = HUGE_VALF;
    if (!freezes) options.freezeAfter = HUGE_VALF;
    DestructionWorld destruction(bullet.world, options);
    const ObjectId object = destruction.spawn(cubes({18, 3, 18}), at(0, 0.15F, 0)).value();
    (void)destruction.breakAll(object);
    btRigidBody& ball = bullet.addBall(0.1F, 1, btVector3(1.01F, 0.1F, 0), btVector3(0, 0, 0));
    ball.setActivationState(DISABLE_DEACTIVATION);
    double time = 0;
    for (int i = -120; i < kSteps; ++i) {
        ball.setAngularVelocity(btVector3(0, 5, 0));
        const double step = milliseconds([&] { bullet.world.stepSimulation(kStep, 8, kStep / 4); });
        if (i >= 0) time += step;
    }
    if (freezes) std::printf("  (%u of 972 frozen)\n", destruction.frozenCount());
    return time / kSteps;
}

/// Of memory, per object, where there are many of them.
double bytesOfWhole() {
    constexpr int kObjects = 16384;
    CountingMemory counting;
    BulletWorld bullet;
    WorldOptions options;
    options.allocator = &counting;
    DestructionWorld destruction(bullet.world, options);
    const auto asset = cubes({2, 2, 2});
    const size_t before = counting.bytes();
    for (int i = 0; i < kObjects; ++i) (void)destruction.spawn(asset, at(float(i), 0, 0)).value();
    (void)destruction.poses();
    return double(counting.bytes() - before) / kObjects;
}

}  // namespace

int main(int argc, char** argv) {
    cli::keepFreedMemory();
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    HitSolver solver;
    IslandFinder finder;
    HitResult result;
    const auto thousand = cubes({7, 11, 13});
    std::printf("damage and split of %u fragments with %zu bonds, no physics\n",
                thousand->graph().leafCount(), thousand->graph().bonds().size());
    for (const float share : {0.01F, 0.1F, 0.5F}) {
        size_t islands = 0;
        const float energy = share * thousand->breakEnergy(0);
        const double time = smallest(runs, [&] {
            return damageAndSplit(thousand, solver, finder, result, energy, &islands);
        });
        std::printf("  %4.0f %% of their energy: %5zu bonds broken, %4zu islands %8.3f ms\n",
                    100 * double(share), result.bonds.size(), islands, time);
    }
    std::printf("break into bodies, and the next step%12s%12s%8s\n", "Sherd", "by hand", "ratio");
    for (const glm::ivec3 counts :
         {glm::ivec3(4, 5, 5), glm::ivec3(10, 10, 10), glm::ivec3(10, 20, 25)}) {
        const auto asset = cubes(counts);
        // In turns: whoever comes first gets the heap's memory fresh, and pays for it.
        double ours = HUGE_VAL, hand = HUGE_VAL;
        for (int i = 0; i <= runs; ++i) {
            const double byHand = breakByHand(asset), bySherd = breakBySherd(asset);
            if (i == 0) continue;
            hand = std::min(hand, byHand);
            ours = std::min(ours, bySherd);
        }
        std::printf("  %6u%40.2f%12.2f%8.2f\n", asset->graph().leafCount(), ours, hand,
                    ours / hand);
    }
    const auto wall = cubes({5, 40, 50});
    const FragmentShapes wallShapes(wall);
    Swaps swaps;
    swaps.longest = HUGE_VAL;
    double first = HUGE_VAL, byHand = HUGE_VAL;
    for (int i = 0; i < runs; ++i) {
        const Swaps now = knockOff(wall, 20);
        first = std::min(first, now.first);
        byHand = std::min(byHand, openByHand(wallShapes, now));
        if (now.longest < swaps.longest) swaps = now;
    }
    std::printf(
        "swaps of an object of %u leaves: first %.2f ms (%.2f by hand), longest of 19 others %.2f, "
        "median %.2f; %u bodies came off\n",
        wall->graph().leafCount(), first, byHand, swaps.longest, swaps.median, swaps.bodies);
    std::printf("a step with 1,000 whole objects%17s%12s%10s\n", "Sherd", "without", "more");
    for (const bool asleep : {false, true}) {
        const Overhead step = stepWithIntact(asleep, 200 * runs);
        std::printf("  %-32s%14.3f%12.3f%7.1f us %4.1f %%\n", asleep ? "asleep" : "awake",
                    step.ours, step.without, 1e3 * step.more, 100 * step.more / step.without);
    }
    std::printf("Sherd's own part of a step with 5,000 pieces that move\n");
    for (const auto& [name, pieces] :
         {std::pair("side by side", Pieces::apart), std::pair("in a heap", Pieces::heaped),
          std::pair("and beside a wall", Pieces::besideWall)})
        std::printf("  %-32s%14.3f ms\n", name, smallest(std::min(runs, 2), [&, which = pieces] {
                        return stepWithPieces(which);
                    }));
    std::printf("a step of 1/60 s, of four, of a quiet heap of 972 beside a turning ball\n");
    for (const bool freezes : {true, false})
        std::printf("  %-32s%14.3f ms\n", freezes ? "frozen one by one" : "as Bullet does",
                    stepOfQuietHeap(freezes));
    std::printf("bytes a whole object takes, its body included: %.0f\n", bytesOfWhole());
    return 0;
}
