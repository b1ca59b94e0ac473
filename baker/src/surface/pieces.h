// SPDX-License-Identifier: MIT
// From patches of surface to pieces: a piece is what lines close off, or, where a pattern says
// which cell a place belongs to, all patches of one cell.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "surface/components.h"
#include "surface/part_groups.h"

namespace sherd {

/// Cells that consist of all that is nearest to a site, seen in a space of their own.
struct CellSites {
    std::vector<glm::dvec3> sites;                                ///< per cell
    std::function<glm::dvec3(const glm::dvec3& position)> place;  ///< a linear map
};

/// How the patches of one level make cells of a pattern.
struct CellLevel {
    uint32_t level = 1;
    /// Per triangle of the surface: what is divided apart from the rest, a piece of the level
    /// before in one group of parts.
    std::vector<uint32_t> domain;
    uint32_t domains = 0;
    /// Empty: every patch is a piece. The cell at a place: its domain, the mesh triangle it lies
    /// on, its position.
    std::function<uint32_t(uint32_t domain, uint32_t source, const glm::dvec3& position)> cellOf;
    std::shared_ptr<const CellSites> sites;  ///< where the cells of a domain have them
    /// All patches of a cell are its piece. Else, within one connected part, only its largest patch
    /// and those across the solid from it are; others join the neighbour with the longest border.
    bool wholeCells = false;
    uint32_t asked = 0;  ///< pieces of the level
    std::string text;    ///< the pattern as it was asked for
};

/// What became of a level of cells.
struct CellReport {
    uint32_t level = 1;
    uint32_t asked = 0;
    uint32_t made = 0;
    uint32_t domains = 0;
    uint32_t strays = 0;  ///< patches that joined a neighbour
    std::string text;
};

struct PatchOptions {
    bool splitPatches = false;  ///< every patch is a piece of its own, whatever its cell
};

/// The components of every level, with patches of one cell put together.
Components findPieces(const SplitSurface& surface, const MeshTopology& topology,
                      const LineTable& lines, uint32_t levels, const PartGroups& groups,
                      std::span<const CellLevel> cells, const PatchOptions& options,
                      std::vector<CellReport>& reports);

}  // namespace sherd
