// SPDX-License-Identifier: MIT
#include "json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace sherd {

namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Finds the spans of all values. The text has been validated: no syntax is checked again.
class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    JsonNode value() {
        skipSpace();
        JsonNode node;
        node.begin = at_;
        const char c = text_[at_];
        if (c == '{') {
            node.kind = JsonNode::Kind::object;
            children(node, '}');
        } else if (c == '[') {
            node.kind = JsonNode::Kind::array;
            children(node, ']');
        } else if (c == '"') {
            node.kind = JsonNode::Kind::string;
            skipString();
        } else {
            while (at_ < text_.size() && !isSpace(text_[at_]) && text_[at_] != ',' &&
                   text_[at_] != '}' && text_[at_] != ']')
                ++at_;
        }
        node.end = at_;
        return node;
    }

  private:
    void skipSpace() {
        while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
    }

    void skipString() {
        ++at_;
        while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
        ++at_;
    }

    std::string key() {
        const size_t begin = at_;
        skipString();
        const std::string_view quoted = text_.substr(begin, at_ - begin);
        if (quoted.find('\\') == std::string_view::npos)
            return std::string(quoted.substr(1, quoted.size() - 2));
        return nlohmann::json::parse(quoted).get<std::string>();
    }

    void children(JsonNode& node, char close) {
        ++at_;
        for (skipSpace(); text_[at_] != close; skipSpace()) {
            if (text_[at_] == ',') {
                ++at_;
                continue;
            }
            JsonMember member;
            member.begin = at_;
            if (close == '}') {
                member.key = key();
                skipSpace();
                ++at_;  // the colon
            }
            member.value = value();
            node.members.push_back(std::move(member));
        }
        ++at_;
    }

    std::string_view text_;
    size_t at_ = 0;
};

size_t indexOf(const JsonNode& node, std::string_view key) {
    for (size_t i = node.members.size(); i-- > 0;)
        if (node.members[i].key == key) return i;
    return node.members.size();
}

}  // namespace

bool jsonDepthIsSafe(std::string_view text) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            if (c == '\\') ++i;
            if (c == '"') inString = false;
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth) return false;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return true;
}

size_t JsonNode::size() const {
    return members.size();
}

Result<JsonText> JsonText::parse(std::string text, const std::string& name) {
    if (!jsonDepthIsSafe(text))
        return fail(ErrorCode::limitExceeded,
                    "the JSON nests deeper than " + std::to_string(kMaxJsonDepth) + " levels",
                    name);
    if (!nlohmann::json::accept(text))
        return fail(ErrorCode::malformed, "the JSON is not valid; was the file cut short?", name);
    JsonText result;
    result.text_ = std::move(text);
    result.root_ = Scanner(result.text_).value();
    if (!result.root_.isObject())
        return fail(ErrorCode::malformed, "the JSON is not an object, so this is no glTF", name);
    return result;
}

const JsonNode* JsonText::find(const JsonNode* node, std::string_view key) {
    if (node == nullptr || !node->isObject()) return nullptr;
    const size_t index = indexOf(*node, key);
    return index < node->members.size() ? &node->members[index].value : nullptr;
}

const JsonNode* JsonText::at(const JsonNode* node, size_t index) {
    if (node == nullptr || !node->isArray() || index >= node->members.size()) return nullptr;
    return &node->members[index].value;
}

std::string_view JsonText::raw(const JsonNode& node) const {
    return std::string_view(text_).substr(node.begin, node.end - node.begin);
}

std::optional<std::string> JsonText::string(const JsonNode* node) const {
    if (node == nullptr || node->kind != JsonNode::Kind::string) return std::nullopt;
    return nlohmann::json::parse(raw(*node)).get<std::string>();
}

std::optional<uint64_t> JsonText::number(const JsonNode* node) const {
    if (node == nullptr || node->kind != JsonNode::Kind::other) return std::nullopt;
    const auto value = nlohmann::json::parse(raw(*node));
    if (!value.is_number()) return std::nullopt;
    // Some exporters write whole numbers as 12.0.
    const double number = value.get<double>();
    if (!(number >= 0) || number >= 9007199254740992.0 || std::floor(number) != number)
        return std::nullopt;
    return static_cast<uint64_t>(number);
}

void JsonText::replace(const JsonNode& node, std::string text) {
    edits_.push_back({node.begin, node.end, std::move(text)});
}

void JsonText::append(const JsonNode& array, const std::vector<std::string>& elements) {
    std::string text;
    bool first = array.members.empty();
    for (const std::string& element : elements) {
        if (!first) text += ',';
        text += element;
        first = false;
    }
    const size_t place = array.members.empty() ? array.begin + 1 : array.members.back().value.end;
    edits_.push_back({place, place, std::move(text)});
}

void JsonText::setMember(const JsonNode& object, std::string_view key, const std::string& text) {
    if (const JsonNode* old = find(&object, key)) return replace(*old, text);
    const bool first = object.members.empty();
    const size_t place = first ? object.begin + 1 : object.members.back().value.end;
    // Several new members of an empty object would need to know of each other.
    for (const Edit& edit : edits_)
        if (first && edit.begin == place)
            return edits_.push_back({place, place, ',' + jsonQuoted(key) + ':' + text});
    edits_.push_back({place, place, (first ? "" : ",") + jsonQuoted(key) + ':' + text});
}

void JsonText::replaceMember(const JsonNode& object, std::string_view key, std::string members) {
    const size_t index = indexOf(object, key);
    if (index < object.members.size())
        edits_.push_back(
            {object.members[index].begin, object.members[index].value.end, std::move(members)});
}

void JsonText::eraseAt(const JsonNode& parent, size_t index) {
    const std::vector<JsonMember>& all = parent.members;
    if (index >= all.size()) return;
    size_t begin = all[index].begin;
    size_t end = all[index].value.end;
    if (index > 0)
        begin = all[index - 1].value.end;
    else if (all.size() > 1)
        end = all[1].begin;
    edits_.push_back({begin, end, {}});
}

void JsonText::eraseMember(const JsonNode& object, std::string_view key) {
    eraseAt(object, indexOf(object, key));
}

void JsonText::eraseElement(const JsonNode& array, size_t index) {
    eraseAt(array, index);
}

void JsonText::truncate(const JsonNode& array, size_t count) {
    if (count == 0 || count >= array.members.size()) return;
    edits_.push_back({array.members[count - 1].value.end, array.members.back().value.end, {}});
}

std::string JsonText::edited() const {
    std::vector<const Edit*> order;
    order.reserve(edits_.size());
    for (const Edit& edit : edits_) order.push_back(&edit);
    std::stable_sort(order.begin(), order.end(),
                     [](const Edit* a, const Edit* b) { return a->begin < b->begin; });
    std::string result;
    size_t copied = 0;
    for (const Edit* edit : order) {
        result.append(text_, copied, edit->begin - copied);
        result += edit->text;
        copied = edit->end;
    }
    return result.append(text_, copied);
}

std::string jsonArray(const std::vector<std::string>& elements) {
    std::string text(1, '[');
    for (const std::string& element : elements) {
        if (text.size() > 1) text.push_back(',');
        text.append(element);
    }
    text.push_back(']');
    return text;
}

std::string jsonQuoted(std::string_view text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace sherd
