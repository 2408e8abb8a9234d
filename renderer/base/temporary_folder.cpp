#include "renderer/base/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace si {

TemporaryFolder::TemporaryFolder(const std::filesystem::path& pattern) {
    std::string name = pattern.string();
    if (::mkdtemp(name.data())) path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace si
