#include "renderer/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "renderer/base/error.h"

namespace si::gltf {
namespace {

constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 32;

/// Bytes that one compressed byte can give at most: four bytes are the least for a column of 256 bytes of attributes,
/// one for a triangle, one for an index.
constexpr std::uint64_t kMaxGrowth = 64;
constexpr std::uint64_t kMaxTailBytes = 65536;  ///< of the last block, which may be larger than its share

void require(bool holds, const std::string& sentence) {
    if (!holds) throw Error(sentence);
}

void check_filter(const MeshoptStream& s) {
    require(s.filter != "COLOR", "the filter COLOR is not read");
    const bool octahedral = s.filter == "OCTAHEDRAL", quaternion = s.filter == "QUATERNION";
    require(octahedral || quaternion || s.filter == "EXPONENTIAL" || s.filter == "NONE",
            fmt::format("\"{}\" is no filter", s.filter));
    require(s.filter == "NONE" || s.mode == "ATTRIBUTES", fmt::format("the filter {} is for ATTRIBUTES", s.filter));
    require(!octahedral || s.stride == 4 || s.stride == 8, "the filter OCTAHEDRAL needs a byteStride of 4 or 8");
    require(!quaternion || s.stride == 8, "the filter QUATERNION needs a byteStride of 8");
}

}  // namespace

std::size_t checked_meshopt_bytes(const MeshoptStream& s, std::size_t compressed_bytes) {
    const bool attributes = s.mode == "ATTRIBUTES", triangles = s.mode == "TRIANGLES";
    require(attributes || triangles || s.mode == "INDICES", fmt::format("\"{}\" is no mode", s.mode));
    if (attributes)
        require(s.stride > 0 && s.stride <= 256 && s.stride % 4 == 0,
                fmt::format("byteStride {} is no multiple of 4 up to 256", s.stride));
    else
        require(s.stride == 2 || s.stride == 4, fmt::format("byteStride {} is neither 2 nor 4", s.stride));
    require(!triangles || s.count % 3 == 0, fmt::format("count {} is no multiple of 3", s.count));
    require(s.count > 0, "count is 0");
    check_filter(s);
    const std::uint64_t most = kMaxGrowth * compressed_bytes + kMaxTailBytes;
    require(s.count <= kMaxCount && s.count * s.stride <= most,
            fmt::format("{} elements of {} bytes are more than {} compressed bytes can hold", s.count, s.stride,
                        compressed_bytes));
    return std::size_t(s.count * s.stride);
}

void decode_meshopt(const MeshoptStream& s, std::span<const std::uint8_t> in, std::span<std::uint8_t> out) {
    const std::size_t count = std::size_t(s.count), stride = std::size_t(s.stride);
    constexpr std::uint8_t kAttributesVersion1 = 0xa1;
    if (s.mode == "ATTRIBUTES" && !in.empty() && in[0] == kAttributesVersion1)
        throw Error("its stream has version 1, and version 0 is read");
    int failure = 0;
    if (s.mode == "ATTRIBUTES")
        failure = meshopt_decodeVertexBuffer(out.data(), count, stride, in.data(), in.size());
    else if (s.mode == "TRIANGLES")
        failure = meshopt_decodeIndexBuffer(out.data(), count, stride, in.data(), in.size());
    else
        failure = meshopt_decodeIndexSequence(out.data(), count, stride, in.data(), in.size());
    require(failure == 0,
            failure == -1 ? "its data are no meshopt stream of this mode" : "its stream is cut or damaged");
    if (s.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
    if (s.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), count, stride);
    if (s.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
}

}  // namespace si::gltf
