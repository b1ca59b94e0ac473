// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sherd/formats/result.h"
#include "sherd/runtime/island_world.h"

namespace sherd {

/// What `saveObject` wrote, checked.
struct SavedObject {
    double savedAt = 0;  ///< s, by the clock of the world it was saved from
    Structure structure;
    Vector<IslandWorld::SavedIsland> islands;
    uint32_t engine = 0;                   ///< whose bytes; 0: there are none
    std::span<const uint8_t> engineBytes;  ///< among those that were read
};

/// An object's damage and its islands with their motion, to the bit, in few bytes when little is
/// broken. An adapter may add what its engine knows of bodies beyond BodyMotion: `engine`, not 0,
/// names it, and others leave those bytes out.
std::vector<uint8_t> saveObject(const IslandWorld& world, uint32_t object, uint32_t engine = 0,
                                std::span<const uint8_t> engineBytes = {});

/// Of an object of this asset. Trusts no byte: `invalidData` with the reason for those of another
/// bake or version, and for what does not make up the object.
Result<SavedObject> readSavedObject(const std::shared_ptr<const Asset>& asset,
                                    std::span<const uint8_t> bytes);

/// Gives an object, of the same asset, the saved state; its old bodies are removed and others made.
/// Fires no events.
void restoreObject(IslandWorld& world, uint32_t object, SavedObject&& saved);

}  // namespace sherd
