#include "renderer/base/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "renderer/base/error.h"

namespace si {

TemporaryFolder::TemporaryFolder(const std::filesystem::path& pattern) {
    std::string name = pattern.string();
    if (::mkdtemp(name.data())) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

TemporaryFolder make_temporary_folder(std::string_view name) {
    std::error_code error;
    const std::filesystem::path place = std::filesystem::temp_directory_path(error);
    if (error)
        throw Error(fmt::format("the folder of temporary files cannot be used: {}; set TMPDIR to another folder",
                                error.message()));
    TemporaryFolder folder(place / fmt::format("{}-XXXXXX", name));
    if (folder.path().empty())
        throw Error(fmt::format("{}: cannot be written: {}; make room or set TMPDIR to another folder", place.string(),
                                std::generic_category().message(errno)));
    return folder;
}

}  // namespace si
