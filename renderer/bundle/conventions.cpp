#include "renderer/bundle/conventions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/error.h"
#include "renderer/base/median.h"
#include "renderer/projection/view_of_matrix.h"

namespace si {
namespace {

constexpr double kNoSurface = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamplesAcross = 64;  ///< of one map

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

/// View of each map, and the scene's distance along the axis at each sample.
struct ReadViews {
    std::vector<LightView> views;
    std::vector<std::vector<double>> expected;  ///< by map and sample, metres; NaN: no surface
    std::string refusal;
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
        for (const BundleMap& map : light.maps) samples_.push_back(samples_of(map));
    }

    ConventionFits run() {
        ConventionFits out;
        out.over_scene = bool(casters_);
        const bool pair = std::ranges::any_of(light_.maps, [](const BundleMap& map) {
            return map.clip.view.has_value() && map.clip.projection.has_value();
        });
        for (const MatrixOrder matrix : {MatrixOrder::Columns, MatrixOrder::Rows})
            for (const ProductOrder product : {ProductOrder::ProjectionView, ProductOrder::ViewProjection})
                for (const bool zero_to_one : {true, false})
                    for (const bool reversed : {false, true})
                        if (product == ProductOrder::ProjectionView || pair)
                            try_views({{zero_to_one, reversed}, FirstRow::Bottom, matrix, product});
        out.fits = std::move(fits_);
        std::ranges::stable_sort(out.fits, [](const ConventionFit& a, const ConventionFit& b) {
            if (a.known != b.known) return a.known;
            if (a.refusal.empty() != b.refusal.empty()) return a.refusal.empty();
            if (a.share_off() != b.share_off()) return a.share_off() < b.share_off();
            return a.median_m < b.median_m;
        });
        out.equal = count_equal(out);
        return out;
    }

private:
    std::vector<MapSample> samples_of(const BundleMap& map) const {
        const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
        if (region.x > image_.width - region.width || region.y > image_.height - region.height)
            throw Error(fmt::format("the region {}, {}, {}, {} exceeds the image of {} × {} texels; correct the region",
                                    region.x, region.y, region.width, region.height, image_.width, image_.height));
        std::vector<MapSample> out;
        const int across = std::min(kSamplesAcross, region.width), down = std::min(kSamplesAcross, region.height);
        for (int j = 0; j < down; ++j)
            for (int i = 0; i < across; ++i) {
                const int x = int((i + 0.5) * region.width / across), y = int((j + 0.5) * region.height / down);
                out.push_back({{(x + 0.5) / region.width, 1 - (y + 0.5) / region.height}, x, y});
            }
        return out;
    }

    float stored_at(const BundleMap& map, const MapSample& sample, FirstRow first_row) const {
        const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
        const int row = first_row == FirstRow::Bottom ? region.height - 1 - sample.row_from_top : sample.row_from_top;
        return image_.at(region.x + sample.column, region.y + row, map.image.channel);
    }

    /// Returns the reason why a view is not that of the light; empty: it may be.
    std::string contradiction(const LightView& view) const {
        const bool parallel_light = light_.type == LightType::Directional;
        if (type_known_ && parallel_light == view.curve.perspective)
            return fmt::format("the matrix: its rays {}, unlike those of a {} light",
                               parallel_light ? "meet in a point" : "are parallel",
                               kLightTypeKeys[std::size_t(light_.type)]);
        if (light_.direction && light_.type == LightType::Directional) {
            const glm::dvec3 stated = glm::normalize(glm::dmat3(world_) * *light_.direction);
            if (glm::dot(stated, -view.axes[2]) < kSameDirection)
                return fmt::format("the matrix: it looks along ({:.3g}, {:.3g}, {:.3g}), and not along the direction",
                                   -view.axes[2].x, -view.axes[2].y, -view.axes[2].z);
        }
        if (light_.position && view.curve.perspective) {
            const glm::dvec3 stated(world_ * glm::dvec4(*light_.position, 1));
            if (glm::distance(stated, view.eye) > kSamePlace * view.curve.far)
                return fmt::format("the matrix: its rays meet in ({:.4g}, {:.4g}, {:.4g}), and not at the position",
                                   view.eye.x, view.eye.y, view.eye.z);
        }
        return {};
    }

    ReadViews read_views(const Convention& convention) const {
        ReadViews out;
        const BundleLight light = with_convention(light_, convention);
        try {
            for (const BundleMap& map : light.maps) {
                out.views.push_back(view_of_matrix(map.clip.matrix() * glm::inverse(world_), convention.depth));
                out.refusal = contradiction(out.views.back());
                if (!out.refusal.empty()) return out;
            }
        } catch (const Error& error) {
            out.refusal = error.what();
            return out;
        }
        for (std::size_t m = 0; m < out.views.size() && casters_; ++m)
            out.expected.push_back(expected_of(out.views[m], m));
        return out;
    }

    std::vector<double> expected_of(const LightView& view, std::size_t map) const {
        std::vector<MapRay> rays;
        for (const MapSample& sample : samples_[map]) {
            const DepthCurve curve = view.curve.curve_at_row(sample.uv.y);
            rays.push_back({view.position_ws(sample.uv, curve.near), view.position_ws(sample.uv, curve.far)});
        }
        std::vector<double> out = casters_(rays);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const DepthCurve curve = view.curve.curve_at_row(samples_[map][i].uv.y);
            const double share = out[i] / glm::distance(rays[i].from_ws, rays[i].to_ws);
            out[i] = curve.near + share * (curve.far - curve.near);
        }
        return out;
    }

    void try_views(Convention convention) {
        KnownConvention of_matrix = known_;
        of_matrix.first_row.reset();
        of_matrix.stored.reset();
        const bool known = of_matrix.allows(convention);
        // Without a scene nothing shows that a known part is wrong.
        if (!known && !casters_) return;
        const ReadViews read = read_views(convention);
        if (!read.refusal.empty()) {
            if (known) fits_.push_back({.convention = convention, .refusal = read.refusal});
            return;
        }
        const bool parallel = !read.views.front().curve.perspective;
        const bool knows_range = light_.maps.front().depth.range_m.has_value();
        for (const BundleStored stored : tried_kinds(known_, bool(casters_), parallel, knows_range))
            for (const FirstRow first_row : {FirstRow::Bottom, FirstRow::Top}) {
                convention.stored = stored;
                convention.first_row = first_row;
                convention.range_m.reset();
                if (stored == BundleStored::DistanceShare)
                    convention.range_m = light_.maps.front().depth.range_m.value_or(read.views.front().curve.far);
                if (!casters_ && !known_.allows(convention)) continue;
                add_fit(convention, read);
            }
    }

    void add_fit(const Convention& convention, const ReadViews& read) {
        ConventionFit fit{.convention = convention, .known = known_.allows(convention)};
        std::vector<double> metres, texels;
        std::vector<glm::dvec3> places;
        for (std::size_t m = 0; m < read.views.size(); ++m) {
            const BundleMap& map = light_.maps[m];
            const LightView& view = read.views[m];
            const BundleRegion region = map.region.value_or(BundleRegion{0, 0, image_.width, image_.height});
            const MapSize size(region.width, region.height);
            places.push_back(view.axes[2]);  // both ends of parallel rays see the same places
            for (std::size_t i = 0; i < samples_[m].size(); ++i) {
                const MapSample& sample = samples_[m][i];
                const DepthCurve curve = view.curve.curve_at_row(sample.uv.y);
                const float value = stored_at(map, sample, convention.first_row);
                const double ray = view.curve.perspective ? glm::distance(view.position_ws(sample.uv, 1), view.eye) : 1;
                double z = metres_of(value, convention, map.depth, curve, ray);
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
                if (places.size() < 256 || i % 16 == 0)
                    places.push_back(view.position_ws(sample.uv, std::isnan(z) ? curve.far : z));
                if (!casters_) {
                    const bool on_near = !std::isnan(z) && std::abs(z - curve.near) <= rounding;
                    ++fit.samples;
                    fit.off += is_outside || on_near;
                    continue;
                }
                const double expected = read.expected[m][i];
                if (std::isnan(expected) && std::isnan(z)) continue;
                ++fit.samples;
                if (std::isnan(expected) || std::isnan(z)) {
                    ++fit.off;
                    ++(std::isnan(expected) ? fit.behind : fit.before);
                    metres.push_back(INFINITY);
                    texels.push_back(INFINITY);
                    continue;
                }
                const double texel = view.texel_size_at(view.position_ws(sample.uv, expected), size).longest;
                const double slope = is_depth ? curve.slope(expected) : 1 / range;
                const double tolerance = kToleranceTexels * texel +
                                         kToleranceSteps * depth_step(map.depth.format) / slope +
                                         kToleranceShare * range;
                const double error = z - expected;
                metres.push_back(std::abs(error));
                texels.push_back(std::abs(error) / texel);
                if (std::abs(error) <= tolerance) continue;
                ++fit.off;
                ++(error < 0 ? fit.behind : fit.before);
            }
        }
        if (!metres.empty()) {
            fit.median_m = median(std::move(metres));
            fit.median_texels = median(std::move(texels));
        }
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

    static bool have_same_effect(const ConventionFit& a, const std::vector<glm::dvec3>& places_a,
                                 const ConventionFit& b, const std::vector<glm::dvec3>& places_b) {
        if (a.convention.first_row != b.convention.first_row || a.samples != b.samples || a.off != b.off) return false;
        for (std::size_t i = 0; i < places_a.size(); ++i) {
            const double size = glm::length(places_a[i]) + glm::distance(places_a[i], places_a.front());
            if (!(glm::distance(places_a[i], places_b[i]) <= 1e-6 * size)) return false;
        }
        return true;
    }

    static std::size_t count_equal(const ConventionFits& all) {
        if (all.fits.empty()) return 0;
        const ConventionFit& best = all.fits.front();
        const double most = all.over_scene ? kFitsOverScene : kFitsAlone;
        if (!best.known || !best.refusal.empty() || best.share_off() > most) return 0;
        std::size_t out = 0;
        while (out < all.fits.size()) {
            const ConventionFit& fit = all.fits[out];
            if (!fit.known || !fit.refusal.empty() || fit.share_off() > best.share_off() + kSameShare) break;
            if (fit.median_texels > std::max(kSameMedians * best.median_texels, kSameTexels)) break;
            ++out;
        }
        return out;
    }

    const BundleLight& light_;
    bool type_known_;
    const glm::dmat4& world_;
    const FloatImage& image_;
    const KnownConvention& known_;
    const FirstCasters& casters_;
    std::vector<std::vector<MapSample>> samples_;  ///< by map
    std::vector<ConventionFit> fits_;
    std::vector<std::vector<glm::dvec3>> places_;  ///< of the map's surface, by tried reading
    std::vector<std::size_t> place_of_;            ///< index in fits_
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
           fits(matrix, c.matrix) && fits(product, c.product) && fits(stored, c.stored);
}

BundleLight with_convention(const BundleLight& light, const Convention& convention) {
    BundleLight out = light;
    for (BundleMap& map : out.maps) {
        BundleMatrix& clip = map.clip;
        if (convention.matrix == MatrixOrder::Rows)
            for (std::optional<glm::dmat4>* matrix :
                 {&clip.clip_from_world, &clip.view, &clip.world_from_view, &clip.projection})
                if (*matrix) *matrix = glm::transpose(**matrix);
        if (convention.product == ProductOrder::ViewProjection && clip.view && clip.projection)
            std::swap(clip.view, clip.projection);
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
