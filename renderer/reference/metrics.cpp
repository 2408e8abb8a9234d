#include "renderer/reference/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/reference/distance_transform.h"

namespace si {
namespace {

template <typename T>
T at(const std::vector<T>& values, std::size_t i, T otherwise) {
    return values.empty() ? otherwise : values[i];
}

/// One pixel's two visibilities and what follows from them.
struct Pixel {
    double v = 1, r = 1;
    bool outside = false, near_edge = false;
    bool false_shadow() const { return r >= 0.5 && v < 0.5; }
    bool false_light() const { return r < 0.5 && v >= 0.5; }
};

Artefact artefact_of(const Pixel& p, double nearest_m, double bias_m) {
    if (p.outside) return Artefact::OutsideMap;
    if (!p.false_shadow() && !p.false_light()) return Artefact::None;
    if (p.near_edge) return Artefact::EdgeAliasing;
    if (p.false_shadow()) return Artefact::Acne;
    if (std::isnan(nearest_m)) return Artefact::LostCaster;
    return bias_m >= nearest_m ? Artefact::PeterPanning : Artefact::Leak;
}

/// Pixels on either side of a step between lit and dark on one surface.
std::vector<std::uint8_t> contour(const FloatImage& visibility, const Truth& truth, const PixelFacts& facts) {
    const auto w = std::size_t(truth.width), h = std::size_t(truth.height);
    std::vector<std::uint8_t> out(w * h, 0);
    const auto counts = [&](std::size_t i) { return truth.state[i] == PixelState::Counted; };
    const auto step = [&](std::size_t i, std::size_t k, std::uint8_t bit) {
        if (!counts(i) || !counts(k) || !(at<std::uint8_t>(facts.joins, i, 3) & bit)) return;
        if ((visibility.data[i] < 0.5f) != (visibility.data[k] < 0.5f)) out[i] = out[k] = 1;
    };
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            if (x + 1 < w) step(y * w + x, y * w + x + 1, 1);
            if (y + 1 < h) step(y * w + x, (y + 1) * w + x, 2);
        }
    return out;
}

/// @param step pixels of the picture per pixel of a and b
void contour_distances(ErrorMetrics& m, const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, int width,
                       int height, int step) {
    const auto any = [](const std::vector<std::uint8_t>& s) { return std::find(s.begin(), s.end(), 1) != s.end(); };
    const bool has_a = any(a), has_b = any(b);
    if (!has_a && !has_b) return;
    if (has_a != has_b) {
        m.boundary_px_mean = m.boundary_px_p95 = m.boundary_px_max = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    std::vector<float> distances;
    const std::vector<float> to_a = distance_to(a, width, height), to_b = distance_to(b, width, height);
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i]) distances.push_back(to_b[i]);
        if (b[i]) distances.push_back(to_a[i]);
    }
    double sum = 0;
    for (float& d : distances) sum += d *= float(step);
    m.boundary_px_mean = sum / double(distances.size());
    const auto rank = std::ptrdiff_t(std::ceil(0.95 * double(distances.size()))) - 1;
    std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
    m.boundary_px_p95 = distances[std::size_t(rank)];
    m.boundary_px_max = *std::max_element(distances.begin() + rank, distances.end());
}

}  // namespace

ErrorMetrics error_metrics(const FloatImage& measured, const Truth& truth, const PixelFacts& facts,
                           std::vector<Artefact>* artefacts) {
    if (measured.width != truth.width || measured.height != truth.height || measured.channels != 1)
        throw Error(fmt::format("visibility of {} x {} pixels cannot be compared with a truth of {} x {}", measured.width,
                                measured.height, truth.width, truth.height));
    ErrorMetrics m;
    m.pixels = truth.pixels;
    m.counted = truth.counted();
    if (artefacts) artefacts->assign(truth.state.size(), Artefact::None);
    double absolute = 0, squares = 0, sum = 0;
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < truth.state.size(); ++i) {
        if (truth.state[i] != PixelState::Counted) continue;
        const float edge = at(facts.edge_texels, i, std::numeric_limits<float>::infinity());
        Pixel p{measured.data[i], truth.visibility.data[i], at<std::uint8_t>(facts.outside_map, i, 0) != 0, false};
        if (std::isnan(p.v)) p.v = 0;  // no light is drawn from it
        p.near_edge = std::isfinite(edge) || (p.r > 0 && p.r < 1);
        const double difference = p.v - p.r;
        absolute += std::abs(difference), squares += difference * difference, sum += difference;
        both += p.v < 0.5 && p.r < 0.5, either += p.v < 0.5 || p.r < 0.5;
        const bool fs = p.false_shadow(), fl = p.false_light();
        m.false_shadow += fs, m.false_light += fl;
        m.outside_map += p.outside;
        (p.outside ? m.outside_false_shadow : p.near_edge ? m.boundary_false_shadow : m.acne) += fs;
        (p.outside ? m.outside_false_light : p.near_edge ? m.boundary_false_light : m.leak) += fl;
        m.any_acne += p.r == 1 && !p.outside && !p.near_edge && p.v < 1 - kRightVisibility;
        const Artefact a = artefact_of(p, truth.nearest_m.data[i], at(facts.bias_m, i, 0.f));
        ++m.artefacts[std::size_t(a)];
        if (artefacts) (*artefacts)[i] = a;
    }
    m.artefacts[0] += truth.state.size() - m.counted;
    if (m.counted > 0) {
        const double n = double(m.counted);
        for (double* fraction : {&m.false_shadow, &m.false_light, &m.acne, &m.leak, &m.boundary_false_shadow,
                                 &m.boundary_false_light, &m.outside_false_shadow, &m.outside_false_light, &m.any_acne,
                                 &m.outside_map})
            *fraction /= n;
        m.mae = absolute / n, m.rmse = std::sqrt(squares / n), m.signed_mean = sum / n;
    }
    if (either > 0) m.iou = double(both) / double(either);
    contour_distances(m, contour(measured, truth, facts), contour(truth.visibility, truth, facts), truth.width,
                      truth.height, truth.step);
    return m;
}

}  // namespace si
