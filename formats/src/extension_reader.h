// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Reads values of the extension out of a glTF document. Remembers the first failure; later reads
/// return empty values, so callers check once per stage. `where`: a JSON pointer, for errors.
class ExtensionReader {
  public:
    using json = nlohmann::json;
    static constexpr uint64_t kMaxWhole = 0xFFFFFFFF;

    ExtensionReader(const json& document, std::span<const uint8_t> bin)
        : document_(document), bin_(bin), budget_(4 * bin.size() + 4096) {}

    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    [[nodiscard]] const Error& error() const { return *error_; }

    void fail(ErrorCode code, std::string message, std::string where);
    const json& member(const json& object, const char* key, const std::string& where);
    /// Null where there is none.
    static const json* optional(const json& object, const char* key);

    uint64_t whole(const json& value, const std::string& where, uint64_t max = kMaxWhole);
    uint64_t whole(const json& object, const char* key, const std::string& where,
                   uint64_t max = kMaxWhole);
    uint64_t wholeOr(const json& object, const char* key, const std::string& where,
                     uint64_t otherwise);
    /// With at least one element.
    const json& array(const json& object, const char* key, const std::string& where);
    /// Empty and false where there is none.
    std::string text(const json& object, const char* key, const std::string& where);
    bool flag(const json& object, const char* key, const std::string& where);

    template <size_t N>
    std::array<float, N> numbers(const json& object, const char* key, const std::string& where) {
        std::array<float, N> out{};
        const json& value = member(object, key, where);
        if (!ok()) return out;
        for (size_t i = 0; i < N; ++i) {
            const bool present = value.is_array() && value.size() == N && value[i].is_number();
            out[i] = present ? static_cast<float>(value[i].get<double>()) : NAN;
            if (!std::isfinite(out[i])) {
                fail(ErrorCode::invalidData, "this must be " + std::to_string(N) + " numbers",
                     where + "/" + key);
                return {};
            }
        }
        return out;
    }

    /// The bytes of the accessor `object[key]`: tightly packed, of the type asked for.
    /// `count`: as many elements as there must be.
    std::span<const uint8_t> table(const json& object, const char* key, const std::string& where,
                                   uint32_t componentType, uint32_t components, uint64_t count);

    template <size_t Components>
    std::vector<float> floats(const json& object, const char* key, const std::string& where,
                              uint64_t count) {
        return floats(object, key, where, count, Components);
    }

    std::vector<float> floats(const json& object, const char* key, const std::string& where,
                              uint64_t count, uint32_t components);

    std::vector<uint32_t> integers(const json& object, const char* key, const std::string& where,
                                   uint64_t count, uint32_t components);

    /// The bytes of the bufferView `object[key]`.
    std::span<const uint8_t> stream(const json& object, const char* key, const std::string& where);

    /// How many components the accessor has, 1 to 4.
    uint32_t componentsOf(const json& index, const std::string& where);

    /// How many elements the accessor `object[key]` says it has.
    uint64_t countOf(const json& object, const char* key, const std::string& where);

  private:
    static const char* typeName(uint32_t components);
    const json& element(const char* list, uint64_t index, const std::string& where);
    std::span<const uint8_t> accessor(uint64_t index, const std::string& where,
                                      uint32_t componentType, uint32_t components, uint64_t count);
    std::span<const uint8_t> bufferView(uint64_t index, const std::string& where);

    const json& document_;
    std::span<const uint8_t> bin_;
    uint64_t budget_;
    std::optional<Error> error_;
};

/// Of a list of numbers, three each.
glm::vec3 vector3(const std::vector<float>& values, size_t i);
std::vector<glm::vec3> vectors(const std::vector<float>& values);
/// Of a list of numbers, two each.
std::vector<Range> ranges(const std::vector<uint32_t>& values);
glm::quat quaternion(const float* xyzw);

}  // namespace sherd
