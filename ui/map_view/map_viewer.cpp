// Map viewer: the light's depth map or the camera's depth image with its display options, zoom and pan, values of
// texels, and marks of the texels that the picture reads.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderer/inspect/probe.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "ui/map_view/depth_plots.h"
#include "ui/map_view/grey_scale.h"
#include "ui/map_view/map_marks.h"
#include "ui/scene_view/frustum_lines.h"
#include "ui/scene_view/kernel_marks.h"
#include "ui/scene_view/picture_marks.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/toolbar.h"

namespace si {
namespace {

constexpr float kZoomPerStep = 1.25f, kMaxTexelPixels = 160;
constexpr int kMarksOpacity = 90;

bool of_camera(const Settings& s) {
    return s.view.map_source == MapSource::Camera;
}

void save_menu(EditorState& state, EditorRequests& requests) {
    menu_button("Save", "save map",
                "Write the depth image: .pfm and .exr hold the stored values as floats (metres when the view\n"
                "is linear), .png the picture as shown",
                ImGui::GetFontSize() * 24);
    if (!ImGui::BeginPopup("save map")) return;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    if (path_input("##file", "file.pfm, .exr or .png", state.map.save_path, "Write"))
        requests.export_file = ExportRequest{ExportKind::Map, state.map.save_path};
    ImGui::EndPopup();
}

/// Draws the checkbox that fits the contrast to the drawn depths.
void fit_choice(ViewSettings& v) {
    const bool whole = v.map_black == 0 && v.map_white == 1;
    bool fits = v.map_fit || (whole && v.map_contrast == MapContrast::Auto);
    const bool pressed = ImGui::Checkbox("##fit", &fits);
    wrapped_tooltip(
        "Contrast from the smallest to the largest drawn depth, empty texels left out; the scale in the picture has "
        "both in metres (view.map_contrast, view.map_fit)");
    if (!pressed) return;
    v.map_contrast = fits ? MapContrast::Auto : MapContrast::Whole;
    v.map_fit = fits && !whole;
}

/// Draws the checkbox that marks the texels that kernels fetch.
void exact_choice(EditorState& state) {
    ImGui::BeginDisabled(state.frozen.has_value());
    ImGui::Checkbox("Texels read", &state.map.exact_texels);
    ImGui::EndDisabled();
    plain_tooltip(state.frozen ? "Not of a frozen camera: of it only the squares about kernels are known"
                               : "Mark the texels that kernels fetch, exactly, where links show the squares "
                                 "about them: red what some pixel\nof the picture fetches, darkened what "
                                 "none does. Costs the kernel once more for every pixel and reading a\nfloat "
                                 "of each texel back, in every new frame while nothing is dragged",
                  ImGuiHoveredFlags_AllowWhenDisabled);
}

float check_width(const char* label) {
    return ImGui::CalcTextSize(label).x + ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
}

void place_combo(EditorState& state, float width) {
    static constexpr ComboItem kPlaces[] = {
        {0, "above the settings"}, {1, "beside the scene"}, {2, "inset"}, {3, "hidden"}};
    int place = int(state.layout.map_place);
    ImGui::SetNextItemWidth(width);
    if (item_combo("##map place", kPlaces, place)) state.layout.map_place = MapSpot(place);
    plain_tooltip(with_key("Place of the shadow map in the window", Command::NextMapPlace));
}

/// Lists the lights as choices; empty if there is nothing to choose from.
NamedValues light_choices(const Settings& s) {
    NamedValues out;
    if (s.light_count < 2) return out;
    for (int i = 0; i < s.light_count; ++i) out.emplace_back(i, light_title(s, i));
    out.back().first = std::max(out.back().first, s.view.light);  // a number beyond the last means the last
    return out;
}

/// Returns true if the plots fit below a map that has this height with its caption.
bool has_room_for_plots(const EditorLayout& layout, float height) {
    return height > ImGui::GetFontSize() * (layout.map_place == MapSpot::NextToScene ? 17 : 30);
}

void header(EditorState& state, const FrameResult* result, EditorRequests& requests) {
    Settings& s = state.settings;
    const float em = ImGui::GetFontSize();
    const bool plots = has_room_for_plots(state.layout, ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeight());
    const bool titled = ImGui::GetContentRegionAvail().x > em * 16;  // narrower viewers have room for the choices only
    Toolbar bar("map tools");
    if (titled) bar.title("Map");
    if (titled && ImGui::IsItemHovered()) {
        plain_tooltip(with_key("Double-click: alone in the window, and back", Command::MaximisePanel));
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) toggle_maximised(state, Panel::Map);
    }
    const auto setting = [&](const char* label, const char* key, float width) {
        bar.item(label, width, [&s, key](float room) { setting_widget(s, key, room); });
    };
    setting("", "view.map_source", em * 9);
    if (!of_camera(s)) {
        if (NamedValues lights = light_choices(s); !lights.empty())
            bar.item("", em * 6.5f,
                     [&s, lights](float room) { setting_widget(s, *find_setting("view.light"), room, lights); });
        if (NamedValues names = view_choices(s, result, "view.face"); !names.empty())
            bar.item("", em * 7,
                     [&s, names](float room) { setting_widget(s, *find_setting("view.face"), room, names); });
    }
    setting("", "view.map", em * 5.5f);
    if (!of_camera(s)) {
        if (filter_of(s).samples() == Samples::Moments) setting("Channel", "view.map_channel", em * 7);
        if (shown_channel(s) > 0 && keeps_mips(s)) setting("Mip level", "view.map_mip", em * 4);
    }
    const bool bands = s.view.map == MapView::Bands;
    const float end = em * 4.2f;
    bar.item(bands ? "Bands" : "Range", 2 * end + ImGui::GetStyle().ItemSpacing.x, [&s, bands, end](float) {
        setting_widget(s, bands ? "view.band_low" : "view.map_black", end);
        ImGui::SameLine();
        setting_widget(s, bands ? "view.band_high" : "view.map_white", end);
    });
    if (!bands) bar.item("Fit", ImGui::GetFrameHeight(), [&s](float) { fit_choice(s.view); });
    if (!bands) setting("Colours", "view.map_colours", em * 5.5f);
    bar.item("", check_width("Plots"), [&state, plots](float) {
        ImGui::Checkbox("Plots", &state.layout.map_plots);
        wrapped_tooltip(std::string("Histogram of the depths, and depth over distance") +
                        (state.layout.map_plots && !plots
                             ? with_key(". They show where the map has more height", Command::MaximisePanel)
                             : ""));
    });
    if (!of_camera(s)) bar.item("", check_width("Texels read"), [&](float) { exact_choice(state); });
    bar.item("Place", em * 9, [&](float room) { place_combo(state, room); });
    bar.item("", em * 3, [&](float) { save_menu(state, requests); });
    bar.end();
}

/// Returns the caption: the image and the meaning of its texels.
std::pair<std::string, std::string> title(const Settings& s, const FrameResult& result, const FittedLight* fitted) {
    const DepthCurve& curve = result.map_view_curve;
    const glm::ivec2 n = result.map_view_size;
    const std::string range =
        fmt::format("map's depth range {} to {}", metres_text(curve.near), metres_text(curve.far));
    if (!fitted) return {fmt::format("camera   {}×{}   32-bit float, reversed", n.x, n.y), range};
    std::string format = "?";
    if (const auto ref = find_setting("map.format")) format = ref->param->choices()[std::size_t(s.map.format)].label;
    const LightView& view = fitted->views[std::size_t(shown_face(s, result))];
    const TexelSize sizes = view.texel_size_range({n.x, n.y});
    const std::string texel = curve.perspective || view.warped()
                                  ? fmt::format("{} to {}", metres_text(sizes.shortest), metres_text(sizes.longest))
                                  : metres_text(sizes.longest);
    const std::string name =
        view_name(fitted->chooser.choice, std::size_t(shown_face(s, result)), fitted->views.size());
    if (const ShownMap& shown = result.shown_map; shown.channel > 0) {
        format = std::string(shown.name);
        if (shown.mip > 0) format += fmt::format("   mip level {}, {}×{}", shown.mip, shown.texels.x, shown.texels.y);
    }
    return {fmt::format("{}{}{}   {}×{}   {}", light_title(s, shown_light(s)), name.empty() ? "" : " ", name, n.x, n.y,
                        format),
            fmt::format("texel {}   {}", texel, range)};
}

MapRect place(const MapWindow& window, ImVec2 origin, ImVec2 size, glm::ivec2 texels) {
    const float fit = std::min(size.x / float(texels.x), size.y / float(texels.y)) * window.zoom;
    const ImVec2 whole(fit * float(texels.x), fit * float(texels.y));
    return {{origin.x + 0.5f * size.x - window.centre.x * whole.x,
             origin.y + 0.5f * size.y - (1 - window.centre.y) * whole.y},
            whole,
            texels};
}

void steer(MapWindow& window, ImVec2 origin, ImVec2 size, glm::ivec2 texels) {
    const ImGuiIO& io = ImGui::GetIO();
    const MapRect before = place(window, origin, size, texels);
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
        const glm::vec2 under(before.uv(io.MousePos));
        const float most = std::max(1.0f, kMaxTexelPixels * window.zoom / before.texel_pixels());
        window.zoom = std::clamp(window.zoom * std::pow(kZoomPerStep, io.MouseWheel), 1.0f, most);
        window.centre += under - glm::vec2(place(window, origin, size, texels).uv(io.MousePos));
    }
    if (ImGui::IsItemActive()) {
        window.centre.x -= io.MouseDelta.x / before.size.x;
        window.centre.y += io.MouseDelta.y / before.size.y;
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) window = {};
    window.centre = glm::clamp(window.centre, glm::vec2(0), glm::vec2(1));
    if (window.zoom <= 1) window.centre = glm::vec2(0.5f);
}

/// Returns the texels that the picture reads: those of the frozen camera's pixels while a camera is frozen.
const TexelUsage* shown_usage(const EditorState& state, const EditorFrame& frame) {
    return state.frozen ? frame.frozen_usage : frame.texel_usage;
}

/// Outlines the texels that the kernel at a pixel of the scene picture reads.
void mark_pixels_texels(const EditorState& state, const EditorFrame& frame, const MapRect& rect, glm::ivec2 pixel,
                        ImU32 colour) {
    const FloatImage* c = frame.map_coordinates;
    if (!c || pixel.x < 0 || pixel.y < 0 || pixel.x >= c->width || pixel.y >= c->height) return;
    if (c->at(pixel.x, pixel.y, 3) <= 0 || int(c->at(pixel.x, pixel.y, 2)) != shown_face(state.settings, *frame.result))
        return;
    const MapSize size(rect.texels.x, rect.texels.y);
    const KernelFootprint f =
        kernel_footprint(c->at(pixel.x, pixel.y, 0), c->at(pixel.x, pixel.y, 1), size, reach_of(state.settings).read);
    outline_texels(rect, f.first, glm::ivec2(f.count), colour);
}

/// Outlines the texels that a probed kernel compares, each in the colour of its result.
void mark_taps(const MapRect& rect, const Probe::PerLight& p) {
    if (p.taps.empty()) return;
    const double heaviest = heaviest_tap(p);
    if (rect.texel_pixels() > 4)
        for (const KernelTap& t : p.taps) {
            const auto [lo, hi] = rect.square(t.texel);
            ImGui::GetWindowDrawList()->AddRectFilled(lo, hi, faded(tap_colour(t, heaviest), 110));
        }
    outline_texels(rect, p.taps_first, p.taps_size, theme::kProbed);
}

/// Outlines the texel of a clicked finding, if its map is shown.
void mark_finding(const EditorState& state, const FrameResult& result, const MapRect& shown) {
    const auto& mark = state.map.marked_texel;
    if (!mark || mark->light != shown_light(state.settings) || mark->view != shown_face(state.settings, result)) return;
    if (mark->level == result.shown_map.mip && shown.holds(mark->texel))
        outline_texels(shown, mark->texel, {1, 1}, theme::error());
}

/// Returns the image that marks the texels fetched by kernels; null: not requested, or not in this frame.
const Image* exact_marks(const EditorState& state, const EditorFrame& frame) {
    const Image& marks = frame.result->texels_read;
    return state.map.exact_texels && !state.frozen && marks.texture != 0 ? &marks : nullptr;
}

std::string usage_text(const EditorState& state, const EditorFrame& frame) {
    if (exact_marks(state, frame) && frame.exact_utilisation)
        return percent_text(*frame.exact_utilisation) + " of texels fetched";
    const TexelUsage* usage = shown_usage(state, frame);
    if (!usage || usage->size().shortest() == 0) return {};
    return fmt::format("{} of texels read{}", percent_text(usage->utilisation()), state.frozen ? " (frozen)" : "");
}

/// Returns why the shown level of a virtual map is empty, and which level is not; empty: the level has pages.
std::string empty_level_text(const Settings& s, const FrameResult& result) {
    if (!result.pages) return {};
    const std::vector<int>& pages = result.pages->by_level;
    const auto shown = std::size_t(shown_face(s, result));
    const auto fullest = std::ranges::max_element(pages);
    if (shown >= pages.size() || pages[shown] > 0 || *fullest == 0) return {};
    return fmt::format("No look-up requests a page of this level; level {} has {} of {}", fullest - pages.begin() + 1,
                       *fullest, result.pages->wanted);
}

/// Appends `more` to the shorter of two lines.
void append(std::pair<std::string, std::string>& lines, const std::string& more) {
    const auto width = [](const std::string& text) { return text_width(text, theme::small()); };
    std::string& line = width(lines.first) <= width(lines.second) ? lines.first : lines.second;
    line += "   " + more;
}

/// Returns the reason why there is no picture of the map; empty: there is one.
std::string obstacle(const Settings& s, const EditorFrame& frame) {
    const FrameResult& result = *frame.result;
    if (!of_camera(s)) {
        const int light = shown_light(s);
        if (light < 0) return "No light: light.count is 0.";
        const FittedLight* const fitted = shown_fitted_light(s, result);
        if (!fitted) return "...";  // a light was just added
        if (!fitted->casts || fitted->views.empty())
            return fmt::format("{} has no shadow map: {}.", light_title(s, light),
                               fitted->reason.empty() ? "it casts no shadow" : fitted->reason);
    }
    if (result.map_view.texture == 0 || result.map_view_size.x <= 0 || result.map_view_size.y <= 0)
        return "The depth image was not drawn.";
    return {};
}

}  // namespace

void draw_map_viewer(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    state.map.hovered_texel.reset();
    header(state, frame.result, requests);
    requests.want_map = true;
    if (!frame.result) return;
    const FrameResult& result = *frame.result;
    const float em = ImGui::GetFontSize();
    const ImVec2 available = ImGui::GetContentRegionAvail();
    const float line = theme::small()->FontSize * 1.25f, caption = 2 * line + em * 0.5f;
    const bool plots = state.layout.map_plots && has_room_for_plots(state.layout, available.y);
    const float plot_height = plots ? em * 6.5f : 0;
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(available.x, 16.0f), std::max(available.y - caption - plot_height, 16.0f));
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(origin, end, theme::well());
    state.shots.map_rect = {{origin.x, origin.y}, {size.x, size.y}};
    if (const std::string text = obstacle(state.settings, frame); !text.empty()) {
        ImGui::SetCursorScreenPos({origin.x + em, origin.y + em});
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x - 2 * em);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        return;
    }
    const bool camera = of_camera(state.settings);
    const FittedLight* fitted = camera ? nullptr : shown_fitted_light(state.settings, result);
    const glm::ivec2 n = result.map_view_size;
    requests.want_map_facts = plots;
    requests.want_exact_texels = !camera && state.map.exact_texels && !state.frozen && !state.viewport.dragging;
    requests.want_frozen_usage = !camera && state.frozen && !state.viewport.dragging;

    ImGui::InvisibleButton("map picture", size);
    const bool hovered = ImGui::IsItemHovered();
    if (ImGui::IsItemActive()) state.viewport.dragging = true;
    steer(state.map.window, origin, size, n);
    const MapRect rect = place(state.map.window, origin, size, n);
    const ImVec2 rect_end(rect.lo.x + rect.size.x, rect.lo.y + rect.size.y);
    list.PushClipRect(origin, end, true);
    draw_empty_hatch(rect.lo, rect_end, origin, end);
    list.AddImage(texture_id(result.map_view.texture), rect.lo, rect_end, {0, 1}, {1, 0});  // stored bottom row first
    if (const Image* marks = camera ? nullptr : exact_marks(state, frame))                  // one channel: red or black
        list.AddImage(texture_id(marks->texture), rect.lo, rect_end, {0, 1}, {1, 0},
                      faded(IM_COL32_WHITE, kMarksOpacity));
    list.AddRect(rect.lo, rect_end, theme::line());
    const MapRect shown{rect.lo, rect.size, result.shown_map.texels};  // texels of the shown mip level
    if (fits_texel_values(shown)) {
        requests.want_map_values = true;
        if (frame.map_values) draw_texel_values(shown, *frame.map_values, origin, end);
    }
    if (camera) {
        if (state.probe_pixel)
            outline_texels(rect, {state.probe_pixel->x, n.y - 1 - state.probe_pixel->y}, {1, 1}, theme::kProbed);
        if (state.viewport.hovered_pixel)
            outline_texels(rect, {state.viewport.hovered_pixel->x, n.y - 1 - state.viewport.hovered_pixel->y}, {1, 1},
                           IM_COL32_WHITE);
    } else {
        // The frozen camera's outline, and the live camera's once it has moved away.
        const LightView& light_view = fitted->views[std::size_t(shown_face(state.settings, result))];
        if (state.frozen) {
            draw_map_lines(rect, camera_outline_in_map(result.camera, light_view), theme::kLive);
            draw_map_lines(rect, camera_outline_in_map(state.frozen->camera, light_view), theme::kFrozen);
        } else if (state.settings.view.map_region) {
            draw_map_lines(rect, camera_region_in_map(result.camera, light_view), theme::kLive);
        }
        if (frame.probe && frame.probe->hit)
            for (const Probe::PerLight& p : frame.probe->lights)
                if (p.casts && p.light == shown_light(state.settings) && p.face == shown_face(state.settings, result) &&
                    p.place == MapPlace::Inside)
                    mark_taps(rect, p);
        mark_finding(state, result, shown);
        if (state.viewport.hovered_pixel)
            mark_pixels_texels(state, frame, rect, *state.viewport.hovered_pixel, theme::kLinked);
    }
    auto text = title(state.settings, result, fitted);
    std::optional<double> marked_m;
    if (const std::string usage = usage_text(state, frame); !usage.empty() && !camera) append(text, usage);
    if (hovered) {
        requests.want_map_values = true;
        requests.want_links |= !camera;
        const glm::dvec2 uv = rect.uv(ImGui::GetIO().MousePos);
        const glm::ivec2 texel(glm::floor(uv * glm::dvec2(n)));
        if (rect.holds(texel)) {
            state.map.hovered_texel = texel;
            outline_texels(rect, texel, {1, 1}, IM_COL32_WHITE);
            text = texel_readout(texel, n, frame.map_values, result.map_view_curve, shown_usage(state, frame),
                                 state.frozen.has_value(), result.shown_map, state.settings.view.map != MapView::Raw);
            if (result.shown_map.channel == 0 && frame.map_values && frame.map_values->width == n.x &&
                frame.map_values->height == n.y)
                marked_m = result.map_view_curve.curve_at_row((texel.y + 0.5) / n.y)
                               .distance(frame.map_values->at(texel.x, n.y - 1 - texel.y));
        }
    }
    if (fitted && fitted->clipped_casters > 0) {
        const std::string lost =
            fmt::format("{} in front of the near plane",
                        fitted->clipped_casters == 1 ? "1 object reaches"
                                                     : fmt::format("{} objects reach", fitted->clipped_casters));
        draw_text_on_picture({origin.x + em * 0.8f, origin.y + em * 0.6f}, lost, theme::kWarningOnPicture);
    }
    if (const std::string empty = camera ? "" : empty_level_text(state.settings, result); !empty.empty())
        draw_text_on_picture({origin.x + em * 0.8f, end.y - em * 1.8f},
                             beginning_that_fits(empty, size.x - em * 2, ImGui::GetFont()), theme::kMutedOnPicture);
    draw_grey_scale(state.settings.view, result, end, size);
    list.PopClipRect();
    float y = end.y + em * 0.2f;
    for (const auto& [words, colour] : {std::pair(text.first, theme::text()), {text.second, theme::muted()}}) {
        small_text({origin.x, y}, beginning_that_fits(words, size.x, theme::small()), colour);
        y += line;
    }
    if (!plots) return;
    const float top = end.y + caption, half = 0.5f * (size.x - em * 0.5f);
    ImGui::SetCursorScreenPos({origin.x, top});
    draw_histogram(state, frame, {half, plot_height});
    ImGui::SetCursorScreenPos({origin.x + half + em * 0.5f, top});
    draw_depth_curve(state, result, marked_m, {half, plot_height});
}

}  // namespace si
