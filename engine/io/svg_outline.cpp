// Shapes of the tree of elements, each under the transforms of those around it.
#include "engine/io/svg_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/whole_file.h"
#include "engine/io/svg_path.h"

namespace lamella {

namespace {

constexpr double unit_mm = 25.4 / 96;
constexpr int deepest = 200;  // elements within elements

/// The map p -> linear p + shift.
struct Map {
    glm::dmat2 linear{1};
    dvec2 shift{0};

    dvec2 operator()(dvec2 p) const { return linear * p + shift; }
    Map operator*(const Map& inner) const { return {linear * inner.linear, linear * inner.shift + shift}; }
    /// Returns the largest stretch, at most.
    double stretch() const { return std::sqrt(squared_length(linear[0]) + squared_length(linear[1])); }
};

/// Numbers separated by spaces and commas; nothing if there is anything else.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text.size();) {
        if (is_space(text[at]) || text[at] == ',') {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && !is_space(text[end]) && text[end] != ',') ++end;
        const auto number = parse_double(text.substr(at, end - at));
        if (!number || !(std::abs(*number) < 1e9)) return std::nullopt;
        numbers.push_back(*number);
        at = end;
    }
    return numbers;
}

/// Returns a length in user units; nothing for a percentage or another unit that depends on a font or window.
std::optional<double> length_of(std::string_view text) {
    text = trimmed(text);
    constexpr std::array<std::pair<std::string_view, double>, 7> units{{{"mm", 1 / unit_mm},
                                                                        {"cm", 10 / unit_mm},
                                                                        {"in", 96},
                                                                        {"pt", 96.0 / 72},
                                                                        {"pc", 16},
                                                                        {"Q", 0.25 / unit_mm},
                                                                        {"px", 1}}};
    for (const auto& [unit, size] : units) {
        if (!text.ends_with(unit)) continue;
        const auto number = parse_double(text.substr(0, text.size() - unit.size()));
        return number ? std::optional(*number * size) : std::nullopt;
    }
    return parse_double(text);
}

class Drawing {
  public:
    Drawing(const std::string& path, double tolerance)
        : path_(path), tolerance_(tolerance), text_(whole_file(path, "an SVG drawing")) {}

    std::vector<std::vector<dvec2>> read() {
        pugi::xml_document document;
        const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
        const pugi::xml_node root = document.child("svg");
        if (!parsed || !root)
            throw InputError(path_ + ": is no SVG drawing; accepted: an XML file whose root is svg");
        collect(root, view_of(root), 0);
        if (polygons_.empty())
            throw InputError(path_ +
                             ": holds no filled shape; accepted: paths, polygons, rectangles, circles or "
                             "ellipses with a fill");
        Rect bounds;
        for (const auto& polygon : polygons_) {
            for (const dvec2 p : polygon) bounds = {glm::min(bounds.lo, p), glm::max(bounds.hi, p)};
        }
        for (auto& polygon : polygons_) {
            for (dvec2& p : polygon) p -= bounds.center();
        }
        return std::move(polygons_);
    }

  private:
    std::string where(const pugi::xml_node& node) const {
        const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
        const auto lines = std::ranges::count(std::string_view(text_).substr(0, offset), '\n');
        return fmt::format("{}:{}: <{}>", path_, lines + 1, std::string_view(node.name()).substr(0, 32));
    }
    [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& wrong) const {
        throw InputError(where(node) + " " + wrong);
    }
    double number(const pugi::xml_node& node, const char* name) const {
        const pugi::xml_attribute given = node.attribute(name);
        if (!given) return 0;
        const auto found = length_of(given.value());
        if (!found || !(std::abs(*found) < 1e9))
            refuse(node, fmt::format("has {}={}; accepted: a number, perhaps with mm, cm, in, pt, pc or px",
                                     name, excerpt(given.value())));
        return *found;
    }
    Map view_of(const pugi::xml_node& root) const;
    Map transform_of(const pugi::xml_node& node) const;
    void collect(const pugi::xml_node& node, const Map& map, int depth);
    void add_shape(const pugi::xml_node& node, const Map& map);
    void add(const std::vector<dvec2>& points, const Map& map) {
        std::vector<dvec2> polygon;
        count_ += points.size();
        if (count_ > most_svg_points)
            throw InputError(path_ + ": has more than a million points; accepted: a simpler drawing");
        polygon.reserve(points.size());
        for (const dvec2 p : points) polygon.push_back(map(p));
        if (polygon.size() > 2) polygons_.push_back(std::move(polygon));
    }

    const std::string& path_;
    double tolerance_;
    std::string text_;
    std::size_t count_ = 0;  ///< points of all polygons
    std::vector<std::vector<dvec2>> polygons_;
};

/// Returns the map from the drawing's units to mm, y upward.
Map Drawing::view_of(const pugi::xml_node& root) const {
    dvec2 scale(unit_mm);
    if (const pugi::xml_attribute view = root.attribute("viewBox")) {
        const auto box = numbers_of(view.value());
        if (!box || box->size() != 4 || !((*box)[2] > 0) || !((*box)[3] > 0))
            refuse(root, "has a viewBox that is not four numbers with a size; accepted: x y width height");
        const auto width = length_of(root.attribute("width").value()),
                   height = length_of(root.attribute("height").value());
        // By default the drawing keeps its proportions and fits in.
        double fit = infinity;
        if (width && *width > 0) fit = *width / (*box)[2];
        if (height && *height > 0) fit = std::min(fit, *height / (*box)[3]);
        if (fit < infinity) scale *= fit;
    }
    return {glm::dmat2(scale.x, 0, 0, -scale.y), dvec2(0)};
}

/// The transforms of a list, the first outermost.
Map Drawing::transform_of(const pugi::xml_node& node) const {
    Map map;
    std::string_view rest = trimmed(node.attribute("transform").value());
    while (!rest.empty()) {
        const std::size_t open = rest.find('('), close = rest.find(')');
        const std::string_view name = trimmed(rest.substr(0, std::min(open, rest.size())));
        std::optional<std::vector<double>> n;
        if (open < close && close != std::string_view::npos)
            n = numbers_of(rest.substr(open + 1, close - open - 1));
        const std::size_t count = n ? n->size() : 0;
        const auto at = [&](std::size_t i) { return i < count ? (*n)[i] : 0; };
        if (name == "translate" && (count == 1 || count == 2)) {
            map = map * Map{glm::dmat2(1), {at(0), at(1)}};
        } else if (name == "scale" && (count == 1 || count == 2)) {
            map = map * Map{glm::dmat2(at(0), 0, 0, count == 2 ? at(1) : at(0)), dvec2(0)};
        } else if (name == "rotate" && (count == 1 || count == 3)) {
            const SineCosine turn = sine_cosine(at(0) * pi / 180);
            const glm::dmat2 linear(turn.cosine, turn.sine, -turn.sine, turn.cosine);
            const dvec2 centre(at(1), at(2));
            map = map * Map{linear, centre - linear * centre};
        } else if ((name == "skewX" || name == "skewY") && count == 1) {
            const double slope = tangent(at(0) * pi / 180);
            map = map *
                  Map{name == "skewX" ? glm::dmat2(1, 0, slope, 1) : glm::dmat2(1, slope, 0, 1), dvec2(0)};
        } else if (name == "matrix" && count == 6) {
            map = map * Map{glm::dmat2(at(0), at(1), at(2), at(3)), {at(4), at(5)}};
        } else {
            refuse(node, "has transform=" + excerpt(node.attribute("transform").value()) +
                             "; accepted: translate, scale, rotate, skewX, skewY, matrix");
        }
        rest = rest.substr(close + 1);
        while (!rest.empty() && (is_space(rest.front()) || rest.front() == ',')) rest.remove_prefix(1);
    }
    return map;
}

/// Returns a property, from the attribute of its name or from the style.
std::string property(const pugi::xml_node& node, std::string_view name) {
    std::string_view style = node.attribute("style").value();
    while (!style.empty()) {
        const std::size_t end = std::min(style.find(';'), style.size()), colon = style.find(':');
        if (colon < end && trimmed(style.substr(0, colon)) == name)
            return std::string(trimmed(style.substr(colon + 1, end - colon - 1)));
        style = style.substr(std::min(end + 1, style.size()));
    }
    return node.attribute(std::string(name).c_str()).value();
}

void Drawing::collect(const pugi::xml_node& node, const Map& map, int depth) {
    static const std::set<std::string_view> shapes{"path",   "polygon", "rect",
                                                   "circle", "ellipse", "polyline"};
    static const std::set<std::string_view> groups{"svg", "g", "a", "switch"};
    const std::string_view name = node.name();
    if (depth > deepest) refuse(node, "lies deeper than 200 elements; accepted: a flatter drawing");
    if (property(node, "display") == "none" || property(node, "visibility") == "hidden") return;
    const Map inner = map * transform_of(node);
    if (groups.contains(name)) {
        if (property(node, "fill") == "none" && depth > 0) return;
        for (const pugi::xml_node& child : node.children()) {
            if (child.type() == pugi::node_element) collect(child, inner, depth + 1);
        }
    } else if (shapes.contains(name)) {
        if (property(node, "fill") != "none") add_shape(node, inner);
    } else if (name == "text" || name == "image" || name == "use") {
        refuse(node, "has no outline of its own; accepted: paths (in Inkscape: Path, Object to Path)");
    }
}

void Drawing::add_shape(const pugi::xml_node& node, const Map& map) {
    const std::string_view name = node.name();
    const double tolerance = tolerance_ / std::max(map.stretch(), 1e-300);
    if (name == "path") {
        for (const SvgSubpath& subpath :
             flattened_path(node.attribute("d").value(), tolerance, where(node))) {
            if (!subpath.is_closed)
                refuse(
                    node,
                    "is open: it ends elsewhere than it begins; accepted: closed paths (z at their ends), or "
                    "fill=\"none\" for lines that do not count");
            add(subpath.points, map);
        }
    } else if (name == "polygon" || name == "polyline") {
        const auto numbers = numbers_of(node.attribute("points").value());
        if (!numbers || numbers->size() % 2 != 0) refuse(node, "has points that are not pairs of numbers");
        std::vector<dvec2> points;
        for (std::size_t i = 0; i < numbers->size(); i += 2)
            points.emplace_back((*numbers)[i], (*numbers)[i + 1]);
        const bool returns = points.size() > 1 && points.front() == points.back();
        if (name == "polyline" && !returns) refuse(node, "is open; accepted: a polygon");
        if (returns) points.pop_back();
        add(points, map);
    } else if (name == "rect") {
        const dvec2 lo(number(node, "x"), number(node, "y")),
            size(number(node, "width"), number(node, "height"));
        if (number(node, "rx") > 0 || number(node, "ry") > 0)
            refuse(node, "has round corners; accepted: a path (in Inkscape: Path, Object to Path)");
        add({lo, {lo.x + size.x, lo.y}, lo + size, {lo.x, lo.y + size.y}}, map);
    } else {
        dvec2 radii(number(node, "r"));
        if (name == "ellipse") radii = {number(node, "rx"), number(node, "ry")};
        if (radii.x > 0 && radii.y > 0)
            add(flattened_ellipse({number(node, "cx"), number(node, "cy")}, radii, tolerance), map);
    }
}

}  // namespace

std::vector<std::vector<dvec2>> read_svg_outlines(const std::string& path, double tolerance) {
    return Drawing(path, tolerance).read();
}

}  // namespace lamella
