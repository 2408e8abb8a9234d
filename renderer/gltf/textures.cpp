#include "renderer/gltf/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "renderer/base/percent_decoded.h"
#include "renderer/base/printable.h"
#include "renderer/gltf/webp.h"

namespace si::gltf {
namespace {

constexpr std::size_t kMostImageBytes = std::size_t{768} << 20;  ///< while decoding one
constexpr std::size_t kMostTextureBytes = std::size_t{4} << 30;  ///< of all decoded ones

/// Returns the number of images that are decoded at once.
std::size_t lane_count() {
    return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 8);
}

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

std::optional<int> Textures::webp_image(int texture) const {
    const Json* const webp = extension_of(root_["textures"][std::size_t(texture)], "EXT_texture_webp");
    const Json* const images = member(&root_, "images");
    if (!webp || !images) return std::nullopt;
    const auto index = index_member(*webp, "source", images->size());
    return index ? std::optional(int(*index)) : std::nullopt;
}

std::optional<int> Textures::readable_image(int texture) {
    // The extension's image comes first: a PNG or JPEG beside it is for readers without WebP.
    if (const auto webp = webp_image(texture)) return webp;
    const int source = model_.textures[std::size_t(texture)].source;
    if (source >= 0) return source;
    const std::string format = foreign_format(root_["textures"][std::size_t(texture)]);
    context_.warn(Place("textures", texture), format.empty()
                                                  ? "has no image; drawn untextured"
                                                  : fmt::format("{} is not supported; drawn untextured", format));
    return std::nullopt;
}

bool Textures::is_ktx2_alone(int texture) const {
    return model_.textures[std::size_t(texture)].source < 0 &&
           foreign_format(root_["textures"][std::size_t(texture)]) == "KHR_texture_basisu";
}

void Textures::warn_lost_alpha(std::size_t material, bool is_ktx2) {
    const AlphaMode alpha = scene_.materials[material].alpha;
    if (alpha == AlphaMode::Opaque) return;
    context_.warn(Place("materials", material),
                  fmt::format("its alpha ({}) is in an image that is not read, so its shadow is wrong; {}",
                              alpha == AlphaMode::Mask ? "MASK" : "BLEND",
                              is_ktx2 ? "convert KTX2 images (gltf-transform ktxdecompress IN OUT)"
                                      : "use PNG, JPEG or WebP images"));
}

int Textures::use(int texture, bool srgb) {
    const int sampler = model_.textures[std::size_t(texture)].sampler;
    const bool says_webp = webp_image(texture).has_value();
    const int source = webp_image(texture).value_or(model_.textures[std::size_t(texture)].source);
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
    jobs_.push_back({*image, scene_.textures.size(), says_webp});
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
        } else if (const auto& read_file = context_.options().read_file) {
            read = read_file(percent_decode(uri), buffers_.bytes_left());
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
    if (is_webp(bytes)) {
        if (!job.says_webp)
            context_.warn(Place("images", job.image), "is WebP without EXT_texture_webp, which not all programs read");
        out.webp = bytes;
        return out;
    }
    out.cost = decoding_bytes(bytes);
    if (out.cost > kMostImageBytes) {
        out.error = fmt::format("the image takes {} MiB to decode, at most {} are allowed; use a smaller one",
                                out.cost >> 20, kMostImageBytes >> 20);
        return out;
    }
    out.image = std::async(std::launch::async, [bytes] { return decode_image(bytes); });
    return out;
}

void Textures::keep(const Job& job, Image image) {
    if (decoded_bytes_ + image.rgba.size() > kMostTextureBytes) image.error = "all textures together exceed 4 GiB";
    if (!image.error.empty()) {
        context_.warn(Place("images", job.image), image.error + "; drawn untextured");
        const bool ktx2 = image.error.starts_with("KTX2");
        failures_[job.scene_texture] = ktx2 ? Failure::Ktx2 : Failure::Unreadable;
        return;
    }
    Texture& texture = scene_.textures[job.scene_texture];
    decoded_bytes_ += image.rgba.size();
    texture.width = image.width;
    texture.height = image.height;
    texture.rgba = std::move(image.rgba);
}

std::vector<Image> Textures::decode_webp_images(const std::vector<Decoding>& waiting) {
    const std::size_t lanes = std::min(lane_count(), waiting.size());
    std::atomic<std::size_t> bytes_left = kMostTextureBytes - decoded_bytes_;
    std::atomic<bool> stop = false;
    std::vector<std::vector<std::span<const std::uint8_t>>> parts(lanes);
    for (std::size_t i = 0; i < waiting.size(); ++i) parts[i % lanes].push_back(waiting[i].webp);
    std::vector<std::future<std::vector<Image>>> running;
    for (const auto& part : parts)
        running.push_back(
            std::async(std::launch::async, [&] { return decode_webp(part, kMostImageBytes, bytes_left, stop); }));
    std::vector<Image> out(waiting.size());
    try {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            while (running[lane].wait_for(std::chrono::milliseconds(50)) != std::future_status::ready)
                context_.progress(0.9);
            std::vector<Image> images = running[lane].get();
            for (std::size_t i = 0; i < images.size(); ++i) out[lane + i * lanes] = std::move(images[i]);
        }
    } catch (...) {
        stop = true;  // the futures wait for the end of their children
        throw;
    }
    return out;
}

void Textures::decode() {
    failures_.assign(scene_.textures.size(), Failure::None);
    std::vector<Decoding> waiting;
    std::vector<Job> waiting_jobs;
    for (std::size_t first = 0; first < jobs_.size();) {
        context_.progress(0.6 + 0.3 * static_cast<double>(first) / static_cast<double>(jobs_.size()));
        std::vector<Decoding> batch;
        std::size_t cost = 0;
        while (first + batch.size() < jobs_.size() && batch.size() < lane_count() && cost <= kMostImageBytes / 2) {
            batch.push_back(start(jobs_[first + batch.size()]));
            cost += batch.back().cost;
        }
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const Job& job = jobs_[first + i];
            if (!batch[i].webp.empty()) {
                waiting.push_back(std::move(batch[i]));
                waiting_jobs.push_back(job);
                continue;
            }
            keep(job, batch[i].error.empty() ? batch[i].image.get() : Image{0, 0, {}, batch[i].error});
        }
        first += batch.size();
    }
    if (!waiting.empty()) {
        std::vector<Image> images = decode_webp_images(waiting);
        for (std::size_t i = 0; i < images.size(); ++i) keep(waiting_jobs[i], std::move(images[i]));
    }
    remove_failed();
}

void Textures::remove_failed() {
    std::vector<int> moved(failures_.size(), -1);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < failures_.size(); ++i) {
        if (failures_[i] != Failure::None) continue;
        moved[i] = int(kept);
        if (kept != i) scene_.textures[kept] = std::move(scene_.textures[i]);
        ++kept;
    }
    scene_.textures.resize(kept);
    const auto remap = [&](int& texture) {
        if (texture >= 0) texture = moved[std::size_t(texture)];
    };
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
        Material& material = scene_.materials[i];
        if (const int texture = material.base_colour_texture; texture >= 0 && moved[std::size_t(texture)] < 0)
            warn_lost_alpha(i, failures_[std::size_t(texture)] == Failure::Ktx2);
        remap(material.base_colour_texture);
        remap(material.normal_texture);
    }
}

}  // namespace si::gltf
