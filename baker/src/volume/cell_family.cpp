// SPDX-License-Identifier: MIT
#include "volume/cell_family.h"

#include <cmath>
#include <utility>

namespace sherd {
namespace {

bool within(const LinearFunction& f) {
    const auto fits = [](int64_t value, int64_t limit) {
        return value <= limit && value >= -limit;
    };
    return fits(f.x, CellFunctions::kLargestSlope) && fits(f.y, CellFunctions::kLargestSlope) &&
           fits(f.z, CellFunctions::kLargestSlope) && fits(f.c, CellFunctions::kLargestOffset);
}

}  // namespace

double slopeOf(const LinearFunction& f) {
    return std::hypot(static_cast<double>(f.x), static_cast<double>(f.y), static_cast<double>(f.z));
}

Result<CellFunctions> CellFunctions::of(std::vector<CellFamily> families) {
    CellFunctions result;
    uint64_t count = 1;
    for (const CellFamily& family : families) {
        if (family.functions.empty()) return fail(ErrorCode::badArgument, "there is no cell");
        result.stride_.push_back(static_cast<uint32_t>(count));
        count *= family.functions.size();
        if (count > kMostCells) {
            return fail(ErrorCode::limitExceeded,
                        "more than " + std::to_string(kMostCells) + " cells");
        }
    }
    result.families_ = std::move(families);
    result.sums_.resize(count);
    for (uint32_t cell = 0; cell < count; ++cell) {
        for (size_t f = 0; f < result.families_.size(); ++f) {
            const LinearFunction& term = result.families_[f].functions[result.member(cell, f)];
            result.sums_[cell] = result.sums_[cell] + term;
            if (within(term) && within(result.sums_[cell])) continue;
            return fail(ErrorCode::limitExceeded, "a cell reaches too far from the mesh",
                        "cell " + std::to_string(cell));
        }
    }
    return result;
}

}  // namespace sherd
