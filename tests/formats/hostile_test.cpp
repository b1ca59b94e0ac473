// SPDX-License-Identifier: MIT
// Files made to hurt: whatever the bytes, the reader answers with a set or an error.
#include <doctest/doctest.h>

#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "sherd/formats/glb_read.h"
#include "sherd/formats/validate.h"
#include "support/fractured_cube.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FracturedCubeOptions small() {
    FracturedCubeOptions options;
    options.splits = {{2, 1, 1}, {1, 2, 1}};
    options.anchorBottom = true;
    return options;
}

void putLength(std::vector<uint8_t>& glb) {
    const auto size = static_cast<uint32_t>(glb.size());
    std::memcpy(glb.data() + 8, &size, 4);
}

/// Reads and, if that succeeds, walks through everything.
bool survives(const std::vector<uint8_t>& glb) {
    const auto sets = readFractureSets(glb);
    if (!sets) return false;
    CheckOptions options;
    options.coverage = false;
    (void)checkFractureSets(glb, options);
    return true;
}

Error refusal(const std::function<void(FractureSet&)>& damage) {
    FractureSet set = makeFracturedCube(small());
    damage(set);
    const NewMaterial inside{"inside"};
    const auto glb =
        attachFractureSets(makeIntactDocument(makeFracturedCube(small())), {&set, 1}, {&inside, 1});
    return glb ? Error{ErrorCode::internal, "accepted", "accepted"} : glb.error();
}

bool refusedAt(const char* pointer, const std::function<void(FractureSet&)>& damage) {
    const Error error = refusal(damage);
    CAPTURE(error.message);
    CAPTURE(error.where);
    CHECK(error.where.find(pointer) != std::string::npos);
    return error.code == ErrorCode::invalidData;
}

/// The document's JSON with one edit, as a file.
std::vector<uint8_t> withJson(const std::string& from, const std::string& to) {
    auto document = parseGlb(makeBakedCube(small()), "cube");
    const size_t at = document->json.find(from);
    REQUIRE(at != std::string::npos);
    document->json.replace(at, from.size(), to);
    return toGlb(*document);
}

}  // namespace

TEST_CASE("a file cut short at any length is refused") {
    const std::vector<uint8_t> whole = makeBakedCube(small());
    REQUIRE(survives(whole));
    for (size_t size = 0; size < whole.size(); ++size) {
        std::vector<uint8_t> glb(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        const auto sets = readFractureSets(glb);
        REQUIRE_FALSE(sets);
        if (size >= 12) REQUIRE(sets.error().code == ErrorCode::malformed);
        // The same with a header that hides it.
        if (size < 12 || size % 7 != 0) continue;
        putLength(glb);
        REQUIRE_FALSE(readFractureSets(glb));
    }
}

TEST_CASE("bytes behind the end are refused") {
    std::vector<uint8_t> glb = makeBakedCube(small());
    glb.push_back(0);
    const auto sets = readFractureSets(glb);
    REQUIRE_FALSE(sets);
    CHECK(sets.error().code == ErrorCode::malformed);
}

TEST_CASE("random bytes changed anywhere never crash the reader or the check") {
    const std::vector<uint8_t> whole = makeBakedCube(small());
    int read = 0;
    for (int i = 0; i < propertyCases(3000); ++i) {
        Random random(static_cast<uint32_t>(i));
        std::vector<uint8_t> glb = whole;
        for (uint32_t n = 1 + random.below(3); n > 0; --n)
            glb[random.below(static_cast<uint32_t>(glb.size()))] =
                static_cast<uint8_t>(random.below(256));
        CAPTURE(i);
        read += survives(glb) ? 1 : 0;
    }
    CHECK(read > 0);
}

TEST_CASE("every number of the extension's JSON can be anything") {
    const auto document = parseGlb(makeBakedCube(small()), "cube");
    REQUIRE(document);
    const size_t begin = document->json.find("\"accessors\"");
    for (size_t at = begin; at < document->json.size(); ++at) {
        const char before = document->json[at - 1];
        if (std::isdigit(static_cast<unsigned char>(document->json[at])) == 0 ||
            (before != ':' && before != ',' && before != '['))
            continue;
        size_t end = at;
        while (std::strchr("0123456789.eE+-", document->json[end]) != nullptr) ++end;
        for (const char* value : {"0", "1", "7", "4294967295", "4294967296", "-1", "1e300", "0.5",
                                  "18446744073709551615", "null", "\"x\"", "[]", "{}"}) {
            GltfDocument changed = *document;
            changed.json.replace(at, end - at, value);
            CAPTURE(at);
            CAPTURE(value);
            survives(toGlb(changed));
        }
    }
}

TEST_CASE("JSON nested without end is refused before it is parsed") {
    const std::string deep = "{\"a\":" + std::string(200000, '[') + std::string(200000, ']') + "}";
    const auto sets = readFractureSets(toGlb({deep, {}}));
    REQUIRE_FALSE(sets);
    CHECK(sets.error().code == ErrorCode::limitExceeded);
    CHECK_FALSE(parseGlb(toGlb({deep, {}}), "deep"));
    const std::string unclosed(100000, '{');
    CHECK_FALSE(readFractureSets(toGlb({unclosed, {}})));
}

TEST_CASE("thousands of fractures sharing one table cannot fill the memory") {
    auto document = parseGlb(makeBakedCube(small()), "cube");
    REQUIRE(document);
    const size_t begin = document->json.find("\"fractures\":[") + 13;
    const size_t end =
        document->json.find("]}}", document->json.find("\"primitives\":[{\"material\"", begin)) + 3;
    const std::string fracture = document->json.substr(begin, end - begin);
    std::string copies;
    for (int i = 0; i < 2000; ++i) copies += fracture + ",";
    document->json.insert(begin, copies);
    const auto sets = readFractureSets(toGlb(*document));
    REQUIRE_FALSE(sets);
    CHECK(sets.error().code == ErrorCode::limitExceeded);
}

TEST_CASE("a fragment among its own ancestors is refused") {
    CHECK(refusedAt("/PARENT", [](FractureSet& s) { s.fragments[1].parent = 3; }));
    CHECK(refusedAt("/PARENT", [](FractureSet& s) { s.fragments[1].parent = 1; }));
    CHECK(refusedAt("/PARENT", [](FractureSet& s) { s.fragments[2].parent = -1; }));
    CHECK(refusedAt("/PARENT", [](FractureSet& s) { s.fragments[0].parent = 0; }));
    CHECK(refusedAt("/PARENT", [](FractureSet& s) { s.fragments[3].parent = 0x7FFFFFFF; }));
}

TEST_CASE("children that are not there, or not theirs, are refused") {
    CHECK(refusedAt("/CHILDREN", [](FractureSet& s) { s.fragments[1].children.count = 9999; }));
    CHECK(refusedAt("/CHILDREN", [](FractureSet& s) {
        s.fragments[1].children = {0xFFFFFFFF, 0xFFFFFFFF};
    }));
    CHECK(refusedAt("/CHILDREN", [](FractureSet& s) { s.fragments[1].children.first += 1; }));
    CHECK(refusedAt("/CHILDREN", [](FractureSet& s) { s.fragments[1].children.count -= 1; }));
    CHECK(refusedAt("/CHILDREN", [](FractureSet& s) { s.fragments[6].children = {1, 1}; }));
}

TEST_CASE("levels that leave out, repeat or exceed fragments are refused") {
    CHECK(refusedAt("/levels", [](FractureSet& s) { s.levels.pop_back(); }));
    CHECK(refusedAt("/levels/1", [](FractureSet& s) { s.levels[1].fragments.first = 0; }));
    CHECK(refusedAt("/levels/2", [](FractureSet& s) { s.levels[2].fragments.count = 50; }));
    CHECK(refusedAt("/levels/0", [](FractureSet& s) { s.levels[0].fragments.count = 2; }));
    CHECK(refusedAt("/levels/3", [](FractureSet& s) { s.levels.push_back({{7, 0}, ""}); }));
}

TEST_CASE("geometry out of range is refused") {
    CHECK(refusedAt("/indices", [](FractureSet& s) { s.geometry.indices[5] = 100000; }));
    CHECK(refusedAt("/indices", [](FractureSet& s) { s.geometry.primitives[1].indices.count++; }));
    CHECK(refusedAt("/indices", [](FractureSet& s) {
        s.geometry.primitives[1].indices = {0xFFFFFFFD, 0xFFFFFFFD};
    }));
    CHECK(refusedAt("/material", [](FractureSet& s) { s.geometry.primitives[0].material = 2; }));
    CHECK(refusedAt("/exposedFrom",
                    [](FractureSet& s) { s.geometry.primitives[0].exposedFrom = 3; }));
    CHECK(refusedAt("/RANGES", [](FractureSet& s) { s.fragmentRanges[4].count += 3000; }));
    CHECK(refusedAt("/RANGES", [](FractureSet& s) { s.fragmentRanges[0].count -= 1; }));
    CHECK(refusedAt("/RANGES", [](FractureSet& s) { s.fragmentRanges[3].first += 1; }));
}

TEST_CASE("numbers that are none are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    CHECK(refusedAt("/POSITION", [&](FractureSet& s) { s.geometry.positions[7].y = nan; }));
    CHECK(refusedAt("/POSITION", [&](FractureSet& s) { s.geometry.positions[0].x = -inf; }));
    CHECK(refusedAt("/NORMAL", [&](FractureSet& s) { s.geometry.attributes[0].values[1] = inf; }));
    CHECK(refusedAt("/MASS", [&](FractureSet& s) { s.fragments[2].mass = nan; }));
    CHECK(refusedAt("/MASS", [&](FractureSet& s) { s.fragments[2].mass = 0; }));
    CHECK(refusedAt("/VOLUME", [&](FractureSet& s) { s.fragments[2].volume = -1; }));
    CHECK(
        refusedAt("/CENTER_OF_MASS", [&](FractureSet& s) { s.fragments[1].centerOfMass.z = inf; }));
    CHECK(refusedAt("/INERTIA_DIAGONAL",
                    [&](FractureSet& s) { s.fragments[1].inertiaDiagonal.z = -1; }));
    CHECK(refusedAt("/INERTIA_ORIENTATION", [&](FractureSet& s) {
        s.fragments[1].inertiaOrientation = {2, 0, 0, 0};
    }));
    CHECK(refusedAt("/DENSITY", [&](FractureSet& s) { s.fragments[1].density = 0; }));
    CHECK(refusedAt("/FRICTION", [&](FractureSet& s) { s.fragments[1].friction = -1; }));
    CHECK(refusedAt("/RESTITUTION", [&](FractureSet& s) { s.fragments[1].restitution = nan; }));
    CHECK(refusedAt("/STRENGTH", [&](FractureSet& s) { s.fragments[1].strength = -1; }));
    CHECK(refusedAt("/TOUGHNESS", [&](FractureSet& s) { s.fragments[1].toughness = inf; }));
    CHECK(refusedAt("/MARGIN", [&](FractureSet& s) { s.hulls[0].margin = -1; }));
    CHECK(refusedAt("/points", [&](FractureSet& s) { s.hullPoints[9].x = nan; }));
    CHECK(refusedAt("/restPose", [&](FractureSet& s) { s.restPose.rotation = {0, 0, 0, 0}; }));
    CHECK(refusedAt("/restPose", [&](FractureSet& s) { s.restPose.translation.x = nan; }));
}

TEST_CASE("hulls and bonds that refer to nothing are refused") {
    CHECK(refusedAt("/HULLS", [](FractureSet& s) { s.fragments[1].hulls = {6, 9}; }));
    CHECK(refusedAt("/hulls", [](FractureSet& s) { s.hulls[1].points = {8, 0xFFFFFFFF}; }));
    CHECK(refusedAt("/POINTS", [](FractureSet& s) { s.hulls[1].points.count = 0; }));
    CHECK(refusedAt("/FRAGMENTS", [](FractureSet& s) { s.bonds[0].a = 1; }));  // no leaf
    CHECK(refusedAt("/FRAGMENTS", [](FractureSet& s) { s.bonds[0].a = -1; }));
    CHECK(refusedAt("/FRAGMENTS", [](FractureSet& s) { s.bonds[0].b = 7; }));
    CHECK(refusedAt("/FRAGMENTS", [](FractureSet& s) { s.bonds[0].b = s.bonds[0].a; }));
    CHECK(refusedAt("/NORMAL", [](FractureSet& s) { s.bonds[0].normal = {0, 0, 0}; }));
    CHECK(refusedAt("/AREA", [](FractureSet& s) { s.bonds[0].area = -1; }));
}

TEST_CASE("JSON that names what is not there is refused with its pointer") {
    struct Case {
        const char* from;
        const char* to;
        const char* where;
    };
    for (const Case& c : {Case{"\"PARENT\":", "\"PARENTS\":", "/fragments/attributes/PARENT"},
                          Case{"\"PARENT\":2", "\"PARENT\":3", "/accessors/3"},
                          Case{"\"PARENT\":2", "\"PARENT\":999", "/PARENT"},
                          Case{"\"fracture\":0", "\"fracture\":1", "/nodes/0"},
                          Case{"\"encoding\":\"none\"", "\"encoding\":\"zip\"", "/encoding"},
                          Case{"\"version\":1,", "\"version\":2,", "/version"},
                          Case{"\"mesh\":0,\"sourceHash\"", "\"mesh\":5,\"sourceHash\"", "/mesh"},
                          Case{"\"materials\":[0,1]", "\"materials\":[0,2]", "/materials/1"},
                          Case{"\"materials\":[0,1]", "\"materials\":[0,-2]", "/materials/1"},
                          Case{"\"vertexCount\":", "\"vertexCount\":1", "/accessors/"},
                          Case{"\"levels\":[", "\"levels\":[7,", "/levels/0"}}) {
        const auto sets = readFractureSets(withJson(c.from, c.to));
        CAPTURE(c.from);
        REQUIRE_FALSE(sets);
        CAPTURE(sets.error().where);
        CHECK(sets.error().where.find(c.where) != std::string::npos);
    }
}

TEST_CASE("words about fragments that are no array of one string each are refused") {
    FractureSet set = makeFracturedCube(small());
    set.fragments[1].material = "oak";
    const NewMaterial inside{"inside"};
    const auto glb = attachFractureSets(makeIntactDocument(set), {&set, 1}, {&inside, 1});
    REQUIRE(glb);
    const std::string right = R"("materials":["","oak","","","","",""])";
    std::string many = "\"materials\":[\"x\"";
    for (int i = 0; i < 100000; ++i) many += ",\"x\"";
    for (const std::string& wrong :
         {std::string(R"("materials":["","oak"])"), std::string(R"("materials":[])"),
          std::string(R"("materials":"oak")"), std::string(R"("materials":{"1":"oak"})"),
          std::string(R"("materials":["",1,"","","","",""])"),
          std::string(R"("materials":[null,"","","","","",""])"), many + "]"}) {
        auto document = parseGlb(*glb, "cube");
        const size_t at = document->json.find(right);
        REQUIRE(at != std::string::npos);
        document->json.replace(at, right.size(), wrong);
        const auto sets = readFractureSets(toGlb(*document));
        CAPTURE(wrong.substr(0, 60));
        REQUIRE_FALSE(sets);
        CHECK(sets.error().code == ErrorCode::invalidData);
        CHECK(sets.error().where.find("/fragments/materials") != std::string::npos);
    }
    // A word of any length is the file's own weight.
    auto document = parseGlb(*glb, "cube");
    document->json.replace(document->json.find("oak"), 3, std::string(1 << 20, 'o'));
    const auto sets = readFractureSets(toGlb(*document));
    REQUIRE(sets);
    CHECK((*sets)[0].fragments[1].material.size() == 1 << 20);
}

TEST_CASE("joined nodes that are not there, or part of an object already, are refused") {
    struct Case {
        const char* joined;
        const char* where;
    };
    for (const Case& c :
         {Case{"[9]", "/joined/0"}, Case{"[-1]", "/joined/0"}, Case{"[1,1]", "/joined/1"},
          Case{"[0]", "/joined/0"}, Case{"[1,\"2\"]", "/joined/1"}, Case{"[]", "/joined"},
          Case{"1", "/joined"}, Case{"[4294967296]", "/joined/0"}, Case{"[0.5]", "/joined/0"}}) {
        auto document = parseGlb(makeBakedCube(small()), "cube");
        REQUIRE(document);
        document->json.insert(document->json.find("],\"meshes\""), ",{\"mesh\":0}");
        const std::string place = "\"mesh\":0,\"sourceHash\"";
        document->json.replace(
            document->json.find(place), place.size(),
            std::string("\"mesh\":0,\"joined\":") + c.joined + ",\"sourceHash\"");
        const auto sets = readFractureSets(toGlb(*document));
        CAPTURE(c.joined);
        REQUIRE_FALSE(sets);
        CHECK(sets.error().code == ErrorCode::invalidData);
        CHECK(sets.error().where.find(c.where) != std::string::npos);
    }
    // The same as further sight and as part.
    auto document = parseGlb(makeBakedCube(small()), "cube");
    document->json.insert(
        document->json.find("],\"meshes\""),
        R"(,{"mesh":0,"extensions":{"SHERD_mesh_fracture":{"fracture":0}}},{"mesh":0})");
    const auto same = readFractureSets(toGlb(*document));
    REQUIRE(same);
    CHECK((*same)[0].sameNodes == std::vector<int32_t>{1});
    const std::string place = "\"mesh\":0,\"sourceHash\"";
    document->json.replace(document->json.find(place), place.size(),
                           "\"mesh\":0,\"joined\":[2],\"sourceHash\"");
    CHECK_FALSE(readFractureSets(toGlb(*document)));
}
