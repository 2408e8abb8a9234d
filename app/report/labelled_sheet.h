// Pictures with text on one sheet, drawn without OpenGL.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Dark image onto which pictures, rectangles and lines of text are drawn without OpenGL. Coordinates are pixels from
/// the upper left.
class LabelledSheet {
public:
    using Colour = std::array<std::uint8_t, 3>;  ///< sRGB
    static constexpr int kLineHeight = 14;       ///< pixels of a line of text

    LabelledSheet(int width, int height);
    ~LabelledSheet();
    const ByteImage& image() const { return image_; }
    /// Fills a rectangle of this image with a colour; parts outside the image are left out. @param x, y upper left
    /// corner, pixels
    void fill(int x, int y, int width, int height, const Colour& colour);
    /// Copies a picture onto this image; parts beyond the right or lower edge are left out. @param x, y place of the
    /// picture's upper left corner, pixels
    void place(const ByteImage& picture, int x, int y);
    /// Draws one line of UTF-8 text onto this image. Text beyond `width` is cut with an ellipsis. @param x, y upper
    /// left corner of the line, pixels
    void write(const std::string& text, int x, int y, int width, const Colour& colour);

private:
    class Letters;
    ByteImage image_;
    std::unique_ptr<Letters> letters_;
};

}  // namespace si
