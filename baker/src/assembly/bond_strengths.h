// SPDX-License-Identifier: MIT
// What it takes to break a bond: who says it, and who wins.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "assembly/hierarchy.h"
#include "assembly/labels.h"
#include "assembly/line_strengths.h"
#include "levels/cluster_level.h"
#include "levels/level_order.h"
#include "sherd/baker/recipe.h"

namespace sherd {

/// The weaker of two pieces gives way. A piece is as strong as a label of a drawing says; failing
/// that, as the level says at which the two part; failing that, as its material or the recipe says
/// in general. Where lines run along the border of the two, what they say wins over all.
class BondStrengths {
  public:
    /// Of a level of the set.
    struct Level {
        std::optional<double> strength;   ///< Pa
        std::optional<double> toughness;  ///< J/m^2
    };

    BondStrengths(BorderStrengths lines, std::vector<Level> levels);

    /// Pieces of which a label says how strong they are.
    void addLabels(const std::vector<PlacedLabel>& labels, const Components& components,
                   const Hierarchy& hierarchy);

    /// Sets the strength and toughness of a bond between two leaves of the set, a below b.
    void apply(const FractureSet& set, Bond& bond) const;

  private:
    const Level& partingLevel(const FractureSet& set, const Bond& bond) const;

    BorderStrengths lines_;
    std::vector<Level> levels_;               ///< from level 0 of the set
    std::vector<uint8_t> labelledStrength_;   ///< per fragment
    std::vector<uint8_t> labelledToughness_;  ///< per fragment
};

/// Per level of the set, from 0, the recipe's that it came from; none where lines modelled on the
/// object made it. plan: of these levels; `order` and `lines` of the cut surface, `clusters` among
/// them.
std::vector<std::optional<size_t>> levelOrigins(const std::vector<RecipeLevel>& levels,
                                                const FracturePlan& plan, const LevelOrder& order,
                                                std::span<const ClusterAt> clusters,
                                                const LineTable& lines, size_t levelCount);

}  // namespace sherd
