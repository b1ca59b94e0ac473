// SPDX-License-Identifier: MIT
#include "pattern/grow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

#include "pattern/surface_voronoi.h"

namespace sherd {
namespace {

/// Shares `count` out by weight, one each at least; what rounding leaves goes to the largest
/// remainders (Hamilton's method).
std::vector<uint32_t> shareOut(uint32_t count, const std::vector<double>& weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<uint32_t> share(weights.size(), 1);
    if (count <= weights.size() || !(total > 0)) return share;
    const double rest = count - static_cast<double>(weights.size());
    std::vector<std::pair<double, size_t>> remainder;
    uint32_t given = static_cast<uint32_t>(weights.size());
    for (size_t i = 0; i < weights.size(); ++i) {
        // What a domain is due beyond the one it has.
        const double due = rest * weights[i] / total;
        const auto whole = static_cast<uint32_t>(due);
        share[i] += whole;
        given += whole;
        remainder.emplace_back(whole - due, i);
    }
    std::sort(remainder.begin(), remainder.end());
    for (size_t k = 0; given < count; ++k, ++given) ++share[remainder[k % remainder.size()].second];
    return share;
}

/// A vertex that no triangle uses must not coarsen the grid.
std::vector<glm::vec3> usedPositions(const SplitSurface& surface) {
    std::vector<glm::vec3> used;
    used.reserve(3 * surface.triangles.size());
    for (const SplitTriangle& t : surface.triangles)
        for (const uint32_t v : t.v) used.push_back(surface.positions[v]);
    return used;
}

/// The sites of every domain, to find the cell of a place later.
struct CellFinder {
    SiteGrid grid;
    std::vector<SiteTree> sites;
    std::vector<uint32_t> first;  ///< number of each domain's first cell
};

}  // namespace

Domains findDomains(const GrowthInput& input) {
    Domains domains;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> number;
    for (uint32_t t = 0; t < input.surface.triangles.size(); ++t) {
        const uint32_t group = input.groups.group[input.surface.triangles[t].source];
        const auto [it, isNew] = number.try_emplace(std::pair(input.piece[t], group),
                                                    static_cast<uint32_t>(number.size()));
        if (isNew) domains.triangles.emplace_back();
        domains.ofTriangle.push_back(it->second);
        if (input.topology.degenerate[t] == 0) domains.triangles[it->second].push_back(t);
    }
    return domains;
}

Growth growCells(const GrowthInput& input, const Pattern& pattern, uint32_t level, uint32_t line) {
    const Domains domains = findDomains(input);
    std::vector<double> weights;
    for (const auto& triangles : domains.triangles) {
        const std::vector<double> areas = weightedAreas(input.surface, triangles, input.density);
        weights.push_back(std::accumulate(areas.begin(), areas.end(), 0.0));
    }
    const std::vector<uint32_t> share = shareOut(pattern.count, weights);
    const bool wood = pattern.kind == Pattern::Kind::wood;
    const auto finder = std::make_shared<CellFinder>(CellFinder{
        SiteGrid(usedPositions(input.surface), input.grain, wood ? pattern.elongation : 1),
        {},
        {}});

    Growth growth;
    uint32_t cells = 0;  // of the domains so far
    for (size_t d = 0; d < domains.triangles.size(); ++d) {
        SamplingOptions options;
        options.seed = pattern.seed + 0x9E3779B97F4A7C15ULL * d;
        options.jitter = pattern.jitter < 0 ? 0.5 : pattern.jitter;
        options.density = input.density;
        const std::vector<SitePoint> sites =
            sampleSites(input.surface, domains.triangles[d], share[d], finder->grid, options);
        finder->first.push_back(cells);
        cells += static_cast<uint32_t>(sites.size());
        finder->sites.emplace_back(sites);
        const std::vector<Chord> borders = voronoiBorders(input.surface, domains.triangles[d],
                                                          finder->grid, finder->sites.back(), line);
        growth.chords.insert(growth.chords.end(), borders.begin(), borders.end());
    }
    growth.cells.level = level;
    growth.cells.domain = domains.ofTriangle;
    growth.cells.domains = static_cast<uint32_t>(domains.triangles.size());
    growth.cells.asked = pattern.count;
    growth.cells.text = pattern.text;
    growth.cells.cellOf = [finder](uint32_t domain, uint32_t, const glm::dvec3& position) {
        const SiteTree& sites = finder->sites[domain];
        return sites.sites().empty()
                   ? finder->first[domain]
                   : finder->first[domain] + sites.nearest(finder->grid.snap(position));
    };
    CellSites sites;
    for (const SiteTree& tree : finder->sites)
        for (const SitePoint& s : tree.sites())
            sites.sites.emplace_back(static_cast<double>(s.x), static_cast<double>(s.y),
                                     static_cast<double>(s.z));
    sites.place = [finder](const glm::dvec3& position) { return finder->grid.place(position); };
    growth.cells.sites = std::make_shared<const CellSites>(std::move(sites));
    return growth;
}

}  // namespace sherd
