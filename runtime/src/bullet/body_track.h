// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btTransform.h>

#include <algorithm>
#include <cstdint>

namespace sherd {

/// Where a body was after the last two substeps, until somebody wants to know: poses are made of
/// that only when they are asked for, which may be once in many substeps.
class BodyTrack {
  public:
    /// Who cares knows that it is there.
    void startAt(const btTransform& place) {
        places_[latest_] = place;
        isStill_ = false;
        forget();
    }
    /// There is nothing to tell.
    void forget() {
        moves_ = 0;
        isUntold_ = false;
    }

    /// A substep is over. Returns whether there was nothing to tell before, and now is.
    bool note(const btTransform& now) {
        const bool wasStill = isStill_, wasUntold = isUntold_;
        isStill_ = now == places_[latest_];
        if (isStill_ && wasStill) return false;
        latest_ ^= 1;
        places_[latest_] = now;
        if (!isStill_) moves_ = uint8_t(std::min(moves_ + 1, 2));
        isUntold_ = true;
        return !wasUntold;
    }
    /// It was where it had been, in the last substep noted.
    [[nodiscard]] bool isStill() const { return isStill_; }

    /// Tells the last moves, two at most, by `move(place)`, and then whether it stayed there for a
    /// substep, by `stay()`.
    template <class Move, class Stay>
    void tell(const Move& move, const Stay& stay) {
        if (!isUntold_) return;
        if (moves_ > 1) move(places_[latest_ ^ 1]);
        if (moves_ > 0) move(places_[latest_]);
        if (isStill_) stay();
        forget();
    }

  private:
    bool isStill_ = false;  ///< the last two are the same
    bool isUntold_ = false;
    uint8_t moves_ = 0;  ///< that nobody was told of; 2 stands for more
    uint8_t latest_ = 0;
    btTransform places_[2];
};

}  // namespace sherd
