// Tests of `scene`, of contact sheets for a folder of models, and of scenes that presets name.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/session/session.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

using test::GltfFile;
using test::Json;

/// Makes a triangle with a point primitive, a light, a camera and an animation.
std::string rich_model() {
    GltfFile file;
    const int positions = file.triangle_positions();
    const Json primitive = {{"attributes", {{"POSITION", positions}}}, {"material", 0}};
    const Json points = {{"attributes", {{"POSITION", positions}}}, {"mode", 0}};
    file.json["materials"] = {{{"name", "leaf"}, {"alphaMode", "MASK"}, {"doubleSided", true}}};
    file.append("meshes", {{"primitives", {primitive, points}}});
    const int node = file.root({{"mesh", 0}, {"name", "Tree"}});
    file.json["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"name", "lamp"}, {"spot", Json::object()}}}}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.root({{"translation", {0, 5, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    file.root({{"camera", 0}, {"translation", {0, 0, 9}}});
    file.json["animations"] = {
        {{"name", "sway"},
         {"samplers",
          {{{"input", file.floats({0, 2.5f}, "SCALAR")}, {"output", file.floats({0, 0, 0, 1, 0, 0}, "VEC3")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}}};
    return file.glb();
}

void write(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

TEST(SceneCommand, ListsContentsAndDroppedPartsOfAFile) {
    const auto folder = fresh_test_folder();
    write(folder / "model.glb", rich_model());
    const Json f = program_json("scene model.glb", folder);
    EXPECT_EQ(f["triangles"], 1);
    EXPECT_EQ(f["materials"][0]["alpha"], "mask");
    EXPECT_EQ(f["lights"][0]["type"], "spot");
    EXPECT_NEAR(f["lights"][0]["cone_deg"].get<double>(), 90, 1e-9);
    EXPECT_EQ(f["lights"][0]["position"], Json({0.0, 5.0, 0.0}));
    EXPECT_EQ(f["cameras"][0]["name"], "eye");
    EXPECT_EQ(f["animations"][0]["duration_s"], 2.5);
    EXPECT_EQ(f["extent"]["size"], Json({1.0, 1.0, 0.0}));
    ASSERT_EQ(f["warnings"].size(), 1u) << f["warnings"];
    EXPECT_NE(f["warnings"][0].get<std::string>().find("points are not drawn"), std::string::npos);

    EXPECT_EQ(test::lacking(run_program("scene model.glb", folder).out,
                            {"leaf: mask, double-sided", "lamp: spot", "eye: perspective", "sway: 2.5 s",
                             "points are not drawn"}),
              "");
}

/// Draws a scene of the folder and returns the report.
Json report_of(const Words& scene_and_more, const std::filesystem::path& folder) {
    const ProcessResult r = run_program("render -o a.png --size 32x32 --report a.json" + scene_and_more, folder);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(file_bytes(folder / "a.json"));
}

SI_TEST_IS(Later, SceneCommand, LightsOfAFileAreSettingsThatSetReplaces);
TEST(SceneCommand, LightsOfAFileAreSettingsThatSetReplaces) {
    const auto folder = fresh_test_folder();
    write(folder / "model.glb", rich_model());
    const Json own = report_of("model.glb", folder);
    EXPECT_EQ(own["settings"]["light.type"], "spot");
    EXPECT_NEAR(own["fit"][0]["position"][1].get<double>(), 5, 1e-9);
    // The triangle has moved, so the scene's centre, the origin of targets, has moved too; the light stays.
    const Json later = report_of("model.glb --set scene.time=2", folder);
    EXPECT_NEAR(later["fit"][0]["position"][0].get<double>(), 0, 1e-9);
    EXPECT_NEAR(later["fit"][0]["position"][1].get<double>(), 5, 1e-9);
    EXPECT_EQ(report_of("model.glb --set light.0.type=point", folder)["settings"]["light.type"], "point");
}

/// Makes two scenes: "near" of one triangle with two cameras, "far" of the triangle twice.
std::string two_scenes() {
    GltfFile file;
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.triangle_positions()}}}});
    file.root({{"mesh", mesh}});
    const Json lens = {{"yfov", 0.5}, {"znear", 0.1}};
    file.json["cameras"] = {{{"type", "perspective"}, {"name", "front"}, {"perspective", lens}},
                            {{"type", "perspective"}, {"name", "back"}, {"perspective", lens}}};
    file.root({{"camera", 0}, {"translation", {0, 0, 9}}});
    file.root({{"camera", 1}, {"translation", {0, 0, -9}}, {"rotation", {0, 1, 0, 0}}});
    file.json["scenes"][0]["name"] = "near";
    const int a = file.append("nodes", {{"mesh", mesh}});
    const int b = file.append("nodes", {{"mesh", mesh}, {"translation", {3, 0, 0}}});
    file.json["scenes"].push_back({{"name", "far"}, {"nodes", {a, b}}});
    return file.glb();
}

TEST(SceneCommand, ListsTheScenesAndCamerasOfAFileByNumber) {
    const auto folder = fresh_test_folder();
    write(folder / "two.glb", two_scenes());
    EXPECT_EQ(
        test::lacking(run_program("scene two.glb", folder).out,
                      {"  0 near\n", "  1 far\n", "this is 0", "  0 front: perspective", "  1 back: perspective"}),
        "");
    const Json far = program_json("scene two.glb --index 1", folder);
    EXPECT_EQ(far["file_scenes"], Json({"near", "far"}));
    EXPECT_EQ(far["file_scene"], 1);
    EXPECT_EQ(far["triangles"], 2);
    EXPECT_TRUE(far["cameras"].empty());
    EXPECT_TRUE(far["warnings"].empty()) << "what was chosen is no surprise";
    EXPECT_EQ(run_program("scene two.glb --index 2", folder).code, 1);
}

SI_TEST_IS(Later, SceneCommand, SettingsSelectSceneAndCamera);
TEST(SceneCommand, SettingsSelectSceneAndCamera) {
    const auto folder = fresh_test_folder();
    write(folder / "two.glb", two_scenes());
    EXPECT_EQ(report_of("two.glb", folder)["camera"]["eye"], Json({0.0, 0.0, 9.0}));
    EXPECT_EQ(report_of("two.glb --set camera.index=1", folder)["camera"]["eye"], Json({0.0, 0.0, -9.0}));
    const Json framed = report_of("two.glb --set camera.index=-1", folder)["camera"]["eye"];
    EXPECT_NE(framed[0], 0.0);
    EXPECT_LT(framed[2], 6.0) << "as near as the triangle fills the picture";
    EXPECT_EQ(report_of("two.glb --set scene.index=1", folder)["scene"]["triangles"], 2);
    const Words render = "render -o b.png --size 32x32 --set";
    expect_error(render + "camera.index=2 two.glb", 2, "has 2 cameras; choose 0 to 1, or -1", folder);
    write(folder / "one.glb", rich_model());
    expect_error(render + "scene.animation=3 one.glb", 2, "has 1 animation; choose 0, or -1 for the rest pose", folder);
    expect_error(render + "camera.index=3 one.glb", 2, "has 1 camera; choose 0, or -1 to show everything", folder);
    expect_error(render + "scene.index=3 one.glb", 1, "scene 3 does not exist, the file has 1; leave scene.index out",
                 folder);
    expect_error(render + "scene.index=2 two.glb", 1, "scene 2 does not exist, the file has 2", folder);
    expect_error(render + "scene.index=0 boxes", 0, "no effect", folder);
}

SI_TEST_IS(Later, SceneCommand, ExportHoldsTheTimeAndTheSettings);
TEST(SceneCommand, ExportHoldsTheTimeAndTheSettings) {
    const auto folder = fresh_test_folder();
    write(folder / "model.glb", rich_model());
    const auto exported = [&](const Words& more) {
        const ProcessResult r = run_program("export model.glb -o out.gltf" + more, folder);
        EXPECT_EQ(r.code, 0) << r.err;
        return report_of("out.gltf", folder);
    };
    const auto suggested = [&] {
        const Json scene = Json::parse(file_bytes(folder / "out.gltf"))["scenes"][0];
        return scene.value(Json::json_pointer("/extras/shadow_inspector/suggested"), Json::object());
    };
    const Json plain = exported({});
    EXPECT_TRUE(suggested().empty()) << "the light itself says all: " << suggested();
    EXPECT_EQ(plain["settings"]["light.type"], "spot");

    // The animation ends one metre along x; the triangle spans 0 to 1.
    const Json moved =
        exported("--set scene.time=2.5 --set bias.slope=2 --set light.red=0.5 --set object.Tree.receive=false");
    EXPECT_NEAR(moved["scene"]["bounds"]["min"][0].get<double>(), plain["scene"]["bounds"]["min"][0].get<double>() + 1,
                1e-6);
    EXPECT_EQ(moved["settings"]["bias.slope"], 2.0);
    EXPECT_EQ(moved["settings"]["light.red"], 0.5) << "not undone by the lamp of the file";
    EXPECT_EQ(moved["settings"]["light.type"], "spot");
    EXPECT_EQ(moved["settings"]["object.Tree.receive"], false);
    EXPECT_NEAR(moved["fit"][0]["position"][1].get<double>(), 5, 1e-9) << "the light stays where it is";
    EXPECT_FALSE(suggested().contains("scene.time")) << "the file holds that moment alone";
    EXPECT_TRUE(program_json("scene out.gltf", folder)["animations"].empty());

    const ProcessResult saved = run_program(
        "preset save model.glb -o p.json --set scene.time=1.25 --set bias.slope=3 --set light.intensity=0.25", folder);
    ASSERT_EQ(saved.code, 0) << saved.err;
    const Json half = exported("--preset p.json --set map.resolution=512");
    EXPECT_NEAR(half["scene"]["bounds"]["min"][0].get<double>(), plain["scene"]["bounds"]["min"][0].get<double>() + 0.5,
                1e-6);
    EXPECT_EQ(half["settings"]["bias.slope"], 3.0);
    EXPECT_EQ(half["settings"]["light.intensity"], 0.25);
    EXPECT_EQ(half["settings"]["map.resolution"], 512);

    // Settings of the preset that equal the program's defaults are not replaced by suggestions for the model.
    const ProcessResult sun = run_program("preset save boxes -o sun.json --set bias.slope=1", folder);
    ASSERT_EQ(sun.code, 0) << sun.err;
    const Json lit_by_sun = exported("--preset sun.json");
    EXPECT_EQ(lit_by_sun["settings"].value("light.type", "directional"), "directional") << "not by the file's lamp";
    for (const char* key :
         {"light.count", "light.type", "light.fit", "light.azimuth", "light.elevation", "caster.blend"})
        EXPECT_TRUE(suggested().contains(key)) << key;
    EXPECT_FALSE(suggested().contains("light.1.type")) << "there is one light";
}

TEST(PresetScene, IsSoughtInThePresetsFolderFirst) {
    namespace fs = std::filesystem;
    const auto folder = fresh_test_folder();
    write(folder / "a/scene.glb", rich_model());
    ASSERT_EQ(run_program("preset save scene.glb -o p.json", folder / "a").code, 0);
    EXPECT_EQ(Json::parse(file_bytes(folder / "a/p.json"))["scene"], "scene.glb");
    // A name that exists in the working directory, too.
    const fs::path name = fs::directory_iterator(fs::current_path())->path().filename();
    write(folder / "a" / name, rich_model());
    Preset preset;
    preset.scene = name.string();
    EXPECT_EQ(scene_of_preset(preset, (folder / "a/p.json").string()), (folder / "a" / name).string());
    EXPECT_EQ(scene_of_preset(preset, (folder / "none/p.json").string()), name.string());
}

TEST(PresetScene, BuiltInKeyIsNoFolderBesideThePreset) {
    const auto folder = fresh_test_folder();
    std::filesystem::create_directories(folder / "out/stage");
    ASSERT_EQ(run_program("preset save stage -o out/t.json", folder).code, 0);
    const ProcessResult checked = run_program("preset check out/t.json", folder);
    EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST(ContactSheet, ShowsModelsAndNamesFailures) {
    const auto folder = fresh_test_folder();
    write(folder / "models/deep/good.glb", rich_model());
    write(folder / "models/bad.gltf", "{}");
    const ProcessResult r = run_program("contact-sheet models -o sheet.png --columns 2 --size 64x48", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(file_bytes(folder / "sheet.png").substr(1, 3), "PNG");
    EXPECT_EQ(test::lacking(file_bytes(folder / "sheet.txt"),
                            {"1\tNOT SHOWN\tbad.gltf\t", "asset", "2\tshown\tdeep/good.glb\t1 triangles"}),
              "");
}

/// Returns a triangle textured by a PNG of one pixel whose data is a deflate block of the reserved type 3. stb_image
/// gives no reason for it.
std::string model_with_reserved_block() {
    GltfFile file;
    const std::string png(
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x8\6\0\0\0\0\0\0\0\0\0\0\3IDAT\x78\1\7\0\0\0\0"
        "\0\0\0\0IEND\0\0\0\0",
        60);
    const Json attributes = {{"POSITION", file.triangle_positions()},
                             {"TEXCOORD_0", file.floats({0, 0, 1, 0, 0, 1}, "VEC2")}};
    file.root({{"mesh", file.mesh({{"attributes", attributes}, {"material", 0}})}});
    file.append("images", {{"bufferView", file.view(std::vector<char>(png.begin(), png.end()))}});
    file.append("textures", {{"source", 0}});
    file.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return file.glb();
}

TEST(ContactSheet, DrawsTheRestOfAFolderWithADamagedImage) {
    const auto folder = fresh_test_folder();
    write(folder / "models/good.glb", rich_model());
    write(folder / "models/killer.glb", model_with_reserved_block());
    const ProcessResult r = run_program("contact-sheet models -o sheet.png --columns 2 --size 64x48", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(test::lacking(file_bytes(folder / "sheet.txt"),
                            {"1\tshown\tgood.glb\t1 triangles", "2\tshown\tkiller.glb\t1 triangles",
                             "images[0]: the PNG's compressed data is damaged; drawn untextured"}),
              "");
}

/// Returns the RGB pixels below the tile of a model of that name. The model is unreadable, which is faster and keeps
/// the label.
std::vector<std::uint8_t> label_below(const std::string& name, int tile_width = 160) {
    constexpr int kTileHeight = 48;
    const auto folder = fresh_test_folder();
    write(folder / "models" / (name + ".gltf"), "{}");
    const ProcessResult r =
        run_program(fmt::format("contact-sheet models -o sheet.png --size {}x{}", tile_width, kTileHeight), folder);
    EXPECT_EQ(r.code, 0) << r.err;
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> sheet(
        stbi_load((folder / "sheet.png").c_str(), &width, &height, &channels, 3), stbi_image_free);
    if (!sheet || height <= kTileHeight) {
        ADD_FAILURE() << "no label of " << name;
        return {};
    }
    return {sheet.get() + kTileHeight * width * 3, sheet.get() + height * width * 3};
}

std::string repeated(int times, const std::string& letter) {
    std::string out;
    for (int i = 0; i < times; ++i) out += letter;
    return out;
}

TEST(ContactSheet, WritesNamesInTheirOwnScript) {
    const auto name = label_below("Größe_Ω_Ж");
    for (const char* other : {"Grüße_Ω_Ж", "Größe_Σ_Ж", "Größe_Ω_Д", "Gr??e_?_?"})
        EXPECT_NE(label_below(other), name) << other;
    const auto lacking = label_below("漢");
    EXPECT_EQ(label_below("字"), lacking) << "letters that the font lacks are boxes";
    for (const char* other : {"?", "Ж", "\u00a0"}) EXPECT_NE(label_below(other), lacking) << other;
}

TEST(ContactSheet, WritesInvalidUtf8NamesAsEscapes) {
    EXPECT_EQ(label_below("a\xff\n\u200f"), label_below("a\\xff; \\u200f"));
}

TEST(ContactSheet, CutsLongNamesBetweenCharacters) {
    constexpr int kNarrow = 64;
    const auto cut = label_below(repeated(40, "Ж"), kNarrow);
    const auto is_cut = [&](int letters) { return label_below(repeated(letters, "Ж") + "…", kNarrow) == cut; };
    EXPECT_TRUE(is_cut(3) || is_cut(2)) << "the most that fit, whichever font the program was built with";
}

}  // namespace
}  // namespace si
