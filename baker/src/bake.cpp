// SPDX-License-Identifier: MIT
// The pipeline: mesh + map -> split surface -> components -> closed fragments, cut further through
// their volume -> fracture set.
#include "sherd/baker/bake.h"

#include <algorithm>
#include <chrono>
#include <future>

#include "appearance/hidden_looks.h"
#include "assembly/anchors.h"
#include "assembly/colliders.h"
#include "assembly/geometry.h"
#include "assembly/labels.h"
#include "assembly/physics.h"
#include "assembly/piece_materials.h"
#include "bake_findings.h"
#include "geometry/closed_mesh.h"
#include "interior/hidden_points.h"
#include "interior/medial.h"
#include "interior/piece_mending.h"
#include "interior/point_merging.h"
#include "interior/shell.h"
#include "levels/bring_inside.h"
#include "levels/cluster_level.h"
#include "levels/level_arranging.h"
#include "levels/piece_names.h"
#include "measures/measures.h"
#include "recipe_use.h"
#include "repair/cap_holes.h"
#include "solid/line_carrying.h"
#include "solid/solid_leaves.h"
#include "surface/component_merging.h"
#include "surface/cut_settings.h"
#include "surface/cut_surface.h"
#include "surface/vertex_fans.h"

namespace sherd {
namespace {

using Clock = std::chrono::steady_clock;

/// How far apart facing sheets may be and still hold: share of the diagonal.
constexpr double kSheetTolerance = 1e-3;

/// One object's bake: what the stages hand to each other.
class Bake {
  public:
    Bake(const SurfaceMesh& mesh, const FracturePlan& plan, const Recipe& recipe,
         const InteriorMaterials& interior, const Progress& progress)
        : mesh_(mesh), plan_(plan), recipe_(recipe), interior_(interior), progress_(progress) {}

    Result<BakedObject> run() {
        if (auto ok = inspect(); !ok) return tl::unexpected(ok.error());
        // The medial surface depends on the mesh only, so it is computed beside the cutting; for
        // solid pieces only if one of them turns out to need it.
        const bool beside = recipe_.threads > 1 && closedBy_ != InteriorType::solid && hasLines();
        medial_ = std::async(beside ? std::launch::async : std::launch::deferred,
                             [this] { return findMedial(); });
        const Result<void> cutDone = cut();
        if (beside) medial_.wait();
        if (!cutDone) return tl::unexpected(cutDone.error());
        if (auto ok = stitchPieces(); !ok) return tl::unexpected(ok.error());
        hidden_ = hiddenMesh(mesh_, cut_.surface, components_, sheet_, pieces_.faces);
        const bool inOrder = order_.plainLevels() == order_.levels().size();
        if (inOrder && plan_.clusters.empty()) beginLooks();
        if (auto ok = proveClosed(); !ok) return tl::unexpected(ok.error());
        if (!inOrder) {
            if (auto ok = arrange(); !ok) return tl::unexpected(ok.error());
        }
        if (auto ok = groupPieces(); !ok) return tl::unexpected(ok.error());
        assemble();
        if (auto ok = judgeFragments(); !ok) return tl::unexpected(ok.error());
        return std::move(result_);
    }

  private:
    struct StageTimer {
        Bake& bake;
        std::string name;
        Clock::time_point start = Clock::now();
        ~StageTimer() {
            bake.report().stages.push_back(
                {name, std::chrono::duration<double>(Clock::now() - start).count()});
        }
    };
    StageTimer stage(const std::string& name, double share) {
        if (progress_) progress_(name, share);
        return {*this, name};
    }
    BakedObjectReport& report() { return result_.report; }

    Result<void> inspect() {
        const StageTimer timer = stage("topology", 0);
        report().name = mesh_.name;
        report().triangles = static_cast<uint32_t>(mesh_.triangles.size());
        report().diagonal = diagonal_ = diagonalOf(mesh_);
        for (const std::string& warning : mesh_.warnings)
            report().findings.push_back({"import", warning, "", 1});
        for (const FracturePlan::Drawing& drawing : plan_.drawings) {
            for (const std::string& warning : drawing.map.warnings)
                report().findings.push_back({"map", warning, "", 1});
        }
        if (auto ok = judgeSize(mesh_, diagonal_); !ok) return ok;
        meshTopology_ = buildTopology(mesh_.positions, mesh_.triangles);
        if (recipe_.capHoles && meshTopology_.boundaryEdges > 0) {
            const std::vector<HoleCap> caps = capHoles(meshTopology_, mesh_);
            if (auto ok = judgeCaps(mesh_, caps, recipe_.allowOpen, report()); !ok) return ok;
            meshTopology_ = buildTopology(mesh_.positions, mesh_.triangles);
        }
        if (auto ok = judgeTopology(mesh_, meshTopology_, recipe_.allowOpen, report()); !ok)
            return ok;
        open_ = meshTopology_.boundaryEdges > 0;
        closedBy_ = open_ ? InteriorType::shell : recipe_.interior.type;
        if (open_ && recipe_.interior.type == InteriorType::solid) {
            report().findings.push_back({"solid-fallback",
                                         "an open surface cannot be cut straight through: all its "
                                         "pieces are shells; close it, or try --cap-holes",
                                         "", 1});
        }
        Result<Thickness> thickness = thicknessOf(mesh_, recipe_.interior.shell, diagonal_);
        if (closedBy_ == InteriorType::shell && !thickness)
            return tl::unexpected(thickness.error());
        if (thickness) thickness_ = std::move(*thickness);
        const uint32_t touching = separateFans(meshTopology_, mesh_);
        if (touching > 0) {
            meshTopology_ = buildTopology(mesh_.positions, mesh_.triangles);
            report().findings.push_back(
                {"touching", "solids that touch in a vertex or edge were told apart there", "",
                 touching});
        }
        return {};
    }

    Result<MedialSurface> findMedial() {
        const auto start = Clock::now();
        MedialOptions options;
        options.thesis = recipe_.interior.thesis;
        options.preSmoothing = recipe_.interior.preSmoothing;
        options.postSmoothing = recipe_.interior.postSmoothing;
        options.separationAngle = recipe_.interior.separationAngle;
        options.scaleAxis = recipe_.interior.scaleAxis;
        options.smallestRadius = recipe_.interior.smallestRadius;
        options.open = open_;
        options.threads = recipe_.threads;
        Result<MedialSurface> medial = medialSurface(mesh_, meshTopology_, options);
        medialSeconds_ = std::chrono::duration<double>(Clock::now() - start).count();
        return medial;
    }

    /// Thesis steps 1 to 5: the surface is cut into components.
    Result<void> cut() {
        const StageTimer timer = stage("cutting", 0.1);
        Result<CutSurface> done =
            cutSurface(mesh_, meshTopology_, plan_, cutOptionsOf(recipe_, diagonal_));
        if (!done) return tl::unexpected(done.error());
#ifdef SHERD_VALIDATE
        if (!isFaithfulSplit(mesh_, meshTopology_, *done, 1e-4)) {
            return fail(ErrorCode::internal, "cutting changed the surface; please report it",
                        mesh_.name);
        }
#endif
        cut_ = std::move(*done);
        order_ = LevelOrder(plan_, cut_.lines);
        if (cut_.lines.size() == 0 && !plan_.cuts.empty()) return beginWhole();
        if (closedBy_ == InteriorType::solid) {
            const Result<CarriedLines> carried =
                carryLines(mesh_, cutOptionsOf(recipe_, diagonal_), cut_);
            if (!carried) return tl::unexpected(carried.error());
            carried_ = carried->edges > 0;
            reportCarried(*carried, report());
        }
        if (cut_.lines.size() == 0)
            return fail(ErrorCode::emptyMap, "there is no fracture line to cut along");
        std::vector<CellReport> cells;
        components_ = componentsOf(cut_, cells);
        reportCells(cells, order_, report());
        report().splitTriangles = static_cast<uint32_t>(cut_.surface.triangles.size());
        reportCutting(mesh_, cut_, components_, report());
        reportShading(mesh_, cut_, report());
        return judgeSeparation(components_, cut_, order_, report());
    }

    bool hasLines() const {
        return !plan_.drawings.empty() || !plan_.patterns.empty() || !mesh_.lines.empty();
    }

    /// Without lines the object is the one piece there is to cut.
    Result<void> beginWhole() {
        components_.leaf.assign(cut_.surface.triangles.size(), 0);
        components_.leafCount = components_.parts = 1;
        report().levels.resize(1);
        report().levels[0].components = report().parts = 1;
        return {};
    }

    /// Thesis steps 6 and 7: hidden points, and every component closed by its sheet and walls.
    Result<void> stitchPieces() {
        if (components_.levels == 0) return {};
        const StageTimer timer = stage("stitching", 0.6);
        const std::vector<MergedLeaf> small = mergeSmallLeaves(
            cut_.surface, cut_.topology, recipe_.minimumComponentShare, components_);
        if (auto ok = closePieces(); !ok) return ok;
        reportPieces(mesh_, small, pieces_, report());
        return judgeMerged(components_, cut_, pieces_, order_, report());
    }

    /// Merging pieces without volume changes what can be solid: then all over again.
    Result<void> closePieces() {
        const InsideTest inside(mesh_.positions, mesh_.triangles);
        const TriangleBvh outer(mesh_.positions, mesh_.triangles);
        std::vector<MergedLeaf> merged;
        do {
            if (closedBy_ == InteriorType::solid)
                solid_ = findSolidLeaves(cut_, carried_, sheet_.points.empty(), components_);
            if (!solid_.containsAll() && medial_.valid()) {
                if (auto ok = takeMedial(); !ok) return ok;
            }
            setHubs(sheet_, solid_.hubs);
            const bool hasInside = !open_ || mostlyInside(inside, sheet_.points);
            pieces_ = mendPieces(cut_.surface, cut_.topology,
                                 {hasInside ? &inside : nullptr, outer, 1e-6 * diagonal_},
                                 recipe_.threads, sheet_, components_, solid_);
            merged.insert(merged.end(), pieces_.merged.begin(), pieces_.merged.end());
        } while (pieces_.stale);
        pieces_.merged = std::move(merged);
        if (closedBy_ == InteriorType::solid)
            reportSolid(mesh_, cut_, components_, solid_, report());
        return {};
    }

    Result<void> takeMedial() {
        const Result<MedialSurface> medial = medial_.get();
        report().stages.push_back({"medial surface (beside)", medialSeconds_});
        if (!medial) return tl::unexpected(medial.error());
        if (medial->delaunaySeconds > 0)
            report().stages.push_back({"of it, Delaunay", medial->delaunaySeconds});
        for (const std::string& warning : medial->warnings)
            report().findings.push_back({"medial", warning, "", 1});
        makeSheet(*medial);
        return {};
    }

    void makeSheet(const MedialSurface& medial) {
        const HiddenMap map = closedBy_ == InteriorType::shell
                                  ? shellMap(mesh_, medial, thickness_)
                                  : HiddenMap([&](uint32_t triangle, const glm::dvec3& weights) {
                                        return medial.at(triangle, weights);
                                    });
        sheet_ = plainSheet(cut_.surface, cut_.topology, hiddenPoints(mesh_, cut_.surface, map));
        if (!recipe_.interior.thesis) {
            SheetRefinement refinement{0.015 * diagonal_, 0.003 * diagonal_};
            refinement.threads = recipe_.threads;
            refineSheet(mesh_, cut_.surface, map, refinement, sheet_);
            if (closedBy_ != InteriorType::shell) {
                mergeNearPoints(0.01 * diagonal_, onBorders(cut_.topology, components_, sheet_),
                                sheet_);
            }
        }
        snapToFeet(1e-6 * diagonal_, sheet_);
    }

    /// Levels that cut through the volume or choose their pieces, and all behind them.
    Result<void> arrange() {
        const StageTimer timer = stage("cutting volumes", 0.72);
        const bool drawn = components_.levels > 0;
        if (auto ok = arrangeLevels(
                order_, plan_,
                {recipe_.snapShare * diagonal_, recipe_.threads, closedBy_ == InteriorType::shell},
                {mesh_, cut_, components_, hidden_}, report());
            !ok)
            return ok;
        const uint32_t outside =
            drawn && !open_ ? bringInside(mesh_, 1e-6 * diagonal_, hidden_) : 0;
        if (outside > 0) {
            report().findings.push_back(
                {"brought-inside",
                 "points where cuts meet walls that reach out of the object "
                 "were moved to its surface",
                 "", outside});
        }
        report().splitTriangles = static_cast<uint32_t>(cut_.surface.triangles.size());
        if (plan_.clusters.empty()) beginLooks();
        return {};
    }

    /// Levels of groups, between those that are there.
    Result<void> groupPieces() {
        if (plan_.clusters.empty()) return {};
        const StageTimer timer = stage("grouping", 0.74);
        for (const FracturePlan::Grouped& group : plan_.clusters)
            clusters_.push_back({&group.cluster, order_.above(group)});
        const PieceModel model{mesh_, cut_.surface, components_, hidden_};
        Result<void> done = addClusters(clusters_, {kSheetTolerance * diagonal_, recipe_.threads},
                                        namedPieces(), model, report());
        if (done) beginLooks();
        return done;
    }

    std::vector<PieceName> namedPieces() const {
        std::vector<BakeFinding> toldLater;
        return namesOf(placeLabels(mesh_, cut_, plan_, recipe_.snapShare * diagonal_, toldLater),
                       order_, components_);
    }

    /// How hidden faces look is worked out beside the proofs; assemble() waits for it.
    void beginLooks() {
        addHoleCaps(mesh_, cut_.surface, components_, hidden_);
        looks_ =
            std::async(recipe_.threads > 1 ? std::launch::async : std::launch::deferred, [this] {
                return hiddenLooks({mesh_, cut_.surface, components_, recipe_.interior, diagonal_},
                                   std::move(hidden_));
            });
    }

    /// Every fragment of every level, over vertex ids; over positions it is proven after assembly.
    Result<void> proveClosed() {
        const StageTimer timer = stage("proving closed", 0.7);
        for (uint32_t level = 1; level <= components_.levels; ++level) {
            const ClosedReport proof = proveByIds(levelTopology(
                cut_.surface, cut_.topology, sheet_, components_, pieces_.faces, level, solid_));
            // Where the mesh touches itself along an edge a piece may do the same.
            const bool excused =
                cut_.topology.pinchedEdges + cut_.topology.nonManifoldEdges > 0 && proof.closed();
            if (proof.manifold() || excused) continue;
            return fail(ErrorCode::notClosed,
                        "a fragment of level " + std::to_string(level) + " is not closed (" +
                            std::to_string(proof.openEdges) +
                            " open edges); nothing was written. This is a mistake in Sherd, please "
                            "report it",
                        "mesh \"" + mesh_.name + "\"");
        }
        return {};
    }

    /// Appends the materials of hidden faces; returns which lies below each of the mesh's.
    std::vector<uint32_t> addInteriorMaterials(std::vector<int32_t>& materials) const {
        const auto first = static_cast<std::ptrdiff_t>(materials.size());
        std::vector<uint32_t> slots;
        for (const int32_t outer : mesh_.materials) {
            const int32_t inner = interior_.under(outer);
            const auto known = std::find(materials.begin() + first, materials.end(), inner);
            slots.push_back(static_cast<uint32_t>(known - materials.begin()));
            if (known == materials.end()) materials.push_back(inner);
        }
        return slots;
    }

    void assemble() {
        FractureSet& set = result_.set;
        set.name = mesh_.name;
        set.node = mesh_.node;
        set.mesh = mesh_.mesh;
        set.restPose = mesh_.restPose;
        set.materials = mesh_.materials;
        const std::vector<uint32_t> interiorSlots = addInteriorMaterials(set.materials);
        const Hierarchy hierarchy = buildHierarchy(components_);
        assembleFragments(hierarchy, recipe_.physics, set);
        std::vector<BakeFinding>& findings = report().findings;
        std::vector<PlacedLabel> labels =
            placeLabels(mesh_, cut_, plan_, recipe_.snapShare * diagonal_, findings);
        for (PlacedLabel& placed : labels)
            placed.level = levelAmong(clusters_, order_.ofLabel(placed.label->level));
        const std::vector<std::optional<size_t>> origins =
            levelOrigins(recipe_.levels, plan_, order_, clusters_, cut_.lines, set.levels.size());
        for (size_t k = 1; k < origins.size(); ++k)
            if (origins[k] && origins[k] != origins[k - 1])
                set.levels[k].name = recipe_.levels[*origins[k]].name;
        {
            const StageTimer timer = stage("geometry", 0.75);
            const HiddenLooks looks = looks_.get();
            findings.insert(findings.end(), looks.findings.begin(), looks.findings.end());
            assembleGeometry({mesh_, cut_.surface, components_, hierarchy, looks, interiorSlots,
                              recipe_.interior},
                             set);
            assembleMaterials(
                {mesh_, cut_.surface, components_, hierarchy, looks.mesh, interior_.names},
                recipe_.materials, set);
        }
        for (const std::string& problem :
             assembleLabels(labels, components_, hierarchy, recipe_.materials, set))
            findings.push_back({"label", problem, "", 1});
        {
            const StageTimer timer = stage("masses", 0.8);
            const uint32_t boxed = assembleMasses(hierarchy, recipe_.threads, set);
            if (boxed > 0) {
                report().findings.push_back({"boxed-inertia",
                                             "pieces overlap themselves too much to have an "
                                             "inertia; their bounding box's was taken",
                                             "", boxed});
            }
        }
        {
            const StageTimer timer = stage("hulls", 0.85);
            assembleColliders(recipe_.physics, recipe_.threads, set);
        }
        const StageTimer timer = stage("bonds", 0.9);
        assembleBonds(hierarchy, bondStrengths(labels, hierarchy, origins),
                      kSheetTolerance * diagonal_, recipe_.threads, set);
        const std::vector<bool> holds = assembleAnchors(
            {cut_.surface, components_, hierarchy, labels, recipe_.anchors, diagonal_}, set);
        reportAnchors(mesh_, recipe_.anchors, holds, result_);
    }

    BondStrengths bondStrengths(const std::vector<PlacedLabel>& labels, const Hierarchy& hierarchy,
                                const std::vector<std::optional<size_t>>& origins) const {
        std::vector<BondStrengths::Level> levels(origins.size());
        for (size_t k = 0; k < origins.size(); ++k) {
            if (!origins[k]) continue;
            const RecipeLevel& said = recipe_.levels[*origins[k]];
            levels[k] = {said.strength, said.toughness};
        }
        BondStrengths strengths(
            lineStrengths(cut_.surface, cut_.topology, cut_.lines, components_, hierarchy),
            std::move(levels));
        strengths.addLabels(labels, components_, hierarchy);
        return strengths;
    }

    /// The last proof, over the positions that are written: no fragment that fails it leaves here.
    Result<void> judgeFragments() {
        {
            const StageTimer timer = stage("proving positions", 0.95);
            reportFragments(result_.set, closedBy_ == InteriorType::shell, report());
        }
        for (uint32_t level = 1; level <= components_.levels; ++level) {
            const BakedLevelReport& entry = report().levels[level];
            if (entry.closed == entry.fragments) continue;
            return fail(ErrorCode::notClosed,
                        std::to_string(entry.fragments - entry.closed) + " fragments of level " +
                            std::to_string(level) +
                            " are not closed; nothing was written. This is a "
                            "mistake in Sherd, please report it",
                        "mesh \"" + mesh_.name + "\"");
        }
        const StageTimer timer = stage("measures", 0.96);
        if (!recipe_.measure.value_or(false)) {
            measureSet(result_.set, nullptr, recipe_.threads, report());
            return {};
        }
        const InsideTest inside(mesh_.positions, mesh_.triangles);
        const InsideCells cells(inside, mesh_.positions, mesh_.triangles);
        const OriginalSolid solid{mesh_.positions, mesh_.triangles, cells};
        measureSet(result_.set, &solid, recipe_.threads, report());
        return {};
    }

    SurfaceMesh mesh_;  ///< a copy: vertices where solids touch are told apart
    const FracturePlan& plan_;
    const Recipe& recipe_;
    const InteriorMaterials& interior_;
    const Progress& progress_;
    double diagonal_ = 0;
    double medialSeconds_ = 0;
    bool open_ = false;  ///< the surface has borders, and so no inside
    InteriorType closedBy_ = InteriorType::medial;
    Thickness thickness_;  ///< of a shell
    MeshTopology meshTopology_;
    CutSurface cut_;
    Components components_;
    std::future<Result<MedialSurface>> medial_;  ///< until a sheet is made of it
    HiddenSheet sheet_;
    bool carried_ = false;  ///< lines onto the far side of walls
    LevelOrder order_;
    SolidLeaves solid_;  ///< none unless the interior is solid
    MendedPieces pieces_;
    HiddenMesh hidden_;  ///< until looks are made of it
    std::vector<ClusterAt> clusters_;
    std::future<HiddenLooks> looks_;
    BakedObject result_;
};

}  // namespace

Result<BakedObject> bakeObject(const SurfaceMesh& mesh, const FracturePlan& plan,
                               const Recipe& recipe, const InteriorMaterials& interior,
                               const Progress& progress) {
    return Bake(mesh, plan, recipe, interior, progress).run();
}

}  // namespace sherd
