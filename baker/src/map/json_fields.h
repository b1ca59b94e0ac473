// SPDX-License-Identifier: MIT
// Members of a JSON map, each checked, the first mistake kept with its pointer.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map/map_warnings.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// A value and where it stands in the document.
struct JsonPlace {
    const nlohmann::json& value;
    std::string pointer;

    JsonPlace member(const char* key) const { return {value.at(key), pointer + "/" + key}; }
    JsonPlace item(size_t i) const { return {value.at(i), pointer + "/" + std::to_string(i)}; }
};

/// Readers return false after a mistake; an absent member leaves its target alone and is none.
class JsonFields {
  public:
    explicit JsonFields(std::string name) : name_(std::move(name)) {}

    bool stop(ErrorCode code, std::string message, const std::string& pointer);
    bool wrong(std::string message, const std::string& pointer) {
        return stop(ErrorCode::invalidData, std::move(message), pointer);
    }
    void warn(const std::string& pointer, const std::string& message);
    void warnUnknown(const JsonPlace& object, std::initializer_list<std::string_view> known);

    /// The array member `key`, an empty one if absent; nothing after a mistake.
    std::optional<JsonPlace> array(const JsonPlace& object, const char* key);
    bool flag(const JsonPlace& object, const char* key, bool& out);
    bool text(const JsonPlace& object, const char* key, std::string& out);
    bool level(const JsonPlace& object, uint32_t lowest, uint32_t& out);
    /// At least 0, or above 0 if `positive`; what a float holds.
    bool quantity(const JsonPlace& object, const char* key, bool positive,
                  std::optional<float>& out);
    bool numbers(const JsonPlace& object, const char* key, std::vector<double>& out);
    /// An array's item as a point. (There may be millions: no pointer is written while all is
    /// well.)
    bool point(const JsonPlace& points, size_t i, glm::dvec2& out);
    /// [u, v] or [x, y, z].
    bool place(const nlohmann::json& value, SurfacePlace& out, const std::string& pointer);

    Error takeError() { return std::move(error_); }
    std::vector<std::string> takeWarnings() { return warnings_.take(); }

  private:
    std::string name_;
    Error error_;
    MapWarnings warnings_;
};

}  // namespace sherd
