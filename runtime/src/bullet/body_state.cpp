// SPDX-License-Identifier: MIT
#include "bullet/body_state.h"

#include <cmath>

namespace sherd {
namespace {

constexpr size_t kBodyBytes = 41;

bool isSound(const BodyState& state) {
    const btMatrix3x3 turn = state.basis * state.basis.transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(turn[i][j] - (i == j ? 1 : 0)) < 1e-3F)) return false;
    // A mirror's rows are of unit length, too.
    return state.basis.determinant() > 0 && state.activation >= ACTIVE_TAG &&
           state.activation <= DISABLE_SIMULATION && state.quietFor >= 0;
}

}  // namespace

void writeBodyState(const btRigidBody& body, ByteWriter& to) {
    const btMatrix3x3& basis = body.getWorldTransform().getBasis();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) to.f32(basis[row][column]);
    to.u8(uint8_t(body.getActivationState()));
    to.f32(body.getDeactivationTime());
}

std::optional<std::vector<BodyState>> readBodyStates(std::span<const uint8_t> bytes, size_t count) {
    if (bytes.size() != kBodyBytes * count) return std::nullopt;
    ByteReader from(bytes);
    std::vector<BodyState> states(count);
    for (BodyState& state : states) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) state.basis[row][column] = from.f32();
        state.activation = from.u8();
        state.quietFor = from.f32();
        if (!isSound(state)) return std::nullopt;
    }
    return states;
}

void restoreBodyState(const BodyState& state, btRigidBody& body) {
    const btTransform place(state.basis, body.getWorldTransform().getOrigin());
    body.setWorldTransform(place);
    body.setInterpolationWorldTransform(place);
    body.setInterpolationLinearVelocity(body.getLinearVelocity());
    body.setInterpolationAngularVelocity(body.getAngularVelocity());
    body.updateInertiaTensor();
    body.forceActivationState(state.activation);
    body.setDeactivationTime(state.quietFor);
}

}  // namespace sherd
