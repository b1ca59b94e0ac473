// SPDX-License-Identifier: MIT
// Z. Guo, R. W. Hall, "Parallel Thinning with Two-Subiteration Algorithms", Comm. ACM 32(3), 1989
// (algorithm A1). Preferred to Zhang and Suen (1984), which wipes out squares of two texels and
// wears down diagonal lines.
//
// Deviations: only texels whose surroundings changed in the last two subiterations are looked at,
// so that the time goes with the ink and not with picture times width; corner texels that the
// parallel rule leaves standing are taken away afterwards, one by one.
#include "map/bitmap_thinning.h"

#include <algorithm>
#include <array>

namespace sherd {

namespace {

constexpr uint8_t kQueued = 2;

struct Around {
    std::array<bool, 8> p{};
    explicit Around(int bits) {
        for (int k = 0; k < 8; ++k) p[k] = (bits >> k & 1) != 0;
    }
    bool operator[](int k) const { return p[k % 8]; }
    /// Components of ink around the texel, those that touch it diagonally only included.
    int components() const {
        int count = 0;
        for (int k = 0; k < 8; k += 2)
            count += !(*this)[k] && ((*this)[k + 1] || (*this)[k + 2]) ? 1 : 0;
        return count;
    }
    /// Neighbours counted by twos, starting at an even or odd one.
    int pairs(int start) const {
        int count = 0;
        for (int k = start; k < start + 8; k += 2) count += (*this)[k] || (*this)[k + 1] ? 1 : 0;
        return count;
    }
};

bool deletable(const Around& a, int pass) {
    const int neighbours = std::min(a.pairs(7), a.pairs(0));
    if (a.components() != 1 || neighbours < 2 || neighbours > 3) return false;
    return pass == 0 ? !((a[0] || a[1] || !a[3]) && a[2]) : !((a[4] || a[5] || !a[7]) && a[6]);
}

/// A texel at the bend of two neighbours that touch each other without it; not the middle of a T.
bool isCorner(const Around& a) {
    if (a.components() != 1) return false;
    for (int k = 0; k < 8; k += 2)
        if (a[k] && a[k + 2]) return !a[k + 4] && !a[k + 6];
    return false;
}

template <class Rule>
std::array<bool, 256> table(const Rule& rule) {
    std::array<bool, 256> result{};
    for (int bits = 0; bits < 256; ++bits) result[bits] = rule(Around(bits));
    return result;
}

class Thinner {
  public:
    explicit Thinner(Raster<uint8_t>& mask) : mask_(mask) {}

    void run() {
        static const std::array<bool, 256> kDelete[2] = {
            table([](const Around& a) { return deletable(a, 0); }),
            table([](const Around& a) { return deletable(a, 1); })};
        queueContour();
        for (int pass = 0; !fresh_.empty() || !older_.empty(); pass = 1 - pass)
            subiterate(kDelete[pass]);
        removeCorners();
    }

  private:
    bool isInk(size_t i) const { return (mask_.values[i] & kInk) != 0; }

    void queueContour() {
        for (int y = 0; y < mask_.height; ++y)
            for (int x = 0; x < mask_.width; ++x) {
                const size_t i = mask_.index(x, y);
                if (isInk(i) && neighbourhood(mask_, i) != 255) fresh_.push_back(i);
            }
    }

    /// A texel has to be looked at in either kind of subiteration after its surroundings changed:
    /// `fresh_` holds those changed by the last one, `older_` those by the one before.
    void subiterate(const std::array<bool, 256>& doomed) {
        gone_.clear();
        for (const auto* list : {&fresh_, &older_})
            for (const size_t i : *list)
                if (isInk(i) && doomed[neighbourhood(mask_, i)]) gone_.push_back(i);
        for (const size_t i : gone_) mask_.values[i] = 0;
        older_.swap(fresh_);
        fresh_.clear();
        for (const size_t i : gone_)
            for (int k = 0; k < 8; ++k) {
                const size_t n = i + mask_.step(k);
                if (mask_.values[n] != kInk) continue;
                mask_.values[n] |= kQueued;
                fresh_.push_back(n);
            }
        older_.erase(std::remove_if(older_.begin(), older_.end(),
                                    [&](size_t i) { return mask_.values[i] != kInk; }),
                     older_.end());
        for (const size_t i : fresh_) mask_.values[i] = kInk;
    }

    void removeCorners() {
        static const std::array<bool, 256> kCorner = table(isCorner);
        for (int y = 0; y < mask_.height; ++y)
            for (int x = 0; x < mask_.width; ++x) {
                const size_t i = mask_.index(x, y);
                if (isInk(i) && kCorner[neighbourhood(mask_, i)]) mask_.values[i] = 0;
            }
    }

    Raster<uint8_t>& mask_;
    std::vector<size_t> fresh_, older_, gone_;
};

}  // namespace

void thin(Raster<uint8_t>& mask) {
    Thinner(mask).run();
}

}  // namespace sherd
