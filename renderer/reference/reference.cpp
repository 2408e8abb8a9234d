#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "renderer/bias/light_receiver.h"
#include "renderer/reference/reference_rays.h"

namespace si {
namespace {

constexpr int kTile = 16;  ///< pixels a side: rays of neighbours visit the same nodes
/// Limit of adjacent tiles per block of work. Adjacent tiles share cache lines, so that one thread takes several.
constexpr std::size_t kTilesInTurn = 8;
constexpr std::size_t kBlocksPerThread = 4;  ///< least blocks per thread
constexpr int kSquare = 4;                   ///< pixels a side of one ray packet
constexpr int kFirstParts = 8;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Batch of shadow rays; those that need double precision are separate.
struct RayBatch {
    std::vector<RTCRay> plain, grazing;
    std::vector<ExactRay> exact;
    std::vector<std::uint32_t> grazing_of;  ///< caller's number of each grazing ray; others carry it as their id

    void clear() {
        plain.clear();
        grazing.clear();
        exact.clear();
        grazing_of.clear();
    }

    /// @param direction unit @param length unit frame
    void add(std::uint32_t number, const Receiver& r, const glm::vec3& origin, const glm::dvec3& direction,
             double cosine, double length) {
        if (cosine >= kGrazingCosine) {
            plain.push_back(make_ray(origin, glm::vec3(direction), float(length), number));
            return;
        }
        grazing.push_back(make_ray(origin, glm::vec3(direction), float(length), unsigned(grazing.size())));
        grazing_of.push_back(number);
        exact.push_back({glm::dvec3(origin), direction, length, r.object, r.primitive});
    }

    template <typename Occluded>
    void trace(const RayHierarchy& scene, std::span<const ObjectTraits> culls, Occluded&& occluded) {
        mark_occluded(scene, plain, {culls, {}});
        for (const RTCRay& ray : plain) occluded(ray.id, ray.tfar < 0);
        mark_occluded(scene, grazing, {culls, exact});
        for (std::size_t i = 0; i < grazing.size(); ++i) occluded(grazing_of[i], grazing[i].tfar < 0);
    }
    std::size_t size() const { return plain.size() + grazing.size(); }
};

/// Estimated visible share of the light, and its standard error; NaN: unknown.
struct Estimate {
    double visibility = 1, error = 0;
};

/// Variance of light samples, estimated from groups of neighbouring samples.
struct Variance {
    double sum = 0;         ///< group sizes times the sample variance, summed over groups
    std::size_t known = 0;  ///< number of samples in the estimate

    /// Adds a group of samples. @param above samples above the horizon @param lit samples of those that are lit
    void add(int lit, int above) {
        if (above < 2) return;  // one sample has no variance
        sum += double(lit) * (above - lit) / (above - 1);
        known += std::size_t(above);
    }
    /// Returns the standard error of a share that is estimated by `samples` samples.
    double standard_error(std::size_t samples) const {
        return known == 0 ? kNaN : std::sqrt(sum / (double(known) * double(samples)));
    }
};

class Tracer {
public:
    Tracer(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query, Reference& out)
        : scene_(scene.impl()), geometry_(scene.geometry()), receivers_(receivers), query_(query), out_(out) {
        if (query.options.as_rasterised) culls_ = query.traits;
        to_light_ = glm::vec3(query.emitter.to_light);
        const auto& objects = scene.geometry().objects;
        if (!objects.empty() && objects.back().ground) ground_ = std::uint32_t(objects.size() - 1);
    }

    void trace_hard(const Workers& workers) {
        const bool quick = query_.emitter.type == LightType::Directional && query_.emitter.casts &&
                           receivers_.starts.size() == receivers_.pixels.size();
        for_tiles(workers, [&](int x0, int y0, int x1, int y1) {
            thread_local RayBatch batch;
            thread_local std::vector<Hit> hits;
            std::array<std::size_t, kPixelStates> pixels{};
            std::size_t on_ground = 0;
            batch.clear();
            for (int square_y = y0; square_y < y1; square_y += kSquare)
                for (int square_x = x0; square_x < x1; square_x += kSquare)
                    for (int y = square_y; y < std::min(square_y + kSquare, y1); ++y)
                        for (int x = square_x; x < std::min(square_x + kSquare, x1); ++x) {
                            const std::size_t i = index(x, y);
                            const PixelState state = quick ? classify_quickly(i, batch) : classify(i, batch);
                            ++pixels[std::size_t(state)];
                            if (ground_ && state == PixelState::Counted)
                                on_ground +=
                                    (quick ? receivers_.starts[i].object : receivers_.pixels[i].object) == ground_;
                        }
            batch.trace(scene_, culls_, [&](std::uint32_t i, bool occluded) {
                if (!occluded) return;
                out_.visibility.data[i] = 0;
                if (query_.options.nearest) find_nearest(i, hits);
            });
            const std::lock_guard guard(lock_);
            for (std::size_t s = 0; s < kPixelStates; ++s) out_.pixels[s] += pixels[s];
            out_.on_ground += on_ground;
            out_.rays += batch.size();
        });
    }

    /// Returns the caster nearest the light over a receiver that the map does not hold.
    std::optional<MissingCaster> missing_caster(std::size_t i) const {
        std::vector<Hit> hits;
        const RaySpan span = collect(i, hits);
        std::optional<MissingCaster> out;
        double farthest = 0;
        for (const Hit& hit : hits) {
            const double t = hit.t + span.origin_shift;
            if ((!hit.culled && t <= span.most) || t < farthest) continue;
            farthest = t;
            out = MissingCaster{hit.object, hit.culled};
        }
        return out;
    }

    /// Traces an area light adaptively: few samples everywhere, then four times as many in and next to penumbrae, and
    /// again where the error is too large.
    void trace_area(const Workers& workers) {
        const int most = std::max(1, int(std::sqrt(double(std::max(query_.options.samples, 1)))));
        error_.assign(out_.state.size(), 0);
        parts_.assign(out_.state.size(), 0);
        std::vector<std::uint8_t> wanted(out_.state.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = is_traced(out_.state[i]);
        for (int parts = std::min(kFirstParts, most), level = 0;; parts = std::min(2 * parts, most), ++level) {
            // Most of the work is in the first two levels.
            const double lo = level == 0 ? 0 : level == 1 ? 0.4 : 1 - std::exp2(-level - 1.0) * 2;
            const double hi = parts == most ? 1 : level == 0 ? 0.4 : 1 - std::exp2(-level - 2.0) * 2;
            sample(parts, wanted, workers.with_progress_range(std::min(lo, hi), hi));
            if (parts == most) break;
            wanted = level == 0 ? near_partial() : wanted;
            for (std::size_t i = 0; i < wanted.size(); ++i)
                wanted[i] = wanted[i] && (level == 0 || !(error_[i] <= query_.options.noise));
        }
        summarise();
    }

private:
    const RayHierarchy& scene_;
    const ReferenceGeometry& geometry_;
    const Receivers& receivers_;
    const ReferenceQuery& query_;
    Reference& out_;
    std::span<const ObjectTraits> culls_;
    std::optional<std::uint32_t> ground_;  ///< index of the ground disc
    std::mutex lock_;
    std::vector<float>& error_ = out_.standard_error.data;
    std::vector<std::uint16_t> parts_;  ///< samples across the light, by pixel
    glm::vec3 to_light_{0};             ///< direction to a directional light

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(receivers_.width) + std::size_t(x); }
    bool partial(std::size_t i) const { return out_.visibility.data[i] > 0 && out_.visibility.data[i] < 1; }

    void summarise() {
        double squares = 0, samples = 0;
        int least = std::numeric_limits<int>::max(), most = 0;
        for (std::size_t i = 0; i < error_.size(); ++i) {
            if (out_.state[i] != PixelState::Counted) continue;
            const int of_pixel = int(parts_[i]) * int(parts_[i]);
            samples += of_pixel;
            least = std::min(least, of_pixel);
            most = std::max(most, of_pixel);
            out_.partial += partial(i);
            if (std::isnan(error_[i]))
                ++out_.noise_unknown;
            else
                squares += double(error_[i]) * error_[i];
        }
        if (out_.counted() == 0) return;
        out_.samples = {least, most, samples / double(out_.counted())};
        out_.noise = std::sqrt(squares / double(out_.counted() - out_.noise_unknown));  // NaN when none is known
    }

    template <typename Work>
    void for_tiles(const Workers& workers, Work&& work) {
        const std::size_t across = std::size_t((receivers_.width + kTile - 1) / kTile);
        const std::size_t down = std::size_t((receivers_.height + kTile - 1) / kTile);
        const std::size_t shared_out = across * down / (kBlocksPerThread * std::size_t(workers.count()));
        const std::size_t in_turn = std::clamp<std::size_t>(shared_out, 1, kTilesInTurn);
        const std::size_t runs = (across + in_turn - 1) / in_turn;
        parallel_for_blocks(runs * down, workers, [&](std::size_t run) {
            const std::size_t first = run % runs * in_turn, end = std::min(first + in_turn, across);
            const int y0 = int(run / runs) * kTile, y1 = std::min(y0 + kTile, receivers_.height);
            for (std::size_t t = first; t < end; ++t) {
                const int x0 = int(t) * kTile;
                work(x0, y0, std::min(x0 + kTile, receivers_.width), y1);
            }
        });
    }

    /// Equals classify() for a directional light that casts, but reads only RayStart where single precision is enough.
    PixelState classify_quickly(std::size_t i, RayBatch& batch) {
        const RayStart& start = receivers_.starts[i];
        if (start.object == Receiver::kNothing) return out_.state[i] = PixelState::Background;
        const float cosine = glm::dot(start.normal, to_light_);
        if (!(std::abs(cosine) > 2 * kGrazingCosine) || !query_.traits[start.object].receives)
            return classify(i, batch);
        if (cosine < 0) {
            out_.visibility.data[i] = 0;
            return out_.state[i] = turned_away(receivers_.pixels[i], query_.emitter.to_light);
        }
        batch.plain.push_back(
            make_ray(start.origin, to_light_, std::numeric_limits<float>::infinity(), std::uint32_t(i)));
        return out_.state[i] = PixelState::Counted;
    }

    /// Returns the state of a receiver whose triangle faces away from the light.
    /// @param direction to the light, unit
    PixelState turned_away(const Receiver& r, const glm::dvec3& direction) const {
        const glm::dvec3 smooth = geometry_.smooth_normal(r.object, r.primitive, r.position_ws);
        const double cosine = glm::dot(smooth, direction);
        const bool lit = faces_light(glm::dot(smooth, r.normal_ws) < 0 ? -cosine : cosine);
        return lit ? PixelState::ShadowTerminator : PixelState::FacesAway;
    }

    PixelState classify(std::size_t i, RayBatch& batch) {
        const Receiver& r = receivers_.pixels[i];
        PixelState& state = out_.state[i];
        if (!r.hit()) return state = PixelState::Background;
        if (!query_.traits[r.object].receives) return state = PixelState::NotReceiving;
        double distance = 0;
        const glm::dvec3 direction = query_.emitter.direction_from(r.position_ws, distance);
        const double cosine = glm::dot(r.normal_ws, direction);
        if (!faces_light(cosine)) {
            out_.visibility.data[i] = 0;
            return state = turned_away(r, direction);
        }
        if (query_.emitter.casts)
            batch.add(std::uint32_t(i), r, ray_origin(scene_, r), direction, cosine, distance * scene_.scale);
        if (!query_.emitter.in_cone(direction)) return state = PixelState::OutsideCone;
        return state = within_range(distance, query_.emitter.range_m) ? PixelState::Counted : PixelState::BeyondRange;
    }

    /// Distances along a shadow ray, in the unit frame.
    struct RaySpan {
        double origin_shift = 0;  ///< from the receiver to the ray's origin
        double most = 0;          ///< from the receiver to the map's near plane
    };

    /// Collects all hits of a pixel's shadow ray.
    RaySpan collect(std::size_t i, std::vector<Hit>& hits) const {
        const Receiver& r = receivers_.pixels[i];
        const glm::vec3 origin = ray_origin(scene_, r);
        double distance = 0;
        const glm::dvec3 direction = query_.emitter.direction_from(r.position_ws, distance);
        HitRules rules{query_.traits, {}};
        const ExactRay exact{glm::dvec3(origin), direction, distance * scene_.scale, r.object, r.primitive};
        if (glm::dot(r.normal_ws, direction) < kGrazingCosine) rules.exact = {&exact, 1};
        collect_hits(scene_, make_ray(origin, glm::vec3(direction), float(distance * scene_.scale), 0), rules, hits);
        return {glm::dot(glm::dvec3(origin) - scene_.to_unit(r.position_ws), direction),
                metres_to_near_plane(r.position_ws, direction) * scene_.scale};
    }

    /// Finds Reference::nearest_m and blocker_m of a pixel on its shadow ray.
    void find_nearest(std::size_t i, std::vector<Hit>& hits) const {
        const RaySpan span = collect(i, hits);
        double drawn = kNaN, any = kNaN;
        for (const Hit& hit : hits) {
            const double t = hit.t + span.origin_shift;
            if (!(t <= any)) any = t;
            if (!hit.culled && t <= span.most && !(t <= drawn)) drawn = t;
        }
        out_.nearest_m.data[i] = float(drawn / scene_.scale);
        out_.blocker_m.data[i] = float(any / scene_.scale);
    }

    double metres_to_near_plane(const glm::dvec3& point, const glm::dvec3& direction) const {
        if (query_.views.empty()) return std::numeric_limits<double>::infinity();
        const LightView& view = query_.views[query_.chooser.choose(query_.views, point).view];
        // No caster lies in front of a warped view's near plane, which no setting moves.
        if (view.clamps_near || view.warped()) return std::numeric_limits<double>::infinity();
        const double z = glm::dot(view.eye - point, view.axes[2]), rises = glm::dot(direction, view.axes[2]);
        return rises > 0 ? (z - view.curve.near) / rises : std::numeric_limits<double>::infinity();
    }

    void sample(int parts, const std::vector<std::uint8_t>& wanted, const Workers& workers) {
        for_tiles(workers, [&](int x0, int y0, int x1, int y1) {
            thread_local RayBatch batch;
            std::uint64_t rays = 0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const std::size_t i = index(x, y);
                    if (!wanted[i]) continue;
                    const Estimate e = sampled(i, parts, batch);
                    out_.visibility.data[i] = float(e.visibility);
                    error_[i] = float(e.error);
                    parts_[i] = std::uint16_t(parts);
                    rays += batch.size();
                }
            const std::lock_guard guard(lock_);
            out_.rays += rays;
        });
    }

    /// Estimates the visible share of the light's part above the surface's horizon.
    Estimate sampled(std::size_t i, int parts, RayBatch& batch) const {
        const Receiver& r = receivers_.pixels[i];
        const glm::vec3 origin = ray_origin(scene_, r);
        const LightSamples samples(query_.emitter, r.position_ws, parts, i);
        enum : std::uint8_t { kBelow, kDark, kLit };
        thread_local std::vector<std::uint8_t> seen;
        seen.assign(std::size_t(parts) * std::size_t(parts), kBelow);
        batch.clear();
        for (int y = 0; y < parts; ++y)
            for (int x = 0; x < parts; ++x) {
                const LightRay ray = samples.ray(x, y);
                const double length = glm::length(ray.towards);
                const glm::dvec3 direction = ray.towards / length;
                const double cosine = glm::dot(r.normal_ws, direction);
                if (!(cosine > 0)) continue;
                batch.add(std::uint32_t(y * parts + x), r, origin, direction, cosine,
                          length * ray.length * scene_.scale);
            }
        batch.trace(scene_, culls_, [](std::uint32_t k, bool occluded) { seen[k] = occluded ? kDark : kLit; });
        const std::size_t lit = std::size_t(std::count(seen.begin(), seen.end(), kLit));
        const std::size_t above = lit + std::size_t(std::count(seen.begin(), seen.end(), kDark));
        const double exact = query_.emitter.size > 0 ? kNaN : 0;  // exact for a light without size
        if (above == 0) return {out_.hard().data[i], exact};
        Variance variance;
        for (int y = 0; y + 1 < parts; y += 2)
            for (int x = 0; x + 1 < parts; x += 2) {
                const std::uint8_t* top = &seen[std::size_t(y * parts + x)];
                const std::array group{top[0], top[1], top[parts], top[parts + 1]};
                const auto of = [&](std::uint8_t what) { return int(std::count(group.begin(), group.end(), what)); };
                variance.add(of(kLit), of(kLit) + of(kDark));
            }
        const double error = std::isnan(exact) ? variance.standard_error(above) : exact;
        return {double(lit) / double(above), error};
    }

    /// Returns the pixels in penumbra and their neighbours.
    std::vector<std::uint8_t> near_partial() const {
        std::vector<std::uint8_t> out(out_.state.size(), 0);
        for (int y = 0; y < receivers_.height; ++y)
            for (int x = 0; x < receivers_.width; ++x) {
                if (!partial(index(x, y))) continue;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, receivers_.height - 1); ++v)
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, receivers_.width - 1); ++u)
                        out[index(u, v)] = is_traced(out_.state[index(u, v)]);
            }
        return out;
    }
};

FloatImage image(int width, int height, float value) {
    return {width, height, 1, std::vector<float>(std::size_t(width) * std::size_t(height), value)};
}

}  // namespace

ReferenceOptions reference_options(const Settings& settings) {
    const ReferenceSettings& t = settings.truth;
    return {.area = t.area, .samples = t.samples, .noise = t.noise, .step = t.step};
}

ReferenceQuery reference_query(const Scene& scene, const Settings& settings, const std::vector<FittedLight>& lights,
                               int light, const ReferenceOptions& options) {
    if (light < 0 || std::size_t(light) >= lights.size())
        throw Error(fmt::format("view.light is {}, but light.count is {}", light, lights.size()));
    const FittedLight& fitted = lights[std::size_t(light)];
    return {emitter_of(fitted, settings.lights[std::size_t(light)]), object_traits(scene, settings), fitted.views,
            fitted.chooser, options};
}

std::string noise_text(const Reference& reference) {
    if (!reference.is_area()) return {};
    const SamplesUsed& used = reference.samples;
    const std::string samples =
        used.least == used.most
            ? fmt::format("{} sample{} a pixel", used.most, used.most == 1 ? "" : "s")
            : fmt::format("{} to {} samples a pixel ({:.0f} on average)", used.least, used.most, used.mean);
    if (std::isnan(reference.noise)) return fmt::format("noise unknown, {}: it needs truth.samples=4 or more", samples);
    std::string text = fmt::format("noise {:.4f}, {}", reference.noise, samples);
    if (reference.noise_unknown > 0) text += fmt::format(", noise of {} pixels unknown", reference.noise_unknown);
    return text;
}

std::optional<MissingCaster> missing_caster(const ReferenceScene& scene, const Receiver& receiver,
                                            const ReferenceQuery& query) {
    const Receivers one{1, 1, {receiver}};
    Reference unused;
    return Tracer(scene, one, query, unused).missing_caster(0);
}

Reference trace_visibility(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query,
                           const Workers& workers) {
    if (query.traits.size() != scene.geometry().objects.size())
        throw Error("the traced scene and its settings do not belong together");
    Reference out;
    out.width = receivers.width;
    out.height = receivers.height;
    out.step = std::max(query.options.step, 1);
    out.traits = query.traits;
    out.state.resize(receivers.pixels.size());
    out.visibility = image(out.width, out.height, 1);
    if (query.options.nearest) out.nearest_m = out.blocker_m = image(out.width, out.height, kNaN);
    const bool area = query.options.area && query.emitter.casts;
    if (area) out.standard_error = image(out.width, out.height, 0);
    Tracer tracer(scene, receivers, query, out);
    tracer.trace_hard(workers.with_progress_range(0, area ? 0.05 : 1));
    if (area) {
        out.point_visibility = out.visibility;
        tracer.trace_area(workers.with_progress_range(0.05, 1));
    }
    std::uint64_t bytes = array_bytes(out.state);
    for (const FloatImage* i :
         {&out.visibility, &out.point_visibility, &out.standard_error, &out.nearest_m, &out.blocker_m})
        bytes += array_bytes(i->data);
    out.held = TrackedMemory("truths", bytes);
    return out;
}

}  // namespace si
