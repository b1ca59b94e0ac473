// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btTransform.h>

#include <optional>
#include <vector>

#include "core/byte_stream.h"
#include "sherd/formats/result.h"
#include "sherd/runtime/structure.h"

namespace sherd {

struct IslandBody;

/// One body as it was, to the bit.
struct BodySnapshot {
    std::vector<uint32_t> fragments;  ///< ascending
    bool isFixed = false;
    bool isAnchored = false;
    double bornAt = 0;
    RigidPose pose, previous;
    btTransform transform;
    btVector3 linear{0, 0, 0}, angular{0, 0, 0};
    int activation = 0;
    float quietFor = 0;  ///< s, towards sleep
};

struct ObjectSnapshot {
    std::optional<Structure> structure;
    std::vector<BodySnapshot> bodies;
};

void writeBody(const IslandBody& island, ByteWriter& to);

/// What `writeStructure` and a count of `writeBody` have written, of an object of this asset; or
/// what is wrong with it.
Result<ObjectSnapshot> readSnapshot(const std::shared_ptr<const Asset>& asset, ByteReader& from);

}  // namespace sherd
