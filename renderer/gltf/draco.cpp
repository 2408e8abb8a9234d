#include "renderer/gltf/draco.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <cstring>

#include "renderer/foreign/pack.h"
#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

/// Limit of the decoded bytes of one job, so that answer and Draco's own copy fit into the memory of a child.
constexpr std::uint64_t kMaxJobBytes = std::uint64_t{512} << 20;

/// Writes an attribute, a value a point, as numbers of type T.
template <class T>
void write_values(const draco::Mesh& mesh, const draco::PointAttribute& from, int width, std::uint8_t* out) {
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = from.mapped_index(draco::PointIndex(i));
        T numbers[4] = {};
        if (value.value() >= from.size() || !from.ConvertValue<T>(value, std::int8_t(width), numbers))
            throw Error("a value is out of range of its accessor's type");
        std::memcpy(out, numbers, std::size_t(width) * sizeof(T));
        out += std::size_t(width) * sizeof(T);
    }
}

void write_values(const draco::Mesh& mesh, const draco::PointAttribute& from, const DracoAttribute& to,
                  std::uint8_t* out) {
    switch (to.component_type) {
        case 5120:
            return write_values<std::int8_t>(mesh, from, to.width, out);
        case 5121:
            return write_values<std::uint8_t>(mesh, from, to.width, out);
        case 5122:
            return write_values<std::int16_t>(mesh, from, to.width, out);
        case 5123:
            return write_values<std::uint16_t>(mesh, from, to.width, out);
        case 5125:
            return write_values<std::uint32_t>(mesh, from, to.width, out);
        default:
            return write_values<float>(mesh, from, to.width, out);
    }
}

/// Returns the bytes of an element of an attribute.
std::size_t element_bytes_of(const DracoAttribute& attribute) {
    return std::size_t(attribute.width) * component_bytes(std::uint64_t(attribute.component_type));
}

std::unique_ptr<draco::Mesh> decoded_mesh(std::span<const std::uint8_t> bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto kind = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!kind.ok()) throw Error("its data are no Draco mesh, or damaged");
    if (kind.value() != draco::TRIANGULAR_MESH) throw Error("its Draco data are points, not triangles");
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) throw Error("its Draco data are damaged");
    return std::move(mesh).value();
}

/// Decodes a mesh into `out`. @param budget decoded bytes that the job may still give, which shrink
void decode_mesh(std::span<const std::uint8_t> bytes, std::span<const DracoAttribute> attributes, PackWriter& out,
                 std::uint64_t& budget) {
    const auto mesh = decoded_mesh(bytes);
    std::uint64_t total = std::uint64_t(mesh->num_faces()) * 12;
    for (const DracoAttribute& wanted : attributes) total += mesh->num_points() * element_bytes_of(wanted);
    if (total > budget)
        throw Error(fmt::format("it decodes to {} MiB, more than {} are read", total >> 20, budget >> 20));
    budget -= total;

    std::vector<std::uint8_t> part(std::size_t(mesh->num_faces()) * 12);
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(f));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t index = face[corner].value();
            if (index >= mesh->num_points()) throw Error(fmt::format("index {} is out of range", index));
            std::memcpy(part.data() + (3 * f + corner) * 4, &index, 4);
        }
    }
    std::vector<std::vector<std::uint8_t>> parts = {std::move(part)};
    for (const DracoAttribute& wanted : attributes) {
        const draco::PointAttribute* const from = mesh->GetAttributeByUniqueId(wanted.id);
        if (!from) throw Error(fmt::format("its Draco data have no attribute {}", wanted.id));
        if (from->num_components() != wanted.width)
            throw Error(fmt::format("Draco attribute {} has {} components, its accessor has {}", wanted.id,
                                    int(from->num_components()), wanted.width));
        std::vector<std::uint8_t> values(mesh->num_points() * element_bytes_of(wanted));
        write_values(*mesh, *from, wanted, values.data());
        parts.push_back(std::move(values));
    }
    out.block(std::string_view());  // no error
    out.number(mesh->num_points());
    out.number(mesh->num_faces());
    for (const auto& bytes_of_part : parts) out.block(bytes_of_part);
}

std::vector<std::uint8_t> run_job(std::span<const std::uint8_t> request, const std::function<void(double)>& progress,
                                  int) {
    return decode_packed_draco(request, progress);
}

}  // namespace

constinit const ForeignJob kDracoJob = {"draco", "the Draco decoder", run_job};

std::vector<std::uint8_t> pack_draco(std::span<const DracoMesh> meshes) {
    PackWriter out;
    for (const DracoMesh& mesh : meshes) {
        out.number(mesh.attributes.size());
        for (const DracoAttribute& attribute : mesh.attributes) {
            out.number(attribute.id);
            out.number(std::uint64_t(attribute.component_type));
            out.number(std::uint64_t(attribute.width));
        }
        out.block(mesh.bytes);
    }
    return std::move(out.bytes());
}

std::vector<std::uint8_t> decode_packed_draco(std::span<const std::uint8_t> request,
                                              const std::function<void(double)>& progress) {
    PackReader in(request);
    PackWriter out;
    std::uint64_t budget = kMaxJobBytes;
    const double size = static_cast<double>(request.size());
    double done = 0;
    while (!in.at_end()) {
        std::vector<DracoAttribute> attributes;
        for (std::uint64_t left = in.number(); left > 0; --left) {
            DracoAttribute attribute;
            attribute.id = std::uint32_t(in.number());
            attribute.component_type = int(in.number());
            attribute.width = int(in.number());
            if (attribute.width < 1 || attribute.width > 4 ||
                component_bytes(std::uint64_t(attribute.component_type)) == 0)
                throw Error("a Draco attribute has no valid type");
            attributes.push_back(attribute);
        }
        const auto bytes = in.block();
        try {
            decode_mesh(bytes, attributes, out, budget);
        } catch (const Error& error) {
            out.block(std::string_view(error.what()));
        }
        done += static_cast<double>(bytes.size());
        progress(std::min(1.0, done / size));
    }
    return std::move(out.bytes());
}

DracoResults decode_draco(std::span<const DracoMesh> meshes, const std::function<bool(double)>& progress) {
    DracoResults out;
    out.bytes = run_foreign_job(kDracoJob, pack_draco(meshes), {}, nullptr, progress);
    PackReader in(out.bytes);
    const auto offset = [&](std::span<const std::uint8_t> block) {
        return std::size_t(block.data() - out.bytes.data());
    };
    for (const DracoMesh& mesh : meshes) {
        DracoResult& result = out.meshes.emplace_back();
        result.error = in.text();
        if (!result.error.empty()) continue;
        result.points = in.number();
        result.faces = in.number();
        const auto indices = in.block();
        result.indices_at = offset(indices);
        bool fits = result.faces <= indices.size() / 12;
        for (const DracoAttribute& attribute : mesh.attributes) {
            const auto values = in.block();
            result.attributes_at.push_back(offset(values));
            fits = fits && result.points <= values.size() / element_bytes_of(attribute);
        }
        if (!fits) throw Error("the Draco decoder returns less than it states");
    }
    return out;
}

}  // namespace si::gltf
