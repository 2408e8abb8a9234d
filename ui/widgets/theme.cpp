#include "ui/widgets/theme.h"

#include <cmath>

#include "ui/widgets/font_data.h"

namespace si::theme {
namespace {

constexpr float kBodyPixels = 15.0f, kSmallPixels = 13.0f;

// Latin, punctuation, super- and subscripts, arrows, mathematics, geometric shapes. Digits are left out: they are
// added apart, all of one width, so that changing numbers do not jitter.
constexpr ImWchar kLetters[] = {0x20,   0x2f,   0x3a,   0xff,   0x100,  0x17f,  0x370,  0x3ff,  0x2000, 0x2027,
                                0x2070, 0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
constexpr ImWchar kDigits[] = {0x30, 0x39, 0};

void add_font(std::span<const unsigned char> data, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    if (data.empty()) {
        ImFontConfig config;
        config.SizePixels = std::round(pixels);
        atlas.AddFontDefault(&config);
        return;
    }
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 3;
    config.PixelSnapH = true;
    config.RasterizerMultiply = 1.1f;
    void* bytes = const_cast<unsigned char*>(data.data());  // ImGui takes a mutable pointer and only reads
    atlas.AddFontFromMemoryTTF(bytes, int(data.size()), pixels, &config, kLetters);
    config.MergeMode = true;
    config.GlyphMinAdvanceX = config.GlyphMaxAdvanceX = std::round(pixels * 0.53f);
    atlas.AddFontFromMemoryTTF(bytes, int(data.size()), pixels, &config, kDigits);
}

ImVec4 grey(float value, float alpha = 1) {
    return {value, value, value * 1.01f, alpha};
}

}  // namespace

void load_fonts(float scale) {
    add_font(regular_font(), std::round(kBodyPixels * scale));
    add_font(strong_font(), std::round(kBodyPixels * scale));
    add_font(regular_font(), std::round(kSmallPixels * scale));
}

ImU32 colour(const glm::vec3& rgb) {
    return ImGui::ColorConvertFloat4ToU32({rgb.r, rgb.g, rgb.b, 1});
}

ImFont* strong() {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    return fonts.Size > 1 ? fonts[1] : fonts[0];
}

ImFont* small() {
    const auto& fonts = ImGui::GetIO().Fonts->Fonts;
    return fonts.Size > 2 ? fonts[2] : fonts[0];
}

void apply(float scale) {
    ImGuiStyle style;
    style.WindowPadding = {10, 8};
    style.FramePadding = {7, 3.5f};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.ScrollbarSize = 11;
    style.GrabMinSize = 8;
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 2;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 6;
    style.TabRounding = 3;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 1;
    style.IndentSpacing = 12;
    style.DisabledAlpha = 0.5f;
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = style.FrameBorderSize = 1;

    ImVec4* c = style.Colors;
    const auto of = ImGui::ColorConvertU32ToFloat4;
    c[ImGuiCol_Text] = of(kText);
    c[ImGuiCol_TextDisabled] = of(kMuted);
    c[ImGuiCol_WindowBg] = c[ImGuiCol_ChildBg] = of(kPanel);
    c[ImGuiCol_PopupBg] = grey(0.165f, 0.985f);
    c[ImGuiCol_Border] = of(kLine);
    c[ImGuiCol_FrameBg] = of(kWell);
    c[ImGuiCol_FrameBgHovered] = grey(0.125f);
    c[ImGuiCol_FrameBgActive] = grey(0.145f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.11f);
    c[ImGuiCol_MenuBarBg] = grey(0.11f);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.30f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.38f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.46f);
    c[ImGuiCol_CheckMark] = grey(0.88f);
    c[ImGuiCol_SliderGrab] = grey(0.31f);
    c[ImGuiCol_SliderGrabActive] = grey(0.42f);
    c[ImGuiCol_Button] = grey(0.205f);
    c[ImGuiCol_ButtonHovered] = grey(0.26f);
    c[ImGuiCol_ButtonActive] = grey(0.32f);
    c[ImGuiCol_Header] = grey(0.21f);
    c[ImGuiCol_HeaderHovered] = grey(0.25f);
    c[ImGuiCol_HeaderActive] = grey(0.29f);
    c[ImGuiCol_Separator] = of(kLine);
    c[ImGuiCol_SeparatorHovered] = c[ImGuiCol_SeparatorActive] = grey(0.45f);
    c[ImGuiCol_ResizeGrip] = grey(0.30f, 0.4f);
    c[ImGuiCol_ResizeGripHovered] = c[ImGuiCol_ResizeGripActive] = grey(0.45f);
    c[ImGuiCol_Tab] = c[ImGuiCol_TabUnfocused] = of(kPanel);
    c[ImGuiCol_TabHovered] = grey(0.27f);
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = grey(0.23f);
    c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = grey(0.7f);
    c[ImGuiCol_TableHeaderBg] = grey(0.165f);
    c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = grey(0.20f);
    c[ImGuiCol_TableRowBg] = grey(0, 0);
    c[ImGuiCol_TableRowBgAlt] = grey(1, 0.018f);
    c[ImGuiCol_TextSelectedBg] = grey(0.42f);
    c[ImGuiCol_NavHighlight] = grey(0.6f);
    c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.45f);
    ImGui::GetStyle() = style;
}

}  // namespace si::theme
