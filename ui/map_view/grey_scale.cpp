#include "ui/map_view/grey_scale.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/inspect/grey_range.h"
#include "shaders/shared/colours.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kScaleWidth = 9;                               ///< width of the scale, ems
constexpr float kScaleLeastWidth = 16, kScaleLeastHeight = 9;  ///< smallest picture that has one, ems
constexpr int kScaleSteps = 32;
constexpr float kStripeStep = 1.1f, kStripe = 0.22f;  ///< distance and width of the stripes, ems

/// Returns Turbo by a polynomial. Mikhailov, Turbo, An Improved Rainbow Colormap for Visualization, 2019.
glm::vec3 turbo(float t) {
    constexpr glm::vec3 kFactors[] = {
        {0.13572138f, 0.09140261f, 0.10667330f},      {4.61539260f, 2.19418839f, 12.64194608f},
        {-42.66032258f, 4.84296658f, -60.58204836f},  {132.13108234f, -14.18503333f, 110.36276771f},
        {-152.94239396f, 4.27729857f, -89.90310912f}, {59.28637943f, 2.82956604f, 27.34824973f}};
    glm::vec3 out(0);
    for (std::size_t i = std::size(kFactors); i-- > 0;) out = kFactors[i] + t * out;
    return out;
}

/// Returns Viridis, interpolated between nine of its colours. Van der Walt and Smith, 2015.
glm::vec3 viridis(float t) {
    constexpr glm::vec3 kStops[] = {{0.267f, 0.005f, 0.329f}, {0.278f, 0.176f, 0.483f}, {0.231f, 0.318f, 0.545f},
                                    {0.173f, 0.443f, 0.557f}, {0.128f, 0.567f, 0.551f}, {0.154f, 0.681f, 0.505f},
                                    {0.361f, 0.786f, 0.388f}, {0.668f, 0.862f, 0.196f}, {0.993f, 0.906f, 0.144f}};
    const int stop = std::min(int(8 * t), 7);
    return glm::mix(kStops[stop], kStops[stop + 1], 8 * t - float(stop));
}

}  // namespace

glm::vec3 map_ramp_colour(MapColours colours, double t) {
    const float at = float(std::clamp(t, 0.0, 1.0));
    const glm::vec3 colour = colours == MapColours::Turbo     ? turbo(at)
                             : colours == MapColours::Viridis ? viridis(at)
                                                              : glm::vec3(at);
    return glm::clamp(colour, 0.0f, 1.0f);
}

void draw_empty_hatch(ImVec2 lo, ImVec2 hi, ImVec2 from, ImVec2 to) {
    from = {std::max(lo.x, from.x), std::max(lo.y, from.y)};
    to = {std::min(hi.x, to.x), std::min(hi.y, to.y)};
    if (from.x >= to.x || from.y >= to.y) return;
    const float em = ImGui::GetFontSize(), step = em * kStripeStep, tall = to.y - from.y;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, to, theme::colour(shared::HATCH_BETWEEN));
    list.PushClipRect(from, to, true);
    const float first = step * std::floor((from.x + from.y) / step);
    for (float sum = first; sum < to.x + to.y + step; sum += step)
        list.AddLine({sum - from.y, from.y}, {sum - from.y - tall, to.y}, theme::colour(shared::HATCH_LINE),
                     em * kStripe);
    list.PopClipRect();
}

void draw_grey_scale(const ViewSettings& view, const FrameResult& frame, ImVec2 end, ImVec2 size) {
    const float em = ImGui::GetFontSize(), pad = em * 0.5f, bar = em * 0.6f;
    if (view.map == MapView::Bands || size.x < em * kScaleLeastWidth || size.y < em * kScaleLeastHeight) return;
    const std::string low = "shown " + grey_value_text(view, frame, frame.map_black);
    const std::string high = "to " + grey_value_text(view, frame, frame.map_white);
    const float line = theme::small()->FontSize,
                texts = text_width(low, theme::small()) + text_width(high, theme::small());
    const float width = std::max(em * kScaleWidth, texts + em);
    if (width + 2 * pad > size.x) return;
    const ImVec2 hi(end.x - pad, end.y - pad), lo(hi.x - width - 2 * pad, hi.y - bar - line - 1.6f * pad);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(lo, hi, theme::kVeil, em * 0.25f);
    const float x0 = lo.x + pad, y0 = lo.y + pad * 0.6f;
    for (int i = 0; i < kScaleSteps; ++i) {
        const auto at = [&](int step) { return float(step) / float(kScaleSteps); };
        const ImU32 left = theme::colour(map_ramp_colour(view.map_colours, at(i)));
        const ImU32 right = theme::colour(map_ramp_colour(view.map_colours, at(i + 1)));
        list.AddRectFilledMultiColor({x0 + at(i) * width, y0}, {x0 + at(i + 1) * width, y0 + bar}, left, right, right,
                                     left);
    }
    small_text({x0, y0 + bar + pad * 0.3f}, low, theme::kOnPicture);
    small_text({x0 + width, y0 + bar + pad * 0.3f}, high, theme::kOnPicture, 1);
}

}  // namespace si
