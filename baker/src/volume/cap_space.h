// SPDX-License-Identifier: MIT
// What caps are made in: vertices of a cut, whatever cells it is by.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "volume/exact_place.h"
#include "volume/key_table.h"

namespace sherd {

class CapSpace {
  public:
    static constexpr uint32_t kNone = KeyTable::kNone;

    virtual ~CapSpace() = default;
    /// Whether what is made of a triangle must not depend on the side it is seen from; see
    /// MeshCutOptions.
    virtual bool shared() const = 0;
    virtual uint32_t count() const = 0;
    /// In grid steps, off by less than 2^-23 of one.
    virtual const glm::dvec3& gridPosition(uint32_t vertex) const = 0;
    /// In the mesh's unit, as it is written.
    virtual const glm::vec3& position(uint32_t vertex) const = 0;
    virtual ExactPlace exactPlace(uint32_t vertex) const = 0;
    /// Across the plane between two cells, from i to j; of any length.
    virtual glm::dvec3 normal(uint32_t i, uint32_t j) const = 0;
    /// Where the planes of two triangles and that between two cells meet, a new vertex if it is
    /// none yet; kNone if they have no common point.
    virtual uint32_t atCrossing(uint32_t s, uint32_t t, uint32_t i, uint32_t j) = 0;
};

}  // namespace sherd
