// SPDX-License-Identifier: MIT
#include "map/svg_viewport.h"

namespace sherd {

std::optional<SvgFrame> rootSvgFrame(const pugi::xml_node& root) {
    std::optional<SvgViewBox> box = parseSvgViewBox(root.attribute("viewBox").value());
    if (!box) {
        const double width = svgLength(root, "width", 0, 0);
        const double height = svgLength(root, "height", 0, 0);
        if (!(width > 0) || !(height > 0)) return std::nullopt;
        box = SvgViewBox{0, 0, width, height};
    }
    return SvgFrame{
        {1 / box->width, 0, 0, 1 / box->height, -box->x / box->width, -box->y / box->height},
        {box->width, box->height}};
}

void enterSvgViewport(const pugi::xml_node& node, SvgViewport size, bool placed, SvgFrame& frame) {
    const SvgViewport outer = frame.viewport;
    const double x = placed ? svgLength(node, "x", outer.width, 0) : 0;
    const double y = placed ? svgLength(node, "y", outer.height, 0) : 0;
    const double width = svgLength(node, "width", outer.width, size.width);
    const double height = svgLength(node, "height", outer.height, size.height);
    frame.transform = frame.transform * Affine{1, 0, 0, 1, x, y};
    frame.viewport = {width, height};
    if (const auto box = parseSvgViewBox(node.attribute("viewBox").value())) {
        frame.transform =
            frame.transform *
            fitSvgViewBox(*box, width, height, node.attribute("preserveAspectRatio").value());
        frame.viewport = {box->width, box->height};
    }
}

}  // namespace sherd
