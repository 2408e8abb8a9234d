#include "renderer/measure/waste.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "renderer/measure/axes.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

/// A frame without something.
struct Trial {
    Trial(std::string name, const Settings& s) : settings(s) { about.name = std::move(name); }
    Tried about;
    Settings settings;
    std::optional<MapOfLight> map;
};

std::uint64_t map_triangles(const FrameResult& frame) {
    std::uint64_t n = 0;
    for (const PassInfo& pass : frame.passes)
        if (pass.state == PassState::Ran && pass.name.starts_with("shadow map ")) n += pass.triangles;
    return n;
}

std::vector<Trial> map_trials(const Settings& settings, const FrameResult& frame) {
    std::vector<Trial> out;
    for (std::size_t i = 0; i < frame.lights.size() && !frame.pages; ++i) {
        const FittedLight& light = frame.lights[i];
        for (std::size_t v = 0; light.casts && v < light.views.size(); ++v) {
            const std::string view = view_name(light.chooser.choice, v, light.views.size());
            Trial& trial = out.emplace_back(fmt::format("{} of light {}", view.empty() ? "map" : view, i), settings);
            trial.settings.view.light = int(i), trial.settings.view.face = int(v);
            trial.map = MapOfLight{int(i), int(v)};
        }
    }
    return out;
}

/// What settings put on, off.
std::vector<Trial> setting_trials(const Settings& settings, const FrameResult& frame) {
    std::vector<Trial> out;
    const auto without = [&](std::string name, const auto& change) {
        Trial trial(std::move(name), settings);
        change(trial.settings);
        if (!(without_idle(trial.settings) == without_idle(settings))) out.push_back(std::move(trial));
    };
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        if (frame.lights[i].shadowed)
            without(fmt::format("contact shadows of light {}", i), [&](Settings& s) { s.lights[i].contact = 0; });
    without("depth blur", [](Settings& s) { s.map.blur_texels = 0; });
    if (filter_of(settings).samples == Samples::Moments) {
        without("blur of the moments", [](Settings& s) { s.filter.blur = 0; });
        without("mip levels of the moments", [](Settings& s) { s.filter.mips = false; });
        without("several samples a texel", [](Settings& s) { s.map.samples = 1; });
    }
    return out;
}

double share_read(Renderer& renderer, const FrameResult& frame) {
    if (frame.texels_read.texture == 0) return 0;
    const FloatImage read = renderer.read_float(frame.texels_read, 1);
    const auto count = std::count_if(read.data.begin(), read.data.end(), [](float v) { return v > 0; });
    return read.data.empty() ? 0 : double(count) / double(read.data.size());
}

}  // namespace

std::uint64_t Waste::triangles() const {
    std::uint64_t n = 0;
    for (const Tried& t : tried) n += t.triangles;
    return n;
}

std::uint64_t Waste::wasted() const {
    std::uint64_t n = 0;
    for (const Tried& t : tried) n += t.changes ? 0 : t.triangles;
    return n;
}

Waste find_waste(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                 const Workers& workers, const std::function<void(double)>& report) {
    const Settings measured = measured_settings(settings);
    request.force = true;
    request.outputs = {};
    const FrameResult whole = renderer.render(scene, measured, request);
    const ByteImage picture = renderer.read_colour(whole.colour);
    const std::uint64_t triangles = map_triangles(whole);
    std::vector<Trial> trials = map_trials(measured, whole);
    for (Trial& t : setting_trials(measured, whole)) trials.push_back(std::move(t));
    Waste waste;
    for (Trial& trial : trials) {
        if (workers.stop.stop_requested()) throw Cancelled();
        if (report) report(double(waste.tried.size()) / double(trials.size()));
        FrameRequest without = request;
        without.emptied = trial.map;
        const FrameResult frame = renderer.render(scene, trial.settings, without);
        trial.about.changes = !(renderer.read_colour(frame.colour) == picture);
        if (trial.map) {
            trial.about.triangles = triangles - std::min(map_triangles(frame), triangles);
            without.emptied.reset();
            without.outputs = {.colour = false, .texels_read = true};
            trial.about.read = share_read(renderer, renderer.render(scene, trial.settings, without));
        }
        waste.tried.push_back(std::move(trial.about));
    }
    return waste;
}

}  // namespace si
