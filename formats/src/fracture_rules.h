// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// What must hold before anything may index with the numbers of a set: references in range,
/// hierarchy sane, physical quantities usable. Fills in each fragment's level.
/// `where` is the JSON pointer of the fracture.
std::optional<Error> applyFractureRules(FractureSet& set, const std::string& where);

}  // namespace sherd
