// SPDX-License-Identifier: MIT
// Generated patterns, cut into the surface.
#pragma once

#include "pattern/grow.h"
#include "surface/cutting_surface.h"
#include "surface/page_frames.h"

namespace sherd {

class PatternCutter {
  public:
    explicit PatternCutter(CuttingSurface& work) : work_(work) {}

    /// Divides what lines of shallower levels left. The groups of parts must be known. mark: of the
    /// pattern's lines.
    Result<void> growPattern(const FracturePlan::Grown& grown, uint32_t mark);

  private:
    std::vector<uint32_t> piecesBefore(uint32_t level) const;
    Result<void> growPage(const Pattern& pattern, uint32_t level, uint32_t mark,
                          const Domains& domains);
    PagePlane radialPlane(const Pattern& pattern) const;

    CuttingSurface& work_;
};

}  // namespace sherd
