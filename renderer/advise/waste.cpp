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

constexpr int kTimedTurns = 7;  ///< odd, so that the median is one of them

/// Comparison of a frame without some work with the whole frame.
enum class ComparedBy {
    Picture,       ///< the whole picture
    SameSurfaces,  ///< pixels that show the same triangle in both
    Shown,         ///< panes with their overlays
};

/// Frame without one piece of work.
struct WorkTrial {
    WorkTrial(std::string name, const Settings& s) : settings(s) { about.name = std::move(name); }
    WasteTrial about;
    Settings settings;
    std::optional<MapOfLight> map;
    std::shared_ptr<const Scene> scene;  ///< changed scene; null: the frame's own
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
        if (!light.casts) continue;
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
            trial.map = MapOfLight{int(i), int(v)};
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

/// Lists frames with one setting switched off.
std::vector<WorkTrial> setting_trials(const Scene& scene, const Settings& settings, const FrameResult& frame) {
    std::vector<WorkTrial> out;
    const auto without = [&](std::string name, const auto& change, bool takes_map_time = false) {
        WorkTrial trial(std::move(name), settings);
        change(trial.settings);
        trial.takes_map_time = takes_map_time;
        if (!(without_ineffective_settings(trial.settings) == without_ineffective_settings(settings)))
            out.push_back(std::move(trial));
    };
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        if (frame.lights[i].shadowed)
            without(fmt::format("contact shadows of light {}", i), [&](Settings& s) { s.lights[i].contact = 0; });
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        if (frame.lights[i].casts && filter_of(settings).reads_light_size)
            without(fmt::format("size of light {}", i), [&](Settings& s) { s.lights[i].size = 0; });
    without(
        "depth blur", [](Settings& s) { s.map.blur_texels = 0; }, true);
    if (filter_of(settings).samples() == Samples::Moments) {
        without(
            "blur of the moments", [](Settings& s) { s.filter.blur = 0; }, true);
        without(
            "mip levels of the moments", [](Settings& s) { s.filter.mips = false; }, true);
        without(
            "several samples a texel", [](Settings& s) { s.map.samples = 1; }, true);
    }
    if (casts_with(scene, settings, AlphaMode::Blend))
        without(
            "shadows of blended casters", [](Settings& s) { s.caster.blend = BlendCasters::None; }, true);
    without("sky and its ambient light", [](Settings& s) { s.shading.sky = SkyLook::Plain; });
    without("tone curve", [](Settings& s) {
        s.shading.curve = ToneCurve::Plain;
        s.shading.exposure = 0;
    });
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
    WasteSearch(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                const Workers& workers)
        : renderer_(renderer),
          scene_(scene),
          settings_(settings),
          measured_(measured_settings(settings)),
          request_(request),
          workers_(workers) {
        request_.force = true;
        request_.timing = false;
        request_.outputs = {};
    }

    Waste find(bool timed, const std::function<void(double)>& report) {
        std::vector<WorkTrial> trials = all_trials();
        Waste waste;
        for (WorkTrial& trial : trials) {
            if (report) report(double(waste.tried.size()) / double(trials.size()));
            try_it(trial);
            some_map_needed_ |= trial.is_drawn_into_maps && trial.about.changes;  // maps are tried first
            if (timed && is_timed(trial)) trial.about.maps_ms = saved_ms(trial);
            waste.tried.push_back(std::move(trial.about));
        }
        if (timed) waste.maps_ms = whole_ms();
        return waste;
    }

private:
    Renderer& renderer_;
    const Scene& scene_;
    const Settings& settings_;
    const Settings measured_;
    FrameRequest request_;
    const Workers& workers_;
    std::vector<ByteImage> picture_, shown_;  ///< panes of the whole frame, without and with overlays
    std::uint64_t triangles_ = 0;
    bool some_map_needed_ = false;
    std::vector<double> whole_ms_;  ///< map times of whole frames

    FrameResult draw(const Scene& scene, const Settings& settings, const FrameRequest& request) {
        if (workers_.stop.stop_requested()) throw Cancelled();
        return renderer_.render(scene, settings, request);
    }
    FrameResult draw(const WorkTrial& trial, FrameRequest request) {
        request.emptied = trial.map;
        return draw(trial.scene ? *trial.scene : scene_, trial.settings, request);
    }

    std::vector<ByteImage> pictures_of(const FrameResult& frame) {
        std::vector<ByteImage> out;
        for (const Pane& pane : frame.panes) out.push_back(renderer_.read_colour(pane.picture));
        return out;
    }

    std::vector<WorkTrial> all_trials() {
        const FrameResult whole = draw(scene_, measured_, request_);
        picture_ = pictures_of(whole);
        triangles_ = map_triangles(whole);
        std::vector<WorkTrial> trials = map_trials(measured_, whole);
        const auto add = [&](std::vector<WorkTrial> more) { std::ranges::move(more, std::back_inserter(trials)); };
        add(setting_trials(scene_, measured_, whole));
        add(scene_trials(scene_, measured_, whole));
        const bool shows = settings_.view.slabs != Slabs::None ||
                           std::ranges::any_of(pane_overlays(settings_.view), [](int n) { return n > 0; });
        if (shows) {
            const FrameResult shown = draw(scene_, settings_, request_);
            shown_ = pictures_of(shown);
            add(shown_trials(settings_, shown));
        }
        return trials;
    }

    void try_it(WorkTrial& trial) {
        if (trial.by == ComparedBy::SameSurfaces) {
            trial.about.changes = changes_same_surfaces(trial);
            return;
        }
        const FrameResult frame = draw(trial, request_);
        trial.about.changes = pictures_of(frame) != (trial.by == ComparedBy::Shown ? shown_ : picture_);
        if (trial.is_drawn_into_maps) trial.about.triangles = triangles_ - std::min(map_triangles(frame), triangles_);
        if (trial.map) trial.about.read = share_read(trial);
    }

    bool changes_same_surfaces(const WorkTrial& trial) {
        FrameRequest request = request_;
        request.outputs.surface_ids = true;
        const FrameResult with = draw(scene_, measured_, request);
        const SurfaceIds ids = renderer_.read_surface_ids(with.surface_ids);
        const FrameResult without = draw(trial, request);
        const SurfaceIds ids_without = renderer_.read_surface_ids(without.surface_ids);
        return differ_on_same_surfaces(scene_, picture_.front(), ids, renderer_.read_colour(without.colour),
                                       ids_without);
    }

    double share_read(const WorkTrial& trial) {
        FrameRequest request = request_;
        request.outputs = {.colour = false, .texels_read = true};
        const FrameResult frame = draw(scene_, trial.settings, request);
        if (frame.texels_read.texture == 0) return 0;
        return exact_utilisation(renderer_.read_float(frame.texels_read, 1));
    }

    /// Returns true when the time of a trial is measured. Needed work is not timed, nor are maps without triangles.
    /// Work on maps that are all waste is a part of the maps' time, which counts once.
    bool is_timed(const WorkTrial& trial) const {
        const bool counts = trial.is_drawn_into_maps ? trial.about.triangles > 0 : some_map_needed_;
        return trial.takes_map_time && !trial.about.changes && counts;
    }

    FrameRequest timed_request() const {
        FrameRequest request = request_;
        request.timing = true;
        return request;
    }

    /// Returns the milliseconds that maps save without a trial's work. Frames with and without the work alternate, and
    /// each kind is first every other turn.
    double saved_ms(const WorkTrial& trial) {
        const FrameRequest request = timed_request();
        std::vector<double> saved;
        for (int turn = 0; turn < kTimedTurns; ++turn) {
            double with = 0, without = 0;
            if (turn % 2 == 0) with = drawn_ms(draw(scene_, measured_, request), PassCategory::Maps);
            without = drawn_ms(draw(trial, request), PassCategory::Maps);
            if (turn % 2 != 0) with = drawn_ms(draw(scene_, measured_, request), PassCategory::Maps);
            whole_ms_.push_back(with);
            saved.push_back(with - without);
        }
        return spread_of(std::move(saved)).median;
    }

    double whole_ms() {
        while (whole_ms_.size() < std::size_t(kTimedTurns))
            whole_ms_.push_back(drawn_ms(draw(scene_, measured_, timed_request()), PassCategory::Maps));
        return spread_of(whole_ms_).median;
    }
};

}  // namespace

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

Waste find_waste(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                 const Workers& workers, const std::function<void(double)>& report) {
    return WasteSearch(renderer, scene, settings, request, workers).find(request.timing, report);
}

}  // namespace si
