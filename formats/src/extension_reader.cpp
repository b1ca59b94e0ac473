// SPDX-License-Identifier: MIT
#include "extension_reader.h"

#include <bit>
#include <cstring>

#include "extension_name.h"

namespace sherd {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

namespace {

using nlohmann::json;

/// Of four bytes each.
template <class Word>
std::vector<Word> wordsOf(std::span<const uint8_t> bytes) {
    std::vector<Word> out(bytes.size() / sizeof(Word));
    if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
    return out;
}

}  // namespace

void ExtensionReader::fail(ErrorCode code, std::string message, std::string where) {
    if (!error_) error_ = Error{code, std::move(message), std::move(where)};
}

const json& ExtensionReader::member(const json& object, const char* key, const std::string& where) {
    static const json kNull;
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (object.is_object() && found != object.end()) return *found;
    fail(ErrorCode::invalidData, "this is missing", where + "/" + key);
    return kNull;
}

const json* ExtensionReader::optional(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

uint64_t ExtensionReader::whole(const json& value, const std::string& where, uint64_t max) {
    if (value.is_number_unsigned() && value.get<uint64_t>() <= max) return value.get<uint64_t>();
    // Other tools may print whole numbers as 12.0.
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number >= 0 && number <= static_cast<double>(max) && std::floor(number) == number)
            return static_cast<uint64_t>(number);
    }
    fail(ErrorCode::invalidData, "this must be a whole number up to " + std::to_string(max), where);
    return 0;
}

uint64_t ExtensionReader::whole(const json& object, const char* key, const std::string& where,
                                uint64_t max) {
    const json& value = member(object, key, where);
    return ok() ? whole(value, where + "/" + key, max) : 0;
}

uint64_t ExtensionReader::wholeOr(const json& object, const char* key, const std::string& where,
                                  uint64_t otherwise) {
    const json* value = optional(object, key);
    return value == nullptr ? otherwise : whole(*value, where + "/" + key);
}

const json& ExtensionReader::array(const json& object, const char* key, const std::string& where) {
    const json& value = member(object, key, where);
    if (ok() && (!value.is_array() || value.empty()))
        fail(ErrorCode::invalidData, "this must be an array with elements", where + "/" + key);
    return value;
}

std::string ExtensionReader::text(const json& object, const char* key, const std::string& where) {
    const json* value = optional(object, key);
    if (value == nullptr) return {};
    if (!value->is_string())
        fail(ErrorCode::invalidData, "this must be a string", where + "/" + key);
    return value->is_string() ? value->get<std::string>() : std::string();
}

bool ExtensionReader::flag(const json& object, const char* key, const std::string& where) {
    const json* value = optional(object, key);
    if (value == nullptr) return false;
    if (!value->is_boolean())
        fail(ErrorCode::invalidData, "this must be true or false", where + "/" + key);
    return value->is_boolean() && value->get<bool>();
}

std::span<const uint8_t> ExtensionReader::table(const json& object, const char* key,
                                                const std::string& where, uint32_t componentType,
                                                uint32_t components, uint64_t count) {
    const uint64_t index = whole(object, key, where);
    if (!ok()) return {};
    const std::string at = where + "/" + key;
    return accessor(index, at, componentType, components, count);
}

std::vector<float> ExtensionReader::floats(const json& object, const char* key,
                                           const std::string& where, uint64_t count,
                                           uint32_t components) {
    auto out = wordsOf<float>(table(object, key, where, kFloat, components, count));
    bool finite = true;
    for (const float value : out) finite = finite && std::abs(value) <= 3.4028234e38F;
    if (!finite)
        fail(ErrorCode::invalidData, "there are numbers that are not finite", where + "/" + key);
    return finite ? out : std::vector<float>();
}

std::vector<uint32_t> ExtensionReader::integers(const json& object, const char* key,
                                                const std::string& where, uint64_t count,
                                                uint32_t components) {
    return wordsOf<uint32_t>(table(object, key, where, kUnsignedInt, components, count));
}

std::span<const uint8_t> ExtensionReader::stream(const json& object, const char* key,
                                                 const std::string& where) {
    const uint64_t index = whole(object, key, where);
    if (!ok()) return {};
    const auto view = bufferView(index, where + "/" + key);
    if (ok() && view.size() > budget_)
        fail(ErrorCode::limitExceeded, "too many fractures share the same stream", where);
    if (!ok()) return {};
    budget_ -= view.size();
    return view;
}

uint32_t ExtensionReader::componentsOf(const json& index, const std::string& where) {
    const json& entry = element("accessors", whole(index, where), where);
    const json* type = optional(entry, "type");
    for (uint32_t components = 1; type != nullptr && components <= 4; ++components)
        if (*type == typeName(components)) return components;
    fail(ErrorCode::invalidData, "this must name an accessor of 1 to 4 components", where);
    return 1;
}

uint64_t ExtensionReader::countOf(const json& object, const char* key, const std::string& where) {
    const uint64_t index = whole(object, key, where);
    const json& entry = element("accessors", index, where + "/" + key);
    return ok() ? whole(entry, "count", "/accessors/" + std::to_string(index)) : 0;
}

const char* ExtensionReader::typeName(uint32_t components) {
    constexpr std::array<const char*, 5> kNames = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return kNames[components];
}

const json& ExtensionReader::element(const char* list, uint64_t index, const std::string& where) {
    static const json kNull;
    const json* all = optional(document_, list);
    if (all != nullptr && all->is_array() && index < all->size()) return (*all)[index];
    fail(ErrorCode::invalidData, "there is no /" + std::string(list) + "/" + std::to_string(index),
         where);
    return kNull;
}

std::span<const uint8_t> ExtensionReader::accessor(uint64_t index, const std::string& where,
                                                   uint32_t componentType, uint32_t components,
                                                   uint64_t count) {
    const json& entry = element("accessors", index, where);
    if (!ok()) return {};
    const std::string at = "/accessors/" + std::to_string(index);
    const json* type = optional(entry, "type");
    if (whole(entry, "componentType", at) != componentType || type == nullptr ||
        *type != typeName(components) || optional(entry, "sparse") != nullptr)
        fail(ErrorCode::invalidData,
             "the accessor for " + where + " must be a plain " + typeName(components) +
                 (componentType == kFloat ? " of FLOAT" : " of UNSIGNED_INT"),
             at);
    const uint64_t have = whole(entry, "count", at);
    if (ok() && have != count)
        fail(ErrorCode::invalidData,
             "the accessor for " + where + " has " + std::to_string(have) + " elements, " +
                 std::to_string(count) + " are needed",
             at + "/count");
    const uint64_t viewIndex = whole(entry, "bufferView", at);
    const uint64_t offset = wholeOr(entry, "byteOffset", at, 0);
    if (!ok()) return {};
    const auto view = bufferView(viewIndex, at + "/bufferView");
    const uint64_t size = count * components * 4;  // below 2^36
    if (ok() && (offset > view.size() || size > view.size() - offset))
        fail(ErrorCode::invalidData, "the accessor reaches beyond its bufferView", at);
    if (ok() && size > budget_)
        // Tables shared by thousands of fractures would unfold into any amount of memory.
        fail(ErrorCode::limitExceeded, "too many fractures share the same tables", where);
    if (!ok()) return {};
    budget_ -= size;
    return view.subspan(offset, size);
}

std::span<const uint8_t> ExtensionReader::bufferView(uint64_t index, const std::string& where) {
    const json& view = element("bufferViews", index, where);
    if (!ok()) return {};
    const std::string at = "/bufferViews/" + std::to_string(index);
    const uint64_t buffer = whole(view, "buffer", at);
    const uint64_t offset = wholeOr(view, "byteOffset", at, 0);
    const uint64_t length = whole(view, "byteLength", at);
    if (ok() && (buffer != 0 || optional(view, "byteStride") != nullptr))
        fail(ErrorCode::invalidData, "fracture data lies tightly packed in buffer 0", at);
    if (ok() && (offset > bin_.size() || length > bin_.size() - offset))
        fail(ErrorCode::invalidData, "the bufferView reaches beyond the binary chunk", at);
    return ok() ? bin_.subspan(offset, length) : std::span<const uint8_t>();
}

glm::vec3 vector3(const std::vector<float>& values, size_t i) {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

glm::quat quaternion(const float* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

std::vector<glm::vec3> vectors(const std::vector<float>& values) {
    std::vector<glm::vec3> out(values.size() / 3);
    for (size_t i = 0; i < out.size(); ++i) out[i] = vector3(values, i);
    return out;
}

std::vector<Range> ranges(const std::vector<uint32_t>& values) {
    std::vector<Range> out(values.size() / 2);
    for (size_t i = 0; i < out.size(); ++i) out[i] = {values[2 * i], values[2 * i + 1]};
    return out;
}

}  // namespace sherd
