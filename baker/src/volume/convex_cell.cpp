// SPDX-License-Identifier: MIT
#include "volume/convex_cell.h"

#include <algorithm>
#include <cmath>

namespace sherd {

void ConvexCell::start(uint32_t i, const CutBox& box) {
    cell_ = i;
    planes_ = {{{1, 0, 0, -box.low.x}, BoundingPlane::kBox + 0},
               {{-1, 0, 0, box.high.x}, BoundingPlane::kBox + 1},
               {{0, 1, 0, -box.low.y}, BoundingPlane::kBox + 2},
               {{0, -1, 0, box.high.y}, BoundingPlane::kBox + 3},
               {{0, 0, 1, -box.low.z}, BoundingPlane::kBox + 4},
               {{0, 0, -1, box.high.z}, BoundingPlane::kBox + 5}};
    corners_.clear();
    used_.clear();
    for (uint32_t k = 0; k < 8; ++k) {
        const uint32_t x = k & 1, y = k >> 1 & 1, z = k >> 2;
        corners_.push_back({{x, 2 + y, 4 + z},
                            {x == 0 ? box.low.x : box.high.x, y == 0 ? box.low.y : box.high.y,
                             z == 0 ? box.low.z : box.high.z}});
        used_.push_back(k);
    }
    faces_.resize(6);
    const std::array<std::array<uint32_t, 4>, 6> loops{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (uint32_t f = 0; f < 6; ++f) {
        faces_[f].plane = f;
        faces_[f].loop.assign(loops[f].begin(), loops[f].end());
    }
}

int ConvexCell::sideOf(const Corner& corner, const BoundingPlane& plane) const {
    const LinearFunction& f = plane.function;
    const double x = static_cast<double>(f.x), y = static_cast<double>(f.y),
                 z = static_cast<double>(f.z), c = static_cast<double>(f.c);
    const double value = x * corner.position.x + y * corner.position.y + z * corner.position.z + c;
    // The corner is off by 2^-25 per axis; the terms, below 2^55 and 2^57, by 2^-52 of their size.
    const double bound =
        0x1p-25 * (std::abs(x) + std::abs(y) + std::abs(z)) +
        0x1p-50 * (0x1p26 * (std::abs(x) + std::abs(y) + std::abs(z)) + std::abs(c));
    if (value > bound) return 1;
    if (value < -bound) return -1;
    return signAtPlaneCorner(
        {&planes_[corner.planes[0]], &planes_[corner.planes[1]], &planes_[corner.planes[2]]}, plane,
        cell_);
}

bool ConvexCell::clip(const LinearFunction& plane, uint32_t l) {
    const BoundingPlane added{plane, l};
    kept_.assign(corners_.size(), 0);
    size_t kept = 0;
    for (const uint32_t v : used_) {
        kept_[v] = sideOf(corners_[v], added) > 0 ? 1 : 0;
        kept += kept_[v];
    }
    if (kept == used_.size()) return false;
    if (kept == 0) {
        faces_.clear();
        used_.clear();
        return true;
    }
    planes_.push_back(added);
    made_.clear();
    rim_.clear();
    for (Face& face : faces_) clipFace(face);
    std::erase_if(faces_, [](const Face& face) { return face.loop.empty(); });
    closeFace();
    std::erase_if(used_, [this](uint32_t v) { return kept_[v] == 0; });
    for (const NewCorner& n : made_) used_.push_back(n.corner);
    return true;
}

void ConvexCell::clipFace(Face& face) {
    loop_.clear();
    uint32_t leaving = 0, entering = 0;
    bool cut = false;
    const size_t n = face.loop.size();
    for (size_t k = 0; k < n; ++k) {
        const uint32_t a = face.loop[k];
        const uint32_t b = face.loop[(k + 1) % n];
        const bool staysA = kept_[a] != 0, staysB = kept_[b] != 0;
        if (staysA) loop_.push_back(a);
        if (staysA == staysB) continue;
        const uint32_t corner = cornerOnEdge(a, b, face.plane);
        loop_.push_back(corner);
        (staysA ? leaving : entering) = corner;
        cut = true;
    }
    if (cut) rim_.emplace_back(entering, leaving);
    std::swap(face.loop, loop_);
}

/// Where the new plane cuts the edge a b of a face; the same from the edge's other face.
uint32_t ConvexCell::cornerOnEdge(uint32_t a, uint32_t b, uint32_t face) {
    uint32_t other = face;
    for (const uint32_t p : corners_[a].planes) {
        const auto& q = corners_[b].planes;
        if (p != face && (p == q[0] || p == q[1] || p == q[2])) other = p;
    }
    const std::pair<uint32_t, uint32_t> edge = std::minmax(face, other);
    for (const NewCorner& n : made_)
        if (n.edge == edge) return n.corner;
    const auto id = static_cast<uint32_t>(corners_.size());
    const auto last = static_cast<uint32_t>(planes_.size()) - 1;
    corners_.push_back(
        {{edge.first, edge.second, last},
         planeCorner({&planes_[edge.first], &planes_[edge.second], &planes_[last]})});
    made_.push_back({edge, id});
    return id;
}

/// The new face from the edges the cut faces left open.
void ConvexCell::closeFace() {
    Face face;
    face.plane = static_cast<uint32_t>(planes_.size()) - 1;
    uint32_t at = rim_[0].first;
    do {
        face.loop.push_back(at);
        const auto next =
            std::find_if(rim_.begin(), rim_.end(), [at](const auto& e) { return e.first == at; });
        at = next->second;
    } while (at != rim_[0].first);
    faces_.push_back(std::move(face));
}

}  // namespace sherd
