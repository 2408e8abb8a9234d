#include "ui/widgets/theme.h"

#include <cmath>

#include "ui/widgets/font_data.h"

namespace si::theme {
namespace {

constexpr float kBodyPixels = 15.0f, kSmallPixels = 13.0f, kHeadingPixels = 17.0f, kVerdictPixels = 19.5f;

// Latin, punctuation, super- and subscripts, arrows, mathematics, geometric shapes. Digits are added separately with
// one width, so that changing numbers do not jitter.
constexpr ImWchar kLetters[] = {0x20,   0x2f,   0x3a,   0xff,   0x100,  0x17f,  0x370,  0x3ff,  0x2000, 0x2027,
                                0x2070, 0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
constexpr ImWchar kDigits[] = {0x30, 0x39, 0};

void add_font(std::span<const unsigned char> data, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    if (data.empty()) {
        config.SizePixels = std::round(pixels);
        atlas.AddFontDefault(&config);
        return;
    }
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 3;
    config.PixelSnapH = true;
    config.RasterizerMultiply = 1.1f;
    void* bytes = const_cast<unsigned char*>(data.data());  // ImGui takes a mutable pointer but only reads
    atlas.AddFontFromMemoryTTF(bytes, int(data.size()), pixels, &config, kLetters);
    config.MergeMode = true;
    config.GlyphMinAdvanceX = config.GlyphMaxAdvanceX = std::round(pixels * 0.53f);
    atlas.AddFontFromMemoryTTF(bytes, int(data.size()), pixels, &config, kDigits);
}

ImVec4 grey(float value, float alpha = 1) {
    return {value, value, value * 1.01f, alpha};
}

/// Returns a font of load_fonts(); the body font where a context has others.
ImFont* font_at(int index) {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    return fonts[fonts.Size > index ? index : 0];
}

constexpr Colours kDark{.text = IM_COL32(222, 222, 220, 255),
                        .muted = IM_COL32(160, 160, 158, 255),
                        .faint = IM_COL32(142, 142, 141, 255),
                        .panel = IM_COL32(35, 35, 36, 255),
                        .popup = IM_COL32(42, 42, 42, 251),
                        .title = IM_COL32(28, 28, 28, 255),
                        .well = IM_COL32(23, 23, 24, 255),
                        .line = IM_COL32(58, 58, 59, 255),
                        .accent = IM_COL32(232, 200, 128, 255),
                        .error = IM_COL32(240, 126, 112, 255),
                        .warning = IM_COL32(226, 180, 92, 255),
                        .note = IM_COL32(50, 50, 52, 255),
                        .done = IM_COL32(92, 84, 62, 255),
                        .bar = IM_COL32(168, 168, 166, 255)};

constexpr Colours kLightTheme{.text = IM_COL32(26, 26, 27, 255),
                              .muted = IM_COL32(84, 84, 86, 255),
                              .faint = IM_COL32(102, 102, 104, 255),
                              .panel = IM_COL32(238, 238, 236, 255),
                              .popup = IM_COL32(247, 247, 246, 252),
                              .title = IM_COL32(228, 228, 226, 255),
                              .well = IM_COL32(252, 252, 251, 255),
                              .line = IM_COL32(198, 198, 196, 255),
                              .accent = IM_COL32(122, 76, 0, 255),
                              .error = IM_COL32(172, 30, 20, 255),
                              .warning = IM_COL32(130, 78, 0, 255),
                              .note = IM_COL32(224, 224, 220, 255),
                              .done = IM_COL32(222, 204, 158, 255),
                              .bar = IM_COL32(120, 120, 122, 255)};

/// Returns true if the style of the current ImGui context has the light theme's colours.
bool is_light() {
    return ImGui::GetStyle().Colors[ImGuiCol_TitleBg].x > 0.5f;
}

/// Copies the theme's colours into the style of the current ImGui context.
void set_colours(bool is_light) {
    const Colours& theme = colours(is_light);
    const auto by = [is_light](float dark, float light) { return grey(is_light ? light : dark); };
    ImVec4* c = ImGui::GetStyle().Colors;
    const auto of = ImGui::ColorConvertU32ToFloat4;
    c[ImGuiCol_Text] = of(theme.text);
    c[ImGuiCol_TextDisabled] = of(theme.muted);
    c[ImGuiCol_WindowBg] = c[ImGuiCol_ChildBg] = of(theme.panel);
    c[ImGuiCol_PopupBg] = of(theme.popup);
    c[ImGuiCol_Border] = of(theme.line);
    c[ImGuiCol_FrameBg] = of(theme.well);
    c[ImGuiCol_FrameBgHovered] = by(0.125f, 0.95f);
    c[ImGuiCol_FrameBgActive] = by(0.145f, 0.92f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = of(theme.title);
    c[ImGuiCol_MenuBarBg] = of(theme.title);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = by(0.30f, 0.74f);
    c[ImGuiCol_ScrollbarGrabHovered] = by(0.38f, 0.66f);
    c[ImGuiCol_ScrollbarGrabActive] = by(0.46f, 0.58f);
    c[ImGuiCol_CheckMark] = by(0.88f, 0.15f);
    c[ImGuiCol_SliderGrab] = by(0.56f, 0.52f);
    c[ImGuiCol_SliderGrabActive] = by(0.80f, 0.28f);
    c[ImGuiCol_Button] = by(0.205f, 0.87f);
    c[ImGuiCol_ButtonHovered] = by(0.26f, 0.84f);
    c[ImGuiCol_ButtonActive] = by(0.32f, 0.81f);
    c[ImGuiCol_Header] = by(0.21f, 0.86f);
    c[ImGuiCol_HeaderHovered] = by(0.25f, 0.82f);
    c[ImGuiCol_HeaderActive] = by(0.29f, 0.78f);
    c[ImGuiCol_Separator] = of(theme.line);
    c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = by(0.45f, 0.55f);
    c[ImGuiCol_ResizeGrip] = grey(is_light ? 0.6f : 0.30f, 0.4f);
    c[ImGuiCol_ResizeGripHovered] = c[ImGuiCol_ResizeGripActive] = by(0.45f, 0.55f);
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = of(theme.panel);
    c[ImGuiCol_TabHovered] = by(0.27f, 0.82f);
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = by(0.23f, 0.85f);
    c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = by(0.7f, 0.35f);
    c[ImGuiCol_TableHeaderBg] = by(0.165f, 0.90f);
    c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = by(0.20f, 0.82f);
    c[ImGuiCol_TableRowBg] = grey(0, 0);
    c[ImGuiCol_TableRowBgAlt] = is_light ? grey(0, 0.025f) : grey(1, 0.018f);
    c[ImGuiCol_TextSelectedBg] = by(0.36f, 0.78f);
    c[ImGuiCol_NavHighlight] = by(0.6f, 0.4f);
    c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.45f);
}

}  // namespace

void load_fonts(float scale) {
    add_font(regular_font(), std::round(kBodyPixels * scale));
    add_font(strong_font(), std::round(kBodyPixels * scale));
    add_font(regular_font(), std::round(kSmallPixels * scale));
    add_font(strong_font(), std::round(kVerdictPixels * scale));
    add_font(medium_font(), std::round(kHeadingPixels * scale));
    add_font(medium_font(), std::round(kBodyPixels * scale));
}

ImU32 colour(const glm::vec3& rgb) {
    return ImGui::ColorConvertFloat4ToU32({rgb.r, rgb.g, rgb.b, 1});
}

ImFont* strong() {
    return font_at(1);
}

ImFont* small() {
    return font_at(2);
}

ImFont* verdict() {
    return font_at(3);
}

ImFont* heading() {
    return font_at(4);
}

ImFont* value() {
    return font_at(5);
}

void apply_style(float scale) {
    ImGuiStyle style;
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 3.5f};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.ScrollbarSize = 11;
    style.GrabMinSize = 8;
    style.FrameRounding = 3;
    style.GrabRounding = 2;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 6;
    style.TabRounding = 3;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.IndentSpacing = 12;
    style.DisabledAlpha = 0.68f;
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = style.FrameBorderSize = 1;

    ImGui::GetStyle() = style;
    set_colours(false);
}

const Colours& colours(bool light) {
    return light ? kLightTheme : kDark;
}

const Colours& colours() {
    return colours(is_light());
}

void set_light(bool light) {
    if (light != is_light()) set_colours(light);
}

}  // namespace si::theme
