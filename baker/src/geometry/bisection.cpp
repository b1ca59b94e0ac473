// SPDX-License-Identifier: MIT
#include "geometry/bisection.h"

namespace sherd {
namespace {

constexpr uint32_t kNone = BisectedTriangles::kNone;

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
             std::span<const uint32_t> middle, const std::function<double(uint32_t)>& length2)
        : mesh_(mesh), marked_(marked), middle_(middle), length2_(length2) {}

    void run() {
        halves_.assign(mesh_.opposite.size(), {kNone, kNone});
        out_.reserve(mesh_.triangles.size());
        for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const BisectedTriangles::Triangle& from = mesh_.triangles[t];
            Piece piece{from, {}};
            for (uint32_t k = 0; k < 3; ++k) piece.sides[k] = {3 * t + k, Part::whole};
            add(piece, longestSide(t, length2_));
        }
        glue();
        mesh_.triangles = std::move(out_);
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

    void emit(const Piece& piece) {
        const auto t = static_cast<uint32_t>(out_.size());
        out_.push_back(piece.triangle);
        for (uint32_t k = 0; k < 3; ++k) {
            const Side& side = piece.sides[k];
            if (side.part == Part::inner) {
                innerPair_[side.halfEdge] = 3 * t + k;
            } else {
                halves_[side.halfEdge][side.part == Part::second ? 1 : 0] = 3 * t + k;
            }
        }
    }

    void glue() {
        std::vector<uint32_t> opposite(3 * out_.size(), kNone);
        for (uint32_t h = 0; h < halves_.size(); ++h) {
            const uint32_t o = mesh_.opposite[h];
            if (o == kNone) continue;
            const bool isCut = halves_[h][1] != kNone;
            opposite[halves_[h][0]] = halves_[o][isCut ? 1 : 0];
            if (isCut) opposite[halves_[h][1]] = halves_[o][0];
        }
        for (size_t i = 0; i < innerPair_.size(); i += 2) {
            opposite[innerPair_[i]] = innerPair_[i + 1];
            opposite[innerPair_[i + 1]] = innerPair_[i];
        }
        mesh_.opposite = std::move(opposite);
    }

    BisectedTriangles& mesh_;
    std::span<const uint8_t> marked_;
    std::span<const uint32_t> middle_;
    const std::function<double(uint32_t)>& length2_;
    std::vector<BisectedTriangles::Triangle> out_;
    std::vector<std::array<uint32_t, 2>> halves_;  ///< per old half edge: what lies on it now
    std::vector<uint32_t> innerPair_;
    uint32_t innerSides_ = 0;
};

}  // namespace

BisectedTriangles::BisectedTriangles(std::span<const std::array<uint32_t, 3>> parents,
                                     std::span<const uint32_t> opposites)
    : opposite(opposites.begin(), opposites.end()) {
    triangles.reserve(parents.size());
    nodes.reserve(parents.size());
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
                std::vector<uint8_t>& marked) {
    std::vector<uint32_t> open;
    for (uint32_t h = 0; h < marked.size(); ++h)
        if (marked[h] != 0) open.push_back(h);
    const auto mark = [&](uint32_t h) {
        if (marked[h] != 0) return;
        marked[h] = 1;
        open.push_back(h);
    };
    while (!open.empty()) {
        const uint32_t h = open.back();
        open.pop_back();
        if (mesh.opposite[h] != kNone) mark(mesh.opposite[h]);
        const uint32_t t = h / 3;
        mark(3 * t + static_cast<uint32_t>(longestSide(t, length2)));
    }
}

void bisect(BisectedTriangles& mesh, std::span<const uint8_t> marked,
            std::span<const uint32_t> middle, const std::function<double(uint32_t)>& length2) {
    Bisector(mesh, marked, middle, length2).run();
}

}  // namespace sherd
