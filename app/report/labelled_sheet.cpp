#include "app/report/labelled_sheet.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "app/report/picture_comparison.h"
#include "ui/widgets/font_data.h"
#include "ui/widgets/text.h"

namespace si {

/// Font atlas of the editor, drawn into images without OpenGL.
class LabelledSheet::Letters {
public:
    Letters() {
        static constexpr ImWchar kEvery[] = {0x20, 0xfffd, 0};
        const std::span<const unsigned char> data = regular_font();
        if (data.empty()) {
            font_ = atlas_.AddFontDefault();
        } else {
            ImFontConfig config;
            config.FontDataOwnedByAtlas = false;
            config.OversampleH = 1;  // letters are copied, one texel to one pixel
            config.PixelSnapH = true;
            void* bytes = const_cast<unsigned char*>(data.data());  // ImGui takes a mutable pointer and only reads
            font_ = atlas_.AddFontFromMemoryTTF(bytes, int(data.size()), kLineHeight, &config, kEvery);
        }
        font_->FallbackChar = 0x25a1;  // a box for missing letters; ImGui cannot reach the font's own
        atlas_.GetTexDataAsAlpha8(&coverage_, &width_, &height_);
    }
    const ImFont& font() const { return *font_; }
    /// Returns the coverage of a glyph's pixel, counted from the glyph's upper left corner; 0 to 255.
    int coverage(const ImFontGlyph& glyph, int x, int y) const {
        const long column = std::lround(glyph.U0 * float(width_)) + x, row = std::lround(glyph.V0 * float(height_)) + y;
        return coverage_[row * width_ + column];
    }
    /// Draws a glyph into an image, cut at the column `right`.
    void draw(ByteImage& image, const ImFontGlyph& glyph, int x, int y, int right, const Colour& colour) const {
        const int left = x + int(std::lround(glyph.X0)), top = y + int(std::lround(glyph.Y0));
        const int width = int(std::lround(glyph.X1 - glyph.X0)), height = int(std::lround(glyph.Y1 - glyph.Y0));
        for (int row = std::max(top, 0); row < std::min(top + height, image.height); ++row)
            for (int column = std::max(left, 0); column < std::min({left + width, right, image.width}); ++column) {
                const int covered = coverage(glyph, column - left, row - top);
                const auto pixel = image.data.begin() + (std::ptrdiff_t(row) * image.width + column) * 4;
                std::transform(colour.begin(), colour.end(), pixel, pixel, [covered](int over, int under) {
                    return std::uint8_t((over * covered + under * (255 - covered) + 127) / 255);
                });
            }
    }

private:
    ImFontAtlas atlas_;
    ImFont* font_ = nullptr;
    unsigned char* coverage_ = nullptr;
    int width_ = 0, height_ = 0;  ///< size of the atlas, pixels
};

LabelledSheet::LabelledSheet(int width, int height)
    : image_(plain_image(width, height, 255)), letters_(std::make_unique<Letters>()) {
    fill(0, 0, width, height, {24, 25, 28});
}

LabelledSheet::~LabelledSheet() = default;

void LabelledSheet::fill(int x, int y, int width, int height, const Colour& colour) {
    for (int row = std::max(y, 0); row < std::min(y + height, image_.height); ++row)
        for (int column = std::max(x, 0); column < std::min(x + width, image_.width); ++column)
            std::copy(colour.begin(), colour.end(),
                      image_.data.begin() + (std::ptrdiff_t(row) * image_.width + column) * 4);
}

void LabelledSheet::place(const ByteImage& picture, int x, int y) {
    paste_image(image_, picture, {x, y});
}

void LabelledSheet::write(const std::string& text, int x, int y, int width, const Colour& colour) {
    const ImFont& font = letters_->font();
    const std::string shown = beginning_that_fits(text, float(width), &font);
    const int right = x + width;
    for (const char *next = shown.data(), *end = next + shown.size(); next < end;) {
        unsigned code = 0;
        next += ImTextCharFromUtf8(&code, next, end);
        const ImFontGlyph& glyph = *font.FindGlyph(ImWchar(code));
        letters_->draw(image_, glyph, x, y, right, colour);
        x += int(std::lround(glyph.AdvanceX));
    }
}

}  // namespace si
