// LDR-FLIP. Numbers of sections and equations are those of Andersson et al., HPG 2020. All filters are separable, and
// pictures are computed in bands of rows, so that memory stays small.
#include "renderer/reference/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "shaders/shared/colours.h"

namespace si {
namespace {

// Exponents and thresholds of the paper's section 4: q_c, p_c, p_t, q_f and the width w of a feature in degrees.
constexpr double kColourExponent = 0.7, kKneeDifference = 0.4, kKneeError = 0.95, kFeatureExponent = 0.5,
                 kFeatureWidthDegrees = 0.082;

/// Gaussian of a contrast sensitivity function: a √(π/b) exp(-π² r² / b), r in degrees.
struct SensitivityGaussian {
    double a, b;
};
// Contrast sensitivity of the channels Y, Cx, Cz (table 1). The second Gaussian of the first two channels is 0.
constexpr SensitivityGaussian kLuminance{1, 0.0047}, kRedGreen{1, 0.0053}, kBlueYellow[]{{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = 0.04;  ///< largest b, which decides the radius of all filters

// Linear sRGB to XYZ by rows, and the white D65, both from the chromaticities of IEC 61966-2-1.
constexpr double kXyzFromRgb[3][3] = {{0.4123907993, 0.3575843394, 0.1804807884},
                                      {0.2126390059, 0.7151686788, 0.0721923154},
                                      {0.0193308187, 0.1191947798, 0.9505321522}};
constexpr double kWhite[3] = {0.9504559271, 1, 1.0890577508};

using ColourTriple = std::array<double, 3>;

/// One-dimensional filter with weights from -radius to +radius.
struct Taps {
    std::vector<double> weights;
    int radius() const { return int(weights.size()) / 2; }
};

/// Image of doubles, by rows.
struct Plane {
    int width, height;
    std::vector<double> data;
    Plane(int w, int h) : width(w), height(h), data(std::size_t(w) * std::size_t(h)) {}
    double* row(int y) { return &data[std::size_t(y) * std::size_t(width)]; }
    const double* row(int y) const { return &data[std::size_t(y) * std::size_t(width)]; }
};

ColourTriple xyz_from_rgb(const ColourTriple& rgb) {
    ColourTriple out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) out[i] += kXyzFromRgb[i][k] * rgb[k];
    return out;
}

/// Returns the inverse of kXyzFromRgb, by rows.
std::array<ColourTriple, 3> rgb_from_xyz_matrix() {
    const auto& m = kXyzFromRgb;
    std::array<ColourTriple, 3> inverse;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            inverse[k][i] = m[i1][k1] * m[i2][k2] - m[i1][k2] * m[i2][k1];
        }
    const double determinant = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
    for (ColourTriple& row : inverse)
        for (double& v : row) v /= determinant;
    return inverse;
}

/// Converts XYZ to the opponent space YCxCz, a linear form of CIELAB.
ColourTriple opponent_from_xyz(const ColourTriple& xyz) {
    const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Converts YCxCz to linear sRGB within the gamut.
ColourTriple rgb_from_opponent(const ColourTriple& c) {
    static const std::array<ColourTriple, 3> kMatrix = rgb_from_xyz_matrix();
    const double y = (c[0] + 16) / 116;
    const ColourTriple xyz{(y + c[1] / 500) * kWhite[0], y * kWhite[1], (y - c[2] / 200) * kWhite[2]};
    ColourTriple out;
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = std::clamp(kMatrix[i][0] * xyz[0] + kMatrix[i][1] * xyz[1] + kMatrix[i][2] * xyz[2], 0.0, 1.0);
    return out;
}

/// Converts linear sRGB to CIELAB whose chroma shrinks with lightness as Hunt found (equation 4).
ColourTriple hunt_lab(const ColourTriple& rgb) {
    constexpr double kDelta = 6.0 / 29;
    const auto curve = [](double t) {
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
    };
    const ColourTriple xyz = xyz_from_rgb(rgb);
    const double x = curve(xyz[0] / kWhite[0]), y = curve(xyz[1] / kWhite[1]), z = curve(xyz[2] / kWhite[2]);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// Returns the HyAB distance of two colours (Abasi et al. 2020): lightness and chroma apart.
double hyab(const ColourTriple& a, const ColourTriple& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Returns the colour difference, 0 to 1, of two colours at `distance`: large distances are compressed (equation 7).
double colour_difference(double distance) {
    static const double kLargest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColourExponent);
    const double power = std::pow(distance, kColourExponent), knee = kKneeDifference * kLargest;
    if (power < knee) return kKneeError / knee * power;
    return kKneeError + (power - knee) / (kLargest - knee) * (1 - kKneeError);
}

/// Makes taps from a function of the distance from the centre in pixels, without scale.
template <typename Function>
Taps sampled_taps(int radius, Function&& value) {
    Taps out;
    for (int i = -radius; i <= radius; ++i) out.weights.push_back(value(double(i)));
    return out;
}

/// Scales weights so that the positive sum to 1 and the negative to -1.
void normalise(Taps& taps) {
    double positive = 0, negative = 0;
    for (const double w : taps.weights) (w > 0 ? positive : negative) += w;
    for (double& w : taps.weights) w /= w > 0 ? positive : std::max(-negative, 1e-300);
}

/// Filters of all channels for one number of pixels per degree.
struct Filters {
    Taps luminance, red_green;
    Taps blue_yellow[2];          ///< the second is added with its weight
    double blue_yellow_share[2];  ///< shares of both Gaussians; their sum is 1
    Taps blur, slope, curvature;  ///< Gaussian of the features, its first and second derivative (section 4.2)
    int radius = 0;               ///< largest of all

    explicit Filters(double pixels_per_degree) {
        const int reach =
            int(std::ceil(3 * std::sqrt(kWidest / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
        const auto gaussian = [&](const SensitivityGaussian& g) {
            const double scale = std::numbers::pi * std::numbers::pi / (g.b * pixels_per_degree * pixels_per_degree);
            return sampled_taps(reach, [&](double x) { return std::exp(-scale * x * x); });
        };
        luminance = gaussian(kLuminance);
        red_green = gaussian(kRedGreen);
        double total = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            const SensitivityGaussian& g = kBlueYellow[i];
            blue_yellow[i] = gaussian(g);
            double sum = 0;
            for (const double w : blue_yellow[i].weights) sum += w;
            total += blue_yellow_share[i] = g.a * std::sqrt(std::numbers::pi / g.b) * sum * sum;
        }
        for (double& share : blue_yellow_share) share /= total;
        const double deviation = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
        const int feature = int(std::ceil(3 * deviation));
        const auto bell = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
        blur = sampled_taps(feature, bell);
        slope = sampled_taps(feature, [&](double x) { return -x * bell(x); });
        curvature = sampled_taps(feature, [&](double x) { return (x * x / (deviation * deviation) - 1) * bell(x); });
        for (Taps* taps : {&luminance, &red_green, &blue_yellow[0], &blue_yellow[1], &blur, &slope, &curvature})
            normalise(*taps);
        radius = std::max(reach, feature);
    }
};

/// Drops outer weights below a ten-billionth of the largest from both ends; they change no digit that is shown.
std::span<const double> effective_weights(const Taps& taps, int& radius) {
    double largest = 0;
    for (const double w : taps.weights) largest = std::max(largest, std::abs(w));
    radius = taps.radius();
    while (radius > 1 && std::abs(taps.weights[std::size_t(taps.radius() - radius)]) < 1e-10 * largest) --radius;
    return std::span(taps.weights).subspan(std::size_t(taps.radius() - radius), std::size_t(2 * radius + 1));
}

/// Filters along rows. @param margin columns on each side of the input that the output lacks
Plane filtered_rows(const Plane& in, const Taps& taps, int margin) {
    Plane out(in.width - 2 * margin, in.height);
    int radius = 0;
    const std::span<const double> weights = effective_weights(taps, radius);
    for (int y = 0; y < in.height; ++y) {
        double* to = out.row(y);
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const double* from = in.row(y) + margin - radius + int(k);
            for (int x = 0; x < out.width; ++x) to[x] += weights[k] * from[x];
        }
    }
    return out;
}

/// Filters along columns. @param margin rows above and below the output that the input has
Plane filtered_columns(const Plane& in, const Taps& taps, int margin) {
    Plane out(in.width, in.height - 2 * margin);
    int radius = 0;
    const std::span<const double> weights = effective_weights(taps, radius);
    for (int y = 0; y < out.height; ++y) {
        double* to = out.row(y);
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const double* from = in.row(y + margin - radius + int(k));
            for (int x = 0; x < out.width; ++x) to[x] += weights[k] * from[x];
        }
    }
    return out;
}

Plane filtered(const Plane& in, const Taps& across, const Taps& down, int margin) {
    return filtered_columns(filtered_rows(in, across, margin), down, margin);
}

/// Rows of one picture: colours as a person sees them, and strengths of edges and points.
struct SeenRows {
    Plane y, cx, cz;    ///< filtered YCxCz
    Plane edge, point;  ///< lengths of the gradients
};

Plane gradient_length(const Plane& a, const Plane& b) {
    Plane out(a.width, a.height);
    for (std::size_t i = 0; i < out.data.size(); ++i)
        out.data[i] = std::sqrt(a.data[i] * a.data[i] + b.data[i] * b.data[i]);
    return out;
}

/// Returns linear intensities of all 8-bit sRGB values (IEC 61966-2-1).
const std::array<double, 256>& linear_intensities() {
    static const std::array<double, 256> kTable = [] {
        std::array<double, 256> table;
        for (std::size_t i = 0; i < table.size(); ++i) {
            const double v = double(i) / 255;
            table[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        return table;
    }();
    return kTable;
}

/// Filters rows [first, end) of a picture. Pixels beyond its sides repeat those at the side.
SeenRows seen_rows(const ByteImage& picture, const Filters& filters, int first, int end) {
    const int margin = filters.radius;
    Plane y(picture.width + 2 * margin, end - first + 2 * margin), cx = y, cz = y, achromatic = y;
    const std::array<double, 256>& linear = linear_intensities();
    for (int row = 0; row < y.height; ++row) {
        const int from = std::clamp(first - margin + row, 0, picture.height - 1);
        for (int column = 0; column < y.width; ++column) {
            const int at = std::clamp(column - margin, 0, picture.width - 1);
            const std::uint8_t* p =
                &picture.data[(std::size_t(from) * std::size_t(picture.width) + std::size_t(at)) * 4];
            const ColourTriple c = opponent_from_xyz(xyz_from_rgb({linear[p[0]], linear[p[1]], linear[p[2]]}));
            y.row(row)[column] = c[0];
            cx.row(row)[column] = c[1];
            cz.row(row)[column] = c[2];
            achromatic.row(row)[column] = (c[0] + 16) / 116;
        }
    }
    Plane blue_yellow = filtered(cz, filters.blue_yellow[0], filters.blue_yellow[0], margin);
    const Plane second = filtered(cz, filters.blue_yellow[1], filters.blue_yellow[1], margin);
    for (std::size_t i = 0; i < blue_yellow.data.size(); ++i)
        blue_yellow.data[i] =
            filters.blue_yellow_share[0] * blue_yellow.data[i] + filters.blue_yellow_share[1] * second.data[i];
    const Plane blurred = filtered_rows(achromatic, filters.blur, margin);
    return {filtered(y, filters.luminance, filters.luminance, margin),
            filtered(cx, filters.red_green, filters.red_green, margin), std::move(blue_yellow),
            gradient_length(filtered(achromatic, filters.slope, filters.blur, margin),
                            filtered_columns(blurred, filters.slope, margin)),
            gradient_length(filtered(achromatic, filters.curvature, filters.blur, margin),
                            filtered_columns(blurred, filters.curvature, margin))};
}

/// Returns the difference of one pixel (equation 10): the larger that of features, the more that of colours counts.
double pixel_difference(const SeenRows& a, const SeenRows& b, std::size_t i) {
    const ColourTriple of_a{a.y.data[i], a.cx.data[i], a.cz.data[i]}, of_b{b.y.data[i], b.cx.data[i], b.cz.data[i]};
    if (of_a == of_b) return 0;
    const double colour = colour_difference(hyab(hunt_lab(rgb_from_opponent(of_a)), hunt_lab(rgb_from_opponent(of_b))));
    const double edge = std::abs(a.edge.data[i] - b.edge.data[i]), point = std::abs(a.point.data[i] - b.point.data[i]);
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
    return std::pow(colour, 1 - feature);
}

}  // namespace

Flip flip_difference(const ByteImage& a, const ByteImage& b, double pixels_per_degree, const Workers& workers) {
    if (a.width != b.width || a.height != b.height)
        throw Error(fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared; draw them in one size",
                                a.width, a.height, b.width, b.height));
    const Filters filters(std::clamp(pixels_per_degree, kMinPixelsPerDegree, kMaxPixelsPerDegree));
    // Rows of a band are a multiple of the margin that neighbours filter again.
    const int band = std::max(32, 2 * filters.radius), bands = (a.height + band - 1) / band;
    const std::size_t pixels = std::size_t(a.width) * std::size_t(a.height);
    Flip out{.map = {a.width, a.height, 1, std::vector<float>(pixels)}};
    std::vector<double> sums(std::size_t(bands), 0), largest(std::size_t(bands), 0);
    parallel_for_blocks(std::size_t(bands), workers, [&](std::size_t number) {
        const int first = int(number) * band, end = std::min(first + band, a.height);
        const std::size_t offset = std::size_t(first) * std::size_t(a.width);
        const std::size_t count = std::size_t(end - first) * std::size_t(a.width);
        const SeenRows of_a = seen_rows(a, filters, first, end), of_b = seen_rows(b, filters, first, end);
        for (std::size_t i = 0; i < count; ++i) {
            const double difference = pixel_difference(of_a, of_b, i);
            out.map.data[offset + i] = float(difference);
            sums[number] += difference;
            largest[number] = std::max(largest[number], difference);
        }
    });
    for (const double sum : sums) out.mean += sum;
    if (pixels > 0) out.mean /= double(pixels);
    for (const double one : largest) out.max = std::max(out.max, one);
    return out;
}

ByteImage flip_picture(const FloatImage& map) {
    ByteImage out{map.width, map.height, std::vector<std::uint8_t>(map.data.size() * 4, 255)};
    for (std::size_t i = 0; i < map.data.size(); ++i) {
        const float t = 2 * std::clamp(map.data[i], 0.f, 1.f);
        const glm::vec3 colour = t < 1 ? glm::mix(shared::SEQUENTIAL_LOW, shared::SEQUENTIAL_MIDDLE, t)
                                       : glm::mix(shared::SEQUENTIAL_MIDDLE, shared::SEQUENTIAL_HIGH, t - 1);
        for (int c = 0; c < 3; ++c) out.data[4 * i + std::size_t(c)] = std::uint8_t(std::lround(255 * colour[c]));
    }
    return out;
}

}  // namespace si
