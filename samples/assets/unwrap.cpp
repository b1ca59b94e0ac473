// SPDX-License-Identifier: MIT
// Triangles choose one of six views by their normals and their neighbours (the label relaxation of
// M. Tarini et al., "PolyCube-Maps", 2004, in its simplest form); connected patches of one view
// grow into charts as long as nothing lies over them.
#include "unwrap.h"

#include <algorithm>
#include <array>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "flat_chart.h"

namespace sherd::samples {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
constexpr uint32_t kSweeps = 30;
constexpr double kCellSize = 0.02;  ///< metres, of the search for overlaps

struct Chart {
    uint32_t view = 0;
    std::vector<uint32_t> triangles;
};

class Unwrapper {
  public:
    Unwrapper(const Mesh& mesh, const UnwrapOptions& options) : mesh_(mesh), options_(options) {
        findNeighbours();
        for (const Triangle& t : mesh.triangles) {
            const glm::dvec3 a = mesh.positions[t[0].position];
            normals_.push_back(
                glm::normalize(glm::cross(glm::dvec3(mesh.positions[t[1].position]) - a,
                                          glm::dvec3(mesh.positions[t[2].position]) - a)));
        }
    }

    std::vector<Chart> charts() {
        chooseViews();
        chartOf_.assign(mesh_.triangles.size(), kNone);
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t)
            if (chartOf_[t] == kNone) grow(t);
        joinSmall();
        std::erase_if(charts_, [](const Chart& chart) { return chart.triangles.empty(); });
        return std::move(charts_);
    }

    [[nodiscard]] FlatTriangle flat(uint32_t view, uint32_t triangle) const {
        const Triangle& t = mesh_.triangles[triangle];
        return {seen(view, mesh_.positions[t[0].position]),
                seen(view, mesh_.positions[t[1].position]),
                seen(view, mesh_.positions[t[2].position])};
    }

  private:
    void findNeighbours() {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (uint32_t k = 0; k < 3; ++k) {
                edges[{mesh_.triangles[t][k].position, mesh_.triangles[t][(k + 1) % 3].position}] =
                    t;
            }
        }
        for (const Triangle& t : mesh_.triangles) {
            std::array<uint32_t, 3> around{};
            for (uint32_t k = 0; k < 3; ++k) {
                const auto other = edges.find({t[(k + 1) % 3].position, t[k].position});
                around[k] = other == edges.end() ? kNone : other->second;
            }
            neighbours_.push_back(around);
        }
    }

    [[nodiscard]] double facing(uint32_t triangle, uint32_t view) const {
        return glm::dot(normals_[triangle], viewDirection(view));
    }

    /// The view with the best sum of facing and agreeing neighbours.
    [[nodiscard]] uint32_t bestView(uint32_t triangle) const {
        uint32_t best = 0;
        double most = -1e9;
        for (uint32_t view = 0; view < kViews; ++view) {
            double score = facing(triangle, view);
            if (score < options_.steepest) continue;
            for (const uint32_t other : neighbours_[triangle]) {
                if (other != kNone && views_[other] == view) score += options_.cohesion;
            }
            if (score <= most) continue;
            most = score;
            best = view;
        }
        return best;
    }

    void chooseViews() {
        views_.assign(mesh_.triangles.size(), kViews);
        for (uint32_t sweep = 0; sweep < kSweeps; ++sweep) {
            for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) views_[t] = bestView(t);
        }
    }

    /// From one triangle over all of its view that can be reached without lying over another.
    void grow(uint32_t seed) {
        const auto index = static_cast<uint32_t>(charts_.size());
        charts_.push_back({views_[seed], {}});
        flats_.emplace_back(kCellSize);
        std::deque<uint32_t> queue{seed};
        while (!queue.empty()) {
            const uint32_t t = queue.front();
            queue.pop_front();
            if (chartOf_[t] != kNone || flats_[index].overlaps(flat(views_[seed], t))) continue;
            take(t, index);
            for (const uint32_t other : neighbours_[t]) {
                if (other != kNone && views_[other] == views_[seed] && chartOf_[other] == kNone)
                    queue.push_back(other);
            }
        }
    }

    void take(uint32_t triangle, uint32_t chart) {
        chartOf_[triangle] = chart;
        charts_[chart].triangles.push_back(triangle);
        flats_[chart].add(flat(charts_[chart].view, triangle));
    }

    /// Smallest first, into the neighbour with the longest common border that has room.
    void joinSmall() {
        for (uint32_t size = 1; size < options_.smallest; ++size) {
            for (uint32_t chart = 0; chart < charts_.size(); ++chart) {
                if (charts_[chart].triangles.size() == size) joinNeighbour(chart);
            }
        }
    }

    void joinNeighbour(uint32_t chart) {
        std::map<uint32_t, uint32_t> borders;
        for (const uint32_t t : charts_[chart].triangles) {
            for (const uint32_t other : neighbours_[t])
                if (other != kNone && chartOf_[other] != chart) ++borders[chartOf_[other]];
        }
        std::vector<std::pair<uint32_t, uint32_t>> order(borders.begin(), borders.end());
        std::stable_sort(order.begin(), order.end(),
                         [](const auto& a, const auto& b) { return a.second > b.second; });
        for (const auto& [host, length] : order) {
            if (!hasRoom(host, charts_[chart])) continue;
            const std::vector<uint32_t> triangles = std::move(charts_[chart].triangles);
            charts_[chart].triangles.clear();
            for (const uint32_t t : triangles) take(t, host);
            return;
        }
    }

    [[nodiscard]] bool hasRoom(uint32_t host, const Chart& guest) const {
        const uint32_t view = charts_[host].view;
        // The guest's triangles lie beside each other in their own view, not always in this one.
        FlatChart together(kCellSize);
        for (const uint32_t t : guest.triangles) {
            const FlatTriangle triangle = flat(view, t);
            if (facing(t, view) < options_.steepest || flats_[host].overlaps(triangle) ||
                together.overlaps(triangle))
                return false;
            together.add(triangle);
        }
        return true;
    }

    const Mesh& mesh_;
    UnwrapOptions options_;
    std::vector<glm::dvec3> normals_;
    std::vector<std::array<uint32_t, 3>> neighbours_;
    std::vector<uint32_t> views_;
    std::vector<uint32_t> chartOf_;
    std::vector<Chart> charts_;
    std::vector<FlatChart> flats_;
};

}  // namespace

std::vector<uint32_t> unwrap(Mesh& mesh, const UnwrapOptions& options) {
    Unwrapper unwrapper(mesh, options);
    const std::vector<Chart> charts = unwrapper.charts();
    std::vector<glm::dvec2> lows, sizes, corners;
    for (const Chart& chart : charts) {
        glm::dvec2 low(std::numeric_limits<double>::max());
        glm::dvec2 high(std::numeric_limits<double>::lowest());
        for (const uint32_t t : chart.triangles) {
            for (const glm::dvec2& p : unwrapper.flat(chart.view, t)) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        lows.push_back(low);
        sizes.push_back(high - low);
    }
    const double factor = packBoxes(sizes, options.gutter, corners);
    std::vector<uint32_t> chartOf(mesh.triangles.size());
    for (uint32_t c = 0; c < charts.size(); ++c) {
        for (const uint32_t t : charts[c].triangles) {
            chartOf[t] = c;
            const FlatTriangle flat = unwrapper.flat(charts[c].view, t);
            for (size_t k = 0; k < 3; ++k)
                mesh.triangles[t][k].uv = corners[c] + (flat[k] - lows[c]) * factor;
        }
    }
    return chartOf;
}

}  // namespace sherd::samples
