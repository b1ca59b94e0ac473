// SPDX-License-Identifier: MIT
// What BulletBodies does with bodies that are the game's, or that the game deletes.
#include <algorithm>

#include "bullet/bullet_bodies.h"
#include "core/report.h"

namespace sherd {

void putToSleep(btRigidBody& body) {
    body.setLinearVelocity(btVector3(0, 0, 0));
    body.setAngularVelocity(btVector3(0, 0, 0));
    body.forceActivationState(ISLAND_SLEEPING);
}

void BulletBodies::adopt(Body& slot, const IslandBody& island) {
    const Adopted adopted = *std::exchange(nextAdopted_, std::nullopt);
    btRigidBody& body = *adopted.body;
    slot.body = BodyPointer(&body, BodyRelease{true});
    dropShape(std::move(slot.shape));
    slot.own = nullptr;
    slot.object = island.object.index;
    slot.firstFragment = island.fragments.front();
    slot.isFixed = body.isStaticOrKinematicObject();
    slot.diagonal = island.asset->diagonal();
    slot.objectToBody = adopted.objectToBody;
    slot.mass = adopted.objectToBody * toBullet(island.frame);
    slot.track.startAt(body.getWorldTransform());
    slot.isKnown = false;
    slot.worldIndex = body.getWorldArrayIndex();
    slot.gamesNumber = body.getUserIndex3();
    body.setUserIndex3(int(island.island));
    adopted_.push_back(island.island);
}

/// The body is as it was before it was adopted.
btRigidBody* BulletBodies::letGo(uint32_t island) {
    Body& slot = bodies_[island];
    btRigidBody* body = slot.body.release();
    body->setUserIndex3(slot.gamesNumber);
    slot.body = nullptr;
    slot.body.get_deleter().isGames = false;
    std::erase(adopted_, island);
    return body;
}

/// Bullet's list holds living bodies only; a new one at the old address has another number.
bool BulletBodies::isStillThere(uint32_t island) {
    Body& slot = bodies_[island];
    const btRigidBody* body = slot.body.get();
    const btCollisionObjectArray& all = world_.getCollisionObjectArray();
    if (slot.worldIndex >= all.size() || all[slot.worldIndex] != body) {
        slot.worldIndex = all.findLinearSearch(slot.body.get());
        if (slot.worldIndex >= all.size()) return false;
    }
    return body->getUserIndex3() == int(island);
}

void BulletBodies::noticeGone() {
    if (isTelling_) return;
    for (size_t i = adopted_.size(); i-- > 0;) {
        const uint32_t island = adopted_[i];
        if (isStillThere(island)) continue;
        (void)bodies_[island].body.release();
        bodies_[island].body.get_deleter().isGames = false;
        adopted_.erase(adopted_.begin() + std::ptrdiff_t(i));
        log(LogLevel::note, "the game has taken an adopted body out of the world");
        lose(island);
    }
}

/// Bullet's part of the body is still alive, but not for long.
void BulletBodies::forgetDeleted(uint32_t island) {
    log(LogLevel::warning, "the game has deleted a body of Sherd's");
    released_.forget(island);
    (void)bodies_[island].body.release();
    bodies_[island].own = nullptr;
    lose(island);
}

void BulletBodies::lose(uint32_t island) {
    // Nothing of it is of use to what has its number next.
    tellMoves();
    quiet_.forget(island);
    dropShape(std::move(bodies_[island].shape));
    const ObjectId object = islands_->idOf(islands_->island(island).object);
    islands_->lose(island);
    tell([&](GameListener& listener) { listener.onBodyGone(object); });
}

void BulletBodies::beforeSplit(uint32_t island) {
    const btRigidBody& body = *bodies_[island].body;
    released_.beforeSplit(island);
    constraints_.beforeSplit(body);
}

void BulletBodies::afterSplit(uint32_t island, std::span<const uint32_t> islands) {
    btRigidBody* old = replaced_ ? replaced_ : bodies_[island].body.get();
    parts_.clear();
    for (const uint32_t i : islands) parts_.push_back(bodies_[i].body.get());
    isTelling_ = true;
    constraints_.afterSplit(*old, parts_, listener_);
    isTelling_ = false;
    if (replaced_) announce(islands);
    released_.afterSplit(island, islands);
}

void BulletBodies::announce(std::span<const uint32_t> islands) {
    btRigidBody* old = std::exchange(replaced_, nullptr);
    if (!old) return;
    parts_.clear();
    for (const uint32_t i : islands) parts_.push_back(bodies_[i].body.get());
    tell([&](GameListener& listener) { listener.onReplace(*old, parts_); });
    // The game may have deleted it by now.
    const btCollisionObjectArray& all = world_.getCollisionObjectArray();
    if (all.findLinearSearch(old) < all.size()) world_.removeRigidBody(old);
}

}  // namespace sherd
