// What `scene` says of a file, and sheets of a folder of models.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

using test::GltfFile;
using test::Json;

/// A triangle with a point primitive beside it, a light, a camera and an animation.
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

TEST(SceneCommand, SaysWhatIsInAFileAndWhatWasDropped) {
    const auto folder = fresh_test_folder();
    write(folder / "model.glb", rich_model());
    const ProcessResult json = run_program({"scene", "model.glb", "--json"}, folder);
    ASSERT_EQ(json.code, 0) << json.err;
    const Json f = Json::parse(json.out);
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

    const ProcessResult text = run_program({"scene", "model.glb"}, folder);
    for (const char* part :
         {"leaf: mask, double-sided", "lamp: spot", "eye: perspective", "sway: 2.5 s", "points are not drawn"})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << " is not in\n" << text.out;
    EXPECT_EQ(run_program({"scene", "nothing.glb"}, folder).code, 1);
}

TEST(SceneCommand, TheLightsOfAFileAreSettingsThatASetReplaces) {
    const auto folder = fresh_test_folder();
    write(folder / "model.glb", rich_model());
    const auto report = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render", "model.glb", "-o",       "a.png",
                                              "--size", "32x32",     "--report", "a.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProcessResult r = run_program(arguments, folder);
        EXPECT_EQ(r.code, 0) << r.err;
        return Json::parse(file_bytes(folder / "a.json"));
    };
    const Json own = report({});
    EXPECT_EQ(own["settings"]["light.type"], "spot");
    EXPECT_NEAR(own["fit"][0]["position"][1].get<double>(), 5, 1e-9);
    // The triangle has moved, so the centre that targets count from has too; the light stays where it is.
    const Json later = report({"--set", "scene.time=2"});
    EXPECT_NEAR(later["fit"][0]["position"][0].get<double>(), 0, 1e-9);
    EXPECT_NEAR(later["fit"][0]["position"][1].get<double>(), 5, 1e-9);
    EXPECT_EQ(report({"--set", "light.0.type=point"})["settings"]["light.type"], "point");
}

TEST(ContactSheet, ShowsModelsAndNamesFailures) {
    const auto folder = fresh_test_folder();
    write(folder / "models/deep/good.glb", rich_model());
    write(folder / "models/bad.gltf", "{}");
    const ProcessResult r =
        run_program({"contact-sheet", "models", "-o", "sheet.png", "--columns", "2", "--size", "64x48"}, folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(file_bytes(folder / "sheet.png").substr(1, 3), "PNG");
    const std::string index = file_bytes(folder / "sheet.txt");
    EXPECT_NE(index.find("1\tNOT SHOWN\tbad.gltf\t"), std::string::npos) << index;
    EXPECT_NE(index.find("asset"), std::string::npos) << index;
    EXPECT_NE(index.find("2\tshown\tdeep/good.glb\t1 triangles"), std::string::npos) << index;
    EXPECT_EQ(run_program({"contact-sheet", "nowhere", "-o", "s.png"}, folder).code, 1);
    EXPECT_EQ(run_program({"contact-sheet", "models", "-o", "s.jpg"}, folder).code, 2);
}

}  // namespace
}  // namespace si
