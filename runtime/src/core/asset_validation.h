// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Everything the runtime relies on without looking again: references inside their tables, ranges
/// without overflow, a proper tree, finite numbers, positive masses, a collider for every fragment.
/// `Error::where` is a pointer into the set, such as `/fragments/3/mass`.
Result<void> validateForRuntime(const FractureSet& set);

}  // namespace sherd
