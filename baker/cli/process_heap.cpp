// SPDX-License-Identifier: MIT
#include "process_heap.h"

#include <climits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace sherd::cli {

// Measured on a skull of 41k triangles: a fifth of the page faults and a tenth of the time of the
// whole command, half of the time of the medial surface by itself.
void keepFreedMemory() {
#ifdef __GLIBC__
    constexpr int kMegabyte = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);  // the most it takes
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    mallopt(M_TOP_PAD, 64 * kMegabyte);
#endif
}

}  // namespace sherd::cli
