// Pictures of the editor as files.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/frame/frame.h"
#include "ui/state/shots.h"

namespace si {

/// The part of the window's picture that was wished for. @param pixels of the picture per unit of the screen
ByteImage cut_out(const ByteImage& window, const ScreenRect& rect, float pixels);

/// Writes it into `folder` as SCENE-PART-NUMBER.png, the first number that no file has; what is there stays as it is.
/// Returns the file's path. @param scene built-in key or path @param svg the same as a drawing, for a file beside it
/// that ends in .svg; empty: none @throws Error
std::filesystem::path save_screenshot(const ByteImage& picture, Shot of, const std::string& scene,
                                      const std::filesystem::path& folder, const std::string& svg = {});

}  // namespace si
