// SPDX-License-Identifier: MIT
// Containers and files: GLB, glTF with parts beside it, and writing whole or not at all.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

#include "sherd/formats/glb_write.h"
#include "sherd/formats/gltf_document.h"

using namespace sherd;

namespace {

/// A folder of its own, gone afterwards.
class Folder {
  public:
    Folder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "sherd_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    size_t files() const {
        size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            (void)entry;
            ++count;
        }
        return count;
    }
    void write(const std::string& name, const std::string& content) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << content;
    }

  private:
    std::filesystem::path path_;
};

std::string textAt(const GltfDocument& document, size_t offset, size_t size) {
    return {document.bin.begin() + static_cast<std::ptrdiff_t>(offset),
            document.bin.begin() + static_cast<std::ptrdiff_t>(offset + size)};
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::string kPng = "\x89PNG picture";

}  // namespace

TEST_CASE("a plain GLB is taken and given back bit for bit") {
    // Odd spacing, padding and numbers included.
    const GltfDocument document{
        "{ \"asset\" : {\"version\":\"2.0\",\"n\":1e5},\n"
        "\"buffers\":[{\"byteLength\":5}]}  ",
        {1, 2, 3, 4, 5, 0, 0, 0}};
    const std::vector<uint8_t> glb = toGlb(document);
    const auto parsed = parseGlb(glb, "a.glb");
    REQUIRE(parsed);
    CHECK(toGlb(*parsed) == glb);
    CHECK(parsed->bin == document.bin);
}

TEST_CASE("a GLB whose buffer is longer than its chunk, or empty, is refused") {
    for (const char* length : {"9", "0", "-1", "1.5", "\"8\"", "1e400"}) {
        const std::string json = std::string("{\"buffers\":[{\"byteLength\":") + length + "}]}";
        CAPTURE(length);
        CHECK_FALSE(parseGlb(toGlb({json, std::vector<uint8_t>(8)}), "a.glb"));
    }
    CHECK_FALSE(parseGlb(toGlb({"[1,2]", {}}), "a.glb"));
    CHECK_FALSE(parseGlb(toGlb({"{\"a\":", {}}), "a.glb"));
    CHECK_FALSE(parseGlb(toGlb({"{\"buffers\":[]}", {}}), "a.glb"));
}

TEST_CASE("a glTF with several buffers and images beside it becomes one document") {
    const Folder folder;
    folder.write("a b.bin", "firstXX");
    folder.write("sub/two.bin", "second");
    folder.write("sub/pic.png", kPng);
    folder.write("model.gltf",
                 R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a%20b.bin","byteLength":5,)"
                 R"("name":"n"},{"byteLength":6,"uri":"sub/../sub/two.bin"},)"
                 R"({"uri":"data:application/octet-stream;base64,dGhpcmQ=","byteLength":5}],)"
                 R"("bufferViews":[{"buffer":0,"byteLength":5},{"buffer":1,"byteOffset":1,)"
                 R"("byteLength":5},{"byteLength":5,"buffer":2}],)"
                 R"("images":[{"uri":"sub/pic.png","name":"pic"}],"extras":{"keep":1e5}})");
    const auto document = loadGltfDocument(folder / "model.gltf");
    if (!document) FAIL(document.error().message << " at " << document.error().where);
    CHECK(document->json ==
          R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"name":"n"}],)"
          R"("bufferViews":[{"buffer":0,"byteLength":5},{"buffer":0,"byteOffset":9,)"
          R"("byteLength":5},{"byteLength":5,"buffer":0,"byteOffset":16},)"
          R"({"buffer":0,"byteOffset":24,"byteLength":12}],)"
          R"("images":[{"bufferView":3,"mimeType":"image/png","name":"pic"}],)"
          R"("extras":{"keep":1e5}})");
    CHECK(textAt(*document, 0, 5) == "first");
    CHECK(textAt(*document, 9, 5) == "econd");
    CHECK(textAt(*document, 16, 5) == "third");
    CHECK(textAt(*document, 24, 12) == kPng);
    // What was taken in stands on its own.
    CHECK(parseGlb(toGlb(*document), "again.glb"));
}

TEST_CASE("an image with a media type of its own keeps it") {
    const Folder folder;
    folder.write("model.gltf",
                 R"({"images":[{"mimeType":"image/jpeg","uri":"data:image/png;base64,AAAA"}]})");
    const auto document = loadGltfDocument(folder / "model.gltf");
    REQUIRE(document);
    CHECK(has(document->json, R"({"mimeType":"image/jpeg","bufferView":0})"));
    CHECK(has(document->json, R"("buffers":[{"byteLength":3}])"));
}

TEST_CASE("placeholder buffers of meshopt files move behind the merged one") {
    const Folder folder;
    folder.write("a.bin", "abcd");
    folder.write("b.bin", "efgh");
    folder.write(
        "model.gltf",
        R"({"buffers":[{"uri":"a.bin","byteLength":4},{"byteLength":99,"x":1},)"
        R"({"uri":"b.bin","byteLength":4}],"bufferViews":[{"buffer":1,"byteLength":9,)"
        R"("extensions":{"EXT_meshopt_compression":{"buffer":2,"byteOffset":1,"byteLength":3}}}]})");
    const auto document = loadGltfDocument(folder / "model.gltf");
    REQUIRE(document);
    CHECK(has(document->json, R"("buffers":[{"byteLength":12},{"byteLength":99,"x":1}])"));
    CHECK(has(document->json, R"([{"buffer":1,"byteLength":9,)"));
    CHECK(has(document->json, R"({"buffer":0,"byteOffset":9,"byteLength":3})"));
}

TEST_CASE("parts that are missing, short, damaged or elsewhere are named") {
    const Folder folder;
    folder.write("short.bin", "abc");
    struct Case {
        const char* json;
        ErrorCode code;
        const char* where;
    };
    for (const Case& c :
         {Case{R"({"buffers":[{"uri":"no.bin","byteLength":4}]})", ErrorCode::fileNotFound,
               "/buffers/0/uri"},
          Case{R"({"buffers":[{"uri":"short.bin","byteLength":4}]})", ErrorCode::malformed,
               "/buffers/0"},
          Case{R"({"buffers":[{"uri":"short.bin"}]})", ErrorCode::invalidData,
               "/buffers/0/byteLength"},
          Case{R"({"buffers":[{"uri":"short.bin","byteLength":0}]})", ErrorCode::invalidData,
               "/buffers/0/byteLength"},
          Case{R"({"buffers":[{"uri":"/etc/hostname","byteLength":1}]})", ErrorCode::unsupported,
               "/buffers/0/uri"},
          Case{R"({"buffers":[{"uri":"http://a/b","byteLength":1}]})", ErrorCode::unsupported,
               "/buffers/0/uri"},
          Case{R"({"buffers":[{"uri":"a%0","byteLength":1}]})", ErrorCode::malformed,
               "/buffers/0/uri"},
          Case{R"({"buffers":[{"uri":"data:;base64,A*A","byteLength":1}]})", ErrorCode::malformed,
               "/buffers/0/uri"},
          Case{R"({"buffers":[{"uri":7,"byteLength":1}]})", ErrorCode::malformed, "/buffers/0/uri"},
          Case{R"({"images":[{"uri":"no.png"}]})", ErrorCode::fileNotFound, "/images/0/uri"},
          Case{R"({"buffers":[{"byteLength":4}]})", ErrorCode::malformed,
               "/buffers/0/byteLength"}}) {
        folder.write("model.gltf", c.json);
        CAPTURE(c.json);
        const auto document = loadGltfDocument(folder / "model.gltf");
        REQUIRE_FALSE(document);
        CHECK(document.error().code == c.code);
        CHECK(has(document.error().where, c.where));
    }
}

TEST_CASE("a model that is missing, a directory or something else is named so") {
    const Folder folder;
    CHECK(loadGltfDocument(folder / "none.glb").error().code == ErrorCode::fileNotFound);
    CHECK(loadGltfDocument(folder / "").error().code == ErrorCode::fileRead);
    folder.write("text.glb", "hello, this is no model");
    CHECK(loadGltfDocument(folder / "text.glb").error().code == ErrorCode::malformed);
    folder.write("empty.gltf", "");
    CHECK(loadGltfDocument(folder / "empty.gltf").error().code == ErrorCode::malformed);
    folder.write("old.glb", std::string("glTF\x01\0\0\0\x0c\0\0\0", 12));
    CHECK(loadGltfDocument(folder / "old.glb").error().code == ErrorCode::unsupported);
}

TEST_CASE("a file is written whole, or nothing is there") {
    const Folder folder;
    const std::vector<uint8_t> bytes(100000, 7);
    REQUIRE(writeFileWhole(folder / "out.bin", bytes));
    CHECK(std::filesystem::file_size(folder / "out.bin") == bytes.size());
    REQUIRE(writeFileWhole(folder / "out.bin", std::vector<uint8_t>(3)));
    CHECK(std::filesystem::file_size(folder / "out.bin") == 3);
    CHECK(folder.files() == 1);
    for (const auto& path : {folder / "none/out.bin", folder / "", folder / "out.bin/x"}) {
        const auto written = writeFileWhole(path, bytes);
        REQUIRE_FALSE(written);
        CHECK(written.error().code == ErrorCode::fileWrite);
        CHECK(written.error().where == path.string());
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a full disk is told") {
    if (!std::filesystem::exists("/dev/full")) return;
    const auto written = writeFileWhole("/dev/full", std::vector<uint8_t>(10));
    REQUIRE_FALSE(written);
    CHECK(written.error().code == ErrorCode::fileWrite);
    CHECK(has(written.error().message, "full"));
}

TEST_CASE("writing through a link keeps the link") {
    const Folder folder;
    folder.write("real.bin", "old");
    std::filesystem::create_symlink(folder / "real.bin", folder / "link.bin");
    REQUIRE(writeFileWhole(folder / "link.bin", std::vector<uint8_t>(5)));
    CHECK(std::filesystem::is_symlink(folder / "link.bin"));
    CHECK(std::filesystem::file_size(folder / "real.bin") == 5);
}
