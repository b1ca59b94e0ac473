// SPDX-License-Identifier: MIT
#include "rest_look.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <set>

namespace sherd::test {
namespace {

glm::vec3 placed(const RigidPose& pose, const glm::vec3& p) {
    return pose.translation + pose.rotation * p;
}

/// A place as the picture shows it.
struct Seen {
    glm::dvec2 at{0.0};  ///< pixels from the upper left corner
    double depth = 0;    ///< metres along the view
};

Seen project(const PixelGrid& grid, const glm::vec3& p) {
    const glm::dvec4 clip = glm::dmat4(grid.camera) * glm::dvec4(p, 1.0);
    return {
        {(clip.x / clip.w * 0.5 + 0.5) * grid.width, (0.5 - clip.y / clip.w * 0.5) * grid.height},
        clip.w};
}

/// The nearest surface in each pixel's centre.
class DepthPicture {
  public:
    explicit DepthPicture(const PixelGrid& grid)
        : width_(int32_t(grid.width)),
          height_(int32_t(grid.height)),
          depths_(size_t{grid.width} * grid.height, std::numeric_limits<double>::infinity()) {}

    void draw(const std::array<Seen, 3>& t) {
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x * b.y - a.y * b.x;
        };
        const double area = cross(t[1].at - t[0].at, t[2].at - t[0].at);
        if (area == 0) return;
        const glm::dvec2 low = glm::floor(glm::min(t[0].at, glm::min(t[1].at, t[2].at)));
        const glm::dvec2 high = glm::ceil(glm::max(t[0].at, glm::max(t[1].at, t[2].at)));
        for (int32_t y = std::max(0, int32_t(low.y)); y < std::min(height_, int32_t(high.y)); ++y) {
            for (int32_t x = std::max(0, int32_t(low.x)); x < std::min(width_, int32_t(high.x));
                 ++x) {
                const glm::dvec2 at(x + 0.5, y + 0.5);
                const double a = cross(t[1].at - at, t[2].at - at) / area;
                const double b = cross(t[2].at - at, t[0].at - at) / area;
                if (std::min({a, b, 1 - a - b}) < 0) continue;
                double& depth = depths_[size_t(y) * size_t(width_) + size_t(x)];
                const double inverse = a / t[0].depth + b / t[1].depth + (1 - a - b) / t[2].depth;
                depth = std::min(depth, 1 / inverse);
            }
        }
    }

    /// Nothing around the pixel lies clearly before the place.
    [[nodiscard]] bool shows(const Seen& place, double tolerance) const {
        const auto px = int32_t(std::floor(place.at.x));
        const auto py = int32_t(std::floor(place.at.y));
        for (int32_t y = std::max(0, py - 1); y <= std::min(height_ - 1, py + 1); ++y) {
            for (int32_t x = std::max(0, px - 1); x <= std::min(width_ - 1, px + 1); ++x) {
                if (place.depth <= depths_[size_t(y) * size_t(width_) + size_t(x)] + tolerance)
                    return true;
            }
        }
        return false;
    }

  private:
    int32_t width_, height_;
    std::vector<double> depths_;
};

double toSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 == 0 ? 0 : std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0);
    return glm::distance(p, a + along * t);
}

void flagAround(const PixelGrid& grid, const glm::dvec2& a, const glm::dvec2& b,
                std::vector<bool>& flags) {
    const glm::dvec2 low = glm::floor(glm::min(a, b) - 1.5);
    const glm::dvec2 high = glm::ceil(glm::max(a, b) + 1.5);
    for (auto y = int32_t(low.y); y <= int32_t(high.y); ++y) {
        for (auto x = int32_t(low.x); x <= int32_t(high.x); ++x) {
            if (x < 0 || y < 0 || x >= int32_t(grid.width) || y >= int32_t(grid.height)) continue;
            if (toSegment({x + 0.5, y + 0.5}, a, b) <= 1)
                flags[size_t(y) * grid.width + size_t(x)] = true;
        }
    }
}

}  // namespace

Result<RestModel> loadRestModel(const std::filesystem::path& path) {
    Result<Model> source = importModel(path, {});
    if (!source) return tl::unexpected(source.error());
    const auto assets = loadAssets(path);
    if (!assets) return tl::unexpected(assets.error());
    return RestModel{std::move(*source), assets->front()};
}

std::vector<std::array<glm::vec3, 3>> sourceTriangles(const RestModel& model) {
    const SurfaceMesh& mesh = model.source.meshes.front();
    std::vector<std::array<glm::vec3, 3>> out;
    for (const std::array<uint32_t, 3>& t : mesh.triangles) {
        out.push_back({placed(mesh.restPose, mesh.positions[t[0]]),
                       placed(mesh.restPose, mesh.positions[t[1]]),
                       placed(mesh.restPose, mesh.positions[t[2]])});
    }
    return out;
}

LineSegments fractureLines(const Asset& asset, const std::vector<FragmentPose>& pieces) {
    const FractureGeometry& geometry = asset.geometry();
    using Place = std::array<float, 3>;
    const auto place = [&](uint32_t index) {
        const glm::vec3& p = geometry.positions[geometry.indices[index]];
        return Place{p.x, p.y, p.z};
    };
    LineSegments lines;
    for (const FragmentPose& piece : pieces) {
        std::set<std::pair<Place, Place>> edges;
        for (const DrawRange& range : asset.drawRanges(piece.fragment)) {
            if (range.exposedFrom != 0) continue;
            for (uint32_t i = 0; i < range.indices.count; ++i) {
                const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
                edges.emplace(place(range.indices.first + i), place(range.indices.first + next));
            }
        }
        for (const auto& [a, b] : edges) {
            if (edges.contains({b, a})) continue;
            lines.push_back(
                {placed(piece.pose, {a[0], a[1], a[2]}), placed(piece.pose, {b[0], b[1], b[2]})});
        }
    }
    return lines;
}

std::vector<bool> nearLines(const PixelGrid& grid, const LineSegments& lines,
                            std::span<const std::array<glm::vec3, 3>> triangles) {
    DepthPicture depths(grid);
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const std::array<glm::vec3, 3>& t : triangles) {
        depths.draw({project(grid, t[0]), project(grid, t[1]), project(grid, t[2])});
        for (const glm::vec3& p : t) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const double tolerance = 1e-3 * glm::distance(low, high);
    std::vector<bool> flags(size_t{grid.width} * grid.height, false);
    for (const std::array<glm::vec3, 2>& line : lines) {
        const double length = glm::distance(project(grid, line[0]).at, project(grid, line[1]).at);
        const auto steps = uint32_t(std::ceil(length / 0.5)) + 1;
        Seen from = project(grid, line[0]);
        for (uint32_t i = 1; i <= steps; ++i) {
            const Seen to = project(grid, glm::mix(line[0], line[1], float(i) / float(steps)));
            if (depths.shows(from, tolerance) || depths.shows(to, tolerance))
                flagAround(grid, from.at, to.at, flags);
            from = to;
        }
    }
    return flags;
}

LookDifference comparePictures(const samples::Picture& whole, const samples::Picture& pieces,
                               const std::vector<bool>& skip) {
    constexpr uint32_t kTolerance = 3;  // of 255
    LookDifference out;
    for (uint32_t pixel = 0; pixel < skip.size(); ++pixel) {
        if (skip[pixel]) {
            ++out.skipped;
            continue;
        }
        uint32_t most = 0;
        for (size_t c = 0; c < 3; ++c) {
            const int32_t a = whole.pixels[size_t{pixel} * 3 + c];
            const int32_t b = pieces.pixels[size_t{pixel} * 3 + c];
            most = std::max(most, uint32_t(std::abs(a - b)));
        }
        if (most > kTolerance) ++out.pixels;
        if (most <= out.worst) continue;
        out.worst = most;
        out.at = {pixel % whole.width, pixel / whole.width};
    }
    return out;
}

}  // namespace sherd::test
