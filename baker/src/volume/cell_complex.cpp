// SPDX-License-Identifier: MIT
#include "volume/cell_complex.h"

#include <algorithm>
#include <cmath>

#include "volume/cell_search.h"

namespace sherd {

CellComplex::CellComplex(const CellFunctions& functions, const CutBox& box, double band)
    : functions_(functions) {
    CellSearch search(functions, box);
    start_.assign(functions.count() + 1, 0);
    bool some = false;
    for (uint32_t i = 0; i < functions.count(); ++i) {
        const ConvexCell& cell = search.cell(i);
        if (!cell.empty()) {
            add(i, cell);
            if (!some) someCell_ = i;
            some = true;
        }
        start_[i + 1] = static_cast<uint32_t>(neighbors_.size());
        for (const uint32_t l : neighbors(i))
            band_.push_back(std::llround(band * slopeOf(functions[l] - functions[i])));
    }
}

void CellComplex::add(uint32_t i, const ConvexCell& cell) {
    vertexOfCorner_.resize(std::max(vertexOfCorner_.size(), cell.corners().size()));
    for (const uint32_t c : cell.usedCorners()) vertexOfCorner_[c] = vertexOf(i, cell, c);
    const auto first = static_cast<int64_t>(neighbors_.size());
    for (const ConvexCell::Face& face : cell.faces()) {
        const BoundingPlane& plane = cell.planes()[face.plane];
        if (plane.isBox()) continue;
        neighbors_.push_back(plane.index);
        if (plane.index > i) addEdges(i, cell, face);
    }
    std::sort(neighbors_.begin() + first, neighbors_.end());
}

uint32_t CellComplex::vertexOf(uint32_t i, const ConvexCell& cell, uint32_t corner) {
    const ConvexCell::Corner& c = cell.corners()[corner];
    KeyTable::Key key{i, cell.planes()[c.planes[0]].index, cell.planes()[c.planes[1]].index,
                      cell.planes()[c.planes[2]].index};
    std::sort(key.begin(), key.end());
    const auto [vertex, isNew] = vertexIndex_.add(key);
    if (isNew) vertices_.push_back({key, c.position});
    return vertex;
}

/// Those of the face i|j to cells beyond j: every edge is added once.
void CellComplex::addEdges(uint32_t i, const ConvexCell& cell, const ConvexCell::Face& face) {
    const uint32_t j = cell.planes()[face.plane].index;
    for (size_t n = 0; n < face.loop.size(); ++n) {
        const uint32_t from = face.loop[n];
        const uint32_t to = face.loop[(n + 1) % face.loop.size()];
        for (const uint32_t p : cell.corners()[from].planes) {
            const auto& q = cell.corners()[to].planes;
            const BoundingPlane& plane = cell.planes()[p];
            if (p == face.plane || (p != q[0] && p != q[1] && p != q[2])) continue;
            if (plane.isBox() || plane.index < j) continue;
            edgeIndex_.add({i, j, plane.index});
            edges_.push_back({{i, j, plane.index}, vertexOfCorner_[from], vertexOfCorner_[to]});
        }
    }
}

uint32_t CellComplex::faceOf(uint32_t low, uint32_t high) const {
    const auto all = neighbors(low);
    const auto it = std::lower_bound(all.begin(), all.end(), high);
    if (it == all.end() || *it != high) return kNone;
    return start_[low] + static_cast<uint32_t>(it - all.begin());
}

CellComplex::Place CellComplex::locate(const CutGridPoint& p, uint32_t from) const {
    Place best{from, false};
    int64_t value = functions_[from].at(p);
    for (bool moved = true; moved;) {
        moved = false;
        best.nearPlane = false;
        for (uint32_t n = start_[best.cell]; n < start_[best.cell + 1]; ++n) {
            const uint32_t l = neighbors_[n];
            const int64_t other = functions_[l].at(p);
            if (other > value || (other == value && l > best.cell)) {
                best.nearPlane = best.nearPlane || other - value <= band_[n];
                continue;
            }
            best.cell = l;
            value = other;
            moved = true;
            break;
        }
    }
    return best;
}

}  // namespace sherd
