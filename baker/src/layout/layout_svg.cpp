// SPDX-License-Identifier: MIT
// The template an artist draws over. Everything for orientation is marked three ways (group
// attribute, layer name, ids), because editors rewrite files: any one of them keeps the map reader
// from taking it for cracks.
#include <array>

#include "layout/overlay_svg.h"
#include "layout/seam_labels.h"
#include "layout/svg_text.h"
#include "layout/uv_wireframe.h"
#include "sherd/baker/layout.h"

namespace sherd {

namespace {

/// Beyond this no drawing program stays usable: borders only.
constexpr size_t kMaxInnerEdges = 500'000;
/// The drawing must stay readable as a map (64 MiB) with room for lines.
constexpr size_t kMaxTextureBytes = size_t{40} << 20;

std::string pathData(const UvWireframe& wireframe, std::span<const std::array<uint32_t, 2>> edges,
                     double size) {
    std::string d;
    for (const std::vector<uint32_t>& chain : chainEdges(wireframe.points.size(), edges)) {
        std::vector<glm::dvec2> points;
        points.reserve(chain.size());
        for (const uint32_t p : chain) points.emplace_back(wireframe.points[p]);
        addChain(points, size, d);
    }
    return d;
}

std::string head(const std::string& size) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "xmlns:xlink=\"http://www.w3.org/1999/xlink\"\n"
           "     xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
           "     xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\"\n"
           "     width=\"" +
           size + "\" height=\"" + size + "\" viewBox=\"0 0 " + size + " " + size +
           "\">\n"
           "  <sodipodi:namedview inkscape:current-layer=\"level-1\"/>\n";
}

std::string image(const std::string& uri, const std::string& size) {
    return "    <image id=\"sherd-guide-texture\" width=\"" + size + "\" height=\"" + size +
           "\" preserveAspectRatio=\"none\" opacity=\"0.7\" xlink:href=\"" + escaped(uri) +
           "\"/>\n";
}

std::string wires(const char* id, const char* style, const std::string& d) {
    if (d.empty()) return {};
    return std::string("    <path id=\"") + id + "\" style=\"" + style + "\" d=\"" + d + "\"/>\n";
}

/// The same number on both charts, a little inside of their borders.
std::string seamNumbers(std::span<const SeamLabel> labels, double resolution, size_t& shown) {
    constexpr size_t kMost = 999;
    const double height = resolution / 110;
    std::string out;
    for (const SeamLabel& label : labels) {
        // Numbers on shorter stretches would lie on top of each other.
        if (shown == kMost || label.length * resolution < 2 * height) break;
        const std::string number = std::to_string(++shown);
        for (size_t side = 0; side < 2; ++side) {
            const glm::dvec2 at = label.at[side] * resolution + label.inward[side] * height;
            out.append("      <text id=\"sherd-guide-seam-").append(number);
            out.append(side == 0 ? "a" : "b").append("\" x=\"").append(svgNumber(at.x));
            out.append("\" y=\"").append(svgNumber(at.y + 0.35 * height)).append("\">");
            out.append(number).append("</text>\n");
        }
    }
    if (out.empty()) return {};
    return "    <g id=\"sherd-guide-seams\" style=\"font-family:sans-serif;font-size:" +
           svgNumber(height) + "px;text-anchor:middle;fill:#a05a00;stroke:#ffffff;stroke-width:" +
           svgNumber(0.25 * height) + ";paint-order:stroke\">\n" + out + "    </g>\n";
}

std::string wireframeLayer(const UvWireframe& wireframe, std::span<const SeamLabel> seams,
                           const LayoutOptions& options, const std::string& size, Layout& layout) {
    std::string out;
    if (options.texture.size() > kMaxTextureBytes)
        layout.warnings.emplace_back("the texture is larger than 40 MiB and left out");
    else if (!options.texture.empty())
        out += image(options.texture, size);
    layout.borderEdges = wireframe.borders.size();
    if (wireframe.inner.size() > kMaxInnerEdges) {
        layout.warnings.emplace_back("more than " + std::to_string(kMaxInnerEdges) +
                                     " edges: only chart borders are drawn");
    } else {
        layout.innerEdges = wireframe.inner.size();
        out += wires("sherd-guide-inner",
                     "fill:none;stroke:#5b7f95;stroke-width:0.5;stroke-opacity:0.6",
                     pathData(wireframe, wireframe.inner, options.resolution));
    }
    out += wires("sherd-guide-borders", "fill:none;stroke:#e08a00;stroke-width:1.5",
                 pathData(wireframe, wireframe.borders, options.resolution));
    out += seamNumbers(seams, options.resolution, layout.seamLabels);
    return guideLayer("sherd-guide", "sherd guide", out);
}

std::string levelLayers() {
    constexpr std::array<const char*, 3> kColours = {"#c00000", "#008030", "#0040c0"};
    std::string out;
    for (size_t k = 0; k < kColours.size(); ++k) {
        const std::string number = std::to_string(k + 1);
        out.append("  <g id=\"level-").append(number);
        out.append("\" inkscape:groupmode=\"layer\" inkscape:label=\"level ").append(number);
        out.append("\"\n     style=\"fill:none;stroke:").append(kColours[k]);
        out.append(";stroke-width:2\">\n  </g>\n");
    }
    return out;
}

void reportTiles(const UvWireframe& wireframe, Layout& layout) {
    if (wireframe.fromOtherTiles > 0)
        layout.warnings.push_back(std::to_string(wireframe.fromOtherTiles) +
                                  " triangles lie in other tiles of their repeating texture; they "
                                  "are drawn in the one tile of this page");
    if (wireframe.beyondEdge > 0)
        layout.warnings.push_back(std::to_string(wireframe.beyondEdge) +
                                  " triangles lie beyond the edge of their clamped texture; they "
                                  "are drawn where they lie, off the page");
}

}  // namespace

Result<Layout> makeLayoutSvg(std::span<const SurfaceMesh> meshes, const LayoutOptions& options) {
    if (options.resolution < 16 || options.resolution > 65536)
        return fail(ErrorCode::badArgument, "the layout's resolution must be from 16 to 65536");
    Layout layout;
    size_t drawable = 0;
    for (const SurfaceMesh& mesh : meshes) {
        if (!mesh.uvSemantic.empty() &&
            findAttribute(mesh.attributes, mesh.uvSemantic) != nullptr) {
            ++drawable;
            continue;
        }
        std::string& warning = layout.warnings.emplace_back("mesh \"");
        warning.append(mesh.name).append("\" has no texture coordinates");
    }
    if (drawable == 0)
        return fail(ErrorCode::noTextureCoordinates,
                    "the model has no texture coordinates to lay out; unwrap it first, or choose "
                    "another UV set",
                    meshes.empty() ? "" : "mesh \"" + meshes.front().name + "\"");

    const UvWireframe wireframe = uvWireframe(meshes);
    reportTiles(wireframe, layout);
    const std::string size = std::to_string(options.resolution);
    const std::vector<SeamLabel> seams =
        options.seamLabels ? seamLabels(meshes) : std::vector<SeamLabel>();
    layout.svg = head(size) + wireframeLayer(wireframe, seams, options, size, layout) +
                 overlayLayers(options.overlays, meshes, options.resolution, layout.spots) +
                 levelLayers() + "</svg>\n";
    return layout;
}

}  // namespace sherd
