// Textures of pictures that panels show and that the renderer does not draw.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"

namespace si {

/// Uploads an image to a new texture for the panels. The texture has the bottom row first, like the renderer's
/// pictures. Needs a current OpenGL context.
/// @param image top row first @throws gl::OutOfMemory
gl::Texture upload_picture(const ByteImage& image);

}  // namespace si
