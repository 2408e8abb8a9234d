// Decoder of KHR_draco_mesh_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/foreign/child.h"

namespace si::gltf {

/// Attribute of a compressed mesh, and the type of its glTF accessor.
struct DracoAttribute {
    std::uint32_t id = 0;    ///< unique id within the Draco data
    int component_type = 0;  ///< glTF componentType
    int width = 0;           ///< components of an element

    bool operator==(const DracoAttribute&) const = default;
};

/// Compressed mesh.
struct DracoMesh {
    std::span<const std::uint8_t> bytes;
    std::vector<DracoAttribute> attributes;
};

/// Decoded mesh, or the reason why it could not be decoded.
struct DracoResult {
    std::string error;  ///< empty: decoded
    std::uint64_t points = 0, faces = 0;
    std::size_t indices_at = 0;              ///< offset of 3 * faces 32-bit indices
    std::vector<std::size_t> attributes_at;  ///< offset of each requested attribute, `points` elements without gaps
};

/// Meshes decoded together, and the bytes that their offsets refer to.
struct DracoResults {
    std::vector<DracoResult> meshes;  ///< for each request, in its order
    std::vector<std::uint8_t> bytes;
};

/// Job that decodes meshes in a child process.
extern const ForeignJob kDracoJob;

/// Decodes meshes in a child process. Indices are below the number of points; values are unchecked.
/// @param progress as of run_foreign_job() @throws Error a sentence without the file's name, or "cancelled"
DracoResults decode_draco(std::span<const DracoMesh> meshes, const std::function<bool(double)>& progress);

/// Decodes the packed meshes of a request in this process. The child process of decode_draco() runs it. @throws Error
std::vector<std::uint8_t> decode_packed_draco(std::span<const std::uint8_t> request,
                                              const std::function<void(double)>& progress);

/// Packs a request of decode_packed_draco().
std::vector<std::uint8_t> pack_draco(std::span<const DracoMesh> meshes);

}  // namespace si::gltf
