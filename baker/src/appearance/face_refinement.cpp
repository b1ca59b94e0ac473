// SPDX-License-Identifier: MIT
// All parts of an edge are made at once, not by halving again and again: halving makes 3 thin faces
// of one for every halving of its length, where 2 are enough, and every cut of a broad face cuts
// its neighbours anew (tried: 15 times the faces where 4 times are enough).
#include "appearance/face_refinement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <unordered_set>

#include "geometry/triangle.h"
#include "geometry/weld.h"

namespace sherd {
namespace {

/// Vertices along a side, both ends included.
using Chain = std::vector<uint32_t>;

uint64_t keyOf(uint32_t a, uint32_t b) {
    return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

Chain reversed(Chain chain) {
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// Every decision below depends on ids and lengths alone, not on which way round a face is seen.
/// What becomes of an edge depends on the places of its ends: where an object touches itself or is
/// made of several solids, one side of a piece's edge may have other vertices there than the other.
class FaceRefiner {
  public:
    FaceRefiner(const SplitSurface& surface, double longest, size_t mostFaces, HiddenMesh& mesh)
        : longest_(longest), mostFaces_(mostFaces), mesh_(mesh) {
        std::vector<glm::vec3> places;
        placeOf_ = PositionWelder(places).add(mesh.positions);
        // Vertices on the skin have the same ids as in the split surface.
        for (const SplitTriangle& triangle : surface.triangles)
            for (size_t k = 0; k < 3; ++k)
                skin_.insert(keyOf(placeOf(triangle.v[k]), placeOf(triangle.v[(k + 1) % 3])));
    }

    double run() {
        while (estimate() > static_cast<double>(mostFaces_)) longest_ *= kCoarser;
        std::vector<HiddenMesh::Face> coarse;
        coarse.swap(mesh_.faces);
        for (const HiddenMesh::Face& face : coarse) {
            face_ = &face;
            cut({chainOf(face.v[0], face.v[1]), chainOf(face.v[1], face.v[2]),
                 chainOf(face.v[2], face.v[0])});
        }
        return longest_;
    }

  private:
    static constexpr double kCoarser = 1.25;

    double lengthOf(uint32_t a, uint32_t b) const {
        return glm::distance(glm::dvec3(mesh_.positions[a]), glm::dvec3(mesh_.positions[b]));
    }

    /// Equal for all vertices in one place; those made here are alone in theirs.
    uint32_t placeOf(uint32_t v) const { return v < placeOf_.size() ? placeOf_[v] : v; }

    /// In how many parts an edge is to be.
    double partsOf(uint32_t a, uint32_t b) const {
        const double parts = std::ceil(lengthOf(a, b) / longest_);
        return parts > 1 && !skin_.contains(keyOf(placeOf(a), placeOf(b))) ? parts : 1;
    }

    /// How many faces there will be, about.
    double estimate() const {
        double faces = 0;
        for (const HiddenMesh::Face& face : mesh_.faces) {
            faces += 1;
            double least = longest_;
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = face.v[k];
                const uint32_t b = face.v[(k + 1) % 3];
                least = std::min(least, lengthOf(a, b));
                faces += partsOf(a, b) - 1;
            }
            // A broad face gets points inside: triangles with sides of 0.85 of the length.
            if (least == longest_)
                faces += triangleArea(mesh_.positions, face.v) / (0.3 * longest_ * longest_);
        }
        return faces;
    }

    Chain chainOf(uint32_t a, uint32_t b) {
        const double parts = partsOf(a, b);
        if (parts == 1) return {a, b};
        const auto [it, isNew] = chains_.try_emplace(keyOf(a, b));
        if (isNew) {
            Chain& chain = it->second;
            const bool upwards = placeOf(a) < placeOf(b);
            const uint32_t first = upwards ? a : b, last = upwards ? b : a;
            const glm::dvec3 low = mesh_.positions[first], high = mesh_.positions[last];
            chain.push_back(first);
            for (uint32_t i = 1; i < static_cast<uint32_t>(parts); ++i) {
                chain.push_back(static_cast<uint32_t>(mesh_.positions.size()));
                mesh_.positions.emplace_back(low + (high - low) * (i / parts));
            }
            chain.push_back(last);
        }
        return it->second.front() == a ? it->second : reversed(it->second);
    }

    static bool isDivided(const Chain& chain) { return chain.size() > 2; }

    /// From corner k to corner k + 1 runs sides[k].
    void cut(const std::array<Chain, 3>& sides) {
        size_t divided = 0;
        size_t whole = 0;
        for (size_t k = 0; k < 3; ++k) {
            if (isDivided(sides[k]))
                ++divided;
            else
                whole = k;
        }
        if (divided == 3) return cutInFour(sides);
        const Chain& base = sides[whole];
        const Chain& left = sides[(whole + 1) % 3];
        const Chain& right = sides[(whole + 2) % 3];
        if (divided == 2 && lengthOf(base[0], base[1]) > longest_)
            return cutInRows(base, left, right);
        if (divided == 0) return add(sides[0][0], sides[1][0], sides[2][0]);
        zip(reversed(left), right);
    }

    /// A chain's two halves, at the same vertex whichever way it runs.
    static std::array<Chain, 2> halves(const Chain& chain) {
        const auto parts = static_cast<std::ptrdiff_t>(chain.size()) - 1;
        const std::ptrdiff_t middle = chain.front() < chain.back() ? parts / 2 : parts - parts / 2;
        return {Chain(chain.begin(), chain.begin() + middle + 1),
                Chain(chain.begin() + middle, chain.end())};
    }

    void cutInFour(const std::array<Chain, 3>& sides) {
        std::array<std::array<Chain, 2>, 3> half;
        std::array<uint32_t, 3> middle{};
        for (size_t k = 0; k < 3; ++k) {
            half[k] = halves(sides[k]);
            middle[k] = half[k][1].front();
        }
        for (size_t k = 0; k < 3; ++k) {
            const size_t last = (k + 2) % 3;
            cut({half[k][0], chainOf(middle[k], middle[last]), half[last][1]});
        }
        cut({chainOf(middle[0], middle[1]), chainOf(middle[1], middle[2]),
             chainOf(middle[2], middle[0])});
    }

    /// Above a side that must stay whole but is long: in rows along it. `left` goes from its end up
    /// to the corner across, `right` from there down to its start.
    void cutInRows(const Chain& base, const Chain& left, const Chain& right) {
        const bool mirrored = base.front() > base.back();
        const Chain down = mirrored ? reversed(left) : right;  // to the lower end of the side
        const Chain other = mirrored ? right : reversed(left);
        const size_t rows = std::min(down.size(), other.size()) - 1;
        const auto at = [rows](const Chain& chain, size_t row) {
            return static_cast<std::ptrdiff_t>(row * (chain.size() - 1) / rows);
        };
        const auto part = [&](const Chain& chain, size_t row) {
            return Chain(chain.begin() + at(chain, row - 1), chain.begin() + at(chain, row) + 1);
        };
        Chain above;
        for (size_t row = 1; row <= rows; ++row) {
            const Chain a = part(down, row);
            const Chain b = part(other, row);
            // The side itself may be a part of a longer one: it is not to be divided once more.
            Chain below =
                row == rows ? (mirrored ? reversed(base) : base) : chainOf(a.back(), b.back());
            if (row == 1) {
                cut(mirrored ? std::array{b, reversed(below), reversed(a)}
                             : std::array{a, below, reversed(b)});
            } else {
                cutRow(above, b, a, below, mirrored);
            }
            above = std::move(below);
        }
    }

    /// A stripe. From one corner two chains go around it to the corner across: `above` and then
    /// `far`, `near` and then `below`.
    void cutRow(Chain above, const Chain& far, Chain near, const Chain& below, bool mirrored) {
        above.insert(above.end(), far.begin() + 1, far.end());
        near.insert(near.end(), below.begin() + 1, below.end());
        zip(above, near, mirrored);
    }

    /// Triangles between two chains from one corner to another one or to a side, always along the
    /// shorter of the two next diagonals; of equal ones that of the lower key.
    void zip(const Chain& left, const Chain& right, bool mirrored = false) {
        const bool closed = left.back() == right.back();
        const size_t lastLeft = left.size() - (closed ? 2 : 1);
        const size_t lastRight = right.size() - (closed ? 2 : 1);
        const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
            mirrored ? add(a, c, b) : add(a, b, c);
        };
        triangle(right[0], right[1], left[1]);
        size_t l = 1;
        size_t r = 1;
        while (l < lastLeft || r < lastRight) {
            bool onLeft = r == lastRight;
            if (!onLeft && l < lastLeft) {
                const double lefts = lengthOf(left[l + 1], right[r]);
                const double rights = lengthOf(left[l], right[r + 1]);
                const bool lower = keyOf(left[l + 1], right[r]) < keyOf(left[l], right[r + 1]);
                onLeft = lefts < rights || (lefts == rights && lower);
            }
            triangle(right[r], onLeft ? left[l + 1] : right[r + 1], left[l]);
            ++(onLeft ? l : r);
        }
        if (closed) triangle(right[r], right[r + 1], left[l]);
    }

    void add(uint32_t a, uint32_t b, uint32_t c) {
        HiddenMesh::Face part = *face_;
        part.v = {a, b, c};
        mesh_.faces.push_back(part);
    }

    double longest_;
    size_t mostFaces_;
    HiddenMesh& mesh_;
    const HiddenMesh::Face* face_ = nullptr;  ///< that is being cut
    std::vector<uint32_t> placeOf_;           ///< per vertex that was there before
    std::unordered_set<uint64_t> skin_;  ///< looked up only, like chains_: order does not matter
    std::unordered_map<uint64_t, Chain> chains_;  ///< of divided edges, from the lower place on
};

}  // namespace

double refineFaces(const SplitSurface& surface, double longest, size_t mostFaces,
                   HiddenMesh& mesh) {
    return FaceRefiner(surface, longest, mostFaces, mesh).run();
}

}  // namespace sherd
