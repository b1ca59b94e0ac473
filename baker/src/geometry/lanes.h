// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace sherd {

/// Four numbers, laid out to be taken at once; see four.h for what can be done with them.
struct alignas(16) Lanes {
    static constexpr size_t kWidth = 4;
    std::array<float, kWidth> at{};
};
using LanesOfPoints = std::array<Lanes, 3>;  ///< x of all, y of all, z of all

}  // namespace sherd
