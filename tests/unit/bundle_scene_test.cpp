// Tests of the importer of bundles: the scene in metres, camera, lights and look-up as suggested settings, errors.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include "app/session/session.h"
#include "renderer/bundle/bundle_files.h"
#include "renderer/bundle/bundle_json.h"
#include "renderer/importers/importers.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/zip_bytes.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string floats(const std::vector<float>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/// Returns a glTF file of one triangle whose buffer is a file beside it.
std::string triangle(const std::string& buffer) {
    return Json{{"asset", {{"version", "2.0"}}},
                {"scenes", {{{"nodes", {0}}}}},
                {"nodes", {{{"name", "Tree"}, {"mesh", 0}}}},
                {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
                {"accessors",
                 {{{"bufferView", 0},
                   {"componentType", 5126},
                   {"count", 3},
                   {"type", "VEC3"},
                   {"min", {0, 0, 0}},
                   {"max", {200, 100, 100}}}}},
                {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
                {"buffers", {{{"uri", buffer}, {"byteLength", 36}}}}}
        .dump();
}

const std::string kCorners = floats({0, 0, 0, 200, 0, 0, 0, 100, 100});

/// Orthographic matrix of a light that shines along -z of the engine, over x and y from -500 to 500, z from 0 to 500.
Json light_matrix() {
    const glm::dmat4 m = glm::scale(glm::translate(glm::dmat4(1), {0, 0, 1}), {1 / 500.0, 1 / 500.0, -1 / 500.0});
    Json out = Json::array();
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) out.push_back(m[c][r]);
    return out;
}

/// Frame of an engine with z up, left-handed, in centimetres.
Json frame() {
    return {{"bundle", 1},
            {"made_by", "test engine"},
            {"scene", "models/tree.gltf"},
            {"world", {{"up", "z"}, {"hand", "left"}, {"metres_per_unit", 0.01}}},
            {"lights",
             {{{"name", "sun"},
               {"type", "directional"},
               {"maps",
                {{{"image", {{"file", "sun.pfm"}}},
                  {"clip_from_world", light_matrix()},
                  {"depth", {{"range", "0..1"}, {"format", "d16"}}},
                  {"raster", {{"offset_factor", 1.5}, {"cull", "front"}}}}}}}}}};
}

class BundleSceneTest : public testing::Test {
protected:
    fs::path folder = fresh_test_folder();
    Json json = frame();

    BundleContents contents() const {
        return {{"frame.json", json.dump()},
                {"models/tree.gltf", triangle("../data/tree.bin")},
                {"data/tree.bin", kCorners},
                {"sun.pfm", "Pf\n2 1\n-1.0\n" + floats({0.5f, 1})}};
    }
    Scene load(const char* name = "a.bundle") {
        write_bundle_files(contents(), folder / name);
        return load_scene((folder / name).string());
    }
    testing::AssertionResult refuses(std::initializer_list<std::string_view> parts) {
        return test::fails_with([&] { load(); }, parts);
    }
    static bool warns(const Scene& scene, std::string_view of) {
        return std::ranges::any_of(scene.warnings, [&](const std::string& w) { return w.find(of) != w.npos; });
    }
};

TEST_F(BundleSceneTest, FoldersAndZipsGiveTheSceneInMetres) {
    for (const char* name : {"a.bundle", "a.zip"}) {
        const Scene scene = load(name);
        ASSERT_EQ(scene.nodes.size(), 1u);
        EXPECT_EQ(scene.nodes[0].path, "Tree");
        // Engine (x, y, z) with z up, left-handed, is (x, z, y) in metres, y up, right-handed.
        EXPECT_LT(glm::distance(scene.bounds.lo, glm::dvec3(0, 0, 0)), 1e-12);
        EXPECT_LT(glm::distance(scene.bounds.hi, glm::dvec3(2, 1, 1)), 1e-12);
        EXPECT_NE(scene.about.find("test engine"), std::string::npos);
        EXPECT_FALSE(scene.looks_z_up);
        EXPECT_FALSE(warns(scene, "z-up"));
        std::size_t stamped = 0;
        for (const StampedFile& file : scene.files) stamped += file.stamp.has_value();
        EXPECT_EQ(stamped, name == std::string("a.zip") ? 1u : 4u) << "a change of any file is seen";
    }
}

TEST_F(BundleSceneTest, LightsAndLookUpBecomeSettings) {
    json["lights"][0]["lookup"] = {
        {"kernel", "pcf5"},
        {"compare", "less"},
        {"wrap", "clamp"},
        {"bias", {{"constant", 0.25}, {"normal", 0.05}, {"units", "texels, depth, metres"}}}};
    const Scene scene = load();
    const Settings s = base_settings(scene);
    EXPECT_EQ(s.map.bundle, (folder / "a.bundle").string());
    EXPECT_EQ(s.light_count, 1);
    EXPECT_EQ(s.lights[0].name, "sun");
    EXPECT_EQ(s.lights[0].type, LightType::Directional);
    EXPECT_NEAR(s.lights[0].elevation, 90, 1e-6) << "it shines down";
    EXPECT_EQ(s.map.format, MapFormat::D16);
    EXPECT_EQ(s.map.resolution, 2);
    EXPECT_FALSE(s.map.reversed_z);
    EXPECT_EQ(s.map.compare, Compare::Less);
    EXPECT_EQ(s.map.wrap, MapWrap::Clamp);
    EXPECT_EQ(s.filter.size, 5);
    EXPECT_EQ(s.bias.unit, BiasUnit::Texels);
    EXPECT_EQ(s.bias.constant, 0.25);
    EXPECT_EQ(s.bias.normal, 0.05);
    EXPECT_EQ(s.bias.normal_unit, OffsetUnit::Metres);
    EXPECT_EQ(s.bias.raster_slope, 1.5);
    EXPECT_EQ(s.caster.cull, Cull::Front);
    EXPECT_TRUE(warns(scene, "slope is unknown, and not 0"));
    EXPECT_FALSE(warns(scene, "kernel is unknown"));
}

TEST_F(BundleSceneTest, UnknownLookUpIsSaid) {
    const Scene scene = load();
    EXPECT_TRUE(warns(scene, "constant, slope, normal are unknown, and not 0"));
    EXPECT_TRUE(warns(scene, "kernel is unknown"));
}

TEST_F(BundleSceneTest, TheFilterOfTheSamplerBlendsTexelsOrTakesOne) {
    const struct {
        const char *kernel, *filter, *chosen;
        bool bilinear;
    } cases[] = {
        {"pcf3", "linear", "pcf", true},      {"pcf3", "nearest", "pcf", false},   {"vogel", "linear", "vogel", true},
        {"vogel", "nearest", "vogel", false}, {"hard", "linear", "hw2x2", true},   {"hard", "nearest", "hard", false},
        {"hw2x2", "linear", "hw2x2", true},   {"hw2x2", "nearest", "hard", false},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(std::string(c.kernel) + " " + c.filter);
        json["lights"][0]["lookup"] = {{"kernel", c.kernel}, {"filter", c.filter}};
        const Settings s = base_settings(load());
        EXPECT_EQ(filter_of(s).key, c.chosen);
        EXPECT_EQ(is_bilinear(filter_of(s), s), c.bilinear);
    }
    json["lights"][0]["lookup"] = {{"filter", "linear"}};
    EXPECT_TRUE(base_settings(load()).filter.bilinear) << "with an unknown kernel, too";
}

TEST_F(BundleSceneTest, TheCameraIsTheFirstOfTheScene) {
    const glm::dmat4 projection = glm::perspective(0.8, 2.0, 10.0, 10000.0);
    const glm::dmat4 view = glm::translate(glm::dmat4(1), {-100, -200, -300});
    for (const char* name : {"view", "projection"}) {
        const glm::dmat4& m = name == std::string("view") ? view : projection;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) json["camera"][name].push_back(m[c][r]);
    }
    json["camera"].update({{"width", 640}, {"height", 480}, {"depth", {{"range", "-1..1"}}}});
    const Scene scene = load();
    ASSERT_EQ(scene.cameras.size(), 1u);
    const SceneCamera& camera = scene.cameras[0];
    EXPECT_LT(glm::distance(glm::dvec3(camera.world[3]), glm::dvec3(1, 3, 2)), 1e-9);
    EXPECT_LT(glm::distance(-glm::dvec3(camera.world[2]), glm::dvec3(0, -1, 0)), 1e-9) << "it looks down";
    EXPECT_GT(glm::determinant(glm::dmat3(camera.world)), 0);
    EXPECT_NEAR(camera.fov_y_deg, glm::degrees(0.8), 1e-9);
    EXPECT_NEAR(camera.near, 0.1, 1e-6);
    EXPECT_TRUE(warns(scene, "times as wide as high")) << "the projection has 2:1, the picture 4:3";
}

TEST_F(BundleSceneTest, DrawnListsLeaveOtherNodesOut) {
    json["lights"][0]["maps"][0]["drawn"] = {"House"};
    const Scene scene = load();
    EXPECT_FALSE(base_settings(scene).objects.at("Tree").cast);
    EXPECT_TRUE(warns(scene, "drawn: 1 of 1 names are no node"));
}

TEST_F(BundleSceneTest, DoubleSidedCastersKeepBothFaces) {
    BundleContents files = contents();
    Json model = Json::parse(files["models/tree.gltf"]);
    model["meshes"][0]["primitives"][0]["material"] = 0;
    for (const bool double_sided : {false, true}) {
        model["materials"] = {{{"doubleSided", double_sided}}};
        files["models/tree.gltf"] = model.dump();
        write_bundle_files(files, folder / (double_sided ? "both.bundle" : "one.bundle"));
        const Scene scene = load_scene((folder / (double_sided ? "both.bundle" : "one.bundle")).string());
        const Settings settings = base_settings(scene);
        EXPECT_EQ(settings.caster.cull, Cull::Front);
        EXPECT_EQ(object_settings(scene, settings, scene.objects[0]).cull,
                  double_sided ? ObjectCull::None : ObjectCull::Inherit);
    }
}

TEST_F(BundleSceneTest, OnlySettingsOfTheCullingDecideOnDoubleSidedCasters) {
    Json model = Json::parse(triangle("../data/tree.bin"));
    model["meshes"][0]["primitives"][0]["material"] = 0;
    model["materials"] = {{{"doubleSided", true}}};
    for (const bool states_culling : {false, true}) {
        json["settings"] = {{"filter.taps", "16"}};
        if (states_culling) json["settings"]["caster.cull"] = "front";
        BundleContents files = contents();
        files["models/tree.gltf"] = model.dump();
        write_bundle_files(files, folder / "a.bundle");
        const Scene scene = load_scene((folder / "a.bundle").string());
        const Settings settings = base_settings(scene);
        EXPECT_EQ(settings.caster.cull, Cull::Front);
        EXPECT_EQ(object_settings(scene, settings, scene.objects[0]).cull,
                  states_culling ? ObjectCull::Inherit : ObjectCull::None);
    }
}

TEST_F(BundleSceneTest, WithoutASceneTheSurfaceOfTheMapIsShown) {
    json.erase("scene");
    BundleContents files = contents();
    files["sun.pfm"] = "Pf\n4 4\n-1.0\n" + floats(std::vector<float>(16, 0.25f));
    write_bundle_files(files, folder / "a.bundle");
    const Scene scene = load_scene((folder / "a.bundle").string());
    ASSERT_EQ(scene.objects.size(), 1u);
    // Height 375 of 500 cm, and the centres of the outer texels of 10 m.
    EXPECT_LT(glm::distance(scene.bounds.lo, glm::dvec3(-3.75, 3.75, -3.75)), 1e-6);
    EXPECT_LT(glm::distance(scene.bounds.hi, glm::dvec3(3.75, 3.75, 3.75)), 1e-6);
    EXPECT_EQ(scene.name, (folder / "a.bundle").string());
}

TEST_F(BundleSceneTest, FaultsAreErrorsWithPlace) {
    json["lights"][0]["lookup"]["kernel"] = "pcx3";
    EXPECT_TRUE(refuses({"frame.json: lights[0].lookup.kernel: filter.kernel: \"pcx3\" is none of"}));
    json = frame();
    json["settings"]["bias.constnat"] = "1";
    EXPECT_TRUE(refuses({"frame.json: settings.bias.constnat: ", "did you mean bias.constant?"}));
    json["settings"] = {{"map.bundle", "/etc"}};
    EXPECT_TRUE(refuses({"settings.map.bundle: a bundle names no file of a setting"}));
    json = frame();
    json["scene"] = "models/none.glb";
    EXPECT_TRUE(refuses({"a.bundle/models/none.glb: does not exist"}));
    json.erase("scene");
    EXPECT_TRUE(refuses({"frame.json: lights[0].maps[0]: the map shows no surface; "}));
    json = frame();
    json["lights"].push_back(json["lights"][0]);
    json["lights"][1]["maps"][0]["depth"]["reversed"] = true;
    for (const int i : {10, 14}) {
        json["lights"][1]["maps"][0]["clip_from_world"][i] =
            i == 10 ? 1 / 500.0 : 0.0;  // depth 1 at the near plane, z = 500
    }
    EXPECT_TRUE(refuses({"frame.json: some maps have reversed depth and others have not"}));
    json["lights"][1]["direction"] = {0, 0, 1};
    EXPECT_TRUE(refuses({"frame.json: lights[1].maps[0]: the map looks against the light's direction"}));
}

TEST_F(BundleSceneTest, ModelsReadNothingOutsideTheBundle) {
    for (const char* uri : {"../../secret.bin", "/etc/passwd", "..%2f..%2fsecret.bin", "../data/link.bin"}) {
        BundleContents files = contents();
        files["models/tree.gltf"] = triangle(uri);
        const fs::path path = folder / "b.bundle";
        fs::remove_all(path);
        write_bundle_files(files, path);
        std::string secret = kCorners;
        write_bundle_files({{"frame.json", "{}"}, {"x", secret}}, folder / "secret.bundle");
        fs::copy_file(folder / "secret.bundle/x", folder / "secret.bin", fs::copy_options::overwrite_existing);
        fs::create_symlink(folder / "secret.bin", path / "data/link.bin");
        EXPECT_TRUE(test::fails_with([&] { load_scene(path.string()); }, {"buffers[0].uri: ", "cannot be read: "}))
            << uri;
    }
}

TEST_F(BundleSceneTest, ModelsNameNoBundle) {
    Json model = Json::parse(triangle("tree.bin"));
    model["scenes"][0]["extras"]["shadow_inspector"]["suggested"] = {{"map.bundle", "/etc"}, {"bias.constant", "2"}};
    write_bundle_files({{"frame.json", "{}"}, {"m.gltf", model.dump()}, {"tree.bin", kCorners}}, folder / "m.bundle");
    const Scene scene = load_scene((folder / "m.bundle/m.gltf").string());
    EXPECT_EQ(base_settings(scene).map.bundle, "");
    EXPECT_EQ(base_settings(scene).bias.constant, 2);
    EXPECT_TRUE(warns(scene, "map.bundle"));
}

TEST_F(BundleSceneTest, PresetsNameBundlesRelativeToThemselves) {
    load();
    fs::create_directories(folder / "presets");
    Preset preset;
    preset.settings.map.bundle = (folder / "a.bundle").string();
    const fs::path file = folder / "presets/p.json";
    save_preset(preset, file);
    EXPECT_NE(file_bytes(file).find("\"map.bundle\": \"../a.bundle\""), std::string::npos) << file_bytes(file);
    const Preset read = load_preset(file.string());
    EXPECT_TRUE(fs::equivalent(read.settings.map.bundle, folder / "a.bundle")) << read.settings.map.bundle;
    Preset none;
    save_preset(none, file);
    EXPECT_EQ(load_preset(file.string()).settings.map.bundle, "");
}

TEST_F(BundleSceneTest, ImportersKnowBundles) {
    for (const char* name : {"a.bundle", "a.bundle/", "a.BUNDLE", "x/frame.json", "a.zip"}) {
        const Importer* const row = find_importer(name);
        ASSERT_TRUE(row) << name;
        EXPECT_EQ(row->label, "bundle") << name;
    }
    EXPECT_FALSE(find_importer("other.json"));
}

}  // namespace
}  // namespace si
