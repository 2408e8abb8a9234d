// Decoder of EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace si::gltf {

/// Properties of one compressed buffer view, as EXT_meshopt_compression states them.
struct MeshoptStream {
    std::string mode;             ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter = "NONE";  ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
    std::uint64_t count = 0;      ///< elements
    std::uint64_t stride = 0;     ///< bytes of an element
};

/// Returns the bytes that a stream decodes to: count times stride.
/// @param compressed_bytes size of the compressed data; what they cannot hold is refused before memory is taken
/// @throws Error a sentence on the first property that the extension forbids
std::size_t checked_meshopt_bytes(const MeshoptStream& stream, std::size_t compressed_bytes);

/// Decodes a stream and applies its filter. Indices may be out of range. @param out checked_meshopt_bytes() bytes,
/// aligned to 4 @throws Error a sentence
void decode_meshopt(const MeshoptStream& stream, std::span<const std::uint8_t> in, std::span<std::uint8_t> out);

}  // namespace si::gltf
