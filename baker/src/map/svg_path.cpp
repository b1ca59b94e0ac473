// SPDX-License-Identifier: MIT
#include "map/svg_path.h"

#include <array>
#include <optional>

#include "map/svg_scanner.h"

namespace sherd {

namespace {

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// How many arguments a command takes, -1 if it is none.
int arity(char command) {
    switch (upper(command)) {
        case 'Z':
            return 0;
        case 'H':
        case 'V':
            return 1;
        case 'M':
        case 'L':
        case 'T':
            return 2;
        case 'S':
        case 'Q':
            return 4;
        case 'C':
            return 6;
        case 'A':
            return 7;
        default:
            return -1;
    }
}

class PathParser {
  public:
    explicit PathParser(std::string_view d) : scanner_(d) {}

    SvgPath parse() {
        scanner_.skipSpace();
        if (scanner_.rest() != "none")
            while (!scanner_.atEnd() && result_.problem.empty()) {
                parseCommand();
                scanner_.skipSpace();
            }
        finishOutline();
        return std::move(result_);
    }

  private:
    void stop(const std::string& why) {
        result_.problem = why + " at character " + std::to_string(scanner_.position() + 1);
    }

    void parseCommand() {
        char command = scanner_.peek();
        if (arity(command) < 0) return stop("a path command was expected");
        if (!started_ && upper(command) != 'M') return stop("a path must begin with M");
        scanner_.advance();
        if (upper(command) == 'Z') return close();
        do {
            if (!readArguments(command)) return;
            apply(command);
            // Further pairs after a move are lines.
            if (command == 'M') command = 'L';
            if (command == 'm') command = 'l';
            scanner_.skipCommaSpace();
        } while (scanner_.startsNumber());
    }

    bool readArguments(char command) {
        for (int i = 0; i < arity(command); ++i) {
            if (i == 0)
                scanner_.skipSpace();
            else
                scanner_.skipCommaSpace();
            const bool isFlag = upper(command) == 'A' && (i == 3 || i == 4);
            const std::optional<double> value = isFlag ? scanner_.flag() : scanner_.number();
            if (!value) {
                stop(isFlag ? "a flag (0 or 1) was expected" : "a number was expected");
                return false;
            }
            arguments_[static_cast<size_t>(i)] = *value;
        }
        return true;
    }

    /// The point in arguments i, i + 1.
    glm::dvec2 pointAt(size_t i, bool relative) const {
        const glm::dvec2 p(arguments_[i], arguments_[i + 1]);
        return relative ? current_ + p : p;
    }

    void apply(char command) {
        const bool relative = command != upper(command);
        switch (upper(command)) {
            case 'M':
                return moveTo(pointAt(0, relative));
            case 'L':
                return add(linePiece(pointAt(0, relative)));
            case 'H':
                return add(linePiece({arguments_[0] + (relative ? current_.x : 0), current_.y}));
            case 'V':
                return add(linePiece({current_.x, arguments_[0] + (relative ? current_.y : 0)}));
            case 'C':
                return addCubic(pointAt(0, relative), pointAt(2, relative), pointAt(4, relative));
            case 'S':
                return addCubic(reflected(cubicControl_), pointAt(0, relative),
                                pointAt(2, relative));
            case 'Q':
                return addQuadratic(pointAt(0, relative), pointAt(2, relative));
            case 'T':
                return addQuadratic(reflected(quadraticControl_), pointAt(0, relative));
            default:
                break;
        }
        const ArcArguments arc{arguments_[0], arguments_[1], arguments_[2], arguments_[3] != 0,
                               arguments_[4] != 0};
        add(arcPiece(current_, arc, pointAt(5, relative)));
    }

    /// The last curve's control point mirrored in its end; without such a curve, the end itself.
    glm::dvec2 reflected(const std::optional<glm::dvec2>& control) const {
        return control ? 2.0 * current_ - *control : current_;
    }

    void moveTo(glm::dvec2 point) {
        finishOutline();
        started_ = true;
        current_ = outline_.start = point;
        cubicControl_.reset();
        quadraticControl_.reset();
    }

    void add(const CurvePiece& piece) {
        if (outline_.closed) moveTo(current_);
        outline_.pieces.push_back(piece);
        current_ = piece.to;
        cubicControl_.reset();
        quadraticControl_.reset();
    }

    void addCubic(glm::dvec2 control1, glm::dvec2 control2, glm::dvec2 to) {
        add(cubicPiece(control1, control2, to));
        cubicControl_ = control2;
    }

    void addQuadratic(glm::dvec2 control, glm::dvec2 to) {
        add(quadraticPiece(current_, control, to));
        quadraticControl_ = control;
    }

    void close() {
        const glm::dvec2 start = outline_.start;
        if (current_ != start) add(linePiece(start));
        outline_.closed = true;
        current_ = start;
        cubicControl_.reset();
        quadraticControl_.reset();
    }

    void finishOutline() {
        if (!outline_.pieces.empty()) result_.outlines.push_back(std::move(outline_));
        outline_ = {};
    }

    SvgScanner scanner_;
    SvgPath result_;
    Outline outline_;
    bool started_ = false;
    glm::dvec2 current_{0.0};
    std::optional<glm::dvec2> cubicControl_, quadraticControl_;
    std::array<double, 7> arguments_{};
};

}  // namespace

SvgPath parseSvgPath(std::string_view d) {
    return PathParser(d).parse();
}

SvgPath parseSvgPoints(std::string_view points, bool closed) {
    SvgPath path;
    SvgScanner scanner(points);
    std::vector<glm::dvec2> read;
    for (scanner.skipSpace(); !scanner.atEnd(); scanner.skipCommaSpace()) {
        const std::optional<double> x = scanner.number();
        scanner.skipCommaSpace();
        const std::optional<double> y = x ? scanner.number() : std::nullopt;
        if (!y) {
            path.problem =
                "a number was expected at character " + std::to_string(scanner.position() + 1);
            break;
        }
        read.emplace_back(*x, *y);
    }
    if (read.size() < 2) return path;
    Outline outline{read.front(), {}, closed};
    for (size_t i = 1; i < read.size(); ++i) outline.pieces.push_back(linePiece(read[i]));
    if (closed && read.back() != read.front()) outline.pieces.push_back(linePiece(read.front()));
    path.outlines.push_back(std::move(outline));
    return path;
}

}  // namespace sherd
