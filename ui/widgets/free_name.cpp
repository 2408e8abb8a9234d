#include "ui/widgets/free_name.h"

#include <fmt/format.h>

#include <system_error>

namespace si {

namespace fs = std::filesystem;

fs::path free_bundle_path(const fs::path& folder, std::string stem) {
    for (char& c : stem)
        if (c == '/' || c == '\\' || c == ':') c = '-';
    std::error_code error;
    fs::path out = folder / (stem + ".bundle");
    for (int i = 2; fs::exists(fs::symlink_status(out, error)); ++i)
        out = folder / fmt::format("{}-{}.bundle", stem, i);
    return out;
}

}  // namespace si
