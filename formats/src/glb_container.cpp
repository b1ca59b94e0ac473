// SPDX-License-Identifier: MIT
// The GLB container: header, JSON chunk, BIN chunk (glTF 2.0, chapter 4).
#include <cstring>

#include "gltf_resources.h"
#include "sherd/formats/gltf_document.h"

namespace sherd {

namespace {

constexpr uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;
constexpr uint32_t kBinChunk = 0x004E4942;

uint32_t word(std::span<const uint8_t> bytes, size_t at) {
    return static_cast<uint32_t>(bytes[at]) | static_cast<uint32_t>(bytes[at + 1]) << 8 |
           static_cast<uint32_t>(bytes[at + 2]) << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

void putWord(std::vector<uint8_t>& out, size_t value) {
    for (int shift = 0; shift < 32; shift += 8)
        out.push_back(static_cast<uint8_t>(value >> shift & 0xFF));
}

Result<void> checkHeader(std::span<const uint8_t> bytes, const std::string& name) {
    if (bytes.empty()) return fail(ErrorCode::malformed, "the file is empty", name);
    if (bytes.size() < 12 || word(bytes, 0) != kMagic)
        return fail(ErrorCode::malformed, "not a GLB file: it does not start with \"glTF\"", name);
    if (word(bytes, 4) != 2)
        return fail(
            ErrorCode::unsupported,
            "GLB version " + std::to_string(word(bytes, 4)) + " is not supported; export glTF 2.0",
            name);
    const uint32_t declared = word(bytes, 8);
    if (declared > bytes.size())
        return fail(ErrorCode::malformed,
                    "the file is cut short: its header says " + std::to_string(declared) +
                        " bytes, there are " + std::to_string(bytes.size()),
                    name);
    if (declared < bytes.size())
        return fail(ErrorCode::malformed,
                    "there are " + std::to_string(bytes.size() - declared) +
                        " bytes after the end that the header names",
                    name);
    return {};
}

}  // namespace

Result<GltfDocument> splitGlb(std::span<const uint8_t> bytes, const std::string& name) {
    if (auto header = checkHeader(bytes, name); !header)
        return tl::unexpected<Error>(header.error());
    GltfDocument document;
    size_t at = 12;
    for (int chunk = 0; at < bytes.size(); ++chunk) {
        if (bytes.size() - at < 8)
            return fail(ErrorCode::malformed, "the last chunk has no header", name);
        const uint32_t size = word(bytes, at);
        const uint32_t type = word(bytes, at + 4);
        at += 8;
        if (size > bytes.size() - at)
            return fail(ErrorCode::malformed,
                        "chunk " + std::to_string(chunk) + " is longer than the file", name);
        if (size % 4 != 0)
            return fail(ErrorCode::malformed,
                        "the length of chunk " + std::to_string(chunk) + " is no multiple of 4",
                        name);
        if ((chunk == 0) != (type == kJsonChunk))
            return fail(ErrorCode::malformed, "the JSON chunk must come first, and once", name);
        const std::span<const uint8_t> data = bytes.subspan(at, size);
        if (chunk == 0) document.json.assign(data.begin(), data.end());
        // Later chunks of other kinds are to be ignored, says the format.
        if (chunk == 1 && type == kBinChunk) document.bin.assign(data.begin(), data.end());
        at += size;
    }
    if (document.json.empty()) return fail(ErrorCode::malformed, "there is no JSON chunk", name);
    return document;
}

std::vector<uint8_t> toGlb(const GltfDocument& document) {
    const size_t jsonSize = (document.json.size() + 3) / 4 * 4;
    const size_t binSize = (document.bin.size() + 3) / 4 * 4;
    const size_t total = 20 + jsonSize + (binSize > 0 ? 8 + binSize : 0);
    std::vector<uint8_t> out;
    out.reserve(total);
    putWord(out, kMagic);
    putWord(out, 2);
    putWord(out, total);
    putWord(out, jsonSize);
    putWord(out, kJsonChunk);
    out.insert(out.end(), document.json.begin(), document.json.end());
    out.resize(20 + jsonSize, ' ');
    if (binSize > 0) {
        putWord(out, binSize);
        putWord(out, kBinChunk);
        out.insert(out.end(), document.bin.begin(), document.bin.end());
        out.resize(total, 0);
    }
    return out;
}

}  // namespace sherd
