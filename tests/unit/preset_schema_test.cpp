// Tests of the JSON schema of presets.
#include "app/session/preset_schema.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/session/presets.h"
#include "renderer/settings/param.h"
#include "tests/support/json_schema.h"
#include "tests/support/process.h"
#include "tests/support/source_tree.h"

namespace si {
namespace {

using Json = nlohmann::json;

TEST(PresetSchema, ThePageIsUpToDate) {
    EXPECT_EQ(file_bytes(test::source_tree() / "docs/preset.schema.json"), preset_schema())
        << "write it with `shadow-inspector docs preset-schema -o docs/preset.schema.json`";
}

TEST(PresetSchema, PresetsObeyIt) {
    const Json schema = Json::parse(preset_schema());
    for (const BuiltinPreset& row : builtin_presets())
        EXPECT_TRUE(test::obeys(schema, Json::parse(preset_text(load_preset(row.key))))) << row.key;
    // Each setting alone, at a value that differs from its default.
    for (const Param& p : params()) {
        const SettingRef ref{&p, p.scope == Scope::Light ? 3 : 0, p.scope == Scope::Object ? "Root/Box" : ""};
        Preset preset;
        const Value v = default_value(ref);
        set_value(preset.settings, ref,
                  std::holds_alternative<bool>(v)          ? Value(!std::get<bool>(v))
                  : std::holds_alternative<std::string>(v) ? Value(std::string("key"))
                  : p.choices                              ? Value(std::get<int>(v) == 0 ? 1 : 0)
                  : std::holds_alternative<int>(v)         ? Value(int(p.max))
                                                           : Value(p.max));
        Json json = Json::parse(preset_text(preset));
        EXPECT_TRUE(test::obeys(schema, json)) << setting_key(ref);
        json["settings"][setting_key(ref) + "x"] = 1;
        EXPECT_FALSE(test::obeys(schema, json)) << setting_key(ref);
    }
    Json wrong = Json::parse(preset_text({}));
    wrong["settings"]["map.resolution"] = 0;
    EXPECT_FALSE(test::obeys(schema, wrong));
    wrong["settings"]["map.resolution"] = 512;
    wrong["settings"]["map.format"] = "d8";
    EXPECT_FALSE(test::obeys(schema, wrong));
}

}  // namespace
}  // namespace si
