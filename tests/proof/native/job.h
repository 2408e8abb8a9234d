// Jobs of the proof in engines, for engine programs in C++: reads JOB/job.json and its buffers, and writes JOB/mask.pgm
// and JOB/facts.json. The program shares no code with the program under test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace proof {

using Matrix = std::array<double, 16>;  ///< column-major

/// Geometry of one object, with indices of its own.
struct Object {
    std::vector<float> positions, normals;  ///< x y z, world space, metres
    std::vector<std::uint32_t> indices;
    bool casts = true, receives = true, double_sided = false;
};

/// Scene, camera and light that an engine draws.
struct Job {
    std::filesystem::path folder;
    nlohmann::json json;
    std::vector<Object> objects;
    int width_px = 0, height_px = 0, map_resolution = 0;

    double camera(const char* key) const { return json["camera"][key].get<double>(); }
    double light(const char* key) const { return json["light"][key].get<double>(); }
    /// Returns a parameter of the engine's profile, or another value where the job sets none.
    template <typename T>
    T parameter(const char* key, T otherwise) const {
        return json.value("parameters", nlohmann::json::object()).value(key, otherwise);
    }
    /// Returns the name of a choice of the engine's profile; true and false may be given without quotes.
    std::string choice(const char* key, const char* otherwise) const {
        const nlohmann::json value = parameter(key, nlohmann::json(otherwise));
        return value.is_boolean() ? (value.get<bool>() ? "true" : "false") : value.get<std::string>();
    }
};

inline Matrix matrix_of(const nlohmann::json& numbers) {
    Matrix out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = numbers.at(i).get<double>();
    return out;
}

/// Returns the product of two matrices.
inline Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            for (int k = 0; k < 4; ++k) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    return out;
}

/// Returns the inverse of a rotation and translation.
inline Matrix inverse_of_pose(const Matrix& m) {
    Matrix out{};
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) out[4 * column + row] = m[4 * row + column];
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k) out[12 + row] -= out[4 * k + row] * m[12 + k];
    out[15] = 1;
    return out;
}

template <typename T>
std::vector<T> read_buffer(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": cannot be read");
    std::vector<T> out(std::filesystem::file_size(file) / sizeof(T));
    in.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size() * sizeof(T)));
    return out;
}

/// Reads a job. @throws std::exception for a file that is missing or malformed
inline Job read_job(const std::filesystem::path& folder) {
    Job job;
    job.folder = folder;
    std::ifstream in(folder / "job.json");
    if (!in) throw std::runtime_error((folder / "job.json").string() + ": cannot be read");
    job.json = nlohmann::json::parse(in);
    const auto positions = read_buffer<float>(folder / job.json["positions"].get<std::string>());
    const auto normals = read_buffer<float>(folder / job.json["normals"].get<std::string>());
    const auto indices = read_buffer<std::uint32_t>(folder / job.json["indices"].get<std::string>());
    job.width_px = job.json["camera"]["width"];
    job.height_px = job.json["camera"]["height"];
    job.map_resolution = job.json["map_resolution"];
    for (const nlohmann::json& row : job.json["objects"]) {
        Object object;
        const auto begin = indices.begin() + row["first_index"].get<std::ptrdiff_t>();
        object.indices.assign(begin, begin + row["index_count"].get<std::ptrdiff_t>());
        if (object.indices.empty()) continue;
        const auto [low, high] = std::ranges::minmax(object.indices);
        object.positions.assign(positions.begin() + 3 * low, positions.begin() + 3 * (high + 1));
        object.normals.assign(normals.begin() + 3 * low, normals.begin() + 3 * (high + 1));
        for (std::uint32_t& index : object.indices) index -= low;
        object.casts = row.value("casts", true);
        object.receives = row.value("receives", true);
        object.double_sided = row.value("double_sided", false);
        job.objects.push_back(std::move(object));
    }
    return job;
}

/// Writes the mask: the picture with shadows over the one without, both of linear RGBA floats, top row first. Pixels
/// without light are white.
inline void write_mask(const Job& job, const std::vector<float>& shadowed, const std::vector<float>& lit) {
    constexpr float kDark = 1e-5F;
    constexpr int kChannels = 4, kWhite = 255;
    std::ofstream out(job.folder / "mask.pgm", std::ios::binary);
    out << "P5\n" << job.width_px << ' ' << job.height_px << "\n255\n";
    for (std::size_t i = 0; i < lit.size(); i += kChannels) {
        const float share = lit[i] > kDark ? std::clamp(shadowed[i] / lit[i], 0.F, 1.F) : 1.F;
        out.put(char(std::lround(kWhite * share)));
    }
    if (!out) throw std::runtime_error("mask.pgm: cannot be written");
}

/// Writes what the engine fitted. The box follows from the rows of the matrix, which has no perspective.
/// @param near_clip z of the near plane in clip space @param far_clip z of the far plane
inline void write_facts(const Job& job, nlohmann::json facts, const Matrix& clip_from_world, double near_clip,
                        double far_clip) {
    const auto length = [&](int row) {
        return std::hypot(clip_from_world[row], clip_from_world[4 + row], clip_from_world[8 + row]);
    };
    facts["width_m"] = 2 / length(0);
    facts["height_m"] = 2 / length(1);
    facts["depth_m"] = std::abs(far_clip - near_clip) / length(2);
    facts["clip_from_world"] = clip_from_world;
    std::ofstream out(job.folder / "facts.json");
    out << facts.dump(1) << '\n';
    if (!out) throw std::runtime_error("facts.json: cannot be written");
}

}  // namespace proof
