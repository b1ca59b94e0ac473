// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/gltf_source.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Accessor values as floats; normalised integers are scaled to [0,1] or [-1,1].
struct FloatAccessor {
    uint32_t components = 0;
    uint64_t count = 0;
    std::vector<float> values;
};

/// Number of elements, without reading any. `user` is the JSON pointer of what refers to it.
Result<uint64_t> accessorCount(const GltfSource& source, int accessor, const std::string& user);

/// Every byte range is checked; sparse accessors, strides and all component types are handled.
Result<FloatAccessor> readFloats(const GltfSource& source, int accessor, const std::string& user);

/// Unsigned scalars.
Result<std::vector<uint32_t>> readIndices(const GltfSource& source, int accessor,
                                          const std::string& user);

}  // namespace sherd
