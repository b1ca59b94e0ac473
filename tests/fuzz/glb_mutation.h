// SPDX-License-Identifier: MIT
// Mutations that know what a GLB is: bytes changed at random seldom get past its header. One value
// of the JSON, some of its text, one number of the binary chunk or some of its bytes are changed,
// and the lengths are made right again.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

namespace sherd::fuzz {

struct GlbParts {
    std::string json;
    std::vector<uint8_t> binary;
};

class GlbMutation {
  public:
    explicit GlbMutation(unsigned seed) : engine_(seed) {}

    size_t operator()(uint8_t* data, size_t size, size_t maxSize) {
        std::optional<GlbParts> parts = split(data, size);
        if (!parts || below(16) == 0) return LLVMFuzzerMutate(data, size, maxSize);
        switch (below(8)) {
            case 0:
                mutateBytes(parts->json, maxSize);
                break;
            case 1:
                mutateBytes(parts->binary, maxSize);
                break;
            case 2:
            case 3:
                changeNumber(parts->binary);
                break;
            default:
                changeValue(parts->json);
        }
        const std::vector<uint8_t> whole = join(*parts);
        if (whole.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
        std::memcpy(data, whole.data(), whole.size());
        return whole.size();
    }

  private:
    using Json = nlohmann::json;
    static constexpr uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;

    uint32_t below(size_t n) { return n == 0 ? 0 : static_cast<uint32_t>(engine_() % n); }

    static uint32_t wordAt(const uint8_t* data, size_t at) {
        uint32_t word = 0;
        std::memcpy(&word, data + at, 4);
        return word;
    }

    static std::optional<GlbParts> split(const uint8_t* data, size_t size) {
        if (size < 20 || wordAt(data, 0) != kMagic || wordAt(data, 16) != kJson) return {};
        const size_t jsonEnd = 20 + size_t{wordAt(data, 12)};
        if (jsonEnd > size) return {};
        GlbParts parts;
        parts.json.assign(reinterpret_cast<const char*>(data) + 20, jsonEnd - 20);
        if (jsonEnd + 8 <= size && wordAt(data, jsonEnd + 4) == kBinary)
            parts.binary.assign(data + jsonEnd + 8, data + size);
        return parts;
    }

    static std::vector<uint8_t> join(const GlbParts& parts) {
        std::vector<uint8_t> out;
        const auto word = [&](size_t value) {
            for (int k = 0; k < 4; ++k) out.push_back(static_cast<uint8_t>(value >> (8 * k)));
        };
        const size_t json = (parts.json.size() + 3) / 4 * 4;
        const size_t binary = (parts.binary.size() + 3) / 4 * 4;
        word(kMagic);
        word(2);
        word(20 + json + (binary > 0 ? 8 + binary : 0));
        word(json);
        word(kJson);
        out.insert(out.end(), parts.json.begin(), parts.json.end());
        out.resize(20 + json, ' ');
        if (binary == 0) return out;
        word(binary);
        word(kBinary);
        out.insert(out.end(), parts.binary.begin(), parts.binary.end());
        out.resize(28 + json + binary, 0);
        return out;
    }

    template <class Bytes>
    void mutateBytes(Bytes& bytes, size_t maxSize) {
        const size_t size = bytes.size();
        const size_t room = std::min(size + 64, maxSize);
        if (room < size || room == 0) return;
        bytes.resize(room);
        bytes.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(bytes.data()), size, room));
    }

    void changeNumber(std::vector<uint8_t>& binary) {
        if (binary.size() < 4) return;
        const size_t at = 4 * size_t{below(binary.size() / 4)};
        uint32_t word = wordAt(binary.data(), at);
        constexpr std::array<float, 7> kFloats{0.0F,
                                               -1.0F,
                                               std::numeric_limits<float>::quiet_NaN(),
                                               std::numeric_limits<float>::infinity(),
                                               std::numeric_limits<float>::max(),
                                               std::numeric_limits<float>::denorm_min(),
                                               1e-30F};
        switch (below(4)) {
            case 0:
                std::memcpy(&word, &kFloats[below(kFloats.size())], 4);
                break;
            case 1:
                word += below(3) - 1;
                break;
            case 2:
                word = wordAt(binary.data(), 4 * size_t{below(binary.size() / 4)});
                break;
            default:
                word = below(2) == 0 ? below(1000) : ~below(4);
        }
        std::memcpy(binary.data() + at, &word, 4);
    }

    static size_t countOf(const Json& json) {
        size_t count = 1;
        if (json.is_structured())
            for (const Json& item : json) count += countOf(item);
        return count;
    }

    /// The n-th value, counted from 0 as it is written, and what holds it.
    static std::pair<Json*, Json*> find(Json& json, Json* holder, size_t& n) {
        if (n-- == 0) return {&json, holder};
        if (json.is_structured()) {
            for (Json& item : json) {
                const auto found = find(item, &json, n);
                if (found.first != nullptr) return found;
            }
        }
        return {nullptr, nullptr};
    }

    void changeValue(std::string& text) {
        Json json = Json::parse(text, nullptr, false);
        if (json.is_discarded()) return;
        size_t n = below(countOf(json));
        const auto [value, holder] = find(json, nullptr, n);
        if (value == nullptr) return;
        if (holder != nullptr && holder->is_array() && below(4) == 0) {
            if (below(2) == 0)
                holder->push_back(Json(*value));
            else
                holder->erase(static_cast<size_t>(value - &(*holder)[0]));
        } else if (holder != nullptr && holder->is_object() && below(8) == 0) {
            for (auto it = holder->begin(); it != holder->end(); ++it) {
                if (&*it != value) continue;
                holder->erase(it);
                break;
            }
        } else {
            *value = otherValue(*value, json);
        }
        text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    Json otherValue(const Json& value, const Json& whole) {
        if (value.is_number() && below(8) != 0) {
            const std::array<Json, 10> others{
                0, 1, -1, 5125, 5126, 0xFFFFFFFFU, 1e300, 9007199254740993LL, 0.5, below(100)};
            const uint32_t which = below(others.size() + 4);
            if (which < others.size()) return others[which];
            if (value.is_number_float()) return -value.get<double>();
            return value.get<int64_t>() / (which % 2 == 0 ? 1 : 2) + (which % 2 == 0 ? 1 : 0);
        }
        if (value.is_string() && below(4) != 0) {
            const std::array<Json, 6> others{"",     "SCALAR", "VEC3",
                                             "VEC4", "MAT4",   "data:application/octet-stream,"};
            return others[below(others.size())];
        }
        if (below(2) == 0) {  // something else that is in the file
            size_t n = below(countOf(whole));
            Json copy = whole;
            if (const auto found = find(copy, nullptr, n); found.first != nullptr)
                return *found.first;
        }
        const std::array<Json, 6> others{nullptr, true, Json::array(), Json::object(), "x", 3};
        return others[below(others.size())];
    }

    std::mt19937 engine_;
};

}  // namespace sherd::fuzz

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize,
                                          unsigned seed) {
    return sherd::fuzz::GlbMutation(seed)(data, size, maxSize);
}
