#include "tests/support/version_1.h"

#include <algorithm>
#include <string>

#include "app/base/output.h"
#include "renderer/settings/param.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kFolder = fs::path(SI_SOURCE_DIR) / "tests/data/version_1";

std::string text_of(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Json version_1_defaults() {
    return Json::parse(read_text_file(kFolder / "defaults.json"));
}

std::vector<fs::path> version_1_presets() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(kFolder / "presets")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

Settings version_1_settings(const fs::path& preset) {
    const Json values = Json::parse(read_text_file(preset)).at("settings");
    const int lights = values.value("light.count", 1);
    Settings s;
    const Json defaults = version_1_defaults();
    for (const auto& [key, value] : defaults.items()) {
        if (key.starts_with("object.")) continue;
        set_setting(s, key, text_of(value));
        if (!key.starts_with("light.") || key == "light.count") continue;
        for (int i = 1; i < lights; ++i)
            set_setting(s, "light." + std::to_string(i) + key.substr(key.find('.')), text_of(value));
    }
    set_setting(s, "scene.ground", "off");  // there was none
    for (const auto& [key, value] : values.items()) set_setting(s, key, text_of(value));
    return s;
}

}  // namespace si::test
