// Pictures of the editor as files.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/frame/frame.h"
#include "ui/state/window_layout.h"

namespace si {

/// Returns a copy of a rectangle of the window's picture, clipped to the picture.
/// @param rect the rectangle, in ImGui's units @param pixels number of pixels of `window` per unit of ImGui
ByteImage cut_out(const ByteImage& window, const ScreenRect& rect, float pixels);

/// Writes a picture into `folder` as SCENE-PART-NUMBER.png, with the first number that no file has. Returns its path.
/// @param of part of the editor that the picture shows: PART
/// @param scene the key of a built-in scene, or a path @param svg the same drawing as SVG, for a file of the same name;
/// empty: none
/// @throws Error
std::filesystem::path save_screenshot(const ByteImage& picture, Shot of, const std::string& scene,
                                      const std::filesystem::path& folder, const std::string& svg = {});

}  // namespace si
