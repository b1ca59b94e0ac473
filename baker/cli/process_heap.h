// SPDX-License-Identifier: MIT
#pragma once

namespace sherd::cli {

/// Tells the C library to keep memory that was freed for what is allocated next, instead of handing
/// it back to the system. A bake allocates and frees many large arrays one after the other, and
/// fresh pages cost it more than the memory it then holds until it ends. For programs of our own
/// only: a library has no say in its host's heap. Does nothing where the C library is not glibc.
void keepFreedMemory();

}  // namespace sherd::cli
