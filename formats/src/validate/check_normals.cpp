// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/geometric.hpp>

#include "check_context.h"

namespace sherd {

namespace {

/// Of the first vertex whose normal is not a unit vector; -1: there is none.
int64_t countWrong(const std::vector<float>& normals, size_t& count) {
    int64_t first = -1;
    for (size_t v = 0; 3 * v + 2 < normals.size(); ++v) {
        const double length =
            glm::length(glm::dvec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]));
        if (std::abs(length - 1) <= 1e-3) continue;
        if (count++ == 0) first = static_cast<int64_t>(v);
    }
    return first;
}

}  // namespace

void checkNormals(CheckContext& context) {
    for (const Attribute& attribute : context.set.geometry.attributes) {
        if (attribute.semantic != "NORMAL" || attribute.components != 3) continue;
        size_t count = 0;
        const int64_t first = countWrong(attribute.values, count);
        if (count > 0)
            context.find(Severity::failure, "normal_not_unit", -1,
                         std::to_string(count) + " normals are not of length 1, the first that of" +
                             " vertex " + std::to_string(first),
                         "/geometry/attributes/NORMAL");
    }
}

}  // namespace sherd
