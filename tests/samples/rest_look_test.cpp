// SPDX-License-Identifier: MIT
// The samples are drawn whole, from the mesh every viewer shows, and in the pieces of each level as
// they rest; the pictures must agree away from the fracture lines.
#include "rest_look.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "camera.h"
#include "explode.h"
#include "model_view.h"
#include "offscreen_context.h"

using namespace sherd;
using namespace sherd::test;
using namespace sherd::samples;

namespace {

constexpr uint32_t kSize = 192;  ///< pixels
/// Per pixel and axis. A single sample must not show: OpenGL rounds vertices to 1/256 of one, so a
/// silhouette's edge that a line divides may gain or lose one here and there.
constexpr uint32_t kSamples = 12;
constexpr uint32_t kTolerance = 3;  ///< of 255

struct View {
    float turn;
    float elevation;
};
constexpr std::array<View, 3> kViews{{{25, 14}, {150, 40}, {-95, -25}}};

/// A renderer without a window, or the reason why there is none.
struct Studio {
    std::unique_ptr<OffscreenContext> context;
    std::unique_ptr<SceneRenderer> renderer;
};
Result<Studio> openStudio() {
    auto context = OffscreenContext::create();
    if (!context) return tl::unexpected(context.error());
    auto renderer = SceneRenderer::create({kSize, kSize, 2048, kSamples});
    if (!renderer) return tl::unexpected(renderer.error());
    return Studio{std::move(*context), std::move(*renderer)};
}

RestModel loadSample(const std::string& name) {
    auto model = loadRestModel(std::string(SHERD_DEMO "/").append(name).append("_baked.glb"));
    if (!model) FAIL(model.error().message);
    REQUIRE(model->source.meshes.size() == 1);
    return std::move(*model);
}

/// The mesh of the source document, one vertex per corner.
std::vector<DrawItem> wholeItems(const RestModel& model, SceneRenderer& renderer) {
    const SurfaceMesh& mesh = model.source.meshes.front();
    const Attribute* normals = findAttribute(mesh.attributes, "NORMAL");
    const Attribute* uvs = findAttribute(mesh.attributes, "TEXCOORD_0");
    REQUIRE(normals != nullptr);
    REQUIRE(uvs != nullptr);
    const std::vector<uint32_t> materials =
        addMaterials(model.source.document, mesh.materials, model.asset->diagonal(), renderer);
    std::vector<RenderVertex> vertices;
    std::vector<std::vector<uint32_t>> indices(mesh.materials.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const float* n = &normals->values[size_t{3} * mesh.corners[t][k]];
            const float* uv = &uvs->values[size_t{2} * mesh.corners[t][k]];
            indices[mesh.triangleMaterials[t]].push_back(uint32_t(vertices.size()));
            vertices.push_back(
                {mesh.positions[mesh.triangles[t][k]], {n[0], n[1], n[2]}, {uv[0], uv[1]}});
        }
    }
    std::vector<DrawItem> items;
    for (size_t m = 0; m < indices.size(); ++m) {
        if (indices[m].empty()) continue;
        items.push_back({renderer.addMesh(vertices, indices[m]), materials[m], 0,
                         uint32_t(indices[m].size()), toMatrix(mesh.restPose)});
    }
    return items;
}

std::vector<glm::vec3> placesOf(std::span<const std::array<glm::vec3, 3>> triangles) {
    std::vector<glm::vec3> places;
    for (const auto& t : triangles) places.insert(places.end(), t.begin(), t.end());
    return places;
}

/// One sample seen from one side, whole.
class Look {
  public:
    Look(const RestModel& model, const View& view, Studio& studio)
        : triangles_(sourceTriangles(model)), renderer_(*studio.renderer) {
        frame_ = frameAround(placesOf(triangles_), {view.turn, view.elevation, 24, 1});
        // One can look from below, and a hole shows the bright backdrop.
        frame_.floor = false;
        frame_.items = wholeItems(model, renderer_);
        whole_ = renderer_.render(frame_);
    }

    LookDifference compare(const ModelView& view, const Asset& asset,
                           const std::vector<FragmentPose>& pieces) {
        frame_.items.clear();
        for (const FragmentPose& piece : pieces) view.append(piece, frame_.items);
        const Picture picture = renderer_.render(frame_);
        const PixelGrid grid{kSize, kSize, viewProjection(frame_, 1)};
        return comparePictures(whole_, picture,
                               nearLines(grid, fractureLines(asset, pieces), triangles_));
    }

  private:
    std::vector<std::array<glm::vec3, 3>> triangles_;
    SceneRenderer& renderer_;
    SceneFrame frame_;
    Picture whole_;
};

/// A sample and what is needed to draw it in pieces; empty, with a message ctest looks for, where
/// nothing can be drawn.
struct Subject {
    Studio studio;
    RestModel model;
};
std::optional<Subject> openSample(const std::string& name) {
    Result<Studio> studio = openStudio();
    if (!studio) {
        MESSAGE("skipped, the " << name << " cannot be drawn: " << studio.error().message);
        return std::nullopt;
    }
    return Subject{std::move(*studio), loadSample(name)};
}

void checkSample(const std::string& name, std::span<const View> views) {
    std::optional<Subject> subject = openSample(name);
    if (!subject) return;
    const Asset& asset = *subject->model.asset;
    const ModelView pieces(subject->model.asset, subject->model.source.document,
                           *subject->studio.renderer);
    for (const View& view : views) {
        Look look(subject->model, view, subject->studio);
        for (uint32_t level = 0; level < asset.set().levels.size(); ++level) {
            const LookDifference found = look.compare(pieces, asset, pullApart(asset, level, 0));
            INFO(name << " level " << level << " seen from " << view.turn << ", " << view.elevation
                      << ": off by " << found.worst << " at " << found.at.x << ", " << found.at.y
                      << ", " << found.pixels << " pixels off");
            CHECK(found.worst <= kTolerance);
            // Most of the picture must have been compared.
            CHECK(found.skipped < kSize * kSize / 10);
        }
    }
}

/// The deepest level of the wall, seen from the front, after somebody has meddled with the set or
/// the pieces.
template <class MeddleSet, class MeddlePieces>
LookDifference lookAtBroken(Subject& subject, MeddleSet meddleSet, MeddlePieces meddlePieces) {
    FractureSet set = subject.model.asset->set();
    meddleSet(set);
    const auto asset = Asset::fromFractureSet(std::move(set));
    REQUIRE(asset.has_value());
    const auto level = uint32_t((*asset)->set().levels.size() - 1);
    std::vector<FragmentPose> pieces = pullApart(**asset, level, 0);
    meddlePieces(pieces);
    const ModelView view(*asset, subject.model.source.document, *subject.studio.renderer);
    return Look(subject.model, kViews[0], subject.studio).compare(view, **asset, pieces);
}

/// The piece whose outer surface is nearest to the middle of the wall's front.
uint32_t middlePiece(const Asset& asset) {
    const FractureGeometry& geometry = asset.geometry();
    uint32_t best = 0;
    float nearest = std::numeric_limits<float>::max();
    for (const uint32_t f : fragmentsAtLevel(asset.set(), 2)) {
        for (const DrawRange& range : asset.drawRanges(f)) {
            if (range.exposedFrom != 0) continue;
            for (uint32_t i = 0; i < range.indices.count; ++i) {
                const glm::vec3& p = geometry.positions[geometry.indices[range.indices.first + i]];
                const float distance = glm::distance(p, glm::vec3(0, 0.6F, 0.125F));
                if (distance >= nearest) continue;
                nearest = distance;
                best = f;
            }
        }
    }
    return best;
}

/// Calls `change(vertex values)` for each vertex of the piece's outer surface, once.
template <class Change>
void changeAttribute(FractureSet& set, uint32_t piece, const std::string& semantic, Change change) {
    std::set<uint32_t> vertices;
    for (size_t p = 0; p < set.geometry.primitives.size(); ++p) {
        if (set.geometry.primitives[p].exposedFrom != 0) continue;
        const Range range = set.fragmentRanges[piece * set.geometry.primitives.size() + p];
        for (uint32_t i = range.first; i < range.first + range.count; ++i)
            vertices.insert(set.geometry.indices[i]);
    }
    for (Attribute& attribute : set.geometry.attributes) {
        if (attribute.semantic != semantic) continue;
        for (const uint32_t v : vertices)
            change(&attribute.values[size_t{v} * attribute.components]);
    }
}

constexpr auto kNoSetChange = [](FractureSet&) {};
constexpr auto kNoPieceChange = [](std::vector<FragmentPose>&) {};

}  // namespace

TEST_CASE("rest look, vase: its pieces look like the intact vase") {
    checkSample("vase", kViews);
}

TEST_CASE("rest look, wall: its pieces look like the intact wall") {
    checkSample("wall", kViews);
}

TEST_CASE("rest look, column: its pieces look like the intact column") {
    checkSample("column", kViews);
}

TEST_CASE("rest look, figure: its pieces look like the intact figure") {
    checkSample("figure", kViews);
}

// Cutting straight through carries lines of one side into the surface of the other.
TEST_CASE("rest look, wall_solid: cut straight through, its pieces look like the intact wall") {
    checkSample("wall_solid", std::span(kViews).first(2));
}

TEST_CASE("rest look, figure_cells: cut by patterns, its pieces look like the intact figure") {
    checkSample("figure_cells", std::span(kViews).first(1));
}

TEST_CASE("rest look, fragment: what is wrong with a single one is seen") {
    std::optional<Subject> wall = openSample("wall");
    if (!wall) return;
    const uint32_t piece = middlePiece(*wall->model.asset);
    SUBCASE("nothing is wrong") {
        const LookDifference found = lookAtBroken(*wall, kNoSetChange, kNoPieceChange);
        CHECK(found.worst <= kTolerance);
    }
    SUBCASE("it is moved by a five-hundredth of the size") {
        const float way = wall->model.asset->diagonal() / 500;
        const LookDifference found =
            lookAtBroken(*wall, kNoSetChange, [&](std::vector<FragmentPose>& pieces) {
                for (FragmentPose& p : pieces)
                    if (p.fragment == piece) p.pose.translation.x += way;
            });
        CHECK(found.pixels > 20);
    }
    SUBCASE("its normals are turned by six degrees") {
        const glm::quat turn = glm::angleAxis(glm::radians(6.0F), glm::vec3(0, 1, 0));
        const LookDifference found = lookAtBroken(
            *wall,
            [&](FractureSet& set) {
                changeAttribute(set, piece, "NORMAL", [&](float* n) {
                    const glm::vec3 turned = turn * glm::vec3(n[0], n[1], n[2]);
                    for (int i = 0; i < 3; ++i) n[i] = turned[i];
                });
            },
            kNoPieceChange);
        CHECK(found.pixels > 20);
    }
    SUBCASE("its picture is shifted by a hundredth") {
        const LookDifference found = lookAtBroken(
            *wall,
            [&](FractureSet& set) {
                changeAttribute(set, piece, "TEXCOORD_0", [](float* uv) { uv[0] += 0.01F; });
            },
            kNoPieceChange);
        CHECK(found.pixels > 20);
    }
    SUBCASE("it is missing") {
        const LookDifference found =
            lookAtBroken(*wall, kNoSetChange, [&](std::vector<FragmentPose>& pieces) {
                std::erase_if(pieces, [&](const FragmentPose& p) { return p.fragment == piece; });
            });
        CHECK(found.pixels > 20);
    }
    SUBCASE("it stands out by a hundredth of the size, beside its lines too") {
        const float way = wall->model.asset->diagonal() / 100;
        const LookDifference found =
            lookAtBroken(*wall, kNoSetChange, [&](std::vector<FragmentPose>& pieces) {
                for (FragmentPose& p : pieces)
                    if (p.fragment == piece) p.pose.translation.z += way;
            });
        CHECK(found.pixels > 20);
    }
}
