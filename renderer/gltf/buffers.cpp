#include "renderer/gltf/buffers.h"

#include <fmt/format.h>

#include "renderer/base/percent_decoded.h"

namespace si::gltf {

Buffers::Buffers(Context& context, const Json& root, const Container& container)
    : context_(context), root_(root), container_(container), bytes_left_(context.options().max_file_bytes) {
    const auto buffers = root.find("buffers");
    if (buffers == root.end()) return;
    loaded_.resize(buffers->size());
    spans_.resize(buffers->size());
}

Bytes Buffers::load(const Json& buffer, const Place& place) {
    const auto& uri = buffer["uri"].get_ref<const std::string&>();
    const Place here(place, "uri");
    ReadResult read;
    if (is_data_uri(uri)) {
        read = decode_data_uri(uri);
        if (!read.error.empty()) context_.fail(here, read.error, "repair the file or export it again");
    } else if (const auto& read_file = context_.options().read_file) {
        read = read_file(percent_decode(uri), bytes_left_);
        if (!read.error.empty())
            context_.fail(here, fmt::format("\"{}\" {}", uri.substr(0, 120), read.error),
                          "put the file next to the model and name it by a relative path");
        spend(read.bytes.size);
    } else {
        const ResolvedUri resolved = resolve_uri(context_.path().parent_path(), uri);
        if (!resolved.error.empty()) {
            context_.fail(here, fmt::format("\"{}\": {}", uri.substr(0, 120), resolved.error),
                          "put the file next to the model and name it by a relative path");
        }
        context_.note_file(resolved.path);
        read = read_regular_file(resolved.path, bytes_left_, [this](double) { context_.progress(0.4); });
        if (!read.error.empty()) {
            context_.fail(here, fmt::format("\"{}\" {}", uri.substr(0, 120), read.error),
                          "put the whole file next to the model");
        }
        spend(read.bytes.size);
    }
    return std::move(read.bytes);
}

std::span<const std::uint8_t> Buffers::buffer(std::size_t i) {
    if (!spans_[i].empty()) return spans_[i];
    const Place place("buffers", i);
    const Json& json = root_["buffers"][i];
    const auto wanted = json["byteLength"].get<std::uint64_t>();
    std::span<const std::uint8_t> all;
    if (json.contains("uri")) {
        loaded_[i] = load(json, place);
        all = loaded_[i].span();
    } else if (i == 0 && container_.has_bin) {
        all = container_.bin;
    } else {
        context_.fail(place, "has no uri and no binary chunk", "export the model again with its buffers");
    }
    if (all.size() < wanted) {
        context_.fail(place, fmt::format("byteLength is {} but only {} bytes are there", wanted, all.size()),
                      "the data is cut, export or copy the model again");
    }
    bytes_loaded_ += std::size_t(wanted);
    return spans_[i] = all.first(std::size_t(wanted));
}

void Buffers::add(std::vector<std::uint8_t> bytes) {
    decoded_.push_back(std::move(bytes));
    spans_.push_back(decoded_.back());
    spend(decoded_.back().size());
    bytes_loaded_ += decoded_.back().size();
}

std::span<const std::uint8_t> Buffers::view(std::size_t i) {
    const Json& json = root_["bufferViews"][i];
    if (json["byteLength"] == 0) return {};
    return buffer(json["buffer"].get<std::size_t>())
        .subspan(json.value("byteOffset", std::size_t{0}), json["byteLength"].get<std::size_t>());
}

}  // namespace si::gltf
