// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sherd {

/// Walks the words and numbers of a line-based text. A backslash at the end of a line continues it;
/// # starts a comment; lines end in LF, CRLF or CR.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

    size_t line() const { return line_; }
    bool atEnd() const { return at_ == end_; }

    bool atLineEnd() {
        skipBlanks();
        return at_ == end_ || *at_ == '\n' || *at_ == '\r' || *at_ == '#';
    }

    void nextLine() {
        while (at_ != end_ && *at_ != '\n' && *at_ != '\r') {
            if (!skipContinuation()) ++at_;
        }
        skipNewline();
    }

    /// The next word; empty at the end of the line.
    std::string_view word() {
        if (atLineEnd()) return {};
        const char* first = at_;
        while (at_ != end_ && !isBlank(*at_) && *at_ != '\n' && *at_ != '\r') ++at_;
        return {first, static_cast<size_t>(at_ - first)};
    }

    /// The rest of the line without surrounding blanks: names may hold blanks.
    std::string rest() {
        skipBlanks();
        const char* first = at_;
        while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
        const char* last = at_;
        while (last != first && isBlank(last[-1])) --last;
        return {first, last};
    }

    /// A finite number, correctly rounded; false (and nothing read) if there is none.
    bool number(float& value) {
        if (atLineEnd()) return false;
        const char* first = at_;
        if (*first == '+') ++first;
        auto [stop, error] = std::from_chars(first, end_, value);
        if (error == std::errc::result_out_of_range) {
            // Too small is zero; too large is refused below.
            double wide = 0;
            const auto again = std::from_chars(first, end_, wide);
            value = again.ec == std::errc() ? static_cast<float>(wide) : 0.0F;
            const bool large = again.ec != std::errc() && !isTiny(first, stop);
            error = large ? std::errc::result_out_of_range : std::errc();
        }
        if (error != std::errc() || !std::isfinite(value) || !isWordEnd(stop)) return false;
        at_ = stop;
        return true;
    }

  private:
    static bool isBlank(char c) { return c == ' ' || c == '\t'; }

    bool isWordEnd(const char* p) const {
        return p == end_ || isBlank(*p) || *p == '\n' || *p == '\r' || *p == '#' || *p == '\\';
    }

    /// Out of a double's range: towards zero if the exponent is negative.
    static bool isTiny(const char* first, const char* last) {
        const std::string_view text(first, static_cast<size_t>(last - first));
        return text.find("e-") != text.npos || text.find("E-") != text.npos;
    }

    void skipNewline() {
        if (at_ == end_) return;
        const bool isCr = *at_ == '\r';
        ++at_;
        if (isCr && at_ != end_ && *at_ == '\n') ++at_;
        ++line_;
    }

    bool skipContinuation() {
        if (*at_ != '\\' || at_ + 1 == end_ || (at_[1] != '\n' && at_[1] != '\r')) return false;
        ++at_;
        skipNewline();
        return true;
    }

    void skipBlanks() {
        while (at_ != end_ && (isBlank(*at_) || skipContinuation())) {
            if (at_ != end_ && isBlank(*at_)) ++at_;
        }
    }

    const char* at_;
    const char* end_;
    size_t line_ = 1;
};

}  // namespace sherd
