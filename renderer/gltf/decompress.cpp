#include "renderer/gltf/decompress.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "renderer/base/error.h"
#include "renderer/gltf/draco.h"
#include "renderer/gltf/meshopt.h"
#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

constexpr std::string_view kWithoutCompression =
    "export the model again without mesh compression (gltf-transform copy IN OUT decodes it)";

/// Decoder of the compressed parts of one document.
class Decompression {
public:
    Decompression(Context& context, Json& root, Buffers& buffers)
        : context_(context), root_(root), buffers_(buffers), lengths_(check_buffers(context, root)) {}

    /// Decodes all buffer views of EXT_meshopt_compression.
    void decode_views();
    /// Decodes all primitives of KHR_draco_mesh_compression.
    void decode_primitives();

private:
    /// Primitive, by the indices of its mesh and of itself.
    using PrimitiveIndex = std::pair<std::size_t, std::size_t>;
    /// Primitives that share one compressed mesh.
    struct Draco {
        DracoMesh mesh;
        std::uint64_t stated_bytes = 0;  ///< decoded size by the accessors
        std::vector<std::string> names;  ///< of its attributes
        std::vector<PrimitiveIndex> primitives;
    };
    /// Returns the bytes of a range that a buffer view or an extension states. @throws Error
    std::span<const std::uint8_t> source(const Fields& fields);
    /// Adds a buffer of decoded bytes to the document. Returns its index.
    std::size_t add_buffer(std::vector<std::uint8_t> bytes);
    void decode_view(Json& view, const Json& extension, const Place& place);
    /// Adds a primitive to the others of the same compressed mesh.
    void find_draco(PrimitiveIndex index, const Json& extension);
    /// Decodes some compressed meshes together and rewrites their primitives.
    void decode_batch(std::span<Draco> batch, double first, double last);
    void rewrite_primitives(const Draco& draco, const DracoResult& result, std::size_t buffer);
    /// Lets an accessor read decoded elements. Returns its index, which is another one where it has other data.
    /// @param fields members of the accessor that the decoded data determine
    std::size_t give_data(std::size_t accessor, const Json& fields);
    std::size_t add_view(std::size_t buffer, std::size_t offset, std::size_t bytes);
    Json& primitive(PrimitiveIndex index) { return root_["meshes"][index.first]["primitives"][index.second]; }
    std::size_t size_of(const char* array) const { return root_.contains(array) ? root_[array].size() : 0; }

    Context& context_;
    Json& root_;
    Buffers& buffers_;
    std::vector<std::uint64_t> lengths_;  ///< of the buffers, in bytes
    std::set<std::size_t> given_;         ///< accessors that read decoded data
    std::vector<Draco> draco_;
    std::map<std::string, std::size_t> known_draco_;  ///< index in draco_ by view, attributes and their types
    std::uint64_t draco_bytes_ = 0;                   ///< compressed, of draco_
};

std::span<const std::uint8_t> Decompression::source(const Fields& fields) {
    const std::size_t buffer = fields.index_required("buffer", lengths_.size());
    const std::uint64_t size = lengths_[buffer];
    const std::uint64_t offset = fields.whole("byteOffset", size).value_or(0);
    const std::uint64_t length = fields.whole_required("byteLength", size - offset);
    return buffers_.buffer(buffer).subspan(std::size_t(offset), std::size_t(length));
}

std::size_t Decompression::add_buffer(std::vector<std::uint8_t> bytes) {
    if (bytes.size() > buffers_.bytes_left())
        context_.fail("the decoded model exceeds the limit of a file's size", "split the model");
    root_["buffers"].push_back({{"byteLength", bytes.size()}});
    lengths_.push_back(bytes.size());
    buffers_.add(std::move(bytes));
    return lengths_.size() - 1;
}

void Decompression::decode_view(Json& view, const Json& extension, const Place& place) {
    const Fields fields(context_, extension, place);
    const std::span<const std::uint8_t> in = source(fields);
    constexpr std::uint64_t kAny = std::uint64_t{1} << 40;
    const MeshoptStream stream{fields.string("mode").value_or(""), fields.string("filter").value_or("NONE"),
                               fields.whole_required("count", kAny), fields.whole_required("byteStride", kAny)};
    try {
        std::vector<std::uint8_t> out(checked_meshopt_bytes(stream, in.size()));
        decode_meshopt(stream, in, out);
        view["buffer"] = add_buffer(std::move(out));
        view["byteOffset"] = 0u;
    } catch (const Error& error) {
        context_.fail(place, error.what(), kWithoutCompression);
    }
}

void Decompression::decode_views() {
    const auto views = root_.find("bufferViews");
    if (views == root_.end()) return;
    for (std::size_t i = 0; i < views->size(); ++i) {
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            const Json* const extension = extension_of((*views)[i], name);
            if (!extension) continue;
            const Place view("bufferViews", i), extensions(view, "extensions");
            decode_view((*views)[i], *extension, Place(extensions, name));
            context_.progress(0.4);
            break;
        }
    }
}

constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// Returns the number of components of an accessor's elements; 0 for matrices and unknown types.
int components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    return type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

/// Place of the extension of a primitive.
struct DracoPlace {
    Place mesh, primitive, extensions, place;
    explicit DracoPlace(std::pair<std::size_t, std::size_t> index)
        : mesh("meshes", index.first),
          primitive(mesh, "primitives", index.second),
          extensions(primitive, "extensions"),
          place(extensions, kDraco) {}
    DracoPlace(const DracoPlace&) = delete;
};

void Decompression::find_draco(PrimitiveIndex index, const Json& extension) {
    const DracoPlace where(index);
    const Json* const attributes = member(&primitive(index), "attributes");
    if (!attributes || !attributes->is_object()) return;  // check_graph() refuses it
    const Fields fields(context_, extension, where.place);
    const std::size_t view = fields.index_required("bufferView", size_of("bufferViews"));
    const Place view_place("bufferViews", view), ids_place(where.place, "attributes");
    const Json& ids = fields.object("attributes");
    const Fields id_fields(context_, ids, ids_place);
    Draco draco;
    std::string key = std::to_string(view);
    for (const auto& [name, unused] : ids.items()) {
        const auto accessor = attributes->find(name);
        if (accessor == attributes->end()) continue;
        const std::size_t at = checked_index(context_, *accessor, Place(ids_place, name), size_of("accessors"));
        const Place accessor_place("accessors", at);
        const Fields properties(context_, root_["accessors"][at], accessor_place);
        const std::uint64_t type = properties.whole_required("componentType", 65535);
        DracoAttribute& attribute = draco.mesh.attributes.emplace_back();
        attribute.id = std::uint32_t(id_fields.whole_required(name.c_str(), 0xffffffff));
        attribute.component_type = int(type);
        attribute.width = components_of(properties.string("type").value_or(""));
        if (attribute.width == 0 || component_bytes(type) == 0)
            context_.fail(accessor_place, "has no type of a vertex attribute");
        draco.stated_bytes += properties.whole_required("count", std::uint64_t{1} << 32) *
                              std::uint64_t(attribute.width) * component_bytes(type);
        draco.names.push_back(name);
        key += fmt::format(" {} {} {} {}", name, attribute.id, type, attribute.width);
    }
    const auto [known, is_new] = known_draco_.try_emplace(std::move(key), draco_.size());
    if (is_new) {
        draco.mesh.bytes = source(Fields(context_, root_["bufferViews"][view], view_place));
        draco_bytes_ += draco.mesh.bytes.size();
        constexpr std::uint64_t kMaxRepeated = 8;
        if (draco_bytes_ > kMaxRepeated * buffers_.bytes_loaded())
            context_.fail(where.place, "the same Draco data are decoded too often", kWithoutCompression);
        draco_.push_back(std::move(draco));
    }
    draco_[known->second].primitives.push_back(index);
}

std::size_t Decompression::add_view(std::size_t buffer, std::size_t offset, std::size_t bytes) {
    root_["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", bytes}});
    return size_of("bufferViews") - 1;
}

std::size_t Decompression::give_data(std::size_t accessor, const Json& fields) {
    Json& accessors = root_["accessors"];
    // An accessor with data of its own is the fallback for readers without Draco, which another primitive may use.
    if (accessor >= accessors.size() || accessors[accessor].contains("bufferView") || !given_.insert(accessor).second) {
        Json copy = accessor < accessors.size() ? accessors[accessor] : Json::object();
        accessors.push_back(std::move(copy));
        accessor = accessors.size() - 1;
        given_.insert(accessor);
    }
    Json& out = accessors[accessor];
    out.erase("sparse");
    out.update(fields);
    return accessor;
}

void Decompression::rewrite_primitives(const Draco& draco, const DracoResult& result, std::size_t buffer) {
    std::map<std::string, Json> rewritten;  // by the accessors of a primitive
    for (const PrimitiveIndex& at : draco.primitives) {
        Json& primitive = this->primitive(at);
        const DracoPlace where(at);
        const Place& place = where.place;
        if (!result.error.empty()) context_.fail(place, result.error, kWithoutCompression);
        if (result.faces == 0 || result.points == 0) {
            context_.warn(place, "its Draco data have no triangles");
            primitive["attributes"] = Json::object();
            primitive.erase("indices");
            continue;
        }
        // Draco data are a list of triangles, also where the primitive states a strip.
        const Json* const mode = member(&primitive, "mode");
        if (mode && (*mode == 5 || *mode == 6)) primitive["mode"] = 4u;
        const std::string key = primitive["attributes"].dump() + primitive.value("indices", Json()).dump();
        if (const auto same = rewritten.find(key); same != rewritten.end()) {
            primitive.update(same->second);
            continue;
        }
        for (std::size_t a = 0; a < draco.names.size(); ++a) {
            const DracoAttribute& type = draco.mesh.attributes[a];
            const std::size_t element = std::size_t(type.width) * component_bytes(std::uint64_t(type.component_type));
            Json& accessor = primitive["attributes"][draco.names[a]];
            const std::size_t index = accessor.get<std::size_t>();
            // Other readers use the decoded data, too, where they differ from what the file states.
            if (const Json& stated = root_["accessors"][index]["count"]; stated != result.points)
                context_.warn(place, fmt::format("its Draco data have {} points, accessor {} states {}", result.points,
                                                 index, stated.dump()));
            const std::size_t view = add_view(buffer, result.attributes_at[a], std::size_t(result.points) * element);
            accessor = give_data(index, {{"bufferView", view}, {"byteOffset", 0u}, {"count", result.points}});
        }
        const std::uint64_t corners = 3 * result.faces;
        const auto indices = index_member(primitive, "indices", size_of("accessors"));
        const std::size_t view = add_view(buffer, result.indices_at, std::size_t(corners) * 4);
        primitive["indices"] = give_data(indices.value_or(size_of("accessors")), {{"bufferView", view},
                                                                                  {"byteOffset", 0u},
                                                                                  {"componentType", 5125u},
                                                                                  {"type", "SCALAR"},
                                                                                  {"count", corners}});
        rewritten[key] = {{"attributes", primitive["attributes"]}, {"indices", primitive["indices"]}};
    }
}

void Decompression::decode_batch(std::span<Draco> batch, double first, double last) {
    std::vector<DracoMesh> meshes;
    for (const Draco& draco : batch) meshes.push_back(draco.mesh);
    const auto progress = [&](double fraction) {
        context_.progress(0.4 + 0.1 * (first + (last - first) * fraction));
        return true;
    };
    DracoResults results;
    try {
        results = decode_draco(meshes, progress);
    } catch (const Error& error) {
        if (std::string_view(error.what()) == "cancelled") throw;
        const DracoPlace where(batch[0].primitives[0]);
        context_.fail(where.place, error.what(), kWithoutCompression);
    }
    const std::size_t buffer = add_buffer(std::move(results.bytes));
    for (std::size_t i = 0; i < batch.size(); ++i) rewrite_primitives(batch[i], results.meshes[i], buffer);
}

void Decompression::decode_primitives() {
    for (std::size_t m = 0; m < size_of("meshes"); ++m) {
        const auto primitives = root_["meshes"][m].find("primitives");
        if (primitives == root_["meshes"][m].end() || !primitives->is_array()) continue;
        for (std::size_t p = 0; p < primitives->size(); ++p)
            if (const Json* const extension = extension_of((*primitives)[p], kDraco)) find_draco({m, p}, *extension);
    }
    constexpr std::uint64_t kMaxBatchBytes = std::uint64_t{128} << 20;
    const double all = static_cast<double>(draco_.size());
    for (std::size_t first = 0, last = 0; first < draco_.size(); first = last) {
        std::uint64_t bytes = 0;
        const auto cost = [](const Draco& draco) { return draco.stated_bytes + draco.mesh.bytes.size(); };
        while (last < draco_.size() && (last == first || bytes + cost(draco_[last]) <= kMaxBatchBytes))
            bytes += cost(draco_[last++]);
        decode_batch(std::span(draco_).subspan(first, last - first), static_cast<double>(first) / all,
                     static_cast<double>(last) / all);
    }
}

}  // namespace

void decompress(Context& context, Json& root, Buffers& buffers) {
    Decompression decompression(context, root, buffers);
    decompression.decode_views();
    decompression.decode_primitives();
}

}  // namespace si::gltf
