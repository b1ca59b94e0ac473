// SPDX-License-Identifier: MIT
#include "import/surface_lines.h"

namespace sherd {

void reportDropped(const LineChains& chains, const std::string& label,
                   std::vector<std::string>& warnings) {
    if (chains.withoutLength > 0) {
        warnings.push_back(label + ": " + std::to_string(chains.withoutLength) +
                           " line segments without length were dropped");
    }
    if (chains.repeated > 0) {
        warnings.push_back(label + ": " + std::to_string(chains.repeated) +
                           " line segments that were there twice were dropped");
    }
}

}  // namespace sherd
