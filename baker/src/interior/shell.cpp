// SPDX-License-Identifier: MIT
#include "interior/shell.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "surface/uv_triangle.h"

namespace sherd {
namespace {

/// Of the diagonal, where no thickness is given.
constexpr double kDefaultShare = 0.02;

glm::dvec3 pointOf(const SurfaceMesh& mesh, uint32_t triangle, const glm::dvec3& weights) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return weights.x * glm::dvec3(mesh.positions[a]) + weights.y * glm::dvec3(mesh.positions[b]) +
           weights.z * glm::dvec3(mesh.positions[c]);
}

/// NaN counts as nothing.
double share(double value) {
    return value > 0 ? std::min(value, 1.0) : 0;
}

Thickness byAttribute(const SurfaceMesh& mesh, const Attribute& attribute, uint32_t channel,
                      double thickness) {
    return [&mesh, &attribute, channel, thickness](uint32_t triangle, const glm::dvec3& weights) {
        double value = 0;
        for (int k = 0; k < 3; ++k) {
            const uint32_t corner = mesh.corners[triangle][static_cast<size_t>(k)];
            value += weights[k] * attribute.values[size_t{attribute.components} * corner + channel];
        }
        return thickness * share(value);
    };
}

Thickness byPicture(const SurfaceMesh& mesh, std::shared_ptr<const GreyImage> picture,
                    double thickness) {
    return [&mesh, picture = std::move(picture), thickness](uint32_t triangle,
                                                            const glm::dvec3& weights) {
        const auto uv = uvOf(mesh, triangle, pointOf(mesh, triangle, weights));
        if (!uv || !std::isfinite(uv->x) || !std::isfinite(uv->y)) return 0.0;
        const auto texel = [](double x, uint32_t size) {
            return std::min(static_cast<uint32_t>((x - std::floor(x)) * size), size - 1);
        };
        const size_t at =
            size_t{texel(uv->y, picture->height)} * picture->width + texel(uv->x, picture->width);
        return thickness * picture->values[at] / 255.0;
    };
}

}  // namespace

Result<Thickness> thicknessOf(const SurfaceMesh& mesh, const ShellSettings& settings,
                              double diagonal) {
    const double thickness = settings.thickness > 0 ? settings.thickness : kDefaultShare * diagonal;
    const std::string where = "mesh \"" + mesh.name + "\"";
    if (!settings.attribute.empty()) {
        const Attribute* attribute = findAttribute(mesh.attributes, settings.attribute);
        if (attribute == nullptr) {
            std::string known;
            for (const Attribute& a : mesh.attributes)
                known += (known.empty() ? "" : ", ") + a.semantic;
            return fail(ErrorCode::invalidData,
                        "there is no attribute \"" + settings.attribute +
                            "\" to scale the shell's thickness by; there are: " + known,
                        where);
        }
        if (settings.channel >= attribute->components) {
            return fail(ErrorCode::invalidData,
                        "the attribute \"" + settings.attribute + "\" has " +
                            std::to_string(attribute->components) +
                            " channels only; the shell's thickness asks for number " +
                            std::to_string(settings.channel),
                        where);
        }
        return byAttribute(mesh, *attribute, settings.channel, thickness);
    }
    if (!settings.texture.empty()) {
        if (findAttribute(mesh.attributes, mesh.uvSemantic) == nullptr) {
            return fail(ErrorCode::noTextureCoordinates,
                        "there are no texture coordinates for the picture of the shell's "
                        "thickness; give it an \"attribute\" instead",
                        where);
        }
        if (!settings.picture || settings.picture->values.empty()) {
            return fail(ErrorCode::badArgument, "the picture of the shell's thickness was not read",
                        where);
        }
        return byPicture(mesh, settings.picture, thickness);
    }
    return [thickness](uint32_t, const glm::dvec3&) { return thickness; };
}

HiddenMap shellMap(const SurfaceMesh& mesh, const MedialSurface& medial, Thickness thickness) {
    return [&mesh, &medial, thickness = std::move(thickness)](uint32_t triangle,
                                                              const glm::dvec3& weights) {
        const glm::dvec3 p = pointOf(mesh, triangle, weights);
        const glm::dvec3 inwards = medial.at(triangle, weights) - p;
        const double depth = glm::length(inwards), wanted = thickness(triangle, weights);
        return depth > wanted ? p + inwards * (wanted / depth) : p + inwards;
    };
}

}  // namespace sherd
