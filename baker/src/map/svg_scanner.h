// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace sherd {

/// Reads numbers as SVG writes them: "1.5.5" is 1.5 and 0.5, "1-2" is 1 and -2, "1e-3".
/// NaN, infinities and numbers too large for a double are no numbers.
class SvgScanner {
  public:
    explicit SvgScanner(std::string_view text) : text_(text) {}

    bool atEnd() const { return at_ >= text_.size(); }
    size_t position() const { return at_; }
    char peek() const { return atEnd() ? '\0' : text_[at_]; }
    void advance() { ++at_; }
    void skipSpace();
    void skipCommaSpace();
    bool startsNumber() const;
    bool take(char c);               ///< consumes `c` if it is next
    std::optional<double> number();  ///< leaves the position alone if there is none
    std::optional<double> flag();    ///< one character, 0 or 1
    std::string_view word();         ///< letters; may be empty
    std::string_view rest() const { return text_.substr(at_); }

  private:
    size_t digitsFrom(size_t i) const;

    std::string_view text_;
    size_t at_ = 0;
};

}  // namespace sherd
