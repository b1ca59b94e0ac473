// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace sherd {

using Histogram = std::array<uint64_t, 256>;

/// The darkness above which a texel is ink (never a whole number, so that no texel is on it).
/// Nothing if the picture is of one shade.
std::optional<double> inkThreshold(const Histogram& darkness);

}  // namespace sherd
