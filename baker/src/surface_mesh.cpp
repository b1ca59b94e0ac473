// SPDX-License-Identifier: MIT
#include "sherd/baker/surface_mesh.h"

namespace sherd {

const Attribute* findAttribute(const std::vector<Attribute>& attributes,
                               const std::string& semantic) {
    for (const Attribute& attribute : attributes) {
        if (attribute.semantic == semantic) return &attribute;
    }
    return nullptr;
}

}  // namespace sherd
