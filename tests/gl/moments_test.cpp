// Tests kernels that read averages of functions of depth: the averages equal those of the map's depths, bounds equal
// the papers' formulas, and no setting gives NaN.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renderer/base/index_of.h"
#include "renderer/gl/target.h"
#include "renderer/inspect/probe.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/idle_reason.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

using Moments = std::array<double, 4>;

const FrameRequest kPicture{.width = 160, .height = 90};
const FrameRequest kMaps{
    .width = kPicture.width, .height = kPicture.height, .outputs = {.colour = false, .shadow_map = true}};
const FrameRequest kSmallMaps{.width = 32, .height = 18, .outputs = {.colour = false, .shadow_map = true}};

bool reads(const Filter& row, std::string_view key) {
    return std::ranges::find(row.settings, key) != row.settings.end();
}

/// Returns the functions of depth that each kernel stores, by its paper.
Moments moments_of(std::string_view key, const FilterSettings& s, double z) {
    const double x = 2 * z - 1, rise = std::exp(s.exponent * x), fall = -std::exp(-s.negative_exponent * x);
    if (key == "esm") return {rise};
    if (key == "evsm2") return {rise, rise * rise};
    if (key == "evsm4") return {rise, rise * rise, fall, fall * fall};
    return {z, z * z, z * z * z, z * z * z * z};
}

std::vector<const Filter*> moment_rows() {
    std::vector<const Filter*> out;
    for (const Filter& row : filters())
        if (row.samples() == Samples::Moments) out.push_back(&row);
    return out;
}

double share_of(const DepthCurve& c, double depth) {
    return (c.distance(depth) - c.near) / (c.far - c.near);
}

/// A map's depths as shares of its range, with averages of functions of them.
class Shares {
public:
    Shares(const FloatImage& map, const DepthCurve& curve) : n_(map.width) {
        for (int y = 0; y < n_; ++y)
            for (int x = 0; x < n_; ++x) z_.push_back(share_of(curve, map.at(x, n_ - 1 - y)));
    }
    int size() const { return n_; }
    double at(int x, int y) const { return z_[std::size_t(y) * std::size_t(n_) + std::size_t(x)]; }

    /// Returns `texel`'s values of the 2x2 texels about `uv`, bilinearly blended.
    template <class Texel>
    static Moments blended(const glm::dvec2& uv, int n, Texel texel) {
        const glm::dvec2 p = uv * double(n) - 0.5, lo = glm::floor(p), f = p - lo;
        Moments sum{};
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                const double w = (i ? f.x : 1 - f.x) * (j ? f.y : 1 - f.y);
                const Moments m = texel(std::clamp(int(lo.x) + i, 0, n - 1), std::clamp(int(lo.y) + j, 0, n - 1));
                for (std::size_t k = 0; k < 4; ++k) sum[k] += w * m[k];
            }
        return sum;
    }

    /// Returns the mean over the map's texels within `radius` of a texel.
    template <class Of>
    Moments mean(int x, int y, int radius, bool gaussian, Of of) const {
        Moments sum{};
        double weights = 0;
        for (int v = std::max(0, y - radius); v <= std::min(n_ - 1, y + radius); ++v)
            for (int u = std::max(0, x - radius); u <= std::min(n_ - 1, x + radius); ++u) {
                const double dx = 2.0 * (u - x) / std::max(radius, 1), dy = 2.0 * (v - y) / std::max(radius, 1);
                const double w = gaussian ? std::exp(-0.5 * (dx * dx + dy * dy)) : 1;
                const Moments m = of(at(u, v));
                weights += w;
                for (std::size_t k = 0; k < 4; ++k) sum[k] += w * m[k];
            }
        for (double& m : sum) m /= weights;
        return sum;
    }

    /// Returns the mean over a square about `uv`, weighted by each texel's covered area.
    template <class Of>
    Moments over(const glm::dvec2& uv, double width, Of of) const {
        const glm::dvec2 lo = glm::max(uv * double(n_) - 0.5 * width, glm::dvec2(0));
        const glm::dvec2 hi = glm::min(uv * double(n_) + 0.5 * width, glm::dvec2(n_));
        Moments sum{};
        double weights = 0;
        for (int y = int(lo.y); y < std::min(n_, int(std::ceil(hi.y))); ++y)
            for (int x = int(lo.x); x < std::min(n_, int(std::ceil(hi.x))); ++x) {
                const double w = (std::min(hi.x, x + 1.0) - std::max(lo.x, double(x))) *
                                 (std::min(hi.y, y + 1.0) - std::max(lo.y, double(y)));
                const Moments m = of(at(x, y));
                weights += w;
                for (std::size_t k = 0; k < 4; ++k) sum[k] += w * m[k];
            }
        for (double& m : sum) m /= weights;
        return sum;
    }

private:
    int n_;
    std::vector<double> z_;
};

/// Returns the averages that the kernel should read at a place of the map.
Moments expected_moments(const Filter& row, const FilterSettings& s, const Shares& shares, const glm::dvec2& uv) {
    const auto of = [&](double z) { return moments_of(row.key, s, z); };
    if (row.moments.summed) return shares.over(uv, s.window, of);
    return Shares::blended(uv, shares.size(), [&](int x, int y) {
        return shares.mean(x, y, s.blur, s.blur_shape == BlurShape::Gaussian, of);
    });
}

double cantelli(double mean, double square, double own, double least) {
    if (own <= mean) return 1;
    const double v = std::max(square - mean * mean, least);
    return v / (v + (own - mean) * (own - mean));
}

using Matrix = std::vector<std::vector<double>>;  ///< rows with the right side in the last column

std::vector<double> solve(Matrix m) {
    const std::size_t n = m.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c; r < n; ++r)
            if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
        std::swap(m[c], m[pivot]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const double f = m[r][c] / m[c][c];
            for (std::size_t k = c; k <= n; ++k) m[r][k] -= f * m[c][k];
        }
    }
    std::vector<double> x(n);
    for (std::size_t r = 0; r < n; ++r) x[r] = m[r][n] / m[r][r];
    return x;
}

/// Returns the share before `own` of the distribution at these depths with equal moments.
double share_before(const std::vector<double>& depths, const Moments& b, double own) {
    Matrix m;
    for (std::size_t k = 0; k < depths.size(); ++k) {
        std::vector<double> row;
        for (const double z : depths) row.push_back(std::pow(z, double(k)));
        row.push_back(k == 0 ? 1 : b[k - 1]);
        m.push_back(row);
    }
    const std::vector<double> weights = solve(m);
    double sum = 0;
    for (std::size_t i = 0; i < depths.size(); ++i)
        if (depths[i] < own - 1e-12) sum += weights[i];
    return sum;
}

/// Returns Peters and Klein's bound, by Gaussian elimination.
double moment_bound(const Moments& read, double bias, double own, bool hausdorff) {
    Moments b{};
    for (std::size_t k = 0; k < 4; ++k) b[k] = (1 - bias) * read[k] + bias * 0.5;
    const std::vector<double> c = solve({{1, b[0], b[1], 1}, {b[0], b[1], b[2], own}, {b[1], b[2], b[3], own * own}});
    const double p = c[1] / c[2], q = c[0] / c[2], r = std::sqrt(std::max(0.25 * p * p - q, 0.0));
    double z1 = -0.5 * p - r, z2 = -0.5 * p + r;
    std::vector<double> depths = {own, z1, z2};
    if (hausdorff && (z1 < 0 || z2 > 1)) {
        const double free = ((b[2] - b[3]) - own * (b[1] - b[2])) / ((b[1] - b[2]) - own * (b[0] - b[1]));
        depths = {0, own, free, 1};
    }
    return 1 - std::clamp(share_before(depths, b, own), 0.0, 1.0);
}

/// Returns the bound by the moments that the kernel reports.
double bound_of(const Filter& row, const FilterSettings& s, const Moments& m, double own) {
    const double x = 2 * own - 1, rise = std::exp(s.exponent * x), fall = -std::exp(-s.negative_exponent * x);
    const auto warped = [&](double mean, double square, double w, double exponent) {
        const double least = 2 * exponent * w * std::sqrt(s.min_variance);
        return cantelli(mean, square, w, least * least);
    };
    if (row.key == "esm") return std::min(m[0] / rise, 1.0);
    if (row.key == "evsm2") return warped(m[0], m[1], rise, s.exponent);
    if (row.key == "evsm4")
        return std::min(warped(m[0], m[1], rise, s.exponent), warped(m[2], m[3], fall, s.negative_exponent));
    if (row.key == "msm_hamburger" || row.key == "msm_hausdorff")
        return moment_bound(m, s.moment_bias, own, row.key == "msm_hausdorff");
    return cantelli(m[0], m[1], own, s.min_variance);
}

struct Case {
    LightType light;
    bool reversed;
    glm::dvec3 at;
    double azimuth;
};

SI_TESTS_ARE(Repeated, Moments);
// Every row is tested under every type of light and both directions of depth, near and far from the origin: moments by
// the map, the bound by the moments, visibility by the bound.
SI_TEST_IS(Later, Moments, EqualMeansOfDepthPowersAndBoundTheLightAsThePapersState);
TEST(Moments, EqualMeansOfDepthPowersAndBoundTheLightAsThePapersState) {
    const Case cases[] = {{LightType::Directional, false, {0, 0, 0}, 30},
                          {LightType::Spot, true, {90, 5, -70}, 90},
                          {LightType::Point, false, {-115, 0, 20}, 30}};
    Renderer& renderer = hard_renderer();
    std::size_t turn = 0;
    int partly = 0;
    for (const Filter* row : moment_rows()) {
        const Case& c = cases[turn % 3];
        Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
        move_scene(scene, c.at);
        Settings s = texel_settings(row->key, 64, 1.5);
        s.lights[0].type = c.light;
        s.lights[0].distance = c.light == LightType::Directional ? 0 : 6;
        s.lights[0].cone = 80;
        s.lights[0].azimuth = c.azimuth;
        s.map.reversed_z = c.reversed;
        s.map.format = turn % 2 ? MapFormat::D24 : MapFormat::D32F;
        move_camera(s, c.at);
        s.filter.exponent = turn % 2 ? 8 : 20;
        s.filter.negative_exponent = 4;
        s.filter.blur_shape = turn % 2 ? BlurShape::Gaussian : BlurShape::Box;
        set_all(s, {"filter.blur=2", "filter.window=4.4", "filter.moment_bias=1e-4"});
        ++turn;
        std::map<int, Shares> shares;
        int told = 0, apart = 0;
        for (int y = 30; y < 85; y += 6)
            for (int x = 40; x < 130; x += 13) {
                const Probe p = renderer.probe(scene, s, kPicture, x, y);
                if (!p.hit || p.lights[0].place != MapPlace::Inside || p.lights[0].account.receiver.n_dot_l < 1e-3)
                    continue;
                const Probe::PerLight& l = p.lights[0];
                const LightView& view = l.fitted.views[std::size_t(l.face)];
                if (!shares.contains(l.face))
                    shares.emplace(l.face, Shares(renderer.read_shadow_map(renderer.render(scene, s, kMaps), 0, l.face),
                                                  view.curve));
                const glm::dvec2 margin = glm::abs(glm::dvec2(l.account.receiver.tap) - 0.5);
                if (std::max(margin.x, margin.y) > 0.5 - 4.0 / 64) continue;
                const Moments wanted =
                    expected_moments(*row, s.filter, shares.at(l.face), glm::dvec2(l.account.receiver.tap));
                Moments read{};
                for (std::size_t k = 0; k < row->moments.names.size(); ++k) {
                    read[k] = l.kernel.moments[k];
                    // Samplers may blend by 256ths; the warp scales an error of depth.
                    ASSERT_NEAR(read[k], wanted[k], 1e-2 * std::abs(wanted[k])) << row->key << " moment " << k;
                }
                const double own = share_of(view.curve, l.compared);
                ASSERT_NEAR(l.kernel.own, own, 2e-5) << row->key;
                const double bound = bound_of(*row, s.filter, read, l.kernel.own);
                EXPECT_NEAR(l.kernel.bound, bound, 4e-3) << row->key << " at " << x << "," << y;
                const double lit = row->moments.reduces_bleeding
                                       ? std::clamp((bound - s.filter.bleed) / (1 - s.filter.bleed), 0.0, 1.0)
                                       : bound;
                EXPECT_NEAR(l.visibility, lit, 6e-3) << row->key;
                EXPECT_GE(l.kernel.lines.size(), 3u);
                ++told;
                partly += bound > 0.02 && bound < 0.98;
                apart += bound < 0.98;
            }
        EXPECT_GT(told, 15) << row->key;
        EXPECT_GT(apart, 2) << row->key << ": nothing in shadow";
    }
    EXPECT_GT(partly, 10) << "nothing between, so this proves little";
}

/// Makes a floor with an upper cover over the half where x < 0 (at `upper` m) and an optional lower cover over all of
/// the middle (`lower`).
Scene covered_floor(double upper, double lower = 0) {
    std::vector<GreyPart> parts{{"floor", make_plane(8, 8)}, {"upper", make_plane(4, 8), moved(-2, upper, 0)}};
    if (lower > 0) parts.push_back({"lower", make_plane(6, 6), moved(0, lower, 0)});
    return grey_scene(std::move(parts));
}

Settings overhead(const Filter& row) {
    return settings_with(texel_settings(row.key, 64, 0.2),
                         {"light.elevation=90", "light.azimuth=0", "camera.elevation=2", "camera.azimuth=0",
                          "camera.distance=4", "bias.constant=5e-4", "filter.bleed=0", "filter.min_variance=0",
                          "filter.moment_bias=1e-6", "filter.blur=1", "filter.window=3"});
}

/// Probes floor pixels along the edge at x = 0, each with its shares of the map's depths that the kernel averages.
template <class Visit>
void along_the_edge(const Scene& scene, const Settings& s, Visit visit) {
    Renderer& renderer = hard_renderer();
    const FrameRequest maps{.width = kPicture.width,
                            .height = kPicture.height,
                            .outputs = {.colour = false, .shadow_map = true, .visibility = true}};
    const FrameResult frame = renderer.render(scene, s, maps);
    const LightView& view = frame.lights.at(0).views.at(0);
    const Shares shares(renderer.read_shadow_map(frame, 0, 0), view.curve);
    const FloatImage visibility = renderer.read_float(frame.visibility, 1);
    const RayReference rays(scene);
    for (const auto& [x, y, hit] : pixel_hits(rays, frame.camera, kPicture.width, kPicture.height)) {
        if (hit.position.y > 1e-6) continue;
        const glm::dvec3 p = hit.position;
        if (std::abs(p.x) > 0.6 || std::abs(p.z) > 1.5) continue;
        const glm::dvec4 uvd = uvdw(view, p);
        visit(shares, glm::dvec2(uvd), share_of(view.curve, uvd.z), double(visibility.at(x, y)));
    }
}

// Between two depths each bound by spread is exact: the share of lit texels. ESM gives that share plus a rest that
// falls exponentially with the distance.
TEST(Moments, OfTwoPlanesGiveTheLitShare) {
    const Scene scene = covered_floor(1);
    for (const Filter* row : moment_rows()) {
        Settings s = overhead(*row);
        s.filter.exponent = row->key == "esm" ? 4 : 12;
        int partly = 0;
        double worst = 0;
        along_the_edge(scene, s, [&](const Shares& shares, glm::dvec2 uv, double own, double v) {
            // The lower part of the picture shows only the floor where no cover hides it.
            const auto lit = [&](double z) { return Moments{z > own - 0.02 ? 1.0 : 0.0, z}; };
            const Moments share =
                row->moments.summed ? shares.over(uv, 3, lit) : Shares::blended(uv, shares.size(), [&](int x, int y) {
                    return shares.mean(x, y, 1, false, lit);
                });
            double expected = share[0];
            if (row->key == "esm" && expected < 1) {
                const double cover = (share[1] - share[0] * own) / (1 - share[0]);  // depth of the cover
                expected += (1 - share[0]) * std::exp(2 * s.filter.exponent * (cover - own));
            }
            worst = std::max(worst, std::abs(v - expected));
            partly += expected > 0.05 && expected < 0.95;
        });
        EXPECT_LT(worst, row->moments.quantised ? 0.03 : 6e-3) << row->key;
        EXPECT_GT(partly, 50) << row->key;
    }
}

// Under two covers nothing is lit. The bound by variance allows light, by a closed form; the other bounds allow less.
TEST(Moments, BleedLightBelowTwoCoversWithinTheirBounds) {
    const Scene scene = covered_floor(3, 1);
    std::map<std::string_view, double> most;
    for (const Filter* row : moment_rows()) {
        Settings s = overhead(*row);
        s.filter.exponent = 20;
        double worst = 0;
        along_the_edge(scene, s, [&](const Shares& shares, glm::dvec2 uv, double own, double v) {
            most[row->key] = std::max(most[row->key], v);
            if (row->key != "vsm") return;
            const auto of = [](double z) { return Moments{z, z * z}; };
            const Moments m =
                Shares::blended(uv, shares.size(), [&](int x, int y) { return shares.mean(x, y, 1, false, of); });
            worst = std::max(worst, std::abs(v - cantelli(m[0], m[1], own, 0)));
        });
        EXPECT_LT(worst, 5e-3);
        const double bled = most[row->key];
        if (!row->moments.reduces_bleeding) continue;
        s.filter.bleed = bled + 0.01;
        double left = 0;
        along_the_edge(scene, s, [&](const Shares&, glm::dvec2, double, double v) { left = std::max(left, v); });
        EXPECT_EQ(left, 0) << row->key;
    }
    // Let a share p lie at depth a and the rest at b, and own at 0 behind both. The maximum over p of p (1 - p) (a -
    // b)^2 / (... + mean^2) lies at p = b / (a + b), and is (a - b)^2 / (a + b)^2: for covers 3 m and 1 m above, a
    // quarter.
    EXPECT_NEAR(most["vsm"], 0.25, 0.02);
    EXPECT_NEAR(most["savsm"], 0.25, 0.02);
    for (const char* less : {"evsm2", "evsm4", "esm"}) EXPECT_LT(most[less], 0.3 * most["vsm"]) << less;
    for (const char* less : {"msm_hamburger", "msm_hausdorff"}) EXPECT_LT(most[less], 0.5 * most["vsm"]) << less;
}

// A window of the table equals the blur of the same width: the table loses no visible digits.
TEST(Moments, FromSummedAreasEqualThoseOfABlur) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Renderer& renderer = hard_renderer();
    const FrameRequest request{
        .width = kPicture.width, .height = kPicture.height, .outputs = {.colour = false, .visibility = true}};
    for (const int radius : {1, 4})
        for (const TableSums sums : {TableSums::Integer, TableSums::Float}) {
            Settings s = texel_settings("vsm", 200, 0.5);  // not a power of two
            s.filter.blur = radius;
            const FloatImage blurred = renderer.read_float(renderer.render(scene, s, request).visibility, 1);
            s.filter.kernel = kernel_row("savsm");
            s.filter.window = 2 * radius + 1;
            s.filter.sums = sums;
            const FloatImage summed = renderer.read_float(renderer.render(scene, s, request).visibility, 1);
            double worst = 0, total = 0;
            for (std::size_t i = 0; i < summed.data.size(); ++i) {
                worst = std::max(worst, std::abs(double(summed.data[i]) - blurred.data[i]));
                total += std::abs(double(summed.data[i]) - blurred.data[i]);
            }
            EXPECT_LT(total / double(summed.data.size()), sums == TableSums::Integer ? 2e-5 : 2e-2) << radius;
            if (sums == TableSums::Integer) {
                EXPECT_LT(worst, 0.03);
            }
        }
}

SI_TEST_IS(Slow, Moments, LeaveNoAcneOnALitPlane);
// Unshadowed planes stay lit: under vertical and grazing lights of each type, far from the origin.
TEST(Moments, LeaveNoAcneOnALitPlane) {
    struct Place {
        LightType light;
        double elevation;
        glm::dvec3 at;
    };
    const Place places[] = {{LightType::Directional, 90, {0, 0, 0}},
                            {LightType::Directional, 20, {115, 0, 40}},
                            {LightType::Directional, 90, {1e5, 3, -1e5}},
                            {LightType::Spot, 90, {115, 0, 40}},
                            {LightType::Point, 60, {0, 0, 115}}};
    for (const Filter* row : moment_rows())
        for (const Place& place : places) {
            Scene scene = make_scene(make_plane(6, 6));
            move_scene(scene, place.at);
            Settings s = texel_settings(row->key, 128, row->moments.quantised ? 24 : 5);
            s.lights[0].type = place.light;
            s.lights[0].elevation = place.elevation;
            s.lights[0].azimuth = 90;
            s.lights[0].distance = place.light == LightType::Directional ? 0 : 7;
            s.lights[0].cone = 90;
            move_camera(s, place.at);
            const Shot shot = draw_shot(scene, s, 80, 45);
            const ReferenceErrors e = compare_with_reference(shot, scene, 0);
            EXPECT_GT(e.domain, 500);
            double least = 1;
            for (int y = 20; y < 44; ++y)
                for (int x = 30; x < 50; ++x) least = std::min(least, double(shot.visibility.at(x, y)));
            EXPECT_GE(least, 1 - row->tolerance.lit)
                << row->key << " light " << int(place.light) << " at " << place.elevation;
        }
}

// At the limit of each format no number overflows; above it the limit is used and reported.
TEST(Moments, StayFiniteAtAndAboveTheExponentsLimits) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    for (const Filter* row : moment_rows()) {
        if (row->moments.power == 0) continue;
        for (const MomentFormat format : {MomentFormat::Bits32, MomentFormat::Bits16}) {
            Settings s = texel_settings(row->key, 96, 2);
            s.filter.moment_format = format;
            const double limit = safe_exponent(s);
            if (format == MomentFormat::Bits16) {
                EXPECT_EQ(limit, row->moments.power == 1 ? 11.08 : 5.54);
            } else {
                // The shares that a blur takes of each texel reduce the limit.
                EXPECT_NEAR(limit, (87.33 - std::log(2 * s.filter.blur + 1)) / row->moments.power, 0.02);
            }
            s.filter.exponent = limit;
            if (reads(*row, "filter.negative_exponent")) s.filter.negative_exponent = limit;
            const Shot at_limit = draw_shot(scene, s);  // checks that all results are finite
            EXPECT_TRUE(at_limit.frame.notes.empty());
            const ReferenceErrors e = compare_with_reference(at_limit, scene, 4);
            EXPECT_LT(e.any_acne, e.domain / 20) << row->key << " " << index_of(format) << ": lit places must stay lit";
            EXPECT_LT(e.any_leak, e.domain / 3) << row->key;
            EXPECT_GT(shadow_share(at_limit), 0.01);
            s.filter.exponent = 88;
            const Shot beyond = draw_shot(scene, s);
            ASSERT_EQ(beyond.frame.notes.size(), 1u) << row->key;
            EXPECT_NE(beyond.frame.notes[0].find("filter.exponent 88"), std::string::npos) << beyond.frame.notes[0];
            EXPECT_EQ(beyond.visibility.data, at_limit.visibility.data) << "not the limit";
        }
    }
}

// 16 bits are coarser but not wrong: four moments after their transform stay close to those in 32 bits.
SI_TEST_IS(Later, Moments, In16BitsAreCloseToThoseIn32);
TEST(Moments, In16BitsAreCloseToThoseIn32) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    for (const Filter* row : moment_rows()) {
        if (!reads(*row, "filter.moment_format")) continue;
        Settings s = settings_with(
            texel_settings(row->key, 96, 6),
            {"filter.exponent=5", "filter.negative_exponent=5", "filter.min_variance=1e-4", "filter.moment_bias=1e-4"});
        const Shot wide = draw_shot(scene, s);
        s.filter.moment_format = MomentFormat::Bits16;
        const Shot narrow = draw_shot(scene, s);
        EXPECT_LT(differing_share(wide, narrow, 0.1), 0.03) << row->key;
        EXPECT_NE(wide.visibility.data, narrow.visibility.data) << row->key << ": the format changed nothing";
    }
}

// With several samples per texel, an edge covers the share of a texel's samples, at the driver's sample positions.
TEST(Moments, OfSeveralSamplesAreTheirMeans) {
    Renderer& renderer = hard_renderer();
    ASSERT_FALSE(renderer.driver().map_samples.empty());
    const int samples = renderer.driver().map_samples.front();
    ASSERT_GE(samples, 4);
    const Scene scene = covered_floor(1);
    Settings s = overhead(*moment_rows().front());
    s.filter.blur = 0;
    s.map.resolution = 61;  // puts the edge inside a texel
    s.map.samples = samples;
    const FrameResult frame = renderer.render(scene, s, kPicture);
    EXPECT_TRUE(frame.notes.empty());
    std::vector<glm::vec2> places;
    {
        gl::Target texture;
        texture.ensure("samples", GL_DEPTH_COMPONENT32F, 4, 4, 0, {.samples = samples});
        const gl::Framebuffer framebuffer = gl::make_framebuffer("samples", nullptr, &texture);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
        for (int i = 0; i < samples; ++i) {
            glm::vec2 at;
            glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(i), &at.x);
            places.push_back(at);
        }
    }
    const LightView& view = frame.lights[0].views[0];
    const auto share = [&](double y) { return share_of(view.curve, uvdw(view, {0, y, 0}).z); };
    const double floor_z = share(0), cover_z = share(1);
    // Position of the edge at x = 0 and the side of its cover, in texels.
    const glm::dvec2 edge(uvdw(view, {0, 1, 0})), covered(uvdw(view, {-1, 1, 0}));
    const int axis = std::abs(covered.x - edge.x) > std::abs(covered.y - edge.y) ? 0 : 1;
    const double at = edge[axis] * 61, fraction = at - std::floor(at);
    ASSERT_GT(std::min(fraction, 1 - fraction), 0.05) << "the edge lies between texels, so this proves little";
    const bool below = covered[axis] < edge[axis];
    int told = 0, partly = 0;
    for (int x = 40; x < 120; x += 3) {
        const Probe p = renderer.probe(scene, s, kPicture, x, 60);
        if (!p.hit || p.position_ws.y > 1e-6 || std::abs(p.position_ws.x) > 0.5) continue;
        const Probe::PerLight& l = p.lights[0];
        const Moments m = Shares::blended(glm::dvec2(l.account.receiver.tap), 61, [&](int i, int j) {
            int hidden = 0;
            for (const glm::vec2& place : places) {
                const double along = axis == 0 ? i + double(place.x) : j + double(place.y);
                hidden += below ? along < at : along > at;
            }
            const double w = double(hidden) / samples;
            partly += hidden > 0 && hidden < samples;
            return Moments{w * cover_z + (1 - w) * floor_z, w * cover_z * cover_z + (1 - w) * floor_z * floor_z};
        });
        EXPECT_NEAR(l.kernel.moments[0], m[0], 2e-3 * std::abs(floor_z - cover_z) + 1e-6);
        EXPECT_NEAR(l.kernel.moments[1], m[1], 4e-3 * std::abs(floor_z - cover_z) + 1e-6);
        ++told;
    }
    EXPECT_GT(told, 8);
    EXPECT_GT(partly, 0) << "no texel at the edge was read";
    s.map.samples = 32;  // more than any known driver offers
    const FrameResult asked = renderer.render(scene, s, kPicture);
    if (samples < 32) {
        ASSERT_EQ(asked.notes.size(), 1u);
        EXPECT_NE(asked.notes[0].find("map.samples 32"), std::string::npos);
    }
}

/// Sets a camera that looks straight down on a floor, with pixels `texels` wide in the map.
Settings from_above(const Filter& row, const Scene& scene, double texels) {
    Settings s = settings_with(overhead(row), {"map.resolution=128", "camera.elevation=90", "camera.orthographic=true",
                                               "filter.mips=true", "filter.blur=0"});
    const FrameResult frame = hard_renderer().render(scene, s, kPicture);
    s.camera.target_x += 0.13;  // no pixel is centred in a texel of a level
    s.camera.height = texels * frame.lights[0].views[0].texel_size(1, 128) * kPicture.height;
    return s;
}

// A pixel covers four texels: the look-up reads the second mip level, whose texels are means of sixteen.
TEST(Moments, OfMipLevelsAreMeansOverThePixelFootprint) {
    const Scene scene = floor_and_box(8, {3.35, 1, 2.3}, 0.4);
    Renderer& renderer = hard_renderer();
    for (const char* key : {"vsm", "evsm4"}) {
        const Filter& row = filters()[std::size_t(kernel_row(key))];
        Settings s = from_above(row, scene, 4);
        s.filter.exponent = s.filter.negative_exponent = 2;
        const FrameResult frame = renderer.render(scene, s, kMaps);
        const Shares shares(renderer.read_shadow_map(frame, 0, 0), frame.lights[0].views[0].curve);
        int told = 0, sharper = 0;
        for (int x = 70; x < 90; ++x) {
            const int y = 45;
            const Probe p = renderer.probe(scene, s, kPicture, x, y);
            if (!p.hit) continue;
            const Probe::PerLight& l = p.lights[0];
            const auto of = [&](double z) { return moments_of(key, s.filter, z); };
            const glm::dvec2 uv(l.account.receiver.tap);
            const Moments m = Shares::blended(uv, 32, [&](int i, int j) {
                Moments sum{};
                for (int k = 0; k < 16; ++k) {
                    const Moments one = of(shares.at(4 * i + k % 4, 4 * j + k / 4));
                    for (std::size_t c = 0; c < 4; ++c) sum[c] += one[c] / 16;
                }
                return sum;
            });
            const Moments fine = expected_moments(row, s.filter, shares, uv);
            for (std::size_t c = 0; c < row.moments.names.size(); ++c)
                EXPECT_NEAR(l.kernel.moments[c], m[c], 0.02 * std::abs(m[c]) + 1e-4) << key << " " << x << "," << y;
            sharper += std::abs(fine[0] - m[0]) > 0.05 * m[0];
            ++told;
        }
        EXPECT_GT(told, 10);
        EXPECT_GT(sharper, 0) << "the levels are alike, so this proves little";
    }
}

// At grazing views a pixel is long in the map: several samples along it keep detail across it.
TEST(Moments, OfMipLevelsAreSharperWithAnisotropy) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Settings s = settings_with(texel_settings("vsm", 512, 1),
                               {"camera.elevation=6", "camera.distance=14", "filter.blur=0", "filter.mips=true"});
    const Shot plain = draw_shot(scene, s);
    s.filter.anisotropy = 16;
    const double most = hard_renderer().driver().max_anisotropy;
    const Shot sharp = draw_shot(scene, s);
    EXPECT_EQ(sharp.frame.notes.size(), most < 16 ? 1u : 0u);
    ASSERT_GE(most, 2) << "this driver has no anisotropy";
    s.filter.mips = false;
    const Shot fine = draw_shot(scene, s);
    const auto off = [&](const Shot& a) {
        double sum = 0;
        for (std::size_t i = 0; i < a.visibility.data.size(); ++i)
            sum += std::abs(double(a.visibility.data[i]) - fine.visibility.data[i]);
        return sum;
    };
    EXPECT_GT(off(plain), 0);
    EXPECT_LT(off(sharp), 0.8 * off(plain)) << "nearer to what no level blurs";
}

// The map viewer shows each moment: raw as the number itself, linear as the depth with that moment.
TEST(Moments, AreShownByTheMapViewer) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Renderer& renderer = hard_renderer();
    for (const Filter* row : moment_rows()) {
        Settings s = settings_with(texel_settings(row->key, 64, 1),
                                   {"map.reversed_z=true", "filter.exponent=4", "filter.negative_exponent=3"});
        s.filter.blur = row->moments.summed ? 0 : 2;
        const FrameResult plain = renderer.render(scene, s, kSmallMaps);
        EXPECT_EQ(plain.shown_map.channel, 0);
        const Shares shares(renderer.read_shadow_map(plain, 0, 0), plain.lights[0].views[0].curve);
        for (int channel = 1; channel <= int(row->moments.names.size()); ++channel) {
            s.view.map_channel = channel;
            s.view.map = MapView::Raw;
            s.filter.blur = 2;
            const FrameResult raw = renderer.render(scene, s, kSmallMaps);
            ASSERT_EQ(raw.shown_map.channel, channel);
            EXPECT_EQ(raw.shown_map.name, row->moments.names[std::size_t(channel - 1)]);
            const FloatImage numbers = renderer.read_map_view_depth(raw);
            s.view.map = MapView::Linear;
            s.filter.blur = 0;
            const FloatImage alone = renderer.read_map_view_depth(renderer.render(scene, s, kSmallMaps));
            double sum = 0;
            for (int x = 3; x < 61; x += 3) {
                const int y = 30;
                const auto of = [&](double z) { return moments_of(row->key, s.filter, z); };
                const double number = numbers.at(x, 63 - y), z = shares.at(x, y);
                if (!row->moments.summed) {
                    const double wanted = shares.mean(x, y, 2, false, of)[std::size_t(channel - 1)];
                    EXPECT_NEAR(number, wanted, 1e-3 * std::abs(wanted) + 1e-6) << row->key << " " << channel;
                }
                // A table rounds to its steps: 32 bits hold the widest window, 34 x 34 texels.
                const double close = row->moments.summed ? 4 * 34.0 * 34.0 * 0x1p-32 : 1e-4;
                EXPECT_NEAR(alone.at(x, 63 - y), z, close) << row->key << " " << channel;
                sum += std::abs(z - shares.at(3, y));
            }
            EXPECT_GT(sum, 0.1) << "all alike, so this proves little";
        }
        s.view.map_channel = int(row->moments.names.size()) + 1;
        if (s.view.map_channel < 5) {
            EXPECT_EQ(renderer.render(scene, s, kSmallMaps).shown_map.channel, 0);
        }
    }
}

// Windows are clipped at the map's sides or lie inside; some are as wide as the map, or wider.
TEST(Moments, AreMeansOfWindowsClippedAtTheMapsSides) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Renderer& renderer = hard_renderer();
    for (const int n : {5, 16, 33})
        for (const int radius : {0, 1, 3, 8}) {
            Settings s = texel_settings("vsm", n, 2.0 * n / 16);
            s.filter.moment_format = MomentFormat::Bits32;
            s.filter.blur = 0;
            const FrameResult plain = renderer.render(scene, s, kSmallMaps);
            const Shares shares(renderer.read_shadow_map(plain, 0, 0), plain.lights[0].views[0].curve);
            s.view.map_channel = 1;
            s.view.map = MapView::Raw;
            s.filter.blur = radius;
            const FloatImage numbers = renderer.read_map_view_depth(renderer.render(scene, s, kSmallMaps));
            ASSERT_EQ(numbers.width, n);
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const int across = std::min({radius, x, n - 1 - x}), along = std::min({radius, y, n - 1 - y});
                    double sum = 0;
                    for (int v = y - along; v <= y + along; ++v)
                        for (int u = x - across; u <= x + across; ++u) sum += shares.at(u, v);
                    ASSERT_NEAR(numbers.at(x, n - 1 - y), sum / ((2 * across + 1) * (2 * along + 1)), 1e-6)
                        << x << "," << y << " of " << n << ", radius " << radius;
                }
        }
}

// Each texel of a mip level holds the mean of the four texels below it, in the stored number.
SI_TEST_IS(Later, Moments, AreShownByMipLevel);
TEST(Moments, AreShownByMipLevel) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Renderer& renderer = hard_renderer();
    for (const Filter* row : moment_rows()) {
        Settings s = settings_with(texel_settings(row->key, 64, 1), {"filter.mips=true", "filter.moment_format=32-bit",
                                                                     "view.map=raw", "view.map_channel=moment-1"});
        FloatImage finer;
        for (const int level : {0, 1, 2, 3, 6}) {
            s.view.map_mip = level;
            const FrameResult frame = renderer.render(scene, s, kSmallMaps);
            const FloatImage numbers = renderer.read_map_view_depth(frame);
            EXPECT_EQ(frame.map_view_size, glm::ivec2(64)) << "the picture has the map's place";
            EXPECT_EQ(frame.shown_map.texels, glm::ivec2(numbers.width, numbers.height));
            if (row->moments.summed) {
                EXPECT_EQ(frame.shown_map.mip, 0);
                EXPECT_EQ(numbers.width, 64);
                continue;
            }
            ASSERT_EQ(frame.shown_map.mip, level);
            ASSERT_EQ(numbers.width, 64 >> level) << row->key;
            if (level > 0 && level < 6) {
                double most = 0, least = 1e30;
                for (int y = 0; y < numbers.height; ++y)
                    for (int x = 0; x < numbers.width; ++x) {
                        const double mean = 0.25 * (double(finer.at(2 * x, 2 * y)) + finer.at(2 * x + 1, 2 * y) +
                                                    finer.at(2 * x, 2 * y + 1) + finer.at(2 * x + 1, 2 * y + 1));
                        ASSERT_NEAR(numbers.at(x, y), mean, 1e-5 * std::abs(mean)) << row->key << " level " << level;
                        most = std::max(most, mean);
                        least = std::min(least, mean);
                    }
                EXPECT_GT(most, least * 1.05) << "all alike, so this proves little";
            }
            finer = numbers;
        }
        if (row->moments.summed) continue;
        s.view.map_mip = 15;
        const FrameResult coarsest = renderer.render(scene, s, kSmallMaps);
        EXPECT_EQ(coarsest.shown_map.mip, 6) << "past the coarsest";
        s.filter.mips = false;
        EXPECT_EQ(renderer.render(scene, s, kSmallMaps).shown_map.mip, 0);
        EXPECT_EQ(idle_reason(s, *find_setting("view.map_mip")), "without effect: filter.mips is off");
    }
}

// All prepared textures stay cached while only the camera moves.
TEST(Moments, AreCachedWhileOnlyTheCameraMoves) {
    const Scene scene = floor_and_box(8, {1.5, 1, 2}, 0.4);
    Renderer& renderer = hard_renderer();
    for (const Filter* row : moment_rows()) {
        Settings s = settings_with(texel_settings(row->key, 64, 2), {"map.samples=4", "filter.mips=true"});
        const FrameResult first = renderer.render(scene, s, kPicture);
        EXPECT_EQ(first.pass("moments")->state, PassState::Drawn) << row->key;
        EXPECT_EQ(first.pass("moments")->category, PassCategory::Maps);
        s.camera.azimuth += 10;
        EXPECT_EQ(renderer.render(scene, s, kPicture).pass("moments")->state, PassState::Cached) << row->key;
        set_all(s, {"filter.bleed=0.1", "filter.moment_bias=1e-5"});
        EXPECT_EQ(renderer.render(scene, s, kPicture).pass("moments")->state, PassState::Cached) << row->key;
        s.lights[0].azimuth += 10;
        EXPECT_EQ(renderer.render(scene, s, kPicture).pass("moments")->state, PassState::Drawn) << row->key;
    }
}

}  // namespace
}  // namespace si::test
