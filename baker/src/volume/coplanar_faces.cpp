// SPDX-License-Identifier: MIT
#include "volume/coplanar_faces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace sherd {
namespace {

double areaOf(const std::vector<uint32_t>& corners, const CutVertices& vertices) {
    glm::dvec3 sum(0);
    for (size_t k = 1; k + 1 < corners.size(); ++k) {
        const glm::dvec3& a = vertices.gridPosition(corners[0]);
        sum += glm::cross(vertices.gridPosition(corners[k]) - a,
                          vertices.gridPosition(corners[k + 1]) - a);
    }
    return 0.5 * glm::length(sum);
}

glm::dvec3 normalOf(const CutInput& input, uint32_t triangle) {
    const auto corner = [&](size_t k) {
        const CutGridPoint& p = input.points[input.triangles[triangle][k]];
        return glm::dvec3(p.x, p.y, p.z);
    };
    return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
}

/// Whether all corners of a triangle are within the band of where a function is 0. A little more
/// than that, for cells that differ in one family are within it to the rounding.
bool liesIn(const CutInput& input, uint32_t triangle, const LinearFunction& f) {
    const double most = kCoplanarBand * input.grid.extent() / input.grid.step() * slopeOf(f);
    const auto& v = input.triangles[triangle];
    return std::all_of(v.begin(), v.end(), [&](uint32_t corner) {
        return std::abs(static_cast<double>(f.at(input.points[corner]))) <= most;
    });
}

/// Member `inner` of a family is to win from `outer`; area in all, less what wants it otherwise.
struct Wish {
    uint32_t inner, outer;
    double area;
};

/// Which members gain: a graph without circles, the largest areas first, and then for each the
/// longest way down.
class Gains {
  public:
    Gains(const CellFamily& family, std::vector<Wish> wishes, double shift)
        : family_(family),
          shift_(shift),
          outerOf_(family.functions.size()),
          gain_(family.functions.size(), -1) {
        std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
            return a.area != b.area ? a.area > b.area
                                    : std::pair(a.inner, a.outer) < std::pair(b.inner, b.outer);
        });
        for (const Wish& w : wishes) {
            if (reaches(w.outer, w.inner))
                ++refused;
            else
                outerOf_[w.inner].push_back(w.outer);
        }
    }

    int64_t of(uint32_t member) {
        if (gain_[member] >= 0) return gain_[member];
        int64_t most = 0;
        for (const uint32_t outer : outerOf_[member]) {
            const double slope = slopeOf(family_.functions[member] - family_.functions[outer]);
            most = std::max(most, of(outer) + int64_t{std::llround(std::ceil(shift_ * slope))});
        }
        return gain_[member] = most;
    }

    uint32_t refused = 0;

  private:
    bool reaches(uint32_t from, uint32_t to) const {
        std::vector<uint32_t> open{from};
        std::vector<uint8_t> seen(outerOf_.size(), 0);
        while (!open.empty()) {
            const uint32_t m = open.back();
            open.pop_back();
            if (m == to) return true;
            for (const uint32_t o : outerOf_[m]) {
                if (seen[o] != 0) continue;
                seen[o] = 1;
                open.push_back(o);
            }
        }
        return false;
    }

    const CellFamily& family_;
    double shift_;
    std::vector<std::vector<uint32_t>> outerOf_;
    std::vector<int64_t> gain_;
};

void moveSlabs(CellFamily& family, const std::vector<Wish>& wishes, double shift) {
    const CellFamily before = family;
    for (const Wish& w : wishes) {
        const uint32_t upper = std::max(w.inner, w.outer);
        if (upper - std::min(w.inner, w.outer) != 1) continue;
        const LinearFunction plane = before.functions[upper] - before.functions[upper - 1];
        const int64_t by = std::llround(std::ceil(shift * slopeOf(plane)));
        for (size_t k = upper; k < family.functions.size(); ++k)
            family.functions[k].c += w.outer == upper ? by : -by;
    }
}

}  // namespace

void addCoplanarFaces(const CutInput& input, uint32_t triangle, const TriangleCells::Polygon& part,
                      const CutVertices& vertices, std::vector<CoplanarFace>& faces) {
    const auto& families = input.functions.families();
    const double area = areaOf(part.corners, vertices);
    for (const uint32_t l : part.coplanar) {
        for (size_t f = 0; f < families.size(); ++f) {
            const uint32_t a = input.functions.member(part.cell, f);
            const uint32_t b = input.functions.member(l, f);
            const LinearFunction ab = families[f].functions[a] - families[f].functions[b];
            if (a == b || !liesIn(input, triangle, ab)) continue;
            const double outwards =
                glm::dot(normalOf(input, triangle),
                         glm::dvec3(static_cast<double>(ab.x), static_cast<double>(ab.y),
                                    static_cast<double>(ab.z)));
            if (outwards > 0) faces.push_back({f, a, b, area});
            if (outwards < 0) faces.push_back({f, b, a, area});
        }
    }
}

MovedPlanes movePlanes(const CellFunctions& functions, const std::vector<CoplanarFace>& faces,
                       double extentInSteps) {
    MovedPlanes result{functions.families(), 0, 0};
    const double shift = kCoplanarShift * extentInSteps;
    std::vector<std::map<std::pair<uint32_t, uint32_t>, double>> areas(result.families.size());
    for (const CoplanarFace& face : faces)
        areas[face.family][{face.inner, face.outer}] += face.area;
    for (size_t f = 0; f < result.families.size(); ++f) {
        std::vector<Wish> wishes;
        for (const auto& [pair, area] : areas[f]) {
            const auto other = areas[f].find({pair.second, pair.first});
            const double against = other == areas[f].end() ? 0 : other->second;
            if (against > 0 && pair.first < pair.second) ++result.opposed;
            if (area > against || (area == against && pair.first < pair.second))
                wishes.push_back({pair.first, pair.second, area - against});
        }
        result.moved += static_cast<uint32_t>(wishes.size());
        if (result.families[f].slabs) {
            moveSlabs(result.families[f], wishes, shift);
            continue;
        }
        Gains gains(functions.families()[f], wishes, shift);
        result.opposed += gains.refused;
        result.moved -= gains.refused;
        for (uint32_t m = 0; m < result.families[f].functions.size(); ++m)
            result.families[f].functions[m].c -= gains.of(m);
    }
    return result;
}

}  // namespace sherd
