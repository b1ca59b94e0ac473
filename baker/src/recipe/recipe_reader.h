// SPDX-License-Identifier: MIT
// The JSON of a recipe, read field by field. For `.cpp` files: JSON stays out of other headers.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// How far from the origin a recipe may name a place, along each axis; in metres.
inline constexpr double kFarthestPlace = 1e9;

/// Reads JSON objects field by field; every key must be known. The first mistake stops it and is
/// kept with its pointer; readers return false from then on.
class RecipeReader {
  public:
    /// `file` is where the recipe stands, for messages; `error` outlives this.
    RecipeReader(std::string file, Error& error) : file_(std::move(file)), error_(error) {}

    /// Reads one value, which stands at the pointer; false after a mistake.
    using Field = std::function<bool(const nlohmann::json&, const std::string& pointer)>;

    bool object(const nlohmann::json& json, const std::string& pointer,
                const std::map<std::string, Field>& fields);

    // Fields for plain values: each fills its target, which outlives it.
    Field number(double& target, double low, double high);
    Field number(std::optional<double>& target, double low, double high);
    /// [x, y, z]
    Field vector(glm::dvec3& target, double low, double high);
    template <class Integer>
    Field integer(Integer& target, int low, int high) {
        return [this, &target, low, high](const nlohmann::json& json, const std::string& pointer) {
            if (!isInteger(json, pointer, low, high)) return false;
            target = static_cast<Integer>(json.get<double>());
            return true;
        };
    }
    Field boolean(bool& target);
    Field boolean(std::optional<bool>& target);
    Field string(std::string& target);
    /// One of these words.
    Field word(std::string& target, std::vector<std::string> words);
    /// One of two words; the second one is true.
    Field choice(bool& target, const std::string& no, const std::string& yes);

    /// The pointer of a member, as RFC 6901 spells keys.
    static std::string below(const std::string& pointer, const std::string& key);
    /// "wall.json#/levels/0/cut"
    std::string place(const std::string& pointer) const { return file_ + "#" + pointer; }

    /// Keeps a mistake: `what` goes on behind the name of the field. Always false.
    bool wrong(const std::string& pointer, const std::string& what);

  private:
    bool isInteger(const nlohmann::json& json, const std::string& pointer, int low, int high);

    std::string file_;
    Error& error_;
};

}  // namespace sherd
