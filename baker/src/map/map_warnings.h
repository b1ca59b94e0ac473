// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

namespace sherd {

/// What was ignored and why: each sentence once, and no more of them than anybody reads, so that a
/// drawing that repeats one mistake a million times costs no memory for it.
class MapWarnings {
  public:
    void add(std::string warning) {
        if (known_.size() >= kMost)
            ++further_;
        else if (known_.insert(warning).second)
            warnings_.push_back(std::move(warning));
    }
    const std::vector<std::string>& all() const { return warnings_; }
    std::vector<std::string> take() {
        if (further_ > 0) warnings_.push_back(std::to_string(further_) + " further warnings");
        return std::move(warnings_);
    }

  private:
    static constexpr size_t kMost = 200;
    std::vector<std::string> warnings_;
    std::unordered_set<std::string> known_;
    size_t further_ = 0;
};

}  // namespace sherd
