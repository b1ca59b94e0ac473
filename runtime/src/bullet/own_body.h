// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <cstdint>
#include <memory>

namespace sherd {

/// At once, and until something touches it.
void putToSleep(btRigidBody& body);

/// Who must know that the game has deleted a body of Sherd's.
class BodyOwner {
  public:
    virtual ~BodyOwner() = default;
    virtual void forgetDeleted(uint32_t island) = 0;
};

/// A body that Sherd makes. Games that clear Bullet's world delete whatever they find in it: then
/// it tells, so that nobody looks at it again.
class OwnBody final : public btRigidBody {
  public:
    OwnBody(const btRigidBodyConstructionInfo& info, BodyOwner& owner, uint32_t island)
        : btRigidBody(info), owner_(&owner), island_(island) {}
    ~OwnBody() override {
        if (owner_) owner_->forgetDeleted(island_);
    }
    OwnBody(const OwnBody&) = delete;
    OwnBody& operator=(const OwnBody&) = delete;
    void disown() { owner_ = nullptr; }

  private:
    BodyOwner* owner_;
    uint32_t island_;
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
