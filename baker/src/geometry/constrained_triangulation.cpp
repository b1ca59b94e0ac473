// SPDX-License-Identifier: MIT
#include "geometry/constrained_triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace sherd {
namespace {

constexpr uint32_t kNobody = TriangulationResult::kNone;
constexpr uint32_t kHeld = 0xFFFFFFFFU;  ///< mark of an edge that must stay for now
/// Up to here edges are flipped out of a constraint's way; more are cleared away at once.
constexpr size_t kFewCrossed = 16;

uint32_t cyclic(uint32_t k) {
    return k % 3;
}

}  // namespace

class ConstrainedTriangulation::Work {
  public:
    const TriangulationResult& run(const TriangulationInput& input) {
        in_ = &input;
        extent_ = 0;
        for (const ExactPoint& p : in_->points) {
            extent_ = std::max({extent_, std::abs(p.ax), std::abs(p.ay)});
        }
        triangles_.assign({{{0, 1, 2}, {kNobody, kNobody, kNobody}, {0, 0, 0}}});
        triangleOf_.assign(in_->points.size(), 0);
        last_ = 0;
        flipsLeft_ = 40 * in_->points.size() + 40;
        findInsertionOrder();
        result_.same.clear();
        result_.passages.clear();
        for (const uint32_t p : order_) insert(p);
        recoverConstraints();
        result_.triangles.clear();
        result_.triangles.reserve(triangles_.size());
        for (const Triangle& t : triangles_) result_.triangles.push_back({t.v, t.mark, t.neighbor});
        return result_;
    }

  private:
    struct Triangle {
        std::array<uint32_t, 3> v;         ///< counter-clockwise
        std::array<uint32_t, 3> neighbor;  ///< across edge v[k] v[k + 1]
        std::array<uint32_t, 3> mark;
    };
    struct Edge {
        uint32_t t, k;
    };

    int side(uint32_t a, uint32_t b, uint32_t c) const {
        if (in_->turn) return in_->turn(a, b, c);
        return orientation(in_->points[a], in_->points[b], in_->points[c], extent_);
    }

    /// Few points in the order they come; many in rounds that double in number, each along a
    /// Hilbert curve (Amenta, Choi and Rote 2003, Incremental constructions con BRIO): neighbours
    /// in the order are neighbours in the plane, and every round meets a triangulation that is
    /// already even, so that finding a point and flipping after it take a few steps whatever the
    /// points. (Row by row without rounds took 4.4 s for 20,000 points, this 0.1 s.)
    void findInsertionOrder() {
        order_.resize(in_->points.size() - 3);
        std::iota(order_.begin(), order_.end(), 3U);
        if (order_.size() < 16) return;
        glm::dvec2 low(in_->points[0].ax, in_->points[0].ay);
        glm::dvec2 high = low;
        for (const ExactPoint& p : in_->points) {
            low = glm::min(low, glm::dvec2(p.ax, p.ay));
            high = glm::max(high, glm::dvec2(p.ax, p.ay));
        }
        const glm::dvec2 scale = 65535.0 / glm::max(high - low, glm::dvec2(1e-300));
        std::vector<uint64_t> key(in_->points.size());
        for (const uint32_t i : order_) {
            const glm::dvec2 p = (glm::dvec2(in_->points[i].ax, in_->points[i].ay) - low) * scale;
            const uint64_t place =
                alongHilbertCurve(static_cast<uint32_t>(p.x), static_cast<uint32_t>(p.y));
            key[i] = uint64_t{roundOf(i)} << 32 | place;
        }
        std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
            return key[a] != key[b] ? key[a] < key[b] : a < b;
        });
    }

    /// Many constraints shuffled: each then crosses what lies between its neighbours among those
    /// already there only, n log n in all for parallel lines where one by one takes n^2.
    void findRecoveryOrder() {
        order_.resize(in_->constraints.size());
        std::iota(order_.begin(), order_.end(), 0U);
        if (order_.size() < 16) return;
        std::sort(order_.begin(), order_.end(), [](uint32_t a, uint32_t b) {
            return std::pair(scrambled(a), a) < std::pair(scrambled(b), b);
        });
    }

    static uint32_t scrambled(uint32_t i) {
        uint32_t h = i * 0x9E3779B9U;  // Fibonacci hashing, then mixed downwards
        h ^= h >> 15;
        h *= 0x85EBCA6BU;
        return h ^ h >> 13;
    }

    /// Half of all points fall in the last round (32), half of the others in the one before, ...
    static uint32_t roundOf(uint32_t i) {
        return 32 - static_cast<uint32_t>(std::countr_zero(scrambled(i) | 0x80000000U));
    }

    /// The place of a cell of a 2^16 x 2^16 grid along Hilbert's curve.
    static uint32_t alongHilbertCurve(uint32_t x, uint32_t y) {
        uint32_t place = 0;
        for (uint32_t s = 1U << 15; s > 0; s >>= 1) {
            const uint32_t right = (x & s) != 0 ? 1 : 0;
            const uint32_t up = (y & s) != 0 ? 1 : 0;
            place += s * s * ((3 * right) ^ up);
            if (up == 0) {
                if (right == 1) {
                    x = 65535 - x;
                    y = 65535 - y;
                }
                std::swap(x, y);
            }
        }
        return place;
    }

    /// The triangle that holds the point, border included, by walking towards it.
    uint32_t locate(uint32_t p) {
        uint32_t t = last_;
        uint32_t turn = 0;
        for (size_t steps = 0; steps < 4 * triangles_.size() + 16; ++steps) {
            bool moved = false;
            for (uint32_t i = 0; i < 3 && !moved; ++i) {
                const uint32_t k = cyclic(turn + i);
                const Triangle& tri = triangles_[t];
                if (tri.neighbor[k] == kNobody || side(tri.v[k], tri.v[cyclic(k + 1)], p) >= 0)
                    continue;
                t = tri.neighbor[k];
                moved = true;
            }
            if (!moved) return t;
            ++turn;  // varying the first edge tried keeps the walk from cycling
        }
        for (t = 0; t < triangles_.size(); ++t) {
            const Triangle& tri = triangles_[t];
            if (side(tri.v[0], tri.v[1], p) >= 0 && side(tri.v[1], tri.v[2], p) >= 0 &&
                side(tri.v[2], tri.v[0], p) >= 0) {
                break;
            }
        }
        return t;
    }

    void insert(uint32_t p) {
        const uint32_t t = locate(p);
        for (uint32_t k = 0; k < 3; ++k) {
            if (side(triangles_[t].v[k], triangles_[t].v[cyclic(k + 1)], p) == 0) {
                if (!isCorner(t, k, p)) splitEdge({t, k}, p);
                return;
            }
        }
        splitTriangle(t, p);
    }

    /// Whether p, on edge k of t, is in the place of one of its ends; then that stands for it.
    bool isCorner(uint32_t t, uint32_t k, uint32_t p) {
        const auto& v = triangles_[t].v;
        const uint32_t apex = v[cyclic(k + 2)];
        if (side(v[cyclic(k + 1)], apex, p) == 0) {
            result_.same.emplace_back(p, v[cyclic(k + 1)]);
        } else if (side(apex, v[k], p) == 0) {
            result_.same.emplace_back(p, v[k]);
        } else {
            return false;
        }
        return true;
    }

    void recoverConstraints() {
        std::vector<uint32_t> standsFor;
        if (!result_.same.empty()) {
            standsFor.resize(in_->points.size());
            std::iota(standsFor.begin(), standsFor.end(), 0U);
            for (const auto& [later, earlier] : result_.same) standsFor[later] = earlier;
        }
        const auto inPlace = [&](uint32_t p) { return standsFor.empty() ? p : standsFor[p]; };
        result_.valid = true;
        findRecoveryOrder();
        for (const uint32_t i : order_) {
            const TriangulationInput::Constraint& c = in_->constraints[i];
            constraint_ = i;
            result_.valid = result_.valid && recover(inPlace(c.a), inPlace(c.b), c.mark);
        }
    }

    void setTriangle(uint32_t t, std::array<uint32_t, 3> v, std::array<uint32_t, 3> neighbor,
                     std::array<uint32_t, 3> mark) {
        triangles_[t] = {v, neighbor, mark};
        for (const uint32_t p : v) triangleOf_[p] = t;
    }

    /// Tells the triangle across edge k of t that t is now its neighbour there.
    void link(uint32_t t, uint32_t k) {
        const uint32_t n = triangles_[t].neighbor[k];
        if (n == kNobody) return;
        const uint32_t from = triangles_[t].v[cyclic(k + 1)];
        for (uint32_t j = 0; j < 3; ++j) {
            if (triangles_[n].v[j] == from) triangles_[n].neighbor[j] = t;
        }
    }

    void splitTriangle(uint32_t t, uint32_t p) {
        const Triangle old = triangles_[t];
        const auto t1 = static_cast<uint32_t>(triangles_.size());
        const uint32_t t2 = t1 + 1;
        triangles_.resize(triangles_.size() + 2);
        setTriangle(t, {old.v[0], old.v[1], p}, {old.neighbor[0], t1, t2}, {old.mark[0], 0, 0});
        setTriangle(t1, {old.v[1], old.v[2], p}, {old.neighbor[1], t2, t}, {old.mark[1], 0, 0});
        setTriangle(t2, {old.v[2], old.v[0], p}, {old.neighbor[2], t, t1}, {old.mark[2], 0, 0});
        link(t1, 0);
        link(t2, 0);
        last_ = t;
        suspects_.assign({{t, 0}, {t1, 0}, {t2, 0}});
        legalize();
    }

    void splitEdge(Edge e, uint32_t p) {
        const Triangle old = triangles_[e.t];
        const uint32_t a = old.v[e.k];
        const uint32_t b = old.v[cyclic(e.k + 1)];
        const uint32_t c = old.v[cyclic(e.k + 2)];
        const uint32_t mark = old.mark[e.k];
        const uint32_t n = old.neighbor[e.k];
        const uint32_t bc = old.neighbor[cyclic(e.k + 1)];
        const uint32_t ca = old.neighbor[cyclic(e.k + 2)];
        const auto t1 = static_cast<uint32_t>(triangles_.size());
        const uint32_t n1 = n == kNobody ? kNobody : t1 + 1;
        triangles_.resize(triangles_.size() + (n == kNobody ? 1 : 2));
        setTriangle(e.t, {a, p, c}, {n1, t1, ca}, {mark, 0, old.mark[cyclic(e.k + 2)]});
        setTriangle(t1, {p, b, c}, {n, bc, e.t}, {mark, old.mark[cyclic(e.k + 1)], 0});
        link(t1, 1);
        suspects_.assign({{e.t, 2}, {t1, 1}});
        if (n != kNobody) {
            const Triangle other = triangles_[n];
            uint32_t j = 0;
            while (other.v[j] != b) ++j;  // its edge j runs b -> a
            const uint32_t d = other.v[cyclic(j + 2)];
            const uint32_t ad = other.neighbor[cyclic(j + 1)];
            const uint32_t db = other.neighbor[cyclic(j + 2)];
            setTriangle(n, {b, p, d}, {t1, n1, db}, {mark, 0, other.mark[cyclic(j + 2)]});
            setTriangle(n1, {p, a, d}, {e.t, ad, n}, {mark, other.mark[cyclic(j + 1)], 0});
            link(n1, 1);
            suspects_.push_back({n, 2});
            suspects_.push_back({n1, 1});
        }
        last_ = e.t;
        legalize();
    }

    /// Whether the diagonal of the two triangles at an edge can be exchanged at all.
    bool flippable(Edge e) const {
        const Triangle& t = triangles_[e.t];
        if (t.neighbor[e.k] == kNobody || t.mark[e.k] != 0) return false;
        const auto [a, b, c, d] = quad(e);
        return side(c, a, d) > 0 && side(d, b, c) > 0;
    }

    /// a -> b the edge, c the corner of e.t, d the corner across.
    std::array<uint32_t, 4> quad(Edge e) const {
        const Triangle& t = triangles_[e.t];
        const uint32_t b = t.v[cyclic(e.k + 1)];
        const Triangle& n = triangles_[t.neighbor[e.k]];
        uint32_t j = 0;
        while (n.v[j] != b) ++j;
        return {t.v[e.k], b, t.v[cyclic(e.k + 2)], n.v[cyclic(j + 2)]};
    }

    /// Exchanges the diagonal; afterwards e.t is (c, a, d) and the neighbour (d, b, c).
    void flip(Edge e) {
        const Triangle t = triangles_[e.t];
        const uint32_t n = t.neighbor[e.k];
        const Triangle other = triangles_[n];
        const auto [a, b, c, d] = quad(e);
        uint32_t j = 0;
        while (other.v[j] != b) ++j;
        const uint32_t kb = cyclic(e.k + 1);  // edge b -> c of t
        const uint32_t kc = cyclic(e.k + 2);  // edge c -> a of t
        const uint32_t ja = cyclic(j + 1);    // edge a -> d of the other
        const uint32_t jd = cyclic(j + 2);    // edge d -> b of the other
        setTriangle(e.t, {c, a, d}, {t.neighbor[kc], other.neighbor[ja], n},
                    {t.mark[kc], other.mark[ja], 0});
        setTriangle(n, {d, b, c}, {other.neighbor[jd], t.neighbor[kb], e.t},
                    {other.mark[jd], t.mark[kb], 0});
        link(e.t, 1);
        link(n, 1);
    }

    /// The angles opposite the edge a b add up to more than a half turn: the other diagonal is
    /// better. By the sine of the sum: below 0 between a half turn and a whole one.
    bool worthFlipping(Edge e) const {
        const auto [a, b, c, d] = quad(e);
        const Angle atC = angle(c, a, b);
        const Angle atD = angle(d, b, a);
        if (atC.cosine >= 0 && atD.cosine >= 0) return false;
        const double sine = atC.sine * atD.cosine + atC.cosine * atD.sine;
        const double cosine = atC.cosine * atD.cosine - atC.sine * atD.sine;
        // Equal angles within 1e-9 are left alone, or rounding would flip for ever.
        if (std::abs(sine) > 1e-9 * std::abs(cosine)) return sine < 0;
        return cosine > 0;  // two flat triangles: a whole turn
    }

    struct Angle {  ///< both times the lengths of the two sides
        double sine, cosine;
    };
    Angle angle(uint32_t at, uint32_t from, uint32_t to) const {
        const glm::dvec2 u = in_->shape[from] - in_->shape[at];
        const glm::dvec2 v = in_->shape[to] - in_->shape[at];
        return {std::abs(u.x * v.y - u.y * v.x), u.x * v.x + u.y * v.y};
    }

    /// Flips edges until those of `suspects_` and all that flips make suspect are worth keeping.
    void legalize() {
        while (!suspects_.empty()) {
            const Edge e = suspects_.back();
            suspects_.pop_back();
            if (flipsLeft_ == 0 || triangles_[e.t].neighbor[e.k] == kNobody || !worthFlipping(e) ||
                !flippable(e)) {
                continue;
            }
            --flipsLeft_;
            const uint32_t n = triangles_[e.t].neighbor[e.k];
            flip(e);
            suspects_.insert(suspects_.end(), {{e.t, 0}, {e.t, 1}, {n, 0}, {n, 1}});
        }
    }

    /// Edge a -> b, or t == kNobody. Looks around a, then b, then a again, twice as far each time:
    /// one of them may have thousands of triangles about it.
    Edge findEdge(uint32_t a, uint32_t b) const {
        Edge found{kNobody, 0};
        for (size_t limit = 32;; limit *= 2) {
            size_t left = limit;
            const bool sawAll = forEachAround(a, [&](uint32_t t, uint32_t k) {
                if (triangles_[t].v[cyclic(k + 1)] == b) found = {t, k};
                if (triangles_[t].v[cyclic(k + 2)] == b) found = {t, cyclic(k + 2)};
                return found.t == kNobody && --left > 0;
            });
            if (sawAll || found.t != kNobody) return found;
            std::swap(a, b);
        }
    }

    /// Calls visit(triangle, corner index of p) until it returns false, and then returns false.
    template <class Visit>
    bool forEachAround(uint32_t p, Visit&& visit) const {
        const uint32_t first = triangleOf_[p];
        uint32_t t = first;
        const auto cornerOf = [&](uint32_t tri) {
            uint32_t k = 0;
            while (triangles_[tri].v[k] != p) ++k;
            return k;
        };
        do {  // counter-clockwise
            const uint32_t k = cornerOf(t);
            if (!visit(t, k)) return false;
            t = triangles_[t].neighbor[cyclic(k + 2)];
        } while (t != kNobody && t != first);
        if (t == first) return true;
        t = triangles_[first].neighbor[cornerOf(first)];
        while (t != kNobody) {  // the rest clockwise: p is on the border
            const uint32_t k = cornerOf(t);
            if (!visit(t, k)) return false;
            t = triangles_[t].neighbor[k];
        }
        return true;
    }

    void setMark(Edge e, uint32_t mark) {
        const auto set = [mark](uint32_t& m) { m = m == 0 ? mark : std::min(m, mark); };
        const uint32_t b = triangles_[e.t].v[cyclic(e.k + 1)];
        set(triangles_[e.t].mark[e.k]);
        const uint32_t n = triangles_[e.t].neighbor[e.k];
        if (n == kNobody) return;
        for (uint32_t j = 0; j < 3; ++j) {
            if (triangles_[n].v[j] == b) set(triangles_[n].mark[j]);
        }
    }

    /// Makes a b an edge and marks it. False if another constraint is in the way.
    bool recover(uint32_t a, uint32_t b, uint32_t mark) {
        while (a != b) {
            if (const Edge e = findEdge(a, b); e.t != kNobody) {
                setMark(e, mark);
                return true;
            }
            uint32_t reached = b;
            if (!collectCrossed(a, b, reached)) return false;
            if (crossed_.size() > kFewCrossed) {
                refillCavity(a, reached);
            } else if (!flipAway(a, reached)) {
                return false;
            }
            const Edge e = findEdge(a, reached);
            if (e.t == kNobody) return false;
            setMark(e, mark);
            if (reached != b) result_.passages.push_back({constraint_, reached});
            a = reached;
        }
        return true;
    }

    /// Edges that a -> b crosses, up to b or the first point that lies on it.
    bool collectCrossed(uint32_t a, uint32_t b, uint32_t& reached) {
        crossed_.clear();
        cavity_.clear();
        Edge e{kNobody, 0};
        uint32_t through = kNobody;
        forEachAround(a, [&](uint32_t t, uint32_t k) {
            const uint32_t right = triangles_[t].v[cyclic(k + 1)];
            const uint32_t left = triangles_[t].v[cyclic(k + 2)];
            const int r = side(a, b, right);
            const int l = side(a, b, left);
            if (r < 0 && l > 0) e = {t, cyclic(k + 1)};
            // A neighbour on the line, ahead and not behind.
            if (r == 0 && ahead(a, b, right)) through = right;
            if (l == 0 && ahead(a, b, left)) through = left;
            return e.t == kNobody && through == kNobody;
        });
        if (through != kNobody) {
            reached = through;
            return true;
        }
        if (e.t == kNobody) return false;
        while (true) {
            const Triangle& t = triangles_[e.t];
            if (t.mark[e.k] != 0 || t.neighbor[e.k] == kNobody) return false;
            crossed_.emplace_back(t.v[e.k], t.v[cyclic(e.k + 1)]);
            cavity_.push_back(e.t);
            const uint32_t n = t.neighbor[e.k];
            const uint32_t from = t.v[cyclic(e.k + 1)];
            uint32_t j = 0;
            while (triangles_[n].v[j] != from) ++j;
            const uint32_t apex = triangles_[n].v[cyclic(j + 2)];
            const int s = apex == b ? 0 : side(a, b, apex);
            if (s == 0) {
                reached = apex;
                cavity_.push_back(n);
                return true;
            }
            // t.v[k] is right of the line, t.v[k + 1] left.
            e = s > 0 ? Edge{n, cyclic(j + 1)} : Edge{n, cyclic(j + 2)};
        }
    }

    bool ahead(uint32_t a, uint32_t b, uint32_t c) const {
        const glm::dvec2 ab(in_->points[b].ax - in_->points[a].ax,
                            in_->points[b].ay - in_->points[a].ay);
        const glm::dvec2 ac(in_->points[c].ax - in_->points[a].ax,
                            in_->points[c].ay - in_->points[a].ay);
        return ab.x * ac.x + ab.y * ac.y > 0;
    }

    /// Exchanges the crossed edges until none crosses. A crossed edge whose quad is not convex has
    /// to wait for others, so this takes the square of their number at worst.
    bool flipAway(uint32_t a, uint32_t b) {
        size_t limit = 16 * (crossed_.size() + 4) * (crossed_.size() + 4);
        for (size_t i = 0; i < crossed_.size(); ++i) {  // grows by what has to wait
            if (limit-- == 0) return false;
            const auto [p, q] = crossed_[i];
            const Edge e = findEdge(p, q);
            if (!flippable(e)) {
                crossed_.emplace_back(p, q);
                continue;
            }
            const auto [u, v, c, d] = quad(e);
            flip(e);
            const bool touches = c == a || c == b || d == a || d == b;
            if (!touches && side(a, b, c) * side(a, b, d) < 0) crossed_.emplace_back(c, d);
        }
        return true;
    }

    /// A directed edge of the cavity or of its filling, and the triangle on its left.
    struct Side {
        uint32_t from, to;
        uint32_t triangle, k;
        uint32_t mark;
        bool operator<(const Side& o) const {
            return std::pair(from, to) < std::pair(o.from, o.to);
        }
    };

    /// Takes all crossed triangles out and fills the hole on either side of a -> b. Each of the two
    /// is weakly visible from a b (crossed edges ran to it from every corner), and such polygons
    /// fall to one scan that cuts every convex corner it meets (Toussaint and Avis 1982, On a
    /// convex hull algorithm for polygons and its application to triangulation problems).
    void refillCavity(uint32_t a, uint32_t b) {
        std::vector<Side> outside = cavityBorder();
        std::vector<uint32_t> left{a}, right{a};  // corners in the order they are met
        for (const auto& [r, l] : crossed_) {
            if (left.back() != l) left.push_back(l);
            if (right.back() != r) right.push_back(r);
        }
        left.push_back(b);
        right.push_back(b);
        size_t next = 0;
        cutCorners(left, 1, next);
        cutCorners(right, -1, next);
        relinkCavity(outside);
        suspects_.clear();
        for (const uint32_t t : cavity_) {
            for (uint32_t k = 0; k < 3; ++k) {
                const auto& v = triangles_[t].v;
                const uint32_t from = v[k];
                const uint32_t to = v[cyclic(k + 1)];
                const bool isConstraint = (from == a && to == b) || (from == b && to == a);
                if (!isConstraint)
                    suspects_.push_back({t, k});
                else
                    triangles_[t].mark[k] = kHeld;
            }
        }
        legalize();
        const Edge e = findEdge(a, b);
        for (const Edge held : {e, across(e)}) triangles_[held.t].mark[held.k] = 0;
    }

    /// The same edge seen from the other side.
    Edge across(Edge e) const {
        const uint32_t b = triangles_[e.t].v[cyclic(e.k + 1)];
        const uint32_t n = triangles_[e.t].neighbor[e.k];
        uint32_t j = 0;
        while (triangles_[n].v[j] != b) ++j;
        return {n, j};
    }

    /// The cavity's triangles' edges that are not crossed, each with what lies across.
    std::vector<Side> cavityBorder() const {
        std::vector<Side> border;
        for (const uint32_t t : cavity_) {
            const Triangle& tri = triangles_[t];
            for (uint32_t k = 0; k < 3; ++k)
                border.push_back({tri.v[k], tri.v[cyclic(k + 1)], tri.neighbor[k], 0, tri.mark[k]});
        }
        std::sort(border.begin(), border.end());
        return border;
    }

    /// Triangles over a chain from a to b whose hole is on its right (turn 1) or left (-1).
    void cutCorners(const std::vector<uint32_t>& chain, int turn, size_t& next) {
        std::vector<uint32_t> open;
        for (const uint32_t v : chain) {
            open.push_back(v);
            while (open.size() >= 3) {
                const uint32_t x = open[open.size() - 3];
                const uint32_t y = open[open.size() - 2];
                if (side(x, y, v) * turn >= 0) break;
                open[open.size() - 2] = v;
                open.pop_back();
                const std::array<uint32_t, 3> corners =
                    turn > 0 ? std::array{v, y, x} : std::array{x, y, v};
                setTriangle(cavity_[next++], corners, {kNobody, kNobody, kNobody}, {0, 0, 0});
            }
        }
    }

    /// Joins the new triangles to each other and to what was around, marks included.
    void relinkCavity(const std::vector<Side>& outside) {
        std::vector<Side> inside;
        for (const uint32_t t : cavity_) {
            for (uint32_t k = 0; k < 3; ++k)
                inside.push_back({triangles_[t].v[k], triangles_[t].v[cyclic(k + 1)], t, k, 0});
        }
        std::sort(inside.begin(), inside.end());
        for (const Side& s : inside) {
            const Side back{s.to, s.from, 0, 0, 0};
            const auto twin = std::lower_bound(inside.begin(), inside.end(), back);
            Triangle& tri = triangles_[s.triangle];
            const auto old = std::lower_bound(outside.begin(), outside.end(), s);
            const bool wasThere = old != outside.end() && !(s < *old);
            if (wasThere) tri.mark[s.k] = old->mark;
            if (twin != inside.end() && !(back < *twin)) {
                tri.neighbor[s.k] = twin->triangle;
            } else if (wasThere) {
                tri.neighbor[s.k] = old->triangle;
                link(s.triangle, s.k);
            }
        }
    }

    const TriangulationInput* in_ = nullptr;
    TriangulationResult result_;
    std::vector<uint32_t> order_;
    double extent_ = 0;
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> triangleOf_;
    std::vector<Edge> suspects_;
    std::vector<std::pair<uint32_t, uint32_t>> crossed_;  ///< by the constraint being recovered
    std::vector<uint32_t> cavity_;                        ///< the triangles it crosses
    uint32_t last_ = 0;
    uint32_t constraint_ = 0;  ///< the one being recovered
    size_t flipsLeft_ = 0;
};

ConstrainedTriangulation::ConstrainedTriangulation() : work_(std::make_unique<Work>()) {}
ConstrainedTriangulation::~ConstrainedTriangulation() = default;

const TriangulationResult& ConstrainedTriangulation::run(const TriangulationInput& input) {
    return work_->run(input);
}

TriangulationResult triangulate(const TriangulationInput& input) {
    return ConstrainedTriangulation().run(input);
}

}  // namespace sherd
