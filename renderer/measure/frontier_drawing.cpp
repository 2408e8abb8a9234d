#include "renderer/measure/frontier_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/base/lengths_text.h"

namespace si {
namespace {

using glm::dvec2;

constexpr PlotColour kPlotColours[] = {
    {{255, 255, 255}, {22, 24, 29}},     // paper
    {{22, 24, 29}, {236, 238, 242}},     // text
    {{85, 91, 102}, {169, 176, 188}},    // muted
    {{228, 230, 234}, {48, 53, 62}},     // grid
    {{168, 173, 182}, {104, 110, 120}},  // beaten
    {{22, 24, 29}, {236, 238, 242}},     // front
    {{176, 0, 80}, {255, 120, 170}},     // spot
    // Families: hues of Okabe and Ito, darkened where they carry text.
    {{193, 74, 0}, {255, 138, 61}},
    {{0, 114, 178}, {86, 180, 233}},
    {{0, 128, 93}, {44, 194, 149}},
    {{163, 61, 122}, {229, 156, 195}},
    {{138, 105, 0}, {240, 192, 74}},
    {{94, 79, 162}, {181, 154, 224}},
    {{110, 68, 38}, {214, 170, 134}},
    {{84, 104, 122}, {180, 196, 208}},
};
static_assert(std::size(kPlotColours) == kPlotInks);

/// Returns the corners of a family's shape, so that families differ without colour.
std::vector<dvec2> shape(int family, dvec2 at, double radius) {
    const auto ring = [&](int corners, double turn, double inner) {
        std::vector<dvec2> out;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * 3.14159265358979 * (i / double(corners)) + turn;
            const double r = inner > 0 && i % 2 ? inner * radius : radius;
            out.push_back(at + r * dvec2(std::sin(angle), -std::cos(angle)));
        }
        return out;
    };
    constexpr double kHalf = 3.14159265358979;
    switch (family) {
        case 0:
            return ring(4, kHalf / 4, 0);
        case 1:
            return ring(20, 0, 0);
        case 2:
            return ring(3, 0, 0);
        case 3:
            return ring(4, 0, 0);
        case 4:
            return ring(3, kHalf, 0);
        case 5:
            return ring(8, 0, 0.45);
        case 6:
            return ring(5, 0, 0);
        default:
            return ring(6, 0, 0.5);
    }
}

/// Estimates the width of a text in a wide sans-serif font.
double estimated_width(std::string_view text, double size, bool strong) {
    double ems = 0;
    for (const char c : text) {
        if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;  // a later byte of a character
        const std::string_view narrow = "ijl.,:;'|!()[] ft/", wide = "mwMW%";
        ems += narrow.find(c) != std::string_view::npos ? 0.35
               : wide.find(c) != std::string_view::npos ? 0.95
               : c >= 'A' && c <= 'Z'                   ? 0.7
                                                        : 0.62;
    }
    return ems * size * (strong ? 1.12 : 1.0);
}

/// Largest cost and error within the axes, as a multiple of the front's largest.
constexpr double kMostOfFront = 4;

/// Logarithmic scale from values to pixels. Values of zero or less stand at its lower end.
struct Scale {
    double low = 0.1, high = 1, from = 0, to = 1;
    bool zero = false;
    double start() const { return from + (zero ? std::copysign(26.0, to - from) : 0.0); }
    /// Returns the pixel of a value; values beyond an end stand at it.
    double at(double value) const {
        if (!(value > 0)) return from + std::copysign(10.0, to - from);
        const double share = std::clamp(std::log(value / low) / std::log(high / low), 0.0, 1.0);
        return start() + share * (to - start());
    }
};

Scale scale_of(const std::vector<double>& values, double from, double to, double pad_from, double pad_to) {
    Scale s{.from = from, .to = to};
    double low = INFINITY, high = 0;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        s.zero = s.zero || v <= 0;
        if (v <= 0) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    if (!(high > 0)) {
        low = 0.1;
        high = 1;
    }
    if (high < 1.3 * low) {
        low /= 1.15;
        high *= 1.15;
    }
    // The pads are pixels: the values span what is left between them.
    const double span = std::abs(to - s.start()), inner = std::max(span - pad_from - pad_to, 0.3 * span);
    const double decades = std::log(high / low) / inner;
    s.low = low / std::exp(decades * (span - inner) * pad_from / std::max(pad_from + pad_to, 1.0));
    s.high = high * std::exp(decades * (span - inner) * pad_to / std::max(pad_from + pad_to, 1.0));
    return s;
}

/// Lists few round values within a scale.
std::vector<double> ticks(const Scale& s, int most, bool bytes) {
    std::vector<double> out;
    if (bytes) {
        const int octaves = std::max(1, int(std::ceil(std::log2(s.high / s.low) / most)));
        for (int e = int(std::ceil(std::log2(s.low))); e <= std::log2(s.high); ++e)
            if (e % octaves == 0) out.push_back(std::exp2(e));
        return out;
    }
    for (const std::vector<double>& steps :
         {std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9}, {1, 2, 3, 5, 7}, {1, 2, 5}, {1, 3}, {1}}) {
        out.clear();
        for (int e = int(std::floor(std::log10(s.low))); e <= int(std::ceil(std::log10(s.high))); ++e)
            for (const double m : steps)
                if (const double v = m * std::pow(10.0, e); v >= s.low && v <= s.high) out.push_back(v);
        if (int(out.size()) <= most) break;
    }
    return out;
}

std::string tick_text(double v, bool bytes) {
    if (!bytes) return fmt::format("{:.6g}", v) == "1e-05" ? "0.00001" : fmt::format("{:.6g}", v);
    constexpr double kKiB = 1024, kMiB = kKiB * kKiB;
    return v < kKiB   ? fmt::format("{:g} B", v)
           : v < kMiB ? fmt::format("{:g} KiB", v / kKiB)
                      : fmt::format("{:g} MiB", v / kMiB);
}

struct Box {
    dvec2 lo{0}, hi{0};
    bool meets(const Box& b) const { return lo.x < b.hi.x && b.lo.x < hi.x && lo.y < b.hi.y && b.lo.y < hi.y; }
};

/// Line of the plot: the cases of one kernel by rising resolution.
struct KernelLine {
    std::vector<std::size_t> cases;
    bool on_front = false;
};

/// Lays out one plot.
class Layout {
public:
    Layout(const FrontierPlot& plot, const PlotPage& page)
        : plot_(plot), page_(page), dots_(dots_of(plot)), front_(strict_front(dots_)), small_(page.em * kSmallText) {}

    FrontierDrawing drawing() {
        out_.width = page_.width;
        double y = 2;
        if (page_.sentence) y = write_lines(PlotInk::Text, y, knee_sentence(plot_), page_.em, true) + page_.em * 0.4;
        find_lines();
        y = place_box(y);
        draw_axes();
        draw_forced();
        draw_lines();
        draw_front();
        draw_spots();
        draw_front_labels();
        draw_line_labels();
        y = draw_legend(y);
        if (page_.table) y = draw_table(y);
        out_.height = y;
        return std::move(out_);
    }

private:
    double width_of(std::string_view text, double size, bool strong = false) const {
        return page_.text_width ? page_.text_width(text, size, strong) : estimated_width(text, size, strong);
    }
    dvec2 at(const Dot& dot) const { return {x_.at(dot.cost), y_.at(dot.error)}; }
    void line(PlotInk ink, std::vector<dvec2> points, double width, bool dashed = false, double opacity = 1) {
        out_.marks.push_back({.kind = PlotMark::Kind::Line,
                              .ink = ink,
                              .points = std::move(points),
                              .width = width,
                              .opacity = opacity,
                              .dashed = dashed});
    }
    void words(PlotInk ink, dvec2 start, std::string text, double size, bool strong = false,
               PlotMark::Anchor anchor = PlotMark::Anchor::Start, bool halo = false) {
        out_.marks.push_back({.kind = PlotMark::Kind::Text,
                              .ink = ink,
                              .points = {start},
                              .strong = strong,
                              .size = size,
                              .anchor = anchor,
                              .text = std::move(text),
                              .halo = halo});
    }

    /// Writes a text in lines that fit the page, below `y`. Returns the y of its last line.
    double write_lines(PlotInk ink, double y, const std::string& text, double size, bool strong) {
        std::string row;
        const auto flush = [&] {
            y += size * 1.25;
            words(ink, {2, y - size * 0.2}, row, size, strong);
            row.clear();
        };
        for (std::size_t from = 0; from < text.size();) {
            const std::size_t end = std::min(text.find(' ', from), text.size());
            const std::string word = text.substr(from, end - from);
            if (!row.empty() && width_of(row + " " + word, size, strong) > page_.width - 4) flush();
            row += (row.empty() ? "" : " ") + word;
            from = end + 1;
        }
        if (!row.empty()) flush();
        return y;
    }

    /// Explains lines and colours below `y`. Returns the y below it.
    double draw_legend(double y) {
        if (!page_.titles || front_.empty()) return y;
        std::string text =
            "A line: one kernel, from small to large maps. Black steps: the Pareto front; no cheaper case has a "
            "smaller error, and no case at all has a smaller one than its last. Grey: kernels with no case on the "
            "front.";
        if (knee_of(dots_, front_)) text += " Circle: the knee.";
        return write_lines(PlotInk::Muted, y, text, small_, false) + page_.em * 0.3;
    }

    void find_lines() {
        for (std::size_t i = 0; i < plot_.cases.size(); ++i) lines_[plot_.cases[i].line].cases.push_back(i);
        for (const std::size_t i : front_) lines_[plot_.cases[i].line].on_front = true;
        for (auto& [name, l] : lines_)
            std::ranges::stable_sort(l.cases, {}, [&](std::size_t i) { return plot_.cases[i].along; });
    }

    /// Places the box with the axes below `y`. Returns the y below the axes' numbers and titles.
    double place_box(double y) {
        std::vector<double> costs, errors;
        const auto add = [&](const Dot& d) {
            costs.push_back(d.cost);
            errors.push_back(d.error);
        };
        for (const std::size_t i : front_) {
            most_cost_ = std::max(most_cost_, kMostOfFront * dots_[i].cost);
            most_error_ = std::max(most_error_, kMostOfFront * dots_[i].error);
        }
        for (const Dot& d : dots_)
            if (inside(d)) add(d);
        for (const PlotSpot& s : plot_.spots) add(s.dot);
        for (const Dot& d : plot_.forced)
            if (inside(d)) add(d);
        if (page_.titles) y += small_ * 1.3;
        title_y_ = y - small_ * 0.35;
        box_.lo.y = y + 2;
        box_.hi.y = box_.lo.y + page_.height;
        const double label = std::min(0.2 * page_.width, 10.5 * page_.em);
        // Labels need room left of the first case of the front, and right of the lines' ends.
        y_ = scale_of(errors, box_.hi.y, box_.lo.y, 2.6 * page_.em, 0.9 * page_.em);
        double numbers = 0;
        for (const double t : ticks(y_, 7, false)) numbers = std::max(numbers, width_of(tick_text(t, false), small_));
        box_.lo.x = numbers + 10;
        box_.hi.x = page_.width - 3;
        double first = 0.5 * label;
        // A page without titles is small: there the axis needs the room more than the label of a knee.
        const bool large = page_.titles;
        if (!front_.empty())
            first = width_of(large ? front_name(front_[0]) : plot_.cases[front_[0]].name(), small_, true) +
                    (large ? 1.5 : 1.2) * page_.em;
        x_ = scale_of(costs, box_.lo.x, box_.hi.x, std::min(first, 0.3 * page_.width), label);
        return box_.hi.y + small_ * (page_.titles ? 3.0 : 1.5);
    }

    /// Returns true for points within the axes.
    bool inside(const Dot& d) const { return plot_.whole || (d.cost <= most_cost_ && d.error <= most_error_); }

    void draw_axes() {
        const int across = std::max(2, int((box_.hi.x - box_.lo.x) / (5.5 * page_.em)));
        const int up = std::clamp(int(page_.height / (3.2 * page_.em)), 2, 6);
        for (const double t : ticks(x_, std::min(across, 7), plot_.bytes)) {
            line(PlotInk::Grid, {{x_.at(t), box_.lo.y}, {x_.at(t), box_.hi.y}}, 1);
            const std::string text = tick_text(t, plot_.bytes);
            const double x = std::min(x_.at(t), page_.width - 0.5 * width_of(text, small_));
            words(PlotInk::Muted, {x, box_.hi.y + small_ * 1.2}, text, small_, false, PlotMark::Anchor::Middle);
        }
        for (const double t : ticks(y_, up, false)) {
            line(PlotInk::Grid, {{box_.lo.x, y_.at(t)}, {box_.hi.x, y_.at(t)}}, 1);
            words(PlotInk::Muted, {box_.lo.x - 5, y_.at(t) + small_ * 0.35}, tick_text(t, false), small_, false,
                  PlotMark::Anchor::End);
        }
        if (x_.zero)
            words(PlotInk::Muted, {x_.at(0), box_.hi.y + small_ * 1.2}, "0", small_, false, PlotMark::Anchor::Middle);
        if (y_.zero)
            words(PlotInk::Muted, {box_.lo.x - 5, y_.at(0) + small_ * 0.35}, "0", small_, false, PlotMark::Anchor::End);
        line(PlotInk::Beaten, {{box_.lo.x, box_.lo.y}, {box_.lo.x, box_.hi.y}, {box_.hi.x, box_.hi.y}}, 1);
        const auto outside = std::ranges::count_if(dots_, [&](const Dot& d) { return !inside(d); });
        if (outside > 0 && page_.titles)
            words(PlotInk::Muted, {box_.hi.x - 2, title_y_},
                  fmt::format("{} case{} not shown: over {:g} \u00d7 the front's largest cost or error", outside,
                              outside == 1 ? "" : "s", kMostOfFront),
                  small_, false, PlotMark::Anchor::End);
        if (!page_.titles) return;
        mark_base();
        words(PlotInk::Text, {2, title_y_}, plot_.error_title + " (log scale; lower is better)", small_);
        std::string cost = plot_.cost_title;
        if (!plot_.cost_unit.empty() && !plot_.bytes) cost += ", " + plot_.cost_unit;
        words(PlotInk::Text, {0.5 * (box_.lo.x + box_.hi.x), box_.hi.y + small_ * 2.5},
              cost + " (log scale; further left is cheaper)", small_, false, PlotMark::Anchor::Middle);
    }

    /// Marks the base's cost on the axis.
    void mark_base() {
        if (!plot_.base_cost) return;
        const double cost = *plot_.base_cost, x = x_.at(cost), r = page_.em * 0.3;
        if (!(cost >= x_.low && cost <= x_.high)) return;
        const dvec2 tip(x, box_.hi.y);
        out_.marks.push_back({.kind = PlotMark::Kind::Area,
                              .ink = PlotInk::Text,
                              .points = {tip, tip + dvec2(-r, -2 * r), tip + dvec2(r, -2 * r)}});
        const double w = width_of("base", small_);
        words(PlotInk::Text, tip + dvec2(r + 2, -4), "base", small_);
        taken_.push_back({tip - dvec2(r, 4 + small_), tip + dvec2(r + 2 + w, 0)});
    }

    void draw_forced() {
        const auto within = [&](const Dot& d) { return inside(d); };
        if (std::ranges::none_of(plot_.forced, within)) return;
        std::vector<dvec2> path;
        for (const std::size_t i : strict_front(plot_.forced)) {
            if (!inside(plot_.forced[i])) continue;
            const dvec2 p = at(plot_.forced[i]);
            if (!path.empty()) path.push_back({p.x, path.back().y});
            path.push_back(p);
        }
        if (path.size() < 2) return;
        line(PlotInk::Muted, path, 1.2, true, 0.6);
        const std::string text = "optimisations off";
        const double w = width_of(text, small_);
        const dvec2 start(std::min(path.back().x + 4, page_.width - w), path.back().y - 4);
        words(PlotInk::Muted, start, text, small_);
        taken_.push_back({start - dvec2(2, small_), start + dvec2(w, 4)});
    }

    void draw_lines() {
        for (const bool on : {false, true})
            for (const auto& [name, l] : lines_) {
                if (l.on_front != on) continue;
                const PlotInk ink = on ? family_ink(plot_.cases[l.cases[0]].family) : PlotInk::Beaten;
                std::vector<dvec2> path;
                for (const std::size_t i : l.cases) path.push_back(at(dots_[i]));
                if (path.size() > 1) line(ink, path, on ? 1.6 : 0.8, false, on ? 1 : 0.7);
                if (on) cover(path);
                for (const std::size_t i : l.cases) draw_case(i, ink, on);
            }
    }

    /// Marks the places along a path as taken, so that labels leave it free.
    void cover(const std::vector<dvec2>& path) {
        for (std::size_t i = 1; i < path.size(); ++i) {
            const int steps = std::max(1, int(glm::distance(path[i - 1], path[i]) / 5));
            for (int k = 0; k <= steps; ++k) {
                const dvec2 p = glm::mix(path[i - 1], path[i], double(k) / steps);
                soft_.push_back({p - 1.5, p + 1.5});
            }
        }
    }

    void draw_case(std::size_t i, PlotInk ink, bool of_front_line) {
        const PlotCase& c = plot_.cases[i];
        if (!inside(c.dot)) return;
        const dvec2 p = at(c.dot);
        const bool on = std::ranges::find(front_, i) != front_.end();
        const double r = page_.em * (on ? 0.42 : of_front_line ? 0.26 : 0.18);
        std::vector<dvec2> corners = shape(c.family, p, r);
        if (c.bound) {
            out_.marks.push_back({.kind = PlotMark::Kind::Area, .ink = PlotInk::Paper, .points = corners});
            out_.marks.push_back(
                {.kind = PlotMark::Kind::Line, .ink = ink, .points = corners, .width = 1.4, .closed = true});
        } else {
            out_.marks.push_back({.kind = PlotMark::Kind::Area, .ink = ink, .points = corners});
        }
        if (c.tied)
            out_.marks.push_back({.kind = PlotMark::Kind::Line,
                                  .ink = PlotInk::Muted,
                                  .points = shape(1, p, r * 1.7),
                                  .width = 1,
                                  .dashed = true,
                                  .closed = true});
        taken_.push_back({p - (r + 1), p + (r + 1)});
        out_.cases.push_back({c.of, p, std::max(x_.at(std::max(c.dot.cost - c.dot.cost_noise, 0.0)), box_.lo.x),
                              std::min(x_.at(c.dot.cost + c.dot.cost_noise), box_.hi.x)});
    }

    /// Draws the front as a stair below its marks, with whiskers where neighbours' noise overlaps.
    void draw_front() {
        std::vector<dvec2> path;
        for (const std::size_t i : front_) {
            const dvec2 p = at(dots_[i]);
            if (!path.empty()) path.push_back({p.x, path.back().y});
            path.push_back(p);
        }
        if (path.size() > 1) line(PlotInk::Front, path, 2.4, false, 0.85);
        cover(path);
        for (std::size_t k = 0; k < front_.size(); ++k) {
            const Dot& d = dots_[front_[k]];
            const auto overlaps = [&](std::size_t other) {
                const Dot& o = dots_[front_[other]];
                return std::abs(o.cost - d.cost) < o.cost_noise + d.cost_noise;
            };
            if ((k > 0 && overlaps(k - 1)) || (k + 1 < front_.size() && overlaps(k + 1)))
                line(PlotInk::Text,
                     {{std::max(x_.at(std::max(d.cost - d.cost_noise, 0.0)), box_.lo.x), at(d).y},
                      {std::min(x_.at(d.cost + d.cost_noise), box_.hi.x), at(d).y}},
                     1);
            draw_case_again(front_[k]);
        }
        if (const auto knee = knee_of(dots_, front_)) {
            out_.marks.push_back({.kind = PlotMark::Kind::Line,
                                  .ink = PlotInk::Text,
                                  .points = shape(1, at(dots_[*knee]), page_.em * 0.75),
                                  .width = 1.6,
                                  .closed = true});
            const double r = page_.em * 0.8;
            taken_.push_back({at(dots_[*knee]) - r, at(dots_[*knee]) + r});
        }
    }

    void draw_case_again(std::size_t i) {
        const PlotCase& c = plot_.cases[i];
        const std::vector<dvec2> corners = shape(c.family, at(c.dot), page_.em * 0.42);
        out_.marks.push_back(
            {.kind = PlotMark::Kind::Area, .ink = c.bound ? PlotInk::Paper : family_ink(c.family), .points = corners});
        out_.marks.push_back({.kind = PlotMark::Kind::Line,
                              .ink = c.bound ? family_ink(c.family) : PlotInk::Paper,
                              .points = corners,
                              .width = c.bound ? 1.6 : 1.0,
                              .closed = true});
    }

    void draw_spots() {
        for (std::size_t i = 0; i < plot_.spots.size(); ++i) {
            const PlotSpot& s = plot_.spots[i];
            const dvec2 p = at(s.dot);
            const double r = page_.em * 0.5;
            const std::vector<dvec2> corners = {p + dvec2(0, -r), p + dvec2(r, 0), p + dvec2(0, r), p + dvec2(-r, 0)};
            const bool filled = s.kind == PlotSpot::Kind::Present;
            out_.marks.push_back(
                {.kind = PlotMark::Kind::Area, .ink = filled ? PlotInk::Spot : PlotInk::Paper, .points = corners});
            out_.marks.push_back({.kind = PlotMark::Kind::Line,
                                  .ink = filled ? PlotInk::Paper : PlotInk::Spot,
                                  .points = corners,
                                  .width = 1.5,
                                  .closed = true});
            taken_.push_back({p - r, p + r});
            out_.spots.push_back(
                {i, p, x_.at(std::max(s.dot.cost - s.dot.cost_noise, 0.0)), x_.at(s.dot.cost + s.dot.cost_noise)});
        }
        for (const PlotSpot& s : plot_.spots) label(at(s.dot), {{s.label, PlotInk::Spot, true}}, kBeside, false);
    }

    struct Row {
        std::string text;
        PlotInk ink;
        bool strong;
    };
    /// Order in which places around a mark are tried.
    enum Places { kBelowLeft, kBeside };

    /// Writes rows of text near a mark where they cover nothing. Returns false if there is no room.
    bool label(dvec2 mark, const std::vector<Row>& rows, Places places, bool may_cover_lines, double reach = 0) {
        double w = 0;
        for (const Row& row : rows) w = std::max(w, width_of(row.text, small_, row.strong));
        const double line_height = small_ * 1.15, h = line_height * double(rows.size()), gap = page_.em * 0.65;
        std::vector<dvec2> corners;
        const dvec2 left(-gap - w, -0.5 * h), right(gap, -0.5 * h);
        if (places == kBelowLeft) {
            for (const double down : {0.0, 0.35, 0.7, 1.0, 1.5, 2.0}) corners.push_back(left + dvec2(0, down * h));
            corners.push_back({-0.5 * w, gap});
            corners.push_back({0, gap});
            corners.push_back({gap, 0.1 * h});
        }
        for (const dvec2 c : {right, right + dvec2(0, -0.6 * h), right + dvec2(0, 0.6 * h), dvec2(-0.5 * w, -gap - h),
                              dvec2(-0.5 * w, gap), dvec2(0, -gap - h), dvec2(0, gap), left})
            corners.push_back(c);
        for (double down = 1; down * h <= reach; down += 0.5)
            for (const double sign : {1.0, -1.0}) {
                corners.push_back(right + dvec2(4, sign * down * h));
                corners.push_back(left + dvec2(-4, sign * down * h));
            }
        for (const dvec2 c : corners) {
            const Box b{mark + c, mark + c + dvec2(w, h)};
            if (b.lo.x < box_.lo.x + 2 || b.hi.x > page_.width || b.lo.y < box_.lo.y - 2 || b.hi.y > box_.hi.y - 2)
                continue;
            const auto meets = [&](const Box& t) { return t.meets(b); };
            if (std::ranges::any_of(taken_, meets) || (!may_cover_lines && std::ranges::any_of(soft_, meets))) continue;
            taken_.push_back(b);
            const bool ends_left = b.hi.x <= mark.x;
            const dvec2 near(std::clamp(mark.x, b.lo.x, b.hi.x), std::clamp(mark.y, b.lo.y, b.hi.y));
            if (glm::distance(near, mark) > 1.6 * gap) line(PlotInk::Muted, {mark, near}, 0.7);
            for (std::size_t i = 0; i < rows.size(); ++i)
                words(rows[i].ink, {ends_left ? b.hi.x : b.lo.x, b.lo.y + line_height * (double(i) + 0.8)},
                      rows[i].text, small_, rows[i].strong, ends_left ? PlotMark::Anchor::End : PlotMark::Anchor::Start,
                      true);
            return true;
        }
        return false;
    }

    /// Returns the label of a case of the front: its name, the bound of its cost, and whether it is the knee.
    std::string front_name(std::size_t i) const {
        const PlotCase& c = plot_.cases[i];
        const std::string bound = c.bound ? " (" + plot_cost_text(plot_, c.dot.cost, true) + ")" : "";
        return c.name() + bound + (knee_of(dots_, front_) == i ? " \u2013 knee" : "");
    }

    /// Returns true for the knee, the last case of the front, and those of the table.
    bool always_labelled(std::size_t i) const {
        if (i == front_.back() || i == knee_of(dots_, front_)) return true;
        if (!page_.table) return false;
        return std::ranges::any_of(best_rows(plot_), [&](const BestRow& row) { return row.best == i; });
    }

    /// Lists the front's cases that get a label: the first, those that always get one, and each with an error of 5 %
    /// less than the case labelled before. Smaller steps are joined with the next.
    std::vector<std::size_t> labelled_cases() const {
        constexpr double kJoined = 0.05;
        std::vector<std::size_t> out;
        for (const std::size_t i : front_) {
            const bool less = out.empty() || dots_[i].error <= (1 - kJoined) * dots_[out.back()].error;
            if (less || always_labelled(i)) out.push_back(i);
        }
        return out;
    }

    /// Names cases of the front, with what each step to them costs and gains. Below and left of the front there are no
    /// cases.
    void draw_front_labels() {
        const std::vector<std::size_t> named = labelled_cases();
        const std::vector<FrontStep> steps = front_steps(dots_, named);
        for (std::size_t k = 0; k < named.size(); ++k) {
            std::string step;
            if (k > 0) {
                const PlotCase &from = plot_.cases[named[k - 1]], &to = plot_.cases[named[k]];
                constexpr double kSame = 1.02;
                const double times = steps[k - 1].cost_factor;
                if (!from.bound && !to.bound && std::isfinite(times))
                    step = times < kSame ? "same cost, " : fmt::format("{} \u00d7 cost, ", digits_text(times));
                step = fmt::format("step: {}\u2212{:.0f} % error", step, 100 * steps[k - 1].error_reduction);
            }
            name_front_case(named[k], step);
        }
    }

    void name_front_case(std::size_t i, const std::string& step) {
        const PlotCase& c = plot_.cases[i];
        const Row name{front_name(i), family_ink(c.family), true}, gain{step, PlotInk::Text, false};
        std::vector<std::vector<Row>> tries = {{name}};
        if (!step.empty()) tries = {{name, gain}, {name}, {gain}};
        for (const std::vector<Row>& rows : tries)
            for (const bool cover_lines : {false, true})
                if (label(at(c.dot), rows, kBelowLeft, cover_lines, cover_lines ? 5 * page_.em : 0)) {
                    named_[c.line] = true;
                    return;
                }
    }

    static std::string digits2(double v) { return v < 10 ? fmt::format("{:.2g}", v) : fmt::format("{:.0f}", v); }

    void draw_line_labels() {
        for (const bool on : {true, false})
            for (const auto& [name, l] : lines_) {
                const std::size_t end = l.cases.back();
                if (!inside(dots_[end])) continue;
                const bool end_named = std::ranges::find(front_, end) != front_.end() && named_[name];
                if (l.on_front != on || end_named) continue;
                const PlotInk ink = on ? family_ink(plot_.cases[end].family) : PlotInk::Muted;
                if (!label(at(dots_[end]), {{name, ink, on}}, kBeside, false) && on && !named_[name])
                    label(at(dots_[end]), {{name, ink, on}}, kBeside, true, 6 * page_.em);
            }
    }

    /// Writes the table of best cases below `y`. Returns the y below it.
    double draw_table(double y) {
        const std::vector<BestRow> rows = best_rows(plot_);
        if (rows.empty()) return y;
        const double row_height = page_.em * 1.35, em = page_.em;
        const double name_x = 0.24 * page_.width, cost_x = 0.79 * page_.width, error_x = page_.width - 4;
        using Anchor = PlotMark::Anchor;
        y += row_height;
        words(PlotInk::Muted, {2, y}, "Budget", small_);
        words(PlotInk::Muted, {name_x, y}, "least error within it", small_);
        words(PlotInk::Muted, {cost_x, y}, "costs (\u00d7 base)", small_, false, Anchor::End);
        words(PlotInk::Muted, {error_x, y}, "error", small_, false, Anchor::End);
        line(PlotInk::Grid, {{2, y + em * 0.35}, {page_.width - 2, y + em * 0.35}}, 1);
        const auto write = [&](std::size_t i) {
            const PlotCase& c = plot_.cases[i];
            words(family_ink(c.family), {name_x, y}, c.name(), em, true);
            words(PlotInk::Text, {cost_x, y},
                  c.bound
                      ? plot_cost_text(plot_, c.dot.cost, true)
                      : fmt::format("{} ({} \u00d7)", digits_text(c.dot.cost), digits2(c.dot.cost / *plot_.base_cost)),
                  em, false, Anchor::End);
            words(PlotInk::Text, {error_x, y}, digits_text(c.dot.error), em, false, Anchor::End);
        };
        if (const auto knee = knee_of(dots_, front_)) {
            y += row_height;
            words(PlotInk::Text, {2, y}, "the knee", em);
            write(*knee);
        }
        std::optional<std::size_t> before;
        for (const BestRow& row : rows) {
            y += row_height;
            words(PlotInk::Text, {2, y}, fmt::format("{:g} \u00d7 base", row.multiple), em);
            if (!row.best) {
                words(PlotInk::Muted, {name_x, y}, "nothing costs so little", em);
                continue;
            }
            const bool same = before == row.best;
            before = row.best;
            if (same) {
                words(PlotInk::Muted, {name_x, y}, "the same: more money buys nothing", em);
                continue;
            }
            write(*row.best);
        }
        y += row_height;
        words(PlotInk::Muted, {2, y},
              fmt::format("Base: {}, {}.", plot_.base_name, plot_cost_text(plot_, *plot_.base_cost, false)), small_);
        return y + em * 0.5;
    }

    const FrontierPlot& plot_;
    const PlotPage& page_;
    std::vector<Dot> dots_;
    std::vector<std::size_t> front_;
    double small_, title_y_ = 0;
    double most_cost_ = 0, most_error_ = 0;  ///< ends of the axes
    Box box_;
    Scale x_, y_;
    std::map<std::string, KernelLine> lines_;
    std::map<std::string, bool> named_;
    std::vector<Box> taken_, soft_;  ///< soft_: along lines, which labels cover only if nothing else is free
    FrontierDrawing out_;
};

}  // namespace

PlotInk family_ink(int family) {
    return PlotInk(std::size_t(PlotInk::Family0) + std::size_t(std::clamp(family, 0, kPlotFamilies - 1)));
}

const PlotColour& plot_colour(PlotInk ink) {
    return kPlotColours[std::size_t(ink)];
}

std::vector<Dot> dots_of(const FrontierPlot& plot) {
    std::vector<Dot> dots;
    for (const PlotCase& c : plot.cases) dots.push_back(c.dot);
    return dots;
}

std::string plot_cost_text(const FrontierPlot& plot, double cost, bool bound) {
    const std::string text = plot.bytes               ? tick_text(cost, true)
                             : plot.cost_unit.empty() ? digits_text(cost)
                                                      : digits_text(cost) + " " + plot.cost_unit;
    return bound ? "< " + text : text;
}

std::string knee_sentence(const FrontierPlot& plot) {
    const std::vector<Dot> dots = dots_of(plot);
    const std::vector<std::size_t> front = strict_front(dots);
    if (front.empty()) return {};
    const auto described = [&](std::size_t i) {
        const PlotCase& c = plot.cases[i];
        return fmt::format("{}: {} for {}", c.name(), digits_text(c.dot.error),
                           plot_cost_text(plot, c.dot.cost, c.bound));
    };
    if (dots.size() == 1)
        return fmt::format("One case: {} for {}.", digits_text(dots[0].error),
                           plot_cost_text(plot, dots[0].cost, plot.cases[0].bound));
    const auto knee = knee_of(dots, front);
    if (!knee && front.size() == 1) return described(front.front()) + "; nothing dearer was measured.";
    if (!knee)
        return "Each doubling of the cost still buys a quarter of the error. The best: " + described(front.back()) +
               ".";
    const Dot& at = dots[*knee];
    const auto next = std::ranges::find_if(front, [&](std::size_t i) { return is_clearly_better(dots[i], at); });
    std::string rest = "No dearer case is, either.";
    if (next != front.end()) {
        const bool ratio = !plot.cases[*next].bound && !plot.cases[*knee].bound && at.cost > 0;
        rest = "The cheapest that is: " + plot.cases[*next].name();
        if (ratio) rest += fmt::format(", for {} \u00d7", digits_text(dots[*next].cost / at.cost));
        rest += ".";
    }
    return described(*knee) + fmt::format("; nothing within {:g} \u00d7 is a quarter better. {}", kKneeCost, rest);
}

std::vector<BestRow> best_rows(const FrontierPlot& plot) {
    std::vector<BestRow> rows;
    if (!plot.base_cost) return rows;
    const std::vector<Dot> dots = dots_of(plot);
    for (const double multiple : kCostMultiples)
        rows.push_back({multiple, best_within(dots, multiple * *plot.base_cost)});
    return rows;
}

FrontierDrawing frontier_drawing(const FrontierPlot& plot, const PlotPage& page) {
    return Layout(plot, page).drawing();
}

}  // namespace si
