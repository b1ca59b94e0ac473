// SPDX-License-Identifier: MIT
#include "texture.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sherd::samples {
namespace {

constexpr uint32_t kBleedTexels = 6;

struct Canvas {
    Image image;
    std::vector<uint8_t> painted;  ///< one flag per texel
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

void storeTexel(Canvas& canvas, size_t texel, const glm::dvec3& color) {
    for (uint32_t c = 0; c < 3; ++c) {
        const double value = std::clamp(color[static_cast<int>(c)], 0.0, 1.0);
        canvas.image.pixels[3 * texel + c] = static_cast<uint8_t>(std::lround(value * 255));
    }
    canvas.painted[texel] = 1;
}

void paintTriangle(Canvas& canvas, const Mesh& mesh, const Triangle& triangle,
                   const Painter& painter) {
    const double size = canvas.image.size;
    const std::array<glm::dvec2, 3> p{glm::dvec2(triangle[0].uv) * size,
                                      glm::dvec2(triangle[1].uv) * size,
                                      glm::dvec2(triangle[2].uv) * size};
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    if (area == 0) return;
    const glm::dvec2 low =
        glm::clamp(glm::floor(glm::min(p[0], glm::min(p[1], p[2]))), 0.0, size - 1);
    const glm::dvec2 high =
        glm::clamp(glm::floor(glm::max(p[0], glm::max(p[1], p[2]))), 0.0, size - 1);
    for (auto y = static_cast<uint32_t>(low.y); y <= static_cast<uint32_t>(high.y); ++y) {
        for (auto x = static_cast<uint32_t>(low.x); x <= static_cast<uint32_t>(high.x); ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            const double a = cross(p[1] - at, p[2] - at) / area;
            const double b = cross(p[2] - at, p[0] - at) / area;
            const double c = 1 - a - b;
            if (std::min({a, b, c}) < -1e-9) continue;
            const auto blend = [&](auto member) {
                return a * glm::dvec3(member(triangle[0])) + b * glm::dvec3(member(triangle[1])) +
                       c * glm::dvec3(member(triangle[2]));
            };
            const SurfacePoint point{
                blend([&](const Corner& corner) { return mesh.positions[corner.position]; }),
                glm::normalize(blend([](const Corner& corner) { return corner.normal; })),
                at / size};
            storeTexel(canvas, size_t{y} * canvas.image.size + x, painter(point));
        }
    }
}

/// One texel outwards: an unpainted texel takes the mean of its painted neighbours.
void bleedOnce(Canvas& canvas) {
    const auto size = static_cast<int32_t>(canvas.image.size);
    const Canvas before = canvas;
    for (int32_t y = 0; y < size; ++y) {
        for (int32_t x = 0; x < size; ++x) {
            const size_t texel = static_cast<size_t>(y) * canvas.image.size + x;
            if (before.painted[texel] != 0) continue;
            glm::dvec3 sum(0);
            uint32_t count = 0;
            for (int32_t n = 0; n < 9; ++n) {
                const int32_t nx = x + n % 3 - 1;
                const int32_t ny = y + n / 3 - 1;
                if (nx < 0 || ny < 0 || nx >= size || ny >= size) continue;
                const size_t from = static_cast<size_t>(ny) * canvas.image.size + nx;
                if (before.painted[from] == 0) continue;
                const uint8_t* rgb = &before.image.pixels[3 * from];
                sum += glm::dvec3(rgb[0], rgb[1], rgb[2]) / 255.0;
                ++count;
            }
            if (count > 0) storeTexel(canvas, texel, sum / double(count));
        }
    }
}

}  // namespace

Image paintTexture(const Mesh& mesh, uint32_t size, const Painter& painter) {
    Canvas canvas;
    canvas.image.size = size;
    canvas.image.pixels.assign(size_t{3} * size * size, 128);
    canvas.painted.assign(size_t{size} * size, 0);
    for (const Triangle& triangle : mesh.triangles) paintTriangle(canvas, mesh, triangle, painter);
    for (uint32_t i = 0; i < kBleedTexels; ++i) bleedOnce(canvas);
    return std::move(canvas.image);
}

std::vector<uint8_t> encodePng(const Image& image) {
    std::vector<uint8_t> png;
    const auto append = [](void* context, void* data, int count) {
        auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
        const auto* begin = static_cast<const uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + count);
    };
    const auto size = static_cast<int>(image.size);
    if (stbi_write_png_to_func(append, &png, size, size, 3, image.pixels.data(), 3 * size) == 0)
        png.clear();
    return png;
}

double smoothStep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double stripe(double x, double half, double soft) {
    return 1 - smoothStep(half - soft / 2, half + soft / 2, std::abs(x));
}

}  // namespace sherd::samples
