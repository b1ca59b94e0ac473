// SPDX-License-Identifier: MIT
// The stages of `check`, in the order in which validate.cpp runs them.
#pragma once

#include <string>
#include <vector>

#include "mesh_measures.h"
#include "sherd/formats/validate.h"

namespace sherd {

struct CheckContext {
    const FractureSet& set;
    const CheckOptions& options;
    int32_t object;
    CheckReport& report;
    ObjectReport& out;
    std::vector<uint32_t> welded;          ///< vertex -> lowest vertex of equal position
    std::vector<MeshMeasures> measures{};  ///< per fragment

    std::string pointer(const char* below) const;
    void find(Severity severity, const char* code, int32_t fragment, std::string message,
              const char* below) const;
};

/// A number for a message.
std::string shortNumber(double value);

void checkClosed(CheckContext& context);
void checkLevelsAddUp(CheckContext& context);
void checkMass(CheckContext& context);
void checkCentersAndInertia(CheckContext& context);
void checkHulls(CheckContext& context);
void checkBonds(CheckContext& context);
void checkNormals(CheckContext& context);
void checkHiddenInside(CheckContext& context);
void measureHiddenArea(CheckContext& context);
void measureCoverage(CheckContext& context);
void measureShapes(CheckContext& context);

}  // namespace sherd
