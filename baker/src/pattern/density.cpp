// SPDX-License-Identifier: MIT
#include "pattern/density.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "map/bitmap_picture.h"
#include "map/map_limits.h"
#include "surface/uv_triangle.h"

namespace sherd {
namespace {

constexpr double kLeast = 0.02;

double luminance(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;  // of linear colours, as COLOR_0 is
}

Density byColor(const SurfaceMesh& mesh, const Attribute& color) {
    return [&mesh, &color](uint32_t triangle, const glm::dvec3& weights) {
        double sum = 0;
        for (size_t k = 0; k < 3; ++k) {
            const float* c = &color.values[size_t{color.components} * mesh.corners[triangle][k]];
            sum += weights[static_cast<int>(k)] * luminance(c[0], c[1], c[2]);
        }
        return std::clamp(sum, kLeast, 1.0);
    };
}

Density byPicture(const SurfaceMesh& mesh, std::shared_ptr<const GreyImage> picture) {
    return [&mesh, picture](uint32_t triangle, const glm::dvec3& weights) {
        glm::dvec3 position(0.0);
        for (size_t k = 0; k < 3; ++k)
            position += glm::dvec3(mesh.positions[mesh.triangles[triangle][k]]) *
                        weights[static_cast<int>(k)];
        const std::optional<glm::dvec2> uv = uvOf(mesh, triangle, position);
        const auto texel = [](double x, uint32_t size) {
            const double wrapped = x - std::floor(x);
            return std::min(static_cast<uint32_t>(wrapped * size), size - 1);
        };
        if (!uv || !std::isfinite(uv->x) || !std::isfinite(uv->y)) return kLeast;
        const size_t at =
            size_t{texel(uv->y, picture->height)} * picture->width + texel(uv->x, picture->width);
        return std::clamp(1 - picture->values[at] / 255.0, kLeast, 1.0);
    };
}

}  // namespace

Result<Density> densityOf(const SurfaceMesh& mesh, const FracturePlan::Grown& grown) {
    const std::string& asked = grown.pattern.density;
    if (asked.empty()) return Density();
    const std::string where = "pattern \"" + grown.pattern.text + "\"";
    if (asked == "color") {
        const Attribute* color = findAttribute(mesh.attributes, "COLOR_0");
        if (color == nullptr || color->components < 3)
            return fail(ErrorCode::invalidData,
                        "mesh \"" + mesh.name + "\" has no vertex colours for density=color",
                        where);
        return byColor(mesh, *color);
    }
    if (findAttribute(mesh.attributes, mesh.uvSemantic) == nullptr)
        return fail(ErrorCode::noTextureCoordinates,
                    "mesh \"" + mesh.name +
                        "\" has no texture coordinates for a density picture; use density=color",
                    where);
    if (!grown.density || grown.density->values.empty())
        return fail(ErrorCode::badArgument, "its density picture was not read", where);
    return byPicture(mesh, grown.density);
}

Result<GreyImage> readGreyImage(const std::filesystem::path& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status))
        return fail(ErrorCode::fileNotFound, "there is no such picture", path.string());
    if (std::filesystem::file_size(path, status) > kMaxMapBytes || status)
        return fail(ErrorCode::limitExceeded, "the picture is larger than 64 MiB", path.string());
    std::ifstream in(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(in)),
                                  std::istreambuf_iterator<char>());
    if (!in.good() && !in.eof())
        return fail(ErrorCode::fileRead, "the picture cannot be read", path.string());
    Result<Picture> picture = decodePicture(
        {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, path.string());
    if (!picture) return tl::unexpected(picture.error());
    return GreyImage{static_cast<uint32_t>(picture->width), static_cast<uint32_t>(picture->height),
                     std::move(picture->grey)};
}

}  // namespace sherd
