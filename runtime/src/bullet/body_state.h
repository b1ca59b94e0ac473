// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <optional>
#include <span>
#include <vector>

#include "core/byte_stream.h"

namespace sherd {

/// Whose bytes these are in a saved object: "BULT".
constexpr uint32_t kBulletState = 0x544C5542;

/// What Bullet knows of a body's state beyond BodyMotion: its rotation as a matrix, to the bit, and
/// how near it is to sleep.
struct BodyState {
    btMatrix3x3 basis;
    int activation = 0;
    float quietFor = 0;  ///< s, towards sleep
};

void writeBodyState(const btRigidBody& body, ByteWriter& to);

/// One for each of `count` bodies; nothing when the bytes are not that.
std::optional<std::vector<BodyState>> readBodyStates(std::span<const uint8_t> bytes, size_t count);

/// Gives a body, where it was put by its motion, the rest of its state.
void restoreBodyState(const BodyState& state, btRigidBody& body);

}  // namespace sherd
