// SPDX-License-Identifier: MIT
#include "measures/measures.h"

#include <algorithm>

#include "measures/collider_measures.h"
#include "measures/hidden_area.h"
#include "measures/level_coverage.h"
#include "measures/self_intersections.h"
#include "measures/thickness.h"
#include "message_text.h"

namespace sherd {
namespace {

void fillCoverage(const LevelCoverage& coverage, BakedObjectReport& report) {
    for (size_t k = 0; k < report.levels.size(); ++k) {
        const LevelCoverage::Level& level = coverage.levels[k];
        // What is open has no inside to be counted: the object itself, where caps close its pieces.
        if (level.points == 0 || (k == 0 && !report.fragments[0].closed)) continue;
        report.levels[k].coverageNone = static_cast<double>(level.none) / level.points;
        report.levels[k].coverageDouble = static_cast<double>(level.several) / level.points;
    }
    for (size_t f = 0; f < report.fragments.size(); ++f) {
        const LevelCoverage::Share& share = coverage.fragments[f];
        if (share.points > 0)
            report.fragments[f].overlap = static_cast<double>(share.shared) / share.points;
    }
}

/// The fragments' measures taken together.
void summarise(const FractureSet& set, const std::vector<FragmentArea>& areas, uint32_t level,
               BakedObjectReport& report) {
    BakedLevelReport& entry = report.levels[level];
    FragmentArea area;
    for (const uint32_t f : fragmentsAtLevel(set, level)) {
        const BakedFragmentReport& fragment = report.fragments[f];
        area.whole += areas[f].whole;
        area.hidden += areas[f].hidden;
        if (fragment.protrusion)
            entry.protrusion = std::max(entry.protrusion.value_or(0), *fragment.protrusion);
        if (fragment.selfIntersections)
            entry.selfIntersections =
                entry.selfIntersections.value_or(0) + *fragment.selfIntersections;
        if (fragment.thinnest)
            entry.thinnest =
                std::min(entry.thinnest.value_or(*fragment.thinnest), *fragment.thinnest);
    }
    entry.hiddenShare = area.whole > 0 ? area.hidden / area.whole : 0;
}

void measureSlowly(const ShownTriangles& shown, const OriginalSolid& solid, unsigned threads,
                   BakedObjectReport& report) {
    const BoxTree tree(boxesOf(shown.set().geometry.positions, shown.corners()));
    fillCoverage(levelCoverage(shown, tree, solid, {.threads = threads}), report);
    const std::vector<double> protrusion = protrusions(shown, solid, threads);
    const std::vector<double> thinnest = thinnestParts(shown.set(), {.threads = threads});
    const SelfIntersections crossings = selfIntersections(shown, tree, {.threads = threads});
    for (size_t f = 0; f < report.fragments.size(); ++f) {
        BakedFragmentReport& fragment = report.fragments[f];
        fragment.protrusion = protrusion[f];
        fragment.selfIntersections = crossings.ofFragment[f];
        if (thinnest[f] > 0) fragment.thinnest = thinnest[f];
    }
    measureColliders(shown.set(), {.threads = threads}, report);
    if (crossings.complete) return;
    report.findings.push_back({"many-intersections",
                               "too many triangles lie in one place to compare each with each; the "
                               "self-intersections counted are the least that there are",
                               "", 1});
}

/// What geometry should hold and does not.
void judge(BakedObjectReport& report) {
    constexpr double kMostNone = 0.02, kMostDouble = 0.01, kDeepest = 1e-5;
    double none = 0, twice = 0, protrusion = 0;
    for (const BakedLevelReport& level : report.levels) {
        none = std::max(none, level.coverageNone.value_or(0));
        twice = std::max(twice, level.coverageDouble.value_or(0));
        protrusion = std::max(protrusion, level.protrusion.value_or(0));
    }
    if (none > kMostNone || twice > kMostDouble) {
        report.findings.push_back({"coverage",
                                   text("%.3g %%", 100 * none) +
                                       " of the object is in no piece, and " +
                                       text("%.3g %%", 100 * twice) + " in several",
                                   "", 1});
    }
    if (protrusion > kDeepest * report.diagonal) {
        report.findings.push_back(
            {"protrusion",
             "hidden faces reach out of the object by up to " + text("%.3g m", protrusion) + ": " +
                 text("%.3g", protrusion / report.diagonal) + " of its diagonal",
             "", 1});
    }
}

}  // namespace

void measureSet(const FractureSet& set, const OriginalSolid* solid, unsigned threads,
                BakedObjectReport& report) {
    const ShownTriangles shown(set);
    const std::vector<FragmentArea> areas = fragmentAreas(shown);
    for (size_t f = 0; f < report.fragments.size(); ++f)
        report.fragments[f].hiddenShare = areas[f].whole > 0 ? areas[f].hidden / areas[f].whole : 0;
    if (solid != nullptr) measureSlowly(shown, *solid, threads, report);
    for (uint32_t level = 0; level < report.levels.size(); ++level)
        summarise(set, areas, level, report);
    judge(report);
}

}  // namespace sherd
