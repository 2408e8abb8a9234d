#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "renderer/bias/light_receiver.h"
#include "renderer/reference/reference_rays.h"
#include "renderer/reference/seen_light.h"

namespace si {
namespace {

constexpr int kTile = 16;  ///< pixels a side: rays of neighbours visit the same nodes
/// Limit of adjacent tiles per block of work. Adjacent tiles share cache lines, so that one thread takes several.
constexpr std::size_t kTilesInTurn = 8;
constexpr std::size_t kBlocksPerThread = 4;  ///< least blocks per thread
constexpr int kSquare = 4;                   ///< pixels a side of one ray packet
constexpr int kPenumbraSamples = 64;         ///< samples of pixels in and around penumbrae
constexpr int kPlainSamples = 256;           ///< samples spread over the whole light; more only along edges of shadows
constexpr int kBesideSamples =
    128;  ///< samples that must agree before a pixel next to a penumbra counts as lit or dark
constexpr int kNeighbourPixels = 2;  ///< distance within which a penumbra asks for these samples
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

class Tracer {
public:
    Tracer(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query, Reference& out,
           const TileDone& tile_done)
        : scene_(scene.impl()),
          geometry_(scene.geometry()),
          receivers_(receivers),
          query_(query),
          out_(out),
          tile_done_(tile_done) {
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

    /// Traces an area light adaptively: few samples everywhere, more around penumbrae, and again where the error is
    /// too large.
    void trace_area(const Workers& workers) {
        first_ = std::clamp(query_.options.first_samples, 1, std::min(most(), kMaxFirst));
        error_.assign(out_.state.size(), 0);
        used_.assign(out_.state.size(), 0);
        first_seen_.assign(out_.state.size(), {});
        has_more_.assign(out_.state.size(), 0);
        std::vector<std::uint8_t> wanted(out_.state.size());
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = is_traced(out_.state[i]);
        double done = first_share();
        sample(wanted, workers.with_progress_range(0, done),
               [&](std::size_t i, RayBatch& batch) { return first_samples(i, batch); });
        // Samples of a neighbour may find a penumbra that the own ones missed.
        while (first_ < most()) {
            wanted = around_penumbrae();
            if (std::ranges::all_of(wanted, [](std::uint8_t w) { return w == 0; })) break;
            const double next = done + 0.9 * (1 - done);
            sample(wanted, workers.with_progress_range(done, next), [&](std::size_t i, RayBatch& batch) {
                has_more_[i] = 1;
                return more_samples(i, wanted[i] == kBeside ? kBesideSamples : kPenumbraSamples, batch);
            });
            done = next;
        }
        summarise();
    }

private:
    const RayHierarchy& scene_;
    const ReferenceGeometry& geometry_;
    const Receivers& receivers_;
    const ReferenceQuery& query_;
    Reference& out_;
    const TileDone& tile_done_;  ///< empty: nobody watches
    std::span<const ObjectTraits> culls_;
    std::optional<std::uint32_t> ground_;  ///< index of the ground disc
    std::mutex lock_;
    std::vector<float>& error_ = out_.standard_error.data;
    static constexpr int kMaxFirst = 64;
    int first_ = 1;                    ///< samples of every pixel
    std::vector<std::uint32_t> used_;  ///< samples taken, by pixel
    /// First samples of a pixel, a bit each.
    struct FirstSeen {
        std::uint64_t lit = 0, above = 0;
    };
    std::vector<FirstSeen> first_seen_;
    std::vector<std::uint8_t> has_more_;  ///< by pixel: 1: more than the first samples were asked for
    glm::vec3 to_light_{0};               ///< direction to a directional light

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(receivers_.width) + std::size_t(x); }
    /// Returns the expected share of the first samples in all samples of an area light, for the progress.
    double first_share() const {
        constexpr double kInPenumbra = 0.2;  // of the pixels
        // Mitchell 1996: the error at an edge falls with the number of samples to the power of -3/4.
        constexpr double kErrorOf64Samples = 0.017, kSmallestNoise = 1e-9;
        const double fewest = std::min(kPenumbraSamples, most());
        double needed = 64 * std::pow(kErrorOf64Samples / std::max(query_.options.noise, kSmallestNoise), 4.0 / 3);
        needed = std::clamp(needed, fewest, double(most()));
        // Above kPlainSamples they grow with an edge's length on the light: as the square root.
        if (needed > kPlainSamples) needed = std::sqrt(needed * kPlainSamples);
        return first_ / (first_ + kInPenumbra * needed);
    }
    bool partial(std::size_t i) const { return out_.visibility.data[i] > 0 && out_.visibility.data[i] < 1; }

    void summarise() {
        double squares = 0, samples = 0;
        int least = std::numeric_limits<int>::max(), most = 0;
        for (std::size_t i = 0; i < error_.size(); ++i) {
            if (out_.state[i] != PixelState::Counted) continue;
            const int of_pixel = int(used_[i]);
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
                const int x1 = std::min(x0 + kTile, receivers_.width);
                work(x0, y0, x1, y1);
                if (tile_done_) tile_done_(out_, {x0, y0}, {x1, y1});
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

    int most() const { return std::max(query_.options.samples, 1); }

    /// Estimates the visibility of wanted pixels, each by `estimate`.
    template <typename Estimated>
    void sample(const std::vector<std::uint8_t>& wanted, const Workers& workers, Estimated&& estimate) {
        for_tiles(workers, [&](int x0, int y0, int x1, int y1) {
            thread_local RayBatch batch;
            std::uint64_t rays = 0;
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    const std::size_t i = index(x, y);
                    if (!wanted[i]) continue;
                    const Estimate e = estimate(i, batch);
                    out_.visibility.data[i] = float(e.visibility);
                    error_[i] = float(e.error);
                    used_[i] = std::uint32_t(e.samples);
                    rays += std::uint64_t(e.rays);
                }
            const std::lock_guard guard(lock_);
            out_.rays += rays;
        });
    }

    /// Traces sample points of a pixel. @param points their numbers @param seen receives their states
    /// @returns the number of rays
    std::size_t trace_samples(std::size_t i, const LightSamples& samples, std::span<const std::uint32_t> points,
                              std::span<Seen> seen, RayBatch& batch) const {
        const Receiver& r = receivers_.pixels[i];
        const glm::vec3 origin = ray_origin(scene_, r);
        std::ranges::fill(seen, Seen::Below);
        batch.clear();
        for (std::size_t k = 0; k < points.size(); ++k) {
            const LightRay ray = samples.ray(points[k]);
            const double cosine = glm::dot(r.normal_ws, ray.direction);
            if (cosine > 0) batch.add(std::uint32_t(k), r, origin, ray.direction, cosine, ray.length_m * scene_.scale);
        }
        batch.trace(scene_, culls_,
                    [&](std::uint32_t k, bool occluded) { seen[k] = occluded ? Seen::Dark : Seen::Lit; });
        return batch.size();
    }

    /// Returns the estimate from the samples so far; a light without size has no error.
    Estimate estimate(std::size_t i, const SeenLight& light) const {
        Estimate out = light.estimate(out_.hard().data[i]);
        if (!(query_.emitter.size > 0)) out.error = 0;
        return out;
    }

    /// Numbers 0, 1, 2 ... of a pixel's first sample points.
    static constexpr auto kFirstPoints = [] {
        std::array<std::uint32_t, kPenumbraSamples> out{};
        for (std::uint32_t k = 0; k < out.size(); ++k) out[k] = k;
        return out;
    }();

    Estimate first_samples(std::size_t i, RayBatch& batch) {
        std::array<Seen, kMaxFirst> seen{};
        const LightSamples samples(query_.emitter, receivers_.pixels[i].position_ws, i);
        const auto first = std::size_t(first_);
        const std::size_t rays =
            trace_samples(i, samples, std::span(kFirstPoints).first(first), std::span(seen).first(first), batch);
        for (std::size_t k = 0; k < first; ++k) {
            const std::uint64_t bit = std::uint64_t{1} << k;
            if (seen[k] != Seen::Below) first_seen_[i].above |= bit;
            if (seen[k] == Seen::Lit) first_seen_[i].lit |= bit;
        }
        thread_local SeenLight light;
        light.start(samples, std::span(seen).first(first));
        Estimate out = estimate(i, light);
        out.rays = rays;
        return out;
    }

    /// Adds samples to the first ones until the error is small enough, or the light is seen to be whole or hidden.
    /// @param least SeenLight::fineness() from which samples that all agree are trusted
    Estimate more_samples(std::size_t i, int least, RayBatch& batch) const {
        std::array<Seen, kPenumbraSamples> seen{};
        const auto first = std::size_t(first_), start = std::size_t(std::min(kPenumbraSamples, most()));
        for (std::size_t k = 0; k < first; ++k)
            seen[k] = !(first_seen_[i].above >> k & 1u) ? Seen::Below
                      : first_seen_[i].lit >> k & 1u    ? Seen::Lit
                                                        : Seen::Dark;
        const LightSamples samples(query_.emitter, receivers_.pixels[i].position_ws, i);
        std::size_t rays = trace_samples(i, samples, std::span(kFirstPoints).subspan(first, start - first),
                                         std::span(seen).subspan(first, start - first), batch);
        thread_local SeenLight light;
        light.start(samples, std::span(seen).first(start));
        for (;;) {
            Estimate out = estimate(i, light);
            out.rays = rays;
            const auto fineness = int(light.fineness());
            const bool whole = out.visibility == 0 || out.visibility == 1;
            const bool enough = whole ? fineness >= least : out.error <= query_.options.noise;
            if (fineness >= most() || enough) return out;
            light.refine(samples, std::uint32_t(std::min(most(), 2 * fineness)), whole || fineness < kPlainSamples,
                         [&](std::span<const std::uint32_t> points, std::span<Seen> found) {
                             rays += trace_samples(i, samples, points, found, batch);
                         });
        }
    }

    /// Pixels that need more than their first samples.
    static constexpr std::uint8_t kNear = 1;    ///< near a penumbra or an edge
    static constexpr std::uint8_t kBeside = 2;  ///< in a penumbra, or with a neighbour in one

    /// Returns the pixels that have only their first samples although they are in penumbra, or a pixel near them is,
    /// or lies on the other side of an edge; and those that see all of the light or none by few samples beside a
    /// penumbra.
    std::vector<std::uint8_t> around_penumbrae() const {
        std::vector<std::uint8_t> out(out_.state.size(), 0);
        for (int y = 0; y < receivers_.height; ++y)
            for (int x = 0; x < receivers_.width; ++x) {
                const std::size_t own = index(x, y);
                if (!is_traced(out_.state[own])) continue;
                const bool differs = out_.visibility.data[own] != out_.hard().data[own];
                if (!partial(own) && !differs && !beside_edge(x, y)) continue;
                for (int v = std::max(y - kNeighbourPixels, 0);
                     v <= std::min(y + kNeighbourPixels, receivers_.height - 1); ++v)
                    for (int u = std::max(x - kNeighbourPixels, 0);
                         u <= std::min(x + kNeighbourPixels, receivers_.width - 1); ++u) {
                        const std::size_t i = index(u, v);
                        if (!is_traced(out_.state[i])) continue;
                        const bool beside = partial(own) && std::max(std::abs(u - x), std::abs(v - y)) <= 1;
                        const bool missed =
                            beside && !partial(i) && used_[i] < std::uint32_t(std::min(kBesideSamples, most()));
                        if (has_more_[i] && !missed) continue;
                        out[i] = std::max(out[i], beside ? kBeside : kNear);
                    }
            }
        return out;
    }

    /// Returns true when the pixel right of or below a pixel sees another share of the light.
    bool beside_edge(int x, int y) const {
        const std::size_t own = index(x, y);
        const auto differs = [&](std::size_t other) {
            return is_traced(out_.state[other]) && out_.visibility.data[other] != out_.visibility.data[own];
        };
        return (x + 1 < receivers_.width && differs(index(x + 1, y))) ||
               (y + 1 < receivers_.height && differs(index(x, y + 1)));
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
    const TileDone nobody;
    return Tracer(scene, one, query, unused, nobody).missing_caster(0);
}

Reference trace_visibility(const ReferenceScene& scene, const Receivers& receivers, const ReferenceQuery& query,
                           const Workers& workers, const TileDone& tile_done) {
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
    Tracer tracer(scene, receivers, query, out, tile_done);
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
