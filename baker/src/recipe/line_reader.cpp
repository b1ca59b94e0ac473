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
        if (!level.is_number_unsigned() || level < 1 || level > 64)
            return reader.wrong((pointer + "/").append(color), "must be a level from 1 to 64");
        recipe.levelOfColor.emplace_back(color, level.get<uint32_t>());
    }
    return true;
}

}  // namespace sherd
