// SPDX-License-Identifier: MIT
// Looking into a glTF document whose members may be missing or of the wrong type. For `.cpp` files:
// JSON stays out of other headers.
#pragma once

#include <nlohmann/json.hpp>

namespace sherd {

/// `object[key]`, null if it is not there.
inline const nlohmann::json& at(const nlohmann::json& object, const char* key) {
    static const nlohmann::json kNull;
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : kNull;
}

/// `array[index]`, null if it is not there.
inline const nlohmann::json& at(const nlohmann::json& array, const nlohmann::json& index) {
    static const nlohmann::json kNull;
    if (!array.is_array() || !index.is_number_unsigned() || index >= array.size()) return kNull;
    return array[index.get<size_t>()];
}

}  // namespace sherd
