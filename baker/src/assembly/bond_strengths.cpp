// SPDX-License-Identifier: MIT
#include "assembly/bond_strengths.h"

#include <algorithm>
#include <utility>

namespace sherd {
namespace {

struct Side {
    float own;      ///< the piece's own
    bool labelled;  ///< a label says so
};

float weaker(Side a, Side b, const std::optional<double>& level) {
    for (Side* side : {&a, &b})
        if (level && !side->labelled) side->own = static_cast<float>(*level);
    return std::min(a.own, b.own);
}

bool isMarked(const std::vector<uint8_t>& marks, int32_t fragment) {
    return static_cast<size_t>(fragment) < marks.size() &&
           marks[static_cast<size_t>(fragment)] != 0;
}

}  // namespace

BondStrengths::BondStrengths(BorderStrengths lines, std::vector<Level> levels)
    : lines_(std::move(lines)), levels_(std::move(levels)) {}

void BondStrengths::addLabels(const std::vector<PlacedLabel>& labels, const Components& components,
                              const Hierarchy& hierarchy) {
    labelledStrength_.resize(hierarchy.leaves.size(), 0);
    labelledToughness_.resize(hierarchy.leaves.size(), 0);
    for (const PlacedLabel& placed : labels) {
        const Range leaves = hierarchy.leaves[fragmentOf(placed, components, hierarchy)];
        for (uint32_t r = leaves.first; r < leaves.first + leaves.count; ++r) {
            const uint32_t f = hierarchy.fragmentOfRank[r];
            if (placed.label->strength) labelledStrength_[f] = 1;
            if (placed.label->toughness) labelledToughness_[f] = 1;
        }
    }
}

const BondStrengths::Level& BondStrengths::partingLevel(const FractureSet& set,
                                                        const Bond& bond) const {
    static const Level kSilent;
    // Upwards to the two children of what they have in common: siblings are of one level.
    auto a = static_cast<size_t>(bond.a);
    auto b = static_cast<size_t>(bond.b);
    while (set.fragments[a].parent != set.fragments[b].parent) {
        size_t& deeper = set.fragments[a].level > set.fragments[b].level ? a : b;
        if (set.fragments[deeper].parent < 0) return kSilent;
        deeper = static_cast<size_t>(set.fragments[deeper].parent);
    }
    const uint32_t level = set.fragments[a].level;
    return level < levels_.size() ? levels_[level] : kSilent;
}

void BondStrengths::apply(const FractureSet& set, Bond& bond) const {
    const Fragment& a = set.fragments[static_cast<size_t>(bond.a)];
    const Fragment& b = set.fragments[static_cast<size_t>(bond.b)];
    const Level& level = partingLevel(set, bond);
    bond.strength = weaker({a.strength, isMarked(labelledStrength_, bond.a)},
                           {b.strength, isMarked(labelledStrength_, bond.b)}, level.strength);
    bond.toughness = weaker({a.toughness, isMarked(labelledToughness_, bond.a)},
                            {b.toughness, isMarked(labelledToughness_, bond.b)}, level.toughness);
    const auto said = lines_.find({static_cast<uint32_t>(bond.a), static_cast<uint32_t>(bond.b)});
    if (said == lines_.end()) return;
    bond.strength = static_cast<float>(said->second.strengthOr(bond.strength));
    bond.toughness = static_cast<float>(said->second.toughnessOr(bond.toughness));
}

std::vector<std::optional<size_t>> levelOrigins(const std::vector<RecipeLevel>& levels,
                                                const FracturePlan& plan, const LevelOrder& order,
                                                std::span<const ClusterAt> clusters,
                                                const LineTable& lines, size_t levelCount) {
    // Clusters have no number among lines and cuts.
    std::vector<size_t> drawn, cuts, groups, numbers;
    for (size_t k = 0; k < levels.size(); ++k) {
        (levels[k].cluster ? groups : levels[k].cut ? cuts : drawn).push_back(k);
        numbers.push_back(k + 1 - groups.size());
    }
    std::vector<std::optional<size_t>> origins(levelCount);
    for (uint32_t n = 0; n < order.levels().size() && levelAmong(clusters, n + 1) < levelCount;
         ++n) {
        const OrderedLevel& level = order.levels()[n];
        if (level.cut != nullptr) {
            const auto c = static_cast<size_t>(level.cut - plan.cuts.data());
            if (c < cuts.size()) origins[levelAmong(clusters, n + 1)] = cuts[c];
            continue;
        }
        // A drawing that alone has lines brings levels of its own.
        const uint32_t asked = lines.asked(level.drawn);
        const auto from = std::find_if(drawn.begin(), drawn.end(), [&](size_t k) {
            return numbers[k] == asked || (drawn.size() == 1 && numbers[k] < asked);
        });
        if (from != drawn.end()) origins[levelAmong(clusters, n + 1)] = *from;
    }
    for (size_t n = 0; n < std::min(clusters.size(), groups.size()); ++n)
        origins[clusters[n].above + n + 1] = groups[n];
    return origins;
}

}  // namespace sherd
