// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "sherd/runtime/area_damage.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/damage.h"
#include "sherd/runtime/debris.h"
#include "sherd/runtime/event_list.h"
#include "sherd/runtime/events.h"
#include "sherd/runtime/memory.h"
#include "sherd/runtime/pose_list.h"
#include "sherd/runtime/stress.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// How a body stands and moves. Its frame: origin in the centre of mass, principal axes.
struct BodyMotion {
    RigidPose pose;                   ///< body to world
    glm::vec3 linearVelocity{0.0F};   ///< of the centre of mass, m/s, world
    glm::vec3 angularVelocity{0.0F};  ///< rad/s, world
};

/// An error's text, or nullptr for a finite place, a unit rotation and finite velocities.
const char* whyRefused(const RigidPose& pose);
const char* whyRefused(const BodyMotion& motion);

/// What a physics engine must know of an island to make a body of it.
struct IslandBody {
    uint32_t island = 0;  ///< number of the body, for as long as it lives
    ObjectId object;
    const Asset* asset = nullptr;         ///< as large as the instance
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

/// An error's text, or nullptr when the hit can be taken.
const char* whyRefused(const ReportedHit& hit);

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

    /// Somebody wants to know where islands are: what the engine has not told after every substep
    /// (IslandWorld::moveTo, stayPut) it tells now, each move once.
    virtual void tellMoves() {}
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
        Vector<uint32_t> fragments;              ///< that stand, ascending
        RigidPose frame;                         ///< body to object
        double bornAt = 0;                       ///< s
        double mass = 0;                         ///< kg, fixed or not
        double keptAt = -HUGE_VAL;               ///< s; when the game last said that it stays
        double fadingSince = HUGE_VAL;           ///< s; infinite: it does not
        RemovalReason why = RemovalReason::age;  ///< it fades

        [[nodiscard]] bool isFading() const { return fadingSince < HUGE_VAL; }
    };
    /// Of an island's object frame, now and a substep ago.
    struct Places {
        RigidPose now, before;
    };
    /// What the game puts on a part of an object that stands.
    struct Load {
        uint32_t fragment = 0;  ///< of any level; at its centre of mass
        glm::vec3 force{0.0F};  ///< N, world
    };
    struct Object {
        std::shared_ptr<const Asset> asset;  ///< null: this slot is free
        Pooled<Structure> structure;
        uint32_t generation = 0;
        DamageOptions damage;
        Vector<Load> loads;
        Vector<uint32_t> islands;        ///< ascending by their first fragment
        uint32_t heaviest = UINT32_MAX;  ///< of them; UINT32_MAX: not known
    };

    /// A whole object. It stands fixed when it is anchored, or when `dynamic` is false until
    /// something comes off. `motion`: of its centre of mass; its pose is not read.
    ObjectId spawn(std::shared_ptr<const Asset> asset, const RigidPose& pose,
                   const DamageOptions& damage, bool dynamic, const BodyMotion& motion);
    void remove(uint32_t object);
    /// The island's body is no more; what it consisted of is gone, and the object with its last.
    void lose(uint32_t island);
    /// Puts another asset's object in the place of one that is whole, sound and not pinned. False,
    /// and nothing done, for others.
    bool exchange(uint32_t object, std::shared_ptr<const Asset> asset);

    /// How many islands may still come off until the next call, by hits, area damage and load.
    /// Where there would be more, they are fewer and larger now. What the game breaks piece by
    /// piece
    /// (`breakFragment`, `breakAll`, pins) comes off whatever this says, and counts.
    void allowBodies(uint32_t count) { budget_.bodies = count; }
    /// The same of islands that move; one a hit always may.
    void allowAwake(uint32_t count) { budget_.awake = count; }

    void setTime(double seconds) {
        time_ = seconds;
        for (const uint32_t island : fading_) poses_.noteMoved(islands_[island].object);
    }
    [[nodiscard]] double time() const { return time_; }
    /// A substep is over: where an island's object frame is now.
    void moveTo(uint32_t island, const RigidPose& pose);
    /// Asks the engine where the island is.
    void follow(uint32_t island);
    void stayPut(uint32_t island);
    std::span<const FragmentPose> poses();
    /// The runs of `poses` that are not what they were when this was called last.
    std::span<const Range> changedPoses();

    /// Below it no hit does anything to any object there ever was, J.
    [[nodiscard]] float leastEnergy() const { return leastEnergy_; }
    /// Whether any hit ever could break something off or within the island as it is.
    [[nodiscard]] bool isBreakable(uint32_t island) const;
    /// Whether a hit like that could do anything to the island.
    [[nodiscard]] bool canTakeDamage(uint32_t island, float energy, float impulse) const;
    /// Lets a hit at a world point on one of the island's fragments do its damage; nothing moves
    /// yet. A fragment that was opened since it was hit passes the hit on to the part at the point.
    /// Returns what was broken; valid until the next call.
    const HitResult& strike(uint32_t island, uint32_t fragment, const glm::vec3& point,
                            float energy, float approachSpeed);
    enum class Change {
        none,
        finer,  ///< fragments that were opened gave way to their children
        apart,  ///< it comes apart, off its anchors or to new ones
    };
    /// What the last strike has made of the island; after every strike that broke something.
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
    /// What a fragment of any level must carry beside its weight, until this is called for it
    /// again; zero: nothing. It strains the bonds of anchored islands, also within what is whole
    /// yet, and moves nothing. False when the object has no such fragment or the force is not
    /// finite.
    bool setLoad(uint32_t object, const Load& load);
    /// How overloaded a bond of the island was that was solved last: > 1 broke; 0: not known.
    [[nodiscard]] float overload(uint32_t object, uint32_t bond) const;

    /// Damage in the world's frame. Returns the bonds broken.
    uint32_t dealArea(uint32_t object, const AreaDamage& damage);
    bool breakFragment(uint32_t object, uint32_t fragment, bool whole);
    void breakAll(uint32_t object);
    /// Pins leaves, or lets them go, and has the bodies follow.
    void pin(uint32_t object, std::span<const uint32_t> leaves, bool pinned);
    bool pinFragment(uint32_t object, uint32_t fragment, bool pinned);
    /// Pins the leaves whose colliders' bounds reach into a box of the world. Returns how many.
    uint32_t pinInBox(uint32_t object, const glm::vec3& low, const glm::vec3& high);

    /// One island as another world had it.
    struct SavedIsland {
        Vector<uint32_t> fragments;  ///< ascending
        bool isFixed = false, isAnchored = false;
        double bornAt = 0;
        double fadingSince = HUGE_VAL;
        Places places;
        BodyMotion motion;  ///< of its body, which is put there to the bit
    };
    /// In place of what the object was. Fires nothing. The islands must share out what stands.
    void replace(uint32_t object, Structure&& structure, Vector<SavedIsland>&& islands);

    std::span<const BreakEvent> takeEvents() { return breaks_.take(); }
    std::span<const ImpactEvent> takeImpacts() { return impacts_.take(); }
    std::span<const IslandEvent> takeIslandEvents() { return born_.take(); }
    /// Lists a hit, that need not break anything, on one of the island's fragments.
    void addImpact(uint32_t island, uint32_t fragment, const ReportedHit& hit);

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
    std::span<const RemovalEvent> takeRemovals() { return removals_.take(); }
    /// s that fading takes; the poses go by it.
    void setFade(float seconds) { fade_ = seconds; }
    /// How far it has come: 0 when it does not fade, up to 1.
    [[nodiscard]] float fadeOf(const Island& island) const;

    [[nodiscard]] bool isAlive(ObjectId id) const;
    [[nodiscard]] ObjectId idOf(uint32_t object) const;
    [[nodiscard]] uint32_t objectCount() const { return uint32_t(objects_.size()); }
    [[nodiscard]] Object& object(uint32_t index) { return objects_[index]; }
    [[nodiscard]] const Object& object(uint32_t index) const { return objects_[index]; }
    [[nodiscard]] std::span<const Island> islands() const { return islands_; }
    [[nodiscard]] const Island& island(uint32_t index) const { return islands_[index]; }
    /// Valid until the next call that is not const, or a substep.
    [[nodiscard]] const Places& placesOf(uint32_t island) const {
        bodies_.tellMoves();
        return places_[island];
    }
    /// The same for who knows that everything has been told.
    [[nodiscard]] const Places& toldPlacesOf(uint32_t island) const { return places_[island]; }
    [[nodiscard]] const Object& objectOf(uint32_t island) const {
        return objects_[islands_[island].object];
    }
    /// In which a fragment stands; UINT32_MAX when it does not.
    [[nodiscard]] uint32_t findIsland(uint32_t object, uint32_t fragment) const;
    [[nodiscard]] uint32_t islandCount() const { return islandCount_; }
    /// Of an island's body now.
    [[nodiscard]] BodyMotion motionOf(uint32_t island) const { return bodies_.motion(island); }

  private:
    uint32_t takeIsland(const Places& places);
    [[nodiscard]] IslandBody describe(uint32_t island) const;
    [[nodiscard]] uint32_t fragmentNear(uint32_t island, const glm::vec3& point) const;
    void create(IslandBody body, const RigidPose* bodyPose = nullptr);
    void removeIslands(uint32_t object);
    void forgetIsland(uint32_t island);
    void takeOut(uint32_t island);
    std::span<const uint32_t> disturbed(const Structure& structure);
    Change regroup(uint32_t island, bool isLimited);
    void keepToBudget(uint32_t island);
    uint32_t dealTo(uint32_t island, const AreaDamage& damage, const glm::vec3& point,
                    bool isLimited);
    void settle(uint32_t island, uint32_t fragment, BreakEvent event, bool isLimited);
    void strain(uint32_t island);
    void takeUp(uint32_t island);
    void addEvent(BreakEvent event, uint32_t island, uint32_t bodies);
    void addIslandEvent(const IslandBody& body, uint32_t from);

    BodyTable& bodies_;
    EventList<BreakEvent> breaks_;
    EventList<ImpactEvent> impacts_;
    EventList<IslandEvent> born_;
    EventList<RemovalEvent> removals_;
    double time_ = 0;
    float leastEnergy_ = HUGE_VALF;
    Vector<Object> objects_;
    Vector<uint32_t> freeObjects_;
    Vector<Island> islands_;
    Vector<Places> places_;  ///< per island; what the engine has not told yet is missing
    Vector<uint32_t> freeIslands_;
    uint32_t islandCount_ = 0;

    HitSolver solver_;
    HitResult hit_;
    IslandFinder groups_;  ///< of the island regrouped last
    Vector<uint32_t> disturbed_;
    Change change_ = Change::none;
    Vector<uint32_t> split_;
    struct Budget {
        uint32_t bodies = UINT32_MAX, awake = UINT32_MAX;
    };
    Budget budget_;
    std::unique_ptr<IslandMerger> merger_;

    StressSolver stress_;
    uint32_t stressed_ = UINT32_MAX;  ///< the island that is solved now
    bool isStressNew_ = false;        ///< it has changed since
    Vector<uint32_t> strained_;       ///< islands whose bonds carry something else than they did
    uint32_t stressedObject_ = UINT32_MAX;
    std::optional<Structure> probe_;  ///< of the object solved, as if what is loaded were opened
    Vector<uint32_t> parts_;

    PoseList poses_;
    float fade_ = 1;
    Vector<uint32_t> fading_;  ///< islands
};

}  // namespace sherd
