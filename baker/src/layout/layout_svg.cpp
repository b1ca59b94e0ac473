// SPDX-License-Identifier: MIT
// The template an artist draws over. Everything for orientation is marked three ways (group
// attribute, layer name, ids), because editors rewrite files: any one of them keeps the map reader
// from taking it for cracks.
#include <array>
#include <charconv>

#include "layout/uv_wireframe.h"
#include "sherd/baker/layout.h"

namespace sherd {

namespace {

/// Beyond this no drawing program stays usable: borders only.
constexpr size_t kMaxInnerEdges = 500'000;
/// The drawing must stay readable as a map (64 MiB) with room for lines.
constexpr size_t kMaxTextureBytes = size_t{40} << 20;

void addNumber(double value, std::string& out) {
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::fixed, 2);
    if (error != std::errc()) return;  // a UV beyond 1e20 is no place on the page
    out.append(buffer.data(), end);
}

std::string escaped(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= 0x20) out += c;
        }
    return out;
}

std::string pathData(const UvWireframe& wireframe, std::span<const std::array<uint32_t, 2>> edges,
                     double size) {
    std::string d;
    for (const std::vector<uint32_t>& chain : chainEdges(wireframe.points.size(), edges)) {
        char separator = 'M';
        for (const uint32_t p : chain) {
            d += separator;
            addNumber(wireframe.points[p].x * size, d);
            d += ' ';
            addNumber(wireframe.points[p].y * size, d);
            separator = ' ';
        }
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

std::string guideLayer(const UvWireframe& wireframe, const LayoutOptions& options,
                       const std::string& size, Layout& layout) {
    std::string out =
        "  <g id=\"sherd-guide\" data-sherd-guide=\"true\" inkscape:groupmode=\"layer\"\n"
        "     inkscape:label=\"sherd guide\" sodipodi:insensitive=\"true\">\n";
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
    return out + "  </g>\n";
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
    layout.svg =
        head(size) + guideLayer(wireframe, options, size, layout) + levelLayers() + "</svg>\n";
    return layout;
}

}  // namespace sherd
