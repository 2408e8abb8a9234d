#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/base/output.h"
#include "app/report/frontier_svg.h"
#include "app/report/html_page.h"
#include "app/report/preset_report.h"
#include "app/report/xml_text.h"
#include "app/session/preset_diff.h"
#include "renderer/base/command_text.h"
#include "renderer/base/lengths_text.h"
#include "renderer/measure/frontier.h"
#include "renderer/reference/artefact_picture.h"

namespace si {
namespace {

std::string element(const char* name, const std::string& text) {
    return fmt::format("<{0}>{1}</{0}>\n", name, xml_text(text));
}

/// Formats an error metric for a cell of the table.
std::string metric_text(const Metric& metric, double value) {
    if (std::isnan(value)) return "–";
    if (metric.unit == kShareOfPixels) return fmt::format("{:.4f} %", 100 * value);
    if (metric.unit == "px") return fmt::format("{:.3f} px", value);
    return fmt::format("{:.5f}", value);
}

/// Formats one row of the table of numbers. The least distance from the best value is bold.
/// @param texts one a subject @param distances one a subject, NaN: not ranked
std::string number_row(const std::string& label, const std::string& help, const std::vector<std::string>& texts,
                       const std::vector<double>& distances, bool part) {
    double best = std::numeric_limits<double>::infinity();
    bool differ = false;
    for (const double d : distances) {
        differ |= std::isfinite(best) && std::isfinite(d) && d != best;
        if (d < best) best = d;
    }
    std::string row =
        fmt::format("<tr{}><td title=\"{}\">{}</td>", part ? " class=\"part\"" : "", xml_text(help), xml_text(label));
    for (std::size_t i = 0; i < texts.size(); ++i)
        row += fmt::format("<td class=\"number{}\">{}</td>", differ && distances[i] == best ? " best" : "",
                           xml_text(texts[i]));
    return row + "</tr>\n";
}

/// Formats a time with the 95 % interval of its median.
std::string median_text(const Spread& time, std::string_view unit) {
    return fmt::format("{} {} ({} to {})", digits_text(time.median), unit, digits_text(time.median_low),
                       digits_text(time.median_high));
}

/// Returns a value of each case. @param of function of a ReportedCase
template <class Of>
auto each_case(const PresetReport& report, const Of& of) {
    std::vector<decltype(of(report.cases.front()))> out;
    for (const ReportedCase& c : report.cases) out.push_back(of(c));
    return out;
}

/// Formats the rows of the shadows' times: under a moving and a still light, and as multiples of the base.
std::string shadow_time_rows(const PresetReport& report) {
    const auto row = [&](const char* label, const char* help, Spread ShadowTime::*of) {
        std::vector<std::string> texts;
        std::vector<double> times;
        for (const ReportedCase& c : report.cases) {
            const Spread& t = c.shadow.*of;
            const std::string_view unit = time_unit(report.clock);
            const bool bound = below_noise(t);
            texts.push_back(bound ? fmt::format("< {} {}", digits_text(time_or_bound(t)), unit) : median_text(t, unit));
            times.push_back(bound ? std::numeric_limits<double>::quiet_NaN() : t.median);
        }
        return number_row(label, help, texts, times, false);
    };
    std::string html =
        row("Time of the shadows, the light moves",
            "A frame in which this light moves minus the same frame without shadows: median, with its 95 % interval",
            &ShadowTime::moving_ms);
    std::vector<std::string> texts;
    std::vector<double> multiples;
    for (const ReportedCase& c : report.cases) {
        texts.push_back(std::isnan(c.shadow.of_base) ? "–" : fmt::format("{:.2f} ×", c.shadow.of_base));
        multiples.push_back(c.shadow.of_base);
    }
    html += number_row(fmt::format("As a multiple of {}", base_of_costs_name()), "Timed in the same turns", texts,
                       multiples, true);
    return html + row("Time of the shadows, the light is still",
                      "A frame in which the camera moves and maps are kept, minus the same frame without shadows",
                      &ShadowTime::still_ms);
}

std::string number_table(const PresetReport& report) {
    std::string html = "<div class=\"scroll\"><table class=\"numbers\">\n<thead><tr><th></th>";
    for (const ReportSubject& subject : report.subjects)
        html += fmt::format("<th class=\"number\">{}</th>", xml_text(subject.name));
    html += "</tr></thead>\n<tbody>\n";
    const auto metric_row = [&](const Metric& metric, const std::string& label, bool part) {
        const auto values = each_case(report, [&](const ReportedCase& c) { return metric.value(c.classified.error); });
        if (metric.rare && std::ranges::none_of(values, [](double v) { return v > 0; })) return;
        std::vector<std::string> texts;
        std::vector<double> distances;
        for (const double v : values) {
            texts.push_back(metric_text(metric, v));
            distances.push_back(distance_from_best(metric.better, v));
        }
        html += number_row(label, std::string(metric.help), texts, distances, part);
    };
    for (const Metric& metric : metrics()) {
        if (!metric.part_of.empty() || (!metric.member && metric.unit != kShareOfPixels)) continue;
        metric_row(metric, std::string(metric.label), false);
        for (const Metric& part : metrics())
            if (part.part_of == metric.key) metric_row(part, std::string(part.part), true);
    }
    for (const ArtefactStyle& style : artefact_styles()) {
        const auto pixels = each_case(
            report, [&](const ReportedCase& c) { return c.classified.error.artefacts[std::size_t(style.artefact)]; });
        if (std::ranges::all_of(pixels, [](std::size_t n) { return n == 0; })) continue;
        std::vector<std::string> texts;
        for (const std::size_t n : pixels) texts.push_back(fmt::format("{} px", n));
        html += number_row(fmt::format("Wrong pixels: {}", style.label), "Wrong pixels with this cause", texts,
                           std::vector<double>(pixels.begin(), pixels.end()), false);
    }
    if (!report.clock.empty()) {
        html += shadow_time_rows(report);
        std::vector<std::string> texts;
        std::vector<double> medians;
        for (const ReportedCase& c : report.cases) {
            const Spread& t = c.time->total_ms;
            texts.push_back(median_text(t, time_unit(c.time->clock)));
            medians.push_back(t.median);
        }
        html += number_row(fmt::format("Time of a frame {}", cost_row(report.cost).when),
                           "Median, with its 95 % interval within this run", texts, medians, false);
    }
    const auto bytes = each_case(report, [](const ReportedCase& c) { return double(c.classified.cost.map_bytes); });
    std::vector<std::string> texts;
    for (const double b : bytes) texts.push_back(fmt::format("{:.2f} MiB", b / (1 << 20)));
    html += number_row("Memory of shadow maps", "Maps, their copies and light maps", texts, bytes, false);
    return html + "</tbody></table></div>\n";
}

FrontierPlot plot_of_presets(const PresetReport& report) {
    FrontierPlot plot{.cases = {},
                      .spots = {},
                      .forced = {},
                      .cost_title = "time of the shadows in a frame in which the light moves",
                      .error_title = "mean error of visibility",
                      .cost_unit = std::string(time_unit(report.clock)),
                      .base_cost = {},
                      .base_name = base_of_costs_name(),
                      .whole = true};
    for (std::size_t i = 0; i < report.cases.size(); ++i) {
        const ShadowTime& time = report.cases[i].shadow;
        const double error = report.cases[i].classified.error.mae;
        plot.cases.push_back({.of = i,
                              .line = report.subjects[i].name,
                              .place = {},
                              .family = int(i) % kPlotFamilies,
                              .dot = {.cost = time_or_bound(time.moving_ms),
                                      .error = error,
                                      .cost_noise = time.moving_ms.noise(),
                                      .error_noise = 0},
                              .bound = below_noise(time.moving_ms)});
        if (time.forced_ms) plot.forced.push_back({.cost = time_or_bound(*time.forced_ms), .error = error});
    }
    if (!below_noise(report.base->moving_ms)) plot.base_cost = report.base->moving_ms.median;
    return plot;
}

std::string frontier_part(const PresetReport& report) {
    if (!report.base) return {};
    const FrontierPlot plot = plot_of_presets(report);
    const std::vector<bool> on = frontier(dots_of(plot));
    std::string names;
    for (std::size_t i = 0; i < on.size(); ++i)
        if (on[i]) names += (names.empty() ? "" : ", ") + report.subjects[i].name;
    return "<section>\n<h2>Error over time</h2>\n<figure class=\"plot\">\n" + frontier_svg(plot, {.in_page = true}) +
           fmt::format(
               "<figcaption>No other preset here beats in both, beyond noise: {}. Clock: {}; {}.</figcaption>\n",
               xml_text(names), xml_text(report.clock), xml_text(report.renderer)) +
           "</figure>\n</section>\n";
}

std::string difference_part(const PresetReport& report) {
    std::string html;
    const ReportSubject& first = report.subjects.front();
    for (std::size_t i = 1; i < report.subjects.size(); ++i) {
        const ReportSubject& other = report.subjects[i];
        Preset a, b;
        a.settings = first.settings;
        b.settings = other.settings;
        html += element("h3", fmt::format("{} → {}", first.name, other.name));
        const auto differences = preset_differences(a, b);
        if (differences.empty()) {
            html += "<p>No setting differs.</p>\n";
            continue;
        }
        html += "<ul>\n";
        for (const PresetDifference& d : differences)
            html += element("li", d.text + (d.note.empty() ? "" : "; " + d.note));
        html += "</ul>\n";
    }
    return html.empty() ? html : "<section>\n<h2>Differences of settings</h2>\n" + html + "</section>\n";
}

/// Formats a picture with numbered marks at the diagnosed pixels.
std::string marked_picture(const PresetReport& report, const ByteImage& image, const std::vector<ReportedPixel>& pixels,
                           const std::string& caption) {
    const double unit = std::max(report.width, report.height) / 640.0;
    std::string svg = fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\"><image width=\"{0}\" "
        "height=\"{1}\" href=\"{3}\"/>\n",
        report.width, report.height, xml_text(caption), data_uri(png_bytes(image), "image/png"));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const double x = pixels[i].pixel.x + 0.5, y = pixels[i].pixel.y + 0.5, r = 7 * unit;
        for (const char* kind : {"mark-edge", "mark"})
            svg += fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{:.2f}\"/>", kind, x, y, r);
        const bool left = x > report.width - 40 * unit;
        svg += fmt::format("<text class=\"mark-text{}\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\">{}</text>\n",
                           left ? " end" : "", left ? x - 1.4 * r : x + 1.4 * r, std::max(y - r * 0.5, 14 * unit),
                           15 * unit, i + 1);
    }
    return fmt::format("<figure>{}</svg><figcaption>{}</figcaption></figure>\n", svg, xml_text(caption));
}

std::string legend(const ErrorMetrics& error) {
    std::string html;
    for (const ArtefactStyle& style : artefact_styles()) {
        const std::size_t pixels = error.artefacts[std::size_t(style.artefact)];
        if (pixels == 0) continue;
        html += fmt::format(
            "<svg class=\"swatch\" viewBox=\"0 0 1 1\" aria-hidden=\"true\"><rect width=\"1\" height=\"1\" "
            "fill=\"#{:02x}{:02x}{:02x}\"/></svg>{} {} px\n",
            style.rgb[0], style.rgb[1], style.rgb[2], xml_text(std::string(style.label)), pixels);
    }
    return html.empty() ? "<p>No pixel is wrong.</p>\n" : "<p>" + html + "</p>\n";
}

std::string pixel_figure(const ReportedPixel& p, std::size_t number) {
    std::string html = "<figure>\n";
    if (!p.section.empty())
        html += fmt::format("<img alt=\"{}\" src=\"{}\">\n", xml_text("Cross-section of the shadow test: " + p.verdict),
                            data_uri(p.section, "image/svg+xml"));
    html +=
        fmt::format("<p><strong>{}. Pixel {},{}</strong>{}{}</p>\n", number, p.pixel.x, p.pixel.y,
                    p.object.empty() ? "" : ", " + xml_text(p.object), p.cause.empty() ? "" : ": " + xml_text(p.cause));
    if (p.wrong > 0)
        html += element("p", fmt::format("In the middle of the largest cluster of this cause, {} pixel{}.", p.wrong,
                                         p.wrong == 1 ? "" : "s"));
    if (!p.verdict.empty()) html += element("p", p.verdict);
    if (!p.fix.empty()) html += element("p", p.fix);
    return html + "</figure>\n";
}

std::string case_part(const PresetReport& report, std::size_t i) {
    const ReportSubject& subject = report.subjects[i];
    const ReportedCase& c = report.cases[i];
    std::string html = "<section>\n" + element("h2", subject.name);
    if (!subject.title.empty()) html += element("p", subject.title);
    html += "<div class=\"pair\">\n" + marked_picture(report, c.classified.picture, c.pixels, "The lit picture") +
            marked_picture(report, c.classified.artefacts, c.pixels, "Wrong pixels by cause") + "</div>\n";
    html += legend(c.classified.error);
    if (!c.pixels.empty()) {
        html += "<div class=\"drawings\">\n";
        for (std::size_t k = 0; k < c.pixels.size(); ++k) html += pixel_figure(c.pixels[k], k + 1);
        html += "</div>\n";
    }
    for (const std::string& note : c.classified.notes) html += element("p", "Note: " + note);
    return html + "</section>\n";
}

/// Escapes a text of several lines. xml_text() alone would escape the line breaks.
std::string escaped_lines(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += xml_text(text.substr(at, end - at)) + "\n";
        at = end + 1;
    }
    return out;
}

std::string command_part(const PresetReport& report) {
    std::string text = report.command.empty() ? std::string() : report.command + "\n";
    for (std::size_t i = 0; i < report.subjects.size(); ++i) {
        const auto command = [&](const char* name, const std::string& rest) {
            text += fmt::format("shadow-inspector {} {}", name, shell_quoted(report.scene));
            for (const std::string& word : report.subjects[i].options) text += " " + shell_quoted(word);
            text += rest + "\n";
        };
        const std::string size = fmt::format(" --size {}x{}", report.width, report.height);
        text += text.empty() ? "" : "\n";
        command("measure", size + (report.clock.empty() ? std::string(" --no-time")
                                                        : fmt::format(" --cost {}", cost_row(report.cost).key)));
        command("render", fmt::format("{} -o picture-{}.png", size, i + 1));
        for (const ReportedPixel& p : report.cases[i].pixels)
            command("probe", fmt::format("{} --pixel {},{}", size, p.pixel.x, p.pixel.y));
        command("edit", "");
    }
    return "<section>\n<h2>Commands that reproduce it</h2>\n<pre>" + escaped_lines(text) + "</pre>\n</section>\n";
}

}  // namespace

std::string preset_report_html(const PresetReport& report) {
    const std::string title = "Shadow report: " + report.scene;
    const ErrorMetrics& first = report.cases.front().classified.error;
    std::string body = "<header>\n" + element("h1", title);
    body += element("p", fmt::format("{} × {} pixels, {} of them compared with {} reference; {}; shadow-inspector {}",
                                     report.width, report.height, first.counted,
                                     report.subjects.front().settings.truth.area ? "an area" : "a hard",
                                     report.renderer, report.version));
    body += "</header>\n<main>\n" + frontier_part(report) + "<section>\n<h2>Numbers</h2>\n" + number_table(report) +
            "</section>\n" + difference_part(report);
    for (std::size_t i = 0; i < report.cases.size(); ++i) body += case_part(report, i);
    return still_page(title, body + command_part(report) + "</main>", {frontier_svg_style(true)});
}

}  // namespace si
