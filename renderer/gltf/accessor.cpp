#include "renderer/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

/// Limit of decoded bytes per byte of the file: ample for sharing and quantisation, far below a hostile file that
/// refers to the same bytes many times.
constexpr std::size_t kMostDecodedPerByte = 32, kAlwaysAllowedBytes = std::size_t{256} << 20;

struct Source {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;
    bool normalized = false;
};

template <class T>
float to_float(const std::uint8_t* at, bool normalized) {
    T value;
    std::memcpy(&value, at, sizeof(T));  // files may be misaligned
    const auto number = static_cast<float>(value);
    if constexpr (std::is_integral_v<T>) {
        if (normalized) return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
    }
    return number;
}

template <class T>
void convert(const Source& source, int width, std::size_t count, std::span<const std::uint32_t> pick, float* out) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* element = source.data + (pick.empty() ? i : pick[i]) * source.stride;
        for (int c = 0; c < width; ++c) *out++ = to_float<T>(element + std::size_t(c) * sizeof(T), source.normalized);
    }
}

/// Calls `work` with a 0 of the type of a glTF componentType.
template <class Work>
auto with_component(int component_type, Work&& work) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return work(std::int8_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return work(std::uint8_t());
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return work(std::int16_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return work(std::uint16_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return work(std::uint32_t());
        default:
            return work(float());
    }
}

void convert(int component_type, const Source& source, int width, std::size_t count,
             std::span<const std::uint32_t> pick, float* out) {
    const auto bytes = std::size_t(width) * sizeof(float);
    if (component_type == TINYGLTF_COMPONENT_TYPE_FLOAT && pick.empty() && source.stride == bytes)
        std::memcpy(out, source.data, count * bytes);
    else
        with_component(component_type, [&]<class T>(T) { convert<T>(source, width, count, pick, out); });
}

/// Converts indices of any type to 32 bits and returns the largest. Works in blocks that stay in the CPU cache.
template <class T>
std::uint32_t widen(const Source& source, std::size_t count, std::uint32_t* out) {
    constexpr std::size_t kBlock = 4096;
    std::uint32_t greatest = 0;
    for (std::size_t first = 0; first < count; first += kBlock) {
        const std::size_t end = std::min(first + kBlock, count);
        if (source.stride == sizeof(T)) {  // constant stride, so that the compiler vectorises
            T values[kBlock];
            std::memcpy(values, source.data + first * sizeof(T), (end - first) * sizeof(T));
            std::copy_n(values, end - first, out + first);
        } else {
            for (std::size_t i = first; i < end; ++i) {
                T value;
                std::memcpy(&value, source.data + i * source.stride, sizeof(T));
                out[i] = value;
            }
        }
        for (std::size_t i = first; i < end; ++i) greatest = std::max(greatest, out[i]);
    }
    return greatest;
}

/// Converts indices to 32 bits and returns the largest. @param component_type unsigned; validated by the callers
std::uint32_t widen(int component_type, const Source& source, std::size_t count, std::uint32_t* out) {
    return with_component(component_type, [&]<class T>(T) { return widen<T>(source, count, out); });
}

}  // namespace

Accessors::Accessors(Context& context, const tinygltf::Model& model, Buffers& buffers)
    : context_(context), model_(model), buffers_(buffers) {}

std::size_t Accessors::count(int accessor) const {
    return model_.accessors[std::size_t(accessor)].count;
}

int Accessors::width(int accessor) const {
    return tinygltf::GetNumComponentsInType(std::uint32_t(model_.accessors[std::size_t(accessor)].type));
}

void Accessors::expect_width(int accessor, int expected, const Place& place) const {
    const int type = model_.accessors[std::size_t(accessor)].type;
    const bool is_matrix = type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3;
    if (width(accessor) == expected && !is_matrix) return;
    context_.fail(place,
                  fmt::format("accessor {} has {} components, {} are expected", accessor, width(accessor), expected));
}

void Accessors::load_data(int accessor) {
    if (const int view = model_.accessors[std::size_t(accessor)].bufferView; view >= 0) {
        buffers_.view(std::size_t(view));
    }
}

void Accessors::spend(int accessor, std::size_t bytes, const Place& place) {
    load_data(accessor);  // so that the size of the buffer counts
    decoded_bytes_ += bytes;
    if (decoded_bytes_ > kAlwaysAllowedBytes + kMostDecodedPerByte * buffers_.bytes_loaded()) {
        context_.fail(place, "the model decodes to more than 32 times the size of its buffers",
                      "remove repeated primitives");
    }
    const double decoded = static_cast<double>(decoded_bytes_), loaded = static_cast<double>(buffers_.bytes_loaded());
    context_.progress(0.4 + 0.2 * std::min(1.0, decoded / (loaded + 1)));
}

std::vector<std::uint32_t> Accessors::sparse_positions(int accessor, const Place& place) {
    const auto& a = model_.accessors[std::size_t(accessor)];
    const auto& sparse = a.sparse;
    const auto count = std::size_t(sparse.count);
    const auto bytes =
        buffers_.view(std::size_t(sparse.indices.bufferView)).subspan(std::size_t(sparse.indices.byteOffset));
    std::vector<std::uint32_t> out(count);
    widen(sparse.indices.componentType, {bytes.data(), component_bytes(sparse.indices.componentType)}, count,
          out.data());
    for (std::size_t i = 0; i < count; ++i) {
        if (out[i] >= a.count || (i > 0 && out[i] <= out[i - 1])) {
            context_.fail(place, fmt::format("accessor {}: sparse index {} (the {}th) is out of range or not ascending",
                                             accessor, out[i], i));
        }
    }
    return out;
}

void Accessors::overlay_sparse(int accessor, const Place& place, int width, float* out) {
    const auto& a = model_.accessors[std::size_t(accessor)];
    const auto positions = sparse_positions(accessor, place);
    const auto bytes =
        buffers_.view(std::size_t(a.sparse.values.bufferView)).subspan(std::size_t(a.sparse.values.byteOffset));
    const std::size_t n = std::size_t(width);
    std::vector<float> values(positions.size() * n);
    convert(a.componentType, {bytes.data(), n * component_bytes(a.componentType), a.normalized}, width,
            positions.size(), {}, values.data());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        std::copy_n(values.data() + i * n, n, out + positions[i] * n);
    }
}

void Accessors::read(int accessor, const Place& place, int width, std::span<const std::uint32_t> pick, float* out) {
    const auto& a = model_.accessors[std::size_t(accessor)];
    const std::size_t n = std::size_t(width);
    if (a.sparse.isSparse && !pick.empty()) {
        spend(accessor, a.count * n * sizeof(float), place);
        std::vector<float> all(a.count * n);
        read(accessor, place, width, {}, all.data());
        for (std::size_t i = 0; i < pick.size(); ++i) std::copy_n(all.data() + pick[i] * n, n, out + i * n);
        return;
    }
    const std::size_t count = pick.empty() ? a.count : pick.size();
    if (a.bufferView < 0) {
        std::fill_n(out, count * n, 0.0f);
    } else {
        const auto bytes = buffers_.view(std::size_t(a.bufferView)).subspan(a.byteOffset);
        const std::size_t stride = model_.bufferViews[std::size_t(a.bufferView)].byteStride;
        const Source source{bytes.data(), stride == 0 ? n * component_bytes(a.componentType) : stride, a.normalized};
        convert(a.componentType, source, width, count, pick, out);
    }
    if (a.sparse.isSparse) overlay_sparse(accessor, place, width, out);
}

template <int N>
std::vector<glm::vec<N, float>> Accessors::floats(int accessor, const Place& place,
                                                  std::span<const std::uint32_t> pick) {
    static_assert(sizeof(glm::vec<N, float>) == N * sizeof(float));
    expect_width(accessor, N, place);
    const std::size_t elements = pick.empty() ? count(accessor) : pick.size();
    spend(accessor, elements * sizeof(glm::vec<N, float>), place);
    std::vector<glm::vec<N, float>> out(elements);
    read(accessor, place, N, pick, &out[0][0]);
    return out;
}

template std::vector<glm::vec2> Accessors::floats<2>(int, const Place&, std::span<const std::uint32_t>);
template std::vector<glm::vec3> Accessors::floats<3>(int, const Place&, std::span<const std::uint32_t>);
template std::vector<glm::vec4> Accessors::floats<4>(int, const Place&, std::span<const std::uint32_t>);

std::vector<float> Accessors::numbers(int accessor, const Place& place, int width) {
    expect_width(accessor, width, place);
    const std::size_t size = count(accessor) * std::size_t(width);
    spend(accessor, size * sizeof(float), place);
    std::vector<float> out(size);
    read(accessor, place, width, {}, out.data());
    return out;
}

std::vector<glm::mat4> Accessors::matrices(int accessor, const Place& place) {
    const auto& a = model_.accessors[std::size_t(accessor)];
    if (a.type != TINYGLTF_TYPE_MAT4 || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        context_.fail(place, fmt::format("accessor {} is not of float matrices (MAT4)", accessor));
    }
    spend(accessor, a.count * sizeof(glm::mat4), place);
    std::vector<glm::mat4> out(a.count);
    read(accessor, place, 16, {}, &out[0][0][0]);
    return out;
}

std::vector<std::uint32_t> Accessors::indices(int accessor, const Place& place, std::size_t limit) {
    const auto& a = model_.accessors[std::size_t(accessor)];
    expect_width(accessor, 1, place);
    spend(accessor, a.count * sizeof(std::uint32_t), place);
    std::vector<std::uint32_t> out(a.count);
    const std::size_t component = component_bytes(a.componentType);
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        context_.fail(place, fmt::format("accessor {} has a component type that is none for indices", accessor));
    }
    std::uint32_t greatest = 0;
    if (a.bufferView >= 0) {
        const auto bytes = buffers_.view(std::size_t(a.bufferView)).subspan(a.byteOffset);
        const std::size_t stride = model_.bufferViews[std::size_t(a.bufferView)].byteStride;
        greatest = widen(a.componentType, {bytes.data(), stride == 0 ? component : stride}, a.count, out.data());
    }
    if (a.sparse.isSparse) {
        const auto positions = sparse_positions(accessor, place);
        const auto bytes =
            buffers_.view(std::size_t(a.sparse.values.bufferView)).subspan(std::size_t(a.sparse.values.byteOffset));
        std::vector<std::uint32_t> values(positions.size());
        widen(a.componentType, {bytes.data(), component}, positions.size(), values.data());
        for (std::size_t i = 0; i < positions.size(); ++i) out[positions[i]] = values[i];
        greatest = *std::max_element(out.begin(), out.end());  // sparse values have replaced some
    }
    if (greatest >= limit) {
        context_.fail(place, fmt::format("accessor {}: index {} is out of range, there are {} vertices", accessor,
                                         greatest, limit));
    }
    // The largest value of the type is primitive restart in OpenGL. glTF forbids it, and exporters write it for the
    // last of 256 or 65536 vertices.
    if (greatest == (std::uint64_t{1} << (8 * component)) - 1) {
        context_.warn(place,
                      fmt::format("accessor {}: {} is the restart value of its type, which glTF forbids; read as "
                                  "an index",
                                  accessor, greatest));
    }
    return out;
}

}  // namespace si::gltf
