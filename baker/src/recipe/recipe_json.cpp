// SPDX-License-Identifier: MIT
#include "recipe/recipe_json.h"

#include <optional>
#include <set>
#include <vector>

#include "recipe/recipe_reader.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

/// Follows the parser and remembers the first key that stands twice.
class KeyWatcher {
  public:
    void see(Json::parse_event_t event, const Json& parsed) {
        switch (event) {
            case Json::parse_event_t::object_start:
            case Json::parse_event_t::array_start:
                countItem();
                open_.push_back({event == Json::parse_event_t::array_start, 0, "", {}});
                break;
            case Json::parse_event_t::object_end:
            case Json::parse_event_t::array_end:
                open_.pop_back();
                break;
            case Json::parse_event_t::key:
                open_.back().key = parsed.get<std::string>();
                if (!open_.back().seen.insert(open_.back().key).second && !twice_)
                    twice_ = pointer();
                break;
            case Json::parse_event_t::value:
                countItem();
                break;
        }
    }

    const std::optional<std::string>& twice() const { return twice_; }

  private:
    struct Open {
        bool array;
        size_t items;
        std::string key;  ///< the latest
        std::set<std::string> seen;
    };

    void countItem() {
        if (!open_.empty()) ++open_.back().items;
    }
    std::string pointer() const {
        std::string out;
        for (const Open& level : open_)
            out =
                RecipeReader::below(out, level.array ? std::to_string(level.items - 1) : level.key);
        return out;
    }

    std::vector<Open> open_;
    std::optional<std::string> twice_;
};

}  // namespace

Result<Json> parseJson(std::string_view text, const std::string& file, const std::string& pointer) {
    KeyWatcher watcher;
    const auto callback = [&watcher](int /*depth*/, Json::parse_event_t event, Json& parsed) {
        watcher.see(event, parsed);
        return true;
    };
    Json json;
    try {
        json = Json::parse(text, callback, true, true);
    } catch (const Json::exception& e) {
        return fail(ErrorCode::malformed, std::string("the recipe is not valid JSON: ") + e.what(),
                    pointer.empty() ? file : file + "#" + pointer);
    }
    if (watcher.twice())
        return fail(ErrorCode::invalidData,
                    "this key stands twice in one object; only one would count",
                    file + "#" + pointer + *watcher.twice());
    return json;
}

}  // namespace sherd
