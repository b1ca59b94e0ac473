// SPDX-License-Identifier: MIT
#include "levels/level_arranging.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "assembly/labels.h"
#include "geometry/compact_labels.h"
#include "levels/drawn_classes.h"
#include "levels/level_exposure.h"
#include "levels/piece_cut.h"
#include "levels/piece_names.h"
#include "levels/sliver_joining.h"
#include "levels/volume_level.h"

namespace sherd {
namespace {

class Arranger {
  public:
    Arranger(const LevelOrder& order, const FracturePlan& plan, const ArrangeOptions& options,
             const ArrangedObject& object, BakedObjectReport& report)
        : order_(order),
          plan_(plan),
          options_(options),
          object_(object),
          model_{object.mesh, object.cut.surface, object.components, object.hidden},
          classes_(object.cut, object.components),
          drawnLevels_(object.components.levels),
          drawnOf_(object.components.leafCount),
          skipped_(object.components.leafCount),
          report_(report) {
        std::iota(drawnOf_.begin(), drawnOf_.end(), 0U);
    }

    Result<void> run() {
        begin(order_.plainLevels());
        for (size_t k = order_.plainLevels(); k < order_.levels().size(); ++k) {
            const OrderedLevel& level = order_.levels()[k];
            if (level.cut != nullptr) tellInnerSheets();
            if (auto ok = level.cut != nullptr ? cut(*level.cut) : part(level); !ok) return ok;
            if (auto ok = joinThin(level); !ok) return ok;
            exposeWalls(model_);
            mergeWhatStays(k + 1);
        }
        showWhatIsApart();
        for (HiddenMesh::Face& face : object_.hidden.faces)
            face.fragment = object_.components.at(face.exposedFrom, face.leaf);
        if (surfaceIsCut_) updateTopology();
        return {};
    }

  private:
    /// Back to the first levels, which need nothing but lines.
    void begin(uint32_t levels) {
        Components& components = object_.components;
        components.levels = levels;
        components.ofLeaf.resize(levels);
        components.count.resize(levels);
        report_.levels.resize(levels + 1);
        // Sheets have one side, and show whenever anything does.
        for (HiddenMesh::Face& face : object_.hidden.faces)
            if (face.exposedFrom > std::max(levels, face.wall ? 0U : 1U))
                face.exposedFrom = kNotExposed;
    }

    Result<void> joinThin(const OrderedLevel& level) {
        const uint32_t joined = joinSlivers(model_);
        if (joined == 0) return {};
        const Components& components = object_.components;
        const uint32_t now = components.count.back();
        report_.levels.back().components = now;
        report_.findings.push_back(
            {"slivers", "pieces of hardly any volume were joined to a neighbour",
             level.cut != nullptr ? level.cut->text : "level " + std::to_string(components.levels),
             joined});
        const bool divides = now > (components.levels > 1 ? components.count.end()[-2] : 1);
        if (divides) return {};
        return fail(ErrorCode::separatesNothing,
                    "level " + std::to_string(components.levels) +
                        " divides pieces into parts of which all but one have hardly any volume",
                    where(level));
    }

    Result<void> cut(const VolumeCut& cut) {
        const std::vector<PieceName> names = namesFor(cut.only);
        const Result<std::vector<uint32_t>> parents =
            cutLevel(cut, options_.threads, names, model_, report_);
        if (!parents) return tl::unexpected(parents.error());
        surfaceIsCut_ = topologyIsOld_ = true;
        std::vector<uint32_t> drawnOf;
        std::vector<std::set<uint32_t>> skipped;
        for (const uint32_t parent : *parents) {
            drawnOf.push_back(drawnOf_[parent]);
            skipped.push_back(skipped_[parent]);
        }
        drawnOf_ = std::move(drawnOf);
        skipped_ = std::move(skipped);
        return {};
    }

    /// A level of lines lets leaves part.
    Result<void> part(const OrderedLevel& level) {
        const std::vector<std::vector<uint32_t>> pieces = leavesOfPieces(object_.components);
        const Result<std::vector<uint8_t>> chosen = choose(level, pieces);
        if (!chosen) return tl::unexpected(chosen.error());
        Components& components = object_.components;
        std::vector<std::pair<uint32_t, uint32_t>> labels(components.leafCount);
        for (uint32_t p = 0; p < pieces.size(); ++p) {
            for (const uint32_t leaf : pieces[p]) labels[leaf] = {p, 0};
            if ((*chosen)[p] == 0)
                for (const uint32_t leaf : pieces[p]) skipped_[leaf].insert(level.drawn);
            else
                divide(level.drawn, pieces[p], labels);
        }
        components.ofLeaf.push_back(compactLabels(labels, components.count.emplace_back()));
        ++components.levels;
        report_.levels.emplace_back().components = components.count.back();
        if (components.count.back() > pieces.size()) return {};
        return fail(ErrorCode::separatesNothing,
                    "the lines of level " + std::to_string(components.levels) +
                        " divide no piece of the level before that they are to divide; draw lines "
                        "that close around part of one, also where they run over its neighbours",
                    where(level));
    }

    Result<std::vector<uint8_t>> choose(const OrderedLevel& level,
                                        const std::vector<std::vector<uint32_t>>& pieces) {
        if (level.only == nullptr) return std::vector<uint8_t>(pieces.size(), 1);
        const PieceChoice choice = inObjectFrame(*level.only, object_.mesh);
        const std::vector<std::vector<uint32_t>> ofLeaves = facesOfLeaves(model_);
        std::vector<std::vector<uint32_t>> faces(pieces.size());
        for (size_t p = 0; p < pieces.size(); ++p)
            for (const uint32_t leaf : pieces[p])
                faces[p].insert(faces[p].end(), ofLeaves[leaf].begin(), ofLeaves[leaf].end());
        Result<std::vector<uint8_t>> chosen = choosePieces(choice, model_, namesFor(choice), faces);
        if (chosen) return chosen;
        return fail(
            chosen.error().code, chosen.error().message,
            where(level) + ", the lines of level " + std::to_string(object_.components.levels + 1));
    }

    /// A piece of which the lines divide nothing that hangs together stays whole.
    void divide(uint32_t drawn, const std::vector<uint32_t>& leaves,
                std::vector<std::pair<uint32_t, uint32_t>>& labels) {
        const std::set<uint32_t>& skipped = skipped_[leaves[0]];
        const std::vector<uint32_t> before = classes_.at(drawn - 1, skipped);
        const std::vector<uint32_t>& now = classes_.at(drawn, skipped);
        std::map<uint32_t, uint32_t> nowOf;  // by what it was
        const bool divided = std::any_of(leaves.begin(), leaves.end(), [&](uint32_t leaf) {
            const uint32_t d = drawnOf_[leaf];
            return nowOf.try_emplace(before[d], now[d]).first->second != now[d];
        });
        if (!divided) return;
        for (const uint32_t leaf : leaves) labels[leaf].second = now[drawnOf_[leaf]];
    }

    /// Leaves that no level to come lets part are one.
    void mergeWhatStays(size_t next) {
        const std::vector<OrderedLevel>& levels = order_.levels();
        const bool linesFollow =
            std::any_of(levels.begin() + static_cast<ptrdiff_t>(next), levels.end(),
                        [](const OrderedLevel& level) { return level.cut == nullptr; });
        const Components& components = object_.components;
        std::vector<std::pair<uint32_t, uint32_t>> keys;
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
            const uint32_t drawn =
                linesFollow ? classes_.at(drawnLevels_, skipped_[leaf])[drawnOf_[leaf]] : 0;
            keys.emplace_back(components.at(components.levels, leaf), drawn);
        }
        uint32_t count = 0;
        const std::vector<uint32_t> classes = compactLabels(keys, count);
        if (count == components.leafCount) return;
        mergeClasses(classes, model_);
        // Any of them stands for its class.
        std::vector<uint32_t> drawnOf(count);
        std::vector<std::set<uint32_t>> skipped(count);
        for (uint32_t leaf = 0; leaf < classes.size(); ++leaf) {
            drawnOf[classes[leaf]] = drawnOf_[leaf];
            skipped[classes[leaf]] = skipped_[leaf];
        }
        drawnOf_ = std::move(drawnOf);
        skipped_ = std::move(skipped);
    }

    void showWhatIsApart() {
        const auto isApart = [](const BakeFinding& f) { return f.code == "walls-apart"; };
        if (std::none_of(report_.findings.begin(), report_.findings.end(), isApart)) return;
        const uint32_t shown = showOpenPieces(model_);
        if (shown == 0) return;
        report_.findings.push_back({"early-walls",
                                    "pieces show walls inside that are to part them later, for the "
                                    "two sides of these are cut in other ways",
                                    "", shown});
    }

    /// Caps of a cut end at sheets, so these show with it: as hollows, for the lines that made them
    /// do not cut yet.
    void tellInnerSheets() {
        if (object_.components.levels > 0 || options_.shells) return;
        const auto sheets = std::count_if(object_.hidden.faces.begin(), object_.hidden.faces.end(),
                                          [](const HiddenMesh::Face& face) { return !face.wall; });
        if (sheets == 0) return;
        report_.findings.push_back(
            {"inner-sheets",
             "the medial surface of lines that cut later shows inside pieces of the levels before "
             "them, as a crack between the two sides of the solid; \"interior\": \"solid\" has "
             "none",
             "level 1", 1});
    }

    std::vector<PieceName> namesFor(const PieceChoice& choice) {
        if (choice.name.empty()) return {};
        if (topologyIsOld_) updateTopology();
        std::vector<BakeFinding> toldLater;
        return namesOf(
            placeLabels(object_.mesh, object_.cut, plan_, options_.snapDistance, toldLater), order_,
            object_.components);
    }

    void updateTopology() {
        object_.cut.topology =
            buildTopology(object_.cut.surface.positions, vertexTriangles(object_.cut.surface));
        topologyIsOld_ = false;
    }

    std::string where(const OrderedLevel& level) const {
        return "mesh \"" + object_.mesh.name + "\"" +
               (level.where.empty() ? "" : ", " + level.where);
    }

    const LevelOrder& order_;
    const FracturePlan& plan_;
    const ArrangeOptions& options_;
    const ArrangedObject& object_;
    PieceModel model_;
    DrawnClasses classes_;
    uint32_t drawnLevels_;
    std::vector<uint32_t> drawnOf_;            ///< per leaf: of the drawing
    std::vector<std::set<uint32_t>> skipped_;  ///< per leaf: drawn levels that do not cut it
    bool surfaceIsCut_ = false, topologyIsOld_ = false;
    BakedObjectReport& report_;
};

}  // namespace

Result<void> arrangeLevels(const LevelOrder& order, const FracturePlan& plan,
                           const ArrangeOptions& options, const ArrangedObject& object,
                           BakedObjectReport& report) {
    return Arranger(order, plan, options, object, report).run();
}

}  // namespace sherd
