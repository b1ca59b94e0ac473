// SPDX-License-Identifier: MIT
#include "pattern/surface_voronoi.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "pattern/power_cells.h"

namespace sherd {
namespace {

/// Divides one triangle after another; most lie in one cell and are passed over.
class Divider {
  public:
    Divider(const SplitSurface& surface, const SiteGrid& grid, const SiteTree& sites, uint32_t line)
        : surface_(surface),
          grid_(grid),
          sites_(sites),
          line_(line),
          values_(sites.sites().size()),
          valuesFor_(sites.sites().size(), kNone),
          queuedFor_(sites.sites().size(), kNone) {}

    void divide(uint32_t triangle) {
        const auto& v = surface_.triangles[triangle].v;
        std::array<uint32_t, 3> nearest{};
        for (size_t k = 0; k < 3; ++k) {
            const Vertex& vertex = at(v[k]);
            nearest[k] = vertex.nearest;
            corner_[k] = vertex.point;
            forward_[k] = v[k] < v[(k + 1) % 3];
        }
        // A site that is nearest at all corners is so everywhere between.
        if (nearest[0] == nearest[1] && nearest[1] == nearest[2]) return;
        triangle_ = triangle;
        // The cells of a triangle hang together: from those at the corners every other is reached
        // over a border.
        for (const uint32_t site : nearest) enqueue(site);
        while (!queue_.empty()) {
            const uint32_t site = queue_.back();
            queue_.pop_back();
            emit(cellOf(site));
        }
    }

    std::vector<Chord> take() { return std::move(chords_); }

  private:
    struct Vertex {
        SitePoint point;
        uint32_t nearest;
    };
    const Vertex& at(uint32_t v) {
        const auto found = vertices_.find(v);
        if (found != vertices_.end()) return found->second;
        const SitePoint point = grid_.snap(surface_.positions[v]);
        return vertices_.emplace(v, Vertex{point, sites_.nearest(point)}).first->second;
    }

    void enqueue(uint32_t site) {
        if (queuedFor_[site] == triangle_) return;
        queuedFor_[site] = triangle_;
        queue_.push_back(site);
    }

    void measure(uint32_t site) {
        if (valuesFor_[site] == triangle_) return;
        valuesFor_[site] = triangle_;
        for (size_t k = 0; k < 3; ++k)
            values_[site][k] = squaredDistance(corner_[k], sites_.sites()[site]);
    }

    /// The triangle clipped by the bisectors with the other sites, nearest first, until no farther
    /// one can reach the cell.
    PowerCell cellOf(uint32_t site) {
        measure(site);
        PowerCell cell(site);
        const size_t others = sites_.sites().size() - 1;
        double reach = reachOf(cell);
        for (size_t done = 0, wanted = 16; done < others; wanted *= 4) {
            const std::vector<uint32_t> near = sites_.nearestTo(site, wanted);
            for (; done < near.size(); ++done) {
                const uint32_t other = near[done];
                const SitePoint& s = sites_.sites()[site];
                if (static_cast<double>(squaredDistance(s, sites_.sites()[other])) > 4 * reach)
                    return cell;
                measure(other);
                const size_t before = cell.sides().size();
                cell.clip(values_, other);
                if (cell.empty()) return cell;
                if (cell.sides().size() != before || cell.sides()[0].index == other)
                    reach = reachOf(cell);
            }
        }
        return cell;
    }

    /// An upper bound of the squared distance from the site to its cell. It is convex, so its
    /// corners tell; they come rounded to the frame, for which a few of its steps are allowed. (The
    /// mean of the distances at the triangle's corners is a bound as well, but one that never gets
    /// smaller than the triangle: 10,000 sites on a cube of 12 triangles took a hundred times as
    /// long as 1,000.)
    double reachOf(const PowerCell& cell) const {
        const auto vector = [](const SitePoint& p) {
            return glm::dvec3(static_cast<double>(p.x), static_cast<double>(p.y),
                              static_cast<double>(p.z));
        };
        const glm::dvec3 a = vector(corner_[0]);
        const glm::dvec3 ab = vector(corner_[1]) - a;
        const glm::dvec3 ac = vector(corner_[2]) - a;
        const glm::dvec3 site = vector(sites_.sites()[cell.site()]);
        double reach = 0;
        for (size_t n = 0; n < cell.sides().size(); ++n) {
            const glm::dvec3 w = weightsOf(cell.corner(values_, n, forward_));
            reach = std::max(reach, glm::distance(a + ab * w[1] + ac * w[2], site));
        }
        reach += 0x1p-22 * (glm::length(ab) + glm::length(ac)) + 1;
        return reach * reach;
    }

    void emit(const PowerCell& cell) {
        const size_t n = cell.sides().size();
        for (size_t k = 0; k < n; ++k) {
            const CellSide& side = cell.sides()[k];
            if (side.edge) continue;
            enqueue(side.index);
            if (side.index < cell.site()) continue;  // that cell adds it
            chords_.push_back({triangle_, cell.corner(values_, (k + n - 1) % n, forward_),
                               cell.corner(values_, k, forward_), line_});
        }
    }

    const SplitSurface& surface_;
    const SiteGrid& grid_;
    const SiteTree& sites_;
    uint32_t line_;
    std::unordered_map<uint32_t, Vertex> vertices_;
    uint32_t triangle_ = kNone;
    std::array<SitePoint, 3> corner_;
    std::array<bool, 3> forward_{};
    std::vector<CornerValues> values_;  ///< per site; of the triangle that valuesFor_ names
    std::vector<uint32_t> valuesFor_, queuedFor_;
    std::vector<uint32_t> queue_;
    std::vector<Chord> chords_;
};

}  // namespace

std::vector<Chord> voronoiBorders(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                  const SiteGrid& grid, const SiteTree& sites, uint32_t line) {
    if (sites.sites().size() < 2) return {};
    Divider divider(surface, grid, sites, line);
    for (const uint32_t t : triangles) divider.divide(t);
    return divider.take();
}

}  // namespace sherd
