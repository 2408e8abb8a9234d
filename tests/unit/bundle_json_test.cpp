// Tests of frame.json: parsing, formatting, errors, and the JSON schema.
#include "renderer/bundle/bundle_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "renderer/bundle/bundle_path.h"
#include "renderer/bundle/bundle_schema.h"
#include "tests/support/error_text.h"
#include "tests/support/json_schema.h"
#include "tests/support/process.h"
#include "tests/support/source_tree.h"

namespace si {
namespace {

using Json = nlohmann::json;

const Json kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Returns the example of docs/bundle.md with matrices in place of its empty lists.
Json documented_example() {
    const std::string page = file_bytes(std::filesystem::path(SI_SOURCE_DIR) / "docs/bundle.md");
    const std::size_t start = page.find("```json\n") + 8;
    Json out = Json::parse(page.substr(start, page.find("```", start) - start));
    out["camera"]["clip_from_world"] = kIdentity;
    out["lights"][0]["maps"][0]["clip_from_world"] = kIdentity;
    return out;
}

Bundle parse(const Json& json) {
    return parse_bundle(json.dump(), "a.bundle/frame.json");
}

TEST(BundleJson, TheDocumentedExampleIsRead) {
    const Bundle b = parse(documented_example());
    EXPECT_EQ(b.made_by, "my engine 3.1");
    EXPECT_EQ(b.scene, "scene.glb");
    EXPECT_EQ(b.picture, "picture.png");
    ASSERT_TRUE(b.camera);
    EXPECT_EQ(b.camera->width, 1280);
    EXPECT_TRUE(b.camera->depth.zero_to_one);
    ASSERT_EQ(b.lights.size(), 1u);
    const BundleLight& light = b.lights[0];
    EXPECT_EQ(light.direction, glm::dvec3(-0.5, -1, -0.35));
    EXPECT_EQ(choice_of(light), ViewChoice::Map);
    ASSERT_EQ(light.maps.size(), 1u);
    const BundleMap& map = light.maps[0];
    EXPECT_EQ(first_row_of(map.image), FirstRow::Bottom);
    EXPECT_EQ(map.region, (BundleRegion{0, 0, 1024, 1024}));
    EXPECT_EQ(map.depth.format, BundleDepthFormat::D16);
    EXPECT_EQ(map.raster.offset_units, 4);
    EXPECT_EQ(map.raster.cull, Cull::Back);
    EXPECT_EQ(map.drawn, (std::vector<std::string>{"Tree", "House/Roof"}));
    EXPECT_EQ(light.lookup.bias.normal, 0.02);
    EXPECT_EQ(light.lookup.bias.units[2], BiasUnit::Metres);
    EXPECT_EQ(light.lookup.compare, BundleCompare::LessEqual);
    EXPECT_EQ(light.lookup.kernel, "pcf3");
}

/// Returns a bundle in which every member is set.
Bundle full_bundle() {
    Bundle b;
    b.made_by = "an \"engine\"\n";
    b.scene = "models/scene.gltf";
    b.world = {UpAxis::MinusZ, true, 0.01, {1.5, -2, 1e9}};
    b.camera = BundleCamera{{.view = glm::dmat4(2), .projection = glm::dmat4(1 / 3.0)}, 640, 480, {false, true}};
    b.picture = "p.png";
    b.notes = {"one", "two"};
    b.settings = {{"bias.constant", "0.5"}, {"filter.kernel", "pcf3"}};
    BundleMap map;
    map.image = {"a/b.raw", FirstRow::Top, 20, 10, RawFormat::U24, 2, 1};
    map.region = BundleRegion{1, 2, 3, 4};
    map.clip = {.world_from_view = glm::dmat4(0.1), .projection = glm::dmat4(1e-7)};
    map.depth = {{true, true}, BundleStored::DistanceShare, BundleDepthFormat::R16F, 25.0, 80.0,
                 0.25,         std::array{0.1, 20.0},       DepthWarp{1, 2, 3, -0.5}};
    map.raster = {1.5, 4.0, 0.01, Cull::Front, BundleFront::Cw, true};
    map.interval = std::array{0.1, 5.0};
    map.edge = std::array{0.4, 0.5};
    map.drawn = {{"Tree"}};
    BundleLight light;
    light.name = "lamp";
    light.type = LightType::Spot;
    light.direction = glm::dvec3(0.1, 0.2, 0.3);
    light.position = glm::dvec3(1, 2, 3);
    light.cone_deg = 60;
    light.choice = ViewChoice::Interval;
    light.closed = true;
    light.maps = {map, map};
    light.lookup = {{1.0, 0.5, 0.02, {BiasUnit::Texels, BiasUnit::Metres, BiasUnit::Depth}, OffsetBy::Sideways},
                    "pcf5",
                    BundleCompare::GreaterEqual,
                    BundleFilter::Linear,
                    BundleWrap::Repeat,
                    "s.glsl"};
    b.lights = {light};
    return b;
}

TEST(BundleJson, FormattedBundlesReadBack) {
    const Bundle full = full_bundle();
    const std::string text = format_bundle(full);
    const Bundle again = parse_bundle(text, "f");
    EXPECT_TRUE(again == full) << text;
    EXPECT_EQ(format_bundle(again), text);
    const Bundle small = parse(documented_example());
    EXPECT_TRUE(parse_bundle(format_bundle(small), "f") == small);
    Bundle infinite = full;
    infinite.world.origin.x = INFINITY;
    EXPECT_TRUE(test::fails_with([&] { format_bundle(infinite); }, {"finite"}));
}

TEST(BundleJson, WideSpotLightsHaveSixFaces) {
    Bundle wide = full_bundle();
    BundleLight& light = wide.lights[0];
    light.cone_deg = 360;
    light.choice = ViewChoice::Face;
    light.maps.assign(6, BundleMap(light.maps.front()));
    EXPECT_TRUE(parse_bundle(format_bundle(wide), "f") == wide);
    EXPECT_TRUE(test::obeys(Json::parse(bundle_schema()), Json::parse(format_bundle(wide))));
    light.type = LightType::Directional;
    EXPECT_TRUE(test::fails_with([&] { parse_bundle(format_bundle(wide), "f"); }, {"choice: ", "spot or point light"}));
    light.type = LightType::Spot;
    light.cone_deg = 361;
    EXPECT_TRUE(test::fails_with([&] { parse_bundle(format_bundle(wide), "f"); }, {"cone_deg: 361 is out of range"}));
}

TEST(BundleJson, UnknownIsNotZero) {
    Json json = documented_example();
    json["lights"][0].erase("lookup");
    json["lights"][0]["maps"][0].erase("raster");
    const Bundle b = parse(json);
    EXPECT_FALSE(b.lights[0].lookup.bias.constant);
    EXPECT_FALSE(b.lights[0].maps[0].raster.offset_factor);
    EXPECT_EQ(format_bundle(b).find("bias"), std::string::npos);
}

// Each case changes one value of the example and names a part of the message.
TEST(BundleJson, ErrorsNamePlaceAndFix) {
    struct Case {
        const char* place;
        Json value;
        std::vector<std::string_view> parts;
    };
    Json twisted = kIdentity;
    twisted.erase(3);
    const Case cases[] = {
        {"/bundle", 2, {"a.bundle/frame.json: bundle:", "version 2", "write version 1"}},
        {"/word", 1, {"frame.json: the member \"word\" is unknown", "did you mean world?"}},
        {"/lights/0/maps/0/depth/reverse", true, {"lights[0].maps[0].depth:", "did you mean reversed?"}},
        {"/lights/0/maps/0/depth/stored", "linaer", {"depth.stored:", "did you mean linear?"}},
        {"/lights/0/maps/0/depth/range", "0-1", {"depth.range:", "is none of 0..1, -1..1"}},
        {"/lights/0/maps/0/clip_from_world", twisted, {"maps[0].clip_from_world:", "16 numbers"}},
        {"/lights/0/maps/0/view", kIdentity, {"maps[0]: the matrix is given twice"}},
        {"/lights/0/maps/0/projection", kIdentity, {"projection is given beside"}},
        {"/lights/0/maps/0/region", {0, 0, 0, 4}, {"region[2]: 0 is out of range"}},
        {"/lights/0/maps/0/region", {0, 0, 0.5, 4}, {"region[2]: 0.5 is out of range"}},
        {"/lights/0/maps/0/image/file", "../a.pfm", {"image.file:", "has ..", "relative path"}},
        {"/lights/0/maps/0/image/file", "a.jpg", {"image.file:", "no image of a map"}},
        {"/lights/0/maps/0/image/file", "a.raw", {"image: the size of the raw image", "width and height"}},
        {"/lights/0/maps/0/image", "a.pfm", {"maps[0].image:", "no object"}},
        {"/lights/0/maps/0/interval", {5, 1}, {"interval: 5 does not lie below 1"}},
        {"/lights/0/maps/0/depth/stored", "exponential", {"depth.exponent:", "missing"}},
        {"/lights/0/maps/0/depth/stored", "distance-share", {"depth.range_m:", "missing"}},
        {"/lights/0/maps", Json::array(), {"lights: no light has a map"}},
        {"/lights", Json::array(), {"lights: the list has 0 members"}},
        {"/lights/0/type", "sun", {"lights[0].type:", "none of directional, spot, point"}},
        {"/lights/0/direction", {0, 0, 0}, {"lights[0].direction: it is no direction"}},
        {"/lights/0/choice", "face", {"lights[0].choice:", "six maps"}},
        {"/lights/0/lookup/bias/units", "depth, texels", {"bias.units:", "three units"}},
        {"/lights/0/lookup/bias/units", "depth, texel, metres", {"bias.units:", "did you mean texels?"}},
        {"/lights/0/lookup/bias/normal_by", "sines", {"bias.normal_by:", "did you mean sine?"}},
        {"/world/metres_per_unit", 0, {"world.metres_per_unit: 0 is out of range", "above 0"}},
        {"/world/metres_per_unit", "1", {"metres_per_unit: \"1\" is no number"}},
        {"/camera", 5, {"camera: 5 is no object"}},
        {"/camera/width", -3, {"camera.width: -3"}},
        {"/scene", "scene.obj", {"scene: \"scene.obj\" is no glTF file"}},
        {"/settings", {{"bias.constant", nullptr}}, {"settings.bias.constant: null is no value"}},
        {"/notes", {1}, {"notes[0]: 1 is no text"}},
    };
    for (const Case& c : cases) {
        Json json = documented_example();
        json[Json::json_pointer(c.place)] = c.value;
        const std::string text = test::error_text([&] { parse(json); });
        for (const std::string_view part : c.parts)
            EXPECT_NE(text.find(part), std::string::npos) << c.place << " " << c.value << ": " << text;
        EXPECT_NE(text.find("; "), std::string::npos) << text;
    }
}

TEST(BundleJson, RequiredMembersAreNamed) {
    const Json example = documented_example();
    for (const char* place : {"/bundle", "/lights", "/lights/0/type", "/lights/0/maps", "/lights/0/maps/0/image",
                              "/lights/0/maps/0/image/file", "/lights/0/maps/0/depth", "/lights/0/maps/0/depth/range",
                              "/lights/0/maps/0/clip_from_world", "/camera/clip_from_world", "/camera/width"}) {
        const Json::json_pointer pointer(place);
        Json json = example;
        json[pointer.parent_pointer()].erase(pointer.back());
        EXPECT_TRUE(test::fails_with([&] { parse(json); }, {"missing"})) << place;
    }
    Json json = example;
    json["lights"][0]["choice"] = "interval";
    json.erase("camera");
    EXPECT_TRUE(test::fails_with([&] { parse(json); }, {"camera: maps are chosen by camera depth"}));
}

TEST(BundleJson, OtherTextsAreRefused) {
    const auto refused = [](std::string text, std::initializer_list<std::string_view> parts) {
        return test::fails_with([&] { parse_bundle(text, "f"); }, parts);
    };
    EXPECT_TRUE(refused("", {"f: ", "repair the JSON"}));
    EXPECT_TRUE(refused("[]", {"f: ", "no object"}));
    EXPECT_TRUE(refused("{\"bundle\": 1, \"bundle\": 1}", {"f: the member \"bundle\" stands twice"}));
    EXPECT_TRUE(refused(std::string(100, '[') + std::string(100, ']'), {"100 levels"}));
    EXPECT_TRUE(refused(std::string(kMaxFrameJsonBytes + 1, ' '), {"4194305 bytes"}));
    EXPECT_TRUE(refused("{\"bundle\": 1e999}", {"repair the JSON"}));
    std::string many = "{\"extras\": [0";
    for (int i = 0; i < 1'000'001; ++i) many += ",0";
    EXPECT_TRUE(refused(many + "]}", {"values"}));
    Json json = documented_example();
    json["extras"] = {{"anything", {1, 2, 3}}};
    json["lights"][0]["maps"][0]["image"]["extras"] = 5;
    EXPECT_NO_THROW(parse_bundle("\xef\xbb\xbf" + json.dump(), "f"));
}

TEST(BundleJson, NamesOfFilesStayInTheBundle) {
    for (const char* name : {"a.pfm", "maps/a.pfm", "..a", "a..b/c", "\xc3\xa9"})
        EXPECT_EQ(bundle_path_fault(name), "");
    for (const char* name : {"", "/a", "../a", "a/..", "a/../b", "./a", "a//b", "a/", "a\\b", "c:a", "a\nb", "\xff"})
        EXPECT_NE(bundle_path_fault(name), "") << name;
    EXPECT_NE(bundle_path_fault(std::string(1001, 'a')), "");
    EXPECT_NE(bundle_path_fault(std::string_view("a\0b", 3)), "");
}

/// Adds the names of all members that a JSON schema describes.
void add_properties(const Json& schema, std::set<std::string>& names) {
    if (schema.is_object() && schema.contains("properties"))
        for (const auto& [name, value] : schema["properties"].items()) names.insert(name);
    if (schema.is_structured())
        for (const Json& part : schema) add_properties(part, names);
}

TEST(BundleJson, SchemaAndPageHaveAllMembers) {
    const std::filesystem::path docs = std::filesystem::path(SI_SOURCE_DIR) / "docs";
    EXPECT_EQ(file_bytes(docs / "bundle.schema.json"), bundle_schema());
    const std::string page = file_bytes(docs / "bundle.md");
    std::set<std::string> names;
    add_properties(Json::parse(bundle_schema()), names);
    EXPECT_GT(names.size(), 50u);
    for (const std::string& name : names)
        EXPECT_TRUE(page.find(name + "`") != std::string::npos || page.find("\"" + name + "\"") != std::string::npos)
            << name << " is not explained in docs/bundle.md";
}

TEST(BundleJson, FormattedBundlesObeyTheSchema) {
    const Json schema = Json::parse(bundle_schema());
    EXPECT_TRUE(test::obeys(schema, Json::parse(format_bundle(full_bundle()))));
    EXPECT_TRUE(test::obeys(schema, documented_example()));
    Json other = documented_example();
    other["lights"][0]["maps"][0]["depth"]["reverse"] = true;
    EXPECT_FALSE(test::obeys(schema, other));
}

}  // namespace
}  // namespace si
