// SPDX-License-Identifier: MIT
// C structs to C++ values and back.
#pragma once

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

#include "c_abi/handle_table.h"
#include "sherd/runtime/island_world.h"
#include "sherd/runtime/sherd.h"

namespace sherd::c_abi {

inline glm::vec3 vec(const float* v) {
    return {v[0], v[1], v[2]};
}
inline void put(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}
inline RigidPose pose(const sherd_pose& p) {
    const float* q = p.rotation;
    return {vec(p.translation), glm::quat(q[3], q[0], q[1], q[2])};
}
inline sherd_pose pose(const RigidPose& p) {
    const glm::quat& q = p.rotation;
    return {{p.translation.x, p.translation.y, p.translation.z}, {q.x, q.y, q.z, q.w}};
}

inline ObjectId toObject(sherd_object object) {
    return {uint32_t(object.id) - 1, uint32_t(object.id >> 32)};  // of 0 no object's index
}
inline sherd_object fromObject(ObjectId object) {
    return {uint64_t{object.generation} << 32 | (object.index + 1)};
}

inline sherd_status say(sherd_error* error, sherd_status status, const std::string& message,
                        const std::string& where) {
    if (!error) return status;
    const auto copy = [](auto& to, const std::string& from) {
        const size_t length = std::min(from.size(), sizeof(to) - 1);
        std::memcpy(to, from.data(), length);
        to[length] = 0;
    };
    copy(error->message, message);
    copy(error->where, where);
    return status;
}

/// Out of memory in the middle of a change has nothing sound to go back to; before one it has.
template <class Work>
sherd_status guarded(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return SHERD_NO_MEMORY;
    } catch (const std::length_error&) {
        return SHERD_NO_MEMORY;
    }
}

/// The library's; never destroyed, so that they may be used whenever a program ends.
HandleTable<const Asset>& assets();

}  // namespace sherd::c_abi
