// SPDX-License-Identifier: MIT
#include "map/json_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/map_limits.h"
#include "map/map_text.h"

namespace sherd {

namespace {

using Json = nlohmann::json;

constexpr double kMostUv = 8;  ///< as far as planarise takes a map's lines

bool areNumbers(const Json& value, size_t count) {
    return value.is_array() && value.size() == count &&
           std::all_of(value.begin(), value.end(), [](const Json& n) { return n.is_number(); });
}

}  // namespace

bool JsonFields::stop(ErrorCode code, std::string message, const std::string& pointer) {
    error_ = {code, std::move(message), name_ + "#" + pointer};
    return false;
}

void JsonFields::warn(const std::string& pointer, const std::string& message) {
    std::string warning = name_ + "#" + pointer;
    warnings_.add(warning.append(": ").append(message));
}

void JsonFields::warnUnknown(const JsonPlace& object,
                             std::initializer_list<std::string_view> known) {
    constexpr size_t kMaxKey = 80;
    for (const auto& [key, value] : object.value.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            warn(object.pointer, "unknown member \"" + shortened(key, kMaxKey) + "\" passed over");
}

std::optional<JsonPlace> JsonFields::array(const JsonPlace& object, const char* key) {
    static const Json kEmpty = Json::array();
    if (!object.value.contains(key)) return JsonPlace{kEmpty, object.pointer + "/" + key};
    const JsonPlace found = object.member(key);
    if (found.value.is_array()) return found;
    wrong("an array was expected", found.pointer);
    return std::nullopt;
}

bool JsonFields::flag(const JsonPlace& object, const char* key, bool& out) {
    if (!object.value.contains(key)) return true;
    const auto [value, pointer] = object.member(key);
    if (!value.is_boolean()) return wrong("true or false was expected", pointer);
    out = value.get<bool>();
    return true;
}

bool JsonFields::text(const JsonPlace& object, const char* key, std::string& out) {
    if (!object.value.contains(key)) return true;
    const auto [value, pointer] = object.member(key);
    if (!value.is_string()) return wrong("a string was expected", pointer);
    out = value.get<std::string>();
    return true;
}

bool JsonFields::level(const JsonPlace& object, uint32_t lowest, uint32_t& out) {
    if (!object.value.contains("level")) return true;
    const auto [value, pointer] = object.member("level");
    if (!value.is_number_integer() || value < lowest || value > kMaxMapLevel)
        return wrong("a level from " + std::to_string(lowest) + " to " +
                         std::to_string(kMaxMapLevel) + " was expected",
                     pointer);
    out = value.get<uint32_t>();
    return true;
}

bool JsonFields::quantity(const JsonPlace& object, const char* key, bool positive,
                          std::optional<float>& out) {
    if (!object.value.contains(key)) return true;
    const auto [value, pointer] = object.member(key);
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0) || !(number <= std::numeric_limits<float>::max()) ||
        (positive && static_cast<float>(number) == 0))
        return wrong(
            positive ? "a number above 0 was expected" : "a number of at least 0 was expected",
            pointer);
    out = static_cast<float>(number);
    return true;
}

bool JsonFields::numbers(const JsonPlace& object, const char* key, std::vector<double>& out) {
    const std::optional<JsonPlace> values = array(object, key);
    if (!values) return false;
    for (size_t i = 0; i < values->value.size(); ++i) {
        const Json& value = values->value[i];
        if (!value.is_number()) return wrong("a number was expected", values->item(i).pointer);
        out.push_back(value.get<double>());
    }
    return true;
}

bool JsonFields::point(const JsonPlace& points, size_t i, glm::dvec2& out) {
    const Json& value = points.value[i];
    if (areNumbers(value, 2)) {
        out = {value[0].get<double>(), value[1].get<double>()};
        return true;
    }
    const bool solid = areNumbers(value, 3);
    return wrong(solid
                     ? "a point [u, v] was expected; only a line with \"surface\": true has points "
                       "[x, y, z]"
                     : "a point [u, v] was expected",
                 points.item(i).pointer);
}

bool JsonFields::place(const Json& value, SurfacePlace& out, const std::string& pointer) {
    out.in3d = areNumbers(value, 3);
    if (!out.in3d && !areNumbers(value, 2))
        return wrong("a place [u, v] or [x, y, z] was expected", pointer);
    out.point = {value[0].get<double>(), value[1].get<double>(),
                 out.in3d ? value[2].get<double>() : 0.0};
    if (!out.in3d && std::max(std::abs(out.point.x), std::abs(out.point.y)) > kMostUv)
        return wrong("a place in UV lies from -8 to 8", pointer);
    return true;
}

}  // namespace sherd
