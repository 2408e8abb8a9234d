#include "renderer/advise/fixes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <limits>
#include <set>
#include <span>

#include "renderer/base/lengths_text.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Returns the map resolution at which 95 % of the undersampled pixels have narrow enough texels.
double sampling_resolution(const MeasuredError& m, const Settings& settings, const DriverInfo& driver) {
    const FittedLight& light = m.lights[std::size_t(m.light)];
    std::vector<double> wanted;
    for (std::size_t i = 0; i < m.classified.size(); ++i) {
        if (m.classified[i].artefact != Artefact::Undersampled) continue;
        const Receiver& r = m.traced.receivers->pixels[i];
        const BiasBreakdown a = measured_bias_breakdown(m, settings, r, driver);
        const float run_m = m.traced.runs->run_m.data[i];
        double n = run_m > 0 && a.receiver.texel_m > run_m ? m.map_resolution * a.receiver.texel_m / run_m : 0;
        // Finer texels make room for a right bias where even one nearest tap has none.
        const double gap_m = m.traced.reference->blocker_m.data[i];
        if (std::isfinite(gap_m)) {
            const double along = gap_m * glm::dot(a.receiver.to_light, light.views[a.receiver.view].axes[2]);
            const double kappa = std::max(kernel_reach_in_light(settings, light, m.map_resolution).bias, 0.5);
            const double fixed = a.least.quantum + a.least.rounding,
                         falls = a.least.kernel * 0.5 / kappa + a.least.snapping;
            const double room = a.curve.depth_change_towards_light(a.receiver.own_m, along) - fixed;
            if (room > 0) n = std::max(n, m.map_resolution * falls / room);
        }
        wanted.push_back(n);
    }
    if (wanted.empty()) return 0;
    const auto at = wanted.begin() + std::ptrdiff_t(0.95 * double(wanted.size() - 1) + 0.5);
    std::nth_element(wanted.begin(), at, wanted.end());
    return std::exp2(std::ceil(std::log2(std::max(*at, 1.0)) - 1e-9));  // a power of two
}

constexpr std::pair<BiasFamily, const char*> kFamilies[] = {{BiasFamily::Normal, "least bias, normal offset"},
                                                            {BiasFamily::Slope, "least bias, slope over constant"},
                                                            {BiasFamily::Constant, "least bias, constant alone"}};

/// Converts a label for use in a sentence: "Receiver plane" becomes "receiver plane".
std::string in_a_sentence(std::string_view label) {
    std::string out(label);
    if (!out.empty()) out[0] = char(std::tolower(static_cast<unsigned char>(out[0])));
    return out;
}

void cast_from_both_sides(Settings& s) {
    s.caster.cull = Cull::None;
    for (auto& [path, object] : s.objects) object.cull = ObjectCull::Inherit;
}

/// Proposes other fits of a light's map, and other numbers of cascades.
template <class Idea>
void add_fits(const Settings& base, const FixFacts& f, Idea idea) {
    const auto light = std::size_t(f.light);
    const FittedLight& fitted = f.lights[light];
    const bool sun = fitted.type == LightType::Directional;
    const bool by_hand = base.lights[light].fit == LightFit::Manual;
    // Fits apply to maps whose rays are the light's own.
    const bool narrows = fitted.views.size() == 1 && sun != fitted.is_perspective();
    for (std::size_t i = 0; i < fits().size(); ++i) {
        const FitRow& row = fits()[i];
        const auto fit = static_cast<LightFit>(i);
        if (fit == LightFit::Manual || fit == base.lights[light].fit) continue;
        if (row.narrows ? !narrows : !narrows && !by_hand) continue;
        idea(fmt::format("fit: {}", row.label), [&](Settings& s) { s.lights[light].fit = fit; });
    }
    if (!narrows && fitted.views.size() == 1)
        idea(
            "tighter fit", [](Settings&) {}, "only a map whose rays are the light's own can be fitted tighter");
    if (fitted.chooser.choice == ViewChoice::Face)
        idea(
            "tighter fit", [](Settings&) {}, "six faces hold all directions");
    idea("the light's own projection", [&](Settings& s) { s.lights[light].projection = LightProjection::Automatic; });
    if (!sun || by_hand || fitted.is_perspective()) return;
    for (int n = 2; n <= kMaxCascades; n *= 2)
        idea(fmt::format("{} cascades", n), [&](Settings& s) { s.lights[light].cascades = n; });
}

/// Timer of the difference between two settings: frames are drawn alternately, and only affected passes count.
class Stopwatch {
public:
    Stopwatch(Renderer& renderer, const Scene& scene, FrameRequest request, int frames)
        : renderer_(renderer), scene_(scene), request_(std::move(request)), frames_(frames) {
        request_.timing = request_.force = true;
        request_.reference.reset();
        request_.outputs = {};
    }

    CostChange difference(const Settings& before, const Settings& with, const Workers& workers) {
        const std::set<std::string> changed = changed_passes(before, with);
        std::vector<double> a, b;
        const auto start = std::chrono::steady_clock::now();
        for (int i = -1; i < frames_; ++i) {
            if (workers.stop.stop_requested()) throw Cancelled();
            if (i >= kMinFrames && std::chrono::steady_clock::now() - start > kMaxDuration) break;
            const double first = time(before, changed), second = time(with, changed);
            if (i < 0) continue;  // warms up
            a.push_back(first), b.push_back(second);
        }
        const Spread x = spread_of(std::move(a)), y = spread_of(std::move(b));
        return {y.median - x.median, x.noise() + y.noise()};
    }

private:
    Renderer& renderer_;
    const Scene& scene_;
    // Slow frames scatter little, so a few are enough.
    static constexpr int kMinFrames = 2;
    static constexpr std::chrono::seconds kMaxDuration{2};

    FrameRequest request_;
    int frames_;

    /// Returns the passes that must run again when one setting replaces the other.
    std::set<std::string> changed_passes(const Settings& before, const Settings& with) {
        FrameRequest quiet = request_;
        quiet.timing = quiet.force = false;
        std::set<std::string> out;
        const auto draw = [&](const Settings& s) {
            for (const PassInfo& pass : renderer_.render(scene_, s, quiet).passes)
                if (pass.state == PassState::Drawn) out.insert(pass.name);
        };
        draw(before);
        out.clear();  // passes that depend on earlier frames do not count
        draw(with);
        draw(before);
        return out;
    }

    double time(const Settings& s, const std::set<std::string>& passes) {
        double ms = 0;
        for (const PassInfo& pass : renderer_.render(scene_, s, request_).passes)
            if (passes.contains(pass.name)) ms += pass.gpu_ms;
        return ms;
    }
};

}  // namespace

std::vector<std::pair<std::string, std::string>> setting_changes(const Settings& base, const Settings& with) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const SettingRef& ref : differing_settings(base, with))
        out.emplace_back(setting_key(ref), value_text(*ref.param, get_value(with, ref)));
    return out;
}

BiasSettings least_bias_of(const BiasNeeds& needs, BiasFamily family) {
    BiasSettings b = needs.least_of(family);
    b.constant = round_up_3_digits(b.constant * 1.001);
    b.slope = round_up_3_digits(b.slope * 1.001);
    b.normal = round_up_3_digits(b.normal * 1.001);
    return scale_bias(b, 1);  // clamps to the limits of the settings
}

std::pair<std::string_view, std::string_view> adjacent_kernels(const Settings& settings) {
    const auto edge = [](const Settings& s) {
        const Filter& row = filter_of(s);
        return row.reach(row, s, 0).edge;
    };
    const double reach = edge(settings);
    std::pair<std::string_view, std::string_view> out;
    double narrower = 0, wider = std::numeric_limits<double>::infinity();
    for (const std::string_view kernel : sweep_kernels()) {
        Settings s = settings;
        set_setting(s, "filter.kernel", kernel);
        if (!filter_of(s).square()) continue;
        const double other = edge(s);
        if (other < reach && other > narrower) {
            narrower = other;
            out.first = kernel;
        }
        if (other > reach && other < wider) {
            wider = other;
            out.second = kernel;
        }
    }
    return out;
}

FixFacts fix_facts(const MeasuredError& measured, const Settings& settings, const DriverInfo& driver) {
    FixFacts f;
    f.needs = bias_needs(measured, settings, driver);
    f.lights = measured.lights;
    f.light = measured.light;
    f.map_resolution = measured.map_resolution;
    f.max_resolution = driver.max_texture_size;
    f.sampling_resolution = sampling_resolution(measured, settings, driver);
    for (const Bias& row : biases()) {
        if (std::ranges::any_of(kFamilies, [&](const auto& family) { return &family_row(family.first) == &row; }))
            continue;
        if (const auto least = least_bias_of_row(row, measured, settings, driver))
            f.least_of_rows.emplace_back(&row, *least);
    }
    return f;
}

std::vector<FixCandidate> fix_candidates(const Settings& base, const FixFacts& f) {
    std::vector<FixCandidate> out;
    const auto idea = [&](std::string name, auto&& change, std::string untried = {}) {
        Settings s = base;
        change(s);
        if (untried.empty() && s == base) return;
        out.push_back({std::move(name), std::move(s), std::move(untried)});
    };
    if (!source_of(base, f.light).needs.map) {
        idea("a shadow map", [&](Settings& s) { s.lights[std::size_t(f.light)].source = LightSettings{}.source; });
        return out;
    }
    const bool any = f.needs.pixels > 0;
    const auto bias = [&](BiasFamily family) { return least_bias_of(f.needs, family); };
    for (const auto& [family, name] : kFamilies)
        if (any) idea(name, [&, fam = family](Settings& s) { s.bias = bias(fam); });
    for (const auto& [row, least] : f.least_of_rows)
        if (any)
            idea(fmt::format("least bias, {}", in_a_sentence(row->label)),
                 [&, bias = least](Settings& s) { s.bias = bias; });
    idea("no normal offset", [](Settings& s) { s.bias.normal = 0; });
    idea("no polygon offset", [](Settings& s) { s.bias.raster_slope = s.bias.raster_units = 0; });
    idea("no contact shadows", [&](Settings& s) { s.lights[std::size_t(f.light)].contact = 0; });

    idea("both sides cast", cast_from_both_sides);
    Settings sided = base;
    cast_from_both_sides(sided);
    if (any && !(sided == base))
        for (const auto& [family, name] : kFamilies)
            idea(fmt::format("both sides cast, {}", name), [&, fam = family](Settings& s) {
                cast_from_both_sides(s);
                s.bias = bias(fam);
            });

    const auto [down, up] = adjacent_kernels(base);
    const auto kernel = [](std::string_view text) {
        return [=](Settings& s) { set_setting(s, "filter.kernel", text); };
    };
    if (!down.empty()) idea("narrower kernel", kernel(down));
    if (!up.empty()) idea("wider kernel", kernel(up));
    idea("no depth blur", [](Settings& s) { s.map.blur_texels = 0; });

    const int limit = f.max_resolution;
    const auto finer = [&](double n, const char* name, auto families) {
        const std::string title = fmt::format("{} ({:.0f}²)", name, n);
        const auto change = [&](Settings& s) { s.map.resolution = int(n); };
        const double most = find_setting("map.resolution")->param->max;
        if (n > std::min(double(limit), most)) {
            idea(
                title, [](Settings&) {}, fmt::format("above the limit of {:.0f}²", std::min(double(limit), most)));
            return;
        }
        idea(title, change);
        for (const auto& [family, least] : families) {
            if (!any) break;
            const auto with_bias = [&, fam = family](Settings& s) {
                change(s);
                s.bias = bias(fam);
            };
            idea(fmt::format("{}, {}", title, least), with_bias);
            if (sided == base) continue;
            idea(fmt::format("both sides cast, {}, {}", title, least), [&](Settings& s) {
                cast_from_both_sides(s);
                with_bias(s);
            });
        }
    };
    finer(2.0 * f.map_resolution, "twice the resolution", std::span(kFamilies));
    // Large maps take seconds to draw, so only the family with the smallest gap is tried.
    if (f.sampling_resolution > 2.0 * f.map_resolution)
        finer(f.sampling_resolution, "the resolution that is needed", std::span(kFamilies).first(1));

    add_fits(base, f, idea);
    return out;
}

FixCandidate suggested_candidate(const SuggestedFix& fix, const Settings& settings) {
    FixCandidate idea{.name = fix.text,
                      .settings = settings,
                      .untried = {},
                      .label = fix_text(fix, settings) + equivalent_bias_text(fix)};
    for (const auto& [key, value] : fix.settings) set_setting(idea.settings, key, value);
    return idea;
}

std::string time_text(const std::optional<CostChange>& ms) {
    if (!ms) return "-";
    return ms->is_significant() ? signed_text(ms->value) + " ms" : "< noise";
}

std::string map_bytes_text(long long bytes) {
    if (bytes == 0) return "same";
    const bool large = std::abs(bytes) >= 1 << 20;
    return fmt::format("{:+.0f} {}", double(bytes) / (large ? 1 << 20 : 1 << 10), large ? "MiB" : "KiB");
}

FixTable find_fixes(Renderer& renderer, const Scene& scene, const Settings& settings, int width, int height,
                    const FixOptions& options, ReferenceCache& cache, const Workers& workers,
                    const std::function<void(double, const std::string&)>& report) {
    const Settings base = measured_settings(settings);
    const FrameRequest request{.width = width, .height = height};
    const int light = base.view.light;
    const auto report_progress = [&](double share, const std::string& what) {
        if (workers.stop.stop_requested()) throw Cancelled();
        if (report) report(share, what);
    };
    report_progress(0, "the present settings");
    const auto measure = [&](const Settings& s) {
        return measure_error(renderer, scene, s, request, light, options.reference, cache,
                             workers.with_progress_range(0, 0));
    };
    const auto bytes = [](const Settings& s, const MeasuredError& measured) {
        FrameResult maps;
        maps.lights = measured.lights;
        maps.map_resolution = measured.map_resolution;
        return (long long)work_cost(s, maps).map_bytes;
    };
    const MeasuredError before = measure(base);
    const auto wrong = [](const MeasuredError& m, std::size_t i) { return m.classified[i].artefact != Artefact::None; };
    FixTable table;
    for (std::size_t a = 1; a < kArtefacts; ++a) table.wrong += table.wrong_of[a] = before.metrics.artefacts[a];
    if (table.wrong == 0) return table;
    std::optional<std::size_t> pixel;
    if (options.pixel) {
        const glm::ivec2 at = *options.pixel / std::max(options.reference.step, 1);
        pixel = std::size_t(at.y) * std::size_t(before.traced.reference->width) + std::size_t(at.x);
    }
    std::vector<FixCandidate> ideas = fix_candidates(base, fix_facts(before, base, renderer.driver()));
    for (const FixCandidate& more : options.more) {
        FixCandidate own = more;
        own.settings = measured_settings(own.settings);
        const bool known =
            std::any_of(ideas.begin(), ideas.end(), [&](const FixCandidate& i) { return i.settings == own.settings; });
        if (!known && !(own.settings == base)) ideas.insert(ideas.begin(), std::move(own));
    }
    const long long bytes_before = bytes(base, before);
    Stopwatch stopwatch(renderer, scene, request, options.frames);
    for (std::size_t k = 0; k < ideas.size(); ++k) {
        const FixCandidate& idea = ideas[k];
        MeasuredFix row{.name = idea.name, .settings = setting_changes(base, idea.settings), .untried = idea.untried};
        row.label = idea.label;
        if (row.untried.empty()) {
            report_progress((double(k) + 1) / (double(ideas.size()) + 1), row.shown_name());
            const MeasuredError after = measure(idea.settings);
            if (after.camera.eye != before.camera.eye || after.camera.clip_from_relative(after.camera.eye) !=
                                                             before.camera.clip_from_relative(before.camera.eye)) {
                row.untried = "the camera looks through this light and would move with it";
            } else if (after.map_resolution != idea.settings.map.resolution &&
                       idea.settings.map.resolution != base.map.resolution) {
                row.untried =
                    fmt::format("maps of that size need too much memory; {}² would be drawn", after.map_resolution);
            } else {
                for (std::size_t i = 0; i < before.classified.size(); ++i) {
                    const bool was = wrong(before, i), is = wrong(after, i);
                    row.cured += was && !is;
                    row.cured_of[std::size_t(before.classified[i].artefact)] += was && !is;
                    row.broken += !was && is;
                }
                if (pixel) row.pixel_right = !wrong(after, *pixel);
                row.map_bytes = bytes(idea.settings, after) - bytes_before;
                if (options.time) row.ms = stopwatch.difference(base, idea.settings, workers);
            }
        }
        table.rows.push_back(std::move(row));
    }
    std::stable_sort(table.rows.begin(), table.rows.end(), [](const MeasuredFix& a, const MeasuredFix& b) {
        if (a.untried.empty() != b.untried.empty()) return a.untried.empty();
        if (a.pixel_right != b.pixel_right) return a.pixel_right.value_or(false);
        if (a.gain() != b.gain()) return a.gain() > b.gain();
        return (a.ms ? a.ms->value : 0) < (b.ms ? b.ms->value : 0);
    });
    return table;
}

}  // namespace si
