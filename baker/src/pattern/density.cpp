// SPDX-License-Identifier: MIT
#include "pattern/density.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "geometry/bounds.h"
#include "map/bitmap_picture.h"
#include "map/map_limits.h"
#include "surface/uv_triangle.h"

namespace sherd {
namespace {

constexpr double kLeast = 0.02;

double luminance(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;  // of linear colours, as COLOR_0 is
}

/// Bells around the places, as wide as `sigma` metres.
Density byPlaces(const SplitSurface& surface, std::vector<glm::dvec3> places, double sigma) {
    return [&surface, places = std::move(places), sigma](uint32_t triangle,
                                                         const glm::dvec3& weights) {
        const glm::dvec3 p = pointOn(surface, triangle, weights);
        double sum = kLeast;
        for (const glm::dvec3& place : places) {
            const double d = glm::distance(p, place) / sigma;
            sum += std::exp(-0.5 * d * d);
        }
        return std::min(1.0, sum);
    };
}

Density byColor(const SurfaceMesh& mesh, const SplitSurface& surface, const Attribute& color) {
    return [&mesh, &surface, &color](uint32_t triangle, const glm::dvec3& weights) {
        // Cut vertices are sums of mesh vertices, and so are their colours.
        const SplitTriangle& t = surface.triangles[triangle];
        const auto& source = mesh.triangles[t.source];
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const VertexOrigin& origin = surface.origins[t.v[static_cast<size_t>(k)]];
            for (int j = 0; j < 3; ++j) {
                const auto at = std::find(source.begin(), source.end(),
                                          origin.vertices[static_cast<size_t>(j)]);
                if (at == source.end()) continue;
                const uint32_t corner =
                    mesh.corners[t.source][static_cast<size_t>(at - source.begin())];
                const float* c = &color.values[size_t{color.components} * corner];
                sum += weights[k] * origin.weights[j] * luminance(c[0], c[1], c[2]);
            }
        }
        return std::clamp(sum, kLeast, 1.0);
    };
}

Density byPicture(const SurfaceMesh& mesh, const SplitSurface& surface,
                  std::shared_ptr<const GreyImage> picture) {
    return [&mesh, &surface, picture = std::move(picture)](uint32_t triangle,
                                                           const glm::dvec3& weights) {
        const std::optional<glm::dvec2> uv =
            uvOf(mesh, surface.triangles[triangle].source, pointOn(surface, triangle, weights));
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

Result<Density> densityOf(const SurfaceMesh& mesh, const SplitSurface& surface,
                          const FracturePlan::Grown& grown) {
    const Pattern& pattern = grown.pattern;
    if (!pattern.around.empty()) {
        std::vector<glm::dvec3> places;
        for (const glm::dvec3& p : pattern.around)
            places.push_back(toObjectFrame(mesh.restPose, p));
        const double diagonal = boundsOf(mesh.positions, mesh.triangles).diagonal();
        return byPlaces(surface, std::move(places), pattern.spread * diagonal);
    }
    const std::string& asked = pattern.density;
    if (asked.empty()) return Density();
    const std::string where = "pattern \"" + grown.pattern.text + "\"";
    if (asked == "color") {
        const Attribute* color = findAttribute(mesh.attributes, "COLOR_0");
        if (color == nullptr || color->components < 3)
            return fail(ErrorCode::invalidData,
                        "mesh \"" + mesh.name + "\" has no vertex colours for density=color",
                        where);
        return byColor(mesh, surface, *color);
    }
    if (findAttribute(mesh.attributes, mesh.uvSemantic) == nullptr)
        return fail(ErrorCode::noTextureCoordinates,
                    "mesh \"" + mesh.name +
                        "\" has no texture coordinates for a density picture; use density=color",
                    where);
    if (!grown.density || grown.density->values.empty())
        return fail(ErrorCode::badArgument, "its density picture was not read", where);
    return byPicture(mesh, surface, grown.density);
}

Result<GreyImage> readGreyImage(const std::filesystem::path& path) {
    const Result<std::string> bytes = readMapFile(path, "picture");
    if (!bytes) return tl::unexpected(bytes.error());
    Result<Picture> picture = decodePicture(
        {reinterpret_cast<const uint8_t*>(bytes->data()), bytes->size()}, path.string());
    if (!picture) return tl::unexpected(picture.error());
    return GreyImage{static_cast<uint32_t>(picture->width), static_cast<uint32_t>(picture->height),
                     std::move(picture->grey)};
}

}  // namespace sherd
