// SPDX-License-Identifier: MIT
#include "sherd/runtime/memory.h"

namespace sherd {
namespace {

thread_local std::pmr::memory_resource* current = nullptr;

}  // namespace

std::pmr::memory_resource& currentMemory() {
    return current ? *current : *std::pmr::new_delete_resource();
}

MemoryScope::MemoryScope(std::pmr::memory_resource& memory) : before_(current) {
    current = &memory;
}

MemoryScope::~MemoryScope() {
    current = before_;
}

}  // namespace sherd
