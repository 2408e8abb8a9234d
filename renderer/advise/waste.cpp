#include "renderer/advise/waste.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "renderer/inspect/texel_usage.h"
#include "renderer/measure/axes.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/passes/casters.h"
#include "renderer/scene/part_identity.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Comparison of a frame without some work with the whole frame.
enum class ComparedBy {
    Picture,       ///< the whole picture
    SameSurfaces,  ///< pixels that show the same triangle in both
    Shown,         ///< panes with their overlays
};

/// Frame without one piece of work.
struct WorkTrial : Candidate {
    WorkTrial(std::string title, const Settings& s) : Candidate{.name = std::move(title), .settings = s} {}
    ComparedBy by = ComparedBy::Picture;
    bool is_drawn_into_maps = false;  ///< the work draws triangles into maps
    bool takes_map_time = false;      ///< the work takes time of the maps' passes
};

std::uint64_t map_triangles(const FrameResult& frame) {
    std::uint64_t n = 0;
    for (const PassInfo& pass : frame.passes)
        if (pass.state == PassState::Drawn && (pass.makes == Result::DrawnMaps || pass.makes == Result::Pages))
            n += pass.triangles;
    return n;
}

std::vector<WorkTrial> map_trials(const Settings& settings, const FrameResult& frame) {
    std::vector<WorkTrial> out;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const FittedLight& light = frame.lights[i];
        if (!light.casts || light.provider == MapProvider::Imported) continue;
        if (draws_pages(settings)) {
            // The light's contact shadows stay, as they do not depend on the source.
            WorkTrial& trial = out.emplace_back(fmt::format("pages of light {}", i), settings);
            set_setting(trial.settings, fmt::format("light.{}.source", i), "none");
            trial.is_drawn_into_maps = trial.takes_map_time = true;
            continue;
        }
        for (std::size_t v = 0; v < light.views.size(); ++v) {
            const std::string view = view_name(light.chooser.choice, v, light.views.size());
            WorkTrial& trial =
                out.emplace_back(fmt::format("{} of light {}", view.empty() ? "map" : view, i), settings);
            trial.settings.view.light = int(i);
            trial.settings.view.face = int(v);
            trial.emptied = MapOfLight{int(i), int(v)};
            trial.is_drawn_into_maps = trial.takes_map_time = true;
        }
    }
    return out;
}

/// Returns true when some caster has a material with this alpha mode.
bool casts_with(const Scene& scene, const Settings& settings, AlphaMode alpha) {
    return std::ranges::any_of(scene.objects, [&](const Object& o) {
        return material_of(scene, scene.meshes[std::size_t(o.mesh)]).alpha == alpha && can_cast(scene, settings, o);
    });
}

/// Lists frames with one effect switched off by its settings.
std::vector<WorkTrial> setting_trials(const Scene& scene, const Settings& settings, const FrameResult& frame) {
    std::vector<WorkTrial> out;
    const auto without = [&](bool applies, std::string name, const SettingChanges& off, bool takes_map_time = false) {
        WorkTrial trial(std::move(name), settings);
        set_settings(trial.settings, off);
        trial.takes_map_time = takes_map_time;
        if (applies && !(without_ineffective_settings(trial.settings) == without_ineffective_settings(settings)))
            out.push_back(std::move(trial));
    };
    const Filter& kernel = filter_of(settings);
    const bool moments = kernel.samples() == Samples::Moments;
    const auto of_light = [](std::size_t i, const char* key) { return fmt::format("light.{}.{}", i, key); };
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        without(frame.lights[i].shadowed, fmt::format("contact shadows of light {}", i),
                {{of_light(i, "contact"), "0"}});
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        without(frame.lights[i].casts && kernel.reads_light_size, fmt::format("size of light {}", i),
                {{of_light(i, "size"), "0"}});
    without(true, "depth blur", {{"map.blur_texels", "0"}}, true);
    without(moments, "blur of the moments", {{"filter.blur", "0"}}, true);
    without(moments, "mip levels of the moments", {{"filter.mips", "false"}}, true);
    without(moments, "several samples a texel", {{"map.samples", "1"}}, true);
    without(casts_with(scene, settings, AlphaMode::Blend), "shadows of blended casters", {{"caster.blend", "none"}},
            true);
    without(true, "sky and its ambient light", {{"shading.sky", "plain"}});
    without(true, "tone curve", {{"shading.curve", "plain"}, {"shading.exposure", "0"}});
    return out;
}

/// Lists frames with a changed scene: without alpha test, or without the ground disc.
std::vector<WorkTrial> scene_trials(const Scene& scene, const Settings& settings, const FrameResult& frame) {
    std::vector<WorkTrial> out;
    const bool has_map = std::ranges::any_of(frame.lights, [](const FittedLight& light) { return light.casts; });
    if (has_map && casts_with(scene, settings, AlphaMode::Mask)) {
        const auto opaque = std::make_shared<Scene>(scene);
        for (Material& m : opaque->materials)
            if (m.alpha == AlphaMode::Mask) m.alpha = AlphaMode::Opaque;
        refresh(*opaque);
        // The camera sees no holes either, so only pixels with the same surface are compared.
        WorkTrial& trial = out.emplace_back("alpha test in maps", settings);
        trial.scene = opaque;
        trial.by = ComparedBy::SameSurfaces;
        trial.takes_map_time = true;
    }
    const auto ground = std::ranges::find_if(scene.objects, [](const Object& o) { return o.ground; });
    if (ground != scene.objects.end()) {
        // The ground is hidden, not removed, so that cameras do not change.
        std::set<std::string> paths = {scene.nodes[std::size_t(ground->node)].path};
        for (const HiddenObject& h : scene.hidden) paths.insert(scene.nodes[std::size_t(h.object.node)].path);
        const auto bare = std::make_shared<Scene>(scene);
        hide_objects(*bare, paths);
        out.emplace_back("ground", settings).scene = bare;
    }
    return out;
}

/// Lists frames without one overlay of the panes.
std::vector<WorkTrial> shown_trials(const Settings& settings, const FrameResult& shown) {
    std::vector<WorkTrial> out;
    for (std::size_t pane = 0; pane < shown.panes.size(); ++pane) {
        // Panes without a reference have no overlay.
        if (shown.panes[pane].overlay == 0 || shown.panes[pane].lacks_reference) continue;
        const std::string_view key = overlays()[std::size_t(shown.panes[pane].overlay - 1)].key;
        WorkTrial& trial = out.emplace_back(shown.panes.size() > 1 ? fmt::format("overlay {} in pane {}", key, pane + 1)
                                                                   : fmt::format("overlay {}", key),
                                            settings);
        overlay_of_pane(trial.settings.view, pane) = 0;
        trial.by = ComparedBy::Shown;
    }
    const auto has_slabs = [](const PassInfo& p) { return p.state == PassState::Drawn && p.makes == Result::Slabs; };
    if (std::ranges::any_of(shown.passes, has_slabs)) {
        WorkTrial& trial = out.emplace_back("stored-depth quads", settings);
        trial.settings.view.slabs = Slabs::None;
        trial.by = ComparedBy::Shown;
    }
    return out;
}

/// Returns true when a pixel that shows the same triangle in both pictures has different colours.
bool differ_on_same_surfaces(const Scene& scene, const ByteImage& a, const SurfaceIds& ids_a, const ByteImage& b,
                             const SurfaceIds& ids_b) {
    if (ids_a.data.size() != ids_b.data.size()) return true;
    for (std::size_t i = 0; i < ids_a.data.size(); ++i) {
        const glm::uvec2 one = ids_a.data[i], other = ids_b.data[i];
        if (one.x != other.x || one.x == 0) continue;
        const Mesh& mesh = scene.meshes[std::size_t(scene.objects[one.x - 1].mesh)];
        const auto triangles = unsigned(mesh.indices.size() / 3);
        if (triangles == 0 || one.y % triangles != other.y % triangles) continue;
        if (!std::equal(&a.data[4 * i], &a.data[4 * i] + 4, &b.data[4 * i])) return true;
    }
    return false;
}

class WasteSearch {
public:
    WasteSearch(const SearchTools& whole, const Settings& settings, const FrameRequest& request)
        : tools_(whole.part()),
          meter_(renderer_trial_meter(tools_)),
          settings_(settings),
          whole_{.name = "the whole frame", .settings = measured_settings(settings)},
          request_(request) {
        request_.force = true;
        request_.timing = false;
        request_.outputs = {};
    }

    Waste find(bool timed, const std::function<void(const Waste&)>& shown) {
        Waste waste;
        std::vector<double> whole_ms;
        std::vector<WorkTrial> trials = all_trials();
        const bool ended = try_each(std::move(trials), tools_.report, [&](const WorkTrial& trial) {
            WasteTrial tried = try_it(trial);
            some_map_needed_ |= trial.is_drawn_into_maps && tried.changes;  // maps are tried first
            if (timed && is_timed(trial, tried)) {
                const AlternatingTimes times = time_against_whole(trial);
                tried.maps_ms = -times.more.value;
                whole_ms.push_back(times.before_ms);
            }
            waste.tried.push_back(std::move(tried));
            if (shown) shown(waste);
            return true;
        });
        if (!ended && waste.tried.empty()) throw Cancelled();
        waste.stopped = !ended;
        if (timed && whole_ms.empty() && ended) whole_ms.push_back(time_against_whole(whole_).before_ms);
        if (!whole_ms.empty()) waste.maps_ms = spread_of(std::move(whole_ms)).median;
        return waste;
    }

private:
    const SearchTools tools_;
    const TrialMeter meter_;
    const Settings& settings_;
    const Candidate whole_;  ///< nothing is left out, and no overlay is drawn
    FrameRequest request_;
    std::vector<ByteImage> picture_, shown_;  ///< panes of the whole frame, without and with overlays
    std::uint64_t triangles_ = 0;
    bool some_map_needed_ = false;

    std::vector<ByteImage> pictures_of(const FrameResult& frame) const {
        std::vector<ByteImage> out;
        for (const Pane& pane : frame.panes) out.push_back(tools_.renderer.read_colour(pane.picture));
        return out;
    }

    std::vector<WorkTrial> all_trials() {
        const FrameResult whole = meter_.draw(whole_, request_);
        picture_ = pictures_of(whole);
        triangles_ = map_triangles(whole);
        std::vector<WorkTrial> trials = map_trials(whole_.settings, whole);
        const auto add = [&](std::vector<WorkTrial> more) { std::ranges::move(more, std::back_inserter(trials)); };
        add(setting_trials(tools_.scene, whole_.settings, whole));
        add(scene_trials(tools_.scene, whole_.settings, whole));
        const bool shows = settings_.view.slabs != Slabs::None ||
                           std::ranges::any_of(pane_overlays(settings_.view), [](int n) { return n > 0; });
        if (shows) {
            const FrameResult shown = meter_.draw({.name = "the shown frame", .settings = settings_}, request_);
            shown_ = pictures_of(shown);
            add(shown_trials(settings_, shown));
        }
        return trials;
    }

    WasteTrial try_it(const WorkTrial& trial) const {
        WasteTrial out{.name = trial.name};
        if (trial.by == ComparedBy::SameSurfaces) {
            out.changes = changes_same_surfaces(trial);
            return out;
        }
        const FrameResult frame = meter_.draw(trial, request_);
        out.changes = pictures_of(frame) != (trial.by == ComparedBy::Shown ? shown_ : picture_);
        if (trial.is_drawn_into_maps) out.triangles = triangles_ - std::min(map_triangles(frame), triangles_);
        if (trial.emptied) out.read = share_read(trial);
        return out;
    }

    bool changes_same_surfaces(const WorkTrial& trial) const {
        FrameRequest request = request_;
        request.outputs.surface_ids = true;
        const SurfaceIds ids = tools_.renderer.read_surface_ids(meter_.draw(whole_, request).surface_ids);
        const FrameResult without = meter_.draw(trial, request);
        return differ_on_same_surfaces(tools_.scene, picture_.front(), ids, tools_.renderer.read_colour(without.colour),
                                       tools_.renderer.read_surface_ids(without.surface_ids));
    }

    double share_read(Candidate whole_map) const {
        whole_map.emptied.reset();
        FrameRequest request = request_;
        request.outputs = {.colour = false, .texels_read = true};
        const FrameResult frame = meter_.draw(whole_map, request);
        if (frame.texels_read.texture == 0) return 0;
        return exact_utilisation(tools_.renderer.read_float(frame.texels_read, 1));
    }

    /// Returns true when the time of a trial is measured. Needed work is not timed, nor are maps without triangles.
    /// Work on maps that are all waste is a part of the maps' time, which counts once.
    bool is_timed(const WorkTrial& trial, const WasteTrial& tried) const {
        const bool counts = trial.is_drawn_into_maps ? tried.triangles > 0 : some_map_needed_;
        return trial.takes_map_time && !tried.changes && counts;
    }

    /// Times the maps of whole frames, and of frames without a trial's work.
    AlternatingTimes time_against_whole(const Candidate& trial) const {
        FrameRequest request = request_;
        request.timing = true;
        const auto maps_ms = [](const FrameResult& frame) { return drawn_ms(frame, PassCategory::Maps); };
        const auto whole = [&] { return maps_ms(meter_.draw(whole_, request)); };
        const auto without = [&] { return maps_ms(meter_.draw(trial, request)); };
        whole();
        without();  // programs are compiled
        return time_alternately(whole, without, tools_.workers.stop);
    }
};

}  // namespace

std::string WasteTrial::text() const {
    // For a pass that is not drawn, the taps are those that the kernel would read.
    if (read < 0 || is_undrawn()) return name;
    return fmt::format("{}, {:.2f} % of its texels are read", name, 100 * read);
}

std::uint64_t Waste::triangles() const {
    std::uint64_t n = 0;
    for (const WasteTrial& t : tried) n += t.triangles;
    return n;
}

std::uint64_t Waste::wasted() const {
    std::uint64_t n = 0;
    for (const WasteTrial& t : tried) n += t.changes ? 0 : t.triangles;
    return n;
}

double Waste::wasted_ms() const {
    double ms = 0;
    for (const WasteTrial& t : tried) ms += t.changes ? 0 : t.maps_ms;
    return std::max(ms, 0.0);  // noise may make differences negative
}

std::optional<double> Waste::share_of_time() const {
    if (!maps_ms || *maps_ms <= 0) return {};
    return std::min(wasted_ms() / *maps_ms, 1.0);
}

std::string Waste::summary() const {
    std::string text =
        fmt::format("{} of {} triangles drawn into maps are waste ({:.1f} %)\n", wasted(), triangles(), 100 * share());
    if (const std::optional<double> of_time = share_of_time())
        text += fmt::format("{:.2f} of {:.2f} ms that maps take are waste ({:.1f} %)\n", wasted_ms(), *maps_ms,
                            100 * *of_time);
    return text;
}

Waste find_waste(const SearchTools& tools, const Settings& settings, FrameRequest request,
                 const std::function<void(const Waste&)>& shown) {
    return WasteSearch(tools, settings, request).find(request.timing, shown);
}

}  // namespace si
