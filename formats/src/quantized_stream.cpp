// SPDX-License-Identifier: MIT
#include "quantized_stream.h"

#include <algorithm>
#include <cmath>

namespace sherd {
namespace {

constexpr uint32_t kUnused = UINT32_MAX;

/// The new number of every vertex, in the order of the old ones; kUnused of those that no triangle
/// has: Draco's sequential decoder fails on them.
std::vector<uint32_t> numberUsed(const FractureGeometry& geometry, uint32_t& count) {
    std::vector<uint32_t> numbers(geometry.positions.size(), kUnused);
    for (const uint32_t index : geometry.indices) numbers[index] = 0;
    count = 0;
    for (uint32_t& number : numbers)
        if (number != kUnused) number = count++;
    return numbers;
}

/// `get(v, c)`: a value.
template <class Get>
bool fillAttribute(QuantizedAttribute& out, const std::vector<uint32_t>& numbers, uint32_t bits,
                   const Get& get) {
    out.origin.assign(out.components, 0.0F);
    double widest = 0;
    for (uint32_t c = 0; c < out.components; ++c) {
        float low = HUGE_VALF, high = -HUGE_VALF;
        for (size_t v = 0; v < numbers.size(); ++v) {
            if (numbers[v] == kUnused) continue;
            const float value = get(v, c);
            if (!std::isfinite(value)) return false;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        out.origin[c] = low;
        widest = std::max(widest, double(high) - double(low));
    }
    const auto steps = double((uint64_t{1} << bits) - 1);
    out.step = float(widest / steps);
    if (!(out.step > 0) || !std::isfinite(out.step)) out.step = widest > 0 ? HUGE_VALF : 1.0F;
    if (!std::isfinite(out.step)) return false;
    for (size_t v = 0; v < numbers.size(); ++v) {
        if (numbers[v] == kUnused) continue;
        for (uint32_t c = 0; c < out.components; ++c) {
            const double at = (double(get(v, c)) - double(out.origin[c])) / double(out.step);
            out.values.push_back(uint32_t(std::clamp(std::round(at), 0.0, steps)));
        }
    }
    return true;
}

/// Of the first three components, `length` 3 or 4 apart.
void normalize(std::vector<float>& values, uint32_t components) {
    for (size_t i = 0; i + 2 < values.size(); i += components) {
        const double x = double(values[i]), y = double(values[i + 1]), z = double(values[i + 2]);
        const double length = std::sqrt(x * x + y * y + z * z);
        if (!(length > 0)) continue;
        values[i] = float(x / length);
        values[i + 1] = float(y / length);
        values[i + 2] = float(z / length);
    }
}

bool areBits(uint32_t bits) {
    return bits >= 1 && bits <= 30;
}

}  // namespace

Result<QuantizedMesh> quantize(const FractureGeometry& geometry, const GeometryPacking& packing) {
    if (!areBits(packing.positionBits) || !areBits(packing.attributeBits))
        return fail(ErrorCode::badArgument, "the bits of a grid must be 1 to 30", "packing");
    const auto refuse = [](const std::string& semantic) {
        return fail(ErrorCode::badArgument,
                    "values are not finite, or spread too far or too little for a grid",
                    "geometry/" + semantic);
    };
    for (const uint32_t index : geometry.indices)
        if (index >= geometry.positions.size())
            return fail(ErrorCode::badArgument, "an index names no vertex", "geometry/indices");
    QuantizedMesh mesh;
    const std::vector<uint32_t> numbers = numberUsed(geometry, mesh.vertexCount);
    mesh.indices.reserve(geometry.indices.size());
    for (const uint32_t index : geometry.indices) mesh.indices.push_back(numbers[index]);
    QuantizedAttribute positions{"POSITION", 3, {}, 1, {}};
    const auto position = [&](size_t v, uint32_t c) {
        return geometry.positions[v][static_cast<int>(c)];
    };
    if (!fillAttribute(positions, numbers, packing.positionBits, position))
        return refuse(positions.semantic);
    mesh.attributes.push_back(std::move(positions));
    for (const Attribute& attribute : geometry.attributes) {
        QuantizedAttribute out{attribute.semantic, attribute.components, {}, 1, {}};
        const auto value = [&](size_t v, uint32_t c) {
            return attribute.values[v * attribute.components + c];
        };
        if (!fillAttribute(out, numbers, packing.attributeBits, value))
            return refuse(attribute.semantic);
        mesh.attributes.push_back(std::move(out));
    }
    return mesh;
}

std::vector<float> dequantize(const QuantizedAttribute& attribute) {
    std::vector<float> values(attribute.values.size());
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = float(double(attribute.values[i]) * double(attribute.step) +
                          double(attribute.origin[i % attribute.components]));
    if (attribute.semantic == "NORMAL" || attribute.semantic == "TANGENT") {
        normalize(values, attribute.components);
        // The fourth of a tangent is a sign.
        if (attribute.components == 4)
            for (size_t i = 3; i < values.size(); i += 4) values[i] = values[i] < 0 ? -1.0F : 1.0F;
    }
    return values;
}

}  // namespace sherd
