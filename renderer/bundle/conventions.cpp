#include "renderer/bundle/conventions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/error.h"
#include "renderer/base/median.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/scene/axes.h"

namespace si {
namespace {

constexpr double kNoSurface = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamplesAcross = 64;  ///< of one map
constexpr int kScreenAcross = 12;   ///< of one map, for readings in other axes or units

/// Readings in other axes or units that are compared at all texels: the best of the screen, with at most this share
/// off, and at most so much more than the best.
constexpr std::size_t kScreened = 48;
constexpr double kScreenShare = 0.7;
constexpr double kScreenMargin = 0.15;
/// Share of texels by which a reading in other axes has to fit better than one in the scene's.
constexpr double kOtherAxesShare = 1e-3;

constexpr UpAxis kTriedUp[] = {UpAxis::Y, UpAxis::Z, UpAxis::MinusZ, UpAxis::X, UpAxis::MinusX, UpAxis::MinusY};
constexpr MirroredAxis kTriedMirrored[] = {MirroredAxis::None, MirroredAxis::X, MirroredAxis::Y, MirroredAxis::Z};
/// Metre, centimetre, millimetre, kilometre, inch and foot, and the other way.
constexpr double kTriedUnits[] = {1, 0.01, 100, 0.001, 1000, 0.0254, 1 / 0.0254, 0.3048, 1 / 0.3048};

// Tolerance of a texel: the surface changes within it, bias moves it, the format rounds it.
constexpr double kToleranceTexels = 2;
constexpr double kToleranceSteps = 4;
constexpr double kToleranceShare = 1e-4;  ///< of the depth range

constexpr double kFitsOverScene = 0.4;  ///< largest share of texels off of a reading that fits
constexpr double kFitsAlone = 0.1;
constexpr double kSameShare = 0.02;  ///< readings fit equally well whose shares differ by less
constexpr double kSameTexels = 0.25;
constexpr double kSameMedians = 3;  ///< and whose medians differ by a smaller factor, or are below kSameTexels

/// Largest angle between a stated direction and that of the matrix, as a cosine, and distance of a place.
constexpr double kSameDirection = 0.99;
constexpr double kSamePlace = 0.01;  ///< of the distance of the far plane

/// Texel of one map that is compared.
struct MapSample {
    glm::dvec2 uv{0};
    int column = 0, row_from_top = 0;
};

/// Samples of one map: rows from the top, each from the left.
struct MapSamples {
    int across = 0, down = 0;
    std::vector<MapSample> list;
};

/// Place of a map's sample in a view.
struct SampleInView {
    double ray = 1;                ///< length of the ray for one metre along the axis
    double expected = kNoSurface;  ///< distance of the scene along the axis, metres; NaN: no surface
    double texel = 0;              ///< longest side of a texel there, metres
};

/// View of each map, and the scene at each sample.
struct ReadViews {
    std::vector<LightView> views;
    std::vector<std::vector<SampleInView>> samples;  ///< by map and sample
    std::string refusal;
};

/// Points of the maps' surfaces, by which readings with the same effect are found: a grid of each map, its rows from
/// the top.
struct SurfacePlaces {
    std::vector<glm::dvec3> backs;  ///< by map: both ends of parallel rays see the same places
    std::vector<std::vector<glm::dvec3>> grids;
    std::vector<int> across;  ///< of each grid
};

/// Returns the distance along the axis that a stored value means, metres. @param ray length of the ray for one metre
/// along the axis
double metres_of(double value, const Convention& convention, const BundleDepth& depth, const DepthCurve& curve,
                 double ray) {
    const auto at_share = [&](double share) { return curve.near + share * (curve.far - curve.near); };
    switch (convention.stored) {
        case BundleStored::Depth:
            return curve.distance(value);
        case BundleStored::Linear:
        case BundleStored::Moments:
            return at_share(value);
        case BundleStored::Exponential:
            return at_share(std::log(value) / depth.exponent.value_or(1));
        case BundleStored::AxisMetres:
            return value;
        case BundleStored::DistanceMetres:
            return value / ray;
        case BundleStored::DistanceShare:
            return value * convention.range_m.value_or(1) / ray;
    }
    return kNoSurface;
}

/// Returns the kinds of stored values to try. @param parallel true: the matrix does not say where metres along the axis
/// begin
std::vector<BundleStored> tried_kinds(const KnownConvention& known, bool over_scene, bool parallel, bool knows_range) {
    if (known.stored && (!over_scene || *known.stored == BundleStored::Exponential)) return {*known.stored};
    std::vector<BundleStored> out = {BundleStored::Depth};
    // Along parallel rays depth is linear; reversed linear values can be told apart over a scene alone.
    if (!parallel || over_scene) out.push_back(BundleStored::Linear);
    if (!parallel) {
        out.insert(out.end(), {BundleStored::AxisMetres, BundleStored::DistanceMetres});
        if (over_scene || knows_range) out.push_back(BundleStored::DistanceShare);
    }
    if (known.stored && std::ranges::find(out, *known.stored) == out.end()) out.push_back(*known.stored);
    return out;
}

/// Tries the readings of one light's maps.
class ConventionTrial {
public:
    ConventionTrial(const BundleLight& light, bool type_known, const glm::dmat4& world, const FloatImage& image,
                    const KnownConvention& known, const FirstCasters& casters)
        : light_(light), type_known_(type_known), world_(world), image_(image), known_(known), casters_(casters) {
        for (const BundleMap& map : light.maps) {
            samples_.push_back(samples_of(map, kSamplesAcross));
            screen_.push_back(samples_of(map, kScreenAcross));
        }
    }

    ConventionFits run() {
        ConventionFits out;
        out.over_scene = bool(casters_);
        for_each_matrix(own_, [&](const Convention& convention) { try_views(convention); });
        if (casters_) try_other_axes();
        out.fits = std::move(fits_);
        const auto share = [&](const ConventionFit& fit) {
            return fit.share_off() + (fit.convention.axes == own_ ? 0 : kOtherAxesShare);
        };
        std::ranges::stable_sort(out.fits, [&](const ConventionFit& a, const ConventionFit& b) {
            if (a.known != b.known) return a.known;
            if (a.refusal.empty() != b.refusal.empty()) return a.refusal.empty();
            if (share(a) != share(b)) return share(a) < share(b);
            return a.median_m < b.median_m;
        });
        find_equal(out);
        return out;
    }

private:
    /// Calls `work` with each order of matrices and each depth convention.
    template <typename Work>
    void for_each_matrix(const LightAxes& axes, const Work& work) const {
        const bool pair = std::ranges::any_of(light_.maps, [](const BundleMap& map) {
            return map.clip.view.has_value() && map.clip.projection.has_value();
        });
        for (const MatrixOrder matrix : {MatrixOrder::Columns, MatrixOrder::Rows})
            for (const ProductOrder product : {ProductOrder::ProjectionView, ProductOrder::ViewProjection})
                for (const bool zero_to_one : {true, false})
                    for (const bool reversed : {false, true}) {
                        if (product == ProductOrder::ViewProjection && !pair) continue;
                        Convention convention{{zero_to_one, reversed}, FirstRow::Bottom, matrix, product};
                        convention.axes = axes;
                        work(convention);
                    }
    }

    MapSamples samples_of(const BundleMap& map, int most_across) const {
        const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
        if (region.x > image_.width - region.width || region.y > image_.height - region.height)
            throw Error(fmt::format("the region {}, {}, {}, {} exceeds the image of {} × {} texels; correct the region",
                                    region.x, region.y, region.width, region.height, image_.width, image_.height));
        MapSamples out{std::min(most_across, region.width), std::min(most_across, region.height), {}};
        for (int j = 0; j < out.down; ++j)
            for (int i = 0; i < out.across; ++i) {
                const int x = int((i + 0.5) * region.width / out.across);
                const int y = int((j + 0.5) * region.height / out.down);
                out.list.push_back({{(x + 0.5) / region.width, 1 - (y + 0.5) / region.height}, x, y});
            }
        return out;
    }

    float stored_at(const BundleMap& map, const MapSample& sample, FirstRow first_row) const {
        const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
        const int row = first_row == FirstRow::Bottom ? region.height - 1 - sample.row_from_top : sample.row_from_top;
        return image_.at(region.x + sample.column, region.y + row, map.image.channel);
    }

    /// Returns the reason why a view is not that of the light; empty: it may be.
    /// @param world from the light's file to metres, y up, right-handed
    std::string contradiction(const LightView& view, const glm::dmat4& world) const {
        const bool parallel_light = light_.type == LightType::Directional;
        if (type_known_ && parallel_light == view.curve.perspective)
            return fmt::format("the matrix: its rays {}, unlike those of a {} light",
                               parallel_light ? "meet in a point" : "are parallel",
                               kLightTypeKeys[std::size_t(light_.type)]);
        if (light_.direction && light_.type == LightType::Directional) {
            const glm::dvec3 stated = glm::normalize(glm::dmat3(world) * *light_.direction);
            if (glm::dot(stated, -view.axes[2]) < kSameDirection)
                return fmt::format("the matrix: it looks along ({:.3g}, {:.3g}, {:.3g}), and not along the direction",
                                   -view.axes[2].x, -view.axes[2].y, -view.axes[2].z);
        }
        if (light_.position && view.curve.perspective) {
            const glm::dvec3 stated(world * glm::dvec4(*light_.position, 1));
            if (glm::distance(stated, view.eye) > kSamePlace * view.curve.far)
                return fmt::format("the matrix: its rays meet in ({:.4g}, {:.4g}, {:.4g}), and not at the position",
                                   view.eye.x, view.eye.y, view.eye.z);
        }
        return {};
    }

    ReadViews read_views(const Convention& convention, const std::vector<MapSamples>& samples) const {
        ReadViews out;
        // Direction and place are those of the scene's world afterwards, as the matrices are.
        const BundleLight light = with_convention(light_, convention);
        const glm::dmat4 engine_from_world = glm::inverse(world_);
        const glm::dmat4 world_from_light = world_ * convention.axes.scene_from_light();
        try {
            for (const BundleMap& map : light.maps) {
                out.views.push_back(view_of_matrix(map.clip.matrix() * engine_from_world, convention.depth));
                out.refusal = contradiction(out.views.back(), world_from_light);
                if (!out.refusal.empty()) return out;
            }
        } catch (const Error& error) {
            out.refusal = error.what();
            return out;
        }
        for (std::size_t m = 0; m < out.views.size(); ++m)
            out.samples.push_back(samples_in_view(out.views[m], m, samples[m].list));
        return out;
    }

    std::vector<SampleInView> samples_in_view(const LightView& view, std::size_t map,
                                              const std::vector<MapSample>& samples) const {
        std::vector<SampleInView> out(samples.size());
        for (std::size_t i = 0; i < out.size() && view.curve.perspective; ++i)
            out[i].ray = glm::distance(view.position_ws(samples[i].uv, 1), view.eye);
        if (!casters_) return out;
        std::vector<MapRay> rays;
        for (const MapSample& sample : samples) {
            const DepthCurve curve = view.curve.curve_at_row(sample.uv.y);
            rays.push_back({view.position_ws(sample.uv, curve.near), view.position_ws(sample.uv, curve.far)});
        }
        const std::vector<double> found = casters_(rays);
        const BundleRegion region = region_of(light_.maps[map]);
        const MapSize size(region.width, region.height);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (std::isnan(found[i])) continue;
            const DepthCurve curve = view.curve.curve_at_row(samples[i].uv.y);
            const double share = found[i] / glm::distance(rays[i].from_ws, rays[i].to_ws);
            out[i].expected = curve.near + share * (curve.far - curve.near);
            out[i].texel = view.texel_size_at(view.position_ws(samples[i].uv, out[i].expected), size).longest;
        }
        return out;
    }

    BundleRegion region_of(const BundleMap& map) const {
        return map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
    }

    /// Calls `work` with each kind of stored values and each first row of a reading. @param view of the first map
    template <typename Work>
    void for_each_reading(Convention convention, const LightView& view, const Work& work) const {
        const std::optional<double> range = light_.maps.front().depth.range_m;
        // Distances may be stored in units of the light's file.
        const double unit = glm::length(glm::dvec3(world_[0])) * convention.axes.unit;
        for (const BundleStored stored :
             tried_kinds(known_, bool(casters_), !view.curve.perspective, range.has_value()))
            for (const FirstRow first_row : {FirstRow::Bottom, FirstRow::Top}) {
                convention.stored = stored;
                convention.first_row = first_row;
                convention.range_m.reset();
                if (stored == BundleStored::DistanceShare) convention.range_m = range.value_or(view.curve.far);
                work(convention);
                if (stored != BundleStored::DistanceShare || range || std::abs(unit - 1) < 1e-12) continue;
                convention.range_m = unit;
                work(convention);
            }
    }

    /// Returns true where a reading contradicts no known part of the matrix.
    bool allows_matrix(const Convention& convention) const {
        KnownConvention of_matrix = known_;
        of_matrix.first_row.reset();
        of_matrix.stored.reset();
        return of_matrix.allows(convention);
    }

    void try_views(const Convention& convention) {
        const bool known = allows_matrix(convention);
        // Without a scene nothing shows that a known part is wrong.
        if (!known && !casters_) return;
        const ReadViews read = read_views(convention, samples_);
        if (!read.refusal.empty()) {
            if (known) fits_.push_back({.convention = convention, .refusal = read.refusal});
            return;
        }
        for_each_reading(convention, read.views.front(), [&](const Convention& reading) {
            if (casters_ || known_.allows(reading)) add_fit(reading, read);
        });
    }

    /// Compares readings in other axes and units than the scene's: all with few texels, then the best with all texels.
    void try_other_axes() {
        std::vector<std::pair<double, Convention>> screened;
        for (const UpAxis up : kTriedUp)
            for (const MirroredAxis mirrored : kTriedMirrored)
                for (const double unit : kTriedUnits) {
                    const LightAxes axes{known_.up.value_or(up), known_.mirrored.value_or(mirrored),
                                         known_.unit.value_or(unit)};
                    // A known part takes the place of each that is tried.
                    if (axes == own_ || !(axes == LightAxes{up, mirrored, known_.unit ? axes.unit : unit})) continue;
                    if (known_.unit && unit != kTriedUnits[0]) continue;
                    for_each_matrix(axes, [&](const Convention& convention) { screen_views(convention, screened); });
                }
        std::ranges::stable_sort(screened, {}, &std::pair<double, Convention>::first);
        for (std::size_t i = 0; i < std::min(screened.size(), kScreened); ++i) {
            if (screened[i].first > std::min(kScreenShare, screened.front().first + kScreenMargin)) break;
            const ReadViews read = read_views(screened[i].second, samples_);
            if (read.refusal.empty()) add_fit(screened[i].second, read);
        }
    }

    void screen_views(const Convention& convention, std::vector<std::pair<double, Convention>>& screened) const {
        if (!allows_matrix(convention)) return;
        const ReadViews read = read_views(convention, screen_);
        if (!read.refusal.empty()) return;
        for_each_reading(convention, read.views.front(), [&](const Convention& reading) {
            if (!known_.allows(reading)) return;
            const double share = fit_of(reading, read, screen_, nullptr).share_off();
            if (share <= kScreenShare) screened.emplace_back(share, reading);
        });
    }

    /// Compares a reading with the scene. @param places receives points of the maps' surfaces; may be null
    ConventionFit fit_of(const Convention& convention, const ReadViews& read,
                         const std::vector<MapSamples>& all_samples, SurfacePlaces* places) const {
        ConventionFit fit{.convention = convention, .known = known_.allows(convention)};
        std::vector<double> metres, texels;
        for (std::size_t m = 0; m < read.views.size(); ++m) {
            const BundleMap& map = light_.maps[m];
            const LightView& view = read.views[m];
            const MapSamples& samples = all_samples[m];
            if (places) {
                places->backs.push_back(view.axes[2]);
                places->grids.emplace_back();
                places->across.push_back(0);
            }
            for (std::size_t i = 0; i < samples.list.size(); ++i) {
                const MapSample& sample = samples.list[i];
                const SampleInView& seen = read.samples[m][i];
                const DepthCurve curve = view.curve.curve_at_row(sample.uv.y);
                const float value = stored_at(map, sample, convention.first_row);
                double z = metres_of(value, convention, map.depth, curve, seen.ray);
                const double range = curve.far - curve.near, rounding = 1e-5 * range;
                const bool is_clear = (map.depth.clear && value == float(*map.depth.clear)) || std::isnan(value);
                // Depth beyond the range has a meaning that the reading of the range lacks.
                const bool is_depth = convention.stored == BundleStored::Depth;
                const bool beyond_far = is_depth ? (curve.convention.reversed ? value < 0 : value > 1)
                                                 : z > curve.far + rounding && z < INFINITY;
                const bool before_near =
                    is_depth ? (curve.convention.reversed ? value > 1 : value < 0) : z < curve.near - rounding;
                const bool is_outside = !is_clear && (before_near || std::isnan(z) ||
                                                      (beyond_far && convention.stored != BundleStored::DistanceShare));
                if (is_clear || !(z < curve.far - 1e-7 * range)) z = kNoSurface;
                ++fit.texels;
                fit.empty += std::isnan(z);
                fit.outside += is_outside;
                if (places && is_in_grid(samples, i)) {
                    places->grids.back().push_back(view.position_ws(sample.uv, std::isnan(z) ? curve.far : z));
                    if (int(i) < samples.across) ++places->across.back();
                }
                if (!casters_) {
                    const bool on_near = !std::isnan(z) && std::abs(z - curve.near) <= rounding;
                    ++fit.samples;
                    fit.off += is_outside || on_near;
                    continue;
                }
                if (std::isnan(seen.expected) && std::isnan(z)) continue;
                ++fit.samples;
                if (std::isnan(seen.expected) || std::isnan(z)) {
                    ++fit.off;
                    ++(std::isnan(seen.expected) ? fit.behind : fit.before);
                    metres.push_back(INFINITY);
                    texels.push_back(INFINITY);
                    continue;
                }
                const double slope = is_depth ? curve.slope(seen.expected) : 1 / range;
                const double tolerance = kToleranceTexels * seen.texel +
                                         kToleranceSteps * depth_step(map.depth.format) / slope +
                                         kToleranceShare * range;
                const double error = z - seen.expected;
                metres.push_back(std::abs(error));
                texels.push_back(std::abs(error) / seen.texel);
                if (std::abs(error) <= tolerance) continue;
                ++fit.off;
                ++(error < 0 ? fit.behind : fit.before);
            }
        }
        if (!metres.empty() && places) {
            fit.median_m = median(std::move(metres));
            fit.median_texels = median(std::move(texels));
        }
        return fit;
    }

    /// Returns true for samples of a grid of at most 8 x 8 samples, which is the same from both ends.
    static bool is_in_grid(const MapSamples& samples, std::size_t index) {
        const int i = int(index) % samples.across, j = int(index) / samples.across;
        const auto is_in = [](int k, int count) {
            constexpr int kStep = (kSamplesAcross - 1) / 7;
            return count < kSamplesAcross || k % kStep == 0;
        };
        return is_in(i, samples.across) && is_in(j, samples.down);
    }

    void add_fit(const Convention& convention, const ReadViews& read) {
        SurfacePlaces places;
        const ConventionFit fit = fit_of(convention, read, samples_, &places);
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (have_same_effect(fits_[place_of_[i]], places_[i], fit, places)) {
                // The known one of two is kept.
                if (fit.known && !fits_[place_of_[i]].known) fits_[place_of_[i]] = fit;
                return;
            }
        place_of_.push_back(fits_.size());
        places_.push_back(std::move(places));
        fits_.push_back(fit);
    }

    static bool have_same_effect(const ConventionFit& a, const SurfacePlaces& places_a, const ConventionFit& b,
                                 const SurfacePlaces& places_b) {
        if (a.samples != b.samples || a.off != b.off) return false;
        // A mirrored axis and the other first row may undo each other.
        const bool turned = a.convention.first_row != b.convention.first_row;
        if (turned && a.convention.axes == b.convention.axes) return false;
        const auto are_near = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& first) {
            const double size = glm::length(p) + glm::distance(p, first);
            return glm::distance(p, q) <= 1e-6 * size;
        };
        for (std::size_t m = 0; m < places_a.grids.size(); ++m) {
            if (!are_near(places_a.backs[m], places_b.backs[m], places_a.backs[m])) return false;
            const std::vector<glm::dvec3>&grid_a = places_a.grids[m], &grid_b = places_b.grids[m];
            const std::size_t across = std::size_t(places_a.across[m]);
            for (std::size_t i = 0; i < grid_a.size(); ++i) {
                const std::size_t row = i / across, rows = grid_a.size() / across;
                const std::size_t k = turned ? (rows - 1 - row) * across + i % across : i;
                if (!are_near(grid_a[i], grid_b[k], grid_a.front())) return false;
            }
        }
        return true;
    }

    /// Moves the readings that fit equally well to the start, and counts them.
    void find_equal(ConventionFits& all) const {
        if (all.fits.empty()) return;
        const ConventionFit best = all.fits.front();
        const double most = all.over_scene ? kFitsOverScene : kFitsAlone;
        if (!best.known || !best.refusal.empty() || best.share_off() > most) return;
        const auto fits_equally = [&](const ConventionFit& fit) {
            return fit.known && fit.refusal.empty() && fit.share_off() <= best.share_off() + kSameShare &&
                   fit.median_texels <= std::max(kSameMedians * best.median_texels, kSameTexels);
        };
        const auto is_better = [&](const ConventionFit& fit) {
            return fit.share_off() + kOtherAxesShare < best.share_off() ||
                   std::max(kSameMedians * fit.median_texels, kSameTexels) < best.median_texels;
        };
        // In a symmetric scene the light's file is taken to share the scene's axes.
        const auto is_other = [&](const ConventionFit& fit) {
            return best.convention.axes == own_ && !(fit.convention.axes == own_) && !is_better(fit);
        };
        const auto rest = std::stable_partition(all.fits.begin(), all.fits.end(), [&](const ConventionFit& fit) {
            return fits_equally(fit) && !is_other(fit);
        });
        all.equal = std::size_t(rest - all.fits.begin());
        all.other_axes = std::size_t(std::count_if(rest, all.fits.end(), fits_equally));
    }

    const BundleLight& light_;
    bool type_known_;
    const glm::dmat4& world_;
    const FloatImage& image_;
    const KnownConvention& known_;
    const FirstCasters& casters_;
    const LightAxes own_ = known_.own_axes();
    std::vector<MapSamples> samples_, screen_;  ///< by map: all that are compared, and few of them
    std::vector<ConventionFit> fits_;
    std::vector<SurfacePlaces> places_;  ///< by tried reading
    std::vector<std::size_t> place_of_;  ///< index in fits_
};

}  // namespace

double depth_step(BundleDepthFormat format) {
    switch (format) {
        case BundleDepthFormat::D16:
            return 1.0 / 65535;
        case BundleDepthFormat::D24:
            return 1.0 / 16777215;
        case BundleDepthFormat::R16F:
            return 1.0 / 2048;
        case BundleDepthFormat::D32F:
        case BundleDepthFormat::R32F:
            break;
    }
    return 6e-8;
}

bool KnownConvention::allows(const Convention& c) const {
    const auto fits = [](const auto& mine, const auto& theirs) { return !mine || *mine == theirs; };
    return fits(zero_to_one, c.depth.zero_to_one) && fits(reversed, c.depth.reversed) && fits(first_row, c.first_row) &&
           fits(matrix, c.matrix) && fits(product, c.product) && fits(stored, c.stored) && fits(up, c.axes.up) &&
           fits(mirrored, c.axes.mirrored) && fits(unit, c.axes.unit);
}

LightAxes KnownConvention::own_axes() const {
    return {up.value_or(UpAxis::Y), mirrored.value_or(MirroredAxis::None), unit.value_or(1)};
}

glm::dmat4 LightAxes::scene_from_light() const {
    glm::dvec3 mirror(1);
    if (mirrored != MirroredAxis::None) mirror[int(mirrored) - 1] = -1;
    const glm::dmat3 turn = y_up_from(up);
    return glm::dmat4(unit * glm::dmat3(mirror.x * turn[0], mirror.y * turn[1], mirror.z * turn[2]));
}

BundleLight with_convention(const BundleLight& light, const Convention& convention) {
    BundleLight out = light;
    const glm::dmat4 scene_from_light = convention.axes.scene_from_light();
    const glm::dmat4 light_from_scene = glm::inverse(scene_from_light);
    const bool changes_axes = !(convention.axes == LightAxes());
    if (changes_axes && out.direction) out.direction = glm::dmat3(scene_from_light) * *out.direction;
    if (changes_axes && out.position) out.position = glm::dvec3(scene_from_light * glm::dvec4(*out.position, 1));
    for (BundleMap& map : out.maps) {
        BundleMatrix& clip = map.clip;
        if (convention.matrix == MatrixOrder::Rows)
            for (std::optional<glm::dmat4>* matrix :
                 {&clip.clip_from_world, &clip.view, &clip.world_from_view, &clip.projection})
                if (*matrix) *matrix = glm::transpose(**matrix);
        if (convention.product == ProductOrder::ViewProjection && clip.view && clip.projection)
            std::swap(clip.view, clip.projection);
        if (changes_axes && clip.clip_from_world) *clip.clip_from_world *= light_from_scene;
        if (changes_axes && clip.view) *clip.view *= light_from_scene;
        if (changes_axes && clip.world_from_view) clip.world_from_view = scene_from_light * *clip.world_from_view;
        map.image.first_row = convention.first_row;
        map.depth.convention = convention.depth;
        map.depth.stored = convention.stored;
        if (convention.range_m) map.depth.range_m = convention.range_m;
    }
    return out;
}

ConventionFits fit_conventions(const BundleLight& light, bool type_known, const glm::dmat4& world,
                               const FloatImage& image, const KnownConvention& known, const FirstCasters& casters) {
    return ConventionTrial(light, type_known, world, image, known, casters).run();
}

std::string fit_sentence(const ConventionFit& fit, bool over_scene) {
    if (!fit.refusal.empty()) return fit.refusal;
    const auto percent = [&](std::size_t count) {
        return 100.0 * double(count) / double(std::max<std::size_t>(fit.samples, 1));
    };
    if (!over_scene)
        return fmt::format("{:.1f} % of {} texels lie beyond or on the near plane, {:.1f} % are empty",
                           percent(fit.off), fit.texels,
                           100.0 * double(fit.empty) / double(std::max<std::size_t>(fit.texels, 1)));
    if (fit.samples == 0) return "neither map nor scene has a surface in the map's volume: another matrix?";
    if (2 * fit.behind > fit.samples)
        return fmt::format("the scene lies behind the map at {:.1f} % of the texels: reversed depth?",
                           percent(fit.behind));
    if (2 * fit.before > fit.samples)
        return fmt::format("the scene lies before the map at {:.1f} % of the texels: another depth range or matrix?",
                           percent(fit.before));
    return fmt::format("{:.1f} % of {} texels differ by more than the tolerance, the median is {:.3g} m",
                       percent(fit.off), fit.samples, fit.median_m);
}

}  // namespace si
