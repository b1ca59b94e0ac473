// SPDX-License-Identifier: MIT
// Geometry on grids, compressed by Draco, in builds that have it.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "quantized_stream.h"
#include "sherd/formats/glb_read.h"
#include "sherd/formats/glb_write.h"
#include "sherd/formats/validate.h"
#include "support/fractured_cube.h"
#include "support/same_set.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr GeometryPacking kDraco{GeometryPacking::Encoding::draco};

FractureSet makeSet() {
    FracturedCubeOptions options;
    options.size = {0.3F, 1.7F, 0.9F};
    options.splits = {{2, 1, 1}, {1, 3, 2}, {2, 2, 2}};
    FractureSet set = makeFracturedCube(options);
    set.geometry.attributes.push_back(
        {"_HEAT", 1, std::vector<float>(set.geometry.positions.size())});
    for (size_t v = 0; v < set.geometry.positions.size(); ++v)
        set.geometry.attributes.back().values[v] = 100 * std::sin(float(v));
    return set;
}

Result<std::vector<uint8_t>> attach(const FractureSet& set, const GeometryPacking& packing) {
    const NewMaterial inside{"inside"};
    return attachFractureSets(makeIntactDocument(set), {&set, 1}, {&inside, 1}, packing);
}

/// The same file with other bytes at a place of its JSON; the length stays.
std::vector<uint8_t> replaced(std::vector<uint8_t> glb, const std::string& what,
                              const std::string& by) {
    REQUIRE(what.size() == by.size());
    const auto at = std::search(glb.begin(), glb.end(), what.begin(), what.end());
    REQUIRE(at != glb.end());
    std::copy(by.begin(), by.end(), at);
    return glb;
}

struct Stream {
    QuantizedMesh mesh;
    std::vector<uint8_t> bytes;
};

Stream makeStream() {
    Stream stream;
    stream.mesh = quantize(makeSet().geometry, kDraco).value();
    stream.bytes = encodeDraco(stream.mesh).value();
    return stream;
}

Result<void> decode(const Stream& stream) {
    QuantizedMesh mesh = stream.mesh;
    return decodeDraco(stream.bytes, uint32_t(stream.mesh.indices.size()), mesh);
}

/// The message of the refusal; empty when there is none.
std::string refusal(const Stream& stream) {
    const auto decoded = decode(stream);
    return decoded ? std::string() : decoded.error().message;
}

}  // namespace

TEST_CASE("values that a grid cannot hold are refused") {
    const FractureGeometry sound = makeSet().geometry;
    for (const uint32_t bits : {0U, 31U}) {
        GeometryPacking packing = kDraco;
        packing.positionBits = bits;
        CHECK_FALSE(quantize(sound, packing).has_value());
        packing = kDraco;
        packing.attributeBits = bits;
        CHECK_FALSE(quantize(sound, packing).has_value());
    }
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -HUGE_VALF}) {
        FractureGeometry geometry = sound;
        geometry.positions[3].y = value;
        CHECK_FALSE(quantize(geometry, kDraco).has_value());
        geometry = sound;
        geometry.attributes.back().values[2] = value;
        CHECK_FALSE(quantize(geometry, kDraco).has_value());
    }
    FractureGeometry geometry = sound;
    geometry.indices[7] = uint32_t(geometry.positions.size());
    CHECK_FALSE(quantize(geometry, kDraco).has_value());
}

TEST_CASE("values lie at most half a step off, and equal ones stay equal") {
    const FractureGeometry geometry = makeSet().geometry;
    for (const uint32_t bits : {1U, 8U, 20U, 30U}) {
        CAPTURE(bits);
        GeometryPacking packing = kDraco;
        packing.positionBits = bits;
        const QuantizedMesh mesh = quantize(geometry, packing).value();
        REQUIRE(mesh.vertexCount == geometry.positions.size());
        CHECK(mesh.indices == geometry.indices);
        const QuantizedAttribute& positions = mesh.attributes[0];
        CHECK(positions.step == doctest::Approx(1.7 / (std::pow(2.0, bits) - 1)));
        const std::vector<float> values = dequantize(positions);
        for (size_t v = 0; v < geometry.positions.size(); ++v)
            for (int c = 0; c < 3; ++c)
                CHECK(std::abs(values[3 * v + size_t(c)] - geometry.positions[v][c]) <=
                      0.501F * positions.step + 1e-7F);
    }
}

TEST_CASE("what is the same everywhere, or used by no triangle, does no harm") {
    FractureGeometry geometry = makeSet().geometry;
    std::fill(geometry.attributes.back().values.begin(), geometry.attributes.back().values.end(),
              3.0F);
    geometry.positions.emplace_back(NAN, 0, 0);  // nobody's
    for (Attribute& attribute : geometry.attributes)
        attribute.values.resize(geometry.positions.size() * attribute.components, NAN);
    const QuantizedMesh mesh = quantize(geometry, kDraco).value();
    CHECK(mesh.vertexCount + 1 == geometry.positions.size());
    for (const float value : dequantize(mesh.attributes.back())) CHECK(value == 3.0F);
}

TEST_CASE("a packed file holds the grid's values bit for bit, closed, and much smaller") {
    if (!hasDraco()) return;
    const FractureSet set = makeSet();
    const auto plain = attach(set, {}).value();
    const auto packed = attach(set, kDraco).value();
    const size_t geometry = 4 * (set.geometry.indices.size() + 9 * set.geometry.positions.size());
    const size_t saved = plain.size() - packed.size();
    MESSAGE("geometry ", geometry, " bytes, as Draco ", geometry - saved);
    CHECK(saved * 4 > geometry * 3);
    FractureSet expected = readFractureSets(plain).value()[0];
    const QuantizedMesh mesh = quantize(expected.geometry, kDraco).value();
    expected.geometry.positions.clear();
    const std::vector<float> places = dequantize(mesh.attributes[0]);
    for (size_t v = 0; v < places.size(); v += 3)
        expected.geometry.positions.emplace_back(places[v], places[v + 1], places[v + 2]);
    expected.geometry.attributes.clear();
    for (size_t a = 1; a < mesh.attributes.size(); ++a)
        expected.geometry.attributes.push_back({mesh.attributes[a].semantic,
                                                mesh.attributes[a].components,
                                                dequantize(mesh.attributes[a])});
    CHECK(whatDiffers(expected, readFractureSets(packed).value()[0]) == "");
    const CheckReport report = checkFractureSets(packed).value();
    for (const Finding& finding : report.findings) CAPTURE(finding.message);
    CHECK(report.passed());
}

TEST_CASE("a packed set is taken out again, byte for byte") {
    if (!hasDraco()) return;
    const FractureSet set = makeSet();
    const GltfDocument document = makeIntactDocument(set);
    const auto twice = [&](const GeometryPacking& packing) {
        const NewMaterial inside{"inside"};
        const auto glb = attachFractureSets(document, {&set, 1}, {&inside, 1}, packing).value();
        return parseGlb(glb, "packed").value();
    };
    CHECK(withoutFractureSets(twice(kDraco)).value().json ==
          withoutFractureSets(twice({})).value().json);
    CHECK(withoutFractureSets(twice(kDraco)).value().bin ==
          withoutFractureSets(twice({})).value().bin);
}

TEST_CASE("a grid too coarse for a fragment is refused, with what to do") {
    if (!hasDraco()) return;
    GeometryPacking packing = kDraco;
    packing.positionBits = 1;
    const auto packed = attach(makeSet(), packing);
    REQUIRE_FALSE(packed.has_value());
    CHECK(packed.error().code == ErrorCode::notClosed);
    CHECK(packed.error().message.find("more bits") != std::string::npos);
}

TEST_CASE("a stream loses nothing") {
    if (!hasDraco()) return;
    const Stream stream = makeStream();
    QuantizedMesh mesh = stream.mesh;
    mesh.indices.clear();
    for (QuantizedAttribute& attribute : mesh.attributes) attribute.values.clear();
    REQUIRE(decodeDraco(stream.bytes, uint32_t(stream.mesh.indices.size()), mesh).has_value());
    CHECK(mesh.indices == stream.mesh.indices);
    for (size_t a = 0; a < mesh.attributes.size(); ++a)
        CHECK(mesh.attributes[a].values == stream.mesh.attributes[a].values);
}

TEST_CASE(
    "a stream of another version, kind or size than the file's is refused before it is decoded") {
    if (!hasDraco()) return;
    const Stream sound = makeStream();
    REQUIRE(refusal(sound).empty());
    const auto changed = [&](size_t at, uint8_t value) {
        Stream stream = sound;
        stream.bytes[at] = value;
        return refusal(stream);
    };
    CHECK(changed(0, 'd').find("begin") != std::string::npos);
    CHECK(changed(5, 1).find("version") != std::string::npos);
    CHECK(changed(6, 1).find("version") != std::string::npos);
    CHECK(changed(7, 0).find("no mesh") != std::string::npos);
    CHECK(changed(8, 1).find("sequential") != std::string::npos);
    CHECK(changed(10, 0x80).find("metadata") != std::string::npos);
    CHECK(changed(11, uint8_t(sound.bytes[11] ^ 1)).find("counts") != std::string::npos);
    for (const uint8_t byte : {0xFF, 0x80}) {  // counts without an end
        Stream stream = sound;
        std::fill(stream.bytes.begin() + 11, stream.bytes.end(), byte);
        CHECK(refusal(stream).find("counts") != std::string::npos);
    }
    Stream other = sound;
    ++other.mesh.vertexCount;
    CHECK(refusal(other).find("counts") != std::string::npos);
    other = sound;
    other.mesh.indices.resize(other.mesh.indices.size() - 3);
    CHECK(refusal(other).find("counts") != std::string::npos);
    other = sound;
    other.mesh.attributes.pop_back();
    CHECK_FALSE(refusal(other).empty());
    other = sound;
    other.mesh.attributes.back().components = 4;
    CHECK_FALSE(refusal(other).empty());
}

TEST_CASE("a small stream of an old version that asks for gigabytes is refused at once") {
    if (!hasDraco()) return;
    Stream stream = makeStream();
    stream.bytes.assign({'D', 'R', 'A', 'C', 'O', 1, 1, 1, 0});
    stream.bytes.resize(61, 0x7F);
    CHECK(refusal(stream).find("version") != std::string::npos);
}

TEST_CASE("a stream cut short or changed anywhere is refused or decodes to as much") {
    if (!hasDraco()) return;
    const Stream sound = makeStream();
    for (size_t length = 0; length < sound.bytes.size(); length += 1 + length / 64) {
        Stream cut = sound;
        cut.bytes.resize(length);
        CHECK_FALSE(decode(cut).has_value());
    }
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        Stream spoiled = sound;
        for (int k = 0; k <= i % 3; ++k)
            spoiled.bytes[random() % spoiled.bytes.size()] = uint8_t(random());
        QuantizedMesh mesh = spoiled.mesh;
        const auto count = uint32_t(mesh.indices.size());
        if (!decodeDraco(spoiled.bytes, count, mesh)) continue;
        REQUIRE(mesh.indices.size() == count);
        for (const QuantizedAttribute& attribute : mesh.attributes)
            REQUIRE(attribute.values.size() == size_t{mesh.vertexCount} * attribute.components);
    }
}

TEST_CASE("what a file says of its stream is checked") {
    if (!hasDraco()) return;
    const auto sound = attach(makeSet(), kDraco).value();
    const auto code = [](const std::vector<uint8_t>& glb) {
        const auto read = readFractureSets(glb);
        return read ? ErrorCode::internal : read.error().code;
    };
    CHECK(code(sound) == ErrorCode::internal);
    const std::string count = std::to_string(makeSet().geometry.positions.size());
    const std::string many(count.size(), '9');
    CHECK(code(replaced(sound, "\"vertexCount\":" + count, "\"vertexCount\":" + many)) ==
          ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"encoding\":\"draco\"", "\"encoding\":\"drago\"")) ==
          ErrorCode::unsupported);
    CHECK(code(replaced(sound, "\"id\":0", "\"id\":1")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"id\":0", "\"id\":9")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"components\":3", "\"components\":0")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"components\":3", "\"components\":5")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"POSITION\":{\"id\"", "\"POSITIOM\":{\"id\"")) ==
          ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"stream\":", "\"strean\":")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"step\":", "\"stop\":")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "\"origin\":", "\"orchid\":")) == ErrorCode::invalidData);
    CHECK(code(replaced(sound, "DRACO", "DRAMA")) == ErrorCode::invalidData);
}
