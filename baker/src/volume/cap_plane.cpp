// SPDX-License-Identifier: MIT
#include "volume/cap_plane.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace sherd {

void CapPlane::start(const CapSpace& vertices, uint32_t i, uint32_t j) {
    vertices_ = &vertices;
    vertexOf_.clear();
    places_.clear();
    exact_.clear();
    const glm::dvec3 normal = vertices.normal(i, j);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    uAxis_ = (axis + 1) % 3;
    vAxis_ = (axis + 2) % 3;
    if (normal[axis] < 0) std::swap(uAxis_, vAxis_);
    glm::dvec3 alongU(0), alongV(0);
    alongU[uAxis_] = alongV[vAxis_] = 1;
    alongU[axis] = -normal[uAxis_] / normal[axis];
    alongV[axis] = -normal[vAxis_] / normal[axis];
    stretch_.x = glm::length(alongU);
    shear_ = glm::dot(alongU, alongV) / stretch_.x;
    stretch_.y = std::sqrt(glm::dot(alongV, alongV) - shear_ * shear_);
}

void CapPlane::add(uint32_t vertex) {
    vertexOf_.push_back(vertex);
    const glm::dvec3& p = vertices_->gridPosition(vertex);
    places_.emplace_back(p[uAxis_], p[vAxis_]);
    exact_.emplace_back();
}

void CapPlane::addFarAway(int64_t u, int64_t v) {
    vertexOf_.push_back(CapSpace::kNone);
    places_.emplace_back(u, v);
    exact_.emplace_back(Exact{u, v, 1});
}

int CapPlane::turn(uint32_t a, uint32_t b, uint32_t c) {
    const glm::dvec2 ab = places_[b] - places_[a];
    const glm::dvec2 ac = places_[c] - places_[a];
    const double left = ab.x * ac.y, right = ab.y * ac.x;
    const double det = left - right;
    // Places are off by 2^-23 per axis, differences by twice that; products and sums are rounded.
    const double bound =
        0x1p-21 * (std::abs(ab.x) + std::abs(ab.y) + std::abs(ac.x) + std::abs(ac.y)) + 0x1p-40 +
        0x1p-50 * (std::abs(left) + std::abs(right));
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return exactTurn(a, b, c);
}

const CapPlane::Exact& CapPlane::exact(uint32_t point) {
    std::optional<Exact>& e = exact_[point];
    if (!e) {
        const ExactPlace p = vertices_->exactPlace(vertexOf_[point]);
        const ExactPlace::Integer* const coordinate[] = {&p.x, &p.y, &p.z};
        e = Exact{*coordinate[uAxis_], *coordinate[vAxis_], p.w};
    }
    return *e;
}

int CapPlane::exactTurn(uint32_t a, uint32_t b, uint32_t c) {
    const Exact& p = exact(a);
    const Exact& q = exact(b);
    const Exact& r = exact(c);
    const ExactPlace::Integer det = p.u * (q.v * r.w - r.v * q.w) - p.v * (q.u * r.w - r.u * q.w) +
                                    p.w * (q.u * r.v - r.u * q.v);
    return det.sign();
}

}  // namespace sherd
