// Harness for panels: made-up frames, synthetic input, ImGui without a backend.
#include "tests/ui/ui_harness.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <tuple>

#include "renderer/bundle/imported_maps.h"
#include "renderer/frame/pane_grid.h"
#include "renderer/scenes/builtin.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/text.h"
#include "tests/ui/screen.h"
#include "ui/widgets/theme.h"

namespace si::test {

FrameResult made_up_frame(const Scene& scene, const Settings& settings) {
    FrameResult r;
    r.camera = make_camera(scene, settings, 1.5);
    r.lights = fit_lights(scene, settings, &r.camera);
    r.colour = r.map_view = {1, 600, 400};
    const std::array overlays = {settings.view.overlay, settings.view.overlay_2, settings.view.overlay_3,
                                 settings.view.overlay_4};
    const int count = pane_grid(settings.view.panes, 1, 1).count();
    for (int i = 0; i < count; ++i) r.panes.push_back({{1, 600, 400}, {}, overlays[std::size_t(i)], 0, 1});
    r.map_resolution = settings.map.resolution;
    r.map_size = settings.map.resolution;
    r.map_view_size = glm::ivec2(settings.map.resolution);
    if (!r.lights.empty() && !r.lights[0].views.empty()) r.map_view_curve = r.lights[0].views[0].curve;
    r.map_black = float(settings.view.map_black);
    r.map_white = float(settings.view.map_white);
    r.passes = {{"shadow map 0", PassState::Drawn, "its inputs changed", 1.5, 0.2, 12, 34567},
                {"visibility", PassState::Skipped, "no pass reads it", 0, 0, 0, 0},
                {"shading", PassState::Cached, "unchanged since frame 12", 0, 0, 0, 0}};
    r.notes = {"view.light was clamped"};
    r.clock = "a made-up clock";
    return r;
}

Probe made_up_probe(int lights) {
    Probe p;
    p.hit = true;
    p.x = 12;
    p.y = 34;
    p.object = "Root/Box";
    for (int i = 0; i < lights; ++i) {
        Probe::PerLight l;
        l.light = i;
        l.casts = i != 1;
        l.texel = {5, 7};
        l.place = MapPlace::Inside;
        l.account.receiver.n_dot_l = 0.6;
        l.taps_first = {4, 6};
        l.taps_size = {2, 2};
        for (const glm::ivec2 t : {glm::ivec2(4, 6), {5, 6}, {4, 7}, {5, 7}})
            l.taps.push_back(
                {.texel = t, .weight = 0.25, .stored = 0.4, .lit = t.x == 5, .meets = KernelTap::Meets::Own});
        l.verdict = "in shadow: its texel stores a surface 0.2 m nearer to the light";
        p.lights.push_back(l);
    }
    return p;
}

UiHarness::UiHarness(int width, int height, float scale) : width_(width), height_(height) {
    state.layout = kWideLayout;
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.MousePos = {-FLT_MAX, -FLT_MAX};
    // The clipboard is private; keys have ASCII codes, as from the window backend.
    static std::string clipboard;
    io.SetClipboardTextFn = [](void*, const char* text) { clipboard = text; };
    io.GetClipboardTextFn = [](void*) { return clipboard.c_str(); };
    for (int key = ImGuiKey_Tab; key <= ImGuiKey_KeyPadEnter; ++key) io.KeyMap[key] = 256 + key;
    for (const auto& [key, code] : {std::pair<int, int>{ImGuiKey_A, 'A'}, {ImGuiKey_Y, 'Y'}, {ImGuiKey_Z, 'Z'}})
        io.KeyMap[key] = code;
    theme::load_fonts(scale);
    theme::apply_style(scale);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    drawn_.emplace();
    scene = load_scene(builtin_scenes().front().key);
    state.scene_name = builtin_scenes().front().key;
    state.history.reset(state.settings);
    driver_.renderer = "made-up driver";
    driver_.software = true;
}

UiHarness::~UiHarness() {
    ImGui::DestroyContext();
}

EditorRequests UiHarness::frame() {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(width_), float(height_)};
    io.DeltaTime = float(frame_seconds);
    result_ = made_up_frame(scene, frame_settings.value_or(state.settings));
    for (FittedLight& light : result_.lights)
        if (maps_imported) light.provider = MapProvider::Imported;
    if (maps_imported)
        result_.imported.assign(result_.lights.size(),
                                imported_maps({FloatImage{1, 1, 1, {0}}}, std::nullopt, {}, false));
    effects_ = frame_effects(scene, frame_settings.value_or(state.settings), result_, state.effects.forced);
    probe_ = made_up_probe(state.settings.light_count);
    probe_.object = probed_object;
    if (state.probe_pixel) {
        probe_.x = state.probe_pixel->x;
        probe_.y = state.probe_pixel->y;
    }
    EditorFrame facts;
    facts.loading = loading;
    facts.importing = importing;
    facts.drawing = drawing;
    facts.desktop_dialogs = desktop_dialogs;
    if (sweep) facts.sweep = &*sweep;
    facts.presets = presets;
    facts.hard_cases = hard_cases;
    facts.recent_scenes = recent_scenes;
    facts.recent_presets = recent_presets;
    facts.comparison = comparison ? &*comparison : nullptr;
    facts.lost = lost;
    facts.scene_saved = scene_saved;
    if (with_facts) {
        facts.result = &result_;
        facts.scene = &scene;
        facts.driver = &driver_;
        facts.reference = reference;
        facts.error = error ? &*error : nullptr;
        facts.earlier_error = earlier_error ? &*earlier_error : nullptr;
        facts.picture_comparison = picture_comparison;
        if (state.probe_pixel) facts.probe = &probe_;
        if (map_facts) facts.map_facts = &*map_facts;
        facts.lost_casters = lost_casters;
        if (facts.probe) facts.diagnoses = diagnoses;
        facts.sections = sections;
        facts.tracing_probe = tracing_probe;
        facts.verdict_follows = verdict_follows;
        facts.tuning = tuning;
        facts.tuned = &tuned;
        facts.tuned_current = tuned_current;
        facts.fixes = facts.pixel_fixes = fixes;
        static_cast<EffectsFacts&>(facts) = effects;
        if (effects.effects.empty()) facts.effects = effects_;
        static_cast<ImproveFacts&>(facts) = advice;
        static_cast<LabFacts&>(facts) = lab;
        static_cast<LightStripFacts&>(facts) = light_strip;
        facts.report = report;
        facts.conversion = conversion ? &*conversion : nullptr;
        facts.health = health;
        static_cast<ImportedFacts&>(facts) = imported;
        facts.memory = memory;
        facts.driver_reset = driver_reset;
    }
    ImGui::NewFrame();
    EditorRequests requests = draw_editor(state, facts);
    ImGui::Render();
    EXPECT_EQ(drawn_->fault(), "");
    if (requests.tune || requests.cancel_tune || requests.find_fixes || requests.cancel_fixes ||
        requests.forget_fixes || requests.cancel_pixel_fixes || requests.forget_pixel_fixes ||
        requests.measure_saved_times || requests.cancel_measuring || requests.find_advice || requests.cancel_advice ||
        requests.find_waste || requests.cancel_waste || requests.compare_pipelines || requests.measure_shimmer)
        last_requests = requests;
    io.MouseWheel = 0;
    return requests;
}

EditorRequests UiHarness::frames(int count) {
    EditorRequests last;
    for (int i = 0; i < count; ++i) last = frame();
    return last;
}

void UiHarness::move(glm::vec2 to) {
    ImGui::GetIO().MousePos = {to.x, to.y};
}
void UiHarness::press(bool down, int button) {
    ImGui::GetIO().MouseDown[button] = down;
}

void UiHarness::click(glm::vec2 at, int button) {
    drag(at, at, button);
}

void UiHarness::click(std::optional<glm::vec2> widget, int button, Caller caller) {
    if (widget) return click(*widget, button);
    ADD_FAILURE_AT(caller.file, caller.line) << "not on the screen: " << sought_;
}

EditorRequests UiHarness::click_here() {
    press(true);
    frame();
    press(false);
    return frame();
}

EditorRequests UiHarness::key(int code) {
    ImGui::GetIO().KeysDown[code] = true;
    const EditorRequests requests = frame();
    ImGui::GetIO().KeysDown[code] = false;
    frame();
    return requests;
}

void UiHarness::drag(glm::vec2 from, glm::vec2 to, int button) {
    move(from);
    frames(2);
    press(true, button);
    frame();
    for (int i = 1; i <= 4; ++i) {
        move(glm::mix(from, to, float(i) / 4));
        frame();
    }
    press(false, button);
    frames(2);
}

void UiHarness::type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frames(2);
}

std::optional<glm::vec2> UiHarness::find(const std::string& window, const std::string& group,
                                         const std::string& label) {
    const auto found = find(window, [&](ImGuiID seed) {
        if (!group.empty()) seed = ImHashData(group.data(), group.size(), seed);
        return ImHashStr(label.c_str(), 0, seed);
    });
    sought_ = window + " " + group + " " + label;
    return found;
}

std::optional<glm::vec2> UiHarness::find_choice(int value, const std::string& label) {
    return find("##Combo",
                [&](ImGuiID seed) { return ImHashStr(label.c_str(), 0, ImHashData(&value, sizeof value, seed)); });
}

// Keyboard navigation keeps the box of the item that has the focus, also of a clipped one.
ImRect UiHarness::box_of(ImGuiWindow* window, ImGuiID id) {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    const auto before = std::tuple(g.NavWindow, g.NavId, g.NavLayer, g.NavFocusScopeId, g.NavIdIsAlive);
    ImRect box;
    std::tie(g.NavWindow, g.NavId) = std::tuple(window, id);
    frame();
    if (g.NavIdIsAlive && g.NavId == id) {
        box = window->NavRectRel[g.NavLayer];
        box.Translate(window->DC.CursorStartPos);
    }
    std::tie(g.NavWindow, g.NavId, g.NavLayer, g.NavFocusScopeId, g.NavIdIsAlive) = before;
    return box;
}

std::optional<glm::vec2> UiHarness::find(const std::string& window, const std::function<unsigned(unsigned)>& id) {
    frames(2);
    sought_ = window;
    std::vector<std::pair<ImGuiWindow*, ImRect>> windows;
    for (ImGuiWindow* w : ImGui::GetCurrentContext()->Windows)
        if (w->WasActive && std::string_view(w->Name).find(window) != std::string_view::npos)
            windows.emplace_back(w, w->InnerClipRect);
    for (const auto& [w, rect] : windows) {
        const unsigned wanted = id(w->ID);
        // Navigation knows no box of some widgets, such as rows of lists, and moving it to a popup closes the popup:
        // the mouse then visits the whole window.
        const bool is_popup = w->Flags & ImGuiWindowFlags_Popup;
        const ImRect known = is_popup ? ImRect() : box_of(w, wanted);
        const ImRect box = known.GetArea() > 0 ? known : rect;
        for (float y = rect.Min.y + 3; y < std::min(rect.Max.y, box.Max.y); y += 7)
            for (float x = rect.Min.x + 5; x < std::min(rect.Max.x, box.Max.x); x += 16) {
                if (x < box.Min.x || y < box.Min.y) continue;
                move({x, y});
                frame();
                if (hovered() == wanted) return glm::vec2(x, y);
            }
    }
    return {};
}

ImGuiWindow* UiHarness::window(std::string_view part_of_name) {
    for (ImGuiWindow* w : ImGui::GetCurrentContext()->Windows)
        if (w->WasActive && std::string_view(w->Name).find(part_of_name) != std::string_view::npos) return w;
    return nullptr;
}

std::string UiHarness::ascii() const {
    std::string out;
    for (const char32_t c : printed()) out += c < 128 ? char(c) : '?';
    return out;
}

std::string UiHarness::lacking(std::initializer_list<std::string_view> parts) const {
    const std::string text = ascii();
    for (const std::string_view part : parts) {
        std::string letters(part);
        std::erase(letters, ' ');
        if (const std::string fault = test::lacking(text, {letters}); !fault.empty()) return fault;
    }
    return {};
}

unsigned UiHarness::hovered() const {
    return ImGui::GetCurrentContext()->HoveredId;
}

}  // namespace si::test
