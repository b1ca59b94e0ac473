// SPDX-License-Identifier: MIT
// SVG to fracture lines. Drawn shapes become lines; what is hidden, what is no line (text, images)
// and the layout's guide layer are passed over. The root viewBox spans UV [0, 1]^2.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "map/map_limits.h"
#include "map/svg_css.h"
#include "map/svg_names.h"
#include "map/svg_shapes.h"
#include "map/svg_viewport.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

namespace {

constexpr size_t kMaxDepth = 256;           ///< nested groups and uses
constexpr size_t kMaxElements = 2'000'000;  ///< visited; a `use` visits its target again

/// What a node inherits.
struct Context {
    SvgFrame frame;
    uint32_t level = 1;
    bool visible = true;
    size_t depth = 0;
};

class SvgReader {
  public:
    SvgReader(const pugi::xml_document& document, const std::string& name,
              const MapReadOptions& options)
        : root_(document.document_element()), name_(name), options_(options) {}

    Result<FractureMap> read() {
        if (localName(root_.name()) != "svg")
            return fail(
                ErrorCode::malformed,
                "not an SVG drawing: the outermost element is <" + std::string(root_.name()) + ">",
                name_);
        index();
        const Result<Context> context = rootContext();
        if (!context) return tl::unexpected(context.error());
        for (const pugi::xml_node& child : root_.children())
            if (!visit(child, *context)) return tl::unexpected(std::move(*error_));
        return finish();
    }

  private:
    /// Ids and style sheets, before anything is drawn.
    void index() {
        struct Walker : pugi::xml_tree_walker {
            explicit Walker(SvgReader& reader) : reader_(reader) {}
            bool for_each(pugi::xml_node& node) override {
                if (const pugi::xml_attribute id = node.attribute("id"))
                    reader_.ids_.emplace(id.value(), node);
                if (localName(node.name()) == "style")
                    for (const pugi::xml_node& text : node.children())
                        reader_.styles_.add(text.value());
                return true;
            }
            SvgReader& reader_;
        } walker(*this);
        root_.traverse(walker);
    }

    Result<Context> rootContext() const {
        const std::optional<SvgFrame> frame = rootSvgFrame(root_);
        if (!frame)
            return fail(ErrorCode::invalidData,
                        "the drawing says neither its viewBox nor its width and height; add "
                        "viewBox=\"0 0 1 1\" (or the size of the texture) to <svg>",
                        name_);
        Context context;
        context.frame = *frame;
        context.level = options_.level;
        return context;
    }

    bool stop(ErrorCode code, std::string message, const pugi::xml_node& node) {
        error_ = Error{code, std::move(message), sourceOf(node)};
        return false;
    }

    std::string sourceOf(const pugi::xml_node& node) const {
        std::string source = name_ + ": " + std::string(localName(node.name()));
        if (const pugi::xml_attribute id = node.attribute("id")) return source + " #" + id.value();
        return source + " at byte " + std::to_string(node.offset_debug());
    }

    /// Draws a node and what is inside; false when reading must stop.
    bool visit(const pugi::xml_node& node, const Context& parent) {
        if (node.type() != pugi::node_element) return true;
        const std::string_view name = localName(node.name());
        if (isSvgGuide(node)) {
            countStrays(node);
            return true;
        }
        if (isForeignSvgElement(node.name())) return true;
        if (++elements_ > kMaxElements)
            return stop(ErrorCode::limitExceeded,
                        "the drawing holds more than " + std::to_string(kMaxElements) +
                            " elements, counting each use of a repeated one",
                        node);
        if (parent.depth >= kMaxDepth)
            return stop(ErrorCode::limitExceeded,
                        "groups are nested deeper than " + std::to_string(kMaxDepth), node);
        if (isReportedSvgElement(name)) {
            if (name != "defs" || node.first_child()) ++ignored_[std::string(name)];
            return true;
        }
        const bool shape = isSvgShape(name);
        if (!shape && !isSvgGroup(name) && name != "svg" && name != "use") return true;
        Context context = parent;
        ++context.depth;
        if (!enter(node, context)) return true;
        if (shape) return draw(node, context);
        if (name == "use") return visitUse(node, context);
        if (name == "svg") enterSvgViewport(node, context.frame.viewport, true, context.frame);
        return visitChildren(node, context);
    }

    /// Shapes in the guide layer that the layout did not put there: drawn in the wrong layer.
    void countStrays(const pugi::xml_node& guide) {
        struct Walker : pugi::xml_tree_walker {
            bool for_each(pugi::xml_node& node) override {
                if (isSvgShape(localName(node.name())) && !isSvgGuide(node)) ++strays;
                return true;
            }
            size_t strays = 0;
        } walker;
        pugi::xml_node(guide).traverse(walker);
        strays_ += walker.strays;
    }

    bool visitChildren(const pugi::xml_node& node, const Context& context) {
        for (const pugi::xml_node& child : node.children())
            if (!visit(child, context)) return false;
        return true;
    }

    /// Takes in the node's visibility, level and transform; false if it draws nothing at all.
    bool enter(const pugi::xml_node& node, Context& context) {
        const std::string opacity = styles_.property(node, "opacity");
        if (styles_.property(node, "display") == "none" ||
            (!opacity.empty() && parseSvgLength(opacity, 1) == 0.0)) {
            ++hidden_;
            return false;
        }
        const std::string visibility = styles_.property(node, "visibility");
        if (visibility == "hidden" || visibility == "collapse") context.visible = false;
        if (visibility == "visible") context.visible = true;

        if (const std::optional<uint32_t> level = namedLevel(node)) context.level = *level;

        std::string transform = styles_.property(node, "transform");
        if (node.attribute("transform")) transform = node.attribute("transform").value();
        const std::optional<Affine> local = parseSvgTransform(transform);
        if (!local) {
            warnings_.push_back(sourceOf(node) + " is left out: its transform cannot be read");
            return false;
        }
        context.frame.transform = context.frame.transform * *local;
        return true;
    }

    bool visitUse(const pugi::xml_node& node, Context& context) {
        const std::string_view href = svgAttribute(node, "href");
        const auto target = href.empty() || href.front() != '#'
                                ? ids_.end()
                                : ids_.find(std::string(href.substr(1)));
        if (target == ids_.end()) {
            warnings_.push_back(sourceOf(node) + " is left out: it refers to nothing in this file");
            return true;
        }
        const pugi::xml_node used = target->second;
        if (std::find(inUse_.begin(), inUse_.end(), used) != inUse_.end()) {
            warnings_.push_back(sourceOf(node) + " is left out: it refers to itself");
            return true;
        }
        const double x = svgLength(node, "x", context.frame.viewport.width, 0);
        const double y = svgLength(node, "y", context.frame.viewport.height, 0);
        context.frame.transform = context.frame.transform * Affine{1, 0, 0, 1, x, y};
        inUse_.push_back(used);
        const bool whole = visitUsed(used, node, context);
        inUse_.pop_back();
        return whole;
    }

    bool visitUsed(const pugi::xml_node& used, const pugi::xml_node& use, Context& context) {
        if (localName(used.name()) != "symbol" || isSvgGuide(used)) return visit(used, context);
        if (!enter(used, context)) return true;
        const SvgViewport outer = context.frame.viewport;
        enterSvgViewport(used,
                         {svgLength(use, "width", outer.width, outer.width),
                          svgLength(use, "height", outer.height, outer.height)},
                         false, context.frame);
        return visitChildren(used, context);
    }

    bool draw(const pugi::xml_node& node, const Context& context) {
        if (!context.visible) {
            ++hidden_;
            return true;
        }
        const SvgPath path = svgShape(node, context.frame.viewport);
        if (!path.problem.empty())
            warnings_.push_back(sourceOf(node) + ": " + path.problem +
                                "; what comes before it is kept");
        for (const Outline& outline : path.outlines) {
            std::optional<std::vector<glm::dvec2>> points = flatten(
                outline, context.frame.transform, options_.tolerance, kMaxMapPoints - points_);
            if (!points)
                return stop(ErrorCode::limitExceeded,
                            "the drawing needs more than " + std::to_string(kMaxMapPoints) +
                                " points at this tolerance; look at the size of this curve, or "
                                "raise the tolerance",
                            node);
            points_ += points->size();
            for (const glm::dvec2 p : *points)
                if (!std::isfinite(p.x) || !std::isfinite(p.y))
                    return stop(ErrorCode::invalidData, "a coordinate is too large for a number",
                                node);
            if (outline.closed) points->back() = points->front();
            const bool extended = std::any_of(points->begin(), points->end(),
                                              [&](glm::dvec2 p) { return p != points->front(); });
            if (extended) map_.lines.push_back({std::move(*points), context.level, sourceOf(node)});
        }
        return true;
    }

    /// "2 hidden element(s), 1 text": what was not drawn, in a fixed order.
    std::string passedOver() const {
        std::string list;
        const auto add = [&list](size_t count, const std::string& what) {
            if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
        };
        add(strays_, "shape(s) drawn in the guide layer (move them to a level layer)");
        add(hidden_, "hidden element(s)");
        for (const auto& [name, count] : ignored_) add(count, name);
        return list;
    }

    Result<FractureMap> finish() {
        const std::string ignored = passedOver();
        if (map_.lines.empty())
            return fail(ErrorCode::emptyMap,
                        "the drawing holds no line to break along" +
                            (ignored.empty() ? "" : " (passed over: " + ignored + ")") +
                            "; draw paths, lines or shapes, visible and outside the guide layer" +
                            (warnings_.empty() ? "" : ". " + warnings_.front()),
                        name_);
        map_.warnings = std::move(warnings_);
        if (!ignored.empty()) map_.warnings.push_back(name_ + ": passed over " + ignored);
        return std::move(map_);
    }

    pugi::xml_node root_;
    std::string name_;
    MapReadOptions options_;
    std::map<std::string, pugi::xml_node> ids_;
    SvgStyleSheet styles_;
    FractureMap map_;
    std::vector<std::string> warnings_;
    std::map<std::string, size_t> ignored_;
    std::vector<pugi::xml_node> inUse_;
    size_t hidden_ = 0, strays_ = 0, elements_ = 0, points_ = 0;
    std::optional<Error> error_;
};

}  // namespace

Result<FractureMap> readSvgMap(std::string_view text, const std::string& name,
                               const MapReadOptions& options) {
    if (const Result<void> fine = checkMapInput(text, name, options); !fine)
        return tl::unexpected(fine.error());
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed)
        return fail(ErrorCode::malformed,
                    std::string("the SVG cannot be read: ") + parsed.description(),
                    name + " at byte " + std::to_string(parsed.offset));
    return SvgReader(document, name, options).read();
}

}  // namespace sherd
