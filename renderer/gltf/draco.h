// Decoder of KHR_draco_mesh_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/foreign/child.h"

namespace si::gltf {

/// Vertex attribute of a Draco-compressed mesh, and the number type of its glTF accessor.
struct DracoAttribute {
    std::uint32_t id = 0;    ///< unique id within the Draco data
    int component_type = 0;  ///< glTF componentType
    int width = 0;           ///< components of an element

    bool operator==(const DracoAttribute&) const = default;
};

/// Draco-compressed mesh: its bytes, and the vertex attributes to decode.
struct DracoMesh {
    std::span<const std::uint8_t> bytes;
    std::vector<DracoAttribute> attributes;
};

/// Layout of one decoded Draco mesh in DracoResults::bytes, or the reason why the mesh could not be decoded.
struct DracoResult {
    std::string error;  ///< empty: decoded
    std::uint64_t points = 0, faces = 0;
    std::size_t indices_at = 0;              ///< offset of 3 * faces 32-bit indices
    std::vector<std::size_t> attributes_at;  ///< offset of each requested attribute, `points` elements without gaps
};

/// Draco meshes that were decoded together, with the bytes of their vertices and indices.
struct DracoResults {
    std::vector<DracoResult> meshes;  ///< results in the order of the requested meshes
    std::vector<std::uint8_t> bytes;
};

/// Job that decodes Draco meshes in a child process; row of foreign_jobs().
extern const ForeignJob kDracoJob;

/// Decodes Draco meshes in a child process, which confines crashes of the decoder. DracoResult::error has the reason
/// for a mesh that cannot be decoded. Vertex indices are below the number of points; attribute values are not
/// validated.
/// @param progress receives 0..1; returning false cancels
/// @throws Error a sentence without the file's name when the child process fails, or "cancelled"
DracoResults decode_draco(std::span<const DracoMesh> meshes, const std::function<bool(double)>& progress);

/// Decodes the Draco meshes of a request from pack_draco(), in the child process of decode_draco(). Returns the packed
/// results.
/// @param progress receives 0..1 @throws Error
std::vector<std::uint8_t> decode_packed_draco(std::span<const std::uint8_t> request,
                                              const std::function<void(double)>& progress);

/// Packs Draco meshes into the bytes of a request for decode_packed_draco().
std::vector<std::uint8_t> pack_draco(std::span<const DracoMesh> meshes);

}  // namespace si::gltf
