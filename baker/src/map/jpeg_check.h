// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace sherd {

/// stb_image fills the rest of a cut-off JPEG with grey, which would be read as ink or as none.
bool jpegIsWhole(std::span<const uint8_t> bytes);

/// No Huffman table has more than 256 codes: stb_image of 2022 writes past its own tables for
/// those.
bool jpegTablesFit(std::span<const uint8_t> bytes);

}  // namespace sherd
