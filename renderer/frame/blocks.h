// What all shaders of a frame read: the frame's block and the settings'.
#pragma once

#include <string>

namespace si {

struct FrameState;
namespace shared {
struct FrameBlock;
}
/// What stands in the frame's block.
shared::FrameBlock make_frame_block(const FrameState& f);
/// Has shaders read another.
void replace_frame_block(const FrameState& f, const shared::FrameBlock& block);
/// Uploads the frame's block, the settings' and places of the kernel's disks, and sets the samplers of the maps.
void upload_blocks(const FrameState& f);

/// How shaders read them, as GLSL text that stands before every shader.
/// @param as_images by images where single numbers are read, else by uniform blocks; the bits are the same
std::string blocks_glsl(bool as_images);

}  // namespace si
