// SPDX-License-Identifier: MIT
// Drawings on a page, cut into the surface they lie on.
#pragma once

#include "map/page_tiling.h"
#include "map/planar_map.h"
#include "surface/cutting_surface.h"

namespace sherd {

/// Lines of one page and their marks.
struct Page {
    FractureMap map;
    std::vector<uint32_t> marks;
};

/// The page's copies in a range of tiles.
void tilePage(Page& page, Wrap wrapU, Wrap wrapV, const TileRange& range);

class PageCutter {
  public:
    explicit PageCutter(CuttingSurface& work) : work_(work) {}

    /// Leads dangling ends on as the options ask.
    Result<void> closeGapsOf(Page& page);
    /// By texture coordinates, wrapped as the options ask. Only for a surface that no cut has
    /// changed yet. seamLine: mark that all chart borders get, 0: none.
    Result<void> cutByUv(Page& page, uint32_t seamLine);
    /// In the given frames, one per triangle.
    Result<void> cutPage(const Page& page, std::span<const UvTriangle> frames,
                         uint32_t seamLine = 0);

  private:
    struct Wrapping {
        Wrap u = Wrap::repeat, v = Wrap::repeat;
        bool repeats = true;
    };
    /// What the picture of most triangles does outside its page, or what was asked for.
    Wrapping wrapping();
    /// Lines that lie wholly outside every chart.
    void noteLinesOffCharts(const Page& page, const PlanarMap& map, std::span<const Cut> cuts);

    CuttingSurface& work_;
};

}  // namespace sherd
