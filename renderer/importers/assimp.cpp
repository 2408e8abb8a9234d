#include "renderer/importers/assimp.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/importers/assimp_files.h"
#include "renderer/importers/assimp_job.h"

namespace si {
namespace {

namespace fs = std::filesystem;

constexpr double kConversionShare = 0.6;  // of the progress

[[noreturn]] void refuse(const fs::path& path, std::string_view what, std::string_view fix) {
    throw Error(fmt::format("{}: {}; {}", printable(path.string(), 300), what, fix));
}

/// Returns the path of a model without links. @throws Error unless it is a regular file of allowed size
fs::path checked_path(const fs::path& path, std::size_t max_bytes) {
    constexpr std::string_view kFix = "give the path of a model";
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (error) refuse(path, fmt::format("cannot be opened ({})", error.message()), kFix);
    if (fs::is_directory(real, error)) refuse(path, "is a directory", kFix);
    if (!fs::is_regular_file(real, error)) refuse(path, "is not a regular file", kFix);
    const std::uintmax_t size = fs::file_size(real, error);
    if (error) refuse(path, fmt::format("cannot be examined ({})", error.message()), kFix);
    if (size > max_bytes)
        refuse(path, fmt::format("has {} bytes, more than the limit of {}", size, max_bytes), "use a smaller model");
    return real;
}

/// Returns the name of a file's format for messages: its extension in capitals, "OBJ".
std::string format_of(const fs::path& path) {
    std::string out = path.extension().string().substr(1);
    for (char& c : out)
        if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
    return out;
}

}  // namespace

Scene load_by_assimp(const fs::path& path, const GltfOptions& options) {
    const fs::path real = checked_path(path, std::min(options.max_file_bytes, assimp::kMaxFileBytes));
    const AssimpRequest request{real.filename().string(), format_of(path)};
    bool cancelled = false;
    const auto report = [&](double share) {
        if (options.progress && !options.progress(share)) cancelled = true;
        return !cancelled;
    };
    std::vector<std::uint8_t> glb;
    try {
        const fs::path folder = real.parent_path();
        glb = run_foreign_job(kAssimpJob, assimp_request_bytes(request), {}, &folder,
                              [&](double share) { return report(kConversionShare * share); });
    } catch (const Error& error) {
        if (cancelled) throw;
        refuse(path, error.what(), "repair the file or export it again, best as glTF");
    }
    GltfOptions rest = options;
    rest.progress = [&](double share) { return report(kConversionShare + (1 - kConversionShare) * share); };
    return load_converted(glb, path, rest);
}

}  // namespace si
