// SPDX-License-Identifier: MIT
#include "repair/boundary_loops.h"

#include <unordered_map>

#include "geometry/triangle.h"

namespace sherd {
namespace {

class LoopFinder {
  public:
    LoopFinder(const MeshTopology& topology, std::span<const std::array<uint32_t, 3>> triangles)
        : topology_(topology), triangles_(triangles), done_(3 * triangles.size(), 0) {}

    std::vector<BoundaryLoop> run() {
        for (uint32_t h = 0; h < done_.size(); ++h) {
            if (done_[h] == 0 && isBorder(h)) walk(h);
        }
        return std::move(loops_);
    }

  private:
    bool isBorder(uint32_t h) const {
        return topology_.degenerate[h / 3] == 0 && topology_.opposite[h] == kNone;
    }
    uint32_t startOf(uint32_t h) const { return triangles_[h / 3][h % 3]; }

    /// The border half edge that leaves the fan into which h leads.
    uint32_t after(uint32_t h) const {
        uint32_t e = nextCorner(h);
        while (topology_.opposite[e] != kNone) e = nextCorner(topology_.opposite[e]);
        return e;
    }

    /// Follows the border fan by fan; whenever it comes back to a vertex, what lies between is a
    /// loop. At a vertex of several fans this also parts holes that the walk runs into one.
    void walk(uint32_t first) {
        BoundaryLoop path;
        std::unordered_map<uint32_t, size_t> at;  // vertex -> where the path leaves it
        for (uint32_t h = first; done_[h] == 0; h = after(h)) {
            if (const auto seen = at.find(startOf(h)); seen != at.end())
                cut(seen->second, path, at);
            done_[h] = 1;
            at.emplace(startOf(h), path.size());
            path.push_back(h);
        }
        cut(0, path, at);
    }

    void cut(size_t from, BoundaryLoop& path, std::unordered_map<uint32_t, size_t>& at) {
        for (size_t i = from; i < path.size(); ++i) at.erase(startOf(path[i]));
        if (from < path.size())
            loops_.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(from), path.end());
        path.resize(from);
    }

    const MeshTopology& topology_;
    std::span<const std::array<uint32_t, 3>> triangles_;
    std::vector<uint8_t> done_;  ///< per half edge
    std::vector<BoundaryLoop> loops_;
};

}  // namespace

std::vector<BoundaryLoop> boundaryLoops(const MeshTopology& topology,
                                        std::span<const std::array<uint32_t, 3>> triangles) {
    return LoopFinder(topology, triangles).run();
}

}  // namespace sherd
