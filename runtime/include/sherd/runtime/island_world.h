// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sherd/runtime/area_damage.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/damage.h"
#include "sherd/runtime/debris.h"
#include "sherd/runtime/events.h"
#include "sherd/runtime/stress.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// How a body stands and moves. Its frame: origin in the centre of mass, principal axes.
struct BodyMotion {
    RigidPose pose;                   ///< body to world
    glm::vec3 linearVelocity{0.0F};   ///< of the centre of mass, m/s, world
    glm::vec3 angularVelocity{0.0F};  ///< rad/s, world
};

/// What a physics engine must know of an island to make a body of it.
struct IslandBody {
    uint32_t island = 0;  ///< number of the body, for as long as it lives
    ObjectId object;
    const Asset* asset = nullptr;
    std::span<const uint32_t> fragments;  ///< whose colliders make it up, ascending
    float mass = 0;                       ///< kg; 0: it stands fixed
    glm::vec3 inertia{0.0F};              ///< along the axes of the frame, kg m^2; 0: fixed
    float friction = 0.5F;
    float restitution = 0;
    RigidPose frame;    ///< body to object: where the body's frame lies among the fragments
    BodyMotion motion;  ///< that it must have
};

/// A hit that was not measured from contacts: a ray, a kinematic blade, another engine's.
struct ReportedHit {
    glm::vec3 point{0.0F};   ///< world, metres
    glm::vec3 normal{0.0F};  ///< unit, pointing into what is hit; for the event
    float energy = 0;        ///< J, at most what is consumed
    float speed = 0;         ///< m/s, which gives the stress
    float impulse = 0;       ///< N s, for the event and the minimum of the options
};

class IslandMerger;

/// A physics engine, as far as breaking needs one. Calls come from within the calls of IslandWorld.
class BodyTable {
  public:
    virtual ~BodyTable() = default;
    virtual void create(const IslandBody& body) = 0;
    /// The body stays, and what it consists of changes: shape, mass, centre, motion.
    virtual void update(const IslandBody& body) = 0;
    virtual void remove(uint32_t island) = 0;
    [[nodiscard]] virtual BodyMotion motion(uint32_t island) const = 0;

    /// An island is about to come apart or to change, and what became of it, itself first.
    virtual void beforeSplit(uint32_t /*island*/) {}
    virtual void afterSplit(uint32_t /*island*/, std::span<const uint32_t> /*islands*/) {}
};

/// Objects, their islands and what breaks them, over whatever engine moves the bodies. It measures
/// no contacts: the engine's adapter does, and calls `strike`. Slots of objects and islands are
/// used again last in, first out, so equal calls give equal numbers.
class IslandWorld {
  public:
    explicit IslandWorld(BodyTable& bodies, uint32_t maxPendingEvents = 65536);
    ~IslandWorld();
    IslandWorld(const IslandWorld&) = delete;
    IslandWorld& operator=(const IslandWorld&) = delete;

    struct Island {
        bool isAlive = false;
        bool isFixed = false;
        bool isAnchored = false;  ///< by a bond to the world that is not broken, or a pin
        uint32_t object = 0;
        std::vector<uint32_t> fragments;         ///< that stand, ascending
        RigidPose frame;                         ///< body to object
        double bornAt = 0;                       ///< s
        RigidPose pose, previous;                ///< of the object's frame, now and a substep ago
        double mass = 0;                         ///< kg, fixed or not
        double keptAt = -HUGE_VAL;               ///< s; when the game last said that it stays
        double fadingSince = HUGE_VAL;           ///< s; infinite: it does not
        RemovalReason why = RemovalReason::age;  ///< it fades

        [[nodiscard]] bool isFading() const { return fadingSince < HUGE_VAL; }
    };
    struct Object {
        std::shared_ptr<const Asset> asset;  ///< null: this slot is free
        std::unique_ptr<Structure> structure;
        uint32_t generation = 0;
        DamageOptions damage;
        std::vector<uint32_t> islands;   ///< ascending by their first fragment
        uint32_t heaviest = UINT32_MAX;  ///< of them; UINT32_MAX: not known
    };

    /// A whole object. It stands fixed when it is anchored, or when `dynamic` is false until
    /// something comes off. `motion`: of its centre of mass; its pose is not read.
    ObjectId spawn(std::shared_ptr<const Asset> asset, const RigidPose& pose,
                   const DamageOptions& damage, bool dynamic, const BodyMotion& motion);
    void remove(uint32_t object);

    /// How many islands may still come off until the next call, by hits, area damage and load.
    /// Where there would be more, they are fewer and larger now. What the game breaks piece by
    /// piece
    /// (`breakFragment`, `breakAll`, pins) comes off whatever this says, and counts.
    void allowBodies(uint32_t count) { budget_.bodies = count; }
    /// The same of islands that move; one a hit always may.
    void allowAwake(uint32_t count) { budget_.awake = count; }

    void setTime(double seconds) {
        time_ = seconds;
        if (anyFading_) posesListed_ = false;
    }
    [[nodiscard]] double time() const { return time_; }
    /// A substep is over: where an island's object frame is now.
    void moveTo(uint32_t island, const RigidPose& pose);
    /// Asks the engine where the island is.
    void follow(uint32_t island);
    void stayPut(uint32_t island) { islands_[island].previous = islands_[island].pose; }
    std::span<const FragmentPose> poses();

    /// Below it no hit does anything to any object there ever was, J.
    [[nodiscard]] float leastEnergy() const { return leastEnergy_; }
    /// Whether any hit ever could break something off or within the island as it is.
    [[nodiscard]] bool isBreakable(uint32_t island) const;
    /// Whether a hit like that could do anything to the island.
    [[nodiscard]] bool canTakeDamage(uint32_t island, float energy, float impulse) const;
    /// Lets a hit at a world point on one of the island's fragments do its damage; nothing moves
    /// yet. Returns what was broken; valid until the next call.
    const HitResult& strike(uint32_t island, uint32_t fragment, const glm::vec3& point,
                            float energy, float approachSpeed);
    enum class Change {
        none,
        finer,  ///< fragments that were opened gave way to their children
        apart,  ///< it comes apart, off its anchors or to new ones
    };
    /// What the object's structure makes of the island now.
    Change regroup(uint32_t island) { return regroup(island, true); }
    /// Carries out what the last `regroup`, of this island, found: every group but the heaviest
    /// becomes an island of its own, with the velocity its part had. Lists an event if the last
    /// strike broke something. Returns the islands there are now, the old one first; valid until
    /// the next call.
    std::span<const uint32_t> split(uint32_t island, BreakEvent event);

    /// Strikes, and lets come apart what does. Returns the energy consumed, J.
    float takeHit(uint32_t island, uint32_t fragment, const ReportedHit& hit);

    /// Lets anchored islands that have changed find out what their bonds carry under `gravity`,
    /// m/s^2, world, at most so many iterations of the solver a call, and breaks what is
    /// overloaded.
    void workOnStress(const glm::vec3& gravity, uint32_t maxIterations);
    /// How overloaded a bond of the island was that was solved last: > 1 broke; 0: not known.
    [[nodiscard]] float overload(uint32_t object, uint32_t bond) const;

    /// Damage in the world's frame. Returns the bonds broken.
    uint32_t dealArea(uint32_t object, const AreaDamage& damage) {
        return dealArea(object, damage, true);
    }
    bool breakFragment(uint32_t object, uint32_t fragment, bool whole);
    void breakAll(uint32_t object);
    /// Pins leaves, or lets them go, and has the bodies follow.
    void pin(uint32_t object, std::span<const uint32_t> leaves, bool pinned);
    bool pinFragment(uint32_t object, uint32_t fragment, bool pinned);

    /// One island as another world had it.
    struct SavedIsland {
        std::vector<uint32_t> fragments;  ///< ascending
        bool isFixed = false, isAnchored = false;
        double bornAt = 0;
        double fadingSince = HUGE_VAL;
        RigidPose pose, previous;
        BodyMotion motion;
    };
    /// In place of what the object was. Fires nothing. The islands must share out what stands.
    void replace(uint32_t object, Structure&& structure, std::vector<SavedIsland>&& islands);

    std::span<const BreakEvent> takeEvents();

    /// What is known of the island as a piece.
    [[nodiscard]] DebrisInfo describePiece(uint32_t island) const;
    /// The heaviest island of an object; UINT32_MAX when it has none.
    [[nodiscard]] uint32_t heaviestOf(uint32_t object);
    /// From now on its poses say so. Nothing else does: whoever calls this removes it in the end.
    void startFading(uint32_t island, RemovalReason why);
    /// It stays, for now.
    void keep(uint32_t island) { islands_[island].keptAt = time_; }
    /// Takes an island and its fragments out for good, and lists an event.
    void removeIsland(uint32_t island, RemovalReason why);
    std::span<const RemovalEvent> takeRemovals();
    /// s that fading takes; the poses go by it.
    void setFade(float seconds) { fade_ = seconds; }

    [[nodiscard]] bool isAlive(ObjectId id) const;
    [[nodiscard]] ObjectId idOf(uint32_t object) const;
    [[nodiscard]] uint32_t objectCount() const { return uint32_t(objects_.size()); }
    [[nodiscard]] Object& object(uint32_t index) { return objects_[index]; }
    [[nodiscard]] const Object& object(uint32_t index) const { return objects_[index]; }
    [[nodiscard]] std::span<const Island> islands() const { return islands_; }
    [[nodiscard]] const Island& island(uint32_t index) const { return islands_[index]; }
    [[nodiscard]] const Object& objectOf(uint32_t island) const {
        return objects_[islands_[island].object];
    }
    /// In which a fragment stands; UINT32_MAX when it does not.
    [[nodiscard]] uint32_t findIsland(uint32_t object, uint32_t fragment) const;
    [[nodiscard]] uint32_t islandCount() const { return islandCount_; }

  private:
    uint32_t takeIsland();
    [[nodiscard]] IslandBody describe(uint32_t island) const;
    void create(IslandBody body);
    void removeIslands(Object& object);
    void dropIsland(uint32_t island);
    [[nodiscard]] float fadeOf(const Island& island) const;
    Change regroup(uint32_t island, bool isLimited);
    void keepToBudget(uint32_t island);
    uint32_t dealArea(uint32_t object, const AreaDamage& damage, bool isLimited);
    void settle(uint32_t island, uint32_t fragment, BreakEvent event, bool isLimited);
    void strain(uint32_t island);
    void addEvent(BreakEvent event, uint32_t island, uint32_t bodies);

    BodyTable& bodies_;
    uint32_t maxPendingEvents_;
    double time_ = 0;
    float leastEnergy_ = HUGE_VALF;
    std::vector<Object> objects_;
    std::vector<uint32_t> freeObjects_;
    std::vector<Island> islands_;
    std::vector<uint32_t> freeIslands_;
    uint32_t islandCount_ = 0;

    HitSolver solver_;
    HitResult hit_;
    IslandFinder groups_;  ///< of the island regrouped last
    Change change_ = Change::none;
    std::vector<uint32_t> split_;
    struct Budget {
        uint32_t bodies = UINT32_MAX, awake = UINT32_MAX;
    };
    Budget budget_;
    std::unique_ptr<IslandMerger> merger_;

    StressSolver stress_;
    uint32_t stressed_ = UINT32_MAX;  ///< the island that is solved now
    bool isStressNew_ = false;        ///< it has changed since
    std::vector<uint32_t> strained_;  ///< islands whose bonds carry something else than they did
    uint32_t stressedObject_ = UINT32_MAX;

    std::vector<FragmentPose> poses_;
    bool posesListed_ = false;
    bool anyFading_ = false;  ///< of the poses listed
    float fade_ = 1;          ///< s
    std::vector<BreakEvent> pending_, taken_;

    std::vector<RemovalEvent> pendingRemovals_, takenRemovals_;
};

}  // namespace sherd
