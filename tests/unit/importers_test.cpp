// Tests of importers: models of other formats against their glTF twins, units and axes, notes, damaged and hostile
// files.
#include "renderer/importers/importers.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>

#include "renderer/base/error.h"
#include "renderer/importers/assimp_files.h"
#include "renderer/importers/assimp_job.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/source_tree.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Greatest difference of a place from its twin, metres: text formats keep six digits.
constexpr double kTolerance = 2e-5;

fs::path model(const std::string& name) {
    return fs::path(SI_SOURCE_DIR) / "tests/data/import" / name;
}

Scene load(const std::string& name, const FileChoices& choices = {}) {
    return load_scene(model(name).string(), {.file = choices});
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const std::string& what) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << what << ": " << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

void expect_same_bounds(const Scene& a, const Scene& b) {
    expect_near(a.bounds.lo, b.bounds.lo, kTolerance, a.name + " lo");
    expect_near(a.bounds.hi, b.bounds.hi, kTolerance, a.name + " hi");
}

/// Returns the paths of the nodes that carry objects.
std::set<std::string> object_paths(const Scene& scene) {
    std::set<std::string> out;
    for (const Object& object : scene.objects) out.insert(scene.nodes[std::size_t(object.node)].path);
    return out;
}

std::size_t masks(const Scene& scene) {
    return std::size_t(std::ranges::count_if(
        scene.materials, [](const Material& m) { return m.alpha == AlphaMode::Mask && m.base_colour_texture >= 0; }));
}

const SceneLight& light(const Scene& scene, LightType type) {
    const auto found = std::ranges::find(scene.lights, type, &SceneLight::type);
    if (found == scene.lights.end()) throw Error("no such light");
    return *found;
}

glm::dvec3 forward(const glm::dmat4& world) {
    return -glm::normalize(glm::dvec3(world[2]));
}

TEST(Importers, TheScriptForFoldersOfFramesKnowsAllExtensions) {
    const std::string script = file_bytes(fs::path(SI_SOURCE_DIR) / "scripts/check_frames.sh");
    for (const Importer& importer : importers())
        for (const std::string_view extension : importer.extensions)
            EXPECT_NE(script.find(" " + std::string(extension.substr(1)) + " | "), std::string::npos) << extension;
}

TEST(Importers, ModelsEqualTheirGltfTwins) {
    const Scene twin = load("scene.glb");
    for (const char* name : {"scene.fbx", "scene.dae", "scene.obj", "scene.x3d"}) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.triangle_count(), twin.triangle_count()) << name;
        EXPECT_EQ(scene.objects.size(), twin.objects.size()) << name;
        expect_same_bounds(scene, twin);
    }
    for (const char* name : {"scene.ply", "scene.stl"}) {
        const Scene scene = load(name, {.up = UpAxis::Z});
        EXPECT_EQ(scene.triangle_count(), twin.triangle_count()) << name;
        expect_same_bounds(scene, twin);
    }
    for (const char* name : {"scene.fbx", "scene.dae"}) EXPECT_EQ(object_paths(load(name)), object_paths(twin)) << name;
    EXPECT_EQ(object_paths(load("scene.obj")), (std::set<std::string>{"Base", "Lid", "Fence"}));
    for (const char* name : {"scene.fbx", "scene.dae", "scene.obj"}) EXPECT_EQ(masks(load(name)), masks(twin)) << name;
}

TEST(Importers, CamerasAndLightsEqualThoseOfTheTwin) {
    const Scene twin = load("scene.glb");
    for (const char* name : {"scene.fbx", "scene.dae"}) {
        const Scene scene = load(name);
        ASSERT_EQ(scene.cameras.size(), 1u) << name;
        const SceneCamera &a = scene.cameras[0], &b = twin.cameras[0];
        EXPECT_EQ(a.name, "Eye");
        EXPECT_NEAR(a.fov_y_deg, b.fov_y_deg, 1e-3) << name;
        EXPECT_NEAR(a.near, b.near, 1e-5) << name;
        EXPECT_NEAR(a.far, b.far, 1e-3) << name;
        expect_near(glm::dvec3(a.world[3]), glm::dvec3(b.world[3]), kTolerance, name);
        expect_near(forward(a.world), forward(b.world), 1e-4, name);
        expect_near(glm::normalize(glm::dvec3(a.world[1])), glm::normalize(glm::dvec3(b.world[1])), 1e-4, name);
        ASSERT_EQ(scene.lights.size(), 2u) << name;
        const SceneLight &spot = light(scene, LightType::Spot), &twin_spot = light(twin, LightType::Spot);
        EXPECT_NEAR(spot.outer_cone_rad, twin_spot.outer_cone_rad, 1e-4) << name;
        expect_near(glm::dvec3(spot.world[3]), glm::dvec3(twin_spot.world[3]), kTolerance, name);
        expect_near(forward(spot.world), forward(twin_spot.world), 1e-4, name);
        expect_near(forward(light(scene, LightType::Directional).world),
                    forward(light(twin, LightType::Directional).world), 1e-4, name);
    }
}

TEST(Importers, SkinsAreShownInTheirRestPose) {
    const Scene fbx = load("skinned.fbx"), collada = load("skinned.dae");
    for (const Scene* scene : {&fbx, &collada}) {
        EXPECT_EQ(scene->triangle_count(), 36u);
        // A bar 2 m high, bent by 60 degrees at its middle.
        EXPECT_NEAR(scene->bounds.hi.y, 1.5 + 0.1 * std::sqrt(0.75), 1e-4) << scene->name;
        EXPECT_NEAR(scene->bounds.hi.z, std::sqrt(0.75) + 0.05, 1e-4) << scene->name;
    }
    expect_same_bounds(fbx, collada);
}

TEST(Importers, UnitsAndAxesOfAFileAreApplied) {
    const Scene cm = load("plate_cm.fbx"), m = load("plate_zup_m.fbx");
    expect_near(cm.bounds.lo, {1, 0, 0}, kTolerance, "lo");
    expect_near(cm.bounds.hi, {3, 1, 3}, kTolerance, "hi");
    expect_near(m.bounds.lo, {1, 0, -1}, kTolerance, "lo");
    expect_near(m.bounds.hi, {3, 3, 0}, kTolerance, "hi");
    EXPECT_EQ(cm.file_unit_m, 0.01);
    EXPECT_TRUE(cm.about.ends_with("; read as y up, 0.01 m a unit")) << cm.about;
    const std::string chosen = load("plate_cm.fbx", {.up = UpAxis::X, .unit = 1}).about;
    EXPECT_TRUE(chosen.ends_with("; read as x up, 1 m a unit")) << chosen;
    EXPECT_EQ(m.file_up, UpAxis::Z);
    expect_near(load("plate_zup_m.fbx", {.up = UpAxis::Y}).bounds.hi, {3, 1, 3}, kTolerance, "y instead of z");
    expect_near(load("plate_cm.fbx", {.unit = 1}).bounds.hi, {300, 100, 300}, kTolerance * 100, "metres");
}

TEST(Importers, ChoicesTurnAndScaleGltfToo) {
    const Scene plain = load("scene.glb");
    const Scene turned = load("scene.glb", {.up = UpAxis::Z, .unit = 0.5});
    expect_near(turned.bounds.lo, 0.5 * glm::dvec3(plain.bounds.lo.x, plain.bounds.lo.z, -plain.bounds.hi.y), 1e-6,
                "lo");
    expect_near(turned.bounds.hi, 0.5 * glm::dvec3(plain.bounds.hi.x, plain.bounds.hi.z, -plain.bounds.lo.y), 1e-6,
                "hi");
    const glm::dvec3 eye(plain.cameras[0].world[3]);
    expect_near(glm::dvec3(turned.cameras[0].world[3]), 0.5 * glm::dvec3(eye.x, eye.z, -eye.y), 1e-6, "camera");
    EXPECT_NEAR(turned.cameras[0].near, 0.5 * plain.cameras[0].near, 1e-9);
    EXPECT_EQ(object_paths(turned), object_paths(plain));
}

TEST(Importers, FilesWithoutMaterialsLoadWithNotes) {
    for (const char* name : {"plate.obj", "plate.off", "plate.ac"}) {
        const Scene scene = load(name);
        EXPECT_EQ(scene.triangle_count(), 2u) << name;
        expect_near(scene.bounds.hi, {2, 1, 3}, kTolerance, name);
        ASSERT_FALSE(scene.warnings.empty()) << name;
        EXPECT_NE(scene.warnings[0].find("states neither unit nor up axis"), std::string::npos) << scene.warnings[0];
    }
    bool lines = false;
    for (const std::string& note : load("plate.obj").warnings) lines |= note.find("1 lines") != std::string::npos;
    EXPECT_TRUE(lines);
}

TEST(Importers, OlderFormatsLoad) {
    for (const char* name : {"scene.3ds", "scene.x"}) EXPECT_EQ(load(name).triangle_count(), 26u) << name;
    expect_same_bounds(load("scene.x"), load("scene.glb"));
    expect_same_bounds(load("plate.3ds"), load("plate_zup_m.fbx"));
}

TEST(Importers, LinksPipesAndOtherFoldersAreNotRead) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "in");
    fs::copy_file(model("scene.obj"), folder / "in/a.obj");
    fs::copy_file(model("scene.mtl"), folder / "scene.mtl");
    fs::create_symlink(folder / "scene.mtl", folder / "in/scene.mtl");
    EXPECT_EQ(masks(load_scene((folder / "in/a.obj").string())), 0u) << "a link";
    fs::remove(folder / "in/scene.mtl");
    ASSERT_EQ(::mkfifo((folder / "in/scene.mtl").c_str(), 0600), 0);
    EXPECT_EQ(masks(load_scene((folder / "in/a.obj").string())), 0u) << "a pipe";
    fs::remove(folder / "in/scene.mtl");
    fs::copy_file(model("scene.mtl"), folder / "in/scene.mtl");
    EXPECT_EQ(masks(load_scene((folder / "in/a.obj").string())), 0u) << "without the image";
    fs::copy_file(model("bars.png"), folder / "in/bars.png");
    EXPECT_EQ(masks(load_scene((folder / "in/a.obj").string())), 1u);
}

TEST(Importers, ConvertedModelNamesNoFile) {
    const std::string json = R"({"asset":{"version":"2.0"},"images":[{"uri":"bars.png"}],"scenes":[{}]})";
    const std::vector<std::uint8_t> bytes(json.begin(), json.end());
    EXPECT_TRUE(test::fails_with([&] { load_converted(bytes, model("scene.obj")); }, {"images[0]", "no converted"}));
}

/// Damages a file: cuts it, flips bits, or swaps two parts.
std::string damaged(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
    const std::size_t kind = below(3);
    if (kind == 0) bytes.resize(below(bytes.size()));
    if (kind == 1)
        for (std::size_t i = 0, n = 1 + below(20); i < n; ++i) bytes[below(bytes.size())] ^= char(1 << below(8));
    if (kind == 2 && bytes.size() > 64) {
        const std::size_t length = 1 + below(32), a = below(bytes.size() - length), b = below(bytes.size() - length);
        std::swap_ranges(bytes.begin() + long(a), bytes.begin() + long(a + std::min(length, a < b ? b - a : length)),
                         bytes.begin() + long(b));
    }
    return bytes;
}

/// Loads damaged copies of every model. Each load ends in a scene or in one sentence.
void load_damaged(int copies) {
    const fs::path folder = fresh_test_folder();
    for (const char* name : {"scene.obj", "scene.fbx", "scene.dae", "scene.ply", "scene.stl", "scene.3ds", "scene.x3d",
                             "scene.x", "plate.off", "plate_cm.fbx", "skinned.fbx"}) {
        const std::string whole = file_bytes(model(name));
        std::mt19937 random(11);
        int loaded = 0;
        for (int i = 0; i < copies; ++i) {
            std::ofstream(folder / name, std::ios::binary) << damaged(whole, random);
            try {
                // Damaged files often loop: two seconds instead of a minute.
                const auto glb =
                    run_foreign_job(kAssimpJob, assimp_request_bytes({name, "model"}), {.processor_s = 2}, &folder);
                load_converted(glb, folder / name);
                ++loaded;
            } catch (const Error& e) {
                const std::string text = e.what();
                EXPECT_FALSE(text.empty());
                EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            }
        }
        ::testing::Test::RecordProperty(name, loaded);
    }
}

TEST(Importers, DamagedModelsEndInASentence) {
    load_damaged(10);
}

SI_TEST_IS(Long, Importers, ManyDamagedModelsEndInASentence);
TEST(Importers, ManyDamagedModelsEndInASentence) {
    load_damaged(500);
}

TEST(Importers, SizeIsCheckedBeforeReading) {
    const fs::path huge = fresh_test_folder() / "huge.obj";
    std::ofstream(huge).close();
    fs::resize_file(huge, assimp::kMaxFileBytes + 1);  // sparse
    EXPECT_TRUE(test::fails_with([&] { load_scene(huge.string()); }, {"huge.obj", "more than the limit of"}));
}

TEST(Importers, FilesThatBecomeABundleNameTheirCommand) {
    for (const FrameFile& row : frame_files())
        for (const std::string_view extension : row.extensions) {
            const std::string file = "a" + std::string(extension);
            EXPECT_EQ(find_importer(file), nullptr) << file << ": is no scene";
            EXPECT_EQ(find_frame_file(file), &row);
            EXPECT_TRUE(test::fails_with([&] { load_scene(file); }, {file, "become a bundle first", "import-"}));
        }
    ASSERT_NE(find_frame_file("/a/FRAME.RDC"), nullptr);
    EXPECT_EQ(find_frame_file("/a/FRAME.RDC")->kind, FrameFileKind::Capture);
    EXPECT_EQ(find_frame_file("a.glb"), nullptr);
}

TEST(Importers, ReadmeNamesEveryFormat) {
    const std::string readme = file_bytes(fs::path(SI_SOURCE_DIR) / "README.md");
    for (const Importer& importer : importers())
        EXPECT_NE(readme.find(importer.label), std::string::npos) << importer.label;
}

}  // namespace
}  // namespace si
