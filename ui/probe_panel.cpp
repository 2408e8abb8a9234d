// The shadow test of one pixel written out, step by step.
#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/theme.h"

namespace si {
namespace {

void row(const char* name, const std::string& value, const char* about = nullptr) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
    if (about && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", about);
}

/// With that many digits after the point; never "-0".
std::string fixed(double value, int digits) {
    std::string text = fmt::format("{:.{}f}", value, digits);
    if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
    return text;
}

std::string vec(const glm::dvec3& v, int digits) {
    return fmt::format("({}, {}, {})", fixed(v.x, digits), fixed(v.y, digits), fixed(v.z, digits));
}

bool begin_steps(const char* id) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
    return ImGui::BeginTable(id, 2, flags);
}

void verdict(const std::string& text) {
    ImGui::PushFont(theme::strong());
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
}

/// Draws the texels around the probed one into the scene, or takes them away.
void slabs_button(Settings& s, const Probe::PerLight& p, int resolution) {
    if (p.where != "inside" || resolution <= 0) return;
    ViewSettings& v = s.view;
    const double u = (p.texel.x + 0.5) / resolution, w = (p.texel.y + 0.5) / resolution;
    const bool here = v.slabs != int(Slabs::None) && v.light == p.light && v.face == p.face && v.slabs_u == u &&
                      v.slabs_v == w;
    if (ImGui::SmallButton(here ? "Hide texel slabs" : "Texel slabs here")) {
        if (here) {
            v.slabs = int(Slabs::None);
        } else {
            if (v.slabs == int(Slabs::None)) v.slabs = int(Slabs::Both);
            v.light = p.light, v.face = p.face;
            v.slabs_u = u, v.slabs_v = w;
        }
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Draw the texels around this one into the scene, each where its stored depth lies\n"
                          "(view.slabs, %d texels across)",
                          v.slabs_texels);
}

void draw_light(const Probe::PerLight& p, Settings& settings, int resolution) {
    if (!p.casts) {
        verdict(p.verdict.empty() ? fmt::format("Light {} casts no shadow: lit.", p.light) : p.verdict);
        return;
    }
    verdict(p.verdict);
    slabs_button(settings, p, resolution);
    const float width = ImGui::GetContentRegionAvail().x;
    const float em = ImGui::GetFontSize();
    const int columns = width > em * 84 ? 3 : width > em * 54 ? 2 : 1;
    if (!ImGui::BeginTable("blocks", columns, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_NoSavedSettings))
        return;
    ImGui::TableNextColumn();
    if (begin_steps("space")) {
        row("light clip space", fmt::format("({:.5f}, {:.5f}, {:.5f}, {:.5f})", p.clip.x, p.clip.y, p.clip.z, p.clip.w),
            "Position times the light's view and projection");
        row("divided by w", vec(p.ndc, 5));
        row("map coordinates and depth", vec(p.uvd, 5), "From clip range to [0,1]");
        row("place in the map", p.where);
        row("texel", fmt::format("{}, {}   {} wide", p.texel.x, p.texel.y, metres_text(p.texel_m)));
        ImGui::EndTable();
    }
    ImGui::TableNextColumn();
    if (begin_steps("bias")) {
        row("N·L", fmt::format("{:.5f}", p.n_dot_l));
        row("bias",
            fmt::format("{:.3g} of depth   {:.3g} texels   {}", p.bias_depth, p.bias_texels, metres_text(p.bias_m)));
        row("normal offset", metres_text(p.normal_offset_m));
        ImGui::EndTable();
    }
    if (columns == 3) ImGui::TableNextColumn();
    if (begin_steps("depths")) {
        row("stored depth", fmt::format("{:.7f}   {}", p.stored, metres_text(p.stored_m)), "Nearest texel");
        row("own depth", fmt::format("{:.7f}   {}", p.own, metres_text(p.own_m)), "Before any bias");
        row("compared depth", fmt::format("{:.7f}", p.compared), "Own depth after bias");
        row("own - stored", metres_text(p.own_m - p.stored_m));
        row("visibility", fmt::format("{:.4f}", p.visibility),
            "What the renderer's filter computed: 1 lit, 0 in shadow");
        ImGui::EndTable();
    }
    ImGui::EndTable();
}

}  // namespace

void draw_probe(EditorState& state, const EditorFrame& frame) {
    if (!state.probe_pixel) {
        ImGui::TextDisabled("Click a surface in the scene to see its shadow test written out.");
        return;
    }
    const Probe* probe = frame.probe;
    if (!probe) {
        ImGui::TextDisabled("Pixel %d, %d", state.probe_pixel->x, state.probe_pixel->y);
        return;
    }
    if (!probe->hit) {
        ImGui::Text("Pixel %d, %d: background.", probe->x, probe->y);
        return;
    }
    const std::string where = fmt::format("Pixel {}, {}   {}   position {} m   normal {}", probe->x, probe->y,
                                          probe->object, vec(probe->position_ws, 4), vec(probe->normal_ws, 4));
    ImGui::TextDisabled("%s", where.c_str());
    for (const Probe::PerLight& light : probe->lights) {
        ImGui::PushID(light.light);
        if (probe->lights.size() > 1) ImGui::Separator();
        draw_light(light, state.settings, frame.result ? frame.result->map_resolution : 0);
        ImGui::PopID();
    }
}

}  // namespace si
