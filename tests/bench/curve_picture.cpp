// Plots of measured curves, drawn with the editor's plotting code.
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "app/context/headless_context.h"
#include "app/context/imgui_session.h"
#include "renderer/base/error.h"
#include "renderer/gl/handle.h"
#include "tests/bench/curves.h"

// clang-format off
#include <backends/imgui_impl_opengl3.h>
// clang-format on

namespace si {
namespace {

constexpr int kAcross = 3, kPlotWidth = 520, kPlotHeight = 400;
constexpr ImU32 kInk = IM_COL32(210, 210, 210, 255), kFaint = IM_COL32(90, 90, 90, 255);
/// Colours of Okabe and Ito, safe for colour-blind readers.
constexpr ImU32 kColours[] = {IM_COL32(230, 159, 0, 255),   IM_COL32(86, 180, 233, 255),  IM_COL32(0, 158, 115, 255),
                              IM_COL32(240, 228, 66, 255),  IM_COL32(0, 114, 178, 255),   IM_COL32(213, 94, 0, 255),
                              IM_COL32(204, 121, 167, 255), IM_COL32(200, 200, 200, 255), IM_COL32(160, 120, 90, 255)};

struct Plot {
    std::string title;
    double expected = 1;
    std::vector<Curve> curves;
    std::map<std::string, double> slopes;
};

Plot plot_of(const nlohmann::json& run) {
    Plot plot;
    const std::string name = run.at("name").get<std::string>();
    plot.title = name.substr(6, name.find('/', 6) - 6);
    plot.expected = run.at("expected").get<double>();
    std::map<std::string, std::map<double, double>> found;
    for (const auto& [key, value] : run.items()) {
        if (const auto at = key.find('@'); at != std::string::npos)
            found[key.substr(0, at)][std::stod(key.substr(at + 1))] = value.get<double>();
        if (const auto at = key.find(", slope"); at != std::string::npos)
            plot.slopes[key.substr(0, at)] = value.get<double>();
    }
    for (const auto& [curve, points] : found) {
        Curve c{.name = curve, .x = {}, .ms = {}};
        for (const auto& [x, ms] : points) {
            c.x.push_back(x);
            c.ms.push_back(std::max(ms, 1e-3));
        }
        plot.curves.push_back(std::move(c));
    }
    return plot;
}

std::vector<Plot> read_plots(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<Plot> plots;
    try {
        const nlohmann::json all = nlohmann::json::parse(in);
        for (const auto& run : all.at("benchmarks"))
            if (run.at("name").get<std::string>().starts_with("curve/")) plots.push_back(plot_of(run));
    } catch (const nlohmann::json::exception& e) {
        throw Error(fmt::format("{}: {}; write it with --benchmark_filter=^curve/ --benchmark_out={}", file.string(),
                                e.what(), file.string()));
    }
    if (plots.empty()) throw Error(file.string() + ": no curve/ benchmark in it");
    return plots;
}

/// Whole decades that enclose the values.
struct Decades {
    double lo = 1e300, hi = -1e300;
    void add(double v) {
        lo = std::min(lo, std::floor(std::log10(v)));
        hi = std::max(hi, std::ceil(std::log10(v)));
    }
    double share(double v) const { return (std::log10(v) - lo) / std::max(hi - lo, 1.0); }
};

class PlotPainter {
public:
    PlotPainter(ImDrawList& to, ImVec2 corner, const Plot& plot) : to_(to), corner_(corner), plot_(plot) {
        for (const Curve& c : plot.curves) {
            for (const double x : c.x) x_.add(x);
            for (const double y : c.ms) y_.add(y);
        }
    }
    void paint() {
        to_.AddText({corner_.x + kLeft, corner_.y + 8}, kInk, ("milliseconds over " + plot_.title).c_str());
        axis();
        for (std::size_t i = 0; i < plot_.curves.size(); ++i) curve(i);
    }

private:
    static constexpr float kLeft = 54, kTop = 34, kBelow = 30, kRight = 215;
    ImDrawList& to_;
    ImVec2 corner_;
    const Plot& plot_;
    Decades x_, y_;

    ImVec2 at(double x, double ms) const {
        const float width = kPlotWidth - kLeft - kRight, height = kPlotHeight - kTop - kBelow;
        return {corner_.x + kLeft + width * float(x_.share(x)), corner_.y + kTop + height * float(1 - y_.share(ms))};
    }
    void axis() {
        for (double d = y_.lo; d <= y_.hi; ++d) {
            const double ms = std::pow(10, d), end = std::pow(10, x_.hi);
            to_.AddLine(at(std::pow(10, x_.lo), ms), at(end, ms), kFaint);
            to_.AddText({corner_.x + 4, at(end, ms).y - 8}, kInk, fmt::format("{:g}", ms).c_str());
        }
        for (double d = x_.lo; d <= x_.hi; ++d) {
            const double x = std::pow(10, d), bottom = std::pow(10, y_.lo);
            to_.AddLine(at(x, bottom), at(x, std::pow(10, y_.hi)), kFaint);
            to_.AddText({at(x, bottom).x - 8, at(x, bottom).y + 6}, kInk, fmt::format("{:g}", x).c_str());
        }
    }
    void curve(std::size_t i) {
        const Curve& c = plot_.curves[i];
        const ImU32 colour = kColours[i % std::size(kColours)];
        for (std::size_t k = 0; k < c.x.size(); ++k) {
            if (k > 0) to_.AddLine(at(c.x[k - 1], c.ms[k - 1]), at(c.x[k], c.ms[k]), colour, 2);
            to_.AddCircleFilled(at(c.x[k], c.ms[k]), 3, colour);
        }
        const auto slope = plot_.slopes.find(c.name);
        const std::string text = fmt::format("{}\n   slope {:.2f}, work {:g}", c.name,
                                             slope == plot_.slopes.end() ? 0 : slope->second, plot_.expected);
        to_.AddText({corner_.x + kPlotWidth - kRight + 8, corner_.y + kTop + 38 * float(i)}, colour, text.c_str());
    }
};

}  // namespace

void draw_curves(const std::filesystem::path& json, const std::filesystem::path& png) {
    const std::vector<Plot> plots = read_plots(json);
    require_writable(png);
    const int width = kAcross * kPlotWidth, height = int((plots.size() + kAcross - 1) / kAcross) * kPlotHeight;
    const HeadlessContext context;
    ImGuiSession imgui(1);
    const gl::Texture canvas = gl::Texture::create("curves", GL_TEXTURE_2D);
    glTextureStorage2D(canvas.id(), 1, GL_RGBA8, width, height);
    const gl::Framebuffer framebuffer = gl::Framebuffer::create("curves");
    glNamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, canvas.id(), 0);
    ImGui::GetIO().DisplaySize = {float(width), float(height)};
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    ImDrawList& to = *ImGui::GetBackgroundDrawList();
    to.AddRectFilled({0, 0}, {float(width), float(height)}, IM_COL32(24, 24, 26, 255));
    for (std::size_t i = 0; i < plots.size(); ++i)
        PlotPainter(to, {float(i % kAcross * kPlotWidth), float(i / kAcross * kPlotHeight)}, plots[i]).paint();
    ImGui::Render();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    imgui.draw(width, height);
    ByteImage image{width, height, {}};
    image.data.resize(std::size_t(width) * std::size_t(height) * 4);
    glGetTextureImage(canvas.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.data.size()), image.data.data());
    const std::ptrdiff_t row = std::ptrdiff_t(width) * 4;
    for (int y = 0; y < height / 2; ++y)
        std::swap_ranges(image.data.begin() + y * row, image.data.begin() + (y + 1) * row,
                         image.data.begin() + (height - 1 - y) * row);
    write_png(png, image);
}

}  // namespace si
