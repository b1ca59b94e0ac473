// SPDX-License-Identifier: MIT
// JSON text that is edited in place.
//
// The baker adds to documents it does not understand. Parsing and printing them again would rewrite
// numbers (1e5 becomes 100000.0, -0 becomes 0, integers beyond 64 bits become floats) and drop
// duplicate keys; so additions are spliced into the text, and every byte not edited stays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// Nesting beyond this is refused before any parser sees the text.
constexpr int kMaxJsonDepth = 128;

/// Whether brackets nest no deeper than kMaxJsonDepth. Needs no valid JSON.
bool jsonDepthIsSafe(std::string_view text);

struct JsonMember;

/// Where a value stands in the text.
struct JsonNode {
    enum class Kind { object, array, string, other };
    Kind kind = Kind::other;
    size_t begin = 0;
    size_t end = 0;
    std::vector<JsonMember> members;  ///< of an object; of an array, with empty keys

    bool isObject() const { return kind == Kind::object; }
    bool isArray() const { return kind == Kind::array; }
    size_t size() const;
};

struct JsonMember {
    std::string key;
    size_t begin = 0;  ///< of the key, or of the value in an array
    JsonNode value;
};

class JsonText {
  public:
    /// `name` is used in errors. The root must be an object.
    static Result<JsonText> parse(std::string text, const std::string& name);

    const JsonNode& root() const { return root_; }

    /// The member `key` of an object (the last one, if there are several), or null.
    static const JsonNode* find(const JsonNode* node, std::string_view key);
    /// Element `index` of an array, or null.
    static const JsonNode* at(const JsonNode* node, size_t index);

    std::string_view raw(const JsonNode& node) const;
    std::optional<std::string> string(const JsonNode* node) const;
    std::optional<uint64_t> number(const JsonNode* node) const;  ///< a whole number below 2^53

    // Edits collect; `edited` applies them all. They must not overlap.
    void replace(const JsonNode& node, std::string text);
    void append(const JsonNode& array, const std::vector<std::string>& elements);
    void setMember(const JsonNode& object, std::string_view key, const std::string& text);
    void eraseMember(const JsonNode& object, std::string_view key);
    void eraseElement(const JsonNode& array, size_t index);
    void truncate(const JsonNode& array, size_t count);  ///< keeps the first `count`, at least one
    /// Replaces key and value of a member by `members` ("\"key\":value,...").
    void replaceMember(const JsonNode& object, std::string_view key, std::string members);
    std::string edited() const;

  private:
    struct Edit {
        size_t begin = 0;
        size_t end = 0;
        std::string text;
    };
    void eraseAt(const JsonNode& parent, size_t index);
    std::string text_;
    JsonNode root_;
    std::vector<Edit> edits_;
};

/// "[a,b,...]" of elements that are JSON already.
std::string jsonArray(const std::vector<std::string>& elements);

/// `text` as a JSON string with its quotes; bytes that are no UTF-8 become U+FFFD.
std::string jsonQuoted(std::string_view text);

}  // namespace sherd
