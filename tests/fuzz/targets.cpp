// Fuzz targets for models, presets, setting values, decoders and bundles.
#include "tests/fuzz/targets.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string_view>

#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/base/error.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/bundle/map_image.h"
#include "renderer/foreign/pack.h"
#include "renderer/gltf/draco.h"
#include "renderer/gltf/gltf.h"
#include "renderer/gltf/meshopt.h"
#include "renderer/gltf/webp.h"
#include "renderer/measure/axes.h"
#include "renderer/scene/animation.h"
#include "renderer/settings/param.h"

namespace si::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLines = 6;  ///< limit of lines; each may be compared with all names

void require(bool holds, const std::string& what) {
    if (!holds) throw std::logic_error(what);
}

/// Runs code that may refuse its input; other exceptions are findings. Messages must be one line of bounded length
/// without control characters.
template <class Action>
bool is_accepted(const Action& action) {
    try {
        action();
        return true;
    } catch (const Error& e) {
        const std::string_view said = e.what();
        require(!said.empty() && said.size() < 4000, fmt::format("a message of {} bytes", said.size()));
        return false;
    }
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Temporary folder of this process, removed at its end.
const fs::path& own_folder() {
    struct Folder {
        fs::path path;
        Folder() {
            std::string pattern = (fs::temp_directory_path() / "si-fuzz-XXXXXX").string();
            if (!::mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
            path = pattern;
        }
        ~Folder() {
            std::error_code ignored;
            fs::remove_all(path, ignored);
        }
    };
    static const Folder folder;
    return folder.path;
}

void require_valid(const Scene& scene) {
    const auto finite = [](const auto& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    if (!scene.bounds.empty())  // a pose may leave nothing to be drawn
        require(finite(scene.bounds.lo) && finite(scene.bounds.hi), "the scene's bounds are not finite");
    for (const Mesh& mesh : scene.meshes) {
        for (const auto& p : mesh.positions) require(finite(p), "a position is not finite");
        for (const std::uint32_t i : mesh.indices) require(i < mesh.positions.size(), "an index is out of range");
        require(mesh.material < int(scene.materials.size()), "a mesh without its material");
    }
    for (const Object& object : scene.objects) {
        require(object.mesh >= 0 && std::size_t(object.mesh) < scene.meshes.size(), "an object without a mesh");
        require(object.node >= 0 && std::size_t(object.node) < scene.nodes.size(), "an object without a node");
    }
}

void fuzz_gltf(std::span<const std::uint8_t> bytes) {
    const fs::path file = own_folder() / "model.glb";  // the content decides, not the name
    {
        std::ofstream out(file, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    is_accepted([&] {
        Scene scene = load_gltf(file);
        require_valid(scene);
        is_accepted([&] { base_settings(scene); });
        if (scene.rig && !scene.rig->animations.empty()) {
            pose_scene(scene, {.animation = 0, .time = 0.5});
            require_valid(scene);
        }
    });
}

void fuzz_preset(std::span<const std::uint8_t> bytes) {
    is_accepted([&] {
        Preset preset = parse_preset(text_of(bytes), "p.json");
        const std::string text = preset_text(preset);
        const Preset again = parse_preset(text, "again.json");
        require(again.settings == preset.settings, "written and read again, the settings differ");
        require(preset_text(again) == text, "written and read again, the text differs");
        sanitise(preset.settings);
        require(sanitise(preset.settings).empty(), "repaired settings are repaired again");
    });
}

void fuzz_value(std::span<const std::uint8_t> bytes) {
    std::string_view rest = text_of(bytes);
    Settings settings;
    for (int lines = 0; lines < kMaxLines && !rest.empty(); ++lines) {
        const std::string line(rest.substr(0, rest.find('\n')));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        if (is_accepted([&] { apply_set(settings, line); })) {
            const auto ref = find_setting(std::string_view(line).substr(0, line.rfind('=')));
            require(ref.has_value(), "a setting that was set is not there");
            const Value value = get_value(settings, *ref);
            require(parse_value(*ref, value_text(*ref->param, value)) == value, "its text is another value: " + line);
        }
        is_accepted([&] {
            const SweepAxis axis = parse_axis(line);
            require(!axis.values.empty(), "an axis without values");
        });
    }
    sanitise(settings);
    require(sanitise(settings).empty(), "repaired settings are repaired again");
}

/// Runs a decoder, which may refuse its input also for want of memory. Decoders run in this process here, so that a
/// sanitizer sees their faults.
template <class Action>
bool is_decoded(const Action& action) {
    try {
        return is_accepted(action);
    } catch (const std::bad_alloc&) {
        return false;
    }
}

/// A byte for the type of the attribute with the id 0, then Draco data.
void fuzz_draco(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return;
    static constexpr int kTypes[] = {5126, 5120, 5121, 5122, 5123, 5125};
    gltf::DracoMesh mesh;
    mesh.bytes = bytes.subspan(1);
    mesh.attributes = {{0, kTypes[bytes[0] % 6], 1 + bytes[0] / 6 % 4}};
    is_decoded([&] {
        const auto answer = gltf::decode_packed_draco(gltf::pack_draco({&mesh, 1}), [](double) {});
        PackReader in(answer);
        if (!in.text().empty()) return;
        const std::uint64_t points = in.number(), faces = in.number();
        const auto indices = in.block();
        require(indices.size() == faces * 12, "other indices than faces");
        for (std::size_t i = 0; i < indices.size(); i += 4) {
            std::uint32_t index = 0;
            std::memcpy(&index, indices.data() + i, 4);
            require(index < points, "an index is out of range");
        }
    });
}

/// Three bytes for mode and filter, stride and count, then the stream.
void fuzz_meshopt(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < 3) return;
    static constexpr const char* kModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static constexpr const char* kFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    const gltf::MeshoptStream stream{kModes[bytes[0] % 3], kFilters[bytes[0] / 3 % 4], bytes[2], bytes[1]};
    is_decoded([&] {
        std::vector<std::uint8_t> out(gltf::checked_meshopt_bytes(stream, bytes.size() - 3));
        gltf::decode_meshopt(stream, bytes.subspan(3), out);
    });
}

void fuzz_webp(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
    is_decoded([&] { gltf::decode_packed_webp(gltf::pack_webp({&bytes, 1}, kMaxBytes), [](double) {}); });
}

/// Text of a frame.json.
void fuzz_bundle(std::span<const std::uint8_t> bytes) {
    is_accepted([&] {
        const Bundle bundle = parse_bundle(text_of(bytes), "frame.json");
        const std::string text = format_bundle(bundle);
        require(parse_bundle(text, "again.json") == bundle, "written and read again, the bundle differs");
        require(format_bundle(parse_bundle(text, "again.json")) == text, "written and read again, the text differs");
    });
}

/// A zip file, whose entries are read.
void fuzz_zip(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
    const fs::path file = own_folder() / "a.zip";
    {
        std::ofstream out(file, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    is_accepted([&] {
        BundleFiles files(file);
        for (const char* name : {"frame.json", "sun.pfm", "scene.glb"})
            is_accepted([&] {
                const std::vector<std::byte> entry = files.read(name, kMaxBytes);
                require(entry.size() <= kMaxBytes, "an entry above the limit");
                if (name == std::string_view("sun.pfm")) decode_map_image(name, entry, {});
            });
    });
}

}  // namespace

const std::vector<Target>& targets() {
    static const std::vector<Target> all = {{"gltf", fuzz_gltf},     {"preset", fuzz_preset},   {"value", fuzz_value},
                                            {"draco", fuzz_draco},   {"meshopt", fuzz_meshopt}, {"webp", fuzz_webp},
                                            {"bundle", fuzz_bundle}, {"zip", fuzz_zip}};
    return all;
}

}  // namespace si::fuzz
