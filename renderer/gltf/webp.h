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

/// Job that decodes WebP images in a child process; row of foreign_jobs().
extern const ForeignJob kWebpJob;

/// Returns true when the bytes begin with the signature of a WebP file.
bool is_webp(std::span<const std::uint8_t> bytes);

/// Decodes WebP images in child processes, which confine crashes of the decoder. An image that fails has its reason in
/// Image::error; the others are still decoded.
/// @param max_image_bytes limit of the memory for decoding one image
/// @param bytes_left limit of the decoded bytes of all images; the size of each image is subtracted
/// @param stop set to true by another thread to cancel @throws Error "cancelled"
std::vector<Image> decode_webp(std::span<const std::span<const std::uint8_t>> images, std::size_t max_image_bytes,
                               std::atomic<std::size_t>& bytes_left, const std::atomic<bool>& stop);

/// Decodes the WebP images of a request from pack_webp(), in the child process of decode_webp(). Returns the packed
/// images: as many as fit into one answer, but at least one.
/// @param progress called after each image, to notice cancelling
std::vector<std::uint8_t> decode_packed_webp(std::span<const std::uint8_t> request,
                                             const std::function<void(double)>& progress);

/// Packs encoded WebP images into the bytes of a request for decode_packed_webp().
/// @param max_image_bytes limit of the memory for decoding one image
std::vector<std::uint8_t> pack_webp(std::span<const std::span<const std::uint8_t>> images, std::size_t max_image_bytes);

}  // namespace si::gltf
