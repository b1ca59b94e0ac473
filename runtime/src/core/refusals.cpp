// SPDX-License-Identifier: MIT
// What no adapter lets through, said once for all of them.
#include <cmath>

#include "core/finite.h"
#include "sherd/runtime/damage.h"
#include "sherd/runtime/island_world.h"

namespace sherd {
namespace {

/// Neither negative nor infinite nor no number.
bool isAmount(float x) {
    return x >= 0 && std::isfinite(x);
}

}  // namespace

const char* whyRefused(const DamageOptions& options) {
    if (!(options.toughnessScale > 0 && options.strengthScale > 0 && options.levelScale > 0))
        return "the scales must be positive";
    if (!(options.minimumImpulse >= 0 && options.minimumEnergy >= 0 && options.immunity >= 0))
        return "the minimum values and times must not be negative";
    return nullptr;
}

const char* whyRefused(const Contact& contact) {
    if (!isAmount(contact.impulse)) return "the impulse must be finite and not negative";
    if (!std::isfinite(contact.approachSpeed)) return "the approach speed must be finite";
    if (!isAmount(contact.effectiveMass))
        return "the effective mass must be finite and not negative";
    return nullptr;
}

const char* whyRefused(const ReportedHit& hit) {
    if (!isFinite(hit.point) || !isFinite(hit.normal)) return "place and direction must be finite";
    if (!isAmount(hit.energy) || !isAmount(hit.speed) || !isAmount(hit.impulse))
        return "energy, speed and impulse must be finite and not negative";
    return nullptr;
}

const char* whyRefused(const RigidPose& pose) {
    return isSound(pose) ? nullptr : "the pose must have a finite place and a unit quaternion";
}

const char* whyRefused(const BodyMotion& motion) {
    if (const char* why = whyRefused(motion.pose)) return why;
    return isFinite(motion.linearVelocity) && isFinite(motion.angularVelocity)
               ? nullptr
               : "the velocities must be finite";
}

}  // namespace sherd
