// SPDX-License-Identifier: MIT
#include "import/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "import/limits.h"

namespace sherd {
namespace {

/// `count` elements of `size` bytes, `stride` apart; data null means zeros.
struct Elements {
    const uint8_t* data = nullptr;
    uint64_t count = 0;
    uint64_t stride = 0;
};

/// Bytes of one component; 0 for types glTF 2.0 does not have.
uint32_t componentSize(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

uint32_t componentCount(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

Result<Elements> locate(const GltfSource& source, int view, uint64_t byteOffset, uint64_t count,
                        uint64_t size, bool strided, const std::string& pointer) {
    const auto bad = [&](const std::string& message) {
        return fail(ErrorCode::invalidData, message, source.where(pointer));
    };
    if (view < 0 || static_cast<size_t>(view) >= source.model.bufferViews.size()) {
        return bad("refers to a bufferView that does not exist");
    }
    const tinygltf::BufferView& bufferView = source.model.bufferViews[static_cast<size_t>(view)];
    const std::vector<uint8_t>& bin = source.document->bin;
    // All of these are below 2^32 (gltf_source.cpp), so 64-bit sums and products cannot wrap.
    if (bufferView.byteOffset + bufferView.byteLength > bin.size()) {
        return bad("bufferView " + std::to_string(view) +
                   " reaches beyond the end of the buffer (" + std::to_string(bin.size()) +
                   " bytes): the file may be truncated");
    }
    const uint64_t stride = strided && bufferView.byteStride != 0 ? bufferView.byteStride : size;
    if (stride < size) return bad("byteStride is smaller than one element");
    if (count > 0 && byteOffset + stride * (count - 1) + size > bufferView.byteLength) {
        return bad(std::to_string(count) + " elements do not fit in bufferView " +
                   std::to_string(view));
    }
    return Elements{bin.data() + bufferView.byteOffset + byteOffset, count, stride};
}

Result<const tinygltf::Accessor*> accessorAt(const GltfSource& source, int index,
                                             const std::string& user) {
    if (index < 0 || static_cast<size_t>(index) >= source.model.accessors.size()) {
        return fail(ErrorCode::invalidData,
                    "refers to accessor " + std::to_string(index) + ", which does not exist",
                    source.where(user));
    }
    return &source.model.accessors[static_cast<size_t>(index)];
}

template <class T, class Out>
Out convert(const uint8_t* bytes, bool normalized) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    if constexpr (std::is_same_v<Out, float> && std::is_integral_v<T>) {
        if (!normalized) return static_cast<float>(value);
        const double scaled =
            static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max());
        return static_cast<float>(std::max(scaled, -1.0));
    } else {
        return static_cast<Out>(value);
    }
}

template <class T, class Out>
void convertAll(const Elements& from, uint32_t components, bool normalized, Out* to) {
    if (std::is_same_v<T, Out> && from.stride == sizeof(T) * components) {
        std::memcpy(to, from.data, from.count * from.stride);
        return;
    }
    for (uint64_t i = 0; i < from.count; ++i) {
        const uint8_t* element = from.data + i * from.stride;
        for (uint32_t k = 0; k < components; ++k) {
            *to++ = convert<T, Out>(element + k * sizeof(T), normalized);
        }
    }
}

template <class Out>
void convertElements(const Elements& from, int type, uint32_t components, bool normalized,
                     Out* to) {
    if (from.count == 0) return;
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return convertAll<int8_t>(from, components, normalized, to);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return convertAll<uint8_t>(from, components, normalized, to);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return convertAll<int16_t>(from, components, normalized, to);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return convertAll<uint16_t>(from, components, normalized, to);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return convertAll<uint32_t>(from, components, normalized, to);
        default:
            return convertAll<float>(from, components, normalized, to);
    }
}

bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Overwrites the elements a sparse accessor names.
template <class Out>
Result<void> applySparse(const GltfSource& source, const tinygltf::Accessor& accessor,
                         uint32_t components, const std::string& pointer,
                         std::vector<Out>& values) {
    const auto& sparse = accessor.sparse;
    const auto bad = [&](const std::string& message) {
        return fail(ErrorCode::invalidData, message, source.where(pointer + "/sparse"));
    };
    if (sparse.count < 0 || static_cast<uint64_t>(sparse.count) > accessor.count) {
        return bad("more sparse elements than the accessor has");
    }
    if (!isIndexType(sparse.indices.componentType) || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0) {
        return bad("sparse indices must be unsigned integers at a non-negative offset");
    }
    const auto count = static_cast<uint64_t>(sparse.count);
    const uint32_t size = componentSize(accessor.componentType) * components;
    auto where =
        locate(source, sparse.indices.bufferView, static_cast<uint64_t>(sparse.indices.byteOffset),
               count, componentSize(sparse.indices.componentType), false, pointer + "/sparse");
    if (!where) return tl::unexpected(where.error());
    auto what =
        locate(source, sparse.values.bufferView, static_cast<uint64_t>(sparse.values.byteOffset),
               count, size, false, pointer + "/sparse");
    if (!what) return tl::unexpected(what.error());

    std::vector<uint32_t> indices(count);
    convertElements(*where, sparse.indices.componentType, 1, false, indices.data());
    std::vector<Out> replacements(count * components);
    convertElements(*what, accessor.componentType, components, accessor.normalized,
                    replacements.data());
    for (uint64_t i = 0; i < count; ++i) {
        if (indices[i] >= accessor.count) return bad("a sparse index is out of range");
        std::copy_n(
            replacements.begin() + static_cast<std::ptrdiff_t>(i * components), components,
            values.begin() + static_cast<std::ptrdiff_t>(uint64_t{indices[i]} * components));
    }
    return {};
}

template <class Out>
Result<std::vector<Out>> readValues(const GltfSource& source, const tinygltf::Accessor& accessor,
                                    uint32_t components, const std::string& pointer) {
    const uint32_t size = componentSize(accessor.componentType) * components;
    Elements elements;
    if (accessor.bufferView >= 0) {
        auto located = locate(source, accessor.bufferView, accessor.byteOffset, accessor.count,
                              size, true, pointer);
        if (!located) return tl::unexpected(located.error());
        elements = *located;
    }
    std::vector<Out> values(accessor.count * components, Out{});
    convertElements(elements, accessor.componentType, components, accessor.normalized,
                    values.data());
    if (accessor.sparse.isSparse) {
        auto ok = applySparse(source, accessor, components, pointer, values);
        if (!ok) return tl::unexpected(ok.error());
    }
    return values;
}

}  // namespace

Result<uint64_t> accessorCount(const GltfSource& source, int accessor, const std::string& user) {
    auto found = accessorAt(source, accessor, user);
    if (!found) return tl::unexpected(found.error());
    // Accessors without a bufferView need no bytes in the file: a small file must not ask for much.
    const uint64_t limit =
        (*found)->bufferView < 0 ? kMaxImportElements / 4 : 3 * kMaxImportElements;
    if ((*found)->count > limit) {
        return fail(ErrorCode::limitExceeded,
                    std::to_string((*found)->count) + " elements are more than Sherd reads (" +
                        std::to_string(limit) + "); split the model",
                    source.where("/accessors/" + std::to_string(accessor)));
    }
    return (*found)->count;
}

Result<FloatAccessor> readFloats(const GltfSource& source, int accessor, const std::string& user) {
    auto count = accessorCount(source, accessor, user);
    if (!count) return tl::unexpected(count.error());
    const tinygltf::Accessor& found = source.model.accessors[static_cast<size_t>(accessor)];
    const std::string pointer = "/accessors/" + std::to_string(accessor);
    const uint32_t components = componentCount(found.type);
    if (components == 0 || componentSize(found.componentType) == 0) {
        return fail(ErrorCode::invalidData,
                    "a vertex attribute must be a scalar or vector of a component type glTF knows",
                    source.where(pointer));
    }
    auto values = readValues<float>(source, found, components, pointer);
    if (!values) return tl::unexpected(values.error());
    return FloatAccessor{components, *count, std::move(*values)};
}

Result<std::vector<uint32_t>> readIndices(const GltfSource& source, int accessor,
                                          const std::string& user) {
    auto count = accessorCount(source, accessor, user);
    if (!count) return tl::unexpected(count.error());
    const tinygltf::Accessor& found = source.model.accessors[static_cast<size_t>(accessor)];
    const std::string pointer = "/accessors/" + std::to_string(accessor);
    if (found.type != TINYGLTF_TYPE_SCALAR || !isIndexType(found.componentType)) {
        return fail(ErrorCode::invalidData, "indices must be unsigned integer scalars",
                    source.where(pointer));
    }
    return readValues<uint32_t>(source, found, 1, pointer);
}

}  // namespace sherd
