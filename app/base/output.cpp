#include "app/base/output.h"

#include <fmt/format.h>
#include <stb/stb_image_write.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/base/regular_file.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/map_image_exr.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTextBytes = std::size_t{16} << 20;

bool is_special(const fs::path& path) {
    std::error_code error;
    const auto status = fs::status(path, error);
    return !error && fs::exists(status) && !fs::is_regular_file(status);
}

/// Writes bytes directly to a device or pipe, which cannot be replaced atomically.
void write_special(const fs::path& path, std::string_view bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) throw Error(fmt::format("{}: cannot be written: {}", path.string(), errno_text()));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
    std::string why = written ? "" : errno_text();
    if (std::fclose(file) != 0 && why.empty()) why = errno_text();
    if (!why.empty()) throw Error(fmt::format("{}: cannot be written: {}", path.string(), why));
}

/// Appends encoded bytes to a std::string, for the encoders of stb.
void append(void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), std::size_t(size));
}

std::string png_bytes(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
    std::string bytes;
    if (!stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(), width * channels))
        throw Error(fmt::format("a picture of {} x {} pixels could not be encoded as PNG", width, height));
    return bytes;
}

}  // namespace

std::string errno_text() {
    return std::strerror(errno);
}

void require_writable(const fs::path& path) {
    std::error_code error;
    if (path.empty()) throw Error("an empty file name cannot be written; name a file");
    if (fs::is_directory(path, error)) throw Error(fmt::format("{}: is a directory; name a file in it", path.string()));
    if (!path.has_filename()) throw Error(fmt::format("{}: names no file", path.string()));
    if (is_special(path)) return;
    const fs::path target = writable_target(path);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw Error(fmt::format("{}: its folder {} does not exist; make it first", path.string(), folder.string()));
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        throw Error(
            fmt::format("{}: its folder {} cannot be written: {}", path.string(), folder.string(), errno_text()));
}

void require_distinct(const fs::path& a, std::string_view one, const fs::path& b, std::string_view other) {
    if (a.empty() || b.empty() || is_special(a)) return;
    std::error_code error;
    const auto same_place = [&](const fs::path& path) {
        const fs::path target = writable_target(path);
        return fs::weakly_canonical(target.parent_path().empty() ? "." : target.parent_path(), error) /
               target.filename();
    };
    if (same_place(a) == same_place(b) || fs::equivalent(a, b, error))
        throw UsageError(fmt::format("{}: {} and {} are one file; name two", b.string(), one, other));
}

void require_outputs_not_read(std::span<const fs::path> outputs, std::span<const fs::path> inputs) {
    for (const fs::path& output : outputs)
        for (const fs::path& input : inputs)
            if (std::error_code error; fs::equivalent(output, input, error))
                throw OutputIsInput(
                    output == input
                        ? fmt::format("{}: is read, so it cannot be written; name another file", output.string())
                        : fmt::format("{}: is the file {}, which is read; name another file to write", output.string(),
                                      input.string()));
}

void require_bundle_not_read(const fs::path& bundle, std::span<const fs::path> inputs) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(bundle, error);
    const fs::path folder = whole.has_filename() ? whole : whole.parent_path();
    for (const fs::path& input : inputs) {
        const fs::path path = fs::weakly_canonical(input, error);
        const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
        if (end == folder.end())
            throw UsageError(fmt::format("{}: {} of this bundle is read; write another one", printable(bundle.string()),
                                         printable(path.filename().string())));
    }
}

void require_output(const fs::path& path, std::string_view what, std::initializer_list<std::string_view> extensions) {
    if (std::ranges::find(extensions, lower_extension(path)) == extensions.end())
        throw UsageError(fmt::format("{}: {} must end in {}", path.string(), what, fmt::join(extensions, " or ")));
    require_writable(path);
}

void write_file(const fs::path& path, std::string_view bytes) {
    require_writable(path);
    if (is_special(path)) return write_special(path, bytes);
    write_atomically(path, {bytes});
}

void write_regular_file(const fs::path& path, std::string_view bytes) {
    require_regular(path);
    write_file(path, bytes);
}

bool is_taken(const fs::path& path) {
    std::error_code error;
    return fs::exists(fs::symlink_status(path, error));
}

void require_regular(const fs::path& path) {
    std::error_code error;
    if (is_special(path) && !fs::is_directory(path, error))
        throw Error(fmt::format("{}: is not a regular file; move it away or choose another place", path.string()));
}

std::string png_bytes(const ByteImage& image) {
    std::vector<std::uint8_t> rgb(image.data.size() / 4 * 3);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) std::copy_n(&image.data[4 * i], 3, &rgb[3 * i]);
    return png_bytes(image.width, image.height, 3, rgb);
}

std::string jpg_bytes(const ByteImage& image, int quality) {
    std::string bytes;
    if (!stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 4, image.data.data(), quality))
        throw Error(fmt::format("a picture of {} x {} pixels could not be encoded as JPEG", image.width, image.height));
    return bytes;
}

void write_png(const fs::path& path, const ByteImage& image) {
    write_file(path, png_bytes(image));
}

std::string pfm_bytes(const FloatImage& image) {
    static_assert(std::endian::native == std::endian::little, "the scale of -1 below says little-endian");
    std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", image.width, image.height);
    for (int y = image.height; y-- > 0;) {
        for (int x = 0; x < image.width; ++x) {
            const float v = image.at(x, y);
            char raw[sizeof v];
            std::memcpy(raw, &v, sizeof v);
            bytes.append(raw, sizeof v);
        }
    }
    return bytes;
}

void require_bundle_name(const std::string& path) {
    if (!is_bundle_path(path) || fs::path(path).filename() == kFrameJson)
        throw UsageError(fmt::format("{}: the name of a bundle ends in .bundle (a folder) or .zip", printable(path)));
}

bool is_float_file(const fs::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".pfm" || extension == ".exr";
}

void write_floats(const fs::path& path, const FloatImage& image) {
    write_file(path, lower_extension(path) == ".exr" ? exr_bytes(image) : pfm_bytes(image));
}

void write_scalar_image(const fs::path& path, const FloatImage& image) {
    if (is_float_file(path)) return write_floats(path, image);
    std::vector<std::uint8_t> grey(std::size_t(image.width) * std::size_t(image.height));
    for (std::size_t i = 0; i < grey.size(); ++i) {
        const float v = image.data[i * std::size_t(image.channels)];
        grey[i] = std::isnan(v) ? 0 : std::uint8_t(std::lround(std::clamp(v, 0.f, 1.f) * 255.f));
    }
    write_file(path, png_bytes(image.width, image.height, 1, grey));
}

std::string read_text_file(const fs::path& path) {
    std::error_code error;
    const auto status = fs::status(path, error);
    if (!fs::exists(status)) throw Error(fmt::format("{}: no such file", path.string()));
    if (!fs::is_regular_file(status)) throw Error(fmt::format("{}: is not a file", path.string()));
    if (fs::file_size(path, error) > kMaxTextBytes)
        throw Error(fmt::format("{}: is larger than 16 MiB, which no text file of this program is", path.string()));
    const ReadResult read = read_regular_file(path, kMaxTextBytes);
    if (!read.error.empty()) throw Error(fmt::format("{}: {}", path.string(), read.error));
    return std::string(read.bytes.text());
}

}  // namespace si
