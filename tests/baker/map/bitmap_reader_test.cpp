// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>

#include "bitmap_drawing.h"
#include "map/map_limits.h"
#include "support/png_bytes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

Result<FractureMap> read(const std::vector<uint8_t>& bytes, const BitmapOptions& bitmap = {}) {
    MapReadOptions options;
    options.bitmap = bitmap;
    return readBitmapMap(bytes, "cracks.png", options);
}

ErrorCode errorOf(const std::vector<uint8_t>& bytes, const BitmapOptions& bitmap = {}) {
    const Result<FractureMap> map = read(bytes, bitmap);
    REQUIRE_FALSE(map);
    CHECK_FALSE(map.error().message.empty());
    CHECK(map.error().where == "cracks.png");
    return map.error().code;
}

Drawing cross() {
    const glm::dvec2 c(24.5, 22.5);
    return {48, 44, {{c, {8, 22}}, {c, {40, 23}}, {c, {24, 8}}, {c, {26, 36}}}};
}

/// A PNG of `drawing` whose texels are packed from their coverage.
std::vector<uint8_t> packed(const Drawing& drawing, uint8_t bitDepth, uint8_t colorType,
                            const std::function<std::vector<uint8_t>(int)>& texel,
                            std::vector<uint8_t> palette = {}) {
    PngImage image{static_cast<uint32_t>(drawing.width),
                   static_cast<uint32_t>(drawing.height),
                   bitDepth,
                   colorType,
                   {},
                   std::move(palette)};
    for (const uint8_t covered : coverage(drawing, {3}))
        for (const uint8_t byte : texel(covered)) image.rows.push_back(byte);
    return pngBytes(image);
}

void checkIsCross(const std::vector<uint8_t>& bytes) {
    const Drawing drawing = cross();
    const Result<FractureMap> map = read(bytes);
    INFO((map ? std::string() : map.error().message));
    REQUIRE(map);
    const std::vector<Polyline> lines = inTexels(*map, drawing);
    CHECK(countGraph(lines) == GraphCounts{5, 4, 4});
    CHECK(hausdorff(lines, drawing.lines) < 1);
}

bool warns(const FractureMap& map, const std::string& of) {
    return std::any_of(map.warnings.begin(), map.warnings.end(), [&](const std::string& warning) {
        return warning.find(of) != std::string::npos && warning.find("cracks.png: ") == 0;
    });
}

uint8_t low(int value) {
    return static_cast<uint8_t>(value);
}

}  // namespace

TEST_CASE("no bytes, other bytes and other pictures are malformed") {
    CHECK(errorOf({}) == ErrorCode::malformed);
    CHECK(errorOf({0x89}) == ErrorCode::malformed);
    CHECK(errorOf({'G', 'I', 'F', '8', '9', 'a'}) == ErrorCode::malformed);
    CHECK(errorOf({0xff, 0xd8, 0xff}) == ErrorCode::malformed);
    CHECK(errorOf({0xff, 0xd8, 0xff, 0xd9}) == ErrorCode::malformed);
    CHECK(errorOf(std::vector<uint8_t>(1000, 0)) == ErrorCode::malformed);
}

TEST_CASE("a PNG cut off anywhere is malformed") {
    const std::vector<uint8_t> whole = plainPng(cross(), {3});
    REQUIRE(read(whole));
    // The last four bytes are a checksum over nothing, which is not looked at.
    for (size_t size = 0; size + 4 < whole.size(); ++size) {
        CAPTURE(size);
        CHECK(errorOf({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)}) ==
              ErrorCode::malformed);
    }
}

TEST_CASE("an empty data chunk before the others, as PNG permits, changes nothing") {
    // The decoder copied no bytes to a null pointer there, which the sanitizer stopped at.
    const std::vector<uint8_t> plain = plainPng(cross(), {3});
    std::vector<uint8_t> emptyFirst(plain.begin(), plain.begin() + 8 + 25);
    png::chunk(emptyFirst, "IDAT", {});
    emptyFirst.insert(emptyFirst.end(), plain.begin() + 8 + 25, plain.end());
    const Result<FractureMap> expected = read(plain);
    const Result<FractureMap> got = read(emptyFirst);
    REQUIRE(expected);
    REQUIRE(got);
    CHECK(got->lines.size() == expected->lines.size());
}

TEST_CASE("a JPEG cut off anywhere is malformed, not half read") {
    const Drawing drawing = cross();
    Random random(1);
    const auto whole = greyJpeg(drawing, shades(coverage(drawing, {3}), 255, 0, 0, random), 90);
    checkIsCross(whole);
    for (size_t size = 0; size + 1 < whole.size(); ++size) {
        CAPTURE(size);
        CHECK(errorOf({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)}) ==
              ErrorCode::malformed);
    }
}

TEST_CASE("flipped bytes give a map or an error") {
    const Drawing drawing = cross();
    Random random(7);
    const auto jpeg = greyJpeg(drawing, shades(coverage(drawing, {3}), 255, 0, 0, random), 60);
    for (const std::vector<uint8_t>& whole : {plainPng(drawing, {3}), jpeg})
        for (int i = 0; i < propertyCases(2000); ++i) {
            std::vector<uint8_t> bytes = whole;
            for (uint32_t k = 0; k <= random.below(4); ++k)
                bytes[random.below(static_cast<uint32_t>(bytes.size()))] =
                    low(static_cast<int>(random.below(256)));
            const Result<FractureMap> map = read(bytes);
            if (!map) CHECK_FALSE(map.error().message.empty());
        }
}

TEST_CASE("declared sizes beyond the limits are refused before anything is decoded") {
    const glm::uvec2 sizes[] = {
        {16385, 1}, {1, 16385}, {16384, 16384}, {0xffffffff, 0xffffffff}, {0x7fffffff, 1}};
    for (const glm::uvec2 size : sizes) {
        CAPTURE(size.x);
        CAPTURE(size.y);
        CHECK(errorOf(pngBytes({size.x, size.y, 8, 0, {}, {}})) == ErrorCode::limitExceeded);
    }
    CHECK(errorOf(pngBytes({0, 5, 8, 0, {}, {}})) == ErrorCode::malformed);
    CHECK(errorOf(pngBytes({5, 0, 8, 0, {}, {}})) == ErrorCode::malformed);
    // A size that is allowed, but not what the data hold.
    CHECK(errorOf(pngBytes({8000, 8000, 8, 0, {}, {}})) == ErrorCode::malformed);
    const MapReadOptions options;
    const std::vector<uint8_t> many(kMaxMapBytes + 1);
    const Result<FractureMap> large = readBitmapMap(many, "cracks.png", options);
    REQUIRE_FALSE(large);
    CHECK(large.error().code == ErrorCode::limitExceeded);
}

TEST_CASE("the smallest pictures hold no line") {
    for (uint32_t width = 1; width <= 3; ++width)
        for (uint32_t height = 1; height <= 3; ++height)
            for (uint32_t ink = 0; ink < 1U << (width * height); ++ink) {
                PngImage image{width, height, 8, 0, {}, {}};
                for (uint32_t i = 0; i < width * height; ++i)
                    image.rows.push_back((ink >> i & 1) != 0 ? 0 : 255);
                const Result<FractureMap> map = read(pngBytes(image));
                if (!map) CHECK(map.error().code == ErrorCode::emptyMap);
            }
}

TEST_CASE("every kind of PNG is read") {
    const Drawing drawing = cross();
    checkIsCross(packed(drawing, 8, 0, [](int c) { return std::vector{low(255 - c)}; }));
    checkIsCross(packed(drawing, 16, 0, [](int c) { return std::vector{low(255 - c), low(c)}; }));
    checkIsCross(packed(drawing, 8, 2, [](int c) {
        return std::vector{low(255 - c), low(255 - c / 2), low(255 - c)};
    }));
    checkIsCross(packed(drawing, 16, 2, [](int c) {
        return std::vector<uint8_t>{low(255 - c), 0, low(255 - c), 0, low(255 - c), 0};
    }));
    checkIsCross(packed(drawing, 8, 6, [](int c) {
        return std::vector<uint8_t>{low(255 - c), low(255 - c), low(255 - c), 255};
    }));
    std::vector<uint8_t> palette;
    for (int i = 0; i < 256; ++i) palette.insert(palette.end(), {low(255 - i), low(255 - i), 255});
    checkIsCross(packed(
        drawing, 8, 3, [](int c) { return std::vector{low(c)}; }, palette));
}

TEST_CASE("opaque lines on a transparent ground are read whatever their colour") {
    const Drawing drawing = cross();
    for (const uint8_t colour : {0, 128, 255}) {
        CAPTURE(colour);
        checkIsCross(packed(drawing, 8, 4, [&](int c) {
            return std::vector<uint8_t>{colour, low(c)};
        }));
        checkIsCross(packed(drawing, 8, 6, [&](int c) {
            return std::vector<uint8_t>{colour, colour, colour, low(c)};
        }));
    }
}

TEST_CASE("a mostly opaque picture is read as if on white paper") {
    const Drawing drawing = cross();
    size_t texel = 0;
    checkIsCross(packed(drawing, 8, 4, [&](int c) {
        // A transparent strip on the left; what colour it would have says nothing.
        const bool strip = texel++ % 48 < 2;
        return strip ? std::vector<uint8_t>{0, 0} : std::vector<uint8_t>{low(255 - c), 255};
    }));
}

TEST_CASE("light lines on dark are found, and it is said") {
    const Drawing drawing = cross();
    const auto bytes = packed(drawing, 8, 0, [](int c) { return std::vector{low(c)}; });
    checkIsCross(bytes);
    const Result<FractureMap> map = read(bytes);
    CHECK(warns(*map, "more than half of the picture is dark"));
    CHECK(read(plainPng(drawing, {3}))->warnings.empty());
}

TEST_CASE("a picture of one shade or of specks only is an empty map that says the threshold") {
    for (const uint8_t shade : {0, 128, 255})
        CHECK(errorOf(pngBytes({9, 9, 8, 0, std::vector<uint8_t>(81, shade), {}})) ==
              ErrorCode::emptyMap);
    std::vector<uint8_t> grey(900, 255);
    grey[31] = grey[400] = grey[401] = 0;
    const auto specks = pngBytes({30, 30, 8, 0, grey, {}});
    CHECK(errorOf(specks) == ErrorCode::emptyMap);
    CHECK(read(specks).error().message.find("threshold 0.5") != std::string::npos);
    BitmapOptions given;
    given.threshold = 0.25;
    CHECK(errorOf(specks, given) == ErrorCode::emptyMap);
    CHECK(read(specks, given).error().message.find("threshold 0.250 (given)") != std::string::npos);
}

TEST_CASE("a given threshold decides which lines are dark enough") {
    Drawing drawing{60, 60, {{{10, 15}, {50, 15}}}};
    std::vector<uint8_t> grey(3600, 255);
    for (int x = 8; x < 52; ++x)
        for (int y = 0; y < 3; ++y) {
            grey[static_cast<size_t>(14 + y) * 60 + x] = 0;
            grey[static_cast<size_t>(44 + y) * 60 + x] = 160;
        }
    const auto bytes = greyPng(drawing, grey);
    BitmapOptions options;
    options.threshold = 0.3;
    CHECK(read(bytes, options)->lines.size() == 1);
    options.threshold = 0.8;
    CHECK(read(bytes, options)->lines.size() == 2);
}

TEST_CASE("few lines on a noisy ground are still told from it") {
    const Drawing drawing{300, 300, {{{40.5, 50.2}, {90.1, 80.7}}}};
    Random random(5);
    const auto grey = shades(coverage(drawing, {3}), 220, 40, 12, random);
    const Result<FractureMap> map = read(greyPng(drawing, grey));
    REQUIRE(map);
    CHECK(map->lines.size() == 1);
    CHECK(hausdorff(inTexels(*map, drawing), drawing.lines) < 1);
}

TEST_CASE("specks, spurs and blobs are reported with their place") {
    Drawing drawing{200, 200, {{{20, 100}, {180, 100}}}};
    std::vector<uint8_t> covered = coverage(drawing, {3});
    covered[static_cast<size_t>(50) * 200 + 40] = 255;
    covered[static_cast<size_t>(20) * 200 + 100] = 255;
    for (int k = 0; k < 5; ++k) covered[static_cast<size_t>(102 + k) * 200 + 100] = 255;
    Random random(1);
    const Result<FractureMap> map = read(greyPng(drawing, shades(covered, 255, 0, 0, random)));
    REQUIRE(map);
    CHECK(map->lines.size() == 3);
    CHECK(warns(*map, "2 specks without length left out, the first at UV (0.5025, 0.1025)"));
    BitmapOptions longer;
    longer.spur = 8;
    const auto pruned = read(greyPng(drawing, shades(covered, 255, 0, 0, random)), longer);
    REQUIRE(pruned);
    CHECK(warns(*pruned, "1 dead branches taken for noise"));

    const Drawing blob{100, 100, {{{25, 50}, {75, 50}}}};
    const Result<FractureMap> wide = read(plainPng(blob, {20}));
    REQUIRE(wide);
    REQUIRE(wide->warnings.size() == 1);
    INFO(wide->warnings[0]);
    CHECK(warns(*wide, "the ink is 19 texels wide at UV (0."));
}

TEST_CASE("a branch longer than the spur option stays") {
    Drawing drawing{100, 100, {{{50, 50}, {10, 50}}, {{50, 50}, {90, 50}}, {{50, 50}, {50, 60}}}};
    BitmapOptions options;
    options.spur = 4;
    CHECK(read(plainPng(drawing, {3}), options)->lines.size() == 3);
    options.spur = 12;
    CHECK(read(plainPng(drawing, {3}), options)->lines.size() == 1);
}

TEST_CASE("options out of their range are refused") {
    const auto bytes = plainPng(cross(), {3});
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-1.0, none, 1e9}) {
        BitmapOptions options;
        options.threshold = bad;
        CHECK(errorOf(bytes, options) == ErrorCode::badArgument);
        options = {};
        options.tolerance = bad;
        CHECK(errorOf(bytes, options) == ErrorCode::badArgument);
        options = {};
        options.spur = bad;
        CHECK(errorOf(bytes, options) == ErrorCode::badArgument);
    }
}

TEST_CASE("texel centres, levels and sources are as documented") {
    // One texel wide along row 2 of 10: v = 0.25.
    PngImage image{20, 10, 8, 0, std::vector<uint8_t>(200, 255), {}};
    for (int x = 0; x < 20; ++x) image.rows[40 + x] = 0;
    MapReadOptions options;
    options.level = 3;
    const Result<FractureMap> map = readBitmapMap(pngBytes(image), "cracks.png", options);
    REQUIRE(map);
    REQUIRE(map->lines.size() == 1);
    const FractureMap::Line& line = map->lines[0];
    CHECK(line.level == 3);
    REQUIRE(line.points.size() == 2);
    for (const glm::dvec2 p : line.points) CHECK(p.y == doctest::Approx(0.25).epsilon(1e-6));
    CHECK(std::min(line.points[0].x, line.points[1].x) == 0);
    CHECK(std::max(line.points[0].x, line.points[1].x) == 1);
    CHECK(line.source.find("cracks.png: line 0 from (") == 0);
    CHECK(line.source.find(", 0.25)") != std::string::npos);
}

TEST_CASE("bitmap files are read by their extension") {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    const Drawing drawing = cross();
    Random random(1);
    const auto jpeg = greyJpeg(drawing, shades(coverage(drawing, {3}), 255, 0, 0, random), 90);
    for (const auto& [file, bytes] :
         {std::pair("sherd_bitmap_test.PNG", plainPng(drawing, {3})),
          std::pair("sherd_bitmap_test.jpg", jpeg), std::pair("sherd_bitmap_test.jpeg", jpeg)}) {
        const std::filesystem::path path = folder / file;
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        const Result<FractureMap> map = readFractureMap(path, {});
        std::filesystem::remove(path);
        REQUIRE(map);
        CHECK(map->lines.size() == 4);
        CHECK(map->lines[0].source.find(file) == 0);
    }
}

TEST_CASE("the same bytes give the same map") {
    Random random(11);
    const auto bytes = plainPng(randomDrawing(random, 4), {4});
    const Result<FractureMap> a = read(bytes);
    const Result<FractureMap> b = read(bytes);
    REQUIRE(a);
    REQUIRE(a->lines.size() == b->lines.size());
    for (size_t i = 0; i < a->lines.size(); ++i) CHECK(a->lines[i].points == b->lines[i].points);
}

// stb_image of 2022 writes past its tables for more than 256 codes (found by flipped bytes).
TEST_CASE("a JPEG with too long Huffman tables is malformed, wherever they stand") {
    const Drawing drawing = cross();
    Random random(1);
    const auto whole = greyJpeg(drawing, shades(coverage(drawing, {3}), 255, 0, 0, random), 90);
    size_t tables = 0;
    for (size_t i = 0; i + 21 < whole.size(); ++i) {
        if (whole[i] != 0xff || whole[i + 1] != 0xc4) continue;
        ++tables;
        std::vector<uint8_t> bytes = whole;
        bytes[i + 19] = bytes[i + 20] = 255;
        CHECK(errorOf(bytes) == ErrorCode::malformed);
    }
    CHECK(tables > 0);
    // After the scan, where a decoder that lost its place may find them.
    std::vector<uint8_t> late(whole.begin(), whole.end() - 2);
    late.insert(late.end(), {0xff, 0xc4, 0x01, 0x00, 0x00});
    late.insert(late.end(), 16, 255);
    late.insert(late.end(), {0xff, 0xd9});
    CHECK(errorOf(late) == ErrorCode::malformed);
}

TEST_CASE("a JPEG without the tables it uses gives an error or the same map every time") {
    const Drawing drawing = cross();
    Random random(1);
    const auto whole = greyJpeg(drawing, shades(coverage(drawing, {3}), 255, 0, 0, random), 90);
    for (const uint8_t table : {0xc4, 0xdb}) {
        std::vector<uint8_t> bytes = whole;
        for (size_t i = 0; i + 1 < bytes.size(); ++i)
            if (bytes[i] == 0xff && bytes[i + 1] == table) bytes[i + 1] = 0xfe;  // a comment
        const Result<FractureMap> first = read(bytes);
        const Result<FractureMap> second = read(bytes);
        REQUIRE(first.has_value() == second.has_value());
        if (first) CHECK(first->lines.size() == second->lines.size());
        if (!first) CHECK(first.error().message == second.error().message);
    }
}
