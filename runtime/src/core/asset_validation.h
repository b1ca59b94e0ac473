// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Everything the runtime relies on without looking again: the rules of all fracture sets
/// (`fracture_rules.h`), and what makes a body of every fragment, a collider and inertia.
/// `Error::where` is a pointer into the set as the file lays it out.
Result<void> validateForRuntime(const FractureSet& set);

}  // namespace sherd
