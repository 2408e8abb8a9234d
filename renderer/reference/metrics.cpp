#include "renderer/reference/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "renderer/base/index_of.h"
#include "renderer/reference/distance_transform.h"

namespace si {
namespace {

/// Calls `use` with the index of each byte that differs between two arrays of `count` bytes, of which few do.
template <typename Use>
void each_differing_byte(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, Use&& use) {
    constexpr std::size_t kBlock = 16;
    for (std::size_t i = 0; i < count;) {
        if (i + kBlock <= count && std::memcmp(a + i, b + i, kBlock) == 0) {
            i += kBlock;
            continue;
        }
        if (a[i] != b[i]) use(i);
        ++i;
    }
}

/// Returns the pixels on either side of a change between lit and dark on one surface.
/// @param visibility_of returns the visibility of a pixel by its index
template <typename VisibilityOf>
std::vector<std::uint8_t> contour(const Reference& reference, const Receivers* receivers,
                                  VisibilityOf&& visibility_of) {
    const auto w = std::size_t(reference.width), h = std::size_t(reference.height);
    std::vector<std::uint8_t> out(w * h, 0), dark(w * h);
    if (out.empty()) return out;
    for (std::size_t i = 0; i < dark.size(); ++i) dark[i] = visibility_of(i) < 0.5f;
    const auto counts = [&](std::size_t i) { return reference.state[i] == PixelState::Counted; };
    const auto mark = [&](std::size_t i, std::size_t k, bool Receiver::*same_surface) {
        if (!counts(i) || !counts(k)) return;
        if (!receivers || receivers->pixels[i].*same_surface) out[i] = out[k] = 1;
    };
    each_differing_byte(dark.data(), dark.data() + 1, w * h - 1, [&](std::size_t i) {
        const bool ends_row = (i + 1) % w == 0;
        if (!ends_row) mark(i, i + 1, &Receiver::same_surface_right);
    });
    each_differing_byte(dark.data(), dark.data() + w, w * (h - 1),
                        [&](std::size_t i) { mark(i, i + w, &Receiver::same_surface_below); });
    return out;
}

/// Computes the distances between two sets of contour pixels: ErrorMetrics::boundary_px_*.
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
    const NearestSetPixel in_a(a, width, height), in_b(b, width, height);
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i]) distances.push_back(in_b.distance(i));
        if (b[i]) distances.push_back(in_a.distance(i));
    }
    double sum = 0;
    for (float& d : distances) sum += d *= float(step);
    m.boundary_px_mean = sum / double(distances.size());
    const auto rank = std::ptrdiff_t(std::ceil(0.95 * double(distances.size()))) - 1;
    std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
    m.boundary_px_p95 = distances[std::size_t(rank)];
    m.boundary_px_max = *std::max_element(distances.begin() + rank, distances.end());
}

using M = ErrorMetrics;
using Counts = Metric::Counts;

constexpr std::uint32_t causes(std::initializer_list<Artefact> list) {
    std::uint32_t bits = 0;
    for (const Artefact a : list) bits |= 1u << int(a);
    return bits;
}
// Causes that no change of bias or offset makes right.
constexpr std::uint32_t kAtEdges =
    causes({Artefact::EdgeAliasing, Artefact::Undersampled, Artefact::Penumbra, Artefact::Filter, Artefact::NoMap});

constexpr std::string_view kHausdorff =
    "Huttenlocher, Klanderman and Rucklidge, Comparing Images Using the Hausdorff Distance, 1993";

constexpr auto kMetrics = std::to_array<Metric>({
    {.key = "mae",
     .label = "Mean error",
     .unit = kOfVisibility,
     .help = "Mean of |V - R| over the counted pixels.",
     .formula = "sum |V - R| / n",
     .member = &M::mae},
    {.key = "rmse",
     .label = "RMS error",
     .unit = kOfVisibility,
     .help = "Root of the mean of (V - R)^2: large errors count more.",
     .formula = "sqrt(sum (V - R)^2 / n)",
     .member = &M::rmse},
    {.key = "signed_mean",
     .label = "Mean signed error (+ too light)",
     .unit = kOfVisibility,
     .help = "Mean of V - R: negative is too dark.",
     .formula = "sum (V - R) / n",
     .member = &M::signed_mean,
     .better = Better::NearZero},
    {.key = "flip",
     .label = "FLIP",
     .unit = "",
     .help = "Difference to the picture with the reference's shadows, as a person sees it who alternates between both: "
             "0 none, 1 the largest. The live error has it while the overlay `flip-difference` is shown.",
     .formula = "mean of LDR-FLIP over all pixels, at 67 pixels per degree, without overlays and smoothing",
     .paper = "Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, FLIP: A Difference Evaluator for "
              "Alternating Images, HPG 2020",
     .member = &M::flip,
     .of_pictures = true},
    {.key = "false_shadow",
     .label = "False shadow",
     .help = "Lit in the reference, dark in the picture: the sum of its causes.",
     .formula = "#{R >= 1/2 and V < 1/2, wrong} / n",
     .member = &M::false_shadow,
     .counts = Counts::Dark,
     .causes = kAllCauses},
    {.key = "false_light",
     .label = "False light",
     .help = "In shadow in the reference, bright in the picture: the sum of its causes.",
     .formula = "#{R < 1/2 and V >= 1/2, wrong} / n",
     .member = &M::false_light,
     .counts = Counts::Bright,
     .causes = kAllCauses},
    {.key = "acne",
     .label = "Acne",
     .help = "False shadow that more bias puts right: surfaces that shadow themselves.",
     .formula = "#{cause `acne`} / n",
     .member = &M::acne,
     .part_of = "false_shadow",
     .part = "acne",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::Acne})},
    {.key = "any_acne",
     .label = "Acne, even faint",
     .help = "Fully lit in the reference, darker in the picture, and more bias lights it: includes acne that a wide "
             "kernel hides.",
     .formula = "#{R = 1, V < 1 - 0.001, and more bias lights it: to one half or more where it is wrong, wholly where "
                "it is not} / n",
     .member = &M::any_acne},
    {.key = "visible_acne",
     .label = "Acne over 2 %",
     .help = "Acne that is seen: the picture is more than 2 % darker than the reference.",
     .formula = "#{as any_acne, and V < 0.98} / n",
     .member = &M::visible_acne},
    {.key = "any_leak",
     .label = "Leak over 2 %",
     .help = "Light in full shadow, where no true edge lies within the kernel's reach: includes faint light that is "
             "not wrong. It takes rays: `measure`, sweeps, the probe and Save of the tab Error have it, the live "
             "error has not.",
     .formula = "#{V > 0.02, and R = 0 at the pixel and at 8 points on its plane, at the reach of the kernel and of "
                "map.blur_texels} / n",
     .member = &M::any_leak,
     .cpu_only = true},
    {.key = "offset_false_shadow",
     .label = "False shadow (normal offset)",
     .help = "False shadow that is right without the normal offset.",
     .formula = "#{`offset_shadow`} / n",
     .member = &M::offset_false_shadow,
     .part_of = "false_shadow",
     .part = "normal offset",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::OffsetShadow})},
    {.key = "boundary_false_shadow",
     .label = "False shadow at edges",
     .help = "False shadow that no bias puts right: edge aliasing, undersampled, filter, penumbra, no map.",
     .formula = "#{false shadow by `edge_aliasing`, `undersampled`, `penumbra`, `filter`, `no_map`} / n",
     .member = &M::boundary_false_shadow,
     .part_of = "false_shadow",
     .part = "at edges",
     .counts = Counts::Dark,
     .causes = kAtEdges},
    {.key = "outside_false_shadow",
     .label = "False shadow outside",
     .help = "False shadow where the map holds nothing, or taps reach beyond its sides.",
     .formula = "#{false shadow by `outside_map`} / n",
     .member = &M::outside_false_shadow,
     .part_of = "false_shadow",
     .part = "outside the map",
     .counts = Counts::Dark,
     .causes = causes({Artefact::OutsideMap}),
     .rare = true},
    {.key = "bias_false_light",
     .label = "Peter-panning",
     .help = "False light that less bias, no normal offset or no polygon offset puts right.",
     .formula = "#{`peter_panning`, `peter_panning_offset`, `peter_panning_raster`} / n",
     .member = &M::bias_false_light,
     .part_of = "false_light",
     .part = "by bias",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::PeterPanning, Artefact::PeterPanningOffset, Artefact::PeterPanningRaster})},
    {.key = "contact_false_shadow",
     .label = "Shadow by contact shadows",
     .help = "False shadow that is right without contact shadows.",
     .formula = "#{`contact`} / n",
     .member = &M::contact_false_shadow,
     .part_of = "false_shadow",
     .part = "by contact shadows",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::Contact}),
     .rare = true},
    {.key = "lost_false_light",
     .label = "Lost casters",
     .help = "False light where culling, the near plane or a mask's mip level left the caster out of the map.",
     .formula = "#{`lost_caster`} / n",
     .member = &M::lost_false_light,
     .part_of = "false_light",
     .part = "lost casters",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::LostCaster})},
    {.key = "leak",
     .label = "Leaks",
     .help = "False light where the nearest texel alone, unfiltered and at its own least bias, is right.",
     .formula = "#{`leak`} / n",
     .member = &M::leak,
     .part_of = "false_light",
     .part = "leak",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::Leak})},
    {.key = "light_bleeding",
     .label = "Light bleeding",
     .help = "As leaks, under kernels by moments (VSM to MSM): the bound of the lit share is one half or more.",
     .formula = "#{`light_bleeding`} / n",
     .member = &M::light_bleeding,
     .part_of = "false_light",
     .part = "light bleeding",
     .counts = Counts::Wrong,
     .causes = causes({Artefact::LightBleeding}),
     .rare = true},
    {.key = "boundary_false_light",
     .label = "False light at edges",
     .help = "False light that neither bias nor filter puts right: edge aliasing, undersampled, penumbra, no map.",
     .formula = "#{false light by `edge_aliasing`, `undersampled`, `penumbra`, `no_map`} / n",
     .member = &M::boundary_false_light,
     .part_of = "false_light",
     .part = "at edges",
     .counts = Counts::Bright,
     .causes = kAtEdges},
    {.key = "outside_false_light",
     .label = "False light outside",
     .help = "False light where the map holds nothing, or taps reach beyond its sides.",
     .formula = "#{false light by `outside_map`} / n",
     .member = &M::outside_false_light,
     .part_of = "false_light",
     .part = "outside the map",
     .counts = Counts::Bright,
     .causes = causes({Artefact::OutsideMap}),
     .rare = true},
    {.key = "artefacts.filter",
     .label = "Kernel too wide",
     .unit = "px",
     .help = "False shadow where the nearest texel alone is right.",
     .formula = "#{`filter`}",
     .causes = causes({Artefact::Filter})},
    {.key = "artefacts.peter_panning_raster",
     .label = "Peter-panning (polygon offset)",
     .unit = "px",
     .help = "False light that is right without polygon offset, as the driver applies it.",
     .formula = "#{`peter_panning_raster`}",
     .causes = causes({Artefact::PeterPanningRaster})},
    {.key = "artefacts.contact",
     .label = "Contact shadows",
     .unit = "px",
     .help = "False shadow that is right without contact shadows.",
     .formula = "#{`contact`}",
     .causes = causes({Artefact::Contact})},
    {.key = "artefacts.edge_aliasing",
     .label = "Edge aliasing",
     .unit = "px",
     .help = "Wrong by the position of the map's texels; smaller ones help.",
     .formula = "#{`edge_aliasing`}",
     .causes = causes({Artefact::EdgeAliasing})},
    {.key = "artefacts.undersampled",
     .label = "Caster thinner than a texel",
     .unit = "px",
     .help = "As edge aliasing, where a shadow or the light between shadows is narrower than a texel.",
     .formula = "#{`undersampled`}",
     .causes = causes({Artefact::Undersampled})},
    {.key = "artefacts.penumbra",
     .label = "Penumbra",
     .unit = "px",
     .help = "Right for a light without size.",
     .formula = "#{`penumbra`}",
     .causes = causes({Artefact::Penumbra})},
    {.key = "artefacts.no_map",
     .label = "Other source",
     .unit = "px",
     .help = "Wrong under a light whose source is no map (light.source).",
     .formula = "#{`no_map`}",
     .causes = causes({Artefact::NoMap})},
    {.key = "within_noise",
     .label = "Within the noise",
     .help = "On the other side of one half than the reference, but within its noise. A smaller truth.noise classifies "
             "them.",
     .formula = "#{V and R on different sides of one half, but not wrong} / n",
     .member = &M::within_noise,
     .better = Better::Neither,
     .rare = true},
    {.key = "iou",
     .label = "Shadow overlap (IoU)",
     .unit = "",
     .help = "Intersection over union of both shadows: 1 is perfect.",
     .formula = "#{both in shadow} / #{either in shadow}; 1 when neither has any",
     .paper = "Jaccard, The Distribution of the Flora in the Alpine Zone, 1912",
     .member = &M::iou,
     .better = Better::More},
    {.key = "boundary_px_mean",
     .label = "Edge displacement",
     .unit = "px",
     .help = "Mean distance between both shadows' edges.",
     .formula = "mean distance in pixels of the picture (whatever `truth.step`) from each pixel of the contour V = 1/2 "
                "to the nearest of R = 1/2, and the reverse; none when only one of the two has a contour",
     .member = &M::boundary_px_mean,
     .cpu_only = true},
    {.key = "boundary_px_p95",
     .label = "Edge displacement, 95 %",
     .unit = "px",
     .help = "Nineteen edge pixels of twenty lie nearer.",
     .formula = "their 95th percentile",
     .paper = kHausdorff,
     .member = &M::boundary_px_p95,
     .cpu_only = true},
    {.key = "boundary_px_max",
     .label = "Edge displacement, maximum",
     .unit = "px",
     .help = "The largest distance (Hausdorff).",
     .formula = "the largest of them",
     .paper = kHausdorff,
     .member = &M::boundary_px_max,
     .cpu_only = true},
    {.key = "outside_map",
     .label = "Outside the map",
     .help = "The map does not cover them, right or wrong.",
     .formula = "#{the look-up lies outside the map, beyond its far plane or behind the light} / n; "
                "`artefacts.outside_map` counts only the wrong ones, and taps beyond the map's sides",
     .member = &M::outside_map,
     .better = Better::Neither},
});

constexpr std::size_t members_with_rows() {
    std::size_t n = 0;
    for (const Metric& m : kMetrics) {
        n += m.member != nullptr;
        for (const Metric& other : kMetrics)
            if (&other != &m && m.member && other.member == m.member) return 0;
    }
    return n;
}
static_assert(members_with_rows() == (offsetof(M, pixels) - offsetof(M, false_shadow)) / sizeof(double),
              "each number of ErrorMetrics has one row");

double counted_by(const Metric& metric, const PixelSums& sums) {
    double pixels = 0;
    for (std::size_t a = 0; a < kArtefacts; ++a) {
        if (!(metric.causes >> a & 1)) continue;
        if (metric.counts != Counts::Bright) pixels += sums.dark[a];
        if (metric.counts != Counts::Dark) pixels += sums.bright[a];
    }
    return pixels;
}

}  // namespace

std::span<const Metric> metrics() {
    return kMetrics;
}

const Metric* find_metric(std::string_view key) {
    const auto it = std::find_if(kMetrics.begin(), kMetrics.end(), [&](const Metric& m) { return m.key == key; });
    return it == kMetrics.end() ? nullptr : &*it;
}

double Metric::value(const ErrorMetrics& m) const {
    if (member) return m.*member;
    double wrong = 0;
    for (std::size_t a = 1; a < kArtefacts; ++a)
        if (causes >> a & 1) wrong += double(m.artefacts[a]);
    return wrong;
}

double distance_from_best(Better better, double value) {
    return better == Better::Less       ? value
           : better == Better::NearZero ? std::abs(value)
           : better == Better::More     ? 1 - value
                                        : std::numeric_limits<double>::quiet_NaN();
}

std::uint32_t compared_bits(float v, const ReferencePixel& reference, bool outside) {
    using J = ClassifiedPixel;
    const bool sides = (v < 0.5f) != (reference.visibility < 0.5), wrong = is_wrong(v, reference);
    const bool faint = reference.visibility == 1 && v >= 0.5f && v < float(1 - kRightVisibility);
    std::uint32_t bits = J::kCounts;
    if (wrong) bits |= v < 0.5f ? J::kFalseShadow : J::kFalseLight;
    if (sides && !wrong) bits |= J::kWithinNoise;
    if (faint) bits |= J::kFaint;
    if (outside) bits |= J::kOutside;
    return bits;
}

ReferencePixel reference_pixel(const Reference& reference, std::size_t i) {
    ReferencePixel p{
        .visibility = reference.visibility.data[i], .noise = 0, .hard_lit = reference.hard().data[i] >= 0.5f};
    if (reference.is_area()) p.noise = reference.standard_error.data[i];
    // One sample gives no estimate of the error, which is at most 0.5: that of a fair coin.
    if (std::isnan(p.noise)) p.noise = 0.5;
    return p;
}

std::vector<ClassifiedPixel> classified_pixels(const FloatImage& classified) {
    static_assert(
        kArtefacts <= 1 << shared::ARTEFACT_BITS &&
            shared::ARTEFACT_BITS + shared::ALSO_SHIFT + index_of(Artefact::NoMap) <= 24,
        "a classified pixel has to fit into the digits of a float; artefacts from NoMap on are never in Cause::also");
    std::vector<ClassifiedPixel> out(classified.data.size() / 2);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto code = std::uint32_t(classified.data[2 * i]);
        out[i] = {Artefact(code & ((1u << shared::ARTEFACT_BITS) - 1)), code >> shared::ARTEFACT_BITS,
                  classified.data[2 * i + 1]};
    }
    return out;
}

ErrorMetrics metrics_of(const PixelSums& sums, const Reference& reference) {
    ErrorMetrics m;
    m.pixels = reference.pixels;
    m.counted = reference.counted();
    m.ground_pixels = reference.on_ground;
    const double n = double(std::max<std::size_t>(m.counted, 1));
    for (const Metric& metric : metrics())
        if (metric.counts != Counts::Otherwise) m.*metric.member = counted_by(metric, sums) / n;
    m.any_acne = sums.any_acne / n;
    m.visible_acne = sums.visible_acne / n;
    m.any_leak = sums.any_leak / n;
    m.within_noise = sums.within_noise / n;
    m.outside_map = sums.outside / n;
    m.mae = sums.absolute / n;
    m.rmse = std::sqrt(sums.squares / n);
    m.signed_mean = sums.sum / n;
    if (sums.either > 0) m.iou = sums.both / sums.either;
    m.boundary_px_mean = m.boundary_px_p95 = m.boundary_px_max = std::numeric_limits<double>::quiet_NaN();
    std::size_t wrong = 0;
    for (std::size_t a = 1; a < kArtefacts; ++a)
        wrong += m.artefacts[a] = std::size_t(std::llround(sums.dark[a] + sums.bright[a]));
    m.artefacts[0] = reference.state.size() - wrong;
    return m;
}

ErrorMetrics error_metrics(const std::vector<ClassifiedPixel>& classified, const Reference& reference,
                           const Receivers* receivers) {
    if (classified.size() != reference.state.size())
        throw Error(fmt::format("{} classified pixels cannot be compared with a reference of {} x {}",
                                classified.size(), reference.width, reference.height));
    using J = ClassifiedPixel;
    PixelSums sums;
    for (std::size_t i = 0; i < reference.state.size(); ++i) {
        if (reference.state[i] != PixelState::Counted) continue;
        const J& p = classified[i];
        const double r = reference.visibility.data[i], difference = p.visibility - r;
        sums.absolute += std::abs(difference);
        sums.squares += difference * difference;
        sums.sum += difference;
        sums.both += p.visibility < 0.5f && r < 0.5;
        sums.either += p.visibility < 0.5f || r < 0.5;
        sums.dark[std::size_t(p.artefact)] += p.has(J::kFalseShadow);
        sums.bright[std::size_t(p.artefact)] += p.has(J::kFalseLight);
        sums.outside += p.has(J::kOutside);
        sums.any_acne += p.has(J::kAnyAcne);
        sums.visible_acne += p.has(J::kAnyAcne) && p.visibility < 1 - shared::VISIBLE_ERROR;
        sums.any_leak += p.any_leak;
        sums.within_noise += p.has(J::kWithinNoise);
    }
    ErrorMetrics m = metrics_of(sums, reference);
    const auto drawn = contour(reference, receivers, [&](std::size_t i) { return classified[i].visibility; });
    const auto real = contour(reference, receivers, [&](std::size_t i) { return reference.visibility.data[i]; });
    m.boundary_px_mean = m.boundary_px_p95 = m.boundary_px_max = 0;
    contour_distances(m, drawn, real, reference.width, reference.height, reference.step);
    return m;
}

}  // namespace si
