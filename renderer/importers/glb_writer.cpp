#include "renderer/importers/glb_writer.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "renderer/base/error.h"

namespace si {
namespace {

// Numbers that the glTF 2.0 specification takes from OpenGL.
constexpr int kFloatType = 5126, kUnsignedIntType = 5125;

constexpr std::uint64_t kMaxGlbBytes = 0xFFFFFFFFu;

template <class T>
std::span<const std::uint8_t> as_bytes(std::span<const T> values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

void append_words(std::vector<std::uint8_t>& out, std::initializer_list<std::uint32_t> words) {
    for (const std::uint32_t word : words)
        for (int i = 0; i < 4; ++i) out.push_back(std::uint8_t(word >> (8 * i)));
}

}  // namespace

int GlbWriter::add_view(std::span<const std::uint8_t> bytes) {
    if (binary_.size() + bytes.size() + 4 > kMaxGlbBytes) throw Error("the model is larger than 4 GiB");
    binary_.resize((binary_.size() + 3) / 4 * 4);
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    return append("bufferViews", std::move(view));
}

int GlbWriter::add_floats(std::span<const float> values, int width, bool with_bounds) {
    const auto step = std::size_t(width);
    nlohmann::json accessor = {{"bufferView", add_view(as_bytes(values))},
                               {"componentType", kFloatType},
                               {"count", values.size() / step},
                               {"type", "VEC" + std::to_string(width)}};
    for (std::size_t i = 0; with_bounds && i < step && i < values.size(); ++i) {
        float least = values[i], greatest = values[i];
        for (std::size_t v = i; v < values.size(); v += step) {
            least = std::min(least, values[v]);
            greatest = std::max(greatest, values[v]);
        }
        accessor["min"].push_back(double(least));
        accessor["max"].push_back(double(greatest));
    }
    return append("accessors", std::move(accessor));
}

int GlbWriter::add_indices(std::span<const std::uint32_t> indices) {
    return append("accessors", {{"bufferView", add_view(as_bytes(indices))},
                                {"componentType", kUnsignedIntType},
                                {"count", indices.size()},
                                {"type", "SCALAR"}});
}

int GlbWriter::append(const char* list, nlohmann::json object) {
    nlohmann::json& all = root[list];
    all.push_back(std::move(object));
    return int(all.size()) - 1;
}

std::vector<std::uint8_t> GlbWriter::bytes() {
    if (!binary_.empty()) root["buffers"] = nlohmann::json::array({{{"byteLength", binary_.size()}}});
    std::string text = root.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary_.resize((binary_.size() + 3) / 4 * 4);
    const std::uint64_t total = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
    if (total > kMaxGlbBytes) throw Error("the model is larger than 4 GiB");
    std::vector<std::uint8_t> out;
    out.reserve(std::size_t(total));
    append_words(out, {0x46546C67u, 2, std::uint32_t(total), std::uint32_t(text.size()), 0x4E4F534Au});
    out.insert(out.end(), text.begin(), text.end());
    if (!binary_.empty()) append_words(out, {std::uint32_t(binary_.size()), 0x004E4942u});
    out.insert(out.end(), binary_.begin(), binary_.end());
    return out;
}

}  // namespace si
