// SPDX-License-Identifier: MIT
#include "core/asset_validation.h"

#include <string>

#include "sherd/formats/fracture_rules.h"

namespace sherd {
namespace {

Result<void> checkBody(const Fragment& fragment, size_t f) {
    const auto refuse = [f](const char* what, const char* where) {
        return fail(ErrorCode::invalidData,
                    "fragment " + std::to_string(f) + ": " + what + "; bake the object again",
                    std::string("/fragments/attributes/") + where);
    };
    const glm::vec3& inertia = fragment.inertiaDiagonal;
    if (!(inertia.x > 0 && inertia.y > 0 && inertia.z > 0))
        return refuse("the moments of inertia must be above 0", "INERTIA_DIAGONAL");
    if (fragment.hulls.count == 0) return refuse("it has no collider", "HULLS");
    return {};
}

}  // namespace

Result<void> validateForRuntime(const FractureSet& set) {
    if (auto error = brokenFractureRule(set, "")) return tl::unexpected<Error>(std::move(*error));
    for (size_t f = 0; f < set.fragments.size(); ++f)
        if (auto ok = checkBody(set.fragments[f], f); !ok) return ok;
    return {};
}

}  // namespace sherd
