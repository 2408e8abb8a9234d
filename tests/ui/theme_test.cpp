// Tests of theme colours: different marks differ in hue, and so do colour scales.
#include "ui/widgets/theme.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "shaders/shared/colours.h"

namespace si {
namespace {

double linear(unsigned c) {
    const double v = c / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* (D65).
glm::dvec3 lab(ImU32 c) {
    const glm::dvec3 rgb(linear(c & 255), linear(c >> 8 & 255), linear(c >> 16 & 255));
    const glm::dvec3 xyz(glm::dot(rgb, {0.4124, 0.3576, 0.1805}) / 0.9505, glm::dot(rgb, {0.2126, 0.7152, 0.0722}),
                         glm::dot(rgb, {0.0193, 0.1192, 0.9505}) / 1.0890);
    glm::dvec3 f;
    for (int i = 0; i < 3; ++i) f[i] = xyz[i] > 0.008856 ? std::cbrt(xyz[i]) : 7.787 * xyz[i] + 16 / 116.0;
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

TEST(Theme, DifferentMarksHaveDifferentColours) {
    const std::map<std::string, ImU32> marks = {
        {"light", theme::kLight},   {"lit", theme::kLit},       {"shadowed", theme::kShadowed},
        {"offset", theme::kOffset}, {"linked", theme::kLinked}, {"probed", theme::kProbed},
        {"frozen", theme::kFrozen}, {"live", theme::kLive},     {"selected", theme::kSelected}};
    for (auto a = marks.begin(); a != marks.end(); ++a)
        for (auto b = std::next(a); b != marks.end(); ++b)
            EXPECT_GT(glm::distance(lab(a->second), lab(b->second)), 22) << a->first << " and " << b->first;
}

/// Returns the pixels that letters of a font cover. Widths do not tell weights apart, since they are whole pixels.
double coverage(const ImFont* font) {
    unsigned char* alpha = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&alpha, &width, &height);
    double sum = 0;
    for (const char letter : std::string_view("Correctlydark")) {
        const ImFontGlyph& g = *font->FindGlyph(ImWchar(letter));
        for (int y = int(g.V0 * float(height)); y < int(g.V1 * float(height)); ++y)
            for (int x = int(g.U0 * float(width)); x < int(g.U1 * float(width)); ++x)
                sum += alpha[std::size_t(y) * std::size_t(width) + std::size_t(x)] / 255.0;
    }
    return sum;
}

// Verdict, heading, value and help differ by more than grey.
TEST(Theme, RolesOfTextDifferBySizeOrWeight) {
    for (const float scale : {1.0f, 1.5f, 2.0f}) {
        ImGui::CreateContext();
        theme::load_fonts(scale);
        ASSERT_TRUE(ImGui::GetIO().Fonts->Build());  // sizes are known from then on
        const float body = ImGui::GetIO().Fonts->Fonts[0]->FontSize;
        EXPECT_NEAR(theme::verdict()->FontSize / body, 1.3, 0.05);
        EXPECT_GT(theme::verdict()->FontSize, theme::heading()->FontSize);
        EXPECT_GT(theme::heading()->FontSize, body);
        EXPECT_EQ(theme::value()->FontSize, body);
        EXPECT_LT(theme::small()->FontSize, body);
        ImFont* const regular = ImGui::GetIO().Fonts->Fonts[0];
        EXPECT_GT(coverage(theme::value()), 1.02 * coverage(regular)) << "a weight between regular and bold";
        EXPECT_LT(coverage(theme::value()), coverage(theme::strong()));
        ImGui::DestroyContext();
    }
}

TEST(Theme, ColoursOfShadersArriveUnchanged) {
    EXPECT_EQ(theme::colour({1, 0, 0.5}), IM_COL32(255, 0, 128, 255));
    // Colours run from dark to bright, also in grey.
    EXPECT_LT(lab(theme::colour(shared::SEQUENTIAL_LOW)).x, 25);
    EXPECT_GT(lab(theme::colour(shared::SEQUENTIAL_HIGH)).x, 80);
    EXPECT_GT(lab(theme::colour(shared::DIVERGING_MIDDLE)).x, lab(theme::colour(shared::DIVERGING_HIGH)).x + 30);
    EXPECT_GT(lab(theme::colour(shared::DIVERGING_MIDDLE)).x, lab(theme::colour(shared::DIVERGING_LOW)).x + 30);
}

/// Relative luminance (WCAG 2.2).
double luminance(const glm::dvec3& rgb) {
    const auto part = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return glm::dot(glm::dvec3(part(rgb.r), part(rgb.g), part(rgb.b)), {0.2126, 0.7152, 0.0722});
}

double contrast(const glm::dvec3& a, const glm::dvec3& b) {
    const double x = luminance(a), y = luminance(b);
    return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

/// Blends a colour over an opaque one, not in linear light. @param alpha opacity of the whole
glm::dvec3 blended_over(const ImVec4& colour, const glm::dvec3& ground, double alpha = 1) {
    return glm::mix(ground, glm::dvec3(colour.x, colour.y, colour.z), colour.w * alpha);
}
glm::dvec3 blended_over(ImU32 colour, const glm::dvec3& ground) {
    return blended_over(ImGui::ColorConvertU32ToFloat4(colour), ground);
}

class ThemeContrast : public testing::TestWithParam<bool> {
protected:
    ThemeContrast() {
        ImGui::CreateContext();
        theme::apply_style(1);
        theme::set_light(GetParam());
    }
    ~ThemeContrast() override {
        theme::set_light(false);
        ImGui::DestroyContext();
    }
    static void expect(const std::string& what, const glm::dvec3& text, const glm::dvec3& ground) {
        EXPECT_GE(contrast(text, ground), 4.5) << what;
    }
};

TEST_P(ThemeContrast, TextIsReadableOnItsBackgrounds) {
    const theme::Colours& c = theme::colours();
    const glm::dvec3 none(0), panel = blended_over(c.panel, none);
    const std::map<std::string, ImU32> texts = {
        {"text", c.text}, {"muted", c.muted}, {"accent", c.accent}, {"error", c.error}, {"warning", c.warning}};
    const std::map<std::string, ImU32> grounds = {
        {"panel", c.panel}, {"popup", c.popup}, {"title", c.title}, {"well", c.well}, {"note", c.note}};
    for (const auto& [text, colour] : texts)
        for (const auto& [ground, under] : grounds)
            expect(text + " on " + ground, blended_over(colour, none), blended_over(under, panel));
    expect("faint on panel", blended_over(c.faint, none), panel);
    expect("text on a progress bar", blended_over(c.text, none), blended_over(c.done, none));
}

TEST_P(ThemeContrast, WidgetsAreReadableInAllStates) {
    const ImVec4* c = ImGui::GetStyle().Colors;
    const theme::Colours& t = theme::colours();
    const glm::dvec3 panel = blended_over(t.panel, glm::dvec3(0));
    for (const ImGuiCol state :
         {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive, ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered,
          ImGuiCol_FrameBgActive, ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive, ImGuiCol_Tab,
          ImGuiCol_TabHovered, ImGuiCol_TabActive, ImGuiCol_TableHeaderBg, ImGuiCol_TextSelectedBg, ImGuiCol_PopupBg})
        expect(ImGui::GetStyleColorName(state), blended_over(c[ImGuiCol_Text], panel), blended_over(c[state], panel));
    // WCAG 2.2, 1.4.11: parts that identify a control.
    for (const ImGuiCol mark : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
        EXPECT_GE(contrast(blended_over(c[mark], panel), blended_over(c[ImGuiCol_FrameBg], panel)), 3)
            << ImGui::GetStyleColorName(mark);
    // Pressed switches and changed values.
    expect("accent on a pressed button", blended_over(t.accent, panel), blended_over(c[ImGuiCol_ButtonActive], panel));
    const double faded = ImGui::GetStyle().DisabledAlpha;
    for (const ImGuiCol state : {ImGuiCol_Button, ImGuiCol_FrameBg}) {
        const glm::dvec3 ground = blended_over(c[state], panel, faded);
        expect(std::string("disabled ") + ImGui::GetStyleColorName(state),
               blended_over(c[ImGuiCol_Text], ground, faded), ground);
    }
}

TEST_P(ThemeContrast, LabelsAreReadableOnAnyPicture) {
    for (const double picture : {0.0, 1.0})
        for (const ImU32 label :
             {theme::kOnPicture, theme::kMutedOnPicture, theme::kWarningOnPicture, theme::kLight, theme::kFrozen}) {
            const glm::dvec3 ground = blended_over(theme::kVeil, glm::dvec3(picture));
            expect("on a picture", blended_over(label, ground), ground);
        }
}

INSTANTIATE_TEST_SUITE_P(, ThemeContrast, testing::Values(false, true),
                         [](const auto& shown) { return shown.param ? "Light" : "Dark"; });

}  // namespace
}  // namespace si
