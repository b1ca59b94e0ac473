// SPDX-License-Identifier: MIT
// SVG to fracture lines and labels. Drawn shapes become lines; what is hidden, what is no line
// (images, texts that are no label) and the layout's guide layer are passed over. The root viewBox
// spans UV [0, 1]^2.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "map/map_limits.h"
#include "map/svg_color.h"
#include "map/svg_harvest.h"
#include "map/svg_index.h"
#include "map/svg_labels.h"
#include "map/svg_line_style.h"
#include "map/svg_names.h"
#include "map/svg_shapes.h"
#include "map/svg_viewport.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

namespace {

constexpr size_t kMaxDepth = 256;           ///< nested groups and uses
constexpr size_t kMaxElements = 2'000'000;  ///< visited; a `use` visits its target again
constexpr size_t kElementBytes = 256;       ///< attributes that cost as much as another element

/// What a node inherits.
struct Context {
    SvgFrame frame;
    SvgLineStyle line;
    bool visible = true;
    size_t depth = 0;
};

/// Where the shapes of a label lie.
struct Bounds {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

size_t attributeBytes(const pugi::xml_node& node) {
    size_t bytes = 0;
    for (const pugi::xml_attribute& attribute : node.attributes())
        bytes += std::string_view(attribute.value()).size();
    return bytes;
}

class SvgReader {
  public:
    SvgReader(const pugi::xml_document& document, const std::string& name,
              const MapReadOptions& options)
        : root_(document.document_element()),
          name_(name),
          options_(options),
          index_(root_),
          harvest_(name, options.level) {}

    Result<FractureMap> read() {
        if (localName(root_.name()) != "svg")
            return fail(
                ErrorCode::malformed,
                "not an SVG drawing: the outermost element is <" + std::string(root_.name()) + ">",
                name_);
        collectColors();
        const Result<Context> context = rootContext();
        if (!context) return tl::unexpected(context.error());
        if (!visitChildren(root_, *context)) return tl::unexpected(std::move(*error_));
        return harvest_.finish();
    }

  private:
    /// The levels that colours choose: the options', then the drawing's own.
    void collectColors() {
        for (const auto& [color, level] : options_.levelOfColor) (void)colors_.add(color, level);
        if (const auto problem = colors_.addList(root_.attribute("data-sherd-colors").value()))
            harvest_.warn(root_, ": data-sherd-colors: " + *problem +
                                     "; \"#ff0000:1 #00ff00:2\" was expected");
    }

    Result<Context> rootContext() {
        const std::optional<SvgFrame> frame = rootSvgFrame(root_);
        if (!frame)
            return fail(ErrorCode::invalidData,
                        "the drawing says neither its viewBox nor its width and height; add "
                        "viewBox=\"0 0 1 1\" (or the size of the texture) to <svg>",
                        name_);
        Context context{*frame, SvgLineStyle(options_.level)};
        enterLineStyle(root_, index_.styles.styleOf(root_), context);
        return context;
    }

    bool stop(ErrorCode code, std::string message, const pugi::xml_node& node) {
        error_ = Error{code, std::move(message), harvest_.sourceOf(node)};
        return false;
    }

    /// Bounds the work; false when reading must stop.
    bool count(const pugi::xml_node& node, const Context& parent) {
        elements_ += 1 + attributeBytes(node) / kElementBytes;
        if (elements_ > kMaxElements)
            return stop(ErrorCode::limitExceeded,
                        "the drawing holds more than " + std::to_string(kMaxElements) +
                            " elements, counting each use of a repeated one",
                        node);
        if (parent.depth >= kMaxDepth)
            return stop(ErrorCode::limitExceeded,
                        "groups are nested deeper than " + std::to_string(kMaxDepth), node);
        if (index_.styles.overflowed())
            return stop(ErrorCode::limitExceeded,
                        "the drawing's style sheets hold too many rules; save it with presentation "
                        "attributes or inline styles",
                        node);
        return true;
    }

    /// Draws a node and what is inside; false when reading must stop.
    bool visit(const pugi::xml_node& node, const Context& parent) {
        if (node.type() != pugi::node_element) return true;
        const std::string_view name = localName(node.name());
        if (!count(node, parent)) return false;
        if (isSvgGuide(node)) {
            if (guides_.insert(node.internal_object()).second)
                harvest_.stray(countStrayShapes(node));
            return true;
        }
        if (isForeignSvgElement(node.name())) return true;
        if (name == "text") return visitText(node, parent);
        if (isReportedSvgElement(name)) {
            if (name != "defs" || node.first_child()) harvest_.passOver(name);
            return true;
        }
        const bool shape = isSvgShape(name);
        if (!shape && !isSvgGroup(name) && name != "svg" && name != "use") return true;
        Context context = parent;
        ++context.depth;
        if (!enter(node, context)) return true;
        if (bounds_ == nullptr && name != "svg" && isSvgLabel(node))
            return visitLabel(node, context);
        return visitInside(node, context);
    }

    bool visitInside(const pugi::xml_node& node, Context& context) {
        const std::string_view name = localName(node.name());
        if (isSvgShape(name)) return draw(node, context);
        if (name == "use") return visitUse(node, context);
        if (name == "svg") enterSvgViewport(node, context.frame.viewport, true, context.frame);
        return visitChildren(node, context);
    }

    bool visitChildren(const pugi::xml_node& node, const Context& context) {
        for (const pugi::xml_node& child : node.children())
            if (!visit(child, context)) return false;
        return true;
    }

    void enterLineStyle(const pugi::xml_node& node, const SvgStyle& style, Context& context) {
        std::vector<std::string> problems;
        context.line.enter(node, style, problems);
        harvest_.warn(node, problems);
    }

    /// Takes in the node's visibility, line style and transform; false if it draws nothing at all.
    bool enter(const pugi::xml_node& node, Context& context) {
        const SvgStyle style = index_.styles.styleOf(node);
        const std::string& opacity = style[SvgProperty::opacity];
        if (style[SvgProperty::display] == "none" ||
            (!opacity.empty() && parseSvgLength(opacity, 1) == 0.0)) {
            harvest_.hide();
            return false;
        }
        const std::string& visibility = style[SvgProperty::visibility];
        if (visibility == "hidden" || visibility == "collapse") context.visible = false;
        if (visibility == "visible") context.visible = true;
        enterLineStyle(node, style, context);

        std::string transform = style[SvgProperty::transform];
        if (node.attribute("transform")) transform = node.attribute("transform").value();
        const std::optional<Affine> local = parseSvgTransform(transform);
        if (!local) {
            harvest_.warn(node, " is left out: its transform cannot be read");
            return false;
        }
        context.frame.transform = context.frame.transform * *local;
        return true;
    }

    bool visitUse(const pugi::xml_node& node, Context& context) {
        const pugi::xml_node used = index_.find(svgAttribute(node, "href"));
        if (!used) {
            harvest_.warn(node, " is left out: it refers to nothing in this file");
            return true;
        }
        if (std::find(inUse_.begin(), inUse_.end(), used) != inUse_.end()) {
            harvest_.warn(node, " is left out: it refers to itself");
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

    /// A text whose words make a label; any other is passed over.
    bool visitText(const pugi::xml_node& node, const Context& parent) {
        const SvgTextContent text = svgTextContent(node, parent.frame.viewport);
        const bool words = readsAsLabel(text.words, LabelForm::text);
        if (bounds_ != nullptr || (!words && !hasSvgLabelAttributes(node))) {
            harvest_.passOver("text");
            return true;
        }
        Context context = parent;
        if (!enter(node, context)) return true;
        if (!context.visible) {
            harvest_.hide();
            return true;
        }
        std::vector<std::string> problems;
        FractureMap::Label label;
        label.level = context.line.layerLevel().value_or(0);
        if (words) readLabelWords(text.words, label, problems);
        readSvgLabelAttributes(node, label, problems);
        harvest_.warn(node, problems);
        harvest_.addLabel(std::move(label), context.frame.transform.point(text.place), node);
        return true;
    }

    /// A shape or group that is a label lies at the middle of what it would draw.
    bool visitLabel(const pugi::xml_node& node, Context& context) {
        std::vector<std::string> problems;
        FractureMap::Label label;
        label.level = context.line.layerLevel().value_or(0);
        readSvgLabelName(node, label, problems);
        readSvgLabelAttributes(node, label, problems);
        harvest_.warn(node, problems);
        Bounds bounds;
        bounds_ = &bounds;
        const bool whole = visitInside(node, context);
        bounds_ = nullptr;
        if (!whole) return false;
        harvest_.addLabel(std::move(label), (bounds.low + bounds.high) * 0.5, node);
        return true;
    }

    bool draw(const pugi::xml_node& node, const Context& context) {
        if (!context.visible) {
            harvest_.hide();
            return true;
        }
        const SvgPath path = svgShape(node, context.frame.viewport);
        if (!path.problem.empty())
            harvest_.warn(node, ": " + path.problem + "; what comes before it is kept");
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
            addLine(std::move(*points), node, context);
        }
        return true;
    }

    void addLine(std::vector<glm::dvec2> points, const pugi::xml_node& node,
                 const Context& context) {
        if (bounds_ == nullptr)
            return harvest_.addLine(std::move(points), node, context.line, colors_);
        for (const glm::dvec2 p : points) {
            bounds_->low = glm::min(bounds_->low, p);
            bounds_->high = glm::max(bounds_->high, p);
        }
    }

    pugi::xml_node root_;
    std::string name_;
    MapReadOptions options_;
    SvgIndex index_;
    ColorLevels colors_;
    SvgHarvest harvest_;
    std::set<const void*> guides_;  ///< whose strays are counted
    std::vector<pugi::xml_node> inUse_;
    Bounds* bounds_ = nullptr;  ///< of the label that is being drawn
    size_t elements_ = 0, points_ = 0;
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
