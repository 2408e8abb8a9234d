#include "ui/scene_view/cascade_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/base/lengths_text.h"
#include "renderer/settings/param.h"
#include "renderer/settings/splits.h"
#include "renderer/view/cascades/cascades.h"
#include "shaders/shared/colours.h"
#include "ui/state/panels.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kLeastWidth = 14;     ///< smallest width of the bar, ems
constexpr double kFirstShare = 0.25;  ///< depth at the bar's left end, as a share of the first cascade's end
constexpr double kLeastShare = 1e-4;  ///< smallest difference of two manual splits

double& split_of(LightSettings& light, int cascade) {
    constexpr double LightSettings::*kSplits[] = {
        &LightSettings::split_1, &LightSettings::split_2, &LightSettings::split_3, &LightSettings::split_4,
        &LightSettings::split_5, &LightSettings::split_6, &LightSettings::split_7};
    static_assert(std::size(kSplits) == kMaxCascades - 1);
    return light.*kSplits[cascade];
}

/// Returns the camera depth at which the divided range begins, metres: the one from which the splits give these ends.
double division_begin(const LightSettings& drawn, std::span<const double> ends) {
    if (drawn.split == Split::Manual) {
        const double share = manual_splits(drawn)[0];
        if (!(share < 1 - kLeastShare)) return 0;
        return std::clamp((ends.front() - share * ends.back()) / (1 - share), 0.0, ends.front());
    }
    const double lambda = drawn.split == Split::Uniform       ? 0
                          : drawn.split == Split::Logarithmic ? 1
                                                              : std::clamp(drawn.split_lambda, 0.0, 1.0);
    // The first end grows with the beginning.
    double low = kLeastShare * ends.front(), high = ends.front();
    constexpr int kBisections = 60;
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        const double first = split_depths(middle, ends.back(), int(ends.size()), lambda).front();
        (first < ends.front() ? low : high) = middle;
    }
    return low;
}

std::vector<double> ends_of(const FittedLight& light) {
    std::vector<double> ends;
    for (const ViewSpan& span : light.chooser.spans) ends.push_back(span.ends);
    return ends;
}

/// Scale of the bar: logarithmic, so that near cascades have room.
struct Scale {
    double first, last;  ///< metres
    float left, width;   ///< pixels of the screen
    float x(double metres) const {
        const double share = std::log(std::max(metres, first) / first) / std::log(last / first);
        return left + width * float(std::clamp(share, 0.0, 1.0));
    }
    double metres(float at) const { return first * std::pow(last / first, double((at - left) / width)); }
};

}  // namespace

void move_cascade_end(LightSettings& light, const LightSettings& drawn, std::span<const double> ends, int cascade,
                      double metres) {
    if (cascade < 0 || cascade + 1 >= int(ends.size()) || cascade >= kMaxCascades - 1) return;
    const double begin = division_begin(drawn, ends), length = ends.back() - begin;
    if (!(length > 0)) return;
    const auto share = [&](double end) { return std::clamp((end - begin) / length, 0.0, 1.0); };
    light.split = Split::Manual;
    for (int i = 0; i + 1 < int(ends.size()) && i < kMaxCascades - 1; ++i)
        if (i != cascade) split_of(light, i) = share(ends[std::size_t(i)]);
    const double least = (cascade == 0 ? 0 : split_of(light, cascade - 1)) + kLeastShare;
    const double most = (cascade + 2 == int(ends.size()) ? 1 : split_of(light, cascade + 1)) - kLeastShare;
    split_of(light, cascade) = std::clamp(share(metres), std::min(least, most), std::max(least, most));
}

void draw_cascade_bar(Settings& settings, const Settings* drawn, const FrameResult& result, ImVec2 lo, ImVec2 room,
                      float taken) {
    const FittedLight* const light = shown_fitted_light(settings, result);
    if (!light || !light->casts || light->chooser.choice != ViewChoice::Interval) return;
    const std::vector<double> ends = ends_of(*light);
    const float em = ImGui::GetFontSize(), gap = em * 0.6f;
    const float left = lo.x + taken + 3 * gap, width = lo.x + room.x - gap - left;
    if (ends.size() < 2 || width < em * kLeastWidth || !(ends.front() > 0 && ends.back() > ends.front())) return;
    const float height = ImGui::GetFrameHeight() + em * 0.4f;
    ImGui::SetCursorScreenPos({left, lo.y + room.y - gap - height});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kVeil);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, em * 0.25f);
    // The bar is a window of its own, so that the mouse over it does not act on the picture.
    ImGui::BeginChild("cascade bar", {width, height}, false, ImGuiWindowFlags_NoScrollbar);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Scale scale{kFirstShare * ends.front(), ends.back(), left + gap, width - 2 * gap};
    const float top = lo.y + room.y - gap - height + em * 0.25f, foot = top + em * 0.55f;
    float from = scale.left;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const float to = scale.x(ends[i]);
        list.AddRectFilled({from, top}, {to, foot}, theme::colour(shared::view_colour(int(i))));
        const std::string text = metres_text(ends[i]);
        const float wide = text_width(text, theme::small());
        // A number without room between its neighbours is left out; the tooltip has it.
        if (to - from > wide + em * 0.5f) small_text({to - wide, foot + em * 0.1f}, text, theme::kOnPicture);
        from = to;
    }
    LightSettings& own = settings.lights[std::size_t(shown_light(settings))];
    const LightSettings& before = (drawn ? *drawn : settings).lights[std::size_t(shown_light(settings))];
    for (int i = 0; i + 1 < int(ends.size()); ++i) {
        const float x = scale.x(ends[std::size_t(i)]);
        ImGui::PushID(i);
        ImGui::SetCursorScreenPos({x - em * 0.4f, top - em * 0.25f});
        ImGui::InvisibleButton("end", {em * 0.8f, height});
        const bool held = ImGui::IsItemActive(), hot = held || ImGui::IsItemHovered();
        if (hot) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        list.AddRectFilled({x - em * 0.08f, top - em * 0.15f}, {x + em * 0.08f, foot + em * 0.15f},
                           hot ? IM_COL32_WHITE : theme::kShade);
        if (held && ImGui::GetIO().MouseDelta.x != 0)
            move_cascade_end(own, before, ends, i, scale.metres(ImGui::GetIO().MousePos.x));
        plain_tooltip(fmt::format("Cascade {} ends {} from the camera.\nDrag to move it: light.split becomes manual",
                                  i + 1, metres_text(ends[std::size_t(i)])));
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

}  // namespace si
