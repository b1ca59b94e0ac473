// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <optional>
#include <vector>

#include "core/byte_stream.h"
#include "sherd/formats/result.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

/// A body's own state, to the bit, beside what its island knows.
struct BodySnapshot {
    btTransform transform;
    btVector3 linear{0, 0, 0}, angular{0, 0, 0};
    int activation = 0;
    float quietFor = 0;  ///< s, towards sleep
};

struct ObjectSnapshot {
    std::optional<Structure> structure;
    std::vector<IslandWorld::SavedIsland> islands;
    std::vector<BodySnapshot> bodies;  ///< of the islands, in their order
};

void writeIsland(const IslandWorld::Island& island, const btRigidBody& body, ByteWriter& to);

/// What `writeStructure` and a count of `writeIsland` have written, of an object of this asset; or
/// what is wrong with it.
Result<ObjectSnapshot> readSnapshot(const std::shared_ptr<const Asset>& asset, ByteReader& from);

/// Gives a body that was made of the island the rest of its state.
void restoreBody(const BodySnapshot& snapshot, btRigidBody& body);

}  // namespace sherd
