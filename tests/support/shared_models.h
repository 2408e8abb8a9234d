// Real models beside the project, where they are there.
#pragma once

#include <filesystem>
#include <vector>

namespace si::test {

struct SharedModel {
    std::filesystem::path file;
    bool may_be_refused = false;  ///< by name: it needs what the program does not read
};

/// Those of ../shared/models that are to be read, in the order of its list; empty where there are none.
std::vector<SharedModel> shared_models();

}  // namespace si::test
