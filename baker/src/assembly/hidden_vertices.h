// SPDX-License-Identifier: MIT
// Vertices of hidden faces in the fracture geometry.
#pragma once

#include "appearance/hidden_looks.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

class HiddenVertices {
  public:
    HiddenVertices(const HiddenLooks& looks, std::string depthAttribute, FractureGeometry& out);

    /// The three output vertices of a face of the hidden mesh; made when first asked for.
    std::array<uint32_t, 3> vertices(uint32_t face);

  private:
    uint32_t newVertex(const HiddenLooks::Vertex& vertex);

    const HiddenLooks& looks_;
    std::string depthAttribute_;
    FractureGeometry& out_;
    std::vector<uint32_t> made_;  ///< per vertex of the looks
};

}  // namespace sherd
