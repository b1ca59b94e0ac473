// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "bullet/approach_watch.h"
#include "bullet/asset_store.h"
#include "bullet/body_rules.h"
#include "bullet/body_track.h"
#include "bullet/constraint_mover.h"
#include "bullet/convert.h"
#include "bullet/island_shape.h"
#include "bullet/own_body.h"
#include "bullet/quiet_debris.h"
#include "bullet/released_pairs.h"
#include "bullet/rest_overlaps.h"
#include "sherd/runtime/island_world.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Bullet's bodies of an IslandWorld, by the islands' numbers.
class BulletBodies final : public BodyTable, private BodyOwner {
  public:
    BulletBodies(btDynamicsWorld& world, float overlapTolerance, float freezeAfter)
        : released_(*this, overlapTolerance),
          quiet_(world, freezeAfter),
          world_(world),
          constraints_(world),
          assets_(overlapTolerance) {}
    ~BulletBodies() override;
    BulletBodies(const BulletBodies&) = delete;
    BulletBodies& operator=(const BulletBodies&) = delete;

    /// Before the first body: whose islands these are, what rules say, who listens, or null, and
    /// the energy from which any contact counts, J.
    void attach(IslandWorld& islands, std::span<const BodyRule> rules, GameListener* listener,
                float leastImpact);
    /// Shapes of assets, by size.
    [[nodiscard]] AssetStore& assets() { return assets_; }
    /// Bullet's filter bits for bodies of the object that comes next; both 0: Bullet's defaults.
    void setNextFilter(int group, int mask) { nextFilter_ = BodyFilter{group, mask}; }
    /// The next body is one of the game's. `objectToBody`: where its object is in it.
    void setNextAdopted(btRigidBody& body, const RigidPose& objectToBody) {
        nextAdopted_ = Adopted{&body, toBullet(objectToBody)};
    }
    /// Whether Bullet has given its gravity for this step already; new bodies must have theirs.
    void setInStep(bool inStep) {
        inStep_ = inStep;
        quiet_.setInStep(inStep);
    }

    void create(const IslandBody& body) override;
    void update(const IslandBody& body) override;
    void remove(uint32_t island) override;
    [[nodiscard]] BodyMotion motion(uint32_t island) const override;
    void beforeSplit(uint32_t island) override;
    void afterSplit(uint32_t island, std::span<const uint32_t> islands) override;
    void tellMoves() override;

    /// Lets go the game's bodies that it has taken out of Bullet's world. Without a look at them:
    /// they may be deleted.
    void noticeGone();
    /// Whether the game is being told something, and must not change anything.
    [[nodiscard]] bool isTelling() const { return isTelling_; }
    /// Is the game's still.
    [[nodiscard]] bool isAdopted(uint32_t island) const {
        return bodies_[island].body.get_deleter().isGames;
    }
    /// An adopted body is to give way to islands that will not be split from it.
    void giveBack(uint32_t island) { replaced_ = letGo(island); }
    void announce(std::span<const uint32_t> islands);

    /// After a substep: notes where its bodies are, for `tellMoves`. Returns whether contacts can
    /// have broken any of them: Bullet wakes what is touched, and the last pieces do not break; or
    /// can have met any, where every contact counts.
    bool readPlaces();

    /// What came at those that may break, in the substep just done; as of `readPlaces`.
    [[nodiscard]] ApproachWatch& approaches() { return approaches_; }

    /// Marks those that may break, or be told of, by their places in Bullet's world; as of
    /// `readPlaces`.
    void markBreakable(Vector<uint8_t>& marks) const;

    /// Pieces that were awake and moving at the last `readPlaces`.
    [[nodiscard]] uint32_t awakeDebris() const { return awakeDebris_; }

    /// The body was moved by hand; its island knows where.
    void noteTransform(uint32_t island) {
        bodies_[island].track.startAt(bodies_[island].body->getWorldTransform());
    }

    /// The body may have been taken out of Bullet's world by the game.
    [[nodiscard]] btRigidBody& body(uint32_t island) const { return *bodies_[island].body; }
    [[nodiscard]] float diagonalOf(uint32_t island) const { return bodies_[island].diagonal; }
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (const Body& slot : bodies_)
            if (slot.body) visit(*slot.body);
    }
    /// UINT32_MAX when it is none of these.
    [[nodiscard]] uint32_t islandOf(const btCollisionObject& body) const;
    /// The fragment that a child of the body's shape belongs to; the first for -1.
    [[nodiscard]] uint32_t fragmentOf(uint32_t island, int child) const;
    /// The same, but for -1 the nearest to a point of the world.
    [[nodiscard]] uint32_t fragmentAt(uint32_t island, int child, const btVector3& point) const;
    [[nodiscard]] const FragmentShapes& shapesOf(const Asset& asset) const {
        return *assets_.find(asset).shapes;
    }
    /// One that has several colliders may be listed for each.
    [[nodiscard]] std::span<const uint32_t> fragmentsOf(uint32_t island) const;
    [[nodiscard]] const RestOverlaps& restOverlapsOf(uint32_t island) const {
        return *bodies_[island].overlaps;
    }
    [[nodiscard]] QuietDebris& quiet() { return quiet_; }
    [[nodiscard]] ReleasedPairs& released() { return released_; }
    [[nodiscard]] const ReleasedPairs& released() const { return released_; }

  private:
    struct Body {
        // What every substep asks of every body lies together.
        BodyPointer body;          ///< null: there is none
        bool isKnown = false;      ///< whether it is breakable:
        bool isBreakable = false;  ///< that changes only with the body
        bool isFixed = false;      ///< by Sherd
        uint32_t firstFragment = 0;
        OwnBody* own = nullptr;  ///< the same, made here
        BodyTrack track;
        Pooled<IslandShape> shape;  ///< null: its only fragment's own
        const FragmentShapes* shapes = nullptr;
        const RestOverlaps* overlaps = nullptr;
        uint32_t object = 0;
        float diagonal = 0;  ///< of the object, metres
        btTransform objectToBody;
        int worldIndex = -1;  ///< where an adopted body was seen in Bullet's list
        int gamesNumber = 0;  ///< what it carried as user index 3
        btTransform mass;     ///< of an adopted body: where the island's own frame is in it
    };
    struct Adopted {
        btRigidBody* body = nullptr;
        btTransform objectToBody;
    };
    Pooled<IslandShape> takeShape();
    void dropShape(Pooled<IslandShape> shape);
    btRigidBody::btRigidBodyConstructionInfo describe(Body& slot, const IslandBody& island);
    void make(Body& slot, const IslandBody& island);
    void adopt(Body& slot, const IslandBody& island);
    BodyFilter rule(Body& slot, const IslandBody& island);
    void addToWorld(Body& slot, const BodyFilter& filter);
    btRigidBody* letGo(uint32_t island);
    [[nodiscard]] bool isStillThere(uint32_t island);
    void forgetDeleted(uint32_t island) override;
    void onNear(const OwnBody& body, const btCollisionObject& other) noexcept override;
    BodyPool& pool() override { return pool_; }
    [[nodiscard]] bool asksBodies() const;
    void lose(uint32_t island);
    template <class Call>
    void tell(const Call& call) {
        if (!listener_) return;
        isTelling_ = true;
        call(*listener_);
        isTelling_ = false;
    }
    static void move(btRigidBody& body, const BodyMotion& motion);

    void watchQuiet(const IslandBody& island);
    void wakeAround(const btRigidBody& body);

    ReleasedPairs released_;
    QuietDebris quiet_;
    btDynamicsWorld& world_;
    ConstraintMover constraints_;
    IslandWorld* islands_ = nullptr;
    std::span<const BodyRule> rules_;
    GameListener* listener_ = nullptr;
    float leastImpact_ = HUGE_VALF;
    bool isTelling_ = false;
    AssetStore assets_;
    Vector<BodyFilter> filters_;  ///< per object
    std::optional<BodyFilter> nextFilter_;
    std::optional<Adopted> nextAdopted_;
    Vector<uint32_t> adopted_;         ///< islands
    btRigidBody* replaced_ = nullptr;  ///< the game's body that is coming apart
    Vector<btRigidBody*> parts_;
    BodyPool pool_{sizeof(OwnBody)};
    Vector<Body> bodies_;  ///< per island
    ApproachWatch approaches_;
    IslandShape::Marks marks_;
    Vector<Pooled<IslandShape>> spareShapes_;
    uint32_t awakeDebris_ = 0;
    Vector<uint32_t> untold_;  ///< islands whose tracks may have something to tell
    bool inStep_ = false;
};

}  // namespace sherd
