// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sherd {

/// Where a body was after the last two substeps, until somebody wants to know: poses are made of
/// that only when they are asked for, which may be once in many substeps.
class BodyTrack {
  public:
    /// Who cares knows that it is there.
    void startAt(const btTransform& place) {
        places_[latest_] = place;
        forget();
    }
    /// There is nothing to tell of what was noted.
    void forget() {
        moves_ = 0;
        isStill_ = false;
    }

    /// A substep is over. Returns whether `tell` must be called that need not have been before.
    bool note(const btTransform& now) {
        const bool wasStill = isStill_;
        isStill_ = now == places_[latest_];
        if (isStill_ && wasStill) return false;
        if (!isStill_) {
            latest_ ^= 1;
            places_[latest_] = now;
            moves_ = uint8_t(std::min(moves_ + 1, 2));
        }
        return !std::exchange(isWaiting_, true);
    }
    /// It was where it had been, in the last substep noted.
    [[nodiscard]] bool isStill() const { return isStill_; }

    /// Tells the last moves, two at most, by `move(place)`, and then whether it stayed there for a
    /// substep, by `stay()`.
    template <class Move, class Stay>
    void tell(const Move& move, const Stay& stay) {
        if (!std::exchange(isWaiting_, false)) return;
        if (moves_ > 1) move(places_[latest_ ^ 1]);
        if (moves_ > 0) move(places_[latest_]);
        if (isStill_) stay();
        moves_ = 0;
    }

  private:
    bool isStill_ = false;    ///< since the latest place was noted
    bool isWaiting_ = false;  ///< for `tell`
    uint8_t moves_ = 0;       ///< that nobody was told of; 2 stands for more
    uint8_t latest_ = 0;
    btTransform places_[2];  ///< the last two that differ
};

}  // namespace sherd
