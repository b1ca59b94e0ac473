// SPDX-License-Identifier: MIT
#include "map/svg_scanner.h"

#include <charconv>
#include <system_error>

namespace sherd {

namespace {

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

}  // namespace

void SvgScanner::skipSpace() {
    while (!atEnd() && isSpace(text_[at_])) ++at_;
}

void SvgScanner::skipCommaSpace() {
    skipSpace();
    if (take(',')) skipSpace();
}

bool SvgScanner::startsNumber() const {
    const char c = peek();
    return isDigit(c) || c == '.' || c == '-' || c == '+';
}

bool SvgScanner::take(char c) {
    if (peek() != c || atEnd()) return false;
    ++at_;
    return true;
}

size_t SvgScanner::digitsFrom(size_t i) const {
    while (i < text_.size() && isDigit(text_[i])) ++i;
    return i;
}

std::optional<double> SvgScanner::number() {
    size_t begin = at_;
    size_t i = at_;
    if (i < text_.size() && (text_[i] == '+' || text_[i] == '-')) ++i;
    if (i > begin && text_[begin] == '+') begin = i;  // from_chars takes no plus sign
    const size_t whole = i;
    i = digitsFrom(i);
    size_t digits = i - whole;
    if (i < text_.size() && text_[i] == '.') {
        const size_t fraction = i + 1;
        i = digitsFrom(fraction);
        digits += i - fraction;
    }
    if (digits == 0) return std::nullopt;
    bool tiny = false;
    if (i < text_.size() && (text_[i] == 'e' || text_[i] == 'E')) {
        size_t exponent = i + 1;
        const bool negative = exponent < text_.size() && text_[exponent] == '-';
        if (exponent < text_.size() && (negative || text_[exponent] == '+')) ++exponent;
        const size_t end = digitsFrom(exponent);
        if (end > exponent) {  // else the e belongs to a unit: "2em"
            i = end;
            tiny = negative;
        }
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + i, value);
    if (error == std::errc::result_out_of_range && tiny)
        value = 0;
    else if (error != std::errc())
        return std::nullopt;
    at_ = i;
    return value;
}

std::optional<double> SvgScanner::flag() {
    if (take('0')) return 0.0;
    if (take('1')) return 1.0;
    return std::nullopt;
}

std::string_view SvgScanner::word() {
    const size_t begin = at_;
    while (!atEnd() && isLetter(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
}

}  // namespace sherd
