// Wrapper of the tinygltf library: the only file that includes and calls it.
#pragma once

#ifdef SI_TINYGLTF_HEADER_ONLY
// These change the header's classes, so every user must see the same.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#ifdef TINYGLTF_IMPLEMENTATION
#include <nlohmann/json.hpp>
#endif
#endif
#include <tiny_gltf.h>

#include "renderer/gltf/json_guard.h"

namespace si::gltf {

/// Parses a validated glTF document with tinygltf. Buffers, images and extensions are left out (see core_text()), so
/// that tinygltf opens no file and decodes nothing. @throws Error with tinygltf's message
tinygltf::Model read_model(const Context& context, const Json& root);

}  // namespace si::gltf
