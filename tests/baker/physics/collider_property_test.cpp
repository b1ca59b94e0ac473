// SPDX-License-Identifier: MIT
// What geometry asks of colliders, on random objects broken at random, judged by brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <string>

#include "sherd/baker/bake.h"
#include "support/collider_oracle.h"
#include "support/property.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr double kDeepest = 1e-5;     ///< of the diagonal: how far what must not overlap may
constexpr double kCoverage = 0.9;     ///< of a convex piece
constexpr double kMedian = 0.7;       ///< of a level's pieces
constexpr double kBare = 0.03;        ///< of a convex piece's size, or
constexpr double kBareMetres = 2e-3;  ///< that
constexpr double kThinnest = 0.1;     ///< of a hull's extent: its margin

/// Straight through along random lines, which end in a frame: pieces that clasp each other.
VolumeCut drawn(Random& random) {
    auto map = std::make_shared<FractureMap>();
    map->lines.emplace_back().points = {
        {-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}, {-0.1, -0.1}};
    for (const bool upright : {true, false}) {
        FractureMap::Line line;
        for (int k = 0; k <= 4; ++k) {
            const double along = -0.1 + 0.3 * k, across = random.in(0.1, 0.9);
            line.points.push_back(upright ? glm::dvec2(across, along) : glm::dvec2(along, across));
        }
        map->lines.push_back(std::move(line));
    }
    VolumeCut cut;
    cut.kind = VolumeCut::Kind::map;
    cut.drawing = map;
    return cut;
}

/// One or two levels, of about 12 pieces at most.
FracturePlan randomPlan(Random& random) {
    const std::string seed = ":" + std::to_string(random.below(1000));
    const auto count = [&](uint32_t most) { return std::to_string(2 + random.below(most - 1)); };
    FracturePlan plan;
    const auto cut = [&](const std::string& text) {
        plan.cuts.push_back(parseVolumeCut(text).value());
    };
    switch (random.below(7)) {
        case 0:
            cut("grid:" + count(12) + seed);
            break;
        case 1:
            cut("slices:2x" + count(3) + "x2" + seed + ":jitter=0.5:tilt=0.4");
            break;
        case 2:
            cut("glass:" + count(4) + "x3" + seed);
            break;
        case 3:
            cut("voronoi:3" + seed);
            cut("voronoi:4" + seed);
            break;
        case 4:
            plan.cuts.push_back(drawn(random));
            break;
        default:
            cut("voronoi:" + count(12) + seed);
    }
    return plan;
}

bool isPartOf(const FractureSet& set, uint32_t fragment, uint32_t whole) {
    for (auto f = static_cast<int32_t>(fragment); f >= 0;
         f = set.fragments[static_cast<size_t>(f)].parent)
        if (f == static_cast<int32_t>(whole)) return true;
    return false;
}

struct Found {
    uint32_t cases = 0, pieces = 0, convex = 0, several = 0, pairs = 0;
};

class Judge {
  public:
    Judge(const FractureSet& set, Random& random) : set_(set), random_(random) {
        for (uint32_t f = 0; f < set.fragments.size(); ++f) {
            pieces_.emplace_back(set, f);
            colliders_.push_back(colliderOf(set, f));
        }
        diagonal_ = glm::distance(pieces_[0].low(), pieces_[0].high());
    }

    void overlaps(Found& found) const {
        for (uint32_t a = 0; a < pieces_.size(); ++a) {
            for (uint32_t b = a + 1; b < pieces_.size(); ++b) {
                if (!mayMeet(a, b)) continue;
                ++found.pairs;
                CAPTURE(a);
                CAPTURE(b);
                for (const RoundedHull& mine : colliders_[a])
                    for (const RoundedHull& theirs : colliders_[b])
                        CHECK(apart(mine, theirs, -kDeepest * diagonal_) >= -kDeepest * diagonal_);
            }
        }
    }

    /// A hull and its margin lie in the convex hull of the piece: in no direction do they reach
    /// farther.
    void protrusion() {
        for (uint32_t f = 0; f < pieces_.size(); ++f) {
            CAPTURE(f);
            for (const RoundedHull& hull : colliders_[f]) {
                std::vector<glm::dvec3> directions = hull.normals();
                for (int k = 0; k < 32; ++k) {
                    const double x = random_.in(-1, 1), y = random_.in(-1, 1);
                    directions.push_back(glm::normalize(glm::dvec3(x, y, random_.in(-1, 1.01))));
                }
                double most = 0;
                for (const glm::dvec3& d : directions)
                    most = std::max(most, hull.reach(d) + hull.margin() - pieces_[f].reach(d));
                CHECK(most <= kDeepest * diagonal_);
            }
        }
    }

    void margins(const PhysicsSettings& settings) const {
        for (uint32_t f = 0; f < pieces_.size(); ++f) {
            CAPTURE(f);
            CHECK(colliders_[f].size() >= 1);
            CHECK(colliders_[f].size() <= settings.convexParts);
            for (const RoundedHull& hull : colliders_[f]) {
                CHECK(hull.margin() >= 0);
                CHECK(hull.margin() <= settings.hullMargin * (1 + 1e-6));
                // Of what is written: corners moved inwards a little more than the margin make it
                // thinner than it was.
                double thinnest = std::numeric_limits<double>::infinity();
                for (const glm::dvec3& n : hull.normals())
                    thinnest = std::min(thinnest, hull.reach(n) + hull.reach(-n));
                CHECK(hull.margin() <= 1.2 * kThinnest * (thinnest + 2 * hull.margin()));
            }
        }
    }

    void coverage(uint32_t level, Found& found) {
        std::vector<double> shares;
        for (const uint32_t f : fragmentsAtLevel(set_, level)) {
            CAPTURE(f);
            ++found.pieces;
            found.several += colliders_[f].size() > 1 ? 1 : 0;
            if (!isConvexAndFree(f)) {
                shares.push_back(covered(f, kPoints));
                continue;
            }
            ++found.convex;
            shares.push_back(covered(f, kConvexPoints));
            const double chance = 4 * std::sqrt(kCoverage * (1 - kCoverage) / kConvexPoints);
            CHECK(shares.back() >= kCoverage - chance);
            CHECK(bare(f) <= std::max(kBareMetres, kBare * pieces_[f].size()));
        }
        if (shares.empty()) return;
        std::sort(shares.begin(), shares.end());
        CHECK(shares[shares.size() / 2] >= kMedian);
    }

  private:
    static constexpr int kPoints = 60, kConvexPoints = 1000;

    /// Neither is part of the other.
    bool mayMeet(uint32_t a, uint32_t b) const {
        return !isPartOf(set_, a, b) && !isPartOf(set_, b, a);
    }

    /// Convex, and no other piece's hull reaches into it: such may take a wall's share of it.
    bool isConvexAndFree(uint32_t f) const {
        const WrittenPiece& piece = pieces_[f];
        const double touch = kDeepest * diagonal_;
        if (piece.bulge() > touch) return false;
        for (uint32_t other = 0; other < pieces_.size(); ++other) {
            if (!mayMeet(f, other)) continue;
            const bool beyondAFace =
                std::any_of(piece.triangles().begin(), piece.triangles().end(), [&](const auto& t) {
                    const glm::dvec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
                    if (!(glm::length(cross) > 1e-6 * piece.size() * piece.size())) return false;
                    const glm::dvec3 n = glm::normalize(cross);
                    return -pieces_[other].reach(-n) >= glm::dot(n, t[0]) - touch;
                });
            if (!beyondAFace) return false;
        }
        return true;
    }

    /// Share of points spread evenly over the piece that are in its collider.
    double covered(uint32_t f, int points) {
        const WrittenPiece& piece = pieces_[f];
        int found = 0, covered = 0;
        for (int tries = 0; tries < 200 * points && found < points; ++tries) {
            const double x = random_.unit(), y = random_.unit(), z = random_.unit();
            const glm::dvec3 p = piece.low() + (piece.high() - piece.low()) * glm::dvec3(x, y, z);
            if (piece.winding(p) < 0.5) continue;
            ++found;
            covered += outside(f, p) <= 1e-9 * diagonal_ ? 1 : 0;
        }
        return found > 0 ? static_cast<double>(covered) / found : 1;
    }

    /// How far the skin lies outside of the collider at most.
    double bare(uint32_t f) const {
        double most = 0;
        for (const glm::dvec3& p : pieces_[f].skin()) most = std::max(most, outside(f, p));
        return most;
    }

    double outside(uint32_t f, const glm::dvec3& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (const RoundedHull& hull : colliders_[f]) {
            least = std::min(least, hull.distance(p));
            if (least <= 0) break;
        }
        return least;
    }

    const FractureSet& set_;
    Random& random_;
    std::vector<WrittenPiece> pieces_;
    std::vector<std::vector<RoundedHull>> colliders_;
    double diagonal_ = 0;
};

}  // namespace

TEST_CASE("the oracle knows how far boxes, balls and crossed edges are apart") {
    const auto box = [](const glm::dvec3& low, double margin) {
        std::vector<glm::dvec3> corners;
        corners.reserve(8);
        for (int k = 0; k < 8; ++k) corners.push_back(low + glm::dvec3(k & 1, k >> 1 & 1, k >> 2));
        return RoundedHull(corners, margin);
    };
    const auto tent = [](double top, bool turned) {  // an edge of length 2 on top of it, or below
        std::vector<glm::dvec3> corners;
        for (const double s : {-1.0, 1.0}) {
            corners.emplace_back(turned ? 0 : s, turned ? s : 0, top);
            for (const double t : {-1.0, 1.0}) corners.emplace_back(s, t, top + (turned ? 2 : -2));
        }
        return RoundedHull(corners, 0.1);
    };
    constexpr double kAll = 1e9;
    CHECK(apart(box({0, 0, 0}, 0), box({0.9, 0.3, 0.2}, 0), kAll) == doctest::Approx(-0.1));
    CHECK(apart(box({0, 0, 0}, 0.1), box({1.3, 0, 0}, 0.1), kAll) == doctest::Approx(0.1));
    CHECK(apart(box({0, 0, 0}, 0.1), box({1.3, 1.4, 0}, 0.1), kAll) == doctest::Approx(0.3));
    CHECK(apart(box({0, 0, 0}, 0.2), box({1.2, 1.2, 1.1}, 0.2), kAll) == doctest::Approx(-0.1));
    CHECK(apart(tent(0, false), tent(0.5, true), kAll) == doctest::Approx(0.3));
    CHECK(apart(tent(0, false), tent(-0.1, true), kAll) == doctest::Approx(-0.3));
    CHECK(box({0, 0, 0}, 0.5).distance({2, 2, 0.5}) == doctest::Approx(std::sqrt(2) - 0.5));
    CHECK(box({0, 0, 0}, 0.5).distance({0.5, 0.5, 1.4}) == 0);
}

TEST_CASE("colliders of random pieces keep apart, stay within them and hold what they must") {
    Found found;
    for (const uint32_t seed : propertySeeds(9'000'000, 200)) {
        CAPTURE(seed);
        Random random(seed);
        Solid solid = randomSolid(random);
        const auto scale = static_cast<float>(std::pow(10.0, random.below(5)) * 1e-2);
        glm::vec3 away(0);
        if (random.oneIn(3))
            for (int k = 0; k < 3; ++k) away[k] = static_cast<float>(random.in(-50, 50));
        solid.transform([&](const glm::vec3& p) { return scale * (p + away); });
        const FracturePlan plan = randomPlan(random);
        Recipe recipe;
        recipe.physics.convexParts = random.oneIn(3) ? 1 + random.below(8) : 8;
        recipe.physics.hullMargin = scale * (random.oneIn(3) ? random.in(0, 0.05) : 0.01);
        if (random.oneIn(4))
            recipe.interior.roughness = {scale * random.in(0, 0.1), 0.5 * scale, seed};
        const Result<BakedObject> baked = bakeObject(meshOf(solid), plan, recipe, 0);
        if (!baked) {
            CAPTURE(baked.error().message);
            CHECK(baked.error().code == ErrorCode::separatesNothing);
            continue;
        }
        ++found.cases;
        Judge judge(baked->set, random);
        judge.overlaps(found);
        judge.protrusion();
        judge.margins(recipe.physics);
        for (uint32_t level = 1; level < baked->set.levels.size(); ++level)
            judge.coverage(level, found);
    }
    MESSAGE(found.cases << " cases, " << found.pieces << " pieces, of which " << found.convex
                        << " convex and " << found.several << " of several hulls, " << found.pairs
                        << " pairs");
}
