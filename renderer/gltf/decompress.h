// Decoding of compressed parts of a glTF file, so that all later steps see a plain document.
#pragma once

#include "renderer/gltf/buffers.h"

namespace si::gltf {

/// Decodes the buffer views of EXT_meshopt_compression and the primitives of KHR_draco_mesh_compression. Rewrites
/// `root` to refer to the decoded buffers, so that later steps see a document without compression. Does not validate
/// the decoded numbers: check_data() and check_graph() follow.
/// @throws Error naming the position in the file
void decompress(Context& context, Json& root, Buffers& buffers);

}  // namespace si::gltf
