// Decoder of EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace si::gltf {

/// Properties of one compressed buffer view, as its extension EXT_meshopt_compression states them.
struct MeshoptStream {
    std::string mode;             ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter = "NONE";  ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
    std::uint64_t count = 0;      ///< elements
    std::uint64_t stride = 0;     ///< bytes of an element
};

/// Validates a buffer view compressed by meshopt, and returns its decoded size in bytes: count times stride. Call
/// before allocating memory for decode_meshopt().
/// @param compressed_bytes size of the compressed data; a decoded size that these bytes cannot hold is an error
/// @throws Error a sentence on the first property that the extension forbids
std::size_t checked_meshopt_bytes(const MeshoptStream& stream, std::size_t compressed_bytes);

/// Decodes a buffer view compressed by meshopt and applies its filter. Decoded indices may be out of range.
/// @param in compressed bytes @param out checked_meshopt_bytes() bytes, aligned to 4 @throws Error a sentence
void decode_meshopt(const MeshoptStream& stream, std::span<const std::uint8_t> in, std::span<std::uint8_t> out);

}  // namespace si::gltf
