// SPDX-License-Identifier: MIT
#include "recipe/recipe_reader.h"

#include <sstream>

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
        const std::string here = std::string(pointer).append("/").append(key);
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

bool RecipeReader::isInteger(const Json& json, const std::string& pointer, int low, int high) {
    if (json.is_number_integer() && json.get<double>() >= low && json.get<double>() <= high)
        return true;
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

RecipeReader::Field RecipeReader::choice(bool& target, const std::string& no,
                                         const std::string& yes) {
    return [this, &target, no, yes](const Json& json, const std::string& pointer) {
        if (json != no && json != yes)
            return wrong(pointer, "must be \"" + no + "\" or \"" + yes + "\"");
        target = json == yes;
        return true;
    };
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
