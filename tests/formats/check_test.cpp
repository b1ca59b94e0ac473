// SPDX-License-Identifier: MIT
// Each test breaks one thing in a sound file and sees `check` name it.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "sherd/formats/glb_read.h"
#include "sherd/formats/validate.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturedCubeOptions threeLevels() {
    FracturedCubeOptions options;
    options.size = {1.0F, 2.0F, 0.7F};
    options.splits = {{2, 1, 1}, {1, 2, 2}, {2, 2, 2}};
    return options;
}

std::vector<uint8_t> bake(const FractureSet& set) {
    const NewMaterial inside{"inside"};
    auto glb = attachFractureSets(makeIntactDocument(makeFracturedCube(threeLevels())), {&set, 1},
                                  {&inside, 1});
    if (!glb) FAIL(glb.error().message << " at " << glb.error().where);
    return std::move(*glb);
}

CheckReport checked(const std::vector<uint8_t>& glb, const CheckOptions& options = {}) {
    auto report = checkFractureSets(glb, options);
    if (!report) FAIL(report.error().message << " at " << report.error().where);
    return std::move(*report);
}

std::set<std::string> failuresOf(const CheckReport& report) {
    std::set<std::string> codes;
    for (const Finding& finding : report.findings)
        if (finding.severity == Severity::failure) codes.insert(finding.code);
    return codes;
}

/// What `check` says about the file of a damaged set.
std::set<std::string> failures(const FractureSet& set) {
    return failuresOf(checked(bake(set)));
}

using Codes = std::set<std::string>;

uint32_t lastFragment(const FractureSet& set) {
    return static_cast<uint32_t>(set.fragments.size()) - 1;
}

Range& rangeOf(FractureSet& set, uint32_t fragment, uint32_t primitive) {
    return set.fragmentRanges[fragment * set.geometry.primitives.size() + primitive];
}

/// Every vertex belongs to one leaf alone, so moving it moves nothing else.
template <class Visit>
void forEachVertexOf(FractureSet& set, uint32_t leaf, Visit visit) {
    std::set<uint32_t> vertices;
    for (const auto& triangle : fragmentTriangles(set, leaf))
        vertices.insert(triangle.begin(), triangle.end());
    for (const uint32_t v : vertices) visit(set.geometry.positions[v]);
}

}  // namespace

TEST_CASE("a sound file passes, with every fragment of every level closed") {
    const CheckReport report = checked(bake(makeFracturedCube(threeLevels())));
    CHECK(report.passed());
    CHECK(report.findings.empty());
    REQUIRE(report.objects.size() == 1);
    const ObjectReport& object = report.objects[0];
    REQUIRE(object.levels.size() == 4);
    for (size_t k = 0; k < 4; ++k) {
        CHECK(object.levels[k].fragments == std::array<uint32_t, 4>{1, 2, 8, 64}[k]);
        CHECK(object.levels[k].closed == object.levels[k].fragments);
        CHECK(object.levels[k].volumeShare == doctest::Approx(1.0).epsilon(1e-6));
    }
    CHECK(object.boundaryEdges == 0);
    CHECK(object.hiddenVertices == 3 * 3 * 3);
    CHECK(object.verticesOutside == 0);
    CHECK(object.protrusion < 1e-6 * object.diagonal);
    CHECK(toJson(report).find("\"passed\": true") != std::string::npos);
}

TEST_CASE("a file that was never baked gives a report without objects") {
    const auto glb = toGlb(makeIntactDocument(makeFracturedCube()));
    CHECK(checked(glb).objects.empty());
}

TEST_CASE("an object that is not divided passes") {
    FracturedCubeOptions options;
    options.splits.clear();
    CHECK(checked(makeBakedCube(options)).passed());
}

TEST_CASE("cutting the cube fills it: no point in no fragment or in two") {
    CheckOptions options;
    options.coverage = true;
    options.coveragePoints = 2000;
    const CheckReport report = checked(makeBakedCube(threeLevels()), options);
    for (const LevelReport& level : report.objects[0].levels) {
        CHECK(level.coverageNone == 0);
        CHECK(level.coverageDouble == 0);
    }
}

TEST_CASE("a fragment that is missing or doubled shows in the coverage") {
    FractureSet set = makeFracturedCube(threeLevels());
    CheckOptions options;
    options.coverage = true;
    options.coveragePoints = 4000;
    // The last leaf takes the place of its neighbour.
    const uint32_t last = lastFragment(set);
    for (uint32_t p = 0; p < 4; ++p) rangeOf(set, last - 1, p) = rangeOf(set, last, p);
    CheckReport report;
    checkFractureSet(set, options, 0, report);
    const LevelReport& leaves = report.objects[0].levels[3];
    CHECK(leaves.coverageNone == doctest::Approx(1.0 / 64).epsilon(0.3));
    CHECK(leaves.coverageDouble == doctest::Approx(1.0 / 64).epsilon(0.3));
    CHECK(report.objects[0].levels[0].coverageNone == 0);
}

TEST_CASE("what shows only since the object broke is measured as a share of the surface") {
    const CheckReport report = checked(bake(makeFracturedCube(threeLevels())));
    const double whole = 2 * (1 * 2 + 2 * 0.7 + 0.7 * 1);
    CHECK(report.objects[0].levels[0].hiddenShare == 0);
    CHECK(report.objects[0].levels[1].hiddenShare == doctest::Approx(2.8 / (whole + 2.8)));
    CHECK(report.objects[0].levels[0].selfIntersections == -1);
}

TEST_CASE("boxes pass through nothing, and a corner pulled through a face is told") {
    FractureSet set = makeFracturedCube(threeLevels());
    CheckOptions options;
    options.shapes = true;
    CheckReport sound;
    checkFractureSet(set, options, 0, sound);
    for (const LevelReport& level : sound.objects[0].levels) CHECK(level.selfIntersections == 0);
    CHECK(sound.objects[0].levels[3].thinnest == doctest::Approx(0.175));
    CHECK(sound.findings.empty());
    const uint32_t last = lastFragment(set);
    const glm::vec3 corner = set.fragments[last].centerOfMass;
    forEachVertexOf(set, last, [&](glm::vec3& p) {
        if (p.x > corner.x && p.y > corner.y && p.z > corner.z) p -= glm::vec3(0.1F, 0.9F, 0.07F);
    });
    CheckReport broken;
    checkFractureSet(set, options, 0, broken);
    CHECK(broken.objects[0].levels[3].selfIntersections > 0);
    CHECK(std::any_of(broken.findings.begin(), broken.findings.end(),
                      [](const Finding& f) { return f.code == "self_intersecting"; }));
}

TEST_CASE("one collapsed triangle opens its fragments") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t first = set.geometry.primitives[3].indices.first;
    set.geometry.indices[first + 2] = set.geometry.indices[first];
    CHECK(failures(set).count("not_closed") == 1);
}

TEST_CASE("one vertex moved by one bit opens its fragments") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t vertex = set.geometry.indices[set.geometry.primitives[2].indices.first];
    float& x = set.geometry.positions[vertex].x;
    x = std::nextafter(x, 10.0F);
    CHECK(failures(set).count("not_closed") == 1);
}

TEST_CASE("one triangle turned over is no closed fragment") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t first = set.geometry.primitives[1].indices.first;
    std::swap(set.geometry.indices[first], set.geometry.indices[first + 1]);
    CHECK(failures(set).count("not_closed") == 1);
}

TEST_CASE("a fragment inside out has no positive volume") {
    FracturedCubeOptions options;
    options.splits.clear();
    FractureSet set = makeFracturedCube(options);
    for (size_t i = 0; i < set.geometry.indices.size(); i += 3)
        std::swap(set.geometry.indices[i], set.geometry.indices[i + 1]);
    CHECK(failures(set).count("volume_not_positive") == 1);
}

TEST_CASE("a range that starts one triangle late is found") {
    FractureSet set = makeFracturedCube(threeLevels());
    rangeOf(set, lastFragment(set) - 1, 3).first += 3;
    CHECK(failures(set).count("not_closed") == 1);
    set = makeFracturedCube(threeLevels());
    rangeOf(set, 1, 0).first += 3;
    CHECK(failures(set).count("children_ranges") == 1);
}

TEST_CASE("a range that is one triangle short is found") {
    FractureSet set = makeFracturedCube(threeLevels());
    rangeOf(set, 3, 0).count -= 3;
    const Codes codes = failures(set);
    CHECK(codes.count("children_ranges") == 1);
    CHECK(codes.count("not_closed") == 1);
}

TEST_CASE("a wrong volume is found, of a leaf and of a sum") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[lastFragment(set)].volume *= 1.01F;
    const Codes leaf = failures(set);
    CHECK(leaf.count("volume_wrong") == 1);
    CHECK(leaf.count("mass_wrong") == 1);
    set = makeFracturedCube(threeLevels());
    set.fragments[0].volume *= 0.5F;
    CHECK(failures(set) == Codes{"volume_wrong"});
}

TEST_CASE("a wrong mass is found, of a leaf and of a sum") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[1].mass *= 1.1F;
    CHECK(failures(set) == Codes{"mass_sum"});
    set = makeFracturedCube(threeLevels());
    set.fragments[lastFragment(set)].mass *= 1.1F;
    CHECK(failures(set) == Codes{"mass_sum", "mass_wrong"});
}

TEST_CASE("a wrong centre of mass is found") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[lastFragment(set)].centerOfMass.y += 0.1F;
    CHECK(failures(set) == Codes{"center_of_mass_wrong"});
}

TEST_CASE("a wrong centre of mass of a parent is found, and nothing else") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[2].centerOfMass.z += 0.01F;
    CHECK(failures(set) == Codes{"center_of_mass_wrong"});
}

TEST_CASE("wrong moments and wrong axes of inertia are found at every level") {
    for (const uint32_t f : {0U, 1U, 5U, 40U}) {
        CAPTURE(f);
        FractureSet set = makeFracturedCube(threeLevels());
        set.fragments[f].inertiaDiagonal.y *= 1.02F;
        CHECK(failures(set) == Codes{"inertia_wrong"});
        set = makeFracturedCube(threeLevels());
        set.fragments[f].inertiaDiagonal = glm::vec3(0.0F);
        CHECK(failures(set) == Codes{"inertia_wrong"});
        set = makeFracturedCube(threeLevels());
        set.fragments[f].inertiaOrientation =
            glm::angleAxis(0.3F, glm::normalize(glm::vec3(1, 2, 3)));
        CHECK(failures(set) == Codes{"inertia_wrong"});
    }
}

TEST_CASE("the same tensor by other axes is no fault") {
    FractureSet set = makeFracturedCube(threeLevels());
    for (Fragment& f : set.fragments) {
        std::swap(f.inertiaDiagonal.x, f.inertiaDiagonal.y);
        f.inertiaOrientation = glm::angleAxis(glm::radians(90.0F), glm::vec3(0, 0, 1));
    }
    CHECK(failures(set).empty());
}

TEST_CASE("a density that none of its children has is found") {
    for (const float factor : {0.99F, 1.01F}) {
        FractureSet set = makeFracturedCube(threeLevels());
        set.fragments[1].density *= factor;
        CHECK(failures(set) == Codes{"density_wrong"});
    }
}

TEST_CASE("a cube far from the origin passes") {
    FracturedCubeOptions options = threeLevels();
    options.size = {1.0F, 2.0F, 0.5F};
    FractureSet set = makeFracturedCube(options);
    const glm::vec3 away(1024.0F, -2048.0F, 512.0F);  // corners stay exact
    for (glm::vec3& p : set.geometry.positions) p += away;
    for (glm::vec3& p : set.hullPoints) p += away;
    for (Fragment& f : set.fragments) f.centerOfMass += away;
    for (Bond& b : set.bonds) b.centroid += away;
    CHECK(failures(set).empty());
}

TEST_CASE("a flat hull and a bond without area are found") {
    FractureSet set = makeFracturedCube(threeLevels());
    for (uint32_t i = 0; i < 8; ++i) set.hullPoints[8 * 5 + i].z = 0.1F;
    CHECK(failures(set) == Codes{"hull_flat"});
    set = makeFracturedCube(threeLevels());
    set.hulls[2].points.count = 3;
    CHECK(failures(set) == Codes{"hull_flat"});
    set = makeFracturedCube(threeLevels());
    set.bonds[4].area = 0;
    CHECK(failures(set) == Codes{"bond_area"});
}

TEST_CASE("a fragment without a collider is worth a warning") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[4].hulls.count = 0;
    const CheckReport report = checked(bake(set));
    CHECK(report.passed());
    REQUIRE(report.findings.size() == 1);
    CHECK(report.findings[0].code == "no_collider");
    CHECK(report.findings[0].fragment == 4);
}

TEST_CASE("a hull that leaves its fragment is found") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.hullPoints[8 * 5].x -= 0.1F;
    CHECK(failures(set) == Codes{"hull_outside"});
    set = makeFracturedCube(threeLevels());
    set.hulls[7].margin = 0.02F;
    CHECK(failures(set) == Codes{"hull_outside"});
    set = makeFracturedCube(threeLevels());
    std::swap(set.fragments[3].hulls, set.fragments[4].hulls);
    CHECK(failures(set) == Codes{"hull_outside"});
}

TEST_CASE(
    "hulls of neighbours inside each other are worth a warning, at whatever levels they are") {
    FractureSet set = makeFracturedCube(threeLevels());
    CHECK(checked(bake(set)).findings.empty());
    // Less than a hull may reach out of the box of its fragment.
    const int32_t parent = set.fragments[lastFragment(set)].parent;
    const uint32_t f = set.fragments[static_cast<size_t>(parent)].children.first;
    set.hulls[set.fragments[f].hulls.first].margin += 0.0003F;
    const CheckReport report = checked(bake(set));
    CHECK(report.passed());
    REQUIRE(report.findings.size() >= 3);  // its siblings, and what is coarser beside it
    std::set<uint32_t> levels;
    for (const Finding& finding : report.findings) {
        CHECK(finding.code == "hull_overlap");
        CHECK(finding.severity == Severity::warning);
        levels.insert(set.fragments[static_cast<size_t>(finding.fragment)].level);
    }
    CHECK(levels.size() > 1);
}

TEST_CASE("a hull that two fragments use, or that is far too small, is worth a warning") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.fragments[6].hulls = set.fragments[5].hulls;
    Codes codes;
    for (const Finding& finding : checked(bake(set)).findings) codes.insert(finding.code);
    CHECK(codes == Codes{"hull_outside", "hull_overlap", "hull_shared"});
    set = makeFracturedCube(threeLevels());
    const glm::vec3 center = set.fragments[2].centerOfMass;
    for (uint32_t i = 8 * 2; i < 8 * 3; ++i)
        set.hullPoints[i] = center + 0.2F * (set.hullPoints[i] - center);
    const CheckReport report = checked(bake(set));
    CHECK(report.passed());
    REQUIRE(report.findings.size() == 1);
    CHECK(report.findings[0].code == "hull_small");
    CHECK(report.findings[0].fragment == 2);
}

TEST_CASE("a bond that is not the wall between its leaves is found") {
    for (const float factor : {0.5F, 1.2F}) {
        FractureSet set = makeFracturedCube(threeLevels());
        set.bonds[4].area *= factor;
        CHECK(failures(set) == Codes{"bond_area"});
    }
    FractureSet set = makeFracturedCube(threeLevels());
    set.bonds[4].centroid.y += 0.05F;
    CHECK(failures(set) == Codes{"bond_centroid"});
    set = makeFracturedCube(threeLevels());
    set.bonds[4].normal = -set.bonds[4].normal;
    CHECK(failures(set) == Codes{"bond_normal"});
    set = makeFracturedCube(threeLevels());
    std::swap(set.bonds[4].a, set.bonds[4].b);
    CHECK(failures(set) == Codes{"bond_normal"});
    set.bonds[4].normal = -set.bonds[4].normal;
    CHECK(failures(set).empty());
}

TEST_CASE("an anchor holds no more than the surface of its leaf, and lies at it") {
    FracturedCubeOptions options = threeLevels();
    options.anchorBottom = true;
    FractureSet set = makeFracturedCube(options);
    CHECK(failures(set).empty());
    Bond* anchor = nullptr;
    for (Bond& b : set.bonds)
        if (b.b == -1) anchor = &b;
    REQUIRE(anchor != nullptr);
    anchor->area *= 20;
    CHECK(failures(set) == Codes{"bond_area"});
    anchor->area /= 20;
    anchor->centroid.x += 1;
    CHECK(failures(set) == Codes{"bond_centroid"});
}

TEST_CASE("walls without any bond are found, a single missing one is worth a warning") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.bonds.pop_back();
    const CheckReport report = checked(bake(set));
    CHECK(report.passed());
    REQUIRE(report.findings.size() == 1);
    CHECK(report.findings[0].code == "bond_missing");
    set.bonds.clear();
    CHECK(failures(set) == Codes{"no_bonds"});
}

TEST_CASE("a normal that is no unit vector is found") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.geometry.attributes[0].values[3 * 7 + 1] += 0.1F;
    CHECK(failures(set) == Codes{"normal_not_unit"});
}

TEST_CASE("a wall cut differently on its two sides is closed but does not cancel") {
    FractureSet set = makeFracturedCube(threeLevels());
    uint32_t* quad = set.geometry.indices.data() + set.geometry.primitives[3].indices.first;
    const std::array<uint32_t, 4> corner = {quad[0], quad[1], quad[2], quad[5]};
    const std::array<uint32_t, 6> other = {corner[0], corner[1], corner[3],
                                           corner[1], corner[2], corner[3]};
    std::copy(other.begin(), other.end(), quad);
    CHECK(failures(set) == Codes{"inner_faces_unpaired"});
    CHECK(isClosed(set, lastFragment(set)));
    CHECK_FALSE(childrenAddUp(set, 3));
    CHECK(childrenAddUp(set, 4));
}

TEST_CASE("a gap between siblings loses volume") {
    FractureSet set = makeFracturedCube(threeLevels());
    // The centre of fragment 3 is inside it: only its children's new faces meet there.
    const glm::vec3 center = set.fragments[3].centerOfMass;
    // Fragment 3 is divided into leaves.
    const uint32_t child = set.fragments[3].children.first;
    forEachVertexOf(set, child, [&](glm::vec3& p) {
        if (glm::distance(p, center) < 1e-4F) p += 0.2F * (set.fragments[child].centerOfMass - p);
    });
    const Codes codes = failures(set);
    CHECK(codes.count("volume_sum") == 1);
    CHECK(codes.count("inner_faces_unpaired") == 1);
    CHECK(codes.count("not_closed") == 0);
}

TEST_CASE("hidden vertices outside the object are counted, with the depth of the worst") {
    FractureSet set = makeFracturedCube(threeLevels());
    for (glm::vec3& p : set.geometry.positions)
        if (p == glm::vec3(0.0F)) p = {0.0F, 0.0F, 0.35F + 0.25F};
    const CheckReport report = checked(bake(set));
    CHECK(failuresOf(report).count("hidden_outside") == 1);
    CHECK(report.objects[0].verticesOutside == 1);
    CHECK(report.objects[0].protrusion == doctest::Approx(0.25));
}

TEST_CASE("an open object is noted, and only its fragments must be closed") {
    FractureSet set = makeFracturedCube(threeLevels());
    const uint32_t first = set.geometry.primitives[0].indices.first;
    set.geometry.indices[first + 2] = set.geometry.indices[first];
    const CheckReport report = checked(bake(set));
    REQUIRE_FALSE(report.findings.empty());
    CHECK(report.findings[0].code == "object_open");
    CHECK(report.findings[0].severity == Severity::note);
    CHECK(report.objects[0].boundaryEdges == 3);
    CHECK(failuresOf(report).count("not_closed") == 1);
    CHECK(report.objects[0].verticesOutside == 0);
}

TEST_CASE("a set older than its mesh is stale") {
    std::vector<uint8_t> glb = makeBakedCube();
    auto document = parseGlb(glb, "cube");
    REQUIRE(document);
    document->bin[40] ^= 1;  // a coordinate of the intact mesh
    CHECK(failuresOf(checked(toGlb(*document))) == Codes{"stale"});
}

TEST_CASE(
    "every node of a set is watched: other meshes shown, and joined meshes changed, are stale") {
    FractureSet set = makeFracturedCube();
    GltfDocument document = makeIntactDocument(set);
    // A second mesh of its own data, and two nodes more.
    document.json.insert(document.json.find("],\"meshes\""), R"(,{"mesh":0},{"mesh":1})");
    document.json.insert(document.json.find("],\"materials\""),
                         R"(,{"primitives":[{"attributes":{"POSITION":2}}]})");
    document.json.insert(document.json.find("],\"bufferViews\""),
                         R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"})");
    const size_t size = document.bin.size();
    document.json.insert(
        document.json.find("],\"buffers\""),
        R"(,{"buffer":0,"byteOffset":)" + std::to_string(size) + R"(,"byteLength":36})");
    document.bin.resize(size + 36);
    const std::string length = "\"buffers\":[{\"byteLength\":" + std::to_string(size);
    document.json.replace(document.json.find(length), length.size(),
                          "\"buffers\":[{\"byteLength\":" + std::to_string(size + 36));
    const NewMaterial inside{"inside"};
    constexpr size_t kNone = SIZE_MAX;
    const auto failuresAfter = [&](const FractureSet& of, const std::string& from,
                                   const std::string& to, size_t changedByte) {
        const auto glb = attachFractureSets(document, {&of, 1}, {&inside, 1});
        REQUIRE(glb);
        auto baked = parseGlb(*glb, "baked");
        const size_t at = baked->json.find(from);
        REQUIRE(at != std::string::npos);
        baked->json.replace(at, from.size(), to);
        if (changedByte != kNone) baked->bin[changedByte] ^= 1;
        return failuresOf(checked(toGlb(*baked)));
    };
    FractureSet same = set;
    same.sameNodes = {1};
    const std::string carrier = R"({"mesh":0,"extensions")";
    CHECK(failuresAfter(same, carrier, R"({"mesh":1,"extensions")", size + 1) == Codes{"stale"});
    CHECK(failuresAfter(same, carrier, R"({"extensions")", size + 1) == Codes{"stale"});
    CHECK(failuresAfter(same, carrier, carrier, size + 1).empty());
    FractureSet joined = set;
    joined.joinedNodes = {2};
    const std::string part = R"({"mesh":1})";
    CHECK(failuresAfter(joined, part, part, size + 1) == Codes{"stale"});
    CHECK(failuresAfter(joined, part, R"({"mesh":0})", kNone) == Codes{"stale"});
    CHECK(failuresAfter(joined, part, "{}", kNone) == Codes{"stale"});
}

TEST_CASE("a finding names fragment, place and reason, in JSON too") {
    FractureSet set = makeFracturedCube(threeLevels());
    set.bonds[4].area = 0;
    const CheckReport report = checked(bake(set));
    REQUIRE(report.findings.size() == 1);
    CHECK(report.findings[0].where ==
          "/extensions/SHERD_mesh_fracture/fractures/0/bonds/attributes/AREA");
    const std::string json = toJson(report);
    CHECK(json.find("\"code\": \"bond_area\"") != std::string::npos);
    CHECK(json.find("\"passed\": false") != std::string::npos);
}

TEST_CASE("minus zero and zero are one place") {
    FractureSet set = makeFracturedCube(threeLevels());
    bool sign = false;
    for (glm::vec3& p : set.geometry.positions)
        if (p.x == 0.0F) p.x = (sign = !sign) ? -0.0F : 0.0F;
    CHECK(checked(bake(set)).passed());
}
