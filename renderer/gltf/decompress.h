// Decoding of compressed parts of a glTF file, so that all later steps see a plain document.
#pragma once

#include "renderer/gltf/buffers.h"

namespace si::gltf {

/// Decodes the buffer views of EXT_meshopt_compression and the primitives of KHR_draco_mesh_compression, and rewrites
/// `root` to refer to decoded buffers. Decoded numbers are unchecked: the rules of any other document follow.
/// @throws Error naming the place
void decompress(Context& context, Json& root, Buffers& buffers);

}  // namespace si::gltf
