#include "renderer/reference/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/reference/distance_transform.h"

namespace si {
namespace {

/// Pixels on either side of a step between lit and dark on one surface.
template <typename Dark>
std::vector<std::uint8_t> contour(const Truth& truth, const std::vector<std::uint8_t>& joins, Dark&& dark) {
    const auto w = std::size_t(truth.width), h = std::size_t(truth.height);
    std::vector<std::uint8_t> out(w * h, 0);
    const auto counts = [&](std::size_t i) { return truth.state[i] == PixelState::Counted; };
    const auto step = [&](std::size_t i, std::size_t k, std::uint8_t bit) {
        if (!counts(i) || !counts(k) || (!joins.empty() && !(joins[i] & bit))) return;
        if (dark(i) != dark(k)) out[i] = out[k] = 1;
    };
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            if (x + 1 < w) step(y * w + x, y * w + x + 1, 1);
            if (y + 1 < h) step(y * w + x, (y + 1) * w + x, 2);
        }
    return out;
}

/// @param step pixels of the picture per pixel of a and b
void contour_distances(ErrorMetrics& m, const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                       int width, int height, int step) {
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

std::uint32_t compared_bits(float v, const TruePixel& truth, bool outside) {
    using J = JudgedPixel;
    const bool sides = (v < 0.5f) != (truth.visibility < 0.5), wrong = is_wrong(v, truth);
    const bool faint = truth.visibility == 1 && v >= 0.5f && v < float(1 - kRightVisibility);
    std::uint32_t bits = J::kCounts;
    if (wrong) bits |= v < 0.5f ? J::kFalseShadow : J::kFalseLight;
    if (sides && !wrong) bits |= J::kWithinNoise;
    if (faint) bits |= J::kFaint;
    if (outside) bits |= J::kOutside;
    return bits;
}

TruePixel true_pixel(const Truth& truth, std::size_t i) {
    TruePixel p{.visibility = truth.visibility.data[i], .noise = 0, .hard_lit = truth.hard().data[i] >= 0.5f};
    if (truth.is_area()) p.noise = truth.standard_error.data[i];
    // One look at a light tells nothing of how others would turn out: its error is at most that of a tossed coin.
    if (std::isnan(p.noise)) p.noise = 0.5;
    return p;
}

std::vector<JudgedPixel> judged_pixels(const FloatImage& judged) {
    static_assert(
        kArtefacts <= 1 << shared::ARTEFACT_BITS && shared::ARTEFACT_BITS + shared::ALSO_SHIFT + kArtefacts - 1 <= 24,
        "a judgement has to fit into the digits of a float; the last artefact is never in Cause::also");
    std::vector<JudgedPixel> out(judged.data.size() / 2);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto code = std::uint32_t(judged.data[2 * i]);
        out[i] = {Artefact(code & ((1u << shared::ARTEFACT_BITS) - 1)), code >> shared::ARTEFACT_BITS,
                  judged.data[2 * i + 1]};
    }
    return out;
}

std::vector<std::uint8_t> joins_of(const Receivers& receivers) {
    std::vector<std::uint8_t> out(receivers.pixels.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = std::uint8_t(receivers.pixels[i].joins_right | receivers.pixels[i].joins_below << 1);
    return out;
}

ErrorMetrics error_metrics(const std::vector<JudgedPixel>& judged, const Truth& truth,
                           const std::vector<std::uint8_t>& joins) {
    if (judged.size() != truth.state.size())
        throw Error(fmt::format("{} judged pixels cannot be compared with a truth of {} x {}", judged.size(),
                                truth.width, truth.height));
    using J = JudgedPixel;
    ErrorMetrics m;
    m.pixels = truth.pixels;
    m.counted = truth.counted();
    double absolute = 0, squares = 0, sum = 0;
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < truth.state.size(); ++i) {
        if (truth.state[i] != PixelState::Counted) continue;
        const J& p = judged[i];
        const double r = truth.visibility.data[i], difference = p.visibility - r;
        absolute += std::abs(difference), squares += difference * difference, sum += difference;
        both += p.visibility < 0.5f && r < 0.5, either += p.visibility < 0.5f || r < 0.5;
        const bool fs = p.has(J::kFalseShadow);
        m.false_shadow += fs, m.false_light += p.has(J::kFalseLight);
        m.outside_map += p.has(J::kOutside);
        m.any_acne += p.has(J::kAnyAcne);
        m.within_noise += p.has(J::kWithinNoise);
        ++m.artefacts[std::size_t(p.artefact)];
        switch (p.artefact) {
            case Artefact::None:
                break;
            case Artefact::Acne:
                ++m.acne;
                break;
            case Artefact::Leak:
                ++m.leak;
                break;
            case Artefact::PeterPanning:
            case Artefact::PeterPanningOffset:
                ++m.bias_false_light;
                break;
            case Artefact::LostCaster:
                ++m.lost_false_light;
                break;
            case Artefact::OffsetShadow:
                ++m.offset_false_shadow;
                break;
            case Artefact::OutsideMap:
                ++(fs ? m.outside_false_shadow : m.outside_false_light);
                break;
            case Artefact::EdgeAliasing:
            case Artefact::Filter:
            case Artefact::Undersampled:
            case Artefact::Penumbra:
            case Artefact::NoMap:
                ++(fs ? m.boundary_false_shadow : m.boundary_false_light);
                break;
        }
    }
    m.artefacts[0] += truth.state.size() - m.counted;
    if (m.counted > 0) {
        const double n = double(m.counted);
        for (double* fraction :
             {&m.false_shadow, &m.false_light, &m.acne, &m.leak, &m.bias_false_light, &m.lost_false_light,
              &m.offset_false_shadow, &m.boundary_false_shadow, &m.boundary_false_light, &m.outside_false_shadow,
              &m.outside_false_light, &m.any_acne, &m.within_noise, &m.outside_map})
            *fraction /= n;
        m.mae = absolute / n, m.rmse = std::sqrt(squares / n), m.signed_mean = sum / n;
    }
    if (either > 0) m.iou = double(both) / double(either);
    const auto drawn = contour(truth, joins, [&](std::size_t i) { return judged[i].visibility < 0.5f; });
    const auto real = contour(truth, joins, [&](std::size_t i) { return truth.visibility.data[i] < 0.5f; });
    contour_distances(m, drawn, real, truth.width, truth.height, truth.step);
    return m;
}

}  // namespace si
