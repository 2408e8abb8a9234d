// Validation of sizes and ranges of buffers, buffer views and accessors.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;  ///< sums of a few such values do not overflow 64 bits
constexpr std::uint64_t kMostElements = std::uint64_t{1} << 32;
constexpr std::uint64_t kMostZeros = std::uint64_t{1} << 22;  ///< elements of accessors without data, which are 0

struct View {
    std::uint64_t bytes = 0, stride = 0;
    std::string fault;  ///< empty: readable
};

std::vector<View> check_views(const Context& context, const Json& root, const std::vector<std::uint64_t>& buffers) {
    std::vector<View> out;
    const auto views = root.find("bufferViews");
    if (views == root.end()) return out;
    for (std::size_t i = 0; i < views->size(); ++i) {
        const Place place("bufferViews", i);
        const Fields fields(context, (*views)[i], place);
        const std::uint64_t buffer = fields.whole_required("buffer", ~std::uint64_t{0});
        const std::uint64_t offset = fields.whole("byteOffset", kMostBytes).value_or(0);
        View view{fields.whole_required("byteLength", kMostBytes), fields.whole("byteStride", 65535).value_or(0), {}};
        if (buffer >= buffers.size()) {
            view.fault = fmt::format("buffer {} does not exist, the file has {}", buffer, buffers.size());
        } else if (view.bytes == 0) {
            view.fault = "its byteLength is 0";
        } else if (offset + view.bytes > buffers[buffer]) {
            view.fault = fmt::format("bytes {} to {} pass the end of buffer {}, which has {}", offset,
                                     offset + view.bytes, buffer, buffers[buffer]);
        }
        out.push_back(std::move(view));
    }
    return out;
}

/// Returns a view that something reads. @throws Error when it is faulty
const View& readable(const Context& context, const std::vector<View>& views, std::size_t i) {
    if (!views[i].fault.empty()) context.fail(Place("bufferViews", i), views[i].fault);
    return views[i];
}

/// Throws Error unless `count` elements of `element` bytes, `stride` apart, lie inside the view.
void check_range(const Context& context, const Place& place, const View& view, std::uint64_t offset,
                 std::uint64_t count, std::uint64_t stride, std::uint64_t element) {
    // At most 2^40 + 2^32 * 2^16 + small: no wrap-around.
    const std::uint64_t end = offset + (count - 1) * stride + element;
    if (end > view.bytes) {
        context.fail(place, fmt::format("{} elements end at byte {}, its buffer view has {}", count, end, view.bytes));
    }
}

void check_sparse(const Context& context, const Json& accessor, const Place& accessor_place,
                  const std::vector<View>& views, std::uint64_t count, std::uint64_t element) {
    const Place place(accessor_place, "sparse");
    const Fields fields(context, accessor["sparse"], place);
    const std::uint64_t changed = fields.whole_required("count", count);
    if (changed == 0) context.fail(Place(place, "count"), "is 0");

    const Place indices_place(place, "indices"), values_place(place, "values");
    const Fields indices(context, fields.object("indices"), indices_place);
    const Fields values(context, fields.object("values"), values_place);
    const std::uint64_t type = indices.whole_required("componentType", 65535);
    if (type != 5121 && type != 5123 && type != 5125) {
        context.fail(Place(indices_place, "componentType"), fmt::format("{} is no type for indices", type));
    }
    const auto check = [&](const Fields& part, std::uint64_t bytes) {
        const std::size_t view = part.index_required("bufferView", views.size());
        // tinygltf stores these offsets in 32 bits.
        const std::uint64_t offset = part.whole("byteOffset", 0x7fffffff).value_or(0);
        check_range(context, part.place(), readable(context, views, view), offset, changed, bytes, bytes);
    };
    check(indices, component_bytes(type));
    check(values, element);
}

void check_accessors(const Context& context, const Json& root, const std::vector<View>& views) {
    const auto accessors = root.find("accessors");
    if (accessors == root.end()) return;
    for (std::size_t i = 0; i < accessors->size(); ++i) {
        const Place place("accessors", i);
        const Json& accessor = (*accessors)[i];
        const Fields fields(context, accessor, place);
        const std::uint64_t component = fields.whole_required("componentType", 65535);
        const auto type = fields.string("type");
        if (component_bytes(component) == 0) {
            context.fail(Place(place, "componentType"), fmt::format("{} is no component type", component));
        }
        if (!type) context.fail(Place(place, "type"), "is missing");
        const std::uint64_t element = element_bytes(*type, component);
        if (element == 0) context.fail(Place(place, "type"), fmt::format("\"{}\" is no element type", *type));
        const std::uint64_t count = fields.whole_required("count", kMostElements);
        if (count == 0) context.fail(Place(place, "count"), "is 0");
        const std::uint64_t offset = fields.whole("byteOffset", kMostBytes).value_or(0);
        if (const auto normalized = accessor.find("normalized");
            normalized != accessor.end() && !normalized->is_boolean()) {
            context.fail(Place(place, "normalized"), "is neither true nor false");
        }
        if (const auto index = fields.index("bufferView", views.size())) {
            const View& view = readable(context, views, *index);
            const std::uint64_t stride = view.stride == 0 ? element : view.stride;
            if (stride < element) {
                context.fail(place, fmt::format("its buffer view's byteStride {} is less than its element of {} bytes",
                                                stride, element));
            }
            check_range(context, place, view, offset, count, stride, element);
        } else if (count > kMostZeros) {
            context.fail(place, fmt::format("{} elements have no bufferView, at most {} are read", count, kMostZeros));
        }
        if (accessor.contains("sparse")) check_sparse(context, accessor, place, views, count, element);
    }
}

}  // namespace

std::size_t component_bytes(std::uint64_t component_type) {
    static constexpr std::size_t kBytes[] = {1, 1, 2, 2, 0, 4, 4};  // from 5120 on; glTF has no signed 32-bit integers
    return component_type >= 5120 && component_type < 5127 ? kBytes[component_type - 5120] : 0;
}

std::size_t element_bytes(std::string_view type, std::uint64_t component_type) {
    const std::size_t component = component_bytes(component_type);
    if (type == "SCALAR") return component;
    if (type == "VEC2") return 2 * component;
    if (type == "VEC3") return 3 * component;
    if (type == "VEC4") return 4 * component;
    // Each column of a matrix starts at a multiple of four bytes.
    const auto matrix = [&](std::size_t n) { return (n - 1) * ((n * component + 3) / 4 * 4) + n * component; };
    if (type == "MAT2") return matrix(2);
    if (type == "MAT3") return matrix(3);
    if (type == "MAT4") return matrix(4);
    return 0;
}

std::vector<std::uint64_t> check_buffers(const Context& context, const Json& root) {
    std::vector<std::uint64_t> bytes;
    const auto buffers = root.find("buffers");
    if (buffers == root.end()) return bytes;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
        const Place place("buffers", i);
        const Fields fields(context, (*buffers)[i], place);
        fields.string("uri");
        bytes.push_back(fields.whole_required("byteLength", kMostBytes));
        if (bytes.back() == 0) context.fail(Place(place, "byteLength"), "is 0");
    }
    return bytes;
}

void check_data(Context& context, Json& root, const Sizes&) {
    const std::vector<View> views = check_views(context, root, check_buffers(context, root));
    check_accessors(context, root, views);
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (views[i].fault.empty()) continue;
        context.warn(Place("bufferViews", i), views[i].fault + "; no accessor reads it, it counts as empty");
        root["bufferViews"][i] = {{"buffer", 0}, {"byteLength", 0}};
    }
}

}  // namespace si::gltf
