// SPDX-License-Identifier: MIT
#include "recipe/recipe_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace sherd {
namespace {

using Json = nlohmann::json;

std::string text(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

}  // namespace

bool RecipeReader::object(const Json& json, const std::string& pointer,
                          const std::map<std::string, Field>& fields) {
    if (!json.is_object()) return wrong(pointer, "must be an object");
    for (const auto& [key, value] : json.items()) {
        const std::string here = below(pointer, key);
        const auto it = fields.find(key);
        if (it == fields.end()) {
            std::string known;
            for (const auto& [name, field] : fields) {
                known += known.empty() ? "" : ", ";
                known += name;
            }
            return wrong(here, "is not a known key here; known are " + known);
        }
        if (!it->second(value, here)) return false;
    }
    return true;
}

RecipeReader::Field RecipeReader::number(double& target, double low, double high) {
    return [this, &target, low, high](const Json& json, const std::string& pointer) {
        const bool ok = json.is_number() && json.get<double>() >= low && json.get<double>() <= high;
        if (!ok) return wrong(pointer, "must be a number from " + text(low) + " to " + text(high));
        target = json.get<double>();
        return true;
    };
}

RecipeReader::Field RecipeReader::number(std::optional<double>& target, double low, double high) {
    return [this, &target, low, high](const Json& json, const std::string& pointer) {
        return number(target.emplace(), low, high)(json, pointer);
    };
}

RecipeReader::Field RecipeReader::vector(glm::dvec3& target, double low, double high) {
    return [this, &target, low, high](const Json& json, const std::string& pointer) {
        bool ok = json.is_array() && json.size() == 3;
        for (size_t k = 0; ok && k < 3; ++k) {
            ok = json[k].is_number() && json[k].get<double>() >= low &&
                 json[k].get<double>() <= high;
            if (ok) target[static_cast<glm::length_t>(k)] = json[k].get<double>();
        }
        return ok || wrong(pointer, "must be three numbers [x, y, z] from " + text(low) + " to " +
                                        text(high));
    };
}

bool RecipeReader::isInteger(const Json& json, const std::string& pointer, int low, int high) {
    // 3.0 is a whole number, too: some exporters know no other.
    const double value = json.is_number() ? json.get<double>() : low - 0.5;
    if (value >= low && value <= high && value == std::floor(value)) return true;
    return wrong(pointer, "must be a whole number from " + std::to_string(low) + " to " +
                              std::to_string(high));
}

RecipeReader::Field RecipeReader::boolean(bool& target) {
    return [this, &target](const Json& json, const std::string& pointer) {
        if (!json.is_boolean()) return wrong(pointer, "must be true or false");
        target = json.get<bool>();
        return true;
    };
}

RecipeReader::Field RecipeReader::boolean(std::optional<bool>& target) {
    return [this, &target](const Json& json, const std::string& pointer) {
        target.emplace();
        return boolean(*target)(json, pointer);
    };
}

RecipeReader::Field RecipeReader::string(std::string& target) {
    return [this, &target](const Json& json, const std::string& pointer) {
        if (!json.is_string()) return wrong(pointer, "must be a string");
        target = json.get<std::string>();
        return true;
    };
}

RecipeReader::Field RecipeReader::word(std::string& target, std::vector<std::string> words) {
    return [this, &target, words = std::move(words)](const Json& json, const std::string& pointer) {
        const auto found = std::find(words.begin(), words.end(), json);
        if (found != words.end()) {
            target = *found;
            return true;
        }
        std::string list;
        for (size_t i = 0; i < words.size(); ++i) {
            if (i > 0) list += i + 1 == words.size() ? " or " : ", ";
            list += "\"" + words[i] + "\"";
        }
        return wrong(pointer, "must be " + list);
    };
}

RecipeReader::Field RecipeReader::choice(bool& target, const std::string& no,
                                         const std::string& yes) {
    return [this, &target, no, yes](const Json& json, const std::string& pointer) {
        if (json != no && json != yes)
            return wrong(pointer, "must be \"" + no + "\" or \"" + yes + "\"");
        target = json == yes;
        return true;
    };
}

std::string RecipeReader::below(const std::string& pointer, const std::string& key) {
    std::string out = pointer + "/";
    for (const char c : key) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

bool RecipeReader::wrong(const std::string& pointer, const std::string& what) {
    error_ = {ErrorCode::invalidData,
              (pointer.empty() ? std::string("the recipe ")
                               : "\"" + pointer.substr(pointer.rfind('/') + 1) + "\" ") +
                  what,
              place(pointer)};
    return false;
}

}  // namespace sherd
