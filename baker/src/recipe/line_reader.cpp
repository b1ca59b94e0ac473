// SPDX-License-Identifier: MIT
#include "recipe/line_reader.h"

namespace sherd {

bool readBitmap(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                BitmapOptions& bitmap) {
    double threshold = -1;
    if (!reader.object(json, pointer,
                       {{"threshold", reader.number(threshold, 0, 1)},
                        {"tolerance", reader.number(bitmap.tolerance, 0, 1000)},
                        {"spur", reader.number(bitmap.spur, 0, 1000)},
                        {"curves", reader.boolean(bitmap.curves)}}))
        return false;
    if (threshold >= 0) bitmap.threshold = threshold;
    return true;
}

bool readLevelColors(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                     Recipe& recipe) {
    if (!json.is_object()) return reader.wrong(pointer, "must be an object {\"#ff0000\": 2}");
    for (const auto& [color, level] : json.items()) {
        uint32_t& target = recipe.levelOfColor.emplace_back(color, 1).second;
        if (!reader.integer(target, 1, 64)(level, RecipeReader::below(pointer, color)))
            return false;
    }
    return true;
}

}  // namespace sherd
