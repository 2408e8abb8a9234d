#include "tests/hard_cases/claim_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"

namespace si::test {
namespace {

/// Returns whether a point lies outside the map's side, out of reach of rounding and of the normal offset.
bool is_outside(const glm::dvec4& p) {
    constexpr double kPad = 0.01;
    return p.x < -kPad || p.x > 1 + kPad || p.y < -kPad || p.y > 1 + kPad;
}
bool is_inside(const glm::dvec4& p) {
    constexpr double kPad = 0.01;
    return p.x > kPad && p.x < 1 - kPad && p.y > kPad && p.y < 1 - kPad;
}

/// Returns the share of a picture's pixels that `chosen(r, g, b)` accepts.
double share_of(const ByteImage& image, const std::function<bool(int r, int g, int b)>& chosen) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.data.size(); i += 4)
        count += chosen(image.data[i], image.data[i + 1], image.data[i + 2]);
    return image.data.empty() ? -1 : double(count) / (double(image.data.size()) / 4);
}

/// Returns the mean grey of the scene in the map viewer, 0 to 1.
double mean_map_grey(const GuidedDrawing& g) {
    EXPECT_EQ(g.map_view.width, g.shot.maps.at(0).width);
    return g.mean_of_drawn([&](int x, int y) {
        return g.map_view.data[(std::size_t(y) * std::size_t(g.map_view.width) + std::size_t(x)) * 4] / 255.0;
    });
}

/// Returns the sum of the changes of visibility along rows of pixels.
double roughness(const GuidedDrawing& g) {
    double sum = 0;
    const FloatImage& v = g.shot.visibility;
    for (int y = 0; y < v.height; ++y)
        for (int x = 1; x < v.width; ++x) sum += std::abs(double(v.at(x, y)) - v.at(x - 1, y));
    return sum;
}

/// Returns the largest movement of the maps' texels over the ground as the camera turns, in texels from the nearest
/// whole number. The result is at most 0.5, and 0.5 where a map changes its width.
double texel_slide(const GuidedDrawing& g) {
    Settings s = g.settings;
    s.camera = manual_camera(g.scene, s);
    std::vector<LightView> before;
    double most = 0;
    for (int i = 0; i < 8; ++i) {
        const Camera camera = make_camera(g.scene, s, 16.0 / 9);
        const std::vector<LightView> now = fit_lights(g.scene, s, &camera)[0].views;
        for (std::size_t v = 0; v < before.size(); ++v) {
            if (before[v].half_extent() != now[v].half_extent()) return 0.5;
            const glm::dvec3 moved = glm::transpose(now[v].axes) * (now[v].eye - before[v].eye);
            const glm::dvec2 texels = glm::dvec2(moved) / now[v].texel_size(1, s.map.resolution);
            const glm::dvec2 part = glm::abs(texels - glm::round(texels));
            most = std::max({most, part.x, part.y});
        }
        before = now;
        s.camera.azimuth += 0.7;
    }
    return most;
}

/// Returns the least of `value(i)` for the views 0 to `count` - 1.
double least_of(std::size_t count, const std::function<double(std::size_t i)>& value) {
    EXPECT_GT(count, 0u);
    double least = 1e300;
    for (std::size_t i = 0; i < count; ++i) least = std::min(least, value(i));
    return least;
}
double most_of(std::size_t count, const std::function<double(std::size_t i)>& value) {
    return -least_of(count, [&](std::size_t i) { return -value(i); });
}

double texel_size_m(const GuidedDrawing& g) {
    return g.shot.view().texel_size(1, g.shot.frame.map_resolution);
}
TexelSize texel_size_range(const GuidedDrawing& g) {
    return g.shot.view().texel_size_range(g.shot.frame.map_resolution);
}
const auto& spans_of(const GuidedDrawing& g) {
    return g.shot.light().chooser.spans;
}

/// Returns the length of the i-th split divided by that of the one before it.
double split_ratio(const GuidedDrawing& g, std::size_t i) {
    return spans_of(g).at(i + 1).ends / spans_of(g).at(i).ends;
}
double width_per_distance(const GuidedDrawing& g, std::size_t i) {
    return g.shot.view(i).half_extent() / spans_of(g).at(i).ends;
}

/// Draws two frames with a new renderer, so that only the first fills the caches. Returns the second. @param changes
/// changes of the second frame to the first's settings, with its camera as a manual one
FrameResult frame_after(Renderer& renderer, const GuidedDrawing& first, const std::vector<std::string>& changes) {
    const FrameRequest request{.width = first.shot.width, .height = first.shot.height};
    renderer.render(first.scene, first.settings, request);
    Settings s = first.settings;
    s.camera = manual_camera(first.scene, s, double(first.shot.width) / first.shot.height);
    for (const std::string& change : changes) apply_set(s, change);
    return renderer.render(first.scene, s, request);
}

double changes_but_light_direction(const GuidedDrawing& g) {
    Settings s = g.settings;
    s.lights[0].azimuth = Settings().lights[0].azimuth;
    s.lights[0].elevation = Settings().lights[0].elevation;
    return double(changed_settings(s).size());
}

FrameResult shaded_frame(const GuidedDrawing& g) {
    return hard_renderer().render(g.scene, g.settings, {.width = g.shot.width, .height = g.shot.height});
}

double colour_levels(const GuidedDrawing& g) {
    const ByteImage picture = hard_renderer().read_colour(shaded_frame(g).colour);
    std::set<int> levels;
    for (std::size_t i = 0; i < picture.data.size(); i += 4) levels.insert(picture.data[i]);
    return double(levels.size());
}

double red_marks(const GuidedDrawing& g) {
    const ByteImage marked = hard_renderer().read_colour(shaded_frame(g).panes.at(1).picture);
    return share_of(marked, [](int r, int green, int) { return r > 150 && green < 90; }) * double(marked.data.size()) /
           4;
}

using S = const ClaimSubject&;
using G = const GuidedDrawing&;

const std::map<std::string, double (*)(S, G)> kOfOne = {
    // Pixels against rays that are traced here, not by the program
    {"wrongly_dark", [](S s, G g) { return g.wrongly_dark(s.receivers); }},
    {"wrongly_lit", [](S s, G g) { return g.wrongly_lit(s.receivers, s.casters); }},
    {"bled", [](S, G g) { return g.mean_errors().bled; }},
    {"darkened", [](S, G g) { return g.mean_errors().darkened; }},
    {"lit_outside_map",
     [](S, G g) { return g.lit_where([](const glm::dvec4& p, bool shadow) { return is_outside(p) && !shadow; }); }},
    {"lit_inside_map",
     [](S, G g) { return g.lit_where([](const glm::dvec4& p, bool shadow) { return is_inside(p) && !shadow; }); }},
    {"lit_beyond_far",
     [](S, G g) { return g.lit_where([](const glm::dvec4& p, bool) { return p.z > 1.01 && is_inside(p); }); }},
    {"lit_shadows_beyond_far",
     [](S, G g) { return g.lit_where([](const glm::dvec4& p, bool shadow) { return shadow && p.z > 1.01; }); }},
    {"lit_shadows_before_far",
     [](S, G g) { return g.lit_where([](const glm::dvec4& p, bool shadow) { return shadow && p.z < 0.99; }); }},
    // The picture
    {"edges", [](S s, G g) { return double(g.edges(s.receivers)); }},
    {"grey", [](S, G g) { return g.grey(); }},
    {"grey_levels", [](S, G g) { return double(g.grey_levels()); }},
    {"grey_pixels",
     [](S, G g) {
         return double(std::ranges::count_if(g.shot.visibility.data, [](float v) { return v > 0.02f && v < 0.98f; }));
     }},
    {"dark", [](S, G g) { return g.dark(); }},
    {"shadow_share", [](S, G g) { return shadow_share(g.shot); }},
    {"roughness", [](S, G g) { return roughness(g); }},
    {"colour_levels", [](S, G g) { return colour_levels(g); }},
    {"red_marks", [](S, G g) { return red_marks(g); }},
    // The map viewer
    {"map_grey", [](S, G g) { return mean_map_grey(g); }},
    {"map_red",
     [](S, G g) { return share_of(g.map_view, [](int r, int gr, int b) { return r > gr + 20 && r > b + 20; }); }},
    {"map_green",
     [](S, G g) { return share_of(g.map_view, [](int r, int gr, int b) { return gr > r + 20 && gr > b + 20; }); }},
    {"map_blue",
     [](S, G g) { return share_of(g.map_view, [](int r, int gr, int b) { return b > r + 20 && b > gr + 20; }); }},
    // Maps
    {"map_resolution", [](S, G g) { return double(g.shot.frame.map_resolution); }},
    {"map_count", [](S, G g) { return double(g.shot.light().views.size()); }},
    {"map_is_perspective", [](S, G g) { return double(g.shot.view().curve.perspective); }},
    {"map_depth_m",
     [](S, G g) {
         double sum = 0;
         for (const LightView& view : g.shot.light().views) sum += view.curve.far - view.curve.near;
         return sum;
     }},
    {"texel_size_m", [](S, G g) { return texel_size_m(g); }},
    {"shortest_texel_m", [](S, G g) { return texel_size_range(g).shortest; }},
    {"longest_texel_m", [](S, G g) { return texel_size_range(g).longest; }},
    {"near_side_texel_m",
     [](S, G g) {
         const LightView& view = g.shot.view();
         return view.texel_size_at(view.position_ws({0.5, 0}, 0), g.shot.frame.map_resolution).longest;
     }},
    {"w_ratio", [](S, G g) { return 1 / (1 + g.shot.view().curve.warp.value().rise); }},
    {"texel_slide", [](S, G g) { return texel_slide(g); }},
    // Cascades
    {"half_width_m", [](S, G g) { return g.shot.view(0).half_extent(); }},
    {"least_width_ratio",
     [](S, G g) {
         return least_of(g.shot.light().views.size() - 1, [&](std::size_t i) {
             return g.shot.view(i + 1).half_extent() / g.shot.view(i).half_extent();
         });
     }},
    {"least_width_per_distance",
     [](S, G g) {
         return least_of(g.shot.light().views.size(), [&](std::size_t i) { return width_per_distance(g, i); });
     }},
    {"most_width_per_distance",
     [](S, G g) {
         return most_of(g.shot.light().views.size(), [&](std::size_t i) { return width_per_distance(g, i); });
     }},
    {"least_split_ratio",
     [](S, G g) { return least_of(spans_of(g).size() - 1, [&](std::size_t i) { return split_ratio(g, i); }); }},
    {"most_split_ratio",
     [](S, G g) { return most_of(spans_of(g).size() - 1, [&](std::size_t i) { return split_ratio(g, i); }); }},
    {"split_length_difference",
     [](S, G g) {
         const auto& spans = spans_of(g);
         return std::abs((spans.at(3).ends - spans.at(2).ends) - (spans.at(1).ends - spans.at(0).ends)) /
                spans.at(3).ends;
     }},
    {"first_split_m", [](S, G g) { return spans_of(g).at(0).ends; }},
    {"nearest_surface_m", [](S, G g) { return g.shot.frame.seen_m.value().from_m; }},
    // Costs, pages, notes
    {"sampler_taps", [](S, G g) { return double(kernel_cost(g.settings).sampler_taps); }},
    {"texels_read", [](S, G g) { return double(kernel_cost(g.settings).texels); }},
    {"pages_drawn", [](S, G g) { return double(g.classification().pages.value().drawn); }},
    {"pages_coarser", [](S, G g) { return double(g.classification().pages.value().coarser); }},
    {"page_texels_drawn", [](S, G g) { return double(g.classification().pages.value().drawn_texels()); }},
    {"notes_on_page_pool",
     [](S, G g) {
         return double(std::ranges::count_if(g.classification().notes, [](const std::string& note) {
             return note.find("map.page_pool") != std::string::npos;
         }));
     }},
    {"changes_but_light_direction", [](S, G g) { return changes_but_light_direction(g); }},
};

/// Metrics of two drawings: the claim's and the one named as "than".
const std::map<std::string, double (*)(S, G, G)> kOfTwo = {
    {"differing_share", [](S, G g, G than) { return differing_share(g.shot, than.shot); }},
    {"differing_pixels",
     [](S, G g, G than) {
         EXPECT_EQ(g.shot.visibility.data.size(), than.shot.visibility.data.size());
         return differing_share(g.shot, than.shot, 0);
     }},
    // A frame with the claim's settings right after one with the other's
    {"cached_page_share",
     [](S s, G, G than) {
         Renderer renderer;
         const PageFacts pages = frame_after(renderer, than, s.set).pages.value();
         return double(pages.kept) / double(pages.kept + pages.drawn);
     }},
    {"moments_drawn",
     [](S s, G, G than) {
         Renderer renderer;
         return double(frame_after(renderer, than, s.set).pass("moments")->state != PassState::Cached);
     }},
};

/// Returns a metric of the program, or the share of the counted pixels with a cause ("cause.acne").
std::optional<double> error_metric(const std::string& name, const GuidedDrawing& g) {
    if (const Metric* metric = find_metric(name)) return metric->value(g.error());
    for (const ArtefactStyle& style : artefact_styles())
        if (name == fmt::format("cause.{}", style.key))
            return double(g.error().artefacts[std::size_t(style.artefact)]) / double(g.error().counted);
    return std::nullopt;
}

}  // namespace

bool compares_drawings(const std::string& metric) {
    return kOfTwo.contains(metric);
}

double claim_metric(const ClaimSubject& subject, const GuidedDrawing& drawing, const GuidedDrawing* than) {
    constexpr std::string_view kPlus = " + ";
    if (const std::size_t plus = subject.metric.find(kPlus); plus != std::string::npos) {
        ClaimSubject first = subject;
        ClaimSubject others = subject;
        first.metric = subject.metric.substr(0, plus);
        others.metric = subject.metric.substr(plus + kPlus.size());
        return claim_metric(first, drawing, than) + claim_metric(others, drawing, than);
    }
    if (const auto one = kOfOne.find(subject.metric); one != kOfOne.end()) return one->second(subject, drawing);
    if (const auto two = kOfTwo.find(subject.metric); two != kOfTwo.end()) {
        if (!than) throw Error(fmt::format("{}: compares two drawings: name the other as \"than\"", subject.metric));
        return two->second(subject, drawing, *than);
    }
    if (const auto value = error_metric(subject.metric, drawing)) return *value;
    throw Error(fmt::format("\"{}\": no such metric", subject.metric));
}

}  // namespace si::test
