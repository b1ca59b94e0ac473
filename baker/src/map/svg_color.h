// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace sherd {

struct SvgColor {
    uint32_t rgb = 0;  ///< 0xrrggbb; opacity is left out
};

/// #rgb, #rgba, #rrggbb, #rrggbbaa, rgb(), rgba() or a name of CSS. Nothing for all else: none,
/// transparent and currentColor too.
std::optional<SvgColor> parseSvgColor(std::string_view text);

/// "#ff8000"
std::string colorText(SvgColor color);

/// The levels that stroke colours choose. Colours are compared as 8-bit RGB, exactly.
class ColorLevels {
  public:
    /// What is wrong with it; nothing if it was taken. What an earlier call said of a colour holds.
    std::optional<std::string> add(std::string_view color, uint32_t level);
    /// "#ff0000:1 #00ff00:2", up to the first mistake.
    std::optional<std::string> addList(std::string_view list);
    std::optional<uint32_t> levelOf(SvgColor color) const;
    bool empty() const { return levels_.empty(); }

  private:
    std::map<uint32_t, uint32_t> levels_;
};

}  // namespace sherd
