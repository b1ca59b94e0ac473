// SPDX-License-Identifier: MIT
#include "geometry/bisection.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/no_index.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

int longestSide(uint32_t triangle, const std::function<double(uint32_t)>& length2) {
    int longest = 0;
    double most = length2(3 * triangle);
    for (int k = 1; k < 3; ++k) {
        const double length = length2(3 * triangle + static_cast<uint32_t>(k));
        if (!(length > most)) continue;
        most = length;
        longest = k;
    }
    return longest;
}

/// One round of cuts; glues the new sides as it goes.
class Bisector {
  public:
    Bisector(BisectedTriangles& mesh, std::span<const uint8_t> marked,
             std::span<const uint32_t> middle, const std::function<double(uint32_t)>& length2,
             std::vector<uint8_t>* kept)
        : mesh_(mesh), marked_(marked), middle_(middle), length2_(length2), kept_(kept) {}

    std::vector<uint32_t> run() {
        placeOf_.assign(mesh_.triangles.size(), kNone);
        for (uint32_t t = 0; t < placeOf_.size(); ++t) {
            const auto isMarked = [&](uint32_t k) { return marked_[3 * size_t{t} + k] != 0; };
            if (!isMarked(0) && !isMarked(1) && !isMarked(2)) continue;
            placeOf_[t] = static_cast<uint32_t>(cut_.size());
            cut_.push_back({t, {}, {}, {}});
        }
        for (Cut& cut : cut_) {
            Piece piece{mesh_.triangles[cut.triangle], {}};
            for (uint32_t k = 0; k < 3; ++k) {
                piece.sides[k] = {3 * cut.triangle + k, Part::whole};
                cut.opposite[k] = mesh_.opposite[3 * size_t{cut.triangle} + k];
                cut.halves[k] = {kNone, kNone};
                if (kept_ != nullptr) cut.kept[k] = (*kept_)[3 * size_t{cut.triangle} + k];
            }
            slot_ = cut.triangle;
            add(piece, longestSide(cut.triangle, length2_));
        }
        glue();
        return std::move(made_);
    }

  private:
    enum class Part : uint8_t { whole, first, second, inner };
    struct Side {
        uint32_t halfEdge = kNone;  ///< of the old mesh; of an inner side: its number
        Part part = Part::whole;
    };
    struct Piece {
        BisectedTriangles::Triangle triangle;
        std::array<Side, 3> sides;
    };

    struct Cut {
        uint32_t triangle;
        std::array<uint32_t, 3> opposite;               ///< what its sides were glued to
        std::array<std::array<uint32_t, 2>, 3> halves;  ///< what lies on them now
        std::array<uint8_t, 3> kept;
    };

    bool isMarked(const Side& side) const {
        return side.part == Part::whole && marked_[side.halfEdge] != 0;
    }

    /// Appends the piece, or what is left of it after cutting it at its marked sides, `side` first.
    void add(const Piece& piece, int side) {
        if (!isMarked(piece.sides[static_cast<size_t>(side)])) {
            for (side = 0; side < 3; ++side)
                if (isMarked(piece.sides[static_cast<size_t>(side)])) break;
        }
        if (side < 3) {
            cut(piece, static_cast<size_t>(side));
        } else {
            emit(piece);
        }
    }

    void cut(const Piece& piece, size_t k) {
        const size_t next = (k + 1) % 3, across = (k + 2) % 3;
        const uint32_t halfEdge = piece.sides[k].halfEdge;
        const uint32_t m = middle_[halfEdge];
        const uint32_t inner = innerSides_++;
        innerPair_.resize(2 * static_cast<size_t>(innerSides_), kNone);
        const auto child = static_cast<uint32_t>(mesh_.nodes.size());
        mesh_.nodes[piece.triangle.node].child = child;
        mesh_.nodes[piece.triangle.node].side = static_cast<uint32_t>(k);
        // Corners keep their numbers: in the half with the side's start its end becomes m, and the
        // other way round.
        Piece start = piece, end = piece;
        start.triangle.v[next] = m;
        start.triangle.along[next] = kNone;
        start.triangle.node = child;
        start.sides[k] = {halfEdge, Part::first};
        start.sides[next] = {2 * inner, Part::inner};
        end.triangle.v[k] = m;
        end.triangle.along[across] = kNone;
        end.triangle.node = child + 1;
        end.sides[k] = {halfEdge, Part::second};
        end.sides[across] = {2 * inner + 1, Part::inner};
        mesh_.nodes.push_back({start.triangle.v});
        mesh_.nodes.push_back({end.triangle.v});
        add(start, 0);
        add(end, 0);
    }

    /// The first piece takes the place of what was cut, the others come after all.
    void emit(const Piece& piece) {
        const uint32_t t = slot_ != kNone ? slot_ : static_cast<uint32_t>(mesh_.triangles.size());
        if (slot_ == kNone) mesh_.triangles.emplace_back();
        mesh_.triangles[t] = piece.triangle;
        made_.push_back(t);
        slot_ = kNone;
        if (kept_ != nullptr) keep(t, piece.sides);
        for (uint32_t k = 0; k < 3; ++k) {
            const Side& side = piece.sides[k];
            if (side.part == Part::inner) {
                innerPair_[side.halfEdge] = 3 * t + k;
            } else {
                Cut& cut = cut_[placeOf_[side.halfEdge / 3]];
                cut.halves[side.halfEdge % 3][side.part == Part::second ? 1 : 0] = 3 * t + k;
            }
        }
    }

    void keep(uint32_t t, const std::array<Side, 3>& sides) {
        kept_->resize(3 * mesh_.triangles.size(), 0);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t h = sides[k].halfEdge;
            (*kept_)[3 * size_t{t} + k] =
                sides[k].part == Part::whole ? cut_[placeOf_[h / 3]].kept[h % 3] : 0;
        }
    }

    /// What lies on an old half edge now.
    std::array<uint32_t, 2> halvesOf(uint32_t halfEdge) const {
        const uint32_t place = placeOf_[halfEdge / 3];
        if (place == kNone) return {halfEdge, kNone};
        return cut_[place].halves[halfEdge % 3];
    }

    void glue() {
        std::vector<uint32_t>& opposite = mesh_.opposite;
        opposite.resize(3 * mesh_.triangles.size(), kNone);
        const auto join = [&](uint32_t h, uint32_t o) { opposite[h] = o, opposite[o] = h; };
        for (const Cut& cut : cut_) {
            for (size_t k = 0; k < 3; ++k) {
                const auto& [first, second] = cut.halves[k];
                opposite[first] = kNone;
                if (second != kNone) opposite[second] = kNone;
            }
        }
        for (const Cut& cut : cut_) {
            for (size_t k = 0; k < 3; ++k) {
                if (cut.opposite[k] == kNone) continue;
                const auto [first, second] = cut.halves[k];
                const std::array<uint32_t, 2> others = halvesOf(cut.opposite[k]);
                const bool isWhole = second == kNone;
                join(first, others[isWhole ? 0 : 1]);
                if (!isWhole) join(second, others[0]);
            }
        }
        for (size_t i = 0; i < innerPair_.size(); i += 2) join(innerPair_[i], innerPair_[i + 1]);
    }

    BisectedTriangles& mesh_;
    std::span<const uint8_t> marked_;
    std::span<const uint32_t> middle_;
    const std::function<double(uint32_t)>& length2_;
    std::vector<uint8_t>* kept_;
    std::vector<Cut> cut_;
    std::vector<uint32_t> placeOf_;  ///< per old triangle: in cut_
    uint32_t slot_ = kNone;          ///< where the next piece goes; kNone: after all
    std::vector<uint32_t> made_;
    std::vector<uint32_t> innerPair_;
    uint32_t innerSides_ = 0;
};

}  // namespace

BisectedTriangles::BisectedTriangles(std::span<const std::array<uint32_t, 3>> parents,
                                     std::span<const uint32_t> opposites) {
    const size_t room = parents.size() + parents.size() / 2;  // for what refines them
    triangles.reserve(room);
    nodes.reserve(room);
    opposite.reserve(3 * room);
    opposite.assign(opposites.begin(), opposites.end());
    for (uint32_t t = 0; t < parents.size(); ++t) {
        triangles.push_back({parents[t], t, {3 * t, 3 * t + 1, 3 * t + 2}, t});
        nodes.push_back({parents[t]});
    }
}

BisectedTriangles::Located BisectedTriangles::locate(uint32_t parent,
                                                     const glm::dvec3& weights) const {
    glm::dvec3 w = weights;
    uint32_t at = parent;
    while (nodes[at].child != kNone) {
        const auto start = static_cast<int>(nodes[at].side);
        const int end = (start + 1) % 3;
        const bool inStart = w[start] >= w[end];
        // The middle weighs twice what is taken from both ends.
        const double both = 2 * (inStart ? w[end] : w[start]);
        const double rest = inStart ? w[start] - w[end] : w[end] - w[start];
        w[start] = inStart ? rest : both;
        w[end] = inStart ? both : rest;
        at = nodes[at].child + (inStart ? 0 : 1);
    }
    return {nodes[at].v, w};
}

void closeMarks(const BisectedTriangles& mesh, const std::function<double(uint32_t)>& length2,
                std::vector<uint32_t>& marks, std::vector<uint8_t>& marked) {
    const auto mark = [&](uint32_t h) {
        if (marked[h] != 0) return;
        marked[h] = 1;
        marks.push_back(h);
    };
    // It grows meanwhile.
    size_t next = 0;
    while (next < marks.size()) {
        const uint32_t h = marks[next++];
        if (mesh.opposite[h] != kNone) mark(mesh.opposite[h]);
        const uint32_t t = h / 3;
        mark(3 * t + static_cast<uint32_t>(longestSide(t, length2)));
    }
}

std::vector<uint32_t> bisect(BisectedTriangles& mesh, std::span<const uint8_t> marked,
                             std::span<const uint32_t> middle,
                             const std::function<double(uint32_t)>& length2,
                             std::vector<uint8_t>* kept) {
    return Bisector(mesh, marked, middle, length2, kept).run();
}

void sortByParent(BisectedTriangles& mesh, unsigned threads) {
    constexpr size_t kGrain = 4096;
    const auto& before = mesh.triangles;
    uint32_t parents = 0;
    for (const auto& t : before) parents = std::max(parents, t.parent + 1);
    std::vector<uint32_t> next(parents + 1, 0), order(before.size()), place(before.size());
    for (const auto& t : before) ++next[t.parent + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (uint32_t t = 0; t < before.size(); ++t) order[place[t] = next[before[t].parent]++] = t;
    std::vector<BisectedTriangles::Triangle> triangles(order.size());
    std::vector<uint32_t> opposite(3 * order.size());
    parallelRuns(order.size(), kGrain, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            triangles[i] = before[order[i]];
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t o = mesh.opposite[3 * size_t{order[i]} + k];
                opposite[3 * i + k] = o == kNone ? kNone : 3 * place[o / 3] + o % 3;
            }
        }
    });
    mesh.triangles = std::move(triangles);
    mesh.opposite = std::move(opposite);
}

}  // namespace sherd
