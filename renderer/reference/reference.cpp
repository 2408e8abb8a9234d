#include "renderer/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "renderer/base/directions.h"
#include "renderer/bias/light_receiver.h"
#include "renderer/reference/projected_casters.h"
#include "renderer/reference/reference_rays.h"
#include "renderer/reference/seen_light.h"

namespace si {
namespace {

constexpr int kTile = 16;  ///< pixels a side: rays of neighbours visit the same nodes
/// Limit of adjacent tiles per block of work. Adjacent tiles share cache lines, so that one thread takes several.
constexpr std::size_t kTilesInTurn = 8;
constexpr std::size_t kBlocksPerThread = 4;  ///< least blocks per thread
constexpr int kSquare = 4;                   ///< pixels a side of one ray packet
constexpr int kPenumbraSamples = 64;         ///< samples of pixels in penumbrae, and of those at edges of shadows
constexpr int kFarSamples = 16;              ///< samples of pixels two pixels from a penumbra or an edge
constexpr int kPlainSamples = 256;           ///< samples spread over the whole light; more only along edges of shadows
constexpr int kBesideSamples =
    128;  ///< samples that must agree before a pixel next to a penumbra counts as lit or dark
constexpr int kNeighbourPixels = 2;  ///< distance within which a penumbra asks for these samples
/// Limit of casters' triangles between a square of pixels and the light, above which rays are faster.
constexpr std::size_t kMostProjected = 512;
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
        tree_ = scene_.caster_tree(workers.stop);
        if (tree_ && query_.emitter.type == LightType::Directional) sun_.emplace(query_.emitter);
        first_ = std::clamp(query_.options.first_samples, 1, std::min(most(), kPenumbraSamples));
        if (first_ < most()) first_ = std::min(first_, kKeptFirst);
        work_.resize(out_.state.size());
        penumbra_.resize(out_.state.size());
        constexpr double kProjectedShare = 0.7;  // projected casters leave few pixels to the rays of later rounds
        double done = tree_ ? kProjectedShare : first_share();
        sample(Round::First, workers.with_progress_range(0, done));
        // Samples of a neighbour may find a penumbra that the own ones missed.
        while (first_ < most() && find_penumbrae(workers)) {
            const double next = done + 0.9 * (1 - done);
            sample(Round::Penumbrae, workers.with_progress_range(done, next));
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
    static constexpr int kKeptFirst = 16;
    int first_ = 1;  ///< samples of every pixel
    enum class Round { First, Penumbrae };
    /// Part of the light that a pixel sees, compared with its neighbours.
    enum class Penumbra : std::uint8_t {
        None,
        Edge,    ///< a neighbour sees another share of the light
        Partial  ///< a part of the light is seen
    };
    /// Reason why a pixel needs more samples; later ones need more.
    enum class Wanted : std::uint8_t {
        None,
        Far,     ///< two pixels from a penumbra or an edge
        Near,    ///< next to an edge
        Beside,  ///< in a penumbra, or with a neighbour in one
        Crossed  ///< the edge of a projected caster crosses the light
    };

    /// State of a pixel that sees an area light.
    struct PixelWork {
        std::uint16_t lit = 0, above = 0;  ///< first samples, a bit each: lit, and above the horizon
        std::uint32_t used = 0;            ///< samples taken
        Wanted wanted = Wanted::None;
        bool projected = false;  ///< projected casters gave all samples that the pixel needs
    };
    BigArray<PixelWork> work_;          ///< by pixel
    BigArray<Penumbra> penumbra_;       ///< by pixel
    glm::vec3 to_light_{0};             ///< direction to a directional light
    const CasterTree* tree_ = nullptr;  ///< null: rays decide everywhere
    std::optional<SunPlaces> sun_;      ///< of a directional light

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
            const int of_pixel = int(work_[i].used);
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
                if (workers.stop.stop_requested()) throw Cancelled();
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

    /// Buffers of one thread that samples pixels.
    struct SampleBuffers {
        RayBatch batch;
        SeenLight light;
        std::vector<Seen> seen;
        std::vector<std::size_t> pixels;  ///< of a square, those to sample
        std::optional<LightShaft> shaft;  ///< between these pixels and the light; nullopt: rays decide
        ShaftTriangles casters;           ///< casters in the shaft
        ProjectedCasters projected;       ///< casters of the present pixel
        bool projects = false;            ///< `projected` decides for the present pixel, else rays do
    };

    /// Samples the light from all traced pixels, or from those that find_penumbrae() marked.
    /// @throws Cancelled
    void sample(Round round, const Workers& workers) {
        for_tiles(workers, [&](int x0, int y0, int x1, int y1) {
            thread_local SampleBuffers buffers;
            std::uint64_t rays = 0;
            for (int square_y = y0; square_y < y1; square_y += kSquare)
                for (int square_x = x0; square_x < x1; square_x += kSquare) {
                    buffers.pixels.clear();
                    for (int k = 0; k < kSquare * kSquare; ++k) {
                        // Squares of four pixels, one after another.
                        const int x = square_x + (k & 1) + (k >> 1 & 2), y = square_y + (k >> 1 & 1) + (k >> 2 & 2);
                        if (x >= x1 || y >= y1) continue;
                        const std::size_t i = index(x, y);
                        if (round == Round::First) work_[i] = {};
                        if (round == Round::First ? is_traced(out_.state[i]) : work_[i].wanted != Wanted::None)
                            buffers.pixels.push_back(i);
                    }
                    for_casters(buffers.pixels, buffers, [&](std::size_t i) {
                        rays += round == Round::First ? take_first_samples(i, buffers, workers.stop)
                                                      : take_more_samples(i, buffers, workers.stop);
                    });
                }
            const std::lock_guard guard(lock_);
            out_.rays += rays;
        });
    }

    /// Returns the region between some pixels and the light. Returns nullopt if it has no simple form, since the light
    /// is too near or too wide.
    std::optional<LightShaft> shaft_from(std::span<const std::size_t> pixels) const {
        const Emitter& light = query_.emitter;
        const auto light_disk = light_samples(pixels.front()).disk();
        if (!light_disk) return std::nullopt;
        double distance = 0;
        const glm::dmat3 axes =
            orthonormal_basis(light.direction_from(receivers_.pixels[pixels.front()].position_ws, distance));
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
        for (const std::size_t i : pixels) {
            const glm::dvec3 origin = glm::transpose(axes) * glm::dvec3(ray_origin(scene_, receivers_.pixels[i]));
            low = glm::min(low, origin);
            high = glm::max(high, origin);
        }
        constexpr double kPad = 1e-6;  // rounding of coordinates, as a share of their size
        const double pad = kPad * scene_.radius;
        LightShaft out{.axes = glm::mat3(axes),
                       .low = glm::vec2(low) - float(pad),
                       .high = glm::vec2(high) + float(pad),
                       .bottom = float(low.z - pad),
                       .top = std::numeric_limits<float>::infinity(),
                       .slope = glm::vec2(float(light_disk->radius * (1 + kPad)))};
        if (light.type == LightType::Directional) return out;
        const glm::dvec3 centre = glm::transpose(axes) * scene_.to_unit(light.position_ws);
        const double size = light.size * scene_.scale, height = centre.z - size - low.z;
        if (!(high.z < centre.z - size)) return std::nullopt;
        out.top = float(centre.z + size + pad);
        for (int a = 0; a < 2; ++a)
            out.slope[a] = float((std::max(centre[a] + size - low[a], high[a] - centre[a] + size) + pad) / height);
        return out;
    }

    /// Calls a function for each of some pixels while SampleBuffers::casters holds the casters between these pixels and
    /// the light. Where too many casters lie there, takes four pixels at a time, and then one.
    /// @param pixels neighbours, in squares of four
    template <typename Work>
    void for_casters(std::span<const std::size_t> pixels, SampleBuffers& b, Work&& work) const {
        constexpr std::size_t kFew = 4;
        if (!tree_ || pixels.empty()) {
            b.shaft.reset();
        } else {
            b.shaft = shaft_from(pixels);
            if (b.shaft && !tree_->collect(*b.shaft, kMostProjected, b.casters)) {
                b.shaft.reset();
                const std::size_t part = pixels.size() > kFew ? kFew : 1;
                for (std::size_t k = 0; pixels.size() > 1 && k < pixels.size(); k += part)
                    for_casters(pixels.subspan(k, std::min(part, pixels.size() - k)), b, work);
                if (pixels.size() > 1) return;
            }
        }
        for (const std::size_t i : pixels) work(i);
    }

    /// Projects the casters of a pixel onto the light. Returns false if rays decide: without a shaft, where samples lie
    /// below the horizon or at grazing angles, or where a caster reaches into the light.
    bool project_casters(std::size_t i, const LightSamples& samples, SampleBuffers& b) const {
        if (!b.shaft) return false;
        const auto light_disk = samples.disk();
        if (!light_disk) return false;
        const Receiver& r = receivers_.pixels[i];
        const glm::dvec3 normal = glm::transpose(light_disk->axes) * r.normal_ws;
        const glm::dvec2 beside(normal);
        const double rise = glm::dot(beside, light_disk->centre) + normal.z - light_disk->radius * glm::length(beside);
        const double longest = std::hypot(1.0, glm::length(light_disk->centre) + light_disk->radius);
        if (!(rise > kGrazingCosine * longest)) return false;
        return b.projected.project(scene_, *tree_, *b.shaft, b.casters, ray_origin(scene_, r), *light_disk, culls_,
                                   sun_ ? &*sun_ : nullptr);
    }

    /// Finds the states of sample points of a pixel. Returns the number of shadow rays, whether traced or answered by
    /// projected casters.
    /// @param points numbers of the sample points @param seen receives their states @throws Cancelled
    std::size_t trace_samples(std::size_t i, const LightSamples& samples, std::span<const std::uint32_t> points,
                              std::span<Seen> seen, SampleBuffers& b, const std::stop_token& stop) const {
        if (stop.stop_requested()) throw Cancelled();  // 2^20 samples in each pixel of a tile take minutes
        if (b.projects) {
            b.projected.find_seen(samples, points, seen);
            return points.size();
        }
        RayBatch& batch = b.batch;
        const Receiver& r = receivers_.pixels[i];
        const glm::vec3 origin = ray_origin(scene_, r);
        std::ranges::fill(seen, Seen::Below);
        batch.clear();
        for (std::uint32_t k = 0; k < seen.size(); ++k) {
            const LightRay ray = samples.ray(points[k]);
            const double cosine = glm::dot(r.normal_ws, ray.direction);
            if (cosine > 0) batch.add(k, r, origin, ray.direction, cosine, ray.length_m * scene_.scale);
        }
        batch.trace(scene_, culls_,
                    [&](std::uint32_t k, bool occluded) { seen[k] = occluded ? Seen::Dark : Seen::Lit; });
        return batch.size();
    }

    /// Sets a pixel's estimate from the samples so far; a light without size has no error.
    Estimate set_estimate(std::size_t i, const SeenLight& light) {
        Estimate out = light.estimate(out_.hard().data[i]);
        if (!(query_.emitter.size > 0)) out.error = 0;
        out_.visibility.data[i] = float(out.visibility);
        error_[i] = float(out.error);
        work_[i].used = std::uint32_t(out.samples);
        return out;
    }

    LightSamples light_samples(std::size_t i) const {
        return LightSamples(query_.emitter, receivers_.pixels[i].position_ws, i);
    }

    /// Numbers 0, 1, 2 ... of a pixel's first sample points.
    static constexpr auto kFirstPoints = [] {
        std::array<std::uint32_t, 1024> out{};
        for (std::uint32_t k = 0; k < out.size(); ++k) out[k] = k;
        return out;
    }();

    /// Takes the first samples of a pixel, and keeps their states. Returns the number of rays.
    std::size_t take_first_samples(std::size_t i, SampleBuffers& b, const std::stop_token& stop) {
        const LightSamples samples = light_samples(i);
        b.projects = project_casters(i, samples, b);
        work_[i].projected = b.projects;
        if (b.projects && !b.projected.hides_all_or_none()) return take_projected_samples(i, samples, b, stop);
        b.seen.resize(std::size_t(first_));
        const std::size_t rays =
            trace_samples(i, samples, std::span(kFirstPoints).first(b.seen.size()), b.seen, b, stop);
        b.light.start(samples, b.seen);
        set_estimate(i, b.light);
        if (b.seen.size() > kKeptFirst) return rays;
        PixelWork& work = work_[i];
        for (std::size_t k = 0; k < b.seen.size(); ++k) {
            if (b.seen[k] != Seen::Below) work.above = std::uint16_t(work.above | 1u << k);
            if (b.seen[k] == Seen::Lit) work.lit = std::uint16_t(work.lit | 1u << k);
        }
        return rays;
    }

    /// Sets the states of the samples that a pixel has: those kept, or the one that all share.
    void restore_states(std::size_t i, const LightSamples& samples, std::vector<Seen>& seen) const {
        const PixelWork& work = work_[i];
        const bool kept = partial(i);
        const auto is_above = [&](std::uint32_t point) {
            return glm::dot(receivers_.pixels[i].normal_ws, samples.ray(point).direction) > 0;
        };
        seen.clear();
        const auto known = std::uint32_t(kept ? first_ : int(work.used));
        for (std::uint32_t k = 0; k < known; ++k) {
            const bool above = kept ? work.above >> k & 1 : is_above(k);
            const bool lit = kept ? work.lit >> k & 1 : out_.visibility.data[i] > 0;
            seen.push_back(!above ? Seen::Below : lit ? Seen::Lit : Seen::Dark);
        }
    }

    /// Adds samples to the first ones of a pixel that find_penumbrae() marked. Returns the number of rays.
    std::size_t take_more_samples(std::size_t i, SampleBuffers& b, const std::stop_token& stop) {
        const LightSamples samples = light_samples(i);
        b.projects = project_casters(i, samples, b);
        restore_states(i, samples, b.seen);
        return take_samples(i, samples, work_[i].wanted, b, stop);
    }

    /// Adds samples to those of a pixel until the error is small enough, or the light is seen to be whole or hidden.
    /// Returns the number of rays.
    /// @param wanted reason why the pixel needs samples @param b SampleBuffers::seen has the first samples' states
    std::size_t take_samples(std::size_t i, const LightSamples& samples, Wanted wanted, SampleBuffers& b,
                             const std::stop_token& stop) {
        std::size_t rays = 0;
        const std::size_t known = b.seen.size();
        const auto end = std::size_t(std::min(wanted == Wanted::Far ? kFarSamples : kPenumbraSamples, most()));
        if (known < end) {
            b.seen.resize(end);
            rays += trace_samples(i, samples, std::span(kFirstPoints).subspan(known, end - known),
                                  std::span(b.seen).subspan(known), b, stop);
        }
        b.light.start(samples, b.seen);
        while (!is_enough(set_estimate(i, b.light), b.light.fineness(), wanted)) rays += refine(i, samples, b, stop);
        return rays;
    }

    /// Takes the samples of a pixel whose casters are projected: all of one fineness at once, as long as that costs
    /// less than to choose among them. Returns their number.
    std::size_t take_projected_samples(std::size_t i, const LightSamples& samples, SampleBuffers& b,
                                       const std::stop_token& stop) {
        const std::size_t most_at_once = b.projected.has_masks() ? kPlainSamples : kFirstPoints.size();
        constexpr double kErrorOfTwice = 0.6;  // times the error: 2^(-3/4)
        auto count = std::size_t(std::min(kPenumbraSamples, most()));
        for (;;) {
            b.seen.resize(count);
            trace_samples(i, samples, std::span(kFirstPoints).first(count), b.seen, b, stop);
            b.light.start(samples, b.seen);
            const Estimate e = set_estimate(i, b.light);
            if (is_enough(e, count, Wanted::Crossed)) return count;
            if (count == most_at_once) break;
            const bool twice = kErrorOfTwice * e.error <= query_.options.noise;
            count = std::min({(twice ? 2 : 4) * count, most_at_once, std::size_t(most())});
        }
        std::size_t rays = count;
        do rays += refine(i, samples, b, stop);
        while (!is_enough(set_estimate(i, b.light), b.light.fineness(), Wanted::Crossed));
        return rays;
    }

    /// Returns true when a pixel needs no more samples: its error is small enough, or enough samples agree.
    bool is_enough(const Estimate& e, std::size_t fineness, Wanted wanted) const {
        const bool whole = e.visibility == 0 || e.visibility == 1;
        return int(fineness) >= most() ||
               (whole ? int(fineness) >= samples_for(wanted) : e.error <= query_.options.noise);
    }

    /// Doubles the fineness of a pixel's samples. Returns the number of rays.
    std::size_t refine(std::size_t i, const LightSamples& samples, SampleBuffers& b, const std::stop_token& stop) {
        const auto fineness = int(b.light.fineness());
        const float visibility = out_.visibility.data[i];
        const bool everywhere = visibility == 0 || visibility == 1 || fineness < kPlainSamples;
        const auto points = b.light.halve(samples, std::uint32_t(std::min(most(), 2 * fineness)), everywhere);
        b.seen.resize(points.size());
        const std::size_t rays = trace_samples(i, samples, points, b.seen, b, stop);
        b.light.set_wanted(b.seen);
        return rays;
    }

    /// Returns the number of samples that must agree before a pixel counts as lit or dark.
    int samples_for(Wanted wanted) const {
        const int all = wanted == Wanted::Crossed  ? kPlainSamples
                        : wanted == Wanted::Beside ? kBesideSamples
                        : wanted == Wanted::Near   ? kPenumbraSamples
                                                   : kFarSamples;
        return std::min(all, most());
    }

    /// Marks the pixels that need more samples: those in penumbra that have only their first ones, and those near a
    /// penumbra or an edge whose samples agree, but are fewer than samples_for(). Returns true if there are any.
    bool find_penumbrae(const Workers& workers) {
        const Workers silent{.threads = workers.threads, .stop = workers.stop};
        const std::size_t bands = std::size_t((receivers_.height + kTile - 1) / kTile);
        const auto for_rows = [&](auto&& work) {
            parallel_for_blocks(bands, silent, [&](std::size_t band) {
                const int y0 = int(band) * kTile, y1 = std::min(y0 + kTile, receivers_.height);
                for (int y = y0; y < y1; ++y) work(y);
            });
        };
        for_rows([&](int y) {
            for (int x = 0; x < receivers_.width; ++x) {
                const std::size_t i = index(x, y);
                const bool differs = out_.visibility.data[i] != out_.hard().data[i];
                penumbra_[i] = !is_traced(out_.state[i])      ? Penumbra::None
                               : partial(i)                   ? Penumbra::Partial
                               : differs || beside_edge(x, y) ? Penumbra::Edge
                                                              : Penumbra::None;
            }
        });
        std::atomic<bool> any = false;
        for_rows([&](int y) {
            const int y0 = std::max(y - kNeighbourPixels, 0),
                      y1 = std::min(y + kNeighbourPixels, receivers_.height - 1);
            thread_local std::vector<std::uint8_t> columns;  // penumbrae above and below each pixel of the row
            columns.assign(std::size_t(receivers_.width), 0);
            for (int v = y0; v <= y1; ++v)
                for (std::size_t x = 0; x < columns.size(); ++x)
                    columns[x] |= penumbra_[index(0, v) + x] != Penumbra::None;
            for (int x = 0; x < receivers_.width; ++x) {
                const std::size_t i = index(x, y);
                const int x0 = std::max(x - kNeighbourPixels, 0),
                          x1 = std::min(x + kNeighbourPixels, receivers_.width - 1);
                const bool near = std::any_of(&columns[std::size_t(x0)], &columns[std::size_t(x1)] + 1,
                                              [](std::uint8_t column) { return column != 0; });
                work_[i].wanted =
                    near && is_traced(out_.state[i]) ? wanted(i, {x, y}, {x0, y0}, {x1, y1}) : Wanted::None;
                if (work_[i].wanted != Wanted::None) any = true;
            }
        });
        return any;
    }

    /// Returns why a traced pixel near a penumbra or an edge needs more samples.
    /// @param i index of the pixel @param first upper left pixel of its neighbourhood @param last lower right one
    Wanted wanted(std::size_t i, glm::ivec2 pixel, glm::ivec2 first, glm::ivec2 last) const {
        Wanted out = Wanted::None;
        for (int v = first.y; v <= last.y; ++v)
            for (int u = first.x; u <= last.x; ++u) {
                const Penumbra penumbra = penumbra_[index(u, v)];
                if (penumbra == Penumbra::None) continue;
                const bool next = std::max(std::abs(u - pixel.x), std::abs(v - pixel.y)) <= 1;
                out = std::max(out, !next                           ? Wanted::Far
                                    : penumbra == Penumbra::Partial ? Wanted::Beside
                                                                    : Wanted::Near);
            }
        const int used = int(work_[i].used);
        const bool enough =
            work_[i].projected || (penumbra_[i] == Penumbra::Partial ? used > first_ : used >= samples_for(out));
        return enough ? Wanted::None : out;
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
