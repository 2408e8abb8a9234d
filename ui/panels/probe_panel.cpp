// Panel Pixel: the shadow test of one pixel, step by step.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/advise/fixes.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/settings/param.h"
#include "ui/panels/fixes_table.h"
#include "ui/panels/section_view.h"
#include "ui/scene_view/kernel_marks.h"
#include "ui/state/panels.h"
#include "ui/state/quick_changes.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/changes_text.h"
#include "ui/widgets/quantity_text.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

void row(const char* name, const std::string& value, const char* about = nullptr) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    value_cell(value);
    if (about) plain_tooltip(about);
}

/// Formats a number with a fixed number of digits after the point; never "-0".
std::string fixed(double value, int digits) {
    std::string text = fmt::format("{:.{}f}", value, digits);
    if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
    return text;
}

std::string vec(const glm::dvec3& v, int digits) {
    return fmt::format("({}, {}, {})", fixed(v.x, digits), fixed(v.y, digits), fixed(v.z, digits));
}

bool begin_fitted_table(const char* id, int columns) {
    return ImGui::BeginTable(id, columns, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings);
}

/// Draws a verdict at 1.3 times the usual size, with a chip before it. @param chip colour that the overlay Artefacts
/// gives the pixel's cause; 0: no chip
void verdict(const std::string& text, ImU32 chip) {
    ImGui::PushFont(theme::verdict());
    if (chip) {
        const float em = ImGui::GetFontSize(), side = std::round(em * 0.7f);
        const ImVec2 at = ImGui::GetCursorScreenPos(), lo(at.x, at.y + std::round((em - side) / 2));
        ImGui::GetWindowDrawList()->AddRectFilled(lo, {lo.x + side, lo.y + side}, chip, em * 0.12f);
        ImGui::Dummy({side, em});
        ImGui::SameLine(0, em * 0.35f);
    }
    wrapped_text(text);
    ImGui::PopFont();
}

/// Returns the colour that the overlay Artefacts gives the cause of a pixel's error; 0: it is right.
ImU32 cause_colour(const PixelDiagnosis& d) {
    for (const ArtefactStyle& style : artefact_styles())
        if (style.artefact == d.cause().artefact) return theme::rgb(style.rgb);
    return 0;
}

/// Draws the button that shows or hides the texels around the probed one as quads in the scene.
void slabs_button(Settings& s, const Probe::PerLight& p, MapSize size) {
    if (p.place != MapPlace::Inside || size.shortest() <= 0) return;
    const TexelPlace place{p.light, p.face, (p.texel.x + 0.5) / size.width, (p.texel.y + 0.5) / size.height};
    if (ImGui::Button(shows_quads_at(s, place) ? "Hide stored-depth quads" : "Stored-depth quads here"))
        toggle_quads(s, place);
    plain_tooltip(
        fmt::format("Draw the texels around this one into the scene, each where its stored depth lies\n"
                    "(view.slabs, {} texels across); {} does so for the pixel under the mouse",
                    s.view.slabs_texels, key_text(Command::ToggleDepthQuads)));
}

/// Draws an amount of bias in texels, depth units and metres as one row. @param endless text for an infinite amount
void amount_row(const char* name, const DepthShift& a, const char* about, const char* endless = "infinite") {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    plain_tooltip(about);
    if (!std::isfinite(a.depth)) return right_cell(endless);
    right_cell(digits_text(a.texels));
    right_cell(metres_text(a.metres));
    right_cell(stored_text(a.depth, 3));
}

bool begin_amounts(const char* id) {
    if (!begin_fitted_table(id, 4)) return false;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    for (const char* name : {"texels", "metres", "depth"}) right_cell(name);
    return true;
}

void bias_terms(const BiasBreakdown& a) {
    if (!begin_amounts("terms")) return;
    amount_row("constant", a.amount(a.constant), "bias.constant; 0 where the slope bias is larger");
    amount_row("slope", a.amount(a.slope), "bias.slope times (1 - N·L); 0 where bias.constant is larger");
    if (a.bias_of_kind != 0)
        amount_row("of itself", a.amount(a.bias_of_kind), "Bias that bias.kind itself adds, at any numbers");
    amount_row(
        "normal offset", a.amount(a.normal),
        "Equivalent depth bias of bias.normal, as the look-up moves along the plane: the whole offset over the cosine "
        "of the light's angle, or as bias.normal_by says");
    if (a.raster != 0)
        amount_row(
            "while drawing", a.amount(a.raster),
            "Depth that bias.raster_* add to this plane in the map: the least that a driver may make of them. In maps "
            "of an engine also the way by which its shader moves casters");
    amount_row("equivalent bias in all", a.amount(a.equivalent_depth()),
               "Against acne: it has to be as much as is needed");
    amount_row("needed", a.amount(a.least.total()),
               "Less, and the triangle's plane shadows itself; the sum of the next");
    amount_row("  kernel", a.amount(a.least.kernel),
               "The kernel compares texels around the fragment, where the plane is nearer to the light");
    amount_row("  format", a.amount(a.least.quantum), "One step of the depth format");
    amount_row("  sub-pixel", a.amount(a.least.snapping), "The rasteriser snaps corners to parts of a texel");
    amount_row("  rounding", a.amount(a.least.rounding), "Shaders compute in single precision");
    ImGui::EndTable();
}

void depths(const Probe::PerLight& p) {
    if (!begin_fitted_table("depths", 2)) return;
    const auto depth = [](double raw, double linear, double metres) {
        return fmt::format("{:.7f}   linear {:.5f}   {}", raw, linear, metres_text(metres));
    };
    row("stored depth", depth(p.stored, p.stored_linear, p.stored_m),
        "Nearest texel: as stored, from 0 at the near to 1 at the far plane, metres along the light's axis");
    row("own depth", depth(p.own, p.own_linear, p.account.receiver.own_m), "Before any bias");
    row("compared depth", fmt::format("{:.7f}", p.compared),
        p.account.per_texel
            ? "Own depth after bias and normal offset; each texel is compared with the plane at its centre"
            : "Own depth after bias and normal offset");
    row("nearer by", metres_text(p.gap_m), "Distance of the stored surface from this one, along the light's ray");
    row("visibility", fmt::format("{:.4f}", p.visibility),
        "Result of the renderer's filter and contact shadows: 1 lit, 0 in shadow");
    const KernelFacts& k = p.kernel;
    if (!std::isnan(k.blocker_m))
        row("occluder", fmt::format("{} nearer", metres_text(k.blocker_m)),
            "Mean distance of the blockers that the kernel's search found, along the light's axis");
    if (!std::isnan(k.penumbra_texels))
        row("penumbra", fmt::format("{} wide   {}", texels_text(k.penumbra_texels), metres_text(p.penumbra_m())),
            "As wide as the light's size and the occluder's distance ask for, within the kernel's limits");
    if (!std::isnan(k.variance))
        row("variance", stored_text(k.variance, 3) + " of the range squared",
            "Of the depths about the texel, by the map's moments; the bound of the visibility comes from it");
    for (const std::string& line : k.lines)
        row("moments", line, "Moments that the kernel read, their meaning, and the bound by them");
    ImGui::EndTable();
}

void space(const Probe::PerLight& p) {
    if (!begin_fitted_table("space", 2)) return;
    const LightReceiver& r = p.account.receiver;
    row("light clip space", fmt::format("({:.5f}, {:.5f}, {:.5f}, {:.5f})", r.clip.x, r.clip.y, r.clip.z, r.clip.w),
        "Position times the light's view and projection");
    row("divided by w", vec(r.ndc, 5));
    row("map coordinates and depth", vec(r.uvd, 5), "From clip range to [0,1]");
    row("place in the map", std::string(place_name(p.place)));
    row("texel", fmt::format("{}, {}   {} wide", p.texel.x, p.texel.y, metres_text(r.texel_m)));
    row("N·L", fmt::format("{:.5f}   {:.1f}°", r.n_dot_l, p.account.theta_rad * 180 / M_PI),
        "Of the triangle's normal; the angle between it and the light");
    row("bias", fmt::format("{} of depth   {}   {}", stored_text(r.bias_depth, 3), texels_text(p.bias_texels),
                            metres_text(r.bias_m)));
    row("normal offset", metres_text(r.normal_offset_m));
    ImGui::EndTable();
}

/// Draws the bias on a line of texels, between the needed one and the largest one that keeps the shadow.
void window_bar(const PixelDiagnosis& d) {
    const float em = ImGui::GetFontSize(), width = em * 20, high = em * 0.7f;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const double finite = std::isfinite(d.occluder.texels) ? d.occluder.texels : 0;
    const double most = 1.25 * std::max({d.least.texels, d.has.texels, finite, 1e-6});
    const auto x = [&](double texels) { return at.x + width * float(std::clamp(texels / most, 0.0, 1.0)); };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + high}, theme::well());
    const float from = x(d.least.texels), to = std::isfinite(d.occluder.texels) ? x(d.occluder.texels) : at.x + width;
    if (to > from) list.AddRectFilled({from, at.y}, {to, at.y + high}, IM_COL32(0, 158, 115, 200));
    if (to < from) list.AddRectFilled({to, at.y}, {from, at.y + high}, IM_COL32(213, 94, 0, 120));
    const float has = x(d.has.texels);
    list.AddRectFilled({has - em * 0.08f, at.y - em * 0.12f}, {has + em * 0.08f, at.y + high + em * 0.12f},
                       theme::text());
    ImGui::Dummy({width, high});
    plain_tooltip(
        "Green: every bias that is right here, from the least that this surface needs to the surface\n"
        "that shadows it. The mark: the bias that it has. Orange: no bias is right.");
}

void reference_column(const PixelDiagnosis& d) {
    window_bar(d);
    if (begin_amounts("window")) {
        amount_row("needed", d.least, "The window of right depth biases begins here");
        amount_row("have", d.has, "Equivalent depth bias of all bias, against acne");
        amount_row("shift towards the light", d.shift, "Shift of the compared depth towards the light by bias");
        amount_row("occluder", d.occluder, "To the surface nearest the light, traced: this much bias loses its shadow",
                   "none");
        ImGui::EndTable();
    }
    std::string reference = d.reference.lit ? "reference: lit" : "reference: in shadow";
    if (d.reference.share > 0 && d.reference.share < 1)
        reference += fmt::format(", {:.1f} % of the light is seen (light.size)", 100 * d.reference.share);
    ImGui::TextUnformatted(reference.c_str());
}

/// Draws the fix of the probed pixel: a button once a tried change is one, else the state of the search.
void fix_line(EditorState& state, const EditorFrame& frame) {
    const FixSearch& search = frame.pixel_fixes;
    if (const Trial* fix = found_fix(search, state.probe_pixel)) {
        const std::string name = fmt::format("Fix: {}", fix->candidate.shown_name());
        const bool fits = text_width(name, ImGui::GetFont()) + 2 * ImGui::GetStyle().FramePadding.x <=
                          ImGui::GetContentRegionAvail().x;
        if (ImGui::SmallButton(fits ? name.c_str() : "Apply the fix")) return apply_trial(state, *fix);
        const std::string text = changes_list(fix->candidate.settings, fix->changes);
        plain_tooltip(fmt::format(
            "{}Tried: this pixel gets visibility {:.2f}, {:.2f} is right; {} px are wrong then, {} "
            "now.\nKey {}; {} takes it back",
            text, fix->pixel ? fix->pixel->visibility : 0, fix->pixel ? fix->pixel->reference : 0,
            wrong_pixels(fix->metrics), search.table->wrong, key_text(Command::ApplyFix), key_text(Command::Undo)));
        if (!fits) wrapped_text(name);
        if (const std::string engine = engine_changes_text(fix->changes); !engine.empty())
            ImGui::TextDisabled("%s", engine.c_str());
    } else if (search.running) {
        ImGui::TextDisabled("trying %s...", search.running->about.c_str());
    } else if (search.table && search.current && search.pixel == state.probe_pixel) {
        ImGui::TextDisabled("No fix among %zu changes that were tried", search.table->drawn());
    }
}

void classification(const Probe::PerLight& p, const PixelDiagnosis* d, EditorState& state, const EditorFrame& frame) {
    verdict(d ? d->verdict : p.verdict, d ? cause_colour(*d) : 0);
    if (d)
        help_text(p.verdict);
    else if (frame.tracing_probe)
        ImGui::TextUnformatted("Tracing the reference … The verdict by the map alone is above.");
    if (d && d->wants_fix() && p.light == shown_light(state.settings)) fix_line(state, frame);
}

/// Layout of blocks in columns, as many as fit into the width.
class BlockFlow {
public:
    void block(float width, const auto& draw) {
        const float gap = ImGui::GetFontSize() * 1.4f;
        if (used_ > 0 && used_ + gap + width <= room_) {
            ImGui::SameLine(0, gap);
            used_ += gap + width;
        } else {
            used_ = width;
        }
        ImGui::BeginGroup();
        const float from = ImGui::GetCursorPosX();
        draw();
        ImGui::SetCursorPosX(from);
        ImGui::Dummy({width, 0});  // reserves the block's full width
        ImGui::EndGroup();
    }

private:
    float room_ = ImGui::GetContentRegionAvail().x, used_ = 0;
};

/// Returns the diagnosis of one light at the probed pixel; null: not known yet.
const PixelDiagnosis* diagnosis_of(const EditorFrame& frame, int light) {
    const auto at = std::ranges::find(frame.diagnoses, light, &PixelDiagnosis::light);
    return at == frame.diagnoses.end() ? nullptr : &*at;
}

/// Draws fixes, kernel taps and, folded, all numbers that the verdict depends on.
void reasons(EditorState& state, const EditorFrame& frame, const Probe::PerLight& p) {
    const PixelDiagnosis* const d = diagnosis_of(frame, p.light);
    // Fixes belong to the light whose shadows are measured.
    if (d && d->wants_fix() && p.light == state.settings.view.light) {
        if (ImGui::Button("More fixes…")) open_improve(state, ImproveMode::Pixel);
        plain_tooltip("Draws and measures each change that may put this pixel right: tab Improve");
        same_line_if_fits(button_width("Hide stored-depth quads"));
    }
    slabs_button(state.settings, p, frame.result ? frame.result->map_size : MapSize());
    const float em = ImGui::GetFontSize();
    BlockFlow blocks;
    blocks.block(em * 15, [&] {
        draw_tap_grid(p, em * 7.5f);
        ImGui::SameLine();
        draw_tap_key();
    });
    if (state.probe_panel.lists_numbers) ImGui::SetNextItemOpen(true);
    ImGui::PushFont(theme::strong());
    const bool open = ImGui::CollapsingHeader("Numbers");
    if (ImGui::IsItemToggledOpen()) state.probe_panel.lists_numbers = open;
    ImGui::PopFont();
    if (!open) return;
    BlockFlow numbers;
    // A diagnosis that is still to come keeps its place, so that the blocks after it do not move.
    if (!d && frame.tracing_probe)
        numbers.block(em * 20, [] { ImGui::TextDisabled("Needed bias, have, occluder: being traced …"); });
    if (d && d->reference.state == PixelState::Counted) numbers.block(em * 20, [&] { reference_column(*d); });
    if (faces_light(p.account.receiver.n_dot_l)) numbers.block(em * 20, [&] { bias_terms(p.account); });
    numbers.block(em * 33, [&] { depths(p); });
    numbers.block(em * 36, [&] { space(p); });
}

/// Draws the verdict of one light's shadow test.
void heading(EditorState& state, const EditorFrame& frame, const Probe::PerLight& p) {
    if (p.casts) return classification(p, diagnosis_of(frame, p.light), state, frame);
    verdict(
        p.verdict.empty() ? fmt::format("{} casts no shadow: lit.", light_title(state.settings, p.light)) : p.verdict,
        0);
}

bool has_section(const Sections& sections, std::size_t light) {
    return sections && light < sections->size() && (*sections)[light].shadowed;
}

/// Returns the width of the drawing left of the verdict, pixels; 0: the panel is too narrow for both.
float section_width(const Sections& sections, std::size_t light, float room) {
    const float em = ImGui::GetFontSize();
    if (!has_section(sections, light) || room < em * 58) return 0;
    return std::clamp(0.42f * room, em * 28, em * 56);
}

/// Draws the cross-section of the light whose shadows are measured. A click makes it as large as the window.
void first_section(EditorState& state, const EditorFrame& frame, std::size_t light, ImVec2 size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_section_view(state.probe_panel.section_views, frame.sections, light, size);
    state.shots.drawing_rect = {{at.x, at.y}, {size.x, size.y}};
    if (ImGui::IsItemClicked()) toggle_maximised(state, Panel::Inspector);
    if (!ImGui::BeginPopupContextItem("drawing")) return;
    if (ImGui::MenuItem(state.window.maximised ? "Small again (click)" : "As large as the window (click)"))
        toggle_maximised(state, Panel::Inspector);
    if (ImGui::MenuItem("Save the drawing (PNG and SVG)")) state.shots.next = Shot::Drawing;
    ImGui::EndPopup();
}

}  // namespace

void draw_probe(EditorState& state, const EditorFrame& frame) {
    if (!state.probe_pixel)
        return ImGui::TextDisabled("Click a surface in the scene to see its shadow test written out.");
    const Probe* probe = frame.probe;
    if (frame.anchor_place == AnchorPlace::Outside)
        return ImGui::TextDisabled("The probed point lies outside of the picture: move the camera, or click another.");
    const glm::ivec2 wanted = *state.probe_pixel;
    if (!probe) return ImGui::TextDisabled("Pixel %d, %d: its shadow test is being read …", wanted.x, wanted.y);
    const bool earlier = !state.probe_anchor && glm::ivec2(probe->x, probe->y) != wanted;
    if (earlier) ImGui::Text("Pixel %d, %d is being read … Below is the pixel before.", wanted.x, wanted.y);
    const Greyed greyed(earlier);
    if (!probe->hit) return ImGui::Text("Pixel %d, %d: background.", probe->x, probe->y);
    const bool hidden = frame.anchor_place == AnchorPlace::Hidden;
    const std::string where =
        fmt::format("{}Pixel {}, {}   {}", hidden ? "Hidden, in its place:   " : "", probe->x, probe->y, probe->object);
    ImGui::TextDisabled("%s", beginning_that_fits(where, ImGui::GetContentRegionAvail().x, ImGui::GetFont()).c_str());
    wrapped_tooltip(
        fmt::format("{}\nposition {} m\nnormal {}", where, vec(probe->position_ws, 4), vec(probe->normal_ws, 4)));
    if (frame.result && frame.result->contacts_darkened)
        help_text("Dark creases are a drawing style (view.look), not a shadow.");
    if (probe->lights.empty()) return;
    // The light whose shadows are measured comes first: its drawing and, next to it, its verdict, which do not scroll.
    const std::size_t first =
        std::clamp<std::size_t>(std::size_t(std::max(state.settings.view.light, 0)), 0, probe->lights.size() - 1);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float drawn = section_width(frame.sections, first, room.x);
    if (drawn > 0) {
        first_section(state, frame, first, {drawn, std::min(room.y, 0.75f * drawn)});
        ImGui::SameLine(0, ImGui::GetFontSize());
        ImGui::BeginGroup();
    }
    ImGui::PushID(probe->lights[first].light);
    heading(state, frame, probe->lights[first]);
    ImGui::PopID();
    ImGui::BeginChild("reasons");
    for (std::size_t k = 0; k < probe->lights.size(); ++k) {
        const std::size_t i = k == 0 ? first : k <= first ? k - 1 : k;
        const Probe::PerLight& light = probe->lights[i];
        ImGui::PushID(light.light);
        const float em = ImGui::GetFontSize(), width = std::min(ImGui::GetContentRegionAvail().x, em * 56);
        if (k > 0) {
            ImGui::Separator();
            heading(state, frame, light);
        }
        if (has_section(frame.sections, i) && width >= em * 12) {
            const ImVec2 size(width, std::min(0.75f * width, em * 20));
            if (k > 0)
                draw_section_view(state.probe_panel.section_views, frame.sections, i, size);
            else if (drawn <= 0)
                first_section(state, frame, i, size);
        }
        if (light.casts) reasons(state, frame, light);
        ImGui::PopID();
    }
    ImGui::EndChild();
    if (drawn > 0) ImGui::EndGroup();
}

}  // namespace si
