// SPDX-License-Identifier: MIT
#include "mesh_measures.h"

#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace sherd {

namespace {

uint64_t mixed(uint64_t x) {
    // The finaliser of MurmurHash3 (A. Appleby, public domain constants).
    x = (x ^ x >> 33) * 0xFF51AFD7ED558CCDULL;
    x = (x ^ x >> 33) * 0xC4CEB9FE1A85EC53ULL;
    return x ^ x >> 33;
}

uint64_t hashOf(const glm::vec3& p) {
    // Adding 0 turns -0 into 0, so that equal numbers have equal bits.
    const auto bits = [](float value) { return uint64_t{std::bit_cast<uint32_t>(value + 0.0F)}; };
    return mixed(bits(p.x) << 32 ^ mixed(bits(p.y) << 32 | bits(p.z)));
}

}  // namespace

std::vector<uint32_t> weldEqualPositions(const std::vector<glm::vec3>& positions) {
    constexpr uint32_t kFree = 0xFFFFFFFF;
    const size_t mask = std::bit_ceil(2 * positions.size() + 2) - 1;
    std::vector<uint32_t> table(mask + 1, kFree);
    std::vector<uint32_t> welded(positions.size());
    for (uint32_t v = 0; v < positions.size(); ++v) {
        size_t slot = hashOf(positions[v]) & mask;
        while (table[slot] != kFree && positions[table[slot]] != positions[v])
            slot = (slot + 1) & mask;
        if (table[slot] == kFree) table[slot] = v;
        welded[v] = table[slot];
    }
    return welded;
}

void EdgeBalance::begin(size_t triangles) {
    const size_t size = std::bit_ceil(4 * triangles + 2);
    slots_.assign(size, Slot{});
    mask_ = size - 1;
}

void EdgeBalance::addEdge(uint32_t from, uint32_t to) {
    const bool up = from < to;
    const uint64_t key = up ? uint64_t{from} << 32 | to : uint64_t{to} << 32 | from;
    size_t slot = mixed(key) & mask_;
    while (slots_[slot].key != 0 && slots_[slot].key != key) slot = (slot + 1) & mask_;
    slots_[slot].key = key;
    slots_[slot].net += up ? 1 : -1;
}

void EdgeBalance::add(uint32_t a, uint32_t b, uint32_t c) {
    if (a == b || b == c || c == a) return;
    addEdge(a, b);
    addEdge(b, c);
    addEdge(c, a);
}

EdgeDefects EdgeBalance::defects() const {
    EdgeDefects result;
    for (const Slot& slot : slots_) {
        if (slot.net == 0) continue;
        if (result.count++ == 0)
            result.first = {static_cast<uint32_t>(slot.key >> 32),
                            static_cast<uint32_t>(slot.key & 0xFFFFFFFF)};
    }
    return result;
}

MeshMeasurer::MeshMeasurer(const FractureSet& set)
    : set_(set), welded_(weldEqualPositions(set.geometry.positions)) {}

/// The integral over a closed mesh is the sum of those over the tetrahedra that its triangles span
/// with any one point (A. M. Messner and G. Q. Taylor, Algorithm 550: Solid polyhedron measures,
/// 1980); each is exact.
MeshMeasures MeshMeasurer::measure(uint32_t fragment) {
    const std::vector<glm::vec3>& positions = set_.geometry.positions;
    size_t triangles = 0;
    glm::dvec3 origin(0);
    forEachTriangle(set_, fragment, [&](size_t, uint32_t a, uint32_t, uint32_t) {
        // A reference near the fragment keeps the sums below from cancelling.
        if (triangles++ == 0) origin = positions[a];
    });
    MeshMeasures result;
    glm::dvec3 moment(0);
    glm::dvec3 squares(0);   // xx, yy, zz
    glm::dvec3 products(0);  // yz, zx, xy
    glm::dvec3 low(0);
    glm::dvec3 high(0);
    balance_.begin(triangles);
    forEachTriangle(set_, fragment, [&](size_t, uint32_t a, uint32_t b, uint32_t c) {
        balance_.add(welded_[a], welded_[b], welded_[c]);
        const glm::dvec3 p = glm::dvec3(positions[a]) - origin;
        const glm::dvec3 q = glm::dvec3(positions[b]) - origin;
        const glm::dvec3 r = glm::dvec3(positions[c]) - origin;
        const glm::dvec3 sum = p + q + r;
        const double six = glm::dot(p, glm::cross(q, r));
        result.volume += six / 6;
        moment += six / 24 * sum;
        squares += six / 120 * (p * p + q * q + r * r + sum * sum);
        const auto turned = [](const glm::dvec3& v) {
            return glm::dvec3(v.y * v.z, v.z * v.x, v.x * v.y);
        };
        products += six / 120 * (turned(p) + turned(q) + turned(r) + turned(sum));
        low = glm::min(glm::min(low, p), glm::min(q, r));
        high = glm::max(glm::max(high, p), glm::max(q, r));
    });
    result.edges = balance_.defects();
    const glm::dvec3 center = result.volume != 0 ? moment / result.volume : glm::dvec3(0);
    result.centroid = origin + center;
    result.covariance = glm::dmat3(squares.x, products.z, products.y, products.z, squares.y,
                                   products.x, products.y, products.x, squares.z) -
                        result.volume * glm::outerProduct(center, center);
    result.low = origin + low;
    result.high = origin + high;
    return result;
}

Face sortedFace(std::array<uint32_t, 3> corners) {
    int32_t sign = 1;
    const auto order = [&](int i, int j) {
        if (corners[i] <= corners[j]) return;
        std::swap(corners[i], corners[j]);
        sign = -sign;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return {corners, sign};
}

glm::dmat3 inertiaOf(const glm::dmat3& covariance) {
    return glm::dmat3(covariance[0][0] + covariance[1][1] + covariance[2][2]) - covariance;
}

glm::dmat3 covarianceOf(const glm::dmat3& inertia) {
    return glm::dmat3(0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2])) - inertia;
}

}  // namespace sherd
