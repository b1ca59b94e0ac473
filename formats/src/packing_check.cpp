// SPDX-License-Identifier: MIT
// Places that become one on the grid keep every edge in balance, so closed fragments stay closed; a
// fragment smaller than the grid's step does not stay a fragment.
#include "packing_check.h"

#include "validate/mesh_measures.h"

namespace sherd {

Result<void> checkPacked(const FractureSet& before, const FractureSet& after) {
    MeshMeasurer given(before), packed(after);
    for (uint32_t f = 0; f < before.fragments.size(); ++f) {
        const MeshMeasures was = given.measure(f), is = packed.measure(f);
        if (is.edges.count > was.edges.count || (was.volume > 0 && !(is.volume > 0)))
            return fail(ErrorCode::notClosed,
                        "fragment " + std::to_string(f) +
                            " is too small for the grid; use more bits for positions",
                        before.name);
    }
    return {};
}

}  // namespace sherd
