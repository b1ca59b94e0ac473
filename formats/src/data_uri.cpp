// SPDX-License-Identifier: MIT
// Percent escapes (RFC 3986) and data URIs (RFC 2397) with base64 (RFC 4648).
#include "gltf_resources.h"

namespace sherd {

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

}  // namespace

std::optional<std::string> percentDecoded(const std::string& uri) {
    std::string out;
    out.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            out += uri[i];
            continue;
        }
        if (i + 2 >= uri.size()) return std::nullopt;
        const int high = hexDigit(uri[i + 1]);
        const int low = hexDigit(uri[i + 2]);
        // A NUL would cut the file name short.
        if (high < 0 || low < 0 || high + low == 0) return std::nullopt;
        out += static_cast<char>(16 * high + low);
        i += 2;
    }
    return out;
}

std::optional<std::vector<uint8_t>> dataUriBytes(const std::string& uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string::npos) return std::nullopt;
    if (uri.substr(0, comma).find(";base64") == std::string::npos) {
        const std::optional<std::string> text = percentDecoded(uri.substr(comma + 1));
        if (!text) return std::nullopt;
        return std::vector<uint8_t>(text->begin(), text->end());
    }
    std::vector<uint8_t> bytes;
    bytes.reserve((uri.size() - comma) / 4 * 3);
    uint32_t bits = 0;
    int count = 0;
    for (size_t i = comma + 1; i < uri.size(); ++i) {
        if (uri[i] == '=') break;
        const int digit = base64Digit(uri[i]);
        if (digit < 0) return std::nullopt;
        bits = (bits << 6 | static_cast<uint32_t>(digit)) & 0xFFFFFF;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<uint8_t>(bits >> count & 0xFF));
        }
    }
    return bytes;
}

}  // namespace sherd
