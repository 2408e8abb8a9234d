// The buffers of a glTF file: loaded on first use, from the GLB chunk, a data URI or a file beside the model.
#pragma once

#include <span>
#include <vector>

#include "renderer/gltf/container.h"
#include "renderer/gltf/file.h"
#include "renderer/gltf/json_guard.h"

namespace si::gltf {

class Buffers {
public:
    /// `root` and the bytes behind `container` must outlive this object.
    Buffers(Context& context, const Json& root, const Container& container);
    /// byteLength bytes of buffer `i`. @throws Error when they cannot be had.
    std::span<const std::uint8_t> buffer(std::size_t i);
    /// The bytes of buffer view `i`, whose range check_data() has checked.
    std::span<const std::uint8_t> view(std::size_t i);
    /// Bytes that files and data URIs may still take.
    std::size_t bytes_left() const { return bytes_left_; }
    /// Bytes of all buffers used so far.
    std::size_t bytes_loaded() const { return bytes_loaded_; }
    void spend(std::size_t bytes) { bytes_left_ -= std::min(bytes, bytes_left_); }

private:
    Bytes load(const Json& buffer, const Place& place);

    Context& context_;
    const Json& root_;
    const Container& container_;
    std::vector<Bytes> loaded_;
    std::vector<std::span<const std::uint8_t>> spans_;
    std::size_t bytes_left_ = 0, bytes_loaded_ = 0;
};

}  // namespace si::gltf
