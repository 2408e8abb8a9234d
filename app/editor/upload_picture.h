// Textures of pictures that panels show and that the renderer does not draw.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"

namespace si {

/// Uploads an image that panels show, bottom row first as the renderer's pictures. Needs a current OpenGL context.
/// @throws gl::OutOfMemory
gl::Texture upload_picture(const ByteImage& image);

}  // namespace si
