// Tests of light maps without a GPU: charts, packing, keys, and the disk cache.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "renderer/reference/light_map_cache.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/box_scene.h"
#include "tests/support/error_text.h"
#include "tests/support/mesh_scene.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

std::shared_ptr<const ReferenceGeometry> scene_geometry(const Scene& scene) {
    return std::make_shared<const ReferenceGeometry>(scene, Settings());
}

LightMapTask task_of(const Scene& scene, int side = 128, const glm::dvec3& to_light = {0.6, 0.8, 0}) {
    return {scene_geometry(scene), {.type = LightType::Directional, .to_light = to_light}, side, 1, scene.id};
}

/// Makes a floor of 10 m with a box of 1 m at (x, 0).
Scene floor_with_box(double x = 0) {
    return test::grey_scene({{"floor", make_plane(10, 10)}, {"box", make_box({1, 1, 1}), moved(x, 0.6, 0)}});
}

/// Makes a spiral ramp of two turns that rises half a metre a turn: nowhere steep, and above itself.
Mesh make_spiral() {
    std::vector<std::vector<glm::dvec3>> faces;
    constexpr int kSteps = 48;
    const auto at = [](int i, double radius) {
        const double angle = 2 * std::numbers::pi * i / kSteps;
        return glm::dvec3(radius * std::cos(angle), 0.5 * i / kSteps, -radius * std::sin(angle));
    };
    for (int i = 0; i < 2 * kSteps; ++i) {
        faces.push_back({at(i, 1), at(i, 2), at(i + 1, 2)});
        faces.push_back({at(i, 1), at(i + 1, 2), at(i + 1, 1)});
    }
    return make_polygons("spiral", faces);
}

/// Expects separate charts with their triangles inside.
void expect_sound(const ReferenceGeometry& geometry, const LightMapLayout& layout) {
    std::vector<std::uint32_t> owner(std::size_t(layout.side) * std::size_t(layout.side), 0);
    for (std::uint32_t c = 0; c < layout.charts.size(); ++c) {
        const glm::ivec4 r = layout.charts[c].rect;
        ASSERT_TRUE(r.x >= 0 && r.y >= 0 && r.x + r.z <= layout.side && r.y + r.w <= layout.side) << c;
        for (int y = r.y; y < r.y + r.w; ++y)
            for (int x = r.x; x < r.x + r.z; ++x) {
                std::uint32_t& o = owner[std::size_t(y) * std::size_t(layout.side) + std::size_t(x)];
                ASSERT_EQ(o, 0u) << "charts " << o - 1 << " and " << c;
                o = c + 1;
            }
    }
    for (std::uint32_t object = 0; object < layout.objects.size(); ++object)
        for (std::uint32_t t = 0; t < layout.objects[object].count; ++t) {
            const std::uint32_t c = layout.chart_of[layout.objects[object].first + t];
            ASSERT_NE(c, LightMapLayout::kNoChart);
            const LightMapChart& chart = layout.charts[c];
            EXPECT_EQ(chart.object, object);
            const TriangleWs corners = geometry.triangle(object, t);
            for (const glm::dvec3& p : corners) {
                const glm::dvec2 at = layout.atlas_position(chart, p);
                EXPECT_GE(at.x, chart.rect.x + 1 - 1e-6);
                EXPECT_GE(at.y, chart.rect.y + 1 - 1e-6);
                EXPECT_LE(at.x, chart.rect.x + chart.rect.z - 1 + 1e-6);
                EXPECT_LE(at.y, chart.rect.y + chart.rect.w - 1 + 1e-6);
            }
        }
}

/// Returns the share of the light map's texels that charts use, gutters included.
double used_share(const LightMapLayout& layout) {
    double texels = 0;
    for (const LightMapChart& c : layout.charts) texels += double(c.rect.z) * c.rect.w;
    return texels / (double(layout.side) * layout.side);
}

TEST(LightMapLayout, PacksChartsWithGutters) {
    for (const char* name : {"boxes", "stage", "teapot", "relief"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name);
        const auto geometry = scene_geometry(scene);
        double before = 0;
        for (const int side : {256, 1024}) {
            const LightMapLayout layout = light_map_layout(*geometry, side);
            expect_sound(*geometry, layout);
            EXPECT_GT(layout.texels_per_metre, 2 * before);
            EXPECT_GT(used_share(layout), side == 1024 ? 0.5 : 0.3);
            before = layout.texels_per_metre;
            std::printf("%-8s %4d: %5zu charts of %zu triangles, %.1f texels/m, %.0f %% used\n", name, side,
                        layout.charts.size(), layout.chart_of.size(), layout.texels_per_metre,
                        100 * used_share(layout));
        }
    }
}

TEST(LightMapLayout, JoinsCoplanarAndSlightlyBentTriangles) {
    const Scene scene = floor_with_box();
    EXPECT_EQ(light_map_layout(*scene_geometry(scene), 256).charts.size(), 7u) << "the floor and six sides";
    const Scene ball = make_scene(make_sphere(1));
    const LightMapLayout layout = light_map_layout(*scene_geometry(ball), 256);
    EXPECT_LT(layout.charts.size(), 60u);
    EXPECT_GT(layout.charts.size(), 8u) << "a side of a ball cannot be laid flat in one";
}

TEST(LightMapLayout, SplitsOverlappingCharts) {
    const Scene scene = make_scene(make_spiral());
    const auto geometry = scene_geometry(scene);
    const LightMapLayout layout = light_map_layout(*geometry, 256);
    expect_sound(*geometry, layout);
    // No texel centre is in two triangles of one chart that are half a metre apart.
    for (const LightMapChart& chart : layout.charts) {
        const auto height = [&](std::uint32_t i) {
            const TriangleWs t = geometry->triangle(chart.object, layout.triangles[chart.first + i]);
            return (t[0].y + t[1].y + t[2].y) / 3;
        };
        for (std::uint32_t i = 1; i < chart.count; ++i) EXPECT_LT(std::abs(height(i) - height(0)), 0.3);
    }
}

TEST(LightMapLayout, RefusesAnUnfittingSizeAndNamesAFittingOne) {
    std::vector<std::vector<glm::dvec3>> blades;
    for (int i = 0; i < 400; ++i)
        blades.push_back({{0.1 * i, 0, 0}, {0.1 * i + 0.05, 0, 0}, {0.1 * i, 0.3, 0.001 * (i % 7)}});
    const Scene grass = make_scene(make_polygons("grass", blades));
    const auto geometry = scene_geometry(grass);
    EXPECT_TRUE(test::fails_with([&] { light_map_layout(*geometry, 32); },
                                 {"400 charts", "set light_map.resolution to 64 or more"}));
    expect_sound(*geometry, light_map_layout(*geometry, 64));
}

TEST(LightMapBake, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = load_scene("boxes");
    LightMapTask task = task_of(scene, 200);  // no multiple of the traced batch
    task.emitter.size = 2;
    for (const int samples : {1, 64}) {
        task.samples = samples;
        LightMapCache one, two;
        const auto a = one.get(task, {.threads = 1}), b = two.get(task, {.threads = 3});
        EXPECT_EQ(a->texels, b->texels);
        EXPECT_EQ(a->rays, b->rays);
        const auto grey = std::count_if(a->texels.begin(), a->texels.end(), [](int t) { return t > 0 && t < 255; });
        EXPECT_EQ(grey > 100, samples > 1) << grey;
        EXPECT_GT(std::count(a->texels.begin(), a->texels.end(), 0), 100);
    }
}

TEST(LightMapKey, DependsOnlyOnInputsOfRays) {
    const Scene scene = floor_with_box();
    const LightMapTask task = task_of(scene);
    const std::uint64_t content = light_map_content_key(task);
    EXPECT_EQ(light_map_content_key(task_of(floor_with_box())), content) << "another scene of the same content";
    EXPECT_NE(light_map_content_key(task_of(floor_with_box(0.001))), content) << "a moved object";
    EXPECT_NE(light_map_content_key(task_of(scene, 129)), content);
    EXPECT_NE(light_map_content_key(task_of(scene, 128, {0.8, 0.6, 0})), content) << "a turned light";
    LightMapTask other = task;
    other.samples = 64;
    other.emitter.size = 1;
    EXPECT_NE(light_map_content_key(other), content);
    other = task;
    other.emitter.size = 1;
    EXPECT_EQ(light_map_content_key(other), content) << "one ray goes to the middle";
    Settings no_cast;
    no_cast.objects[scene.nodes[std::size_t(scene.objects[1].node)].path].cast = false;
    other.geometry = std::make_shared<const ReferenceGeometry>(scene, no_cast);
    EXPECT_NE(light_map_content_key(other), content) << "a box that casts nothing";
    LightMapTask spot = task;
    spot.emitter = {.type = LightType::Spot, .position_ws = {0, 5, 0}, .cos_cone = 0.5, .range_m = 0};
    const std::uint64_t of_spot = light_map_content_key(spot);
    spot.emitter.cos_cone = 0.7;
    spot.emitter.range_m = 9;
    EXPECT_EQ(light_map_content_key(spot), of_spot) << "cone and range are not what rays find";
    spot.emitter.position_ws.x = 1e-3;
    EXPECT_NE(light_map_content_key(spot), of_spot);
    // Masks: the stage has foliage.
    Scene stage = load_scene("stage");
    const std::uint64_t of_stage = light_map_content_key(task_of(stage));
    EXPECT_EQ(light_map_content_key(task_of(load_scene("stage"))), of_stage);
    bool changed = false;
    for (Texture& t : stage.textures)
        for (std::size_t i = 3; !changed && i < t.rgba.size(); i += 4)
            changed = t.rgba[i] != 0 && (t.rgba.edit()[i] = 0, true);
    ASSERT_TRUE(changed);
    bool masked = false;
    for (const Material& m : stage.materials) masked |= m.alpha == AlphaMode::Mask;
    ASSERT_TRUE(masked);
}

class LightMapFiles : public testing::Test {
protected:
    fs::path folder = fresh_test_folder() / "maps";
    Scene scene = floor_with_box();

    std::vector<fs::path> files() const {
        std::vector<fs::path> out;
        std::error_code none;
        for (const auto& e : fs::directory_iterator(folder, none)) out.push_back(e.path());
        return out;
    }
    /// Returns the light map as a fresh instance finds it.
    std::shared_ptr<const LightMap> get(const LightMapTask& task, std::size_t baked,
                                        std::uint64_t most = LightMapCache::kMaxDiskBytes) {
        LightMapCache maps;
        maps.set_disk_folder(folder, most);
        auto map = maps.get(task, {.threads = 2});
        EXPECT_EQ(maps.counts().baked, baked);
        EXPECT_EQ(maps.counts().read, 1 - baked);
        return map;
    }
    void rewrite(const fs::path& file, const std::function<void(std::string&)>& change) {
        std::string bytes = file_bytes(file);
        change(bytes);
        std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    }
};

TEST_F(LightMapFiles, AreReadInsteadOfBakingAndHoldTheSameBytes) {
    const auto baked = get(task_of(scene), 1);
    ASSERT_EQ(files().size(), 1u);
    const auto read = get(task_of(floor_with_box()), 0);
    EXPECT_TRUE(read->from_disk);
    EXPECT_EQ(read->texels, baked->texels);
    EXPECT_EQ(read->rays, baked->rays);
    EXPECT_TRUE(read->remark.empty()) << read->remark;
    get(task_of(floor_with_box(1)), 1);
    EXPECT_EQ(files().size(), 2u) << "another content, another file";
}

TEST_F(LightMapFiles, MapsInMemoryAreFoundByContent) {
    LightMapCache maps;
    const auto first = maps.get(task_of(scene), {.threads = 2});
    const Scene again = floor_with_box();
    const auto second = maps.get(task_of(again), {.threads = 2});
    EXPECT_EQ(maps.counts().baked, 1u);
    EXPECT_EQ(second->key, again.id) << "for the frame that asks";
    EXPECT_EQ(second->version, first->version);
    EXPECT_TRUE(files().empty()) << "no folder was given";
}

TEST_F(LightMapFiles, DamagedFilesAreBakedAgain) {
    const auto baked = get(task_of(scene), 1);
    const fs::path file = files().at(0);
    const std::vector<std::pair<const char*, std::function<void(std::string&)>>> damages = {
        {"damaged", [](std::string& b) { b[b.size() / 2] ^= 0x40; }},
        {"cut short", [](std::string& b) { b.resize(b.size() - 1); }},
        {"cut short", [](std::string& b) { b.resize(40); }},
        {"no light map", [](std::string& b) { b.clear(); }},
        {"too long", [](std::string& b) { b += "x"; }},
        {"no light map", [](std::string& b) { b[3] ^= 1; }},
        {"another version", [](std::string& b) { b[27] ^= 1; }},
        {"another scene", [](std::string& b) { b[36] ^= 1; }}};
    for (const auto& [what, damage] : damages) {
        rewrite(file, damage);
        const auto again = get(task_of(scene), 1);
        EXPECT_NE(again->remark.find(what), std::string::npos) << what << ": " << again->remark;
        EXPECT_NE(again->remark.find(file.string()), std::string::npos);
        EXPECT_EQ(again->texels, baked->texels);
        EXPECT_EQ(get(task_of(scene), 0)->texels, baked->texels) << "and the file is whole again after: " << what;
    }
}

TEST_F(LightMapFiles, CancelledBakesLeaveNone) {
    LightMapCache maps;
    maps.set_disk_folder(folder);
    std::stop_source stop;
    double last = 0;
    const Workers workers{.threads = 2, .stop = stop.get_token(), .progress = [&](double t) {
                              EXPECT_GE(t, last - 1e-9) << "progress rises";
                              last = t;
                              if (t > 0.3) stop.request_stop();
                          }};
    EXPECT_THROW(maps.get(task_of(scene, 512), workers), Cancelled);
    EXPECT_LT(last, 0.9);
    EXPECT_TRUE(files().empty());
    EXPECT_EQ(maps.counts().baked, 0u);
    const auto baked = maps.get(task_of(scene, 512), {.threads = 2});
    EXPECT_EQ(baked->texels, get(task_of(scene, 512), 0)->texels);
}

TEST_F(LightMapFiles, StayBelowTheirSizeLimit) {
    const std::uint64_t one = 128 * 128 + 100, most = 2 * one + one / 2;
    for (const double x : {0.0, 1.0, 2.0}) {
        get(task_of(floor_with_box(x)), 1, most);
        ::usleep(20'000);  // so that times differ
    }
    EXPECT_EQ(files().size(), 2u);
    get(task_of(floor_with_box(1)), 0, most);  // used, so now the newest
    ::usleep(20'000);
    get(task_of(floor_with_box(3)), 1, most);
    get(task_of(floor_with_box(1)), 0, most);
    get(task_of(floor_with_box(2)), 1, most);
    get(task_of(scene, 256), 1, most);
    get(task_of(scene, 256), 1, most);
    EXPECT_EQ(files().size(), 2u) << "what is larger than all may be is not kept";
}

TEST_F(LightMapFiles, UnwritableFilesAreReported) {
    fs::create_directories(folder.parent_path());
    std::ofstream(folder.string()) << "in the way";
    const auto map = get(task_of(scene), 1);
    EXPECT_NE(map->remark.find("not kept on disk"), std::string::npos) << map->remark;
}

}  // namespace
}  // namespace si
