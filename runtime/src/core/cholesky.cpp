// SPDX-License-Identifier: MIT
#include "core/cholesky.h"

#include <cmath>
#include <cstddef>

namespace sherd {

// A.-L. Cholesky's method as in G. H. Golub, C. F. Van Loan, "Matrix Computations" (2013), 4.2. The
// diagonal keeps reciprocals: divisions are dear. A pivot that rounding has eaten counts as the
// diagonal it came from, which only makes a preconditioner a worse one.
void factorCholesky(double* m, uint32_t n) {
    constexpr double kEaten = 1e-13;
    for (uint32_t row = 0; row < n; ++row) {
        double* const r = m + size_t(row) * n;
        const double diagonal = r[row];
        for (uint32_t column = 0; column <= row; ++column) {
            const double* const c = m + size_t(column) * n;
            double sum = r[column];
            for (uint32_t k = 0; k < column; ++k) sum -= r[k] * c[k];
            if (column < row) {
                r[column] = sum * c[column];
            } else {
                if (!(sum > kEaten * diagonal)) sum = diagonal;
                r[row] = sum > 0 ? 1 / std::sqrt(sum) : 0;
            }
        }
    }
}

void solveCholesky(const double* factor, uint32_t n, double* x) {
    for (uint32_t row = 0; row < n; ++row) {
        const double* const r = factor + size_t(row) * n;
        double sum = x[row];
        for (uint32_t k = 0; k < row; ++k) sum -= r[k] * x[k];
        x[row] = sum * r[row];
    }
    for (uint32_t row = n; row-- > 0;) {
        const double* const r = factor + size_t(row) * n;
        x[row] *= r[row];
        for (uint32_t k = 0; k < row; ++k) x[k] -= r[k] * x[row];
    }
}

}  // namespace sherd
