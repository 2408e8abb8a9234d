// Builder of small glTF files in a temporary folder.
#pragma once

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/gltf/gltf.h"

namespace si::test {

using Json = nlohmann::json;

/// Temporary folder, removed with its content by the destructor.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "si-gltf-XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    /// Returns the path of the folder.
    const std::filesystem::path& path() const { return path_; }
    /// Writes a file below the folder and returns its path. @param name relative path
    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const auto file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file;
    }

private:
    std::filesystem::path path_;
};

/// Builder of a glTF file: the JSON is public, binary data is appended by member functions.
class GltfFile {
public:
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", Json::array()}}}}};

    /// Appends values to the binary chunk as a buffer view of their own and returns its index. @param stride bytes; 0:
    /// tightly packed
    template <class T>
    int view(const std::vector<T>& values, int stride = 0) {
        while (bin_.size() % 4 != 0) bin_.push_back('\0');
        Json v = {{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) v["byteStride"] = stride;
        bin_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return append("bufferViews", v);
    }
    /// Appends an accessor and returns its index. @param view buffer view; -1: none
    /// @param component glTF component type, 5126 for floats
    /// @param offset bytes from the start of the view
    int accessor(int view, int component, const char* type, std::size_t count, std::size_t offset = 0,
                 bool normalized = false) {
        Json a = {{"componentType", component}, {"type", type}, {"count", count}};
        if (view >= 0) a["bufferView"] = view;
        if (offset > 0) a["byteOffset"] = offset;
        if (normalized) a["normalized"] = true;
        return append("accessors", a);
    }
    /// Appends floats with a view and an accessor of `type` ("VEC3") and returns the accessor's index.
    int floats(const std::vector<float>& values, const char* type) {
        const std::size_t width = std::string_view(type) == "SCALAR" ? 1
                                  : std::string_view(type) == "MAT4" ? 16
                                                                     : std::size_t(type[3] - '0');
        return accessor(view(values), 5126, type, values.size() / width);
    }
    /// Appends vertex indices with a view and an accessor and returns the accessor's index.
    template <class T>
    int indices(const std::vector<T>& values) {
        return accessor(view(values), sizeof(T) == 1 ? 5121 : sizeof(T) == 2 ? 5123 : 5125, "SCALAR", values.size());
    }
    /// Appends a mesh of one primitive and returns its index.
    int mesh(const Json& primitive) { return append("meshes", {{"primitives", {primitive}}}); }
    /// Appends a root node of scene 0 and returns its index.
    int root(const Json& node) {
        const int i = append("nodes", node);
        json["scenes"][0]["nodes"].push_back(i);
        return i;
    }
    /// Appends an element to a top-level array of the JSON and returns its index.
    int append(const char* array, const Json& element) {
        json[array].push_back(element);
        return static_cast<int>(json[array].size()) - 1;
    }
    /// Appends the triangle (0,0,0) (1,0,0) (0,1,0) and returns the accessor's index.
    int triangle_positions() { return floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"); }
    /// Adds a root node with a mesh of one triangle, triangle_positions().
    void add_triangle() { root({{"mesh", mesh({{"attributes", {{"POSITION", triangle_positions()}}}})}}); }

    /// Returns the file as .glb bytes.
    std::string glb() const {
        Json out = json;
        std::string bin = bin_;
        while (bin.size() % 4 != 0) bin.push_back('\0');
        if (!bin.empty()) out["buffers"] = {{{"byteLength", bin.size()}}};
        std::string text = out.dump();
        while (text.size() % 4 != 0) text.push_back(' ');
        std::string bytes = "glTF";
        const auto u32 = [&](std::size_t v) {
            for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(v >> (8 * i) & 0xff));
        };
        u32(2);
        u32(12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size()));
        u32(text.size());
        bytes += "JSON" + text;
        if (!bin.empty()) {
            u32(bin.size());
            bytes += std::string("BIN\0", 4) + bin;
        }
        return bytes;
    }
    /// Returns the binary chunk.
    const std::string& bin() const { return bin_; }
    /// Writes the file to a temporary folder and loads it. @throws Error
    Scene load(const GltfOptions& options = {}) const {
        const TemporaryFolder folder;
        return load_gltf(folder.write("model.glb", glb()), options);
    }
    /// Returns the message of the loading error; empty if the file loads.
    std::string error() const {
        try {
            load();
            return "";
        } catch (const Error& e) {
            return e.what();
        }
    }

private:
    std::string bin_;
};

/// Returns the bytes of a .glb: a floor, a leaf that shades it, and an animation that moves the leaf. @param seconds
/// length of the animation
/// @param from, to positions of the leaf, metres
inline std::string falling_leaf(float seconds, std::vector<float> from, const std::vector<float>& to) {
    GltfFile file;
    const auto mesh = [&](const std::vector<float>& corners) {
        return file.mesh({{"attributes", {{"POSITION", file.floats(corners, "VEC3")}}}});
    };
    file.root({{"mesh", mesh({-3, 0, -3, -3, 0, 3, 3, 0, 3, -3, 0, -3, 3, 0, 3, 3, 0, -3})}});
    const int leaf = file.root({{"mesh", mesh({-1, 1, -1, -1, 1, 1, 1, 1, 1})}});
    from.insert(from.end(), to.begin(), to.end());
    file.json["animations"] = {
        {{"samplers", {{{"input", file.floats({0, seconds}, "SCALAR")}, {"output", file.floats(from, "VEC3")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", leaf}, {"path", "translation"}}}}}}}};
    return file.glb();
}

/// Returns whether one of the lines contains `part`.
inline bool mentions(const std::vector<std::string>& lines, std::string_view part) {
    for (const std::string& line : lines) {
        if (line.find(part) != std::string::npos) return true;
    }
    return false;
}

}  // namespace si::test
