// SPDX-License-Identifier: MIT
// Every fragment in convex parts of few corners -> walls between overlapping parts of fragments
// that may be bodies at the same time -> parts shrunk by their margins.
#include "assembly/colliders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/bounds.h"
#include "geometry/box_tree.h"
#include "geometry/no_index.h"
#include "parallel/parallel_for.h"
#include "physics/collider_separation.h"
#include "physics/convex_hull.h"
#include "physics/convex_parts.h"
#include "physics/hull_selection.h"
#include "physics/hull_shrink.h"
#include "physics/solid_samples.h"

namespace sherd {
namespace {

constexpr size_t kRuns = 32;
/// Corners nearer than this to the hull of others are left out at once: share of the diagonal. Not
/// of a thin piece that would then lack more of its volume than kSkinVolume. (Nor less than a
/// sphere lacks, whose thousands of corners are all on its hull.)
constexpr double kSkin = 2e-3;
constexpr double kSkinVolume = 0.02;
/// Overlaps below this share of the diagonal are let be: a tenth of what is accepted.
constexpr double kTouch = 1e-6;
/// What a collider's corners must reach before their number is looked at: share of the volume of
/// the part, and distance to the surface. The margin's roundness may take as much of it again, so
/// that nine tenths of a convex piece are held and its surface is bare nowhere by more than 3 %.
constexpr double kFilled = 0.93;
constexpr double kRounded = 0.97;   ///< share of the corners' hull that margins leave
constexpr double kReach = 0.015;    ///< of the size
constexpr double kReachMin = 1e-3;  ///< metres
constexpr uint32_t kMostVertices = 128;
/// What a wall must leave of a fragment's only part, as a share.
constexpr double kLeft = 0.02;
/// Thinner ones are not worth keeping beside others: share of the size.
constexpr double kFlat = 1e-3;
/// Along a fragment's longest side.
constexpr uint32_t kSampleCells = 12;

/// The middle of some points in the origin, about 1 in size, scaled by a power of two. The object's
/// is that of all work on colliders.
struct Frame {
    glm::dvec3 middle{0.0};
    double scale = 1;  ///< to the frame's unit
    double diagonal = 0;
    glm::dvec3 in(const glm::dvec3& p) const { return (p - middle) * scale; }
    glm::dvec3 out(const glm::dvec3& p) const { return middle + p / scale; }
};

template <class Point>
Frame frameOf(const std::vector<Point>& points) {
    Bounds box;
    for (const Point& p : points) box.add(p);
    Frame frame;
    if (!(box.diagonal() > 0)) return frame;
    frame.middle = box.middle();
    frame.scale = std::exp2(-std::ilogb(box.diagonal()));
    frame.diagonal = box.diagonal() * frame.scale;
    return frame;
}

/// A collider of it would be given a thickness.
bool isFlat(const Polytope& body) {
    Bounds box;
    for (const glm::dvec3& p : body.points) box.add(p);
    return thinnestExtent(body.points, halfSpacesOf(body)) < kFlat * box.diagonal();
}

class ColliderAssembler {
  public:
    ColliderAssembler(const PhysicsSettings& settings, unsigned threads, FractureSet& set)
        : settings_(settings),
          threads_(threads),
          set_(set),
          frame_(frameOf(set.geometry.positions)) {}

    void run() {
        findParts();
        separate();
        write();
    }

  private:
    /// One fragment, its vertices numbered from 0. `numbers`: kNone per vertex of the set, before
    /// and after.
    SolidChain solidOf(uint32_t fragment, std::vector<uint32_t>& numbers) const {
        std::vector<std::array<uint32_t, 3>> triangles = fragmentTriangles(set_, fragment);
        std::vector<uint32_t> used;
        std::vector<glm::dvec3> points;
        for (auto& t : triangles) {
            for (uint32_t& v : t) {
                if (numbers[v] == kNone) {
                    numbers[v] = static_cast<uint32_t>(points.size());
                    points.push_back(frame_.in(set_.geometry.positions[v]));
                    used.push_back(v);
                }
                v = numbers[v];
            }
        }
        for (const uint32_t v : used) numbers[v] = kNone;
        return {std::move(points), std::move(triangles)};
    }

    /// The hull of few of its corners, which fills most of a volume, chosen at the size of 1: what
    /// is a crumb of the object has corners, too.
    ColliderPart reduced(uint32_t fragment, const Polytope& hull, double volume,
                         double reach) const {
        const std::vector<uint8_t> all(hull.points.size(), 1);
        const Frame own = frameOf(hull.points);
        std::vector<glm::dvec3> points;
        for (const glm::dvec3& p : hull.points) points.push_back(own.in(p));
        SelectionGoal goal;
        goal.count = settings_.hullVertices;
        goal.most = std::max(settings_.hullVertices, kMostVertices);
        goal.volume = kFilled * volume * own.scale * own.scale * own.scale;
        goal.reach = reach * own.scale;
        goal.counts = all;
        std::vector<glm::dvec3> chosen;
        for (const uint32_t i : selectHullVertices(points, spanOf(points), goal))
            chosen.push_back(hull.points[i]);
        return {fragment, hullOf(chosen), {}, static_cast<uint32_t>(chosen.size()), reach};
    }

    std::vector<ColliderPart> partsOf(uint32_t fragment, std::vector<uint32_t>& numbers) const {
        const SolidChain solid = solidOf(fragment, numbers);
        Polytope hull = hullOf(solid.skinPoints(), kSkin);
        if (volumeOf(hull) < (1 - kSkinVolume) * solid.volume()) hull = hullOf(solid.skinPoints());
        if (hull.empty()) return {};
        // What the skin took is to be filled, too; more than that is a solid that overlaps itself.
        const double whole =
            std::max(volumeOf(hull), std::min(solid.volume(), volumeOf(hull) / (1 - kSkinVolume)));
        Bounds box;
        for (const glm::dvec3& p : hull.points) box.add(p);
        const glm::dvec3 size = box.size();
        const double reach =
            std::max(kReachMin * frame_.scale, kReach * std::max({size.x, size.y, size.z})) -
            0.5 * kSkin * box.diagonal();
        PartSettings settings;
        settings.most = settings_.convexParts;
        if (settings.most == 1 || solid.volume() > settings.full * volumeOf(hull))
            return {reduced(fragment, hull, whole, reach)};
        std::vector<ColliderPart> parts;
        for (const std::vector<glm::dvec3>& corners : convexParts(solid, settings)) {
            const Polytope part = hullOf(corners, kSkin);
            if (!part.empty() && !isFlat(part))
                parts.push_back(reduced(fragment, part, volumeOf(part), reach));
        }
        if (parts.empty()) parts.push_back(reduced(fragment, hull, whole, reach));
        return parts;
    }

    void findParts() {
        const size_t count = set_.fragments.size();
        std::vector<std::vector<ColliderPart>> parts(count);
        parallelRuns(count, count / kRuns, threads_, [&](size_t first, size_t last) {
            std::vector<uint32_t> numbers(set_.geometry.positions.size(), kNone);
            for (size_t f = first; f < last; ++f)
                parts[f] = partsOf(static_cast<uint32_t>(f), numbers);
        });
        samples_.assign(count, 0);
        partsLeft_.assign(count, 0);
        for (size_t f = 0; f < count; ++f) {
            for (ColliderPart& part : parts[f]) {
                ++partsLeft_[f];
                parts_.push_back(std::move(part));
            }
        }
    }

    bool mayMeet(uint32_t a, uint32_t b) const {
        // Parents come before their children.
        const uint32_t high = std::max(a, b), low = std::min(a, b);
        for (auto f = static_cast<int32_t>(high); f >= static_cast<int32_t>(low);
             f = set_.fragments[static_cast<size_t>(f)].parent)
            if (f == static_cast<int32_t>(low)) return false;
        return true;
    }

    WalledBody walled(const ColliderPart& part) const {
        const uint32_t f = part.fragment;
        return {part.body, part.solid, samples_[f] > 0 ? 1.0 / samples_[f] : 0,
                partsLeft_[f] > 1 ? 0.0 : kLeft};
    }

    std::vector<std::pair<uint32_t, uint32_t>> closePairs() const {
        std::vector<FloatBox> boxes;
        std::vector<uint32_t> boxed;  // parts that are no body of their own meet nothing
        for (uint32_t i = 0; i < parts_.size(); ++i) {
            if (parts_[i].body.empty()) continue;
            Bounds box;
            for (const glm::dvec3& p : parts_[i].body.points) box.add(p);
            // Rounded, but what would be missed touches only.
            boxes.push_back({glm::vec3(box.low), glm::vec3(box.high)});
            boxed.push_back(i);
        }
        const BoxTree tree(std::move(boxes));
        std::vector<std::pair<uint32_t, uint32_t>> pairs;
        for (size_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
            tree.pairsOf(leaf, ~size_t{0}, [&](uint32_t a, uint32_t b) {
                const auto [low, high] = std::minmax(boxed[a], boxed[b]);
                if (mayMeet(parts_[low].fragment, parts_[high].fragment))
                    pairs.emplace_back(low, high);
            });
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

    /// Those that overlap, found beside each other; then one by one, for a wall may part a body
    /// from more than one neighbour.
    void separate() {
        std::vector<std::pair<uint32_t, uint32_t>> pairs = closePairs();
        std::vector<uint8_t> overlapping(pairs.size(), 0);
        parallelRuns(pairs.size(), 64, threads_, [&](size_t first, size_t last) {
            for (size_t i = first; i < last; ++i) {
                const Polytope &a = parts_[pairs[i].first].body, &b = parts_[pairs[i].second].body;
                overlapping[i] = overlap(a, b, kTouch * frame_.diagonal) ? 1 : 0;
            }
        });
        size_t kept = 0;
        for (size_t i = 0; i < pairs.size(); ++i)
            if (overlapping[i] != 0) pairs[kept++] = pairs[i];
        pairs.resize(kept);
        sample(pairs);
        for (const auto& pair : pairs) part(pair);
    }

    /// Points in the solids of all fragments that walls may cut.
    void sample(const std::vector<std::pair<uint32_t, uint32_t>>& pairs) {
        std::vector<std::vector<uint32_t>> partsOf(set_.fragments.size());
        for (uint32_t i = 0; i < parts_.size(); ++i) partsOf[parts_[i].fragment].push_back(i);
        std::vector<uint32_t> fragments;
        for (const auto& [a, b] : pairs)
            for (const uint32_t i : {a, b}) fragments.push_back(parts_[i].fragment);
        std::sort(fragments.begin(), fragments.end());
        fragments.erase(std::unique(fragments.begin(), fragments.end()), fragments.end());
        parallelRuns(fragments.size(), fragments.size() / kRuns, threads_,
                     [&](size_t first, size_t last) {
                         std::vector<uint32_t> numbers(set_.geometry.positions.size(), kNone);
                         for (size_t i = first; i < last; ++i)
                             sampleFragment(fragments[i], partsOf[fragments[i]], numbers);
                     });
    }

    void sampleFragment(uint32_t fragment, const std::vector<uint32_t>& parts,
                        std::vector<uint32_t>& numbers) {
        const std::vector<glm::dvec3> points =
            solidSamples(solidOf(fragment, numbers), kSampleCells);
        samples_[fragment] = static_cast<uint32_t>(points.size());
        for (const uint32_t i : parts) {
            const std::vector<HalfSpace> walls = halfSpacesOf(parts_[i].body);
            for (const glm::dvec3& p : points) {
                const bool within = std::all_of(
                    walls.begin(), walls.end(),
                    [&](const HalfSpace& h) { return glm::dot(h.normal, p) <= h.offset; });
                if (within) parts_[i].solid.push_back(p);
            }
        }
    }

    std::optional<HalfSpace> wallOf(const std::pair<uint32_t, uint32_t>& pair) const {
        const ColliderPart &a = parts_[pair.first], &b = parts_[pair.second];
        if (a.body.empty() || b.body.empty()) return std::nullopt;
        return wallBetween(walled(a), walled(b), kTouch * frame_.diagonal);
    }

    void part(const std::pair<uint32_t, uint32_t>& pair) {
        const std::optional<HalfSpace> wall = wallOf(pair);
        if (!wall) return;
        clip(parts_[pair.first], *wall);
        clip(parts_[pair.second], {-wall->normal, -wall->offset});
    }

    void clip(ColliderPart& part, const HalfSpace& wall) {
        part.body = clipped(part.body, wall);
        std::erase_if(part.solid,
                      [&](const glm::dvec3& p) { return glm::dot(wall.normal, p) > wall.offset; });
        if (partsLeft_[part.fragment] > 1 && isFlat(part.body)) part.body = {};
        if (part.body.empty()) --partsLeft_[part.fragment];
    }

    void write() {
        const size_t count = set_.fragments.size();
        std::vector<std::vector<uint32_t>> partsOf(count);
        for (uint32_t i = 0; i < parts_.size(); ++i)
            if (!parts_[i].body.empty()) partsOf[parts_[i].fragment].push_back(i);
        std::vector<std::vector<ColliderHull>> hulls(count);
        parallelRuns(count, 1, threads_, [&](size_t f, size_t) {
            for (const uint32_t i : partsOf[f]) hulls[f].push_back(finished(parts_[i]));
            if (hulls[f].empty()) hulls[f].push_back(flat(static_cast<uint32_t>(f)));
        });
        for (size_t f = 0; f < count; ++f) {
            set_.fragments[f].hulls = {static_cast<uint32_t>(set_.hulls.size()),
                                       static_cast<uint32_t>(hulls[f].size())};
            for (const ColliderHull& hull : hulls[f]) {
                set_.hulls.push_back({{static_cast<uint32_t>(set_.hullPoints.size()),
                                       static_cast<uint32_t>(hull.points.size())},
                                      hull.margin});
                set_.hullPoints.insert(set_.hullPoints.end(), hull.points.begin(),
                                       hull.points.end());
            }
        }
    }

    ColliderHull finished(const ColliderPart& part) const {
        std::vector<glm::dvec3> points;
        for (const glm::dvec3& p : part.body.points) points.push_back(frame_.out(p));
        return colliderHull(points, {std::max(part.vertices, settings_.hullVertices),
                                     static_cast<float>(settings_.hullMargin),
                                     part.reach / frame_.scale, kRounded});
    }

    /// What has no volume to be cut into parts.
    ColliderHull flat(uint32_t fragment) const {
        std::vector<glm::dvec3> points;
        std::vector<uint32_t> numbers(set_.geometry.positions.size(), kNone);
        const SolidChain solid = solidOf(fragment, numbers);
        for (const glm::dvec3& p : solid.skinPoints()) points.push_back(frame_.out(p));
        return colliderHull(points,
                            {settings_.hullVertices, static_cast<float>(settings_.hullMargin)});
    }

    const PhysicsSettings& settings_;
    unsigned threads_;
    FractureSet& set_;
    Frame frame_;
    std::vector<ColliderPart> parts_;
    std::vector<uint32_t> samples_;    ///< per fragment: points in its solid
    std::vector<uint32_t> partsLeft_;  ///< per fragment
};

}  // namespace

void assembleColliders(const PhysicsSettings& settings, unsigned threads, FractureSet& set) {
    ColliderAssembler(settings, threads, set).run();
}

}  // namespace sherd
