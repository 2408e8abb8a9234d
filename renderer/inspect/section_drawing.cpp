#include "renderer/inspect/section_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "renderer/base/lengths_text.h"

namespace si {
namespace {

constexpr std::array<InkColour, kInks> kColours{{
    {"paper", {251, 250, 246}, {27, 28, 30}},       {"text", {29, 29, 31}, {230, 229, 226}},
    {"muted", {92, 92, 96}, {169, 169, 166}},       {"grid", {214, 210, 202}, {60, 61, 64}},
    {"shade", {72, 96, 150}, {104, 140, 210}},      {"step", {38, 86, 178}, {126, 172, 255}},
    {"surface", {29, 29, 31}, {230, 229, 226}},     {"plane", {110, 104, 92}, {158, 152, 140}},
    {"ray", {138, 92, 0}, {236, 190, 96}},          {"lit", {240, 196, 64}, {255, 244, 190}},
    {"dark", {60, 104, 196}, {92, 146, 236}},       {"self", {190, 78, 0}, {255, 150, 84}},
    {"compared-lit", {138, 92, 0}, {236, 190, 96}}, {"compared-dark", {60, 104, 196}, {92, 146, 236}},
    {"offset", {176, 40, 116}, {244, 130, 178}},    {"bias", {112, 52, 184}, {196, 160, 255}},
    {"window", {0, 112, 76}, {70, 214, 160}},       {"no-window", {190, 70, 0}, {255, 150, 84}},
    {"occluder", {176, 24, 40}, {255, 128, 120}},   {"moments", {0, 108, 124}, {96, 212, 224}},
}};

constexpr std::array<LegendRow, 13> kLegend{{
    {Mark::Kind::Line, Ink::Step, false, "stored depths, one step per texel"},
    {Mark::Kind::Area, Ink::Shade, false, "in shadow, by the map"},
    {Mark::Kind::Line, Ink::Surface, false, "first surface from the light, by rays"},
    {Mark::Kind::Line, Ink::Plane, true, "the surface's plane"},
    {Mark::Kind::Line, Ink::ComparedLit, true, "compared with the texel's depth: lit"},
    {Mark::Kind::Line, Ink::ComparedDark, true, "compared with the texel's depth: in shadow"},
    {Mark::Kind::Area, Ink::Window, false, "right depth biases"},
    {Mark::Kind::Area, Ink::NoWindow, false, "no bias is right"},
    {Mark::Kind::Area, Ink::Lit, false, "tap lit"},
    {Mark::Kind::Area, Ink::Dark, false, "tap in shadow"},
    {Mark::Kind::Area, Ink::Self, false, "tap in shadow by the surface itself"},
    {Mark::Kind::Line, Ink::Moments, true, "mean of the depths"},
    {Mark::Kind::Area, Ink::Moments, false, "one standard deviation to each side of the mean"},
}};

/// Viewport: a rectangle in metres and its position and scale in pixels.
struct Viewport {
    glm::dvec2 lo{0}, hi{1};  ///< metres; y towards the light
    double x = 0, bottom = 0, across = 1, along = 1;
    glm::dvec2 px(const glm::dvec2& m) const { return {x + (m.x - lo.x) * across, bottom - (m.y - lo.y) * along}; }
    bool holds(const glm::dvec2& m) const { return m.x >= lo.x && m.x <= hi.x && m.y >= lo.y && m.y <= hi.y; }
};

/// Clips a line to a rectangle (Liang, Barsky, A New Concept and Method for Line Clipping, 1984).
std::optional<std::pair<glm::dvec2, glm::dvec2>> clipped(glm::dvec2 a, glm::dvec2 b, const Viewport& v) {
    double from = 0, to = 1;
    const glm::dvec2 d = b - a;
    for (int i = 0; i < 2; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double p = side * d[i], q = side > 0 ? v.hi[i] - a[i] : a[i] - v.lo[i];
            if (p == 0 && q < 0) return {};
            if (p < 0) from = std::max(from, q / p);
            if (p > 0) to = std::min(to, q / p);
        }
    if (!(from <= to)) return {};
    return std::pair{a + from * d, a + to * d};
}

/// Clips a convex area to a rectangle (Sutherland, Hodgman, Reentrant Polygon Clipping, 1974).
std::vector<glm::dvec2> clipped(std::vector<glm::dvec2> area, const Viewport& v) {
    for (int i = 0; i < 2; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double edge = side > 0 ? v.hi[i] : v.lo[i];
            const auto inside = [&](const glm::dvec2& p) { return side * (edge - p[i]) >= 0; };
            std::vector<glm::dvec2> out;
            for (std::size_t k = 0; k < area.size(); ++k) {
                const glm::dvec2 a = area[k], b = area[(k + 1) % area.size()];
                if (inside(a)) out.push_back(a);
                if (inside(a) != inside(b)) out.push_back(a + (b - a) * ((edge - a[i]) / (b[i] - a[i])));
            }
            area = std::move(out);
        }
    return area;
}

double pixels_to(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 d = b - a;
    const double square = glm::dot(d, d);
    const double share = square > 0 ? std::clamp(glm::dot(at - a, d) / square, 0.0, 1.0) : 0;
    return glm::length(at - a - share * d);
}

bool lies_in(const glm::dvec2& at, const std::vector<glm::dvec2>& convex) {
    bool left = false, right = false;
    for (std::size_t i = 0; i < convex.size(); ++i) {
        const glm::dvec2 side = convex[(i + 1) % convex.size()] - convex[i], to = at - convex[i];
        const double turn = side.x * to.y - side.y * to.x;
        left |= turn > 0;
        right |= turn < 0;
    }
    return !(left && right);
}

/// Returns the distance from a point to a mark in pixels: `inside` within an area, infinite outside areas and for
/// texts.
double pixels_to(const Mark& mark, const glm::dvec2& at, double inside) {
    double least = std::numeric_limits<double>::infinity();
    if (mark.kind == Mark::Kind::Area) return lies_in(at, mark.points) ? inside : least;
    if (mark.kind == Mark::Kind::Dot) return std::max(glm::length(at - mark.points[0]) - mark.width, 0.0);
    for (std::size_t i = 0; i + 1 < mark.points.size(); ++i)  // a text has one point
        least = std::min(least, pixels_to(at, mark.points[i], mark.points[i + 1]));
    return least;
}

/// Rounds a length down to 1, 2 or 5 times a power of ten.
double round_length(double max_length) {
    const double power = std::pow(10, std::floor(std::log10(max_length)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= max_length) return digit * power;
    return power;
}

class SectionDrawer {
public:
    SectionDrawer(const Section& section, const SectionPage& page) : s_(section), page_(page), em_(page.em) {
        out_.width = page.width;
        out_.height = page.height;
    }

    SectionDrawing draw() {
        const double margin = 0.8 * em_;
        double top = margin;
        if (page_.captions) {
            area({{0, 0}, {page_.width, 0}, {page_.width, page_.height}, {0, page_.height}}, Ink::Paper, 1);
            top = header(margin);
        }
        if (!s_.shadowed) {
            if (!page_.captions) words({margin, top + em_}, "No map tests this pixel.", Ink::Muted);
            if (page_.captions) out_.height = top + margin;
            resize_paper();
            return std::move(out_);
        }
        frame(margin, top);
        columns();
        steps();
        moments();
        reference();
        window();
        ray();
        comparison();
        taps();
        scales();
        place_labels();
        gather_legend();  // before its own swatches are marks, too
        if (page_.captions) legend(margin);
        resize_paper();
        return std::move(out_);
    }

private:
    /// Priority of a label; low drawings drop the last first.
    enum class Need { Always, Bias, Rest };
    struct Label {
        glm::dvec2 at;
        std::string text;
        Ink ink;
        Need need;
        std::vector<std::string> lines{};  ///< the text, broken where the page is too narrow
        double y = 0;                      ///< middle of the first line
    };
    const Section& s_;
    const SectionPage& page_;
    const double em_;
    SectionDrawing out_;
    Viewport near_;
    std::optional<Viewport> far_;
    double left_ = 0, right_ = 0, top_ = 0, bottom_ = 0, below_ = 0;
    double stretch_ = 1;
    bool surface_apart_ = false;  ///< from the line of its plane in the cut, by pixels that show
    std::vector<Label> labels_;

    double width_of(std::string_view text) const {
        return page_.text_width ? page_.text_width(text) : 0.54 * em_ * double(text.size());
    }

    // Marks in pixels
    Mark& add(Mark mark) { return out_.marks.emplace_back(std::move(mark)); }
    void line(std::vector<glm::dvec2> points, Ink ink, double width, bool dashed = false, bool arrow = false) {
        add({.kind = Mark::Kind::Line,
             .ink = ink,
             .points = std::move(points),
             .width = width * em_ / 15,
             .dashed = dashed,
             .arrow = arrow});
    }
    void area(std::vector<glm::dvec2> points, Ink ink, double opacity) {
        if (points.size() > 2)
            add({.kind = Mark::Kind::Area, .ink = ink, .points = std::move(points), .opacity = opacity});
    }
    void dot(const glm::dvec2& at, Ink ink, double radius) {
        add({.kind = Mark::Kind::Dot, .ink = ink, .points = {at}, .width = radius * em_ / 15});
    }
    void words(const glm::dvec2& at, std::string text, Ink ink, bool strong = false,
               Mark::Anchor anchor = Mark::Anchor::Start) {
        add({.kind = Mark::Kind::Text,
             .ink = ink,
             .points = {at},
             .strong = strong,
             .anchor = anchor,
             .text = std::move(text)});
    }
    // Marks in metres, in both viewports
    template <typename Draw>
    void in_viewports(Draw&& draw) {
        draw(near_);
        if (far_) draw(*far_);
    }
    void line_m(const glm::dvec2& a, const glm::dvec2& b, Ink ink, double width, bool dashed = false) {
        in_viewports([&](const Viewport& v) {
            if (const auto part = clipped(a, b, v)) line({v.px(part->first), v.px(part->second)}, ink, width, dashed);
        });
    }
    /// Draws connected lines, clipped to both viewports.
    void polyline_m(const std::vector<glm::dvec2>& points, Ink ink, double width) {
        in_viewports([&](const Viewport& v) {
            std::vector<glm::dvec2> run;
            const auto end = [&] {
                if (run.size() > 1) line(run, ink, width);
                run.clear();
            };
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const auto part = clipped(points[i], points[i + 1], v);
                if (!part) {
                    end();
                    continue;
                }
                if (run.empty()) run.push_back(v.px(part->first));
                run.push_back(v.px(part->second));
                if (part->second != points[i + 1]) end();
            }
            end();
        });
    }
    void area_m(const std::vector<glm::dvec2>& points, Ink ink, double opacity) {
        in_viewports([&](const Viewport& v) {
            std::vector<glm::dvec2> part = clipped(points, v);
            for (glm::dvec2& p : part) p = v.px(p);
            area(std::move(part), ink, opacity);
        });
    }
    std::optional<glm::dvec2> seen(const glm::dvec2& m) const {
        if (near_.holds(m)) return near_.px(m);
        if (far_ && far_->holds(m)) return far_->px(m);
        return {};
    }
    /// Adds a label at the right margin with a leader to a point of the drawing.
    void label(const glm::dvec2& m, std::string text, Ink ink, Need need) {
        if (const auto at = seen(m)) labels_.push_back({*at, std::move(text), ink, need});
    }

    /// Breaks a text between words into lines of at most `width` pixels; a longer word is not broken.
    std::vector<std::string> lines_of(const std::string& text, double width) const {
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < text.size();) {
            const std::size_t end = std::min(text.find(' ', i), text.size());
            const std::string word = text.substr(i, end - i);
            if (!lines.empty() && width_of(lines.back() + " " + word) <= width)
                lines.back() += " " + word;
            else
                lines.push_back(word);
            i = end + 1;
        }
        return lines;
    }

    /// Draws a paragraph with line breaks. @return top of the next line, pixels
    double paragraph(double x, double y, double width, const std::string& text, Ink ink) {
        for (const std::string& line_of_words : lines_of(text, width)) {
            words({x, y + em_}, line_of_words, ink);
            y += 1.35 * em_;
        }
        return y;
    }

    double header(double margin) {
        std::string title = s_.lit ? "Lit" : "In shadow";
        if (s_.classified) {
            title += s_.lit == s_.reference_lit ? ", as in the reference"
                     : s_.reference_lit         ? ", lit in the reference"
                                                : ", in shadow in the reference";
            if (!s_.artefact.empty()) title += ": " + s_.artefact;
        }
        words({margin, margin + em_}, title, Ink::Text, true);
        return paragraph(margin, margin + 1.6 * em_, page_.width - 2 * margin, s_.verdict, Ink::Text) + 0.6 * em_;
    }

    bool is_near(const Section::Step& step) const {
        const double off = std::abs(step.texel - s_.lookup_texel);
        return step.in_map && off <= std::max(1.0, s_.cut.reach_texels) &&
               (step.meets == KernelTap::Meets::Own || step.meets == KernelTap::Meets::Farther);
    }

    /// Returns true when rays are so oblique to the map that a texel across them differs from one along the map, in
    /// which bias is counted.
    bool aslant() const { return s_.texel_long_m - s_.texel_m > 0.005 * s_.texel_m; }
    std::string bias_text(const DepthShift& a) const {
        return aslant() ? fmt::format("{} = {}", texels_text(a.texels), metres_text(a.metres)) : texels_text(a.texels);
    }
    /// Returns the point on the surface's light ray at a distance in metres.
    glm::dvec2 on_ray(double metres) const { return metres * s_.light_ray; }
    /// Returns true when the equivalent depth bias differs from the drawn shift: with a normal offset or polygon
    /// offset.
    bool marks_equivalent_bias() const {
        return s_.has_window && (glm::length(s_.moved) > 0.02 * s_.texel_m || s_.raster.depth != 0);
    }

    /// Chooses scale and viewports: one for the comparison, and one above a break for distant occluders.
    void frame(double margin, double top) {
        const double gutter = std::min(18 * em_, 0.42 * page_.width);
        left_ = margin;
        right_ = page_.width - margin - gutter;
        top_ = top;
        bottom_ = page_.captions ? std::max(page_.height - 9 * em_, top + 16 * em_) : page_.height - 4.1 * em_;
        double lo = 0, hi = 0;
        std::vector<double> far;
        const auto show = [&](double y) {
            if (std::isfinite(y)) {
                lo = std::min(lo, y);
                hi = std::max(hi, y);
            }
        };
        show(s_.moved.y);
        show(s_.compared.y);
        if (s_.has_window) show(on_ray(s_.window_from).y);
        for (const Section::Step& step : s_.steps) {
            if (is_near(step) && step.meets == KernelTap::Meets::Own) {
                show(step.from.y);
                show(step.to.y);
            }
            if (step.in_map && step.meets == KernelTap::Meets::Nearer) far.push_back(std::max(step.from.y, step.to.y));
        }
        if (s_.occluder) far.push_back(s_.occluder->y);
        if (s_.has_window && std::isfinite(s_.window_to)) far.push_back(on_ray(s_.window_to).y);
        // Below the window's near end, only the mark of the equivalent bias shows if the bias is enough.
        if (marks_equivalent_bias() && s_.shift.metres < s_.window_from && s_.has.metres < 3 * std::max(hi, -lo))
            show(on_ray(s_.has.metres).y);
        if (s_.moments) {
            const double spread = std::isnan(s_.moments->spread) ? 0 : s_.moments->spread;
            far.push_back(s_.moments->mean + spread);
            far.push_back(s_.moments->mean - spread);
        }
        const double texel = s_.texel_m;
        const double content = std::max(hi - lo, 0.15 * texel);
        lo -= 0.25 * content;
        hi += 0.25 * content;
        const double farthest = far.empty() ? hi : *std::max_element(far.begin(), far.end());
        // With moments, the range between is needed, so there is no break.
        out_.broken = !s_.moments && farthest > hi + 1.5 * (hi - lo) && farthest > hi + 2 * texel;
        if (!out_.broken && !far.empty()) {
            hi = std::max(hi, farthest + 0.12 * (farthest - lo));
            const double deepest = *std::min_element(far.begin(), far.end());
            if (deepest < lo) lo = deepest - 0.1 * (hi - deepest);
        }
        double x0 = -0.5 * texel, x1 = 0.5 * texel;
        for (const Section::Step& step : s_.steps) {
            x0 = std::min(x0, step.compared_from.x);
            x1 = std::max(x1, step.compared_to.x);
        }
        x0 = std::max(x0, -3.0 * kProbeRowReachTexels * texel);
        x1 = std::min(x1, 3.0 * kProbeRowReachTexels * texel);
        const double height = bottom_ - top_, high = out_.broken ? 0.70 * height : height;
        const double across = (right_ - left_) / (x1 - x0);
        const double fits = high / (hi - lo) / across;
        // The drawing is true to scale unless that would cut it or leave most of it empty.
        stretch_ = fits > 4     ? round_length(fits)
                   : fits >= 1  ? 1
                   : fits > 0.1 ? 1 / std::ceil(1 / fits)
                                : round_length(fits);
        const double along = stretch_ * across, free_height = high / along - (hi - lo);
        lo -= 0.4 * free_height;
        hi = lo + high / along;
        near_ = {{x0, lo}, {x1, hi}, left_, bottom_, across, along};
        if (out_.broken) {
            std::erase_if(far, [&](double y) { return y <= hi; });
            const auto [least, most] = std::minmax_element(far.begin(), far.end());
            const double from = *least, to = *most, room = std::max(0.3 * (to - from), 0.5 * texel);
            const double strip = 0.24 * height;
            const double begin = std::max(from - room, hi), end = to + room;
            far_ = Viewport{{x0, begin}, {x1, end}, left_, top_ + strip, across, strip / (end - begin)};
        }
        out_.across = across;
        out_.along = along;
        const glm::dvec2 zero = near_.px({0, 0});
        out_.zero_x = zero.x;
        out_.zero_y = zero.y;
        below_ = bottom_;
    }

    /// Returns a length in metres that leads from any point out of the drawing.
    double outside_length() const { return 4 * (near_.hi.y - near_.lo.y) + (far_ ? far_->hi.y - near_.lo.y : 0); }

    void columns() {
        for (const Section::Step& step : s_.steps) {
            line_m(step.from - step.from_ray * outside_length(), step.from + step.from_ray * outside_length(),
                   Ink::Grid, 0.8);
            if (&step == &s_.steps.back())
                line_m(step.to - step.to_ray * outside_length(), step.to + step.to_ray * outside_length(), Ink::Grid,
                       0.8);
        }
        if (far_) {  // the break
            const double y = 0.5 * (near_.px(near_.hi).y + far_->px(far_->lo).y), h = 0.22 * em_;
            std::vector<glm::dvec2> zigzag;
            bool up = false;
            for (double x = left_; x <= right_; x += 0.6 * em_, up = !up) zigzag.push_back({x, y + (up ? -h : h)});
            line(zigzag, Ink::Muted, 0.8);
        }
    }

    void steps() {
        const auto shows = [](const Section::Step& s) { return s.in_map && s.meets != KernelTap::Meets::Nothing; };
        for (const Section::Step& step : s_.steps)
            if (shows(step))
                area_m({step.from, step.to, step.to - step.to_ray * outside_length(),
                        step.from - step.from_ray * outside_length()},
                       Ink::Shade, 0.2);
        for (std::size_t i = 0; i < s_.steps.size(); ++i) {
            const Section::Step& step = s_.steps[i];
            if (!shows(step)) continue;
            line_m(step.from, step.to, Ink::Step, 2.6);
            if (i + 1 < s_.steps.size() && shows(s_.steps[i + 1]))
                line_m(step.to, s_.steps[i + 1].from, Ink::Step, 1.2);
        }
        if (const Section::Step* own = s_.lookup_step(); own && shows(*own)) {
            const glm::dvec2 side = own->to;
            label(side,
                  fmt::format("stored in texel {}, {}", s_.cut.axis == 0 ? own->texel : s_.row,
                              s_.cut.axis == 0 ? s_.row : own->texel),
                  Ink::Step, Need::Rest);
        }
    }

    void moments() {
        if (!s_.moments) return;
        const double reach = std::max(s_.cut.reach_texels, 0.5) * s_.texel_m, x = s_.moved.x, y = s_.moments->mean;
        const double spread = s_.moments->spread;
        if (spread > 0)
            area_m({{x - reach, y - spread}, {x + reach, y - spread}, {x + reach, y + spread}, {x - reach, y + spread}},
                   Ink::Moments, 0.2);
        line_m({x - reach, y}, {x + reach, y}, Ink::Moments, 2, true);
        label({std::min(x + reach, near_.hi.x), y},
              spread > 0 ? fmt::format("mean depth ± {}", metres_text(spread)) : "mean depth", Ink::Moments,
              Need::Bias);
    }

    void reference() {
        const glm::dvec2 far = s_.surface_along * 4.0 * (near_.hi.x - near_.lo.x + near_.hi.y - near_.lo.y);
        double missed = std::numeric_limits<double>::infinity();
        if (const auto part = clipped(s_.surface_at - far, s_.surface_at + far, near_)) {
            const glm::dvec2 a = near_.px(part->first), b = near_.px(part->second);
            line({a, b}, Ink::Plane, 1.2, true);
            missed = pixels_to(near_.px({0, 0}), a, b);
        }
        // A surface off the cut: parallel cuts of a plane are parallel lines.
        surface_apart_ = missed > 0.15 * em_;
        if (surface_apart_) {
            const glm::dvec2 piece =
                s_.surface_along * (1.5 * s_.texel_m / std::max(std::abs(s_.surface_along.x), 0.2));
            line_m(-piece, piece, Ink::Plane, 1.2, true);
        }
        for (const auto& run : s_.profile) polyline_m(run, Ink::Surface, 2);
    }

    void window() {
        if (!s_.has_window) return;
        const double end = std::isfinite(s_.window_to) ? s_.window_to : outside_length();
        const bool open = s_.window_open();
        const Ink ink = open ? Ink::Window : Ink::NoWindow;
        // The window lies next to the surface's ray, so that both are visible.
        const glm::dvec2 half(0.3 * em_ / near_.across, 0), aside(-0.75 * em_ / near_.across, 0);
        const auto at = [&](double metres) { return aside + on_ray(metres); };
        const glm::dvec2 lower = at(std::min(s_.window_from, end)), upper = at(std::max(s_.window_from, end));
        area_m({lower - half, lower + half, upper + half, upper - half}, ink, 0.55);
        const auto tick = [&](double metres, Ink of, double reach) {
            const glm::dvec2 side(reach * em_, 0);
            if (const auto px = seen(at(metres))) line({*px - side, *px + side}, of, 2);
        };
        tick(s_.window_from, ink, 0.45);
        tick(end, ink, 0.45);
        label(at(s_.window_from), "needs " + bias_text(s_.least) + (aslant() ? "" : " of bias"), ink, Need::Bias);
        if (std::isfinite(s_.window_to))
            label(at(s_.window_to), open ? "more bias loses the shadow" : "no bias is right", ink, Need::Rest);
        if (!marks_equivalent_bias()) return;
        tick(s_.has.metres, Ink::Bias, 0.6);
        label(at(s_.has.metres), fmt::format("has {}", bias_text(s_.has)), Ink::Bias, Need::Bias);
    }

    void ray() {
        const glm::dvec2 end = s_.light_ray * outside_length();
        line_m({0, 0}, end, Ink::Ray, 1.4, true);
        const Viewport& v = far_ ? *far_ : near_;
        if (const auto part = clipped(glm::dvec2(0), end, v)) {
            const glm::dvec2 at = v.px(part->second);
            // The light is outside the picture: rays come from above.
            line({at, at + glm::dvec2(0, 1.3 * em_)}, Ink::Ray, 1.4, false, true);
            labels_.push_back({at + glm::dvec2(0, 0.5 * em_),
                               s_.light == LightType::Directional
                                   ? "from the light"
                                   : fmt::format("from the light, {}", metres_text(s_.light_m)),
                               Ink::Ray, Need::Rest});
        }
        if (!s_.occluder) return;
        if (const auto at = seen(*s_.occluder)) {
            line({*at - glm::dvec2(0.7 * em_, 0), *at + glm::dvec2(0.7 * em_, 0)}, Ink::Occluder, 3.2);
            dot(*at, Ink::Occluder, 3.5);
        }
        label(*s_.occluder,
              fmt::format("{} {} nearer", s_.occluder_in_map ? "occluder" : "lost caster", metres_text(s_.occluder_m)),
              Ink::Occluder, Need::Always);
    }

    /// Returns the part of the normal offset that lies in the cut, in words; empty: all of it.
    std::string offset_in_cut() const {
        const double drawn = glm::length(s_.moved), whole = std::abs(s_.normal_offset_m);
        return std::abs(drawn - whole) <= 1e-3 * whole ? "" : metres_text(drawn);
    }

    void comparison() {
        for (const Section::Step& step : s_.steps) {
            const bool read = step.weight > 0 || (s_.steps.size() > 0 && step.texel == s_.lookup_texel);
            if (read && step.in_map && !s_.moments && s_.tested)
                line_m(step.compared_from, step.compared_to, step.lit ? Ink::ComparedLit : Ink::ComparedDark, 1.6,
                       true);
        }
        const glm::dvec2 point = near_.px({0, 0}), moved = near_.px(s_.moved), compared = near_.px(s_.compared);
        if (glm::length(moved - point) > 0.15 * em_) {
            line({point, moved}, Ink::Offset, 2, false, true);
            label(0.5 * s_.moved,
                  offset_in_cut().empty() ? "normal offset " + metres_text(s_.normal_offset_m)
                                          : fmt::format("offset {} in the cut", offset_in_cut()),
                  Ink::Offset, Need::Bias);
        }
        for (const Section::Term& term : s_.terms) {
            const glm::dvec2 a = near_.px(term.from), b = near_.px(term.to);
            const double length = glm::length(b - a), room = &term == &s_.terms.back() ? 0.4 * em_ : 0;
            const bool has_head = length > 2 * room + 0.3 * em_;  // the arrow ends before the dot
            line({a, has_head ? b - (b - a) * (room / length) : b}, Ink::Bias, 2.2, false, has_head);
            label(0.5 * (term.from + term.to), fmt::format("{} {}", term.name, texels_text(term.amount.texels)),
                  Ink::Bias, Need::Bias);
        }
        dot(point, Ink::Text, 4.5);
        dot(point, Ink::Paper, 2.4);
        dot(compared, Ink::Text, 6);
        dot(compared, !s_.tested ? Ink::Paper : s_.lit ? Ink::Lit : Ink::Dark, 4.4);
        label({0, 0}, fmt::format("surface, {:.0f}° from the light", s_.theta_rad * 180 / M_PI), Ink::Text,
              Need::Always);
        label(s_.compared,
              !s_.tested                               ? std::string("not compared")
              : s_.visibility > 0 && s_.visibility < 1 ? fmt::format("compared: {:.0f} % lit", 100 * s_.visibility)
                                                       : fmt::format("compared: {}", s_.lit ? "lit" : "in shadow"),
              Ink::Text, Need::Always);
    }

    /// Draws the result of each texel's comparison under its column.
    void taps() {
        double heaviest = 0;
        for (const Section::Step& step : s_.steps) heaviest = std::max(heaviest, step.weight);
        const double y0 = bottom_ + 0.3 * em_, y1 = y0 + 0.8 * em_;
        below_ = y1;
        if (heaviest == 0 || !s_.tested) return;
        for (const Section::Step& step : s_.steps) {
            if (step.weight == 0) continue;
            const double x0 = std::max(near_.px(step.compared_from).x + 1, left_);
            const double x1 = std::min(near_.px(step.compared_to).x - 1, right_);
            if (x1 <= x0) continue;
            const Ink ink = step.lit ? Ink::Lit : step.meets == KernelTap::Meets::Own ? Ink::Self : Ink::Dark;
            area({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, ink, 0.35 + 0.65 * step.weight / heaviest);
            line({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, Ink::Muted, 0.6);
        }
        const std::string name = s_.cut.axis == 0 ? "taps in this row" : "taps in this column";
        const double x = right_ + 0.8 * em_;
        const bool fits = x + width_of("the kernel's " + name) <= page_.width;
        words({x, y1 - 0.02 * em_}, fits ? "the kernel's " + name : name, Ink::Muted);
    }

    void scales() {
        const double y = below_ + 0.9 * em_;
        const auto bar = [&](double x, double metres, const std::string& text) {
            const double end = x + metres * near_.across, h = 0.25 * em_;
            line({{x, y - h}, {x, y + h}}, Ink::Muted, 1.2);
            line({{end, y - h}, {end, y + h}}, Ink::Muted, 1.2);
            line({{x, y}, {end, y}}, Ink::Muted, 1.2);
            words({end + 0.5 * em_, y + 0.35 * em_}, text, Ink::Muted);
            return end + 0.5 * em_ + width_of(text) + 1.5 * em_;
        };
        const double room = 0.2 * (right_ - left_) / near_.across;
        const double texels = std::max(1.0, round_length(room / s_.texel_m));
        const double x = bar(left_, texels * s_.texel_m,
                             fmt::format("{} = {}", texels_text(texels), metres_text(texels * s_.texel_m)));
        const double metres = round_length(room);
        const double end = bar(x, metres, metres_text(metres));
        const std::string scale = stretch_ == 1  ? out_.broken ? "to scale below the break" : "to scale"
                                  : stretch_ > 1 ? fmt::format("depth drawn {:g} times larger", stretch_)
                                                 : fmt::format("depth drawn {:g} times smaller", 1 / stretch_);
        const bool fits = end + width_of(scale) <= page_.width;
        const double below = fits ? 0 : 1.25 * em_;
        words({fits ? end : left_, y + below + 0.35 * em_}, scale, Ink::Muted);
        below_ = y + below + 0.6 * em_;
    }

    /// Places the labels from top to bottom without overlap. Labels without room in the page's width are broken.
    void place_labels() {
        if (labels_.empty()) return;
        std::stable_sort(labels_.begin(), labels_.end(),
                         [](const Label& a, const Label& b) { return a.at.y < b.at.y; });
        const double x = right_ + 0.8 * em_;
        for (Label& l : labels_) l.lines = lines_of(l.text, page_.width - x);
        const double first = top_ + 0.5 * em_, last = bottom_ - 0.3 * em_, least_height = 1.05 * em_;
        const auto room = std::size_t(std::max(std::floor((last - first) / least_height), 0.0)) + 1;
        const auto lines = [&] {
            std::size_t count = 0;
            for (const Label& l : labels_) count += l.lines.size();
            return count;
        };
        while (labels_.size() > 1 && lines() > room) labels_.erase(std::ranges::max_element(labels_, {}, &Label::need));
        const double line_height = std::min(1.3 * em_, (last - first) / double(std::max<std::size_t>(lines() - 1, 1)));
        const double broken_height = std::min(line_height, 1.15 * em_);  // of lines of the same label
        const auto height = [&](const Label& l) { return line_height + broken_height * double(l.lines.size() - 1); };
        double y = first;
        for (Label& l : labels_) y = (l.y = std::max(l.at.y, y)) + height(l);
        double most = last + line_height;
        for (auto l = labels_.rbegin(); l != labels_.rend(); ++l) most = l->y = std::min(l->y, most - height(*l));
        for (const Label& l : labels_) {
            line({l.at, {right_ + 0.1 * em_, l.y}, {x - 0.2 * em_, l.y}}, Ink::Muted, 0.5);
            double base = l.y + 0.35 * em_;
            for (const std::string& text : l.lines) {
                words({x, base}, text, l.ink);
                base += broken_height;
            }
        }
    }

    void gather_legend() {
        std::ranges::copy_if(kLegend, std::back_inserter(out_.legend), [&](const LegendRow& row) {
            return std::ranges::any_of(out_.marks, [&](const Mark& mark) { return row.explains(mark); });
        });
    }

    void legend(double margin) {
        double x = margin, y = below_ + 0.5 * em_;
        for (const LegendRow& row : out_.legend) {
            const double width = 2.2 * em_ + width_of(row.text) + 1.2 * em_;
            if (x > margin && x + width > page_.width) {
                x = margin;
                y += 1.4 * em_;
            }
            add(legend_swatch(row, {x, y + 0.6 * em_}, em_));
            words({x + 2.2 * em_, y + 0.95 * em_}, std::string(row.text), Ink::Text);
            x += width;
        }
        if (!out_.legend.empty()) y += 1.6 * em_;
        std::string note =
            fmt::format("Cut along the map's {}, texels {} to {} of {} {}", s_.cut.axis == 0 ? "u" : "v", s_.cut.first,
                        s_.cut.first + s_.cut.count - 1, s_.cut.axis == 0 ? "row" : "column", s_.row);
        if (std::abs(s_.row_offset_texels) >= 0.005)
            note += fmt::format(", whose middle lies {:.2f} texels off the cut", std::abs(s_.row_offset_texels));
        note += ".";
        if (std::abs(s_.surface_offset_texels) >= 0.005) {
            note +=
                fmt::format(" The surface itself lies {} off the cut", texels_text(std::abs(s_.surface_offset_texels)));
            if (!offset_in_cut().empty())
                note += fmt::format(", as of {} of normal offset the cut holds {}", metres_text(s_.normal_offset_m),
                                    offset_in_cut());
            note += surface_apart_ ? "; the short dashes are its plane there." : ".";
        }
        if (aslant())
            note += fmt::format(" Rays meet the map aslant: along it, as bias counts them, texels are {} long.",
                                metres_text(s_.texel_long_m));
        if (s_.raster.depth != 0)
            note += fmt::format(" Polygon offset has moved the stored depths by {}.", texels_text(s_.raster.texels));
        if (s_.moments)
            note += fmt::format(" At most {:.0f} % can be lit by mean and spread.", 100 * s_.moments->bound);
        y = paragraph(margin, y, page_.width - 2 * margin, note, Ink::Muted);
        out_.height = y + margin;
    }

    /// Fits the height of the paper to its content.
    void resize_paper() {
        if (!page_.captions || out_.marks.empty()) return;
        out_.marks.front().points = {{0, 0}, {out_.width, 0}, {out_.width, out_.height}, {0, out_.height}};
    }
};

}  // namespace

const InkColour& ink_colour(Ink ink) {
    return kColours[std::size_t(ink)];
}

SectionDrawing draw_section(const Section& section, const SectionPage& page) {
    return SectionDrawer(section, page).draw();
}

Mark legend_swatch(const LegendRow& row, const glm::dvec2& left, double em) {
    const double end = left.x + kSwatchEms * em, half = 0.35 * em;
    if (row.kind == Mark::Kind::Area)
        return {
            .kind = row.kind,
            .ink = row.ink,
            .points = {{left.x, left.y - half}, {end, left.y - half}, {end, left.y + half}, {left.x, left.y + half}},
            .opacity = row.ink == Ink::Shade ? 0.25 : 0.75};
    return {.kind = row.kind,
            .ink = row.ink,
            .points = {left, {end, left.y}},
            .width = 2.2 * em / 15,
            .dashed = row.dashed};
}

const LegendRow* legend_row_at(const SectionDrawing& drawing, const glm::dvec2& at, double reach) {
    const LegendRow* row = nullptr;
    double nearest = reach;
    for (const Mark& mark : drawing.marks) {  // the topmost of equally near marks
        if (mark.ink == Ink::Paper || mark.ink == Ink::Grid || mark.ink == Ink::Muted) continue;
        const double pixels = pixels_to(mark, at, reach);
        if (pixels > nearest) continue;
        nearest = pixels;
        const auto found = std::ranges::find_if(drawing.legend, [&](const LegendRow& r) { return r.explains(mark); });
        row = found == drawing.legend.end() ? nullptr : &*found;
    }
    return row;
}

}  // namespace si
