// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "map/bitmap_ink.h"
#include "map/centre_graph.h"

namespace sherd {

/// The drawing between its texels: ink where the interpolated darkness is above the threshold.
class InkField {
  public:
    explicit InkField(const Ink& ink) : ink_(ink) {}

    glm::dvec2 size() const { return {ink_.mask.width, ink_.mask.height}; }
    bool isInside(glm::dvec2 p) const {
        return p.x >= 0 && p.y >= 0 && p.x <= size().x && p.y <= size().y;
    }
    /// Above 0: ink. Beyond the picture as at its border.
    double at(glm::dvec2 p) const;
    /// How far the ink goes from `p`, which is in it, in direction `unit`; nothing if further than
    /// `reach` or out of the picture.
    std::optional<double> edge(glm::dvec2 p, glm::dvec2 unit, double reach) const;

  private:
    const Ink& ink_;
};

/// Moves a line's inner points half-way between the two edges of the ink beside them, then evens
/// out what is left of the texels' steps; sets their radius.
void refineLine(CentreLine& line, const InkField& field);

}  // namespace sherd
