#include "tests/support/shared_models.h"

#include <fstream>
#include <string>

namespace si::test {

std::vector<SharedModel> shared_models() {
    std::vector<SharedModel> out;
    const std::filesystem::path folder = std::filesystem::path(SI_SOURCE_DIR) / "../shared/models";
    std::ifstream list(folder / "EXPECT.tsv");
    std::string line;
    while (std::getline(list, line)) {
        const std::size_t name = line.find('\t');
        if (name == line.npos || !line.substr(name).starts_with("\tload\t")) continue;
        const std::filesystem::path file = folder / line.substr(0, name);
        if (std::filesystem::exists(file)) out.push_back({file, line.substr(name).starts_with("\tload\trefuse")});
    }
    return out;
}

}  // namespace si::test
