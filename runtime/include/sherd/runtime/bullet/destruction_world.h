// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "sherd/formats/result.h"
#include "sherd/runtime/bullet/body_rule.h"
#include "sherd/runtime/bullet/prepared_asset.h"
#include "sherd/runtime/island_world.h"

class btCollisionObject;
class btDynamicsWorld;
class btRigidBody;

namespace sherd {

class GameListener;
struct Advice;

/// Who tells the DestructionWorld that a substep is over.
enum class Drive {
    action,  ///< Bullet does: it registers itself as a btActionInterface and runs in every substep
    manual,  ///< the game calls `afterStep` after every `world.stepSimulation(dt, 0)`
};

struct WorldOptions {
    Drive drive = Drive::action;
    DamageOptions damage;  ///< for every object; each spawn may add its own
    /// Pieces released deeper inside each other than this share of the object's diagonal ignore
    /// each other until they are apart. > 0; smaller lets fewer touching pairs be ignored.
    float overlapTolerance = kOverlapTolerance;
    /// Iterations a substep that may be spent on what anchored, broken objects carry at rest; what
    /// is overloaded breaks. 0: walls stand however they are undercut.
    uint32_t stressIterations = 4;
    /// False: contacts break nothing by themselves; another world decides, and sends its breaks.
    bool authority = true;
    /// Impacts of at least so much energy are listed by `impacts`, J; infinity: none, and pieces
    /// that cannot break are not looked at. Some 0.3 us for every pair that touches.
    float leastImpact = HUGE_VALF;
    /// Filters, friction and sweeping by level and size.
    std::vector<BodyRule> rules;
    GameListener* listener = nullptr;  ///< the game's, told of what happens to its bodies
    /// Bodies that hits, area damage and load may make in a substep and the calls before it. Over
    /// it there are fewer and larger ones now, whose bonds keep next to nothing for the next hit.
    /// The default costs about 2 ms in the substep that adds them. UINT32_MAX: no limit.
    uint32_t maxNewBodiesPerStep = 128;
    /// Pieces that move at once, the same way; one a hit comes off whatever this says. A pile of
    /// 300 awake takes Bullet 6 to 10 ms a step. UINT32_MAX: no limit. `breakFragment`, `detach`,
    /// `breakAll` and anchors let go do what they say, over both.
    uint32_t maxAwakeBodies = 250;
    /// Seconds that a piece must lie quiet on something firm before it is frozen, > 0; infinite:
    /// never. A frozen piece is asleep by itself, whatever rolls through the heap (Bullet lets only
    /// a heap sleep as a whole), and static to Bullet; it keeps its mass, and wakes by touch, by
    /// losing its support, or when the game pushes or moves it. Bodies set to DISABLE_DEACTIVATION,
    /// and those with constraints, are left alone, and so is everything without gravity.
    float freezeAfter = 0.5F;
    DebrisOptions debris;  ///< which pieces go by themselves, and how
    /// Where all that grows with objects, islands and contacts gets its memory, bodies among it, in
    /// blocks that are kept for what comes later; it must outlive the DestructionWorld. Null: the
    /// heap. Assets and their shapes, which worlds share, and what Bullet takes for the bodies in
    /// its world are not among it.
    std::pmr::memory_resource* allocator = nullptr;
    /// Events of each kind kept until they are asked for; later ones are dropped. >= 1
    uint32_t maxPendingEvents = 65536;
};

struct SpawnOptions {
    /// False: the intact object stands fixed until something comes off. Objects baked with anchors
    /// stand by those, as long as one holds, and whatever this says.
    bool dynamic = true;
    DamageOptions damage;
    glm::vec3 linearVelocity{0.0F};   ///< of the centre of mass, m/s, world
    glm::vec3 angularVelocity{0.0F};  ///< rad/s, world
    int collisionGroup = 0;  ///< Bullet filter bits for the object and its fragments; both 0:
    int collisionMask = 0;   ///< Bullet's defaults
    /// Pins every leaf that touches something static where the object is put, a wall on its ground.
    bool anchorToStatic = false;
    /// What the game breaks (`breakFragment`, `detach`, `breakAll`, `damage`) while all of the
    /// object lies still starts frozen where it rests, over others, on something static: the heap
    /// keeps its shape until it is touched. Needs `WorldOptions::freezeAfter`.
    bool releaseAsleep = false;
    /// Times its size, > 0: masses grow with its cube, what breaking consumes with its square.
    /// `placementOf` takes it out of a matrix, and refuses those that stretch.
    float scale = 1;
};

struct AdoptOptions {
    RigidPose objectToBody;  ///< where the asset's object frame is in the body's
    float scale = 1;         ///< of the asset, > 0
    DamageOptions damage;
    int collisionGroup = 0;  ///< Bullet filter bits of what comes off; both 0: the body's own
    int collisionMask = 0;
};

/// What became of the objects of an asset.
struct Reload {
    uint32_t exchanged = 0;
    std::vector<ObjectId> kept;  ///< broken, weakened, anchored by the game, or adopted
};

/// What a Bullet body of Sherd's stands for.
struct BodyInfo {
    ObjectId object;
    uint32_t fragment = 0;  ///< the first, or the one a child of its compound shape belongs to
};

/// Breaks baked objects in a Bullet world that belongs to the game.
///
/// It owns only the bodies it creates and removes them when destroyed; it writes no Bullet global
/// and no solver setting. It must be destroyed before the Bullet world. Not thread-safe: use it on
/// the thread that steps the world. Assets may be shared between worlds and threads.
class DestructionWorld {
  public:
    explicit DestructionWorld(btDynamicsWorld& world, const WorldOptions& options = {});
    ~DestructionWorld();
    DestructionWorld(const DestructionWorld&) = delete;
    DestructionWorld& operator=(const DestructionWorld&) = delete;

    /// Puts an intact object into the world. `pose` places the asset's object frame; the place it
    /// had in its own scene is `asset->set().restPose`. The first spawn of an asset in a size makes
    /// its shapes; they and the asset are kept until `trim`.
    Result<ObjectId> spawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                           const SpawnOptions& options = {});

    /// The same with a body of the game's as the intact object, which must be in the Bullet world
    /// and look like it. It stays the game's and as it is until something comes off, or it cracks;
    /// then bodies of Sherd's take its place, with its motion and together as heavy, and
    /// `GameListener::onReplace` is called. Sherd uses its user index 3 until then. The game may
    /// take it out of the world, which is noticed, or have it back by `remove`.
    Result<ObjectId> adopt(btRigidBody& body, const std::shared_ptr<const Asset>& asset,
                           const AdoptOptions& options = {});

    /// Shapes that were made elsewhere: spawns of that asset in that size need make none.
    Result<void> use(const PreparedAsset& prepared);
    /// Forgets the shapes of assets that no object is of and nobody else holds.
    void trim();
    /// Puts a new bake in the place of all whole objects of an old one, where they are and as they
    /// move. What is broken keeps the old one.
    Result<Reload> reload(const std::shared_ptr<const Asset>& old,
                          const std::shared_ptr<const Asset>& fresh);

    /// What of Bullet's settings makes breaking dearer or worse than it must be; the game decides.
    /// Depends on what was spawned and on the last step.
    [[nodiscard]] std::vector<Advice> advice() const;

    /// Takes the object and all its fragments out. False when the handle is no longer valid.
    bool remove(ObjectId object);

    /// Takes out the body that a standing fragment is part of, for good; what lay on it falls.
    /// False when it does not stand.
    bool removePiece(ObjectId object, uint32_t fragment);

    /// Where the game looks from, for `DebrisOptions::distance`. Not finite: ignored.
    void setViewer(const glm::vec3& position);

    /// Breaks a standing fragment (0: the intact object) out of its neighbours and into its
    /// children, without a hit: every child is a body with the velocity of its part. False when it
    /// does not stand or has no children.
    bool breakFragment(ObjectId object, uint32_t fragment = 0);

    /// Lets energy loose on a region in the world, on one object or on all. What comes apart keeps
    /// its motion. Returns how many bonds broke.
    Result<uint32_t> damage(ObjectId object, const AreaDamage& damage);
    Result<uint32_t> damage(const AreaDamage& damage);

    /// The same in a sphere, and throws what of Sherd's is there outwards: `impulsePerArea`, N
    /// s/m^2 in the core, on the area each body shows to `damage.a`. The game's own bodies are its
    /// own.
    Result<uint32_t> explode(const AreaDamage& damage, float impulsePerArea);

    /// A hit on one of Sherd's bodies; `child` as for `find`. Returns the energy consumed, J. The
    /// hitter is the game's, who takes that from it.
    Result<float> reportHit(const btCollisionObject& body, const ReportedHit& hit, int child = -1);

    /// Breaks every bond of the object.
    bool breakAll(ObjectId object);
    /// Breaks a standing fragment out of its neighbours, whole. False when it does not stand.
    bool detach(ObjectId object, uint32_t fragment);
    /// Stops the body that a standing fragment is part of, and lets it sleep until something
    /// touches it. False when the fragment does not stand; one that stands fixed stays as it is.
    bool freeze(ObjectId object, uint32_t fragment = 0);
    /// Gives bonds that are not broken `share` of their energy back, 0..1.
    bool heal(ObjectId object, float share = 1);

    /// Holds all leaves of a fragment to the world, or lets them go again; anchors of the file are
    /// bonds and only break.
    bool anchor(ObjectId object, uint32_t fragment, bool anchored = true);
    /// All leaves whose colliders reach into a box of the world. Returns how many.
    uint32_t anchorInBox(ObjectId object, const glm::vec3& low, const glm::vec3& high);

    /// The state of an object: its damage, and its bodies with their motion, to the bit. For saved
    /// games, and for whoever joins late: small when little is broken.
    [[nodiscard]] std::vector<uint8_t> save(ObjectId object) const;
    /// Gives an object that was spawned of the same bake the state another one had. Fires no
    /// events. Bytes are checked before anything changes; those of another bake are refused.
    Result<void> restore(ObjectId object, std::span<const uint8_t> bytes);

    /// Only for `Drive::manual`: measures the hits of the substep just done and breaks what they
    /// break. Call right after every `world.stepSimulation(dt, 0)`; `dt` in seconds, > 0.
    void afterStep(float dt);

    /// Exactly what to draw: per object either the intact object or the fragments in its place.
    /// Valid until the next substep, spawn, remove or break. Ordered by object, then fragment.
    [[nodiscard]] std::span<const FragmentPose> poses() const;
    /// The runs of `poses()` that are not what they were when this was called last, ascending: what
    /// to send to the GPU. Valid as long as the poses.
    [[nodiscard]] std::span<const Range> changedPoses();

    /// The breaks since the last call, in the order they happened; each is listed once.
    /// Valid until the next call.
    std::span<const BreakEvent> events();
    /// Contacts and reported hits on objects, likewise, whether they broke anything or not.
    std::span<const ImpactEvent> impacts();
    /// Bodies that came off, and those let go, likewise; every object spawned is listed by none.
    std::span<const IslandEvent> islandEvents();

    /// The pieces that were removed since the last call, by age, distance or `removePiece`; not
    /// those of `remove`. Valid until the next call.
    std::span<const RemovalEvent> removals();

    [[nodiscard]] bool isAlive(ObjectId object) const;

    /// The body that a standing fragment is part of, or null. The largest part of what breaks keeps
    /// its body. The game may push it, put constraints on it, and take it out of the Bullet world
    /// and put it in again: it must not delete it, which only is noticed, and its part gone.
    [[nodiscard]] btRigidBody* body(ObjectId object, uint32_t fragment = 0) const;

    /// What a body found by the game (ray cast, contact) stands for; nothing when it is not
    /// Sherd's. `child`: the index of the compound's child that Bullet gives with a contact point
    /// or a ray's `LocalShapeInfo`.
    [[nodiscard]] std::optional<BodyInfo> find(const btCollisionObject& body, int child = -1) const;

    /// Bodies of Sherd's in the world now.
    [[nodiscard]] uint32_t bodyCount() const;

    /// Pieces that lie frozen, and whether one does.
    [[nodiscard]] uint32_t frozenCount() const;
    [[nodiscard]] bool isFrozen(ObjectId object, uint32_t fragment) const;
    /// Wakes the body of a standing fragment and what touches it, as `activate` does in Bullet.
    bool wake(ObjectId object, uint32_t fragment);

    /// What a fragment, of any level, must carry beside its weight: a force, N, world, at its
    /// centre of mass, until this is called for it again; zero: nothing. It strains the bonds of
    /// what is anchored, also of what is whole yet, and moves nothing. False when there is no such
    /// fragment or the force is not finite.
    bool setLoad(ObjectId object, uint32_t fragment, const glm::vec3& force);
    /// How overloaded a bond is under its load, of the anchored object that was solved last: > 1
    /// breaks; 0: not known.
    [[nodiscard]] float overload(ObjectId object, uint32_t bond) const;

    /// What is left of each bond of an object, or nullptr when it is gone.
    [[nodiscard]] const Structure* structure(ObjectId object) const;

    /// Pairs that overlapped when released and still ignore each other.
    [[nodiscard]] uint32_t ignoredPairCount() const;

    /// Simulated seconds since this was made.
    [[nodiscard]] double time() const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace sherd
