#include "renderer/reference/umbra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "renderer/projection/projection.h"
#include "renderer/reference/umbra_cache.h"

namespace si {
namespace {

constexpr std::size_t kPoints = 8;
/// Samples of an area light per point: as many as the reference takes next to penumbrae.
constexpr int kAreaSamples = 64;

using Points = std::array<glm::dvec3, kPoints>;

/// Returns the coarser of the views in which a point is looked up.
const LightView& coarser_view(const FittedLight& light, const glm::dvec3& point_ws, MapSize size) {
    const ChosenView chosen = light.chooser.choose(light.views, point_ws);
    const LightView &view = light.views[chosen.view], &other = light.views[chosen.other];
    const auto texel_m = [&](const LightView& v) { return v.texel_size_at(point_ws, size).longest; };
    return chosen.share > 0 && texel_m(other) > texel_m(view) ? other : view;
}

/// Returns the points around a receiver on its plane; none where the plane does not meet the light's ray.
std::optional<Points> points_around(const Receiver& r, const FittedLight& light, MapSize size, double reach_texels) {
    Points points;
    points.fill(r.position_ws);
    if (light.views.empty()) return points;
    const LightView& view = coarser_view(light, r.position_ws, size);
    const glm::dvec4 clip = view.clip_position(r.position_ws);
    const glm::dvec2 at = uvd_from_ndc(view.curve.convention, glm::dvec3(clip) / clip.w);
    const glm::dvec2 reach = reach_texels / size.texels();
    std::size_t i = 0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) continue;
            const glm::dvec2 uv = at + reach * glm::dvec2(x, y);
            const glm::dvec3 first = view.position_ws(uv, view.curve.near), last = view.position_ws(uv, view.curve.far);
            const double along = glm::dot(r.normal_ws, last - first);
            const glm::dvec3 point = first + (last - first) * (glm::dot(r.normal_ws, r.position_ws - first) / along);
            const bool behind = view.curve.perspective && !(glm::dot(view.eye - point, view.axes[2]) > 0);
            if (behind || !std::isfinite(point.x + point.y + point.z)) return {};
            points[i++] = point;
        }
    return points;
}

/// Adds one receiver per point to a row of receivers.
void add_points(Receivers& to, Receiver r, const Points& points) {
    for (const glm::dvec3& point : points) {
        r.position_ws = point;
        to.pixels.push_back(r);
    }
    ++to.height;
}

std::uint64_t umbra_key(const FittedLight& light, MapSize size, double reach_texels) {
    Key key;
    key.add(reach_texels)
        .add(size.sides())
        .add(light.chooser.choice)
        .add(light.chooser.from_ws)
        .add(light.chooser.forward);
    for (const LightView& view : light.views) key.add(view.clip_from_relative(glm::dvec3(0)));
    for (const ViewSpan& span : light.chooser.spans) key.add(span.ends).add(span.blends_from);
    return key.value();
}

bool all_dark(const Reference& row, std::size_t first) {
    const auto begin = row.visibility.data.begin() + std::ptrdiff_t(first);
    return std::all_of(begin, begin + kPoints, [](float v) { return v == 0; });
}

/// Traces the points around receivers that are dark themselves.
/// @returns one number per receiver: 1 in the umbra, else 0
std::vector<std::uint8_t> trace_umbra(const ReferenceScene& scene, const std::vector<Receiver>& receivers,
                                      ReferenceQuery query, const FittedLight& light, MapSize size, double reach_texels,
                                      const Workers& workers) {
    std::vector<std::uint8_t> umbra(receivers.size(), 0);
    std::vector<std::size_t> tested;  // indices into `receivers`
    Receivers around{.width = int(kPoints), .height = 0, .pixels = {}};
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        const auto points = points_around(receivers[i], light, size, reach_texels);
        if (!points) continue;
        add_points(around, receivers[i], *points);
        tested.push_back(i);
    }
    if (tested.empty()) return umbra;
    const bool area = query.options.area;
    query.options.nearest = query.options.area = false;
    query.options.step = 1;
    const Reference hard = trace_visibility(scene, around, query, workers.with_progress_range(0, area ? 0.2 : 1));
    std::vector<std::size_t> dark;  // indices into `tested`
    for (std::size_t k = 0; k < tested.size(); ++k)
        if (all_dark(hard, k * kPoints)) dark.push_back(k);
    for (const std::size_t k : dark) umbra[tested[k]] = 1;
    if (!area) return umbra;
    query.options.area = true;
    query.options.samples = query.options.first_samples = std::min(query.options.samples, kAreaSamples);
    // Samples on the light depend on a point's place in its image. A row of its own makes them the same in every call.
    const Workers here{.threads = 1};
    parallel_for_blocks(dark.size(), workers.with_progress_range(0.2, 1), [&](std::size_t d) {
        const std::size_t k = dark[d];
        Receivers row{.width = int(kPoints), .height = 1, .pixels = {}};
        row.pixels.assign(around.pixels.begin() + std::ptrdiff_t(k * kPoints),
                          around.pixels.begin() + std::ptrdiff_t((k + 1) * kPoints));
        umbra[tested[k]] = all_dark(trace_visibility(scene, row, query, here), 0);
    });
    return umbra;
}

}  // namespace

bool in_umbra(const ReferenceScene& scene, const Receiver& receiver, const ReferenceQuery& query,
              const FittedLight& light, MapSize size, double reach_texels) {
    ReferenceQuery hard = query;
    hard.options = {.nearest = false};
    const Workers here{.threads = 1};
    const Reference own = trace_visibility(scene, {1, 1, {receiver}}, hard, here);
    if (own.state[0] != PixelState::Counted || own.visibility.data[0] != 0) return false;
    return trace_umbra(scene, {receiver}, hard, light, size, reach_texels, here)[0] != 0;
}

std::vector<std::uint8_t> umbra_of(const TracedReference& traced, const FittedLight& light, MapSize size,
                                   double reach_texels, std::span<const std::size_t> pixels, const Workers& workers) {
    using State = UmbraCache::State;
    const std::uint64_t key = umbra_key(light, size, reach_texels);
    std::vector<State> states = traced.umbra->find(key, traced.reference->state.size());
    const Reference& reference = *traced.reference;
    std::vector<std::size_t> unknown;
    std::vector<Receiver> receivers;
    for (const std::size_t p : pixels) {
        if (states[p] != State::Unknown) continue;
        states[p] = State::Outside;
        if (reference.state[p] != PixelState::Counted || reference.visibility.data[p] != 0) continue;
        unknown.push_back(p);
        receivers.push_back(traced.receivers->pixels[p]);
    }
    const std::vector<std::uint8_t> found =
        trace_umbra(*traced.scene, receivers, *traced.query, light, size, reach_texels, workers);
    for (std::size_t i = 0; i < unknown.size(); ++i)
        if (found[i]) states[unknown[i]] = State::Inside;
    std::vector<std::uint8_t> out;
    for (const std::size_t p : pixels) out.push_back(states[p] == State::Inside);
    if (!unknown.empty()) traced.umbra->store(key, std::move(states));
    return out;
}

}  // namespace si
