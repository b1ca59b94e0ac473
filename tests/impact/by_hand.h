// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "bullet/convert.h"
#include "bullet/fragment_shapes.h"

namespace sherd::test {

/// A body of a fragment, as a game would make it without Sherd, where the object frame is the
/// world's.
inline std::unique_ptr<btRigidBody> bodyByHand(const FragmentShapes& shapes, uint32_t fragment) {
    const Fragment& piece = shapes.asset()->fragment(fragment);
    btRigidBody::btRigidBodyConstructionInfo info(piece.mass, nullptr, shapes.shape(fragment),
                                                  toBullet(piece.inertiaDiagonal));
    info.m_startWorldTransform = shapes.bodyFrame(fragment);
    return std::make_unique<btRigidBody>(info);
}

}  // namespace sherd::test
