#include "renderer/gltf/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "renderer/base/printable.h"

namespace si::gltf {
namespace {

constexpr std::size_t kMostImageBytes = std::size_t{768} << 20;  ///< while decoding one
constexpr std::size_t kMostTextureBytes = std::size_t{4} << 30;  ///< of all decoded ones

TextureWrap wrap_of(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::Clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::Mirror : TextureWrap::Repeat;
}

void apply_sampler(const tinygltf::Sampler& sampler, Texture& texture) {
    texture.wrap_s = wrap_of(sampler.wrapS);
    texture.wrap_t = wrap_of(sampler.wrapT);
    texture.nearest_mag = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    const int filter = sampler.minFilter;
    texture.nearest_min = filter == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                          filter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                          filter == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    texture.mipmaps = filter != TINYGLTF_TEXTURE_FILTER_NEAREST && filter != TINYGLTF_TEXTURE_FILTER_LINEAR;
}

/// Returns the extension of a glTF texture whose image format is not read here; empty: none.
std::string foreign_format(const Json& texture) {
    const Json* const extensions = member(&texture, "extensions");
    if (!extensions || !extensions->is_object()) return "";
    for (const auto& [name, value] : extensions->items()) {
        if (value.is_object() && value.contains("source")) return name;
    }
    return "";
}

}  // namespace

Textures::Textures(Context& context, const Json& root, const tinygltf::Model& model, Buffers& buffers, Scene& scene)
    : context_(context), root_(root), model_(model), buffers_(buffers), scene_(scene) {}

std::optional<int> Textures::readable_image(int texture) {
    const int source = model_.textures[std::size_t(texture)].source;
    if (source >= 0) return source;
    const std::string format = foreign_format(root_["textures"][std::size_t(texture)]);
    context_.warn(Place("textures", texture), format.empty()
                                                  ? "has no image; drawn untextured"
                                                  : fmt::format("{} is not supported; drawn untextured", format));
    return std::nullopt;
}

int Textures::use(int texture, bool srgb) {
    const int sampler = model_.textures[std::size_t(texture)].sampler;
    const int source = model_.textures[std::size_t(texture)].source;
    // A texture without a source has a unique negative key, so that it gives one warning.
    const auto key = std::tuple(source >= 0 ? source : -1 - texture, sampler, srgb);
    if (const auto it = known_.find(key); it != known_.end()) return it->second;
    int& index = known_[key];
    index = -1;
    const auto image = readable_image(texture);
    if (!image) return -1;

    Texture made;
    const Json& json = root_["images"][std::size_t(*image)];
    made.name = printable(text_member(json, "name"));
    made.srgb = srgb;
    if (sampler >= 0) apply_sampler(model_.samplers[std::size_t(sampler)], made);
    index = int(scene_.textures.size());
    jobs_.push_back({*image, scene_.textures.size()});
    scene_.textures.push_back(std::move(made));
    return index;
}

std::string Textures::fetch(int image, std::span<const std::uint8_t>& bytes, Bytes& storage) {
    const Json& json = root_["images"][std::size_t(image)];
    if (const auto uri_it = json.find("uri"); uri_it != json.end()) {
        if (!uri_it->is_string()) return "its uri is not a string";
        const auto& uri = uri_it->get_ref<const std::string&>();
        ReadResult read;
        if (is_data_uri(uri)) {
            read = decode_data_uri(uri);
        } else {
            const ResolvedUri resolved = resolve_uri(context_.path().parent_path(), uri);
            if (!resolved.error.empty()) return fmt::format("\"{}\": {}", uri.substr(0, 120), resolved.error);
            context_.note_file(resolved.path);
            read = read_regular_file(resolved.path, buffers_.bytes_left());
        }
        if (!read.error.empty()) return read.error;
        storage = std::move(read.bytes);
        buffers_.spend(storage.size);
        bytes = storage.span();
        return "";
    }
    if (!json.contains("bufferView")) return "has neither uri nor bufferView";
    const Json* const views = member(&root_, "bufferViews");
    const auto view = index_member(json, "bufferView", views ? views->size() : 0);
    if (!view) return "its bufferView does not exist";
    bytes = buffers_.view(*view);
    return bytes.empty() ? fmt::format("its bufferView {} is faulty", *view) : "";
}

Textures::Decoding Textures::start(const Job& job) {
    Decoding out;
    std::span<const std::uint8_t> bytes;
    out.error = fetch(job.image, bytes, out.storage);
    if (!out.error.empty()) return out;
    out.cost = decoding_bytes(bytes);
    if (out.cost > kMostImageBytes) {
        out.error = fmt::format("the image takes {} MiB to decode, at most {} are allowed; use a smaller one",
                                out.cost >> 20, kMostImageBytes >> 20);
        return out;
    }
    out.image = std::async(std::launch::async, [bytes] { return decode_image(bytes); });
    return out;
}

void Textures::decode() {
    const std::size_t lanes = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 8);
    std::vector<char> failed(scene_.textures.size(), 0);
    std::size_t total = 0;
    for (std::size_t first = 0; first < jobs_.size();) {
        context_.progress(0.6 + 0.35 * static_cast<double>(first) / static_cast<double>(jobs_.size()));
        std::vector<Decoding> batch;
        std::size_t cost = 0;
        while (first + batch.size() < jobs_.size() && batch.size() < lanes && cost <= kMostImageBytes / 2) {
            batch.push_back(start(jobs_[first + batch.size()]));
            cost += batch.back().cost;
        }
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const Job& job = jobs_[first + i];
            Image image = batch[i].error.empty() ? batch[i].image.get() : Image{0, 0, {}, batch[i].error};
            if (total + image.rgba.size() > kMostTextureBytes) image.error = "all textures together exceed 4 GiB";
            if (!image.error.empty()) {
                context_.warn(Place("images", job.image), image.error + "; drawn untextured");
                failed[job.scene_texture] = 1;
                continue;
            }
            Texture& texture = scene_.textures[job.scene_texture];
            total += image.rgba.size();
            texture.width = image.width;
            texture.height = image.height;
            texture.rgba = std::move(image.rgba);
        }
        first += batch.size();
    }
    remove_failed(failed);
}

void Textures::remove_failed(const std::vector<char>& failed) {
    std::vector<int> moved(failed.size(), -1);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < failed.size(); ++i) {
        if (failed[i]) continue;
        moved[i] = int(kept);
        if (kept != i) scene_.textures[kept] = std::move(scene_.textures[i]);
        ++kept;
    }
    scene_.textures.resize(kept);
    const auto remap = [&](int& texture) {
        if (texture >= 0) texture = moved[std::size_t(texture)];
    };
    for (Material& material : scene_.materials) {
        remap(material.base_colour_texture);
        remap(material.normal_texture);
    }
}

}  // namespace si::gltf
