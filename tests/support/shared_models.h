// Lists real models in ../shared/models for tests, if that folder exists.
#pragma once

#include <filesystem>
#include <vector>

namespace si::test {

/// Model file outside the repository.
struct SharedModel {
    std::filesystem::path file;
    bool may_be_refused = false;  ///< permission to fail: the file needs an unsupported extension
};

/// Returns the existing models that ../shared/models/EXPECT.tsv marks as loadable, in that file's order. Empty if there
/// are none.
std::vector<SharedModel> shared_models();

}  // namespace si::test
