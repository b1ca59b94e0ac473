// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

/// Factors a symmetric positive definite n x n matrix, row by row, in its lower triangle. Reads
/// nothing of the upper one.
void factorCholesky(double* m, uint32_t n);
/// Solves with the factor, in place.
void solveCholesky(const double* factor, uint32_t n, double* x);

}  // namespace sherd
