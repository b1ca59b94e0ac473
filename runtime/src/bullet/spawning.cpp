// SPDX-License-Identifier: MIT
// How objects come into a DestructionWorld.
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "bullet/convert.h"
#include "bullet/destruction_world_impl.h"
#include "core/finite.h"

namespace sherd {
namespace {

/// Of what stands for the asset.
Result<void> checkInstance(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                           float scale, const DamageOptions& damage) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    if (const char* why = whyRefused(pose)) return fail(ErrorCode::badArgument, why, "pose");
    if (!(scale > 0) || !std::isfinite(scale))
        return fail(ErrorCode::badArgument, "the scale must be positive and finite",
                    "options.scale");
    if (const char* why = whyRefused(damage))
        return fail(ErrorCode::badArgument, why, "options.damage");
    return {};
}

constexpr const char* kTelling = "a GameListener must not change the world that calls it";

constexpr float kStaticTouch = 1e-3F;  // of the object's diagonal: how near is touching

/// Whether a shape at a place comes as near as `tolerance`, metres, to something static.
bool touchesStatic(btCollisionWorld& world, btCollisionShape& shape, const btTransform& place,
                   float tolerance) {
    struct Touch : btCollisionWorld::ContactResultCallback {
        bool found = false;
        bool needsCollision(btBroadphaseProxy* proxy) const override {
            const auto* other = static_cast<const btCollisionObject*>(proxy->m_clientObject);
            return other->isStaticObject() && other->hasContactResponse();
        }
        btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                                 const btCollisionObjectWrapper*, int, int) override {
            found = found || point.getDistance() <= m_closestDistanceThreshold;
            return 0;
        }
    };
    btCollisionObject probe;
    probe.setCollisionShape(&shape);
    probe.setWorldTransform(place);
    Touch touch;
    touch.m_closestDistanceThreshold = tolerance;
    world.contactTest(&probe, touch);
    return touch.found;
}

/// What comes off collides as the body did: as what Bullet makes of it where the game left that to
/// Bullet.
BodyFilter filterOf(const btRigidBody& body, const AdoptOptions& options) {
    if (options.collisionGroup != 0 || options.collisionMask != 0)
        return {options.collisionGroup, options.collisionMask};
    const btBroadphaseProxy& proxy = *body.getBroadphaseProxy();
    const bool isFixed = body.isStaticOrKinematicObject();
    const int group = isFixed ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
    const int mask = isFixed ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter
                             : btBroadphaseProxy::AllFilter;
    if (proxy.m_collisionFilterGroup == group && proxy.m_collisionFilterMask == mask) return {};
    return {proxy.m_collisionFilterGroup, proxy.m_collisionFilterMask};
}

}  // namespace

void DestructionWorld::Impl::anchorToStatic(uint32_t object) {
    const IslandWorld::Object& found = islands.object(object);
    const BondGraph& graph = found.asset->graph();
    const FragmentShapes& shapes = bodies.shapesOf(*found.asset);
    const float tolerance = kStaticTouch * found.asset->diagonal();
    std::vector<uint32_t> leaves;
    for (const uint32_t i : found.islands) {
        const btTransform frame = toBullet(islands.placesOf(i).now);
        for (const uint32_t fragment : islands.island(i).fragments) {
            const Range run = graph.leavesOf(fragment);
            for (uint32_t leaf = run.first; leaf < run.first + run.count; ++leaf) {
                const uint32_t f = graph.fragmentOfLeaf(leaf);
                if (touchesStatic(world, *shapes.shape(f), frame * shapes.bodyFrame(f), tolerance))
                    leaves.push_back(leaf);
            }
        }
    }
    islands.pin(object, leaves, true);
}

Result<ObjectId> DestructionWorld::spawn(const std::shared_ptr<const Asset>& asset,
                                         const RigidPose& pose, const SpawnOptions& options) {
    const MemoryScope scope(impl_->memory);
    if (auto ok = checkInstance(asset, pose, options.scale, options.damage); !ok)
        return tl::unexpected<Error>(ok.error());
    if (!isFinite(options.linearVelocity) || !isFinite(options.angularVelocity))
        return fail(ErrorCode::badArgument, "the velocities must be finite", "options");
    Impl& impl = *impl_;
    if (!SHERD_ASSERT(!impl.bodies.isTelling())) return fail(ErrorCode::badArgument, kTelling);
    if (const char* why = whyRefused(impl.settings.damage))
        return fail(ErrorCode::badArgument, why, "WorldOptions::damage");
    try {
        auto sized = impl.bodies.assets().take(asset, options.scale);
        if (!sized) return tl::unexpected<Error>(sized.error());
        // The object's number, and with it its filter, is known only once it is there.
        impl.bodies.setNextFilter(options.collisionGroup, options.collisionMask);
        BodyMotion motion;
        motion.linearVelocity = options.linearVelocity;
        motion.angularVelocity = options.angularVelocity;
        const ObjectId object = impl.islands.spawn(
            *sized, pose, combine(impl.settings.damage, options.damage), options.dynamic, motion);
        impl.releasesAsleep.resize(std::max<size_t>(impl.releasesAsleep.size(), object.index + 1));
        impl.releasesAsleep[object.index] = options.releaseAsleep ? 1 : 0;
        impl.holds(object.index) = options.anchorToStatic ? Impl::Hold::toStatic : Impl::Hold::none;
        if (options.anchorToStatic) impl.anchorToStatic(object.index);
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

Result<ObjectId> DestructionWorld::adopt(btRigidBody& body,
                                         const std::shared_ptr<const Asset>& asset,
                                         const AdoptOptions& options) {
    const MemoryScope scope(impl_->memory);
    if (auto ok = checkInstance(asset, options.objectToBody, options.scale, options.damage); !ok)
        return tl::unexpected<Error>(ok.error());
    Impl& impl = *impl_;
    if (!SHERD_ASSERT(!impl.bodies.isTelling())) return fail(ErrorCode::badArgument, kTelling);
    impl.bodies.noticeGone();
    if (!body.isInWorld() || impl.world.getCollisionObjectArray().findLinearSearch(&body) ==
                                 impl.world.getNumCollisionObjects())
        return fail(ErrorCode::badArgument, "the body must be in the Bullet world", "body");
    if (impl.bodies.islandOf(body) != UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is Sherd's, or adopted already", "body");
    try {
        auto sized = impl.bodies.assets().take(asset, options.scale);
        if (!sized) return tl::unexpected<Error>(sized.error());
        // As heavy as the game has it, or what comes off would carry another momentum.
        constexpr float kSameMass = 1e-5F;
        const float mass = (*sized)->fragment(0).mass;
        if (!body.isStaticOrKinematicObject() &&
            std::abs(body.getMass() - mass) > kSameMass * mass) {
            sized = impl.bodies.assets().take(*sized, 1, body.getMass() / mass);
            if (!sized) return tl::unexpected<Error>(sized.error());
        }
        const BodyFilter filter = filterOf(body, options);
        impl.bodies.setNextFilter(filter.group, filter.mask);
        impl.bodies.setNextAdopted(body, options.objectToBody);
        const RigidPose pose = toPose(body.getWorldTransform() * toBullet(options.objectToBody));
        const ObjectId object =
            impl.islands.spawn(*sized, pose, combine(impl.settings.damage, options.damage),
                               !body.isStaticOrKinematicObject(), {});
        impl.holds(object.index) = Impl::Hold::none;
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

}  // namespace sherd
