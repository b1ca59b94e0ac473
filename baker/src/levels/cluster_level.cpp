// SPDX-License-Identifier: MIT
#include "levels/cluster_level.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/compact_labels.h"
#include "graph/graph_partition.h"
#include "levels/piece_graph.h"
#include "levels/wall_exposure.h"
#include "message_text.h"
#include "sherd/baker/pattern.h"

namespace sherd {
namespace {

/// The pieces of one level of a model, as if they were its leaves.
class LevelPieces {
  public:
    LevelPieces(const PieceModel& model, uint32_t level) : model_(model), level_(level) {
        const Components& all = model.components;
        pieces_.levels = level;
        pieces_.leafCount = level == 0 ? 1 : all.count[level - 1];
        pieces_.ofLeaf.assign(level, std::vector<uint32_t>(pieces_.leafCount));
        for (uint32_t leaf = 0; leaf < all.leafCount; ++leaf)
            for (uint32_t k = 1; k <= level; ++k)
                pieces_.ofLeaf[k - 1][all.at(level, leaf)] = all.at(k, leaf);
    }

    Result<std::vector<uint8_t>> choose(const PieceChoice& choice,
                                        const std::vector<PieceName>& names) {
        if (choice.all()) return std::vector<uint8_t>(pieces_.leafCount, 1);
        std::vector<PieceName> known;
        for (const PieceName& name : names)
            if (name.level <= level_) known.push_back(name);
        return choosePieces(choice, {model_.mesh, model_.surface, pieces_, model_.hidden}, known,
                            shownFaces());
    }

  private:
    std::vector<std::vector<uint32_t>> shownFaces() const {
        std::vector<std::vector<uint32_t>> faces(pieces_.leafCount);
        const auto outer = static_cast<uint32_t>(model_.surface.triangles.size());
        const Components& all = model_.components;
        for (uint32_t t = 0; t < outer; ++t) faces[all.at(level_, all.leaf[t])].push_back(t);
        for (uint32_t f = 0; f < model_.hidden.faces.size(); ++f) {
            const HiddenMesh::Face& face = model_.hidden.faces[f];
            if (face.exposedFrom <= level_) faces[all.at(level_, face.leaf)].push_back(outer + f);
        }
        return faces;
    }

    const PieceModel& model_;
    uint32_t level_;
    Components pieces_;
};

/// What one cluster came to.
struct Grouping {
    std::vector<uint32_t> ofLeaf;
    uint32_t groups = 0;
    uint32_t divided = 0;  ///< pieces of the level before with more than one group
    uint32_t grouped = 0;  ///< groups of more than one piece
    uint32_t chosen = 0;   ///< pieces of the level before
    uint32_t few = 0;      ///< of these: with fewer pieces than groups are asked
    uint32_t apart = 0;    ///< of these: with parts that no bond joins
    double smallest = std::numeric_limits<double>::max();  ///< volume over the mean in its piece
    double largest = 0;
};

class Clustering {
  public:
    Clustering(std::span<const ClusterAt> clusters, const ClusterSettings& settings,
               const std::vector<PieceName>& names, const PieceModel& model,
               BakedObjectReport& report)
        : clusters_(clusters),
          names_(names),
          model_(model),
          report_(report),
          leaves_(pieceGraph(model, settings.sheetTolerance, settings.threads)),
          groupings_(clusters.size()) {}

    Result<void> run() {
        for (size_t n = clusters_.size(); n-- > 0;) {
            const Cluster& cluster = *clusters_[n].cluster;
            if (auto done = groupAt(n); !done) {
                std::string where =
                    "mesh \"" + model_.mesh.name + "\", cluster \"" + cluster.text + "\"";
                if (!cluster.where.empty()) where += ", " + cluster.where;
                return fail(done.error().code, done.error().message, where);
            }
        }
        for (size_t n = 0; n < clusters_.size(); ++n) tell(n);
        insert();
        return {};
    }

  private:
    Result<void> groupAt(size_t n) {
        const auto& [cluster, above] = clusters_[n];
        if (above >= model_.components.levels) {
            return fail(ErrorCode::badArgument,
                        "there is no finer level to group: lines or cuts must come behind it");
        }
        const bool groupsGroups = n + 1 < clusters_.size() && clusters_[n + 1].above == above;
        const std::vector<uint32_t>& finer =
            groupsGroups ? groupings_[n + 1].ofLeaf : model_.components.ofLeaf[above];
        const PieceChoice choice = inObjectFrame(cluster->only, model_.mesh);
        const Result<std::vector<uint8_t>> chosen =
            LevelPieces(model_, above).choose(choice, names_);
        if (!chosen) return tl::unexpected(chosen.error());
        groupings_[n] = group(*cluster, above, finer, *chosen);
        return judge(*cluster, groupings_[n]);
    }

    Grouping group(const Cluster& cluster, uint32_t above, const std::vector<uint32_t>& finer,
                   const std::vector<uint8_t>& chosen) const {
        const uint32_t leafCount = model_.components.leafCount;
        std::vector<uint32_t> parent(leafCount);
        for (uint32_t leaf = 0; leaf < leafCount; ++leaf)
            parent[leaf] = model_.components.at(above, leaf);
        const WeightedGraph graph = groupGraph(leaves_, finer, parent);
        std::vector<std::vector<uint32_t>> pieces(chosen.size());
        std::vector<uint8_t> listed(graph.count(), 0);
        for (uint32_t leaf = 0; leaf < leafCount; ++leaf)
            if (std::exchange(listed[finer[leaf]], uint8_t{1}) == 0)
                pieces[parent[leaf]].push_back(finer[leaf]);
        Grouping result;
        std::vector<uint32_t> groupOf(graph.count(), 0);
        for (size_t p = 0; p < pieces.size(); ++p) {
            std::sort(pieces[p].begin(), pieces[p].end());
            if (chosen[p] != 0) {
                divide(cluster, graph, pieces[p], result, groupOf);
            } else {
                for (const uint32_t piece : pieces[p]) groupOf[piece] = result.groups;
                ++result.groups;
            }
        }
        for (uint32_t leaf = 0; leaf < leafCount; ++leaf)
            result.ofLeaf.push_back(groupOf[finer[leaf]]);
        // Numbered by their first leaves, as all components are.
        result.ofLeaf = compactLabels(result.ofLeaf, result.groups);
        return result;
    }

    /// The pieces within one of the level before.
    static void divide(const Cluster& cluster, const WeightedGraph& graph,
                       const std::vector<uint32_t>& pieces, Grouping& result,
                       std::vector<uint32_t>& groupOf) {
        const WeightedGraph part = graph.part(pieces);
        const GraphPartition partition = partitionGraph(part, {cluster.count, cluster.evenness});
        std::vector<double> volumes(partition.parts, 0);
        std::vector<uint32_t> sizes(partition.parts, 0);
        double whole = 0;
        for (uint32_t n = 0; n < pieces.size(); ++n) {
            groupOf[pieces[n]] = result.groups + partition.part[n];
            volumes[partition.part[n]] += part.weight(n);
            ++sizes[partition.part[n]];
            whole += part.weight(n);
        }
        for (uint32_t g = 0; g < partition.parts && whole > 0; ++g) {
            const double share = volumes[g] * partition.parts / whole;
            result.smallest = std::min(result.smallest, share);
            result.largest = std::max(result.largest, share);
        }
        for (const uint32_t size : sizes) result.grouped += size > 1 ? 1 : 0;
        ++result.chosen;
        result.groups += partition.parts;
        result.divided += partition.parts > 1 ? 1 : 0;
        result.few += pieces.size() < cluster.count ? 1 : 0;
        result.apart += partition.components > 1 ? 1 : 0;
    }

    static Result<void> judge(const Cluster& cluster, const Grouping& made) {
        if (made.divided == 0) {
            return fail(ErrorCode::separatesNothing,
                        "the cluster makes one group of each piece of the level before, as that "
                        "is without it; ask for more groups");
        }
        if (made.grouped == 0) {
            return fail(ErrorCode::separatesNothing,
                        "the cluster groups nothing: it asks for " +
                            counted(cluster.count, "group") +
                            ", and nowhere has the finer level more pieces; ask for fewer groups");
        }
        if (made.groups <= kMostPieces) return {};
        return fail(ErrorCode::limitExceeded, "the cluster makes " + std::to_string(made.groups) +
                                                  " pieces; a bake holds at most " +
                                                  std::to_string(kMostPieces));
    }

    void tell(size_t n) {
        const Cluster& cluster = *clusters_[n].cluster;
        const Grouping& made = groupings_[n];
        const std::string where = "level " + std::to_string(clusters_[n].above + n + 1);
        std::string message =
            "the cluster " + cluster.text + " made " + counted(made.groups, "piece") +
            text(", of %.2f to %.2f", made.smallest, made.largest) + " times their mean volume";
        report_.findings.push_back({"cluster", message, where, 1});
        if (made.few > 0) {
            report_.findings.push_back({"cluster-few",
                                        "pieces of the level before have fewer pieces than groups "
                                        "were asked for: each is a group of its own there",
                                        where, made.few});
        }
        if (made.apart > 0) {
            report_.findings.push_back({"cluster-apart",
                                        "pieces of the level before have parts that no bond joins: "
                                        "no group holds pieces of several",
                                        where, made.apart});
        }
    }

    /// The new levels take their places among the others, in the components, the report, and in
    /// what hidden faces show.
    void insert() {
        Components& components = model_.components;
        std::vector<std::vector<uint32_t>> ofLeaf;
        std::vector<uint32_t> count;
        std::vector<BakedLevelReport> levels{report_.levels[0]};
        std::vector<LevelSpan> spans(components.levels + 1);
        size_t next = 0;
        for (uint32_t level = 1; level <= components.levels; ++level) {
            spans[level].first = static_cast<uint32_t>(ofLeaf.size()) + 1;
            for (; next < clusters_.size() && clusters_[next].above < level; ++next) {
                ofLeaf.push_back(std::move(groupings_[next].ofLeaf));
                count.push_back(groupings_[next].groups);
                levels.emplace_back().components = groupings_[next].groups;
            }
            ofLeaf.push_back(std::move(components.ofLeaf[level - 1]));
            count.push_back(components.count[level - 1]);
            levels.push_back(report_.levels[level]);
            spans[level].last = static_cast<uint32_t>(ofLeaf.size());
        }
        components.levels = static_cast<uint32_t>(ofLeaf.size());
        components.ofLeaf = std::move(ofLeaf);
        components.count = std::move(count);
        report_.levels = std::move(levels);
        exposeBetween(spans, model_);
    }

    std::span<const ClusterAt> clusters_;
    const std::vector<PieceName>& names_;
    const PieceModel& model_;
    BakedObjectReport& report_;
    PieceGraph leaves_;
    std::vector<Grouping> groupings_;  ///< per cluster
};

}  // namespace

uint32_t levelAmong(std::span<const ClusterAt> clusters, uint32_t level) {
    const auto before = std::count_if(clusters.begin(), clusters.end(),
                                      [level](const ClusterAt& c) { return c.above < level; });
    return level + static_cast<uint32_t>(before);
}

Result<void> addClusters(std::span<const ClusterAt> clusters, const ClusterSettings& settings,
                         const std::vector<PieceName>& names, const PieceModel& model,
                         BakedObjectReport& report) {
    return Clustering(clusters, settings, names, model, report).run();
}

}  // namespace sherd
