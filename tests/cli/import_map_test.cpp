// Tests of `import-map`: maps of this program are read back with their conventions left out, and faults.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "renderer/bundle/bundle_json.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

class ImportMap : public testing::Test {
protected:
    /// Draws the map of the scene `boxes` into a file, and writes its matrix. @param set settings as --set words
    void draw(const std::string& image, const Words& set, bool rows = false) {
        const ProcessResult r = run_program(
            Words{"render", "boxes", "-o", image} +
                Words("--size 64x64 --view shadow-map --report r.json --set view.map=raw --set map.resolution=256") +
                set,
            folder_);
        ASSERT_EQ(r.code, 0) << r.err;
        fit_ = Json::parse(file_bytes(folder_ / "r.json"))["fit"][0];
        const Json& m = fit_["matrices"]["clip_from_world"];
        Json numbers;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) numbers.push_back(rows ? m[i][j] : m[j][i]);
        write("light.json", {{"clip_from_world", numbers}});
    }
    void write(const std::string& name, const Json& json) const { std::ofstream(folder_ / name) << json.dump(); }
    Json light() const { return Json::parse(file_bytes(folder_ / "light.json")); }

    const std::filesystem::path folder_ = fresh_test_folder();
    Json fit_;
};

SI_TEST_IS(Later, ImportMap, OwnMapsAreReadByTheirMatrixAlone);
TEST_F(ImportMap, OwnMapsAreReadByTheirMatrixAlone) {
    const struct {
        const char* image;
        const char* set;
        bool rows, spot, reversed;
    } cases[] = {
        {"map.pfm", "", false, false, false},
        {"map.exr", "", true, false, false},
        {"map.exr", "--set map.reversed_z=true --set light.type=spot", false, true, true},
        {"map.pfm", "--set map.format=d16 --set light.type=spot", true, true, false},
    };
    for (const auto& c : cases) {
        draw(c.image, Words(c.set), c.rows);
        const Json json = program_json(
            Words{"import-map", c.image, "--light", "light.json"} + "--scene boxes -o out.bundle --json", folder_);
        ASSERT_EQ(json["chosen"], 1) << c.set << json.dump(1);
        const Json& fit = json["readings"][0];
        EXPECT_EQ(fit["reversed"], c.reversed) << c.set;
        EXPECT_EQ(fit["matrix"], c.rows ? "rows" : "columns");
        EXPECT_EQ(fit["stored"], "depth");
        EXPECT_EQ(fit["first_row"], std::string(c.image).ends_with(".exr") ? "top" : "bottom");
        EXPECT_EQ(fit["depth_range"], fit_["depth_zero_to_one"] ? "0..1" : "-1..1");
        EXPECT_LT(fit["share_off"], 0.02);
        const std::string frame = file_bytes(folder_ / "out.bundle/frame.json");
        const Bundle bundle = parse_bundle(frame, "frame.json");
        ASSERT_EQ(bundle.lights.size(), 1u);
        EXPECT_EQ(bundle.lights[0].type, c.spot ? LightType::Spot : LightType::Directional);
        EXPECT_EQ(bundle.scene, "scene.glb");
        const BundleMap& map = bundle.lights[0].maps.at(0);
        const glm::dmat4 m = map.clip.matrix();
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) EXPECT_EQ(m[j][i], double(fit_["matrices"]["clip_from_world"][i][j]));
        EXPECT_EQ(file_bytes(folder_ / "out.bundle" / map.image.file), file_bytes(folder_ / c.image));
        EXPECT_TRUE(file_bytes(folder_ / "out.bundle/scene.glb").starts_with("glTF"));
    }
}

// The matrix takes positions of a file in other axes and units: those of the scene, by columns of the change.
TEST_F(ImportMap, AxesHandAndUnitOfTheLightAreFound) {
    const glm::dmat3 z_up({1, 0, 0}, {0, 0, -1}, {0, 1, 0});  // (x, y, z) of the file is (x, z, -y) of the scene
    const glm::dmat3 mirrored_z({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    const struct {
        glm::dmat3 scene_from_file;
        const char *up, *mirrored;
        double unit;
        const char* options;
    } cases[] = {
        {z_up, "z", "none", 1, "--up z --mirrored none --unit 1"},
        {mirrored_z, "y", "z", 1, "--up y --mirrored z --unit 1"},
        {glm::dmat3(0.01), "y", "none", 0.01, "--up y --mirrored none --unit 0.01"},
        {0.0254 * z_up * mirrored_z, "z", "z", 0.0254, "--up z --mirrored z --unit 0.0254"},
    };
    draw("map.pfm", Words("--set light.type=spot"));
    const Json own = light();
    glm::dmat4 clip_from_scene;
    for (int i = 0; i < 16; ++i) clip_from_scene[i / 4][i % 4] = own["clip_from_world"][std::size_t(i)];
    for (const auto& c : cases) {
        SCOPED_TRACE(c.options);
        const glm::dmat4 clip = clip_from_scene * glm::dmat4(c.scene_from_file);
        Json numbers;
        for (int i = 0; i < 16; ++i) numbers.push_back(clip[i / 4][i % 4]);
        write("light.json", {{"clip_from_world", numbers}});
        const Words command = "import-map map.pfm --light light.json --scene boxes -o out.bundle";
        const Json json = program_json(command + "--json", folder_);
        ASSERT_EQ(json["chosen"], 1) << json.dump(1);
        const Json& fit = json["readings"][0];
        EXPECT_EQ(fit["up"], c.up);
        EXPECT_EQ(fit["mirrored"], c.mirrored);
        EXPECT_EQ(fit["unit"], c.unit);
        EXPECT_LT(fit["share_off"], 0.02);
        EXPECT_NE(fit["options"].get<std::string>().find(c.options), std::string::npos) << fit["options"];
        const Bundle bundle = parse_bundle(file_bytes(folder_ / "out.bundle/frame.json"), "frame.json");
        const glm::dmat4 read = bundle.lights.at(0).maps.at(0).clip.matrix();
        for (int i = 0; i < 4; ++i)
            EXPECT_LT(glm::distance(read[i], clip_from_scene[i]), 1e-9 * glm::length(clip_from_scene[i]));
        // The options state them, and other ones are refused.
        const ProcessResult stated = run_program(command + Words(c.options), folder_);
        EXPECT_EQ(stated.code, 0) << stated.err;
        expect_error(command + "--up x --mirrored none --unit 1", 1, "no reading of the map fits", folder_);
    }
    expect_error("import-map map.pfm --light light.json --scene boxes -o out.bundle --up file", 2, "--up", folder_);
    expect_error("import-map map.pfm --light light.json --scene boxes -o out.bundle --unit 0", 2, "--unit", folder_);
}

TEST_F(ImportMap, AWrongStatementIsNamedWithTheReadingThatFits) {
    draw("map.pfm", {});
    Json wrong = light();
    wrong["depth"] = {{"range", "0..1"}, {"reversed", true}, {"stored", "linear"}};
    write("wrong.json", wrong);
    const Words command = "import-map map.pfm --light wrong.json --scene boxes -o out.bundle";
    const ProcessResult r = expect_error(command, 1, "another reading fits", folder_);
    EXPECT_NE(r.err.find("--reversed false"), std::string::npos) << r.err;
    EXPECT_NE(r.out.find("contradicts the light file"), std::string::npos) << r.out;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.bundle"));
    const ProcessResult chosen = run_program(
        command + "--depth-range 0..1 --reversed false --first-row bottom --matrix columns --stored depth", folder_);
    EXPECT_EQ(chosen.code, 0) << chosen.err;
    EXPECT_NE(chosen.out.find("wrote out.bundle"), std::string::npos) << chosen.out;
}

TEST_F(ImportMap, AloneItListsWhatFitsAndTakesAChoice) {
    draw("map.pfm", {});
    const Words command = "import-map map.pfm --light light.json -o out.zip";
    const ProcessResult r =
        expect_error(command, 1, "readings fit equally well; take one by --pick N, or state --depth-range", folder_);
    EXPECT_NE(r.out.find("fits\n"), std::string::npos) << r.out;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.zip"));
    for (const char* more : {"--depth-range 0..1 --reversed false --matrix columns", "--pick 1"}) {
        const ProcessResult taken = run_program(command + Words(more), folder_);
        EXPECT_EQ(taken.code, 0) << taken.err;
        EXPECT_NE(taken.err.find("without a scene the first row is taken as the bottom"), std::string::npos)
            << taken.err;
        EXPECT_TRUE(file_bytes(folder_ / "out.zip").starts_with("PK"));
        std::filesystem::remove(folder_ / "out.zip");
    }
    expect_error(command + "--pick 99", 2, "--pick 99: there are", folder_);
}

TEST_F(ImportMap, RawTexelsNeedTheirLayout) {
    draw("map.pfm", {});
    const std::string pfm = file_bytes(folder_ / "map.pfm");
    const std::string texels = pfm.substr(pfm.size() - 256 * 256 * 4);
    std::ofstream(folder_ / "map.raw", std::ios::binary) << texels;
    const Words command = "import-map map.raw --light light.json --scene boxes -o out.bundle";
    expect_error(command, 1, "the size of the raw image is missing", folder_);
    Json stated = light();
    stated["image"] = {{"width", 256}, {"height", 256}, {"format", "f32"}};
    write("light.json", stated);
    const ProcessResult r = run_program(command, folder_);
    EXPECT_EQ(r.code, 0) << r.err;
    stated["image"]["channel"] = 1;
    write("light.json", stated);
    expect_error(command, 1, "channel 1 is read", folder_);
}

TEST_F(ImportMap, RefusesAnOutputThatHoldsTheInput) {
    const ProcessResult made =
        run_program("export boxes --size 64x64 --set map.resolution=256 --bundle f.bundle", folder_);
    ASSERT_EQ(made.code, 0) << made.err;
    draw("map.pfm", {});
    std::filesystem::create_directory_symlink("f.bundle", folder_ / "link");
    const std::string before = file_bytes(folder_ / "f.bundle/frame.json");
    for (const char* image : {"f.bundle/maps/light0-0.pfm", "link/maps/light0-0.pfm"})
        for (const char* output : {"f.bundle", "f.bundle/"})
            expect_error(Words{"import-map", image, "--light", "light.json", "--scene", "boxes", "-o", output}, 2,
                         "light0-0.pfm of this bundle is read; write another one", folder_);
    expect_error("import-map map.pfm --light light.json --scene f.bundle/scene.glb -o f.bundle", 2,
                 "scene.glb of this bundle is read; write another one", folder_);
    EXPECT_EQ(file_bytes(folder_ / "f.bundle/frame.json"), before);
    for (const char* file : {"scene.glb", "picture.png", "maps/light0-0.pfm"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "f.bundle" / file)) << file;
}

TEST_F(ImportMap, BadInputEndsInOneSentenceAndWritesNothing) {
    draw("map.pfm", {});
    std::ofstream(folder_ / "text.exr") << "no image";
    std::ofstream(folder_ / "cut.pfm") << file_bytes(folder_ / "map.pfm").substr(0, 5000);
    std::ofstream(folder_ / "huge.pfm") << "Pf\n2000000000 2000000000\n-1.0\n";
    const std::string header = "Pf\n4 4\n-1.0\n";
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::string numbers(64, '\0');
    for (std::size_t i = 0; i < 16; ++i) std::memcpy(numbers.data() + 4 * i, &nan, 4);
    std::ofstream(folder_ / "nan.pfm", std::ios::binary) << header << numbers;
    const auto with = [](const std::string& image, const std::string& more = "") {
        return Words{"import-map", image, "--light", "light.json", "-o", "out.bundle"} + Words(more);
    };
    expect_error(with("none.pfm"), 1, "none.pfm: cannot be opened", folder_);
    expect_error(with("text.exr"), 1, "text.exr: the file is no OpenEXR image", folder_);
    expect_error(with("cut.pfm"), 1, "cut.pfm: ", folder_);
    expect_error(with("huge.pfm"), 1, "2000000000 × 2000000000 texels", folder_);
    expect_error(with("light.json"), 1, "light.json: is no image of a map", folder_);
    expect_error(with("nan.pfm", "--scene boxes"), 1, "no reading of the map fits", folder_);
    expect_error(with("map.pfm", "--scene none.glb"), 1, "none.glb", folder_);
    expect_error(with("map.pfm", "--depth-range 0..2"), 2, "--depth-range", folder_);
    expect_error("import-map map.pfm --light map.pfm -o out.bundle", 1, "map.pfm", folder_);
    expect_error("import-map map.pfm --light light.json -o out.glb", 2, "ends in .bundle", folder_);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.bundle"));
    // A matrix that is none.
    write("light.json", {{"clip_from_world", std::vector<double>(16, 0)}});
    expect_error(with("map.pfm", "--scene boxes"), 1, "no reading of the matrix", folder_);
    write("light.json", {{"clip_from_world", std::vector<double>(16, 1e300)}});
    expect_error(with("map.pfm", "--scene boxes"), 1, "light.json: ", folder_);
}

}  // namespace
}  // namespace si
