#include "renderer/inspect/map_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/bias/theory.h"
#include "renderer/bundle/drawn_casters.h"
#include "renderer/reference/first_surface.h"
#include "renderer/reference/ray_scenes.h"

namespace si {
namespace {

/// Least step of float formats. Rasterisers interpolate with an error of the last place of 1, whatever the depth is.
constexpr double kLeastFloatStep = 0x1p-23;
/// Steps of the format, and multiples of the median difference, beyond which a depth belongs to another surface.
constexpr double kSurfaceSteps = 4, kSurfaceMedians = 2;
/// Most differences of which medians and percentiles are taken.
constexpr std::size_t kMaxMeasured = 1 << 22;
/// Most rays of a search for lacking casters.
constexpr std::size_t kMaxRays = 1 << 16;
/// Greatest tangent between a surface's normal and the ray that widens the tolerance of a depth.
constexpr double kMaxTangent = 20;
/// Share of a caster's texels below which nothing counts as lacking.
constexpr double kLeastLackingShare = 0.05;

double step_of(MapFormat format, double depth) {
    const double step = depth_quantum(format, depth);
    return format == MapFormat::D16 || format == MapFormat::D24 ? step : std::max(step, kLeastFloatStep);
}

/// Returns the quantile of a list. @param values not empty, reordered
double quantile_of(std::vector<double>& values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Returns the distribution of differences. @param max largest absolute difference
DepthDifferences differences_of(std::vector<double> values, double max) {
    DepthDifferences out{.median = 0, .most_of_99 = 0, .max = max, .signed_median = 0};
    if (values.empty()) return out;
    out.signed_median = quantile_of(values, 0.5);
    for (double& v : values) v = std::abs(v);
    out.median = quantile_of(values, 0.5);
    out.most_of_99 = quantile_of(values, 0.99);
    return out;
}

/// Extends a box by a texel.
void add_texel(TexelBox& box, int x, int y) {
    if (box.is_empty()) {
        box = {{x, y}, {x + 1, y + 1}};
        return;
    }
    box.from = glm::min(box.from, glm::ivec2(x, y));
    box.to = glm::max(box.to, glm::ivec2(x + 1, y + 1));
}

/// Place of texels in a view: distances along the axis, and their ratio to the ray.
class TexelRays {
public:
    TexelRays(const LightView& view, MapSize size) : view_(view), size_(size) {}

    glm::dvec2 uv(int x, int y) const { return {(x + 0.5) / size_.width, 1 - (y + 0.5) / size_.height}; }
    /// Returns metres along the axis at a depth of a texel.
    double axis_m(const glm::dvec2& uv, double depth) const { return curve(uv).distance(depth); }
    /// Returns metres along the ray per metre along the axis.
    double ray_per_axis(const glm::dvec2& uv) const {
        return view_.curve.perspective ? glm::length(view_.position_ws(uv, 1) - view_.eye) : 1;
    }
    DepthCurve curve(const glm::dvec2& uv) const {
        return view_.warped() ? view_.curve.curve_at_row(uv.y) : view_.curve;
    }
    double texel_m(const glm::dvec2& uv, double axis_m) const {
        return view_.texel_size_at(view_.position_ws(uv, axis_m), size_).longest;
    }

private:
    const LightView& view_;
    MapSize size_;
};

/// Compares two images texel by texel.
class MapComparer {
public:
    MapComparer(const FloatImage& imported, const FloatImage& drawn, const LightView& view, MapFormat format,
                const std::vector<bool>& masked, const MapCompareOptions& options)
        : imported_(imported),
          drawn_(drawn),
          view_(view),
          format_(format),
          masked_(masked),
          options_(options),
          far_(float(view.curve.convention.far_depth())),
          rays_(view, {imported.width, imported.height}) {}

    MapComparison compare() {
        out_.size = {imported_.width, imported_.height};
        out_.room_m = options_.room_m;
        classify();
        measure();
        find_other_surfaces();
        decide();
        return std::move(out_);
    }

private:
    const FloatImage &imported_, &drawn_;
    const LightView& view_;
    MapFormat format_;
    const std::vector<bool>& masked_;
    const MapCompareOptions& options_;
    float far_;
    TexelRays rays_;
    MapComparison out_;

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(out_.size.width) + std::size_t(x); }
    static bool is_valid(float depth) { return depth >= 0 && depth <= 1; }
    bool holds_caster(const FloatImage& image, int x, int y) const {
        const float depth = image.at(x, y);
        return is_valid(depth) && depth != far_;
    }

    template <class Visit>
    void each(const Visit& visit) {
        for (int y = 0; y < out_.size.height; ++y)
            for (int x = 0; x < out_.size.width; ++x) visit(x, y);
    }

    /// Returns true when the imported map holds a caster within the border around a texel.
    bool near_covered(int x, int y) const {
        const int reach = options_.border_texels;
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, out_.size.height - 1); ++v)
            for (int u = std::max(x - reach, 0); u <= std::min(x + reach, out_.size.width - 1); ++u)
                if (holds_caster(imported_, u, v)) return true;
        return false;
    }

    void classify() {
        out_.match.resize(std::size_t(out_.size.width) * std::size_t(out_.size.height));
        each([&](int x, int y) {
            const std::size_t i = index(x, y);
            out_.invalid += !is_valid(imported_.at(x, y));
            if (!masked_.empty() && masked_[i]) {
                out_.match[i] = TexelMatch::Masked;
                ++out_.masked;
                return;
            }
            const bool theirs = holds_caster(imported_, x, y), ours = holds_caster(drawn_, x, y);
            out_.covered += theirs;
            out_.drawn += ours;
            if (theirs && ours) {
                out_.match[i] = TexelMatch::Both;
                ++out_.both;
            } else if (theirs) {
                out_.match[i] = TexelMatch::Missed;
                ++out_.missed;
                add_texel(out_.unexplained, x, y);
            } else if (ours) {
                out_.match[i] = TexelMatch::Extra;
                const bool border = options_.border_texels > 0 && near_covered(x, y);
                ++(border ? out_.extra_border : out_.extra);
                if (!border) add_texel(out_.lacking, x, y);
            }
        });
    }

    void measure() {
        // Medians of large maps need an even sample only; the largest difference is that of all texels.
        const std::size_t stride = out_.both / kMaxMeasured + 1;
        std::vector<double> steps, depth, metres, texels, step;
        for (auto* list : {&steps, &depth, &metres, &texels, &step}) list->reserve(out_.both / stride + 1);
        double most_steps = 0, most_depth = 0, most_metres = 0, most_texels = 0;
        out_.difference_m.assign(out_.match.size(), 0);
        const double away = view_.curve.convention.reversed ? -1 : 1;
        std::size_t count = 0;
        each([&](int x, int y) {
            if (out_.match[index(x, y)] != TexelMatch::Both) return;
            const double theirs = imported_.at(x, y), ours = drawn_.at(x, y), difference = away * (theirs - ours);
            const double step_here = step_of(format_, std::max(theirs, ours));
            const glm::dvec2 uv = rays_.uv(x, y);
            const double z = rays_.axis_m(uv, ours), along = rays_.axis_m(uv, theirs) - z;
            const double along_ray = along * rays_.ray_per_axis(uv), in_texels = along / rays_.texel_m(uv, z);
            out_.difference_m[index(x, y)] = float(along_ray);
            most_steps = std::max(most_steps, std::abs(difference / step_here));
            most_depth = std::max(most_depth, std::abs(difference));
            most_metres = std::max(most_metres, std::abs(along_ray));
            most_texels = std::max(most_texels, std::abs(in_texels));
            if (count++ % stride != 0) return;
            step.push_back(step_here);
            depth.push_back(difference);
            steps.push_back(difference / step_here);
            metres.push_back(along_ray);
            texels.push_back(in_texels);
        });
        if (!step.empty()) out_.step = quantile_of(step, 0.5);
        out_.steps = differences_of(std::move(steps), most_steps);
        out_.depth = differences_of(std::move(depth), most_depth);
        out_.metres = differences_of(std::move(metres), most_metres);
        out_.texels = differences_of(std::move(texels), most_texels);
    }

    /// Finds texels in both maps whose depths belong to different surfaces. Bias, and edges that run one texel beside,
    /// do not count.
    void find_other_surfaces() {
        const double away = view_.curve.convention.reversed ? -1 : 1;
        const double bias = kSurfaceMedians * std::abs(out_.depth.signed_median);
        each([&](int x, int y) {
            if (out_.match[index(x, y)] != TexelMatch::Both) return;
            double least = std::numeric_limits<double>::infinity(), most = -least;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, out_.size.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, out_.size.width - 1); ++u) {
                    const double d = away * drawn_.at(u, v);
                    least = std::min(least, d);
                    most = std::max(most, d);
                }
            const double theirs = away * imported_.at(x, y);
            // The depth range around a texel is that of two texels. Bias by slope is less than as much again.
            double room = kSurfaceSteps * step_of(format_, std::abs(theirs)) + bias + (most - least);
            if (out_.room_m > 0) {
                const glm::dvec2 uv = rays_.uv(x, y);
                room += out_.room_m * rays_.curve(uv).slope(rays_.axis_m(uv, drawn_.at(x, y)));
            }
            if (theirs < least - room) {
                ++out_.nearer;
                add_texel(out_.unexplained, x, y);
            } else if (theirs > most + room) {
                ++out_.farther;
                add_texel(out_.lacking, x, y);
            }
        });
    }

    /// Returns the share of texels at which another reading of the imported map agrees with the drawn map.
    template <class Read>
    double agreement(const Read& read) const {
        std::size_t agree = 0, count = 0;
        for (int y = 0; y < out_.size.height; ++y)
            for (int x = 0; x < out_.size.width; ++x) {
                const double theirs = read(x, y), ours = drawn_.at(x, y);
                if (float(theirs) == far_ && float(ours) == far_) continue;
                ++count;
                agree += (float(theirs) == far_) == (float(ours) == far_) && std::abs(theirs - ours) < 0.01;
            }
        return count > 0 ? double(agree) / double(count) : 0;
    }

    /// Looks for another convention that fits much better.
    std::string hint() const {
        const double now = agreement([&](int x, int y) { return double(imported_.at(x, y)); });
        const auto is_better = [&](double other) { return other > 0.5 && other > now + 0.2; };
        const int last = out_.size.height - 1, end = out_.size.width - 1;
        if (is_better(agreement([&](int x, int y) { return double(imported_.at(x, last - y)); })))
            return "its rows run the other way: the other image.first_row fits";
        if (is_better(agreement([&](int x, int y) { return double(imported_.at(end - x, y)); })))
            return "its columns run the other way: the first column of the matrix has the other sign";
        // The clear value of the other convention is this one's near plane.
        if (is_better(agreement([&](int x, int y) { return 1.0 - double(imported_.at(x, y)); })))
            return "its depth runs the other way: the other depth.reversed fits";
        return {};
    }

    void decide() {
        MapGate& gate = out_.gate;
        const MapGateLimits& limits = options_.limits;
        gate.missed = out_.missed_share() <= limits.missed_share;
        gate.extra = out_.extra_share() <= limits.extra_share;
        const bool measured = out_.both > 0 || (out_.covered == 0 && out_.drawn == 0);
        gate.median = measured && out_.steps.median <= limits.median_steps;
        gate.most = measured && out_.steps.most_of_99 <= limits.most_steps;
        std::vector<std::string> faults;
        if (!gate.missed)
            faults.push_back(fmt::format("{:.2f} % of its texels are missed, more than {:g} %",
                                         100 * out_.missed_share(), 100 * limits.missed_share));
        if (!gate.extra)
            faults.push_back(fmt::format("{} are extra, {:.2f} %, more than {:g} %",
                                         out_.extra == 1 ? "1 texel" : fmt::format("{} texels", out_.extra),
                                         100 * out_.extra_share(), 100 * limits.extra_share));
        if (!measured) faults.push_back("no texel holds a caster in both maps, so no depth was compared");
        if (measured && !gate.median)
            faults.push_back(fmt::format("the median depth differs by {} steps ({}), more than {:g}",
                                         digits_text(out_.steps.median), metres_text(out_.metres.median),
                                         limits.median_steps));
        if (measured && !gate.most)
            faults.push_back(fmt::format("99 % of the depths lie within {} steps ({}), not within {:g}",
                                         digits_text(out_.steps.most_of_99), metres_text(out_.metres.most_of_99),
                                         limits.most_steps));
        if (faults.empty()) {
            gate.text = "passed: the scene draws this map";
            return;
        }
        gate.text = fmt::format("failed: {}", fmt::join(faults, "; "));
        gate.hint = hint();
    }
};

/// Returns the texels that masked casters may cover, holes included.
std::vector<bool> masked_texels(Renderer& renderer, const Scene& scene, const Settings& settings,
                                const FrameRequest& request, int light, int view) {
    const auto is_masked = [&](const Object& object) {
        const int material = scene.meshes[std::size_t(object.mesh)].material;
        return material >= 0 && scene.materials[std::size_t(material)].alpha == AlphaMode::Mask;
    };
    if (std::ranges::none_of(scene.objects, is_masked)) return {};
    Scene solid = scene;
    for (Material& material : solid.materials)
        if (material.alpha == AlphaMode::Mask) material.alpha = AlphaMode::Opaque;
    std::erase_if(solid.objects, [&](const Object& object) { return !is_masked(object); });
    solid.hidden.clear();
    refresh(solid);
    const FrameResult frame = renderer.render(solid, settings, request);
    const FloatImage depths = renderer.read_shadow_map(frame, light, view);
    const float far_depth =
        float(frame.lights[std::size_t(light)].views[std::size_t(view)].curve.convention.far_depth());
    std::vector<bool> out(depths.data.size());
    // Edges of a mask may run one texel beside.
    for (int y = 0; y < depths.height; ++y)
        for (int x = 0; x < depths.width; ++x) {
            if (depths.at(x, y) == far_depth) continue;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, depths.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, depths.width - 1); ++u)
                    out[std::size_t(v) * std::size_t(depths.width) + std::size_t(u)] = true;
        }
    return out;
}

/// Returns the node paths of a scene's objects that are not drawn into a map. Where a name is unknown, all count as
/// drawn.
std::set<std::string> casters_left_out(const Scene& scene, const ImportedMaps& given, std::size_t view) {
    if (view >= given.drawn.size() || !given.drawn[view]) return {};
    DrawnCasters casters = drawn_casters(scene, {given.drawn[view]->begin(), given.drawn[view]->end()});
    return casters.unknown > 0 ? std::set<std::string>() : std::move(casters.left_out);
}

}  // namespace

MapComparison compare_maps(const FloatImage& imported, const FloatImage& drawn, const LightView& view, MapFormat format,
                           const std::vector<bool>& masked, const MapCompareOptions& options) {
    if (imported.width != drawn.width || imported.height != drawn.height)
        throw Error(fmt::format("the imported map has {}×{} texels and the drawn one {}×{}; compare maps of one size",
                                imported.width, imported.height, drawn.width, drawn.height));
    return MapComparer(imported, drawn, view, format, masked, options).compare();
}

std::vector<LackingCaster> lacking_casters(const FloatImage& imported, const FloatImage& drawn, const LightView& view,
                                           const MapComparison& comparison, const ReferenceScene& scene,
                                           const std::vector<ObjectTraits>& traits, double offset_factor,
                                           const Workers& workers) {
    const TexelRays rays(view, comparison.size);
    std::vector<glm::ivec2> places;
    for (int y = 0; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x) {
            const TexelMatch match = comparison.match[std::size_t(y) * std::size_t(drawn.width) + std::size_t(x)];
            if (match == TexelMatch::Both || match == TexelMatch::Extra) places.emplace_back(x, y);
        }
    const std::size_t stride = (places.size() + kMaxRays - 1) / kMaxRays;
    std::vector<glm::ivec2> traced;
    std::vector<LightRaySegment> segments;
    for (std::size_t i = 0; i < places.size(); i += std::max<std::size_t>(stride, 1)) {
        const glm::dvec2 uv = rays.uv(places[i].x, places[i].y);
        const DepthCurve curve = rays.curve(uv);
        // Casters before the near plane count where they are drawn on it.
        const double before = view.clamps_near && !curve.perspective ? 10 * (curve.far - curve.near) : 0;
        traced.push_back(places[i]);
        segments.push_back({view.position_ws(uv, curve.near - before), view.position_ws(uv, curve.far)});
    }
    const auto firsts = first_casters(scene, segments, traits, workers);
    std::vector<LackingCaster> by_object(scene.geometry().objects.size());
    const float far_depth = float(view.curve.convention.far_depth());
    for (std::size_t i = 0; i < traced.size(); ++i) {
        if (!firsts[i]) continue;
        const auto [x, y] = std::pair(traced[i].x, traced[i].y);
        LackingCaster& caster = by_object[firsts[i]->object];
        ++caster.texels;
        const float stored = imported.at(x, y);
        if (!(stored >= 0 && stored <= 1) || stored == far_depth) {
            ++caster.empty;
            continue;
        }
        const glm::dvec2 uv = rays.uv(x, y);
        const double ours = rays.axis_m(uv, drawn.at(x, y)), theirs = rays.axis_m(uv, stored);
        const glm::dvec3 ray = glm::normalize(segments[i].to_ws - segments[i].from_ws);
        const double cosine = std::abs(glm::dot(ray, firsts[i]->normal_ws));
        const double tangent =
            cosine > 0 ? std::min(std::sqrt(std::max(1 - cosine * cosine, 0.0)) / cosine, kMaxTangent) : kMaxTangent;
        const double step_m = comparison.step / rays.curve(uv).slope(ours);
        const double room = comparison.room_m + kSurfaceSteps * step_m +
                            kSurfaceMedians * std::abs(comparison.metres.signed_median) +
                            (1.5 + std::abs(offset_factor)) * tangent * rays.texel_m(uv, ours);
        caster.farther += theirs > ours + room;
    }
    std::vector<LackingCaster> out;
    for (std::size_t object = 0; object < by_object.size(); ++object) {
        LackingCaster& caster = by_object[object];
        if (caster.empty + caster.farther == 0 || caster.lacking_share() < kLeastLackingShare) continue;
        caster.object = object;
        caster.path = scene.geometry().objects[object].path;
        for (std::size_t* count : {&caster.texels, &caster.empty, &caster.farther}) *count *= stride;
        out.push_back(caster);
    }
    std::ranges::stable_sort(
        out, [](const LackingCaster& a, const LackingCaster& b) { return a.empty + a.farther > b.empty + b.farther; });
    return out;
}

std::vector<ComparedMap> compare_imported_maps(Renderer& renderer, const Scene& scene, const Settings& settings,
                                               const std::vector<std::shared_ptr<const ImportedMaps>>& maps, int light,
                                               const MapCompareOptions& options, const Workers& workers) {
    const ImportedMaps* given =
        light >= 0 && std::size_t(light) < maps.size() ? maps[std::size_t(light)].get() : nullptr;
    if (!given || !given->has_images() || !given->views)
        throw Error(fmt::format("light {} has no imported map to compare with; choose a light that has one", light));
    if (light >= settings.light_count)
        throw Error(fmt::format("there is no light {}; light.count is {}", light, settings.light_count));
    Settings own = settings;
    own.map.blur_texels = 0;
    own.view = {};
    for (int i = 0; i < own.light_count; ++i)
        own.lights[std::size_t(i)].cast = i == light;  // maps of others take memory
    own.view.light = light;
    FrameRequest request{.width = 16, .height = 16, .outputs = {.colour = false, .shadow_map = true}};
    request.imported.resize(std::size_t(light) + 1);
    request.imported.back() = drawn_maps(*given->views, given->size(), given->raster);
    const FrameResult frame = renderer.render(scene, own, request);
    const FittedLight& fitted = frame.lights.at(std::size_t(light));
    if (!fitted.casts)
        throw Error(fmt::format("light {} has no shadow map: {}", light,
                                fitted.reason.empty() ? "its source is another" : fitted.reason));
    const ViewChoice choice = fitted.chooser.choice;
    std::vector<FloatImage> whole;  // maps of all casters
    for (std::size_t v = 0; v < given->images.size(); ++v)
        whole.push_back(renderer.read_shadow_map(frame, light, int(v)));
    std::vector<ComparedMap> out;
    const auto casters = ray_scenes().get(ray_scenes().geometry(scene, own), workers);
    for (std::size_t v = 0; v < given->images.size(); ++v) {
        const std::set<std::string> left_out = casters_left_out(scene, *given, v);
        Settings drawn_there = own;
        for (const std::string& path : left_out) drawn_there.objects[path].cast = false;
        ComparedMap map{
            .numbers = {}, .view = given->views->views[v], .imported = given->images[v], .drawn = {}, .lacking = {}};
        if (left_out.empty())
            map.drawn = std::move(whole[v]);
        else
            map.drawn = renderer.read_shadow_map(renderer.render(scene, drawn_there, request), light, int(v));
        const FloatImage& of_all = left_out.empty() ? map.drawn : whole[v];
        MapCompareOptions applied = options;
        if (const CasterShift& shift = given->views->views[v].caster_shift; shift.moves()) {
            applied.limits = kMovedCasterLimits;
            applied.room_m = std::abs(shift.grazing_m);
        }
        const std::vector<bool> masked = options.leaves_out_masked
                                             ? masked_texels(renderer, scene, drawn_there, request, light, int(v))
                                             : std::vector<bool>{};
        map.numbers = compare_maps(map.imported, map.drawn, map.view, own.map.format, masked, applied);
        map.numbers.light = light;
        map.numbers.view = int(v);
        map.numbers.name = view_name(choice, v, given->images.size());
        auto traits = object_traits(scene, own);
        double factor = own.bias.raster_slope;
        if (v < given->raster.size()) {
            factor = given->raster[v].offset_factor;
            if (const auto cull = given->raster[v].cull)
                for (const Object& object : scene.objects) {
                    const ObjectCull chosen = object_settings(scene, own, object).cull;
                    traits[std::size_t(&object - scene.objects.data())].cull = cull_in_force(chosen, *cull);
                }
        }
        MapComparison with_all;  // with all casters, where some are left out
        if (!left_out.empty()) {
            with_all = compare_maps(map.imported, of_all, map.view, own.map.format, masked, applied);
            if (map.numbers.gate.passed())
                map.numbers.gate.text = "passed: the casters that were drawn there draw this map";
        }
        map.lacking = lacking_casters(map.imported, of_all, map.view, left_out.empty() ? map.numbers : with_all,
                                      *casters, traits, factor, workers);
        for (LackingCaster& caster : map.lacking) caster.drawn = !left_out.contains(caster.path);
        std::stable_partition(map.lacking.begin(), map.lacking.end(), [](const LackingCaster& c) { return c.drawn; });
        out.push_back(std::move(map));
    }
    return out;
}

std::string lacking_caster_text(const LackingCaster& caster) {
    const std::string_view where = caster.farther == 0 ? "it is empty there"
                                   : caster.empty == 0 ? "it holds a surface behind there"
                                                       : "it is empty or holds a surface behind there";
    return fmt::format("{}: the map lacks {} ({} of {} texels; {}{})", caster.path.empty() ? "(unnamed)" : caster.path,
                       caster.is_whole() ? "it" : "a part of it", caster.empty + caster.farther, caster.texels, where,
                       caster.drawn ? "" : "; it was not drawn there");
}

double difference_scale_m(const MapComparison& comparison) {
    const double step_m = comparison.steps.max > 0 && comparison.depth.max > 0
                              ? comparison.metres.max * comparison.step / comparison.depth.max
                              : 0;
    const double metres = std::max(comparison.metres.most_of_99, step_m);
    if (!(metres > 0) || !std::isfinite(metres)) return 1e-3;
    const double unit = std::pow(10.0, std::floor(std::log10(metres)));
    return std::ceil(metres / unit * (1 - 1e-6)) * unit;
}

std::array<std::uint8_t, 3> difference_colour(double metres, double scale_m) {
    const double share = std::clamp(metres / scale_m, -1.0, 1.0), amount = std::abs(share);
    constexpr glm::dvec3 kWhite(240), kNearer(33, 102, 172), kFarther(178, 24, 43);
    const glm::dvec3 colour = glm::mix(kWhite, share < 0 ? kNearer : kFarther, amount);
    return {std::uint8_t(std::lround(colour.r)), std::uint8_t(std::lround(colour.g)),
            std::uint8_t(std::lround(colour.b))};
}

ByteImage linear_picture(const ComparedMap& map, const FloatImage& image) {
    const float far_depth = float(map.view.curve.convention.far_depth());
    const auto distance = [&](const FloatImage& of, int x, int y) {
        const float depth = of.at(x, y);
        if (!(depth >= 0 && depth <= 1) || depth == far_depth) return std::numeric_limits<double>::quiet_NaN();
        const DepthCurve curve =
            map.view.warped() ? map.view.curve.curve_at_row(1 - (y + 0.5) / of.height) : map.view.curve;
        return curve.distance(depth);
    };
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (const FloatImage* of : {&map.imported, &map.drawn})
        for (int y = 0; y < of->height; ++y)
            for (int x = 0; x < of->width; ++x) {
                const double z = distance(*of, x, y);
                if (std::isnan(z)) continue;
                nearest = std::min(nearest, z);
                farthest = std::max(farthest, z);
            }
    ByteImage out{image.width, image.height, {}};
    out.data.reserve(4 * image.data.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double z = distance(image, x, y);
            const double share = std::isnan(z)        ? 1
                                 : farthest > nearest ? 0.9 * (z - nearest) / (farthest - nearest)
                                                      : 0;
            const auto grey = std::uint8_t(std::lround(255 * share));
            out.data.insert(out.data.end(), {grey, grey, grey, 255});
        }
    return out;
}

ByteImage difference_picture(const MapComparison& comparison, double scale_m) {
    const MapDifferenceColours colours;
    ByteImage out{comparison.size.width, comparison.size.height, {}};
    out.data.reserve(4 * comparison.match.size());
    for (std::size_t i = 0; i < comparison.match.size(); ++i) {
        std::array<std::uint8_t, 3> rgb = colours.empty;
        switch (comparison.match[i]) {
            case TexelMatch::Empty:
                break;
            case TexelMatch::Both:
                rgb = difference_colour(comparison.difference_m[i], scale_m);
                break;
            case TexelMatch::Missed:
                rgb = colours.missed;
                break;
            case TexelMatch::Extra:
                rgb = colours.extra;
                break;
            case TexelMatch::Masked:
                rgb = colours.masked;
                break;
        }
        out.data.insert(out.data.end(), {rgb[0], rgb[1], rgb[2], 255});
    }
    return out;
}

}  // namespace si
