// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// What must hold before anything may index with the numbers of a set or reckon with them, whoever
/// made it: tables of the right sizes, references in range, a sane hierarchy, finite numbers,
/// usable physical quantities. Nothing when it does, else `invalidData`; `where` begins its JSON
/// pointer, in the layout of the file.
std::optional<Error> brokenFractureRule(const FractureSet& set, const std::string& where);

/// Gives each fragment the level that `FractureSet::levels` puts it in; those that name no fragment
/// are left to the rules.
void numberLevels(FractureSet& set);

}  // namespace sherd
