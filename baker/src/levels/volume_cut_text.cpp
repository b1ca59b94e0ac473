// SPDX-License-Identifier: MIT
// Volume cuts as they are written on a command line or in a recipe.
#include <functional>
#include <map>
#include <optional>

#include "levels/piece_choice_text.h"
#include "sherd/baker/volume_cut.h"
#include "text_fields.h"

namespace sherd {
namespace {

constexpr uint32_t kMostCells = 10'000;
constexpr uint32_t kMostSlabs = 1'000;

/// Reads one cut's text part by part; the first mistake ends it.
class CutReader {
  public:
    explicit CutReader(std::string_view text) : text_(text), parts_(split(text, ':')) {}

    Result<VolumeCut> read() {
        cut_.text = text_;
        joinPath();
        if (!readKind() || !readCounts()) return tl::unexpected(error_);
        size_t next = 2;
        if (cut_.kind != VolumeCut::Kind::map && next < parts_.size() &&
            parts_[next].find('=') == std::string_view::npos) {
            if (!readNumber(parts_[next], cut_.seed)) {
                stop(quoted(parts_[next]) + " is not a seed, a whole number from 0 to 4294967295");
                return tl::unexpected(error_);
            }
            ++next;
        }
        if (cut_.kind == VolumeCut::Kind::points && cut_.points.size() < 2) {
            stop("needs at least two points, X,Y,Z;X,Y,Z");
            return tl::unexpected(error_);
        }
        for (; next < parts_.size(); ++next)
            if (!readOption(parts_[next])) return tl::unexpected(error_);
        return cut_;
    }

  private:
    bool stop(const std::string& what) {
        error_ = {ErrorCode::badArgument, what, "cut " + quoted(text_)};
        return false;
    }

    /// A path may have colons: it goes on to the first of the keys that end the text.
    void joinPath() {
        if (parts_[0] != "map" || parts_.size() < 2) return;
        const auto isKey = [](std::string_view part) {
            const std::string_view key = part.substr(0, part.find('='));
            return key.size() < part.size() && !key.empty() &&
                   key.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
        };
        size_t keys = parts_.size();
        while (keys > 2 && isKey(parts_[keys - 1])) --keys;
        const char* end = parts_[keys - 1].data() + parts_[keys - 1].size();
        parts_[1] = {parts_[1].data(), static_cast<size_t>(end - parts_[1].data())};
        parts_.erase(parts_.begin() + 2, parts_.begin() + static_cast<std::ptrdiff_t>(keys));
    }

    bool readKind() {
        using Kind = VolumeCut::Kind;
        static const std::map<std::string_view, Kind> kinds = {
            {"voronoi", Kind::voronoi}, {"grid", Kind::grid},     {"slices", Kind::slices},
            {"wood", Kind::wood},       {"points", Kind::points}, {"bricks", Kind::bricks},
            {"glass", Kind::glass},     {"map", Kind::map}};
        const auto it = kinds.find(parts_[0]);
        if (it == kinds.end())
            return stop("there is no cut " + quoted(parts_[0]) +
                        "; known are voronoi:N, grid:N, slices:NxMxK, wood:N, points:X,Y,Z;..., "
                        "bricks:NxMxK, glass:NxM and map:FILE");
        cut_.kind = it->second;
        if (cut_.kind == Kind::slices || cut_.kind == Kind::bricks) cut_.jitter = 0;
        return true;
    }

    bool readCounts() {
        using Kind = VolumeCut::Kind;
        const std::string_view text = parts_.size() > 1 ? parts_[1] : std::string_view();
        switch (cut_.kind) {
            case Kind::voronoi:
            case Kind::grid:
            case Kind::wood:
                if (readNumber(text, cut_.count) && cut_.count >= 1 && cut_.count <= kMostCells)
                    return true;
                return stop(quoted(text) + " is not a number of cells from 1 to " +
                            std::to_string(kMostCells));
            case Kind::points:
                return take(readPlaces("", text, cut_.points));
            case Kind::slices:
                return readSlabs(text, 3, "NxMxK, slabs along x, y and z");
            case Kind::bricks:
                return readSlabs(text, 3, "NxMxK, bricks in a row, rows, and bricks deep");
            case Kind::glass:
                cut_.slabs[2] = 1;
                return readSlabs(text, 2, "NxM, sectors and rings");
            case Kind::map:
                cut_.map = text;
                return !text.empty() || stop("needs a drawing: map:FILE[:axis=z]");
        }
        return false;
    }

    bool readSlabs(std::string_view text, size_t count, const char* what) {
        const std::vector<std::string_view> sides = split(text, 'x');
        bool fine = sides.size() == count;
        uint64_t cells = 1;
        for (size_t k = 0; k < count && fine; ++k) {
            fine = readNumber(sides[k], cut_.slabs[k]) && cut_.slabs[k] >= 1 &&
                   cut_.slabs[k] <= kMostSlabs;
            cells *= cut_.slabs[k];
        }
        if (!fine)
            return stop(quoted(text) + " is not " + what + ", each from 1 to " +
                        std::to_string(kMostSlabs));
        if (cells <= kMostCells) return true;
        return stop(quoted(text) + " makes more than " + std::to_string(kMostCells) + " cells");
    }

    bool readOption(std::string_view part) {
        const size_t equals = part.find('=');
        const std::string_view key = part.substr(0, equals);
        const std::string_view value =
            equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
        using Kind = VolumeCut::Kind;
        const auto share = [&](double low, double high, double& target) {
            return [this, key, value, low, high, &target] {
                return take(readShare(key, value, low, high, target));
            };
        };
        std::map<std::string_view, std::function<bool()>> known;
        switch (cut_.kind) {
            case Kind::voronoi:
                known["around"] = [&] { return take(readPlaces("around=", value, cut_.around)); };
                known["spread"] = share(1e-6, 10, cut_.spread);
                known["stretch"] = [&] { return readStretch(value); };
                break;
            case Kind::grid:
                known["jitter"] = share(0, 1, cut_.jitter);
                known["stretch"] = [&] { return readStretch(value); };
                break;
            case Kind::slices:
                known["jitter"] = share(0, 1, cut_.jitter);
                known["tilt"] = share(0, 1, cut_.tilt);
                break;
            case Kind::wood:
                known["axis"] = [&] { return readAxis(value); };
                known["elongation"] = share(1, 64, cut_.elongation);
                break;
            case Kind::points:
                break;
            case Kind::bricks:
                known["axis"] = [&] { return readAxis(value); };
                known["jitter"] = share(0, 1, cut_.jitter);
                break;
            case Kind::glass:
                known["at"] = [&] { return readCentre(value); };
                known["axis"] = [&] { return readAxis(value); };
                known["jitter"] = share(0, 1, cut_.jitter);
                break;
            case Kind::map:
                known["axis"] = [&] { return readAlong(value); };
                break;
        }
        for (const std::string_view name : kChoiceKeys)
            known[name] = [this, key, value] { return take(readChoice(key, value, cut_.only)); };
        if (const auto it = known.find(key); it != known.end()) return it->second();
        std::string names;
        for (const auto& [name, read] : known) {
            if (!names.empty()) names += ", ";
            names += name;
        }
        return stop(quoted(key) + " is not known here; known are " + names);
    }

    /// wrong: what a reader found.
    bool take(const std::optional<std::string>& wrong) { return !wrong || stop(*wrong); }
    bool readCentre(std::string_view value) {
        glm::dvec3 point;
        if (!readVector(value, point)) return stop("at=" + std::string(value) + " is not X,Y,Z");
        cut_.centre = point;
        return true;
    }
    bool readStretch(std::string_view value) {
        const bool fine = readVector(value, cut_.stretch) && inRange(cut_.stretch.x) &&
                          inRange(cut_.stretch.y) && inRange(cut_.stretch.z);
        return fine || stop("stretch=" + std::string(value) + " is not X,Y,Z, each from 1 to 64");
    }
    static bool inRange(double x) { return x >= 1 && x <= 64; }
    bool readAxis(std::string_view value) {
        if (value.size() != 1 || value[0] < 'x' || value[0] > 'z')
            return stop("axis=" + std::string(value) + " is not x, y or z");
        cut_.axis = static_cast<uint32_t>(value[0] - 'x');
        return true;
    }

    bool readAlong(std::string_view value) {
        const std::string_view axis = value.substr(value.starts_with('-') ? 1 : 0);
        if (axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
            return stop("axis=" + std::string(value) + " is not x, y, z, -x, -y or -z");
        cut_.along = glm::dvec3(0);  // of several the last counts, as with all keys
        cut_.along[axis[0] - 'x'] = axis.size() < value.size() ? -1 : 1;
        return true;
    }

    std::string_view text_;
    std::vector<std::string_view> parts_;
    VolumeCut cut_;
    Error error_;
};

}  // namespace

Result<VolumeCut> parseVolumeCut(std::string_view text) {
    return CutReader(text).read();
}

}  // namespace sherd
