// Strips between the top bar and the pictures: the note of the open preset, notes on the scene, the session that a
// crash has left, and a scene that another program has saved.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <iterator>
#include <vector>

#include "renderer/settings/param.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kGap = 0.53f;      ///< between buttons, in text heights
constexpr float kPadding = 0.67f;  ///< left and right of a strip's text, in text heights

float buttons_width(std::initializer_list<const char*> labels) {
    float width = 0;
    const float gap = ImGui::GetFontSize() * kGap;
    for (const char* label : labels) width += button_width(label) + gap;
    return width - gap;
}

struct Run {
    std::string text;
    ImFont* font;
    ImU32 colour;
};

struct Flowed {
    float height = 0;
    int lines = 1;
    bool cut = false;  ///< the last line ends in "…"
};

/// Lays out runs of text one after the other, broken between words at `width`, in at most `most` lines (0: no limit).
/// Draws them from `at` on, unless `draw` is null.
Flowed lay_out_runs(const std::vector<Run>& runs, ImVec2 at, float width, int most, ImDrawList* draw) {
    const float size = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    constexpr const char* kMore = "…";
    const float more = ImGui::CalcTextSize(kMore).x;
    float x = 0, y = 0;
    int lines = 1;
    for (const Run& run : runs) {
        const auto wide = [&](const char* from, const char* to) {
            return run.font->CalcTextSizeA(size, FLT_MAX, 0, from, to).x;
        };
        const float space = wide(" ", nullptr);
        for (const char *word = run.text.c_str(), *end = word; *word; word = *end ? end + 1 : end) {
            end = word + std::strcspn(word, " ");
            const float w = wide(word, end);
            const bool last = lines == most;
            if (x > 0 && x + w + (last ? more : 0) > width) {
                if (last) {
                    if (draw) draw->AddText(run.font, size, {at.x + x - space, at.y + y}, run.colour, kMore);
                    return {y + line, lines, true};
                }
                x = 0;
                y += line;
                ++lines;
            }
            if (draw) draw->AddText(run.font, size, {at.x + x, at.y + y}, run.colour, word, end);
            x += w + space;
        }
    }
    return {y + line, lines, false};
}

/// Returns true if a strip is so narrow that its buttons are below the text.
bool buttons_below(float width, float buttons) {
    return width - buttons < ImGui::GetFontSize() * 24;
}

/// Room for text in a strip.
float text_room(float width, float buttons) {
    const float em = ImGui::GetFontSize();
    return std::max(std::floor(width - 2 * kPadding * em - (buttons_below(width, buttons) ? 0 : buttons + em)), em * 8);
}

/// Draws a strip with text runs and buttons (`buttons` pixels wide, drawn by `draw`). The strip has `lines` lines of
/// text, or as many as the runs need; a tooltip shows text that does not fit.
void strip(const char* id, float width, float buttons, const std::vector<Run>& runs, int lines, const auto& draw) {
    const float em = ImGui::GetFontSize(), pad_x = em * kPadding, pad_y = em * 0.35f;
    const bool below = buttons_below(width, buttons);
    const float wrap = text_room(width, buttons);
    const float frame = ImGui::GetFrameHeight();
    const Flowed flowed = lay_out_runs(runs, {}, wrap, lines, nullptr);
    const float text = lines > 0 ? float(lines) * ImGui::GetTextLineHeight() : flowed.height;
    const float gap = em * 0.33f;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::colours().note);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad_x, pad_y));
    ImGui::BeginChild(
        id, {width, (below ? text + gap + frame : std::max(text, frame)) + 2 * pad_y}, false,
        ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = below ? text : std::max(text, frame);
    lay_out_runs(runs, {at.x, at.y + (room - flowed.height) / 2}, wrap, lines, ImGui::GetWindowDrawList());
    ImGui::Dummy({wrap, text});
    if (flowed.cut) wrapped_tooltip(runs.back().text);
    ImGui::SetCursorScreenPos(below ? ImVec2(at.x, at.y + text + gap)
                                    : ImVec2(at.x + width - 2 * pad_x - buttons, at.y));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(em * kGap, gap));
    draw();
    ImGui::PopStyleVar();
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

/// Returns the runs of a preset's note: "3/38  Title  Description."
std::vector<Run> note_runs(std::span<const PresetEntry> sequence, const std::string& key, const std::string& title,
                           const std::string& about) {
    std::vector<Run> runs;
    const auto at = std::ranges::find(sequence, key, &PresetEntry::key);
    if (at != sequence.end())
        runs.push_back(
            {fmt::format("{}/{}", at - sequence.begin() + 1, sequence.size()), ImGui::GetFont(), theme::muted()});
    if (!title.empty()) runs.push_back({title, theme::strong(), theme::text()});
    runs.push_back({about, ImGui::GetFont(), theme::text()});
    return runs;
}

void draw_guide(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width) {
    const GuideNote& guide = state.files.guide;
    if (guide.about.empty() || state.files.hidden_guide == guide.key) return;
    const std::span<const PresetEntry> sequence = open_preset_sequence(state, frame);
    const auto at = std::ranges::find(sequence, guide.key, &PresetEntry::key);
    const bool built_in = at != sequence.end();
    const std::vector<Run> runs = note_runs(sequence, guide.key, guide.title, guide.about);
    const float buttons = built_in ? buttons_width({"Previous", "Next", "Hide"}) : buttons_width({"Hide"});
    // The number of lines is the same for all presets of the sequence, so that the picture keeps its place and size.
    constexpr int kMinLines = 2, kMaxLines = 5;
    int lines = kMinLines;
    for (const PresetEntry& preset : sequence) {
        if (lines >= kMaxLines) break;
        const std::vector<Run> note = note_runs(sequence, preset.key, preset.title, preset.about);
        lines = std::max(lines, lay_out_runs(note, {}, text_room(width, buttons), 0, nullptr).lines);
    }
    strip("guide", width, buttons, runs, std::min(lines, kMaxLines), [&] {
        if (built_in) {
            if (hint_button("Previous", with_key("The preset before this", Command::PreviousPreset),
                            at != sequence.begin()))
                requests.load_preset = neighbour_preset(state, frame, -1);
            ImGui::SameLine();
            if (hint_button("Next", with_key("The preset after this", Command::NextPreset),
                            std::next(at) != sequence.end()))
                requests.load_preset = neighbour_preset(state, frame, +1);
            ImGui::SameLine();
        }
        if (hint_button("Hide", "Until another preset is opened")) state.files.hidden_guide = guide.key;
    });
}

void draw_lost(const EditorFrame& frame, EditorRequests& requests, float width) {
    if (!frame.lost) return;
    const std::string text =
        fmt::format("The last session has unsaved changes: {}, {}.", scene_label(frame.lost->scene), frame.lost->when);
    strip("lost session", width, buttons_width({"Restore", "Discard"}), {{text, ImGui::GetFont(), theme::text()}}, 0,
          [&] {
              if (hint_button("Restore", "Opens its scene with its settings; undo brings back what is shown now"))
                  requests.restore_lost = true;
              ImGui::SameLine();
              if (hint_button("Discard", "Forgets it for good")) requests.discard_lost = true;
          });
}

void draw_saved_scene(const EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width) {
    if (!frame.scene_saved || frame.loading) return;
    const std::string text = fmt::format("{} was saved by another program.", scene_label(state.scene_name));
    strip("saved scene", width, buttons_width({"Reload", "Keep"}), {{text, ImGui::GetFont(), theme::text()}}, 0, [&] {
        if (hint_button("Reload",
                        with_key("Reads it again; camera, settings and selection stay", Command::ReloadScene)))
            requests.reload_scene = true;
        ImGui::SameLine();
        if (hint_button("Keep", "Shows the scene as it was read, until the file is saved once more"))
            requests.keep_scene = true;
    });
}

void draw_reset(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width) {
    if (!frame.driver_reset) return;
    constexpr const char* kText =
        "The graphics driver reset: no picture can be drawn until the program is started again. The settings are still "
        "here.";
    strip("driver reset", width, buttons_width({"Save now", "Save as…"}), {{kText, ImGui::GetFont(), theme::error()}},
          0, [&] {
              if (hint_button("Save now", fmt::format("Writes {}", state.files.preset_path)))
                  requests.save_preset = state.files.preset_path;
              ImGui::SameLine();
              if (hint_button("Save as…", "Under another name"))
                  open_file_dialog(state.files.dialog, FileDialog::Job::SavePreset, state.files.preset_path,
                                   state.files.guide.about);
          });
}

/// Draws a note on the scene with a button that acts on it, until the user hides it or acts.
void draw_scene_note(EditorState& state, const char* id, const std::string& text, const char* action,
                     const char* action_hint, float width, const auto& act) {
    if (state.files.hidden_scene_note == text) return;
    strip(id, width, buttons_width({action, "Hide"}), {{text, ImGui::GetFont(), theme::text()}}, 0, [&] {
        if (hint_button(action, action_hint)) act();
        ImGui::SameLine();
        if (hint_button("Hide", "Until another scene with such a note is opened")) state.files.hidden_scene_note = text;
    });
}

void draw_scene_notes(EditorState& state, const EditorFrame& frame, float width) {
    if (!frame.scene) return;
    CameraSettings& camera = state.settings.camera;
    if (!frame.scene->far_objects.empty() && camera.source == CameraSource::Automatic && camera.index >= 0)
        draw_scene_note(state, "far objects",
                        fmt::format("The first picture frames most of {}: {}.", scene_label(frame.scene->name),
                                    frame.scene->far_objects),
                        "Frame all", "camera.index -1: the whole scene, with what is far", width,
                        [&] { camera = {.index = -1}; });
    const auto up = find_setting("scene.up");
    if (frame.scene->looks_z_up && up && get_value(state.settings, *up) == default_value(*up))
        draw_scene_note(
            state, "up axis",
            fmt::format("{} looks z-up: it is low, and stands on a plane along z.", scene_label(frame.scene->name)),
            "Turn z up", "scene.up z: reads the file again with z upwards", width,
            [&] { set_setting(state.settings, "scene.up", "z"); });
}

}  // namespace

std::span<const PresetEntry> open_preset_sequence(const EditorState& state, const EditorFrame& frame) {
    const bool hard =
        std::ranges::find(frame.hard_cases, state.files.guide.key, &PresetEntry::key) != frame.hard_cases.end();
    return hard ? frame.hard_cases : frame.presets;
}

std::optional<std::string> neighbour_preset(const EditorState& state, const EditorFrame& frame, int step) {
    const std::span<const PresetEntry> sequence = open_preset_sequence(state, frame);
    const int count = int(sequence.size());
    const int at = int(std::ranges::find(sequence, state.files.guide.key, &PresetEntry::key) - sequence.begin());
    const int to = at < count ? at + step : step > 0 ? 0 : count - 1;
    if (to < 0 || to >= count) return {};
    return sequence[std::size_t(to)].key;
}

void draw_notes(EditorState& state, const EditorFrame& frame, EditorRequests& requests, float width) {
    ImGui::BeginGroup();
    draw_reset(state, frame, requests, width);
    draw_lost(frame, requests, width);
    draw_saved_scene(state, frame, requests, width);
    draw_scene_notes(state, frame, width);
    draw_guide(state, frame, requests, width);
    ImGui::EndGroup();
}

}  // namespace si
