// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <new>

#include "bullet/body_pool.h"

namespace sherd {

/// At once, and until something touches it.
void putToSleep(btRigidBody& body);

class OwnBody;

/// Who must know what happens to a body of Sherd's.
class BodyOwner {
  public:
    virtual ~BodyOwner() = default;
    /// The game has deleted it.
    virtual void forgetDeleted(uint32_t island) = 0;
    /// Something awake is near it, or it is awake; contacts have not been solved yet.
    virtual void onNear(const OwnBody& body, const btCollisionObject& other) noexcept = 0;
    /// Where its bodies are.
    virtual BodyPool& pool() = 0;
};

/// A body that Sherd makes. Bullet asks it about everything that comes near while one of the two is
/// awake, before contacts are solved: the only place where a body can still be given back in time,
/// or seen as it came. Games that clear Bullet's world delete whatever they find in it: then it
/// tells, so that nobody looks at it again.
class OwnBody final : public btRigidBody {
  public:
    /// Why Bullet must ask.
    enum class Watch : uint8_t { frozen = 1, breakable = 2 };

    OwnBody(const btRigidBodyConstructionInfo& info, BodyOwner& owner, uint32_t island)
        : btRigidBody(info), owner_(&owner), island_(island) {}
    ~OwnBody() override {
        if (!isDisowned_) owner_->forgetDeleted(island_);
    }
    OwnBody(const OwnBody&) = delete;
    OwnBody& operator=(const OwnBody&) = delete;
    static void* operator new(size_t /*size*/, BodyPool& pool) { return pool.take(); }
    static void operator delete(void* place, BodyPool& pool) { pool.giveBack(place); }
    static void operator delete(OwnBody* body, std::destroying_delete_t /*tag*/) {
        BodyPool& pool = body->owner_->pool();
        body->~OwnBody();
        pool.giveBack(body);
    }

    /// Its end is no news to its owner.
    void disown() { isDisowned_ = true; }

    [[nodiscard]] uint32_t island() const { return island_; }
    [[nodiscard]] bool isWatchedAs(Watch why) const { return (watches() & uint8_t(why)) != 0; }
    void watch(Watch why, bool isOn) {
        const auto bit = uint8_t(why);
        watches_.store(uint8_t(isOn ? watches() | bit : watches() & ~bit), kRelaxed);
        keepWatch();
    }
    /// A game that lets a pair collide again turns Bullet's question off. Returns false if it was.
    bool keepWatch() {
        const bool was = m_checkCollideWith != 0;
        const bool isOn = watches() != 0 || getNumObjectsWithoutCollision() > 0;
        m_checkCollideWith = isOn ? 1 : 0;
        return was || !isOn;
    }

    /// The round of questions in which an ApproachWatch last noted something of it.
    std::atomic<uint64_t>& notedIn() const { return notedIn_; }

    bool checkCollideWithOverride(const btCollisionObject* other) const override {
        if (!btRigidBody::checkCollideWithOverride(other)) return false;
        if (!isDisowned_ && watches() != 0) owner_->onNear(*this, *other);
        return true;
    }

  private:
    static constexpr auto kRelaxed = std::memory_order_relaxed;
    [[nodiscard]] uint8_t watches() const { return watches_.load(kRelaxed); }

    BodyOwner* owner_;
    uint32_t island_;
    bool isDisowned_ = false;
    // Bullet may ask on several threads, of which one wakes what another asks about.
    std::atomic<uint8_t> watches_{0};
    mutable std::atomic<uint64_t> notedIn_{0};
};

/// Deletes Sherd's bodies, and lets go those of the game.
struct BodyRelease {
    bool isGames = false;
    void operator()(btRigidBody* body) const {
        if (isGames) return;
        static_cast<OwnBody*>(body)->disown();
        delete body;
    }
};
using BodyPointer = std::unique_ptr<btRigidBody, BodyRelease>;

}  // namespace sherd
