// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sherd/baker/volume_cut.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A level whose pieces are groups of the pieces of the next finer level: of such that hold to each
/// other, near together and alike in volume. Groups stay within the pieces of the level before.
struct Cluster {
    uint32_t count = 8;  ///< groups in each piece of the level before, 1 to 10,000
    /// 0 to 1: what even volumes count for, against large bonds that stay within groups.
    double evenness = 0.5;
    PieceChoice only;   ///< of the level before; the others stay whole
    std::string text;   ///< as it was asked for, for reports
    std::string where;  ///< its pointer in a recipe, for messages; may be empty
};

/// N[:KEY=VALUE]...: "8", "12:evenness=0.8", "4:larger=0.1". Error badArgument says what is known
/// and allowed.
Result<Cluster> parseCluster(std::string_view text);

}  // namespace sherd
