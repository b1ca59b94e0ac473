// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace sherd {

/// Labels numbered anew from 0 in the order of their first appearance; `count`: how many differ.
template <class Label>
std::vector<uint32_t> compactLabels(const std::vector<Label>& labels, uint32_t& count) {
    std::map<Label, uint32_t> number;
    std::vector<uint32_t> result;
    result.reserve(labels.size());
    for (const Label& label : labels) {
        result.push_back(
            number.try_emplace(label, static_cast<uint32_t>(number.size())).first->second);
    }
    count = static_cast<uint32_t>(number.size());
    return result;
}

}  // namespace sherd
