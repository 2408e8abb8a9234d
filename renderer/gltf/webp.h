// Decoder of WebP images (EXT_texture_webp).
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/foreign/child.h"
#include "renderer/gltf/image_decode.h"

namespace si::gltf {

/// Job that decodes images in a child process.
extern const ForeignJob kWebpJob;

/// Returns true for the bytes of a WebP file.
bool is_webp(std::span<const std::uint8_t> bytes);

/// Decodes WebP images in child processes. A failure is reported in Image::error of its image alone.
/// @param max_image_bytes limit of the memory of one image while it is decoded
/// @param bytes_left decoded bytes that may still be kept, which shrinks @param stop true ends it early
std::vector<Image> decode_webp(std::span<const std::span<const std::uint8_t>> images, std::size_t max_image_bytes,
                               std::atomic<std::size_t>& bytes_left, const std::atomic<bool>& stop);

/// Decodes the images of a request of pack_webp() in this process: as many as fit into one answer, but at least one.
/// The child process of decode_webp() runs it.
std::vector<std::uint8_t> decode_packed_webp(std::span<const std::uint8_t> request,
                                             const std::function<void(double)>& progress);

/// Packs encoded images and their memory limit into a request for decode_packed_webp().
std::vector<std::uint8_t> pack_webp(std::span<const std::span<const std::uint8_t>> images, std::size_t max_image_bytes);

}  // namespace si::gltf
