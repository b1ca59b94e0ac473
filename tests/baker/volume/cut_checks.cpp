// SPDX-License-Identifier: MIT
#include "cut_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "geometry/bounds.h"
#include "geometry/closed_mesh.h"
#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"

namespace sherd::test {
namespace {

using Triangle = std::array<uint32_t, 3>;

std::string at(const std::string& what, size_t piece) {
    return what + " (piece " + std::to_string(piece) + ")";
}

double extentOf(const CutSolid& cut) {
    const glm::dvec3 size = boundsOf(cut.whole.positions, cut.whole.triangles).size();
    return std::max({size.x, size.y, size.z});
}

/// Farthest coordinate from 0: what floats are rounded by.
double reachOf(const CutSolid& cut) {
    const Bounds b = boundsOf(cut.whole.positions, cut.whole.triangles);
    const glm::dvec3 m = glm::max(glm::abs(b.low), glm::abs(b.high));
    return std::max({m.x, m.y, m.z});
}

/// The value of a cell's function at a place, divided by its extent to compare with.
double functionAt(const CutSolid& cut, uint32_t cell, const glm::dvec3& place) {
    const glm::dvec3 g = cut.grid.toGrid(place);
    const LinearFunction& f = cut.cut.functions[cell];
    return static_cast<double>(f.x) * g.x + static_cast<double>(f.y) * g.y +
           static_cast<double>(f.z) * g.z + static_cast<double>(f.c);
}

double slope(const LinearFunction& f) {
    return glm::length(
        glm::dvec3(static_cast<double>(f.x), static_cast<double>(f.y), static_cast<double>(f.z)));
}

/// How far a place is beyond the nearest plane of a cell, in grid steps; negative: inside by that.
double outsideBy(const CutSolid& cut, uint32_t cell, const glm::dvec3& place) {
    double worst = -1e30;
    for (uint32_t l = 0; l < cut.cut.functions.count(); ++l) {
        const LinearFunction difference = cut.cut.functions[cell] - cut.cut.functions[l];
        const double size = slope(difference);
        if (l == cell) continue;
        if (size == 0) {  // one of the two is never the lowest; of equals the first
            if (difference.c > 0 || (difference.c == 0 && l < cell)) return 1e30;
            continue;
        }
        worst = std::max(worst, (functionAt(cut, cell, place) - functionAt(cut, l, place)) / size);
    }
    return worst;
}

/// The same for the cells of a piece, in the positions' unit. Places near a plane between two of
/// them are near one.
double outsidePiece(const CutSolid& cut, uint32_t piece, const glm::dvec3& place) {
    double least = 1e30, nearest = 1e30;
    for (uint32_t cell = 0; cell < cut.cut.cells(); ++cell) {
        if (cut.pieces.pieceOfCell[cell] != piece) continue;
        const double by = outsideBy(cut, cell, place) * cut.grid.step();
        least = std::min(least, by);
        nearest = std::min(nearest, std::abs(by));
    }
    return least < 0 ? std::max(least, -nearest) : least;
}

glm::dvec3 areaVector(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return 0.5 * glm::cross(b - a, c - a);
}

using Corners = std::array<std::array<float, 3>, 3>;

/// Begun at its lowest corner.
Corners cornersOf(const CutSolid& cut, const PieceMesh& piece, const Triangle& t, bool turned) {
    Corners c{};
    for (size_t k = 0; k < 3; ++k) {
        const glm::vec3& p = cut.cut.positions[piece.vertices[t[turned ? 2 - k : k]]];
        c[k] = {p.x, p.y, p.z};
    }
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
}

}  // namespace

bool cutSolid(const Solid& whole, std::vector<CellFamily> families, CutSolid& result,
              std::string& wrong) {
    const Result<CutGrid> grid = CutGrid::around(whole.positions, whole.triangles);
    Result<CellFunctions> functions = CellFunctions::of(std::move(families));
    if (!grid || !functions) {
        wrong = grid ? functions.error().message : grid.error().message;
        return false;
    }
    Result<MeshCut> cut = cutMesh(whole.positions, whole.triangles, *grid, *functions);
    if (!cut) {
        wrong = cut.error().message;
        return false;
    }
    CutPieces pieces = assemblePieces(*cut);
    result = {whole, *grid, std::move(*cut), std::move(pieces)};
    return true;
}

std::string brokenClosed(const CutSolid& cut) {
    for (size_t p = 0; p < cut.pieces.pieces.size(); ++p) {
        const PieceMesh& piece = cut.pieces.pieces[p];
        const ClosedReport ids = proveByIds(piece.triangles);
        if (!ids.manifold()) {
            return at("not closed: " + std::to_string(ids.openEdges) + " open edges, " +
                          std::to_string(ids.repeatedEdges) + " repeated, " +
                          std::to_string(ids.splitFans) + " fans",
                      p);
        }
        const std::vector<glm::vec3> positions = piece.positions(cut.cut);
        if (!proveByPositions(positions, piece.triangles).closed())
            return at("open over positions", p);
        if (!(signedVolume(positions, piece.triangles, positions[0]) > 0))
            return at("without volume", p);
    }
    return "";
}

std::string brokenSharing(const CutSolid& cut) {
    std::map<std::pair<uint32_t, Corners>, int> uses;  // by cap
    for (uint32_t p = 0; p < cut.pieces.pieces.size(); ++p) {
        const PieceMesh& piece = cut.pieces.pieces[p];
        for (size_t t = 0; t < piece.triangles.size(); ++t) {
            if (!piece.origins[t].cap) continue;
            const auto cap = std::find_if(
                cut.cut.caps.begin(), cut.cut.caps.end(),
                [&](const MeshCut::Cap& c) { return piece.origins[t].index - c.first < c.count; });
            if (cap == cut.cut.caps.end()) return at("a triangle of no cap", p);
            const bool high = p == cut.pieces.pieceOfCell[cap->high];
            if (high == (p == cut.pieces.pieceOfCell[cap->low])) return at("a strange cap", p);
            uses[{static_cast<uint32_t>(cap - cut.cut.caps.begin()),
                  cornersOf(cut, piece, piece.triangles[t], high)}] += high ? -1 : 1;
        }
    }
    for (const auto& [key, sum] : uses)
        if (sum != 0) return "a cap differs between its two pieces";
    return "";
}

std::string brokenVolume(const CutSolid& cut) {
    const glm::dvec3 middle = boundsOf(cut.whole.positions, cut.whole.triangles).middle();
    const double whole = signedVolume(cut.whole.positions, cut.whole.triangles, middle);
    double sum = 0;
    for (const PieceMesh& piece : cut.pieces.pieces)
        sum += signedVolume(piece.positions(cut.cut), piece.triangles, middle);
    const double extent = extentOf(cut);
    // Thin solids far from 0 lose by rounding alone.
    const double rounding = 1e-6 * reachOf(cut) * extent * extent;
    if (std::abs(sum - whole) <= 1e-6 * std::abs(whole) + 1e-3 * rounding) return "";
    return "volumes add up to " + std::to_string(sum / whole) + " of the whole";
}

std::string brokenPlaces(const CutSolid& cut) {
    const double bound = 4e-7 * (reachOf(cut) + extentOf(cut));
    for (uint32_t cell = 0; cell < cut.cut.cells(); ++cell) {
        for (const MeshCut::SkinTriangle& t : cut.cut.skinOf(cell)) {
            const Triangle& source = cut.whole.triangles[t.source];
            for (size_t k = 0; k < 3; ++k) {
                glm::dvec3 w(0);
                w[static_cast<int>(k)] = 1;
                if (t.weights != MeshCut::kWhole) w = cut.cut.weights[t.weights][k];
                if (!(std::abs(w.x + w.y + w.z - 1) < 1e-9) || !(w.x > -1e-9) || !(w.y > -1e-9) ||
                    !(w.z > -1e-9)) {
                    return at("weights that are none", cell);
                }
                glm::dvec3 place(0);
                for (size_t n = 0; n < 3; ++n)
                    place += w[static_cast<int>(n)] * glm::dvec3(cut.whole.positions[source[n]]);
                if (glm::distance(place, glm::dvec3(cut.cut.positions[t.v[k]])) > bound)
                    return at("a corner is not where its weights say", cell);
            }
        }
    }
    for (uint32_t p = 0; p < cut.pieces.pieces.size(); ++p) {
        for (const uint32_t v : cut.pieces.pieces[p].vertices) {
            if (outsidePiece(cut, p, cut.cut.positions[v]) > bound)
                return at("a vertex outside its cells", p);
        }
    }
    return "";
}

std::string brokenSkin(const CutSolid& cut) {
    std::vector<glm::dvec3> sums(cut.whole.triangles.size(), glm::dvec3(0));
    for (const MeshCut::SkinTriangle& t : cut.cut.skin) {
        const auto& p = cut.cut.positions;
        sums[t.source] += areaVector(p[t.v[0]], p[t.v[1]], p[t.v[2]]);
    }
    const double bound = 1e-6 * (reachOf(cut) + extentOf(cut)) * extentOf(cut);
    for (size_t t = 0; t < sums.size(); ++t) {
        const auto& [a, b, c] = cut.whole.triangles[t];
        const auto& p = cut.whole.positions;
        if (glm::distance(sums[t], areaVector(p[a], p[b], p[c])) > bound)
            return "the parts of triangle " + std::to_string(t) + " are not the whole";
    }
    return "";
}

std::string brokenCoverage(const CutSolid& cut, Random& random, uint32_t points) {
    const InsideTest whole(cut.whole.positions, cut.whole.triangles);
    const TriangleBvh skin(cut.whole.positions, cut.whole.triangles);
    std::vector<InsideTest> pieces;
    for (const PieceMesh& piece : cut.pieces.pieces)
        pieces.emplace_back(piece.positions(cut.cut), piece.triangles);
    const Bounds box = boundsOf(cut.whole.positions, cut.whole.triangles);
    const double tight = 1e-6 * (extentOf(cut) + reachOf(cut));
    for (uint32_t n = 0; n < points; ++n) {
        glm::dvec3 place;
        for (int k = 0; k < 3; ++k) place[k] = random.in(box.low[k], box.high[k]);
        if (skin.closest(place, tight).triangle != ClosestPoint::kNone) continue;
        const int there = whole.winding(place);
        for (uint32_t p = 0; p < pieces.size(); ++p) {
            const double by = outsidePiece(cut, p, place);
            if (std::abs(by) < tight) continue;
            const int expected = by < 0 ? there : 0;
            const int found = pieces[p].winding(place);
            if (found == expected) continue;
            return at("a point is in it " + std::to_string(found) + " times, not " +
                          std::to_string(expected),
                      p);
        }
    }
    return "";
}

std::string whatBreaks(const CutSolid& cut, Random& random, uint32_t points) {
    for (const std::string& wrong :
         {brokenClosed(cut), brokenSharing(cut), brokenVolume(cut), brokenPlaces(cut),
          brokenSkin(cut), brokenCoverage(cut, random, points)}) {
        if (!wrong.empty()) return wrong;
    }
    return "";
}

}  // namespace sherd::test
