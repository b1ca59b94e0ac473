// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cstdint>
#include <span>

#include "bullet/own_body.h"
#include "sherd/runtime/memory.h"

class btDynamicsWorld;

namespace sherd {

/// Freezes quiet pieces one by one, where Bullet lets only a whole heap sleep at once. A frozen
/// piece is asleep and marked as static, so it joins no heap of Bullet's and costs no solving; it
/// is neither taken out of the world nor made anew, and keeps its mass.
///
/// What comes near it gently finds it fixed for that substep, and rests on it. What comes fast
/// wakes it before the contact is solved, and with it what it touches, as far as the momentum
/// reaches: so it gives way with its mass. It wakes, too, when something it touches has moved or is
/// gone, and then all that it bears, at once.
class QuietDebris {
  public:
    /// `after`: seconds that a piece must have been quiet; infinite: none is ever frozen.
    QuietDebris(btDynamicsWorld& world, float after) : world_(world), after_(after) {}

    /// A body of an island that came or changed. Null: of the game's class, it is only touched.
    void add(uint32_t island, btRigidBody& body, OwnBody* freezable, float mass,
             const btVector3& inertia);
    /// It is about to change or to go: it thaws, and so does what it bore or touched.
    void forget(uint32_t island);

    /// After a substep.
    void step(double time);
    /// Whether Bullet has given its gravity for this step already; what thaws must have its.
    void setInStep(bool inStep) { giveGravity_ = inStep; }
    /// Thaws a piece and what it touches, such as before it is pushed.
    void wake(uint32_t island);

    [[nodiscard]] bool isFrozen(uint32_t island) const {
        return island < nodes_.size() && nodes_[island].isFrozen;
    }
    [[nodiscard]] uint32_t frozenCount() const { return frozenCount_; }

    /// Freezes a piece that lies still, whether or not it has for long. False where it may not be.
    bool rest(uint32_t island);
    /// What is known to touch before Bullet has made contacts of it; one of the two is frozen.
    void touch(uint32_t lower, uint32_t upper, bool bears) { link(lower, upper, bears, false); }
    void touchBearer(uint32_t island, const btCollisionObject& bearer);
    /// Fixed, asleep, or slower than what wakes others.
    [[nodiscard]] bool isSlow(uint32_t island) const;

    /// Something awake is near a frozen piece, and contacts have not been solved yet.
    void onNear(uint32_t island, const btCollisionObject& other);

  private:
    static constexpr uint32_t kForeign = 1U << 31;  ///< of others_, not of nodes_
    static constexpr uint32_t kNobody = UINT32_MAX;

    /// Of two that touch, or are near each other, one of them frozen. Both list it.
    struct Link {
        uint32_t to;
        bool bearsMe, isBorne;
        btTransform pose;  ///< of the one that lists it, when it was last known at rest
    };
    struct Node {
        btRigidBody* body = nullptr;   ///< null: there is none
        OwnBody* freezable = nullptr;  ///< the same; null: it may not be frozen
        float mass = 0;
        btVector3 inertia{0, 0, 0};
        float size = 0;       ///< radius around its centre, metres
        float wakeSpeed = 0;  ///< m/s, of what comes near
        bool isFrozen = false, isHeld = false, isInWorld = false;
        btTransform pose;  ///< since which it has been quiet, or in which it was frozen
        double since = 0;  ///< s
        Vector<Link> links;
    };
    /// A body of the game's that frozen pieces touch. It may be deleted at any time.
    struct Other {
        const btCollisionObject* object = nullptr;  ///< null: this slot is free
        int uniqueId = 0, index = 0;                ///< in Bullet's world
        btTransform seen;                           ///< its pose in the last substep
        Vector<Link> links;
    };
    struct Touch {
        uint32_t a, b;
        bool aBearsB, bBearsA;
    };

    [[nodiscard]] uint32_t islandOf(const btCollisionObject& object) const;
    uint32_t otherFor(const btCollisionObject& object);
    Vector<Link>& linksOf(uint32_t id);
    [[nodiscard]] btTransform poseOf(uint32_t id) const;
    void link(uint32_t a, uint32_t b, bool aBearsB, bool bBearsA);
    void unlink(uint32_t from, uint32_t to);
    void checkOthers();
    void look(const Link& link, const btTransform& now, float radius);
    [[nodiscard]] bool isThere(Other& other) const;
    void watch(uint32_t island, double time);
    void watchFrozen(uint32_t island);

    void freezeQuiet(double time);
    void findTouches();
    [[nodiscard]] bool isFirm(uint32_t id) const;
    void findGrounded();
    [[nodiscard]] bool mayFreeze(const Node& node) const;
    [[nodiscard]] static float wakeSpeedOf(const Node& node);
    void freeze(uint32_t island);
    void hold(uint32_t island);
    void letGo(Node& node);
    void thaw(uint32_t island);
    void thawReached(uint32_t from, float mass);
    void thawBorne(uint32_t from);

    btDynamicsWorld& world_;
    float after_;
    bool giveGravity_ = false;  ///< to what thaws
    double time_ = 0;
    uint32_t tick_ = 0;
    uint32_t frozenCount_ = 0, freezableCount_ = 0;
    Vector<Node> nodes_;  ///< per island
    Vector<Other> others_;
    Vector<uint32_t> held_, queue_, candidates_;
    Vector<uint32_t> gone_, touched_;  ///< frozen pieces whose support is, that are
    Vector<Touch> touches_;
    enum class Standing : uint8_t { none, candidate, grounded };
    Vector<Standing> standing_;  ///< per island, in a round
};

}  // namespace sherd
