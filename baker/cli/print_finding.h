// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

#include "sherd/baker/report.h"

namespace sherd::cli {

inline void printFinding(const BakeFinding& finding) {
    std::printf("  note %s: %s%s%s%s\n", finding.code.c_str(), finding.message.c_str(),
                finding.count > 1 ? (" (" + std::to_string(finding.count) + ")").c_str() : "",
                finding.where.empty() ? "" : ": ", finding.where.c_str());
}

}  // namespace sherd::cli
