// SPDX-License-Identifier: MIT
// Levels that cut through the volume, alone, after drawn levels and after each other; judged by the
// file check and by what the written set holds, which share no decision with the baker.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sherd/baker/bake.h"
#include "sherd/formats/fracture_set.h"
#include "sherd/formats/validate.h"
#include "support/baked_set.h"
#include "support/cube_ring.h"
#include "support/hidden_looks.h"
#include "support/property.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"
#include "support/surface_meshes.h"
#include "support/wall_sides.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturePlan planOf(const std::vector<std::string>& patterns,
                    const std::vector<std::string>& cuts) {
    std::vector<FracturePlan> levels;
    for (const std::string& text : patterns)
        levels.emplace_back().patterns.push_back({parsePattern(text).value(), 1, nullptr});
    for (const std::string& text : cuts)
        levels.emplace_back().cuts.push_back(parseVolumeCut(text).value());
    return stackLevels(std::move(levels));
}

}  // namespace

TEST_CASE("a cube cut by Voronoi cells becomes closed pieces that fill it, held by bonds") {
    const Result<BakedObject> baked =
        bakeObject(chartedCube(1, 2), planOf({}, {"voronoi:12"}), {}, 0);
    REQUIRE(baked.has_value());
    const FractureSet& set = baked->set;
    CHECK(set.fragments.size() == 13);
    CHECK(baked->report.levels[1].closed == 12);
    CHECK(volumeAt(set, 1) == doctest::Approx(1).epsilon(1e-6));
    CHECK(set.bonds.size() >= 12);
    for (const Fragment& fragment : set.fragments) CHECK(fragment.hulls.count == 1);
    // Caps are walls of the interior's material, shown from level 1.
    for (const Primitive& p : set.geometry.primitives) {
        CHECK(p.material == (p.exposedFrom == 0 ? 0 : 1));
        CHECK_FALSE(p.sheet);
    }
    // What two neighbours share has the same area from both sides.
    double area = 0, bonds = 0;
    for (const SeenFace& face : hiddenFacesOf(set)) area += 0.5 * glm::length(face.normal);
    for (const Bond& bond : set.bonds) bonds += bond.area;
    CHECK(2 * bonds == doctest::Approx(area).epsilon(1e-5));
    writtenSet(modelAround(chartedCube(1, 2)), planOf({}, {"voronoi:12"}));
}

TEST_CASE("attributes are interpolated where the skin is cut") {
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 1)), planOf({}, {"voronoi:9:3", "slices:2x2x2"}));
    const Attribute* uv = attributeOf(set, "TEXCOORD_0");
    REQUIRE(uv != nullptr);
    size_t corners = 0;
    for (const Primitive& primitive : set.geometry.primitives) {
        if (primitive.exposedFrom != 0) continue;
        for (uint32_t i = primitive.indices.first;
             i < primitive.indices.first + primitive.indices.count; i += 3) {
            const uint32_t* v = &set.geometry.indices[i];
            const auto& p = set.geometry.positions;
            const glm::vec3 n = glm::cross(p[v[1]] - p[v[0]], p[v[2]] - p[v[0]]);
            if (!(glm::length(n) > 1e-5F)) continue;
            int axis = 0;
            for (int k = 1; k < 3; ++k)
                if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
            for (uint32_t k = 0; k < 3; ++k) {
                const glm::vec3& at = p[v[k]];
                const glm::dvec2 wanted = cubeUv(2 * axis + (n[axis] > 0 ? 0 : 1),
                                                 at[(axis + 1) % 3], at[(axis + 2) % 3]);
                CHECK(glm::length(uvOf(*uv, v[k]) - wanted) < 1e-6);
                ++corners;
            }
        }
    }
    CHECK(corners > 500);
}

TEST_CASE(
    "hidden faces of a cut have an even texture and tangents, and look alike at every level") {
    Recipe recipe;
    recipe.interior.uvMetresPerTile = 0.5;
    SurfaceMesh mesh = chartedCube(1, 2);
    mesh.attributes.push_back({"TANGENT", 4, {}});
    for (size_t v = 0; v < mesh.attributes[0].values.size() / 3; ++v)
        mesh.attributes.back().values.insert(mesh.attributes.back().values.end(), {1, 0, 0, 1});
    const FractureSet set =
        writtenSet(modelAround(mesh), planOf({}, {"voronoi:8", "voronoi:5"}), recipe);
    const TexelDensity density = texelDensity(set, 1e-7);
    CHECK(density.faces > 100);
    CHECK(density.byArea < 1.15);
    CHECK(density.mean == doctest::Approx(4).epsilon(0.02));
    CHECK(density.mirrored == 0);
    CHECK(tangentFaults(set, 5).sum() == 0);
    CHECK(facesThatChange(set) == 0);
}

TEST_CASE("a cut below drawn levels divides their pieces, each on its own") {
    for (const InteriorType type : {InteriorType::medial, InteriorType::solid}) {
        Recipe recipe;
        recipe.interior.type = type;
        const FractureSet set =
            writtenSet(modelAround(torus(10, 6)),
                       planOf({"voronoi:5"}, {"voronoi:4", "slices:2x1x2"}), recipe);
        REQUIRE(set.levels.size() == 4);
        CHECK(set.levels[1].fragments.count == 5);
        for (uint32_t f = 1; f < 6; ++f) CHECK(set.fragments[f].children.count == 4);
        for (uint32_t level = 2; level <= 3; ++level)
            CHECK(volumeAt(set, level) == doctest::Approx(volumeAt(set, 1)).epsilon(1e-5));
    }
}

TEST_CASE("neighbours share the same triangles, whoever cut them last") {
    for (const char* last :
         {"voronoi:4", "slices:2x2x2:1:jitter=0.4:tilt=0.3", "voronoi:5:2:larger=0.1"}) {
        CAPTURE(last);
        const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)),
                                           planOf({}, {"voronoi:4:3", "bricks:2x3x1", last}));
        // Every hidden face is seen from two sides, and holds a bond.
        double area = 0, bonds = 0;
        for (const SeenFace& face : hiddenFacesOf(set)) area += 0.5 * glm::length(face.normal);
        for (const Bond& bond : set.bonds) bonds += bond.area;
        CHECK(2 * bonds == doctest::Approx(area).epsilon(1e-6));
        CHECK(unpairedFaces(set) == 0);
    }
}

TEST_CASE("rough pieces of three levels still fit: broken faces move as one") {
    Recipe recipe;
    recipe.interior.roughness = {0.01, 0.15, 1};
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 1)),
                   planOf({}, {"voronoi:4:3", "voronoi:3", "voronoi:3"}), recipe);
    for (uint32_t level = 1; level <= 3; ++level)
        CHECK(volumeAt(set, level) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("pieces that were cut apart add up to their parent, though each is cut in its own way") {
    FractureSet set = writtenSet(modelAround(chartedCube(1, 1)),
                                 planOf({}, {"voronoi:3", "voronoi:3", "voronoi:3"}));
    std::vector<uint32_t> parents;
    for (uint32_t f = 0; f < set.fragments.size(); ++f)
        if (set.fragments[f].level == 1) parents.push_back(f);
    for (const uint32_t f : parents) CHECK(childrenAddUp(set, f));
    // A point inside a wall that is moved along the wall on one side only is found.
    const uint32_t child = set.fragments[parents[0]].children.first;
    std::map<uint32_t, int> used;
    const size_t primitives = set.geometry.primitives.size();
    for (size_t p = 0; p < primitives; ++p) {
        if (set.geometry.primitives[p].exposedFrom != 2) continue;
        const Range range = set.fragmentRanges[child * primitives + p];
        for (uint32_t i = range.first; i < range.first + range.count; ++i)
            ++used[set.geometry.indices[i]];
    }
    REQUIRE_FALSE(used.empty());
    const auto most = std::max_element(
        used.begin(), used.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    set.geometry.positions[most->first] += glm::vec3(0.02F, 0.01F, 0.015F);
    CHECK_FALSE(childrenAddUp(set, parents[0]));
}

TEST_CASE("bricks lie in bond: every other row begins and ends with half a brick") {
    const FractureSet set =
        writtenSet(modelAround(chartedCube(1, 2)), planOf({}, {"bricks:3x4x1:axis=z"}));
    CHECK(set.levels[1].fragments.count == 2 * 3 + 2 * 4);
    std::map<double, int> volumes;  // in 1/24 of the cube
    for (const uint32_t f : fragmentsAtLevel(set, 1))
        ++volumes[std::round(24 * double{set.fragments[f].volume})];
    CHECK(volumes == std::map<double, int>{{1, 4}, {2, 10}});
}

TEST_CASE("glass breaks into sectors and rings around the place that was hit") {
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 1)),
                                       planOf({}, {"glass:5x2:1:at=0.5,0.5,0.5:axis=z:jitter=0"}));
    CHECK(set.levels[1].fragments.count == 10);
    // Straight through: nobody's cut faces look along the axis.
    for (const SeenFace& face : hiddenFacesOf(set))
        CHECK(std::abs(face.normal.z) < 1e-5 + 1e-3 * glm::length(face.normal));
}

TEST_CASE("points that are said make a piece each, in the scene's coordinates") {
    SurfaceMesh mesh = chartedCube(1, 1);
    mesh.restPose.translation = {10, 0, 0};
    const FracturePlan plan = planOf({}, {"points:10.5,0.5,0.2;10.5,0.5,0.6"});
    const FractureSet set = bakeObject(mesh, plan, {}, 0).value().set;
    REQUIRE(set.fragments.size() == 3);
    CHECK(set.fragments[1].volume == doctest::Approx(0.4));
    CHECK(set.fragments[2].volume == doctest::Approx(0.6));
}

TEST_CASE("only chosen pieces are divided, the others stand for themselves") {
    // 0.2, 0.3 and 0.5 of the cube, along z.
    const std::string slices = "points:0.5,0.5,0;0.5,0.5,0.4;0.5,0.5,0.6";
    struct Choice {
        const char* keys;
        std::vector<uint32_t> divided;
    };
    const std::vector<Choice> choices = {
        {"", {1, 2, 3}},
        {":larger=0.25", {2, 3}},
        {":smaller=0.25", {1}},
        {":larger=0.25:smaller=0.4", {2}},
        {":near=0.5,0.5,0.9", {3}},
        {":near=0.5,0.5,0.9;0.1,0.1,0.1", {1, 3}},
        {":near=0.5,0.5,-0.1:within=0.15", {1}},
        {":near=0.5,0.5,-0.1:within=0.31", {1, 2}},
    };
    for (const Choice& choice : choices) {
        CAPTURE(choice.keys);
        const FractureSet set =
            writtenSet(modelAround(chartedCube(1, 1)),
                       planOf({}, {slices, std::string("slices:2x1x1") + choice.keys}));
        std::vector<uint32_t> divided;
        for (uint32_t f = 1; f < 4; ++f)
            if (set.fragments[f].children.count > 0) divided.push_back(f);
        CHECK(divided == choice.divided);
        CHECK(volumeAt(set, 2) == doctest::Approx(1));
    }
    for (const char* keys : {":larger=0.9", ":near=9,9,9:within=1", ":name=head"}) {
        CAPTURE(keys);
        const Result<BakedObject> baked = bakeObject(
            chartedCube(1, 1), planOf({}, {slices, std::string("voronoi:2") + keys}), {}, 0);
        REQUIRE_FALSE(baked.has_value());
        CHECK(baked.error().code == ErrorCode::badArgument);
        CHECK(baked.error().message.find("3 pieces of 0.2 to 0.5") != std::string::npos);
    }
}

TEST_CASE("a name that a label gives chooses the pieces of its component") {
    FractureMap map = ringAroundCube();
    FractureMap::Label label;
    label.name = "top";
    label.anchor = true;
    label.place = {true, glm::dvec3(0.5, 0.5, 1)};
    map.labels.push_back(label);
    FracturePlan plan = planOf({}, {"voronoi:3:1:name=top"});
    plan.drawings.push_back({map, {}});
    Recipe recipe;
    recipe.wrap = PageWrap::none;
    const FractureSet set = writtenSet(modelAround(chartedCube(1, 2)), plan, recipe);
    REQUIRE(set.levels[1].fragments.count == 2);
    size_t divided = 0;
    for (uint32_t f = 1; f < 3; ++f) {
        const Fragment& fragment = set.fragments[f];
        CHECK((fragment.name == "top") == (fragment.children.count == 3));
        divided += fragment.children.count;
    }
    CHECK(divided == 3);
    // What is divided further stays anchored: a bond to the world for each crumb with a skin.
    size_t anchors = 0;
    for (const Bond& bond : set.bonds) anchors += bond.b == -1 ? 1 : 0;
    CHECK(anchors == 3);
}

TEST_CASE("the same cut gives the same bytes, whatever the number of threads") {
    const FracturePlan plan = planOf({"voronoi:4"}, {"voronoi:5:3", "grid:4"});
    std::vector<std::vector<uint8_t>> files;
    for (const unsigned threads : {1U, 2U, 5U}) {
        Recipe recipe;
        recipe.threads = threads;
        files.push_back(bakeModel(modelAround(torus(10, 6)), plan, recipe).value().glb);
    }
    CHECK(files[0] == files[1]);
    CHECK(files[0] == files[2]);
}

TEST_CASE("an object scaled by a power of two is cut into the same pieces, scaled") {
    const FracturePlan plan = planOf({}, {"voronoi:7", "wood:4:2:axis=x:elongation=5"});
    const FractureSet one = bakeObject(chartedCube(1, 2), plan, {}, 0).value().set;
    for (const float scale : {0x1p-10F, 0x1p10F}) {
        const FractureSet other = bakeObject(chartedCube(scale, 2), plan, {}, 0).value().set;
        CHECK(other.geometry.indices == one.geometry.indices);
        std::vector<glm::vec3> scaled;
        for (const glm::vec3& p : one.geometry.positions) scaled.push_back(p * scale);
        CHECK(other.geometry.positions == scaled);
    }
}

TEST_CASE("bad cuts are refused with the reason") {
    const auto refuse = [](const SurfaceMesh& mesh, const std::string& cut, const Recipe& recipe) {
        const Result<BakedObject> baked = bakeObject(mesh, planOf({}, {cut}), recipe, 0);
        REQUIRE_FALSE(baked.has_value());
        return baked.error().code;
    };
    CHECK(refuse(chartedCube(1, 1), "voronoi:1", {}) == ErrorCode::separatesNothing);
    CHECK(refuse(chartedCube(1, 1), "slices:1x1x1", {}) == ErrorCode::separatesNothing);
    SurfaceMesh open = chartedCube(1, 1);
    open.triangles.pop_back();
    open.corners.pop_back();
    open.triangleMaterials.pop_back();
    CHECK(refuse(open, "voronoi:5", {}) == ErrorCode::openMesh);
    Recipe allowed;
    allowed.allowOpen = true;
    CHECK(refuse(open, "voronoi:5", allowed) == ErrorCode::openMesh);
}

TEST_CASE("random solids cut two and three times over bake into files that pass the check") {
    const std::vector<std::string> kinds = {"voronoi:6",
                                            "grid:6:jitter=0",
                                            "slices:2x2x2:1:jitter=0.3:tilt=0.2",
                                            "slices:2x2x1",
                                            "wood:5:1:axis=y",
                                            "bricks:3x3x1",
                                            "glass:5x2:1:jitter=0",
                                            "voronoi:5:1:larger=0.1"};
    for (const uint32_t seed : propertySeeds(5'000'000, 200)) {
        CAPTURE(seed);
        Random random(seed);
        const SurfaceMesh mesh = meshOf(randomSolid(random));
        std::vector<std::string> cuts;
        for (uint32_t k = 0; k < 2 + random.below(2); ++k)
            cuts.push_back(kinds[random.below(static_cast<uint32_t>(kinds.size()))]);
        const Result<BakedObject> baked = bakeObject(mesh, planOf({}, cuts), {}, 0);
        if (!baked) {
            // A level may find every piece in one cell or too small, or a whole inside out.
            CAPTURE(baked.error().message);
            CHECK((baked.error().code == ErrorCode::separatesNothing ||
                   baked.error().code == ErrorCode::badArgument ||
                   baked.error().code == ErrorCode::invalidData));

            continue;
        }
        for (const BakedLevelReport& level : baked->report.levels)
            REQUIRE(level.closed == level.fragments);
        CheckReport report;
        checkFractureSet(baked->set, {}, 0, report);
        for (const Finding& f : report.findings)
            if (f.severity == Severity::failure) FAIL_CHECK(f.message << " " << f.where);
    }
}
