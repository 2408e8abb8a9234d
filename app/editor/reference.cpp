#include "app/editor/reference.h"

#include <algorithm>
#include <utility>

#include "app/base/output.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/light_map_cache.h"

namespace si {
namespace {

struct LightNeed : ReferenceNeed {
    int light = 0;
    bool light_map = false;  ///< light map; else reference
};

/// Stores a result of one light in a list by light.
void store(auto& by_light, int light, auto what) {
    by_light.resize(std::max(by_light.size(), std::size_t(light) + 1));
    by_light[std::size_t(light)] = std::move(what);
}

/// Returns the references and light maps that a frame needs: of the shown light, and of lights whose source they are.
std::vector<LightNeed> needs_of(const FrameResult& frame, int shown_light) {
    std::vector<LightNeed> out;
    if (frame.reference.key != 0) out.push_back({frame.reference, shown_light});
    for (std::size_t i = 0; i < frame.traced.size(); ++i)
        if (frame.traced[i].key != 0) out.push_back({frame.traced[i], int(i)});
    for (std::size_t i = 0; i < frame.light_maps.size(); ++i)
        if (const LightMapNeed& n = frame.light_maps[i]; n.key != 0)
            out.push_back({ReferenceNeed{n.key, n.met}, int(i), true});
    return out;
}

nlohmann::ordered_json saved_error(const MeasuredError& measured) {
    const Reference& reference = *measured.traced.reference;
    nlohmann::ordered_json json = {{"format", "shadow-inspector-measurement"},
                                   {"version", 1},
                                   {"light", measured.light},
                                   {"width", measured.picture.x},
                                   {"height", measured.picture.y},
                                   {"map_resolution", measured.map_resolution},
                                   {"area", reference.is_area()},
                                   {"step", reference.step},
                                   {"truth_noise", reference.noise}};
    json["truth"] = reference_quality_json(reference);
    json["error"] = error_json(measured.metrics);
    return json;
}

}  // namespace

const TracedSoFar* EditorReference::so_far(const FrameResult& frame) const {
    const bool lacking = frame.reference.key != 0 && !frame.reference.met && frame.reference.key == so_far_key_;
    return lacking ? so_far_.get() : nullptr;
}

void EditorReference::clear() {
    job_.drop();
    so_far_.reset();
    kept_.clear();
    pictures_.clear();
    light_maps_.clear();
}

void EditorReference::release_unused_memory() {
    if (job_.busy()) return;  // the job uses the cache
    const bool shown =
        std::ranges::any_of(pictures_, [&](const auto& p) { return p && p->traced.receivers == cache_.receivers(); });
    if (!shown) cache_.clear();
}

std::shared_ptr<const ReferencePicture> EditorReference::picture(int light) const {
    return light >= 0 && std::size_t(light) < pictures_.size() ? pictures_[std::size_t(light)] : nullptr;
}

bool EditorReference::poll() {
    auto outcome = job_.poll();
    if (!outcome) return false;
    if (auto& found = outcome->value) {
        const auto take = [&](auto& by_light, auto& what) {
            if (!what) return;
            store(by_light, found->light, std::move(what));
            problem_.clear();
            given_up_.erase(doing_key_);
        };
        if (found->picture) {
            kept_.add(found->picture);
            so_far_.reset();
        }
        take(pictures_, found->picture);
        take(light_maps_, found->light_map);
        remark_ = std::move(found->remark);
    }
    if (outcome->problem) {
        given_up_.insert(doing_key_);
        problem_ = exception_message(outcome->problem);
        std::rethrow_exception(outcome->problem);
    }
    return true;
}

void EditorReference::begin_work(const char* doing, std::uint64_t key) {
    doing_ = doing;
    doing_key_ = key;
    left_ = {};
}

void EditorReference::start_trace(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, int light) {
    auto task = std::make_shared<ReferenceTask>(
        reference_task(renderer, scene, settings, request, light, reference_options(settings)));
    begin_work("Tracing rays", task->key);
    task->so_far = so_far_ = std::make_shared<TracedSoFar>();
    so_far_key_ = task->key;
    job_.start([this, light, task = std::move(task)](const Workers& workers, const auto&) {
        return Found{light, reference_picture(*task, cache_.trace(*task, workers)), {}, nullptr};
    });
}

void EditorReference::start_bake(const Scene& scene, const Settings& settings, const FrameResult& frame, int light) {
    auto task = std::make_shared<LightMapTask>(light_map_task(scene, settings, frame, light));
    begin_work("Baking the light map", task->key);
    job_.start([light, task = std::move(task)](const Workers& workers, const auto&) {
        return Found{light, nullptr, {}, si::light_maps().get(*task, workers)};
    });
}

void EditorReference::start_save(Renderer& renderer, const Scene& scene, const Settings& settings,
                                 const FrameRequest& request, const std::string& path) {
    require_writable(path);
    FrameRequest classified = request;
    classified.outputs = {.colour = false, .classified = true};
    classified.timing = classified.force = false;
    const FrameResult frame = renderer.render(scene, settings, classified);
    auto measured =
        std::make_shared<MeasuredError>(read_classified_pixels(renderer, frame, *request.reference, settings));
    measured->pictures = draw_picture_pair(renderer, scene, settings, request);
    begin_work("Measuring", request.reference->key);
    job_.start([path, measured = std::move(measured)](const Workers& workers, const auto&) {
        sum_error_metrics(*measured, workers);
        write_file(path, json_text(saved_error(*measured)));
        return Found{.remark = "Saved " + path};
    });
}

bool EditorReference::is_of_view(const Scene& scene, const Settings& settings, const FrameRequest& request,
                                 const FrameResult& frame) const {
    for (int light = 0; light < int(frame.lights.size()); ++light)
        if (reference_key(scene, settings, frame.camera, request.width, request.height, frame.lights, light,
                          reference_options(settings)) == doing_key_)
            return true;
    return false;
}

bool EditorReference::update(Renderer& renderer, const Scene& scene, const Settings& settings,
                             const FrameRequest& request, const FrameResult& frame, bool drawn,
                             const ReferenceRequests& requests) {
    const bool changed = poll();
    const std::vector<LightNeed> needs = needs_of(frame, settings.view.light);
    const auto wants = [&](std::uint64_t key) { return std::ranges::find(needs, key, &LightNeed::key) != needs.end(); };
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const bool shown = int(i) == settings.view.light;
        const bool wanted = std::ranges::find(needs, int(i), &LightNeed::light) != needs.end();
        if (!shown && !wanted) pictures_[i].reset();
    }
    for (std::size_t i = 0; i < light_maps_.size(); ++i)
        if (i >= frame.light_maps.size() || frame.light_maps[i].key == 0) light_maps_[i].reset();
    const auto next =
        std::ranges::find_if(needs, [&](const LightNeed& n) { return !n.met && !given_up_.contains(n.key); });
    if (requests.save_error) save_next_ = requests.save_error;
    if (!needs.empty()) {
        std::erase_if(given_up_, [&](std::uint64_t key) { return !wants(key); });
        if (given_up_.empty()) problem_.clear();
    }
    if (requests.cancel_reference) {
        if (job_.busy()) given_up_.insert(doing_key_);
        for (const LightNeed& n : needs)
            if (!n.met) given_up_.insert(n.key);
        problem_ = "Cancelled";
        job_.cancel();
    }
    if (job_.busy()) {
        const bool stale = !needs.empty() && !wants(doing_key_);
        // Another tab shows no errors, but the one before may come back.
        const bool unwanted = needs.empty() && !save_next_ && !is_of_view(scene, settings, request, frame);
        if (stale || unwanted) job_.cancel();
        return changed;
    }
    if (next != needs.end() && !next->light_map) {
        if (auto known = kept_.find(next->key); known && known != picture(next->light)) {
            store(pictures_, next->light, std::move(known));
            return true;
        }
    }
    // A new reference is drawn first; only then missing work is determined.
    const auto shown = picture(settings.view.light);
    if (drawn || changed || (shown && request.reference != shown) || request.traced != pictures_ ||
        request.light_maps != light_maps_)
        return changed;
    if (save_next_ && frame.reference.met) {
        start_save(renderer, scene, settings, request, *std::exchange(save_next_, {}));
    } else if (next != needs.end() && !given_up_.contains(next->key)) {
        if (next->light_map)
            start_bake(scene, settings, frame, next->light);
        else
            start_trace(renderer, scene, settings, request, next->light);
    } else if (save_next_) {
        remark_ = "Not saved: the reference of this view is not traced";
        save_next_.reset();
    } else {
        return changed;
    }
    return true;
}

ReferenceFacts EditorReference::facts(const FrameResult& frame, int shown_light) const {
    ReferenceFacts f;
    const std::vector<LightNeed> needs = needs_of(frame, shown_light);
    f.wanted = !needs.empty();
    f.current = f.wanted && std::ranges::all_of(needs, &LightNeed::met);
    f.lacks_light_map = std::ranges::any_of(needs, [](const LightNeed& n) { return n.light_map && !n.met; });
    f.problem = problem_;
    if (job_.busy()) f.doing = doing_;
    f.progress = job_.progress().value_or(0);
    if (const TracedSoFar* traced = so_far(frame)) f.traced_share = traced->share();
    if (job_.busy()) f.seconds_left = left_.seconds(f.progress);
    auto known = picture(shown_light);
    for (const LightNeed& n : needs)
        if (!known) known = picture(n.light);
    if (known) {
        const TracedReference& t = known->traced;
        f.build_ms = t.build_ms;
        f.place_ms = t.place_ms;
        f.trace_ms = t.trace_ms;
        f.rays = t.reference->rays;
        f.noise = noise_text(*t.reference);
        f.width = t.reference->width;
        f.height = t.reference->height;
    }
    return f;
}

}  // namespace si
