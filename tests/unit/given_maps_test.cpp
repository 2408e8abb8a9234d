// Tests of a bundle's maps in the program's terms: worlds, views, cameras, stored values, choices, the cache.
#include "renderer/bundle/given_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/bundle/bundle_json.h"
#include "renderer/projection/camera.h"
#include "renderer/projection/camera_of_matrix.h"
#include "renderer/projection/projection.h"
#include "renderer/projection/view_of_matrix.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"

namespace si {
namespace {

namespace fs = std::filesystem;

glm::dmat3 some_axes() {
    return glm::dmat3(glm::rotate(glm::rotate(glm::dmat4(1), 0.7, {0, 1, 0}), -0.9, {1, 0, 0}));
}

LightView some_view(bool perspective, DepthConvention convention) {
    LightView view;
    view.eye = {3, 8, -2};
    view.axes = some_axes();
    view.curve = {perspective, perspective ? 0.5 : -4.0, 20, convention};
    view.set_half_extents(glm::dvec2(perspective ? 0.8 : 7.0));
    return view;
}

BundleMap map_of_view(const LightView& view) {
    BundleMap map;
    map.image.file = "a.pfm";
    map.depth.convention = view.curve.convention;
    map.clip.clip_from_world = view.clip_from_relative(glm::dvec3(0));
    return map;
}

const DepthConvention kConventions[] = {{true, false}, {true, true}, {false, false}, {false, true}};

TEST(GivenMaps, WorldsTurnUp) {
    const glm::dvec3 ups[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    const UpAxis axes[] = {UpAxis::X, UpAxis::Y, UpAxis::Z, UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ};
    for (int i = 0; i < 6; ++i)
        for (const bool left : {false, true}) {
            const glm::dvec3 origin(5, 6, 7), point(1, -2, 3);
            const glm::dmat4 world = world_from_engine({axes[i], left, 0.01, origin});
            EXPECT_LT(glm::distance(glm::dmat3(world) * ups[i], glm::dvec3(0, 0.01, 0)), 1e-15) << i;
            EXPECT_NEAR(glm::determinant(glm::dmat3(world)), left ? -1e-6 : 1e-6, 1e-18);
            EXPECT_LT(glm::distance(glm::dvec3(world * glm::dvec4(point, 1)), glm::dmat3(world) * (origin + point)),
                      1e-15);
        }
    EXPECT_EQ(world_from_engine({}), glm::dmat4(1));
}

// A point of the engine's world and the same point in metres lie at one place of the map.
TEST(GivenMaps, ViewsFollowTheWorld) {
    const BundleWorld worlds[] = {{},
                                  {UpAxis::Z, false, 0.01, {100, 200, 300}},
                                  {UpAxis::Z, true, 1, {0, 0, 0}},
                                  {UpAxis::MinusX, true, 0.3048, {1e5, 0, 3}}};
    for (const BundleWorld& world : worlds)
        for (const bool perspective : {false, true})
            for (const DepthConvention convention : kConventions) {
                const glm::dmat4 change = world_from_engine(world);
                const LightView ours = some_view(perspective, convention);
                BundleMap map = map_of_view(ours);
                map.clip.clip_from_world = 3.5 * *map.clip.clip_from_world * change;
                const LightView view = view_of_map(world, map);
                EXPECT_LT(glm::distance(glm::dvec3(view.axes[2]), glm::dvec3(ours.axes[2])), 1e-9);
                EXPECT_NEAR(view.curve.far - view.curve.near, ours.curve.far - ours.curve.near, 1e-6);
                for (const glm::dvec3 metres : {glm::dvec3(2, 1, 0), glm::dvec3(-1, 0.5, 3)}) {
                    const glm::dvec4 engine = glm::inverse(change) * glm::dvec4(metres, 1);
                    const glm::dvec4 theirs = *map.clip.clip_from_world * engine;
                    const glm::dvec4 here = view.clip_from_relative(metres)[3];
                    EXPECT_LT(glm::distance(glm::dvec3(theirs) / theirs.w, glm::dvec3(here) / here.w), 1e-7);
                }
            }
}

TEST(GivenMaps, ViewsInPartsAreExact) {
    for (const bool perspective : {false, true})
        for (const DepthConvention convention : kConventions) {
            const LightView ours = some_view(perspective, convention);
            BundleMap map = map_of_view(ours);
            map.clip = {.projection = ours.projection};
            map.clip.world_from_view = glm::dmat4(ours.axes);
            (*map.clip.world_from_view)[3] = glm::dvec4(ours.eye, 1);
            map.depth.planes_m = {ours.curve.near, ours.curve.far};
            const LightView view = view_of_map({}, map);
            EXPECT_EQ(view.eye, ours.eye);
            EXPECT_EQ(view.axes, ours.axes);
            EXPECT_EQ(view.projection, ours.projection);
            EXPECT_TRUE(view.curve == ours.curve);
            // Numbers that disagree with the matrix are not taken.
            map.depth.planes_m = {ours.curve.near + 0.1, ours.curve.far + 1};
            EXPECT_NEAR(view_of_map({}, map).curve.far, ours.curve.far, 1e-9);
        }
    BundleMap bad = map_of_view(some_view(true, {}));
    bad.clip.clip_from_world = glm::dmat4(0);
    EXPECT_TRUE(test::fails_with([&] { view_of_map({}, bad); }, {"the matrix: it is singular"}));
}

TEST(GivenMaps, CamerasFollowFromMatrices) {
    for (const bool orthographic : {false, true})
        for (const DepthConvention convention : kConventions)
            for (const bool flipped : {false, true}) {
                Camera camera;
                camera.eye = {4, 3, -9};
                camera.axes = some_axes();
                camera.orthographic = orthographic;
                camera.curve = {!orthographic, 0.2, 90, convention};
                camera.fov_y_rad = 0.9;
                camera.height = 6;
                camera.aspect = 16.0 / 9;
                glm::dmat4 clip = 2.0 * camera.clip_from_relative(glm::dvec3(0));
                if (flipped) clip = glm::scale(glm::dmat4(1), {1, -1, 1}) * clip;
                const MatrixCamera found = camera_of_matrix(clip, convention);
                EXPECT_EQ(found.orthographic, orthographic);
                for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(found.axes[i], camera.axes[i]), 1e-9);
                EXPECT_FALSE(found.is_off_axis());
                EXPECT_NEAR((found.hi.x - found.lo.x) / (found.hi.y - found.lo.y), camera.aspect, 1e-9);
                if (orthographic) {
                    EXPECT_NEAR(found.hi.y - found.lo.y, 6, 1e-9);
                    EXPECT_LT(glm::distance(found.eye, camera.eye - 0.2 * camera.axes[2]), 1e-9);
                } else {
                    EXPECT_NEAR(found.fov_y_rad(), 0.9, 1e-9);
                    EXPECT_LT(glm::distance(found.eye, camera.eye), 1e-9);
                    EXPECT_NEAR(found.near, 0.2, 1e-9);
                    EXPECT_NEAR(found.far, 90, 1e-6);
                }
            }
    // An infinite reversed projection off its axis.
    glm::dmat4 p(0);
    p[0][0] = 1;
    p[1][1] = 2;
    p[2][0] = 0.3;
    p[2][3] = -1;
    p[3][2] = 0.1;
    const MatrixCamera found = camera_of_matrix(p, {true, true});
    EXPECT_TRUE(found.is_off_axis());
    EXPECT_NEAR(found.lo.x, -0.7, 1e-12);
    EXPECT_NEAR(found.hi.x, 1.3, 1e-12);
    EXPECT_NEAR(found.near, 0.1, 1e-12);
    EXPECT_EQ(found.far, 0);
    EXPECT_TRUE(test::fails_with([] { camera_of_matrix(glm::dmat4(0), {}); }, {"the matrix: "}));
}

// Texels are computed from a plane of known distance by each rule of storage.
TEST(GivenMaps, StoredValuesBecomeDepths) {
    constexpr int kSide = 4;
    for (const bool perspective : {false, true})
        for (const DepthConvention convention : kConventions) {
            const LightView view = some_view(perspective, convention);
            const double z = 7.25, near = view.curve.near, far = view.curve.far;
            const auto expect_depths = [&](BundleStored stored, auto value_of, double tolerance) {
                BundleMap map = map_of_view(view);
                map.depth.stored = stored;
                map.depth.range_m = 50;
                map.depth.exponent = 5;
                FloatImage image{kSide, kSide, 1, {}};
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x) {
                        const glm::dvec2 tangent = 0.8 * (2.0 * (glm::dvec2(x, y) + 0.5) / double(kSide) - 1.0);
                        image.data.push_back(
                            float(value_of(perspective ? std::sqrt(1 + glm::dot(tangent, tangent)) : 1)));
                    }
                const MapDepths out = depths_of_map(map, view, image);
                EXPECT_EQ(out.outside_range, 0u);
                for (const float depth : out.depths.data)
                    EXPECT_NEAR(view.curve.distance(double(depth)), z, tolerance) << int(stored);
            };
            expect_depths(
                BundleStored::Depth, [&](double) { return view.curve.depth(z); }, 1e-3);
            expect_depths(
                BundleStored::Linear, [&](double) { return (z - near) / (far - near); }, 1e-3);
            expect_depths(
                BundleStored::Moments, [&](double) { return (z - near) / (far - near); }, 1e-3);
            expect_depths(
                BundleStored::AxisMetres, [&](double) { return z; }, 1e-3);
            expect_depths(
                BundleStored::DistanceMetres, [&](double ray) { return z * ray; }, 1e-3);
            expect_depths(
                BundleStored::DistanceShare, [&](double ray) { return z * ray / 50; }, 1e-3);
            expect_depths(
                BundleStored::Exponential, [&](double) { return std::exp(5 * (z - near) / (far - near)); }, 1e-2);
        }
}

TEST(GivenMaps, RegionsRowsAndFaultyTexels) {
    const LightView view = some_view(false, {true, true});
    BundleMap map = map_of_view(view);
    FloatImage image{3, 4, 2, {}};
    for (int i = 0; i < 24; ++i) image.data.push_back(float(i) / 32);
    map.image.channel = 1;
    map.region = BundleRegion{1, 2, 2, 2};
    map.image.first_row = FirstRow::Top;
    const auto depth = [](int x, int y) { return float(2 * (3 * y + x) + 1) / 32; };
    EXPECT_EQ(depths_of_map(map, view, image).depths.data,
              (std::vector<float>{depth(1, 2), depth(2, 2), depth(1, 3), depth(2, 3)}));
    map.image.first_row = FirstRow::Bottom;
    EXPECT_EQ(depths_of_map(map, view, image).depths.data,
              (std::vector<float>{depth(1, 3), depth(2, 3), depth(1, 2), depth(2, 2)}));
    map.region->width = 3;
    EXPECT_TRUE(test::fails_with([&] { depths_of_map(map, view, image); }, {"exceeds the image of 3 × 4"}));
    map.region.reset();
    map.image.channel = 2;
    EXPECT_TRUE(test::fails_with([&] { depths_of_map(map, view, image); }, {"channel 2 is read, and the image has 2"}));

    map = map_of_view(view);
    map.depth.clear = -1;
    const MapDepths out = depths_of_map(map, view, {5, 1, 1, {NAN, -1, 0.5f, 1.5f, INFINITY}});
    EXPECT_EQ(out.depths.data, (std::vector<float>{0, 0, 0.5f, 1, 1})) << "reversed depth: the far plane is 0";
    EXPECT_EQ(out.not_a_number, 1u);
    EXPECT_EQ(out.outside_range, 2u);
}

// The map of a matrix whose w changes by column holds what the map of the same matrix with x and y exchanged holds.
TEST(GivenMaps, MapsWarpedByColumnAreTurned) {
    const fs::path folder = fs::path(SI_TEST_OUTPUT_DIR) / "warped_by_column.bundle";
    fs::remove_all(folder);
    fs::create_directories(folder);
    glm::dmat4 by_row(0.0);  // parallel rays along -z, w = 1 + 0.05 y, depth z / -10
    by_row[0][0] = 0.25;
    by_row[1][1] = 0.2;
    by_row[1][3] = 0.05;
    by_row[2][2] = -0.1;
    by_row[3][3] = 1;
    glm::dmat4 by_column = by_row;
    for (int c = 0; c < 4; ++c) std::swap(by_column[c].x, by_column[c].y);
    EXPECT_FALSE(is_warped_by_column(by_row));
    ASSERT_TRUE(is_warped_by_column(by_column));
    // Three columns and two rows, the first row at the bottom: texel (x, y) holds (1 + x + 3 y) / 10.
    const float texels[] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
    std::ofstream(folder / "a.raw", std::ios::binary).write(reinterpret_cast<const char*>(texels), sizeof texels);
    Bundle bundle;
    BundleLight light;
    BundleMap map;
    map.image = {.file = "a.raw", .width = 3, .height = 2, .format = RawFormat::F32};
    map.clip.clip_from_world = by_column;
    light.maps = {map};
    bundle.lights = {light};
    std::ofstream(folder / "frame.json") << format_bundle(bundle);
    BundleFiles files(folder);
    const GivenMaps given = read_given_maps(files);
    ASSERT_EQ(given.lights.size(), 1u);
    const ImportedMaps& maps = *given.lights[0];
    EXPECT_EQ(maps.size(), MapSize(2, 3));
    EXPECT_EQ(given.notes.size(), 1u);
    const LightView& view = maps.views->views[0];
    EXPECT_TRUE(view.warped());
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 2; ++y) {
            const float depth = texels[x + 3 * y];
            // The place of the texel in the world by the engine's matrix.
            const glm::dvec4 clip((x + 0.5) / 3 * 2 - 1, (y + 0.5) / 2 * 2 - 1, double(depth), 1);
            const glm::dvec4 world = glm::inverse(by_column) * clip;
            const glm::dvec4 seen = view.clip_from_relative(glm::dvec3(0)) * glm::dvec4(glm::dvec3(world) / world.w, 1);
            const glm::dvec3 uvd = uvd_from_ndc(view.curve.convention, glm::dvec3(seen) / seen.w);
            const int column = int(uvd.x * 2), row = 2 - int(uvd.y * 3);
            EXPECT_NEAR(uvd.z, double(depth), 1e-6);
            EXPECT_FLOAT_EQ(maps.images[0].at(column, row), depth) << x << ", " << y;
        }
}

TEST(GivenMaps, OverlappingIntervalsBlend) {
    Bundle bundle;
    Camera camera;
    camera.axes = some_axes();
    camera.eye = {1, 2, 3};
    camera.curve.perspective = true;
    bundle.camera = BundleCamera{{camera.clip_from_relative(glm::dvec3(0))}, 10, 10, camera.curve.convention};
    BundleLight light;
    const LightView view = some_view(false, {});
    light.maps.assign(3, map_of_view(view));
    light.maps[0].interval = {0, 5};
    light.maps[1].interval = {4, 12};
    light.maps[2].interval = {12, 40};
    const ViewChooser chooser = chooser_of(bundle, light, {view, view, view});
    EXPECT_EQ(chooser.choice, ViewChoice::Interval);
    EXPECT_LT(glm::distance(chooser.from_ws, camera.eye), 1e-9);
    const auto at = [&](double z) {
        const std::vector<LightView> views(3, view);
        return chooser.choose(views, camera.eye - z * camera.axes[2]);
    };
    EXPECT_EQ(at(3).view, 0u);
    EXPECT_NEAR(at(4.5).share, 0.5, 1e-9);
    EXPECT_EQ(at(4.5).other, 1u);
    EXPECT_EQ(at(11).view, 1u);
    EXPECT_EQ(at(11).share, 0);
    EXPECT_EQ(at(13).view, 2u);
}

std::string pfm(int width, int height, float value) {
    std::string out = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    for (int i = 0; i < width * height; ++i) out.append(reinterpret_cast<const char*>(&value), sizeof value);
    return out;
}

/// Returns a bundle of one light whose maps have these images.
Bundle bundle_of(const std::vector<std::string>& images) {
    Bundle bundle;
    bundle.lights.emplace_back();
    for (const std::string& image : images) {
        bundle.lights[0].maps.push_back(map_of_view(some_view(false, {})));
        bundle.lights[0].maps.back().image.file = image;
    }
    return bundle;
}

TEST(GivenMaps, FilesAreReadOnceUntilTheyChange) {
    const fs::path path = fresh_test_folder() / "a.bundle";
    const std::string frame = format_bundle(bundle_of({"a.pfm", "b.pfm"}));
    write_bundle_files({{"frame.json", frame}, {"a.pfm", pfm(4, 2, 0.25f)}, {"b.pfm", pfm(4, 2, 0.5f)}}, path);
    const auto maps = given_maps(path);
    ASSERT_EQ(maps->lights.size(), 1u);
    EXPECT_EQ(maps->lights[0]->size(), MapSize(4, 2));
    EXPECT_EQ(maps->lights[0]->images[1].data[3], 0.5f);
    EXPECT_EQ(maps->lights[0]->views->chooser.choice, ViewChoice::Map);
    EXPECT_EQ(given_maps(path), maps);
    EXPECT_EQ(given_maps(path / "frame.json")->lights[0]->key, maps->lights[0]->key);
    fs::remove(path / "b.pfm");
    std::ofstream(path / "b.pfm", std::ios::binary) << pfm(4, 2, 0.75f);
    const auto changed = given_maps(path);
    EXPECT_EQ(changed->lights[0]->images[1].data[3], 0.75f);
    EXPECT_NE(changed->lights[0]->key, maps->lights[0]->key);
}

TEST(GivenMaps, FaultyBundlesAreRefusedByOneSentence) {
    const fs::path path = fresh_test_folder() / "a.bundle";
    const auto refused = [&](const Bundle& bundle, std::initializer_list<std::string_view> parts) {
        fs::remove_all(path);
        write_bundle_files({{"frame.json", format_bundle(bundle)},
                            {"a.pfm", pfm(4, 2, 0.25f)},
                            {"b.pfm", pfm(2, 2, 0.5f)},
                            {"c.pfm", "no image"},
                            {"d.pfm", pfm(4, 2, 0).substr(0, 20)},
                            {"e.raw", "12345678"}},
                           path);
        return test::fails_with([&] { given_maps(path); }, parts);
    };
    EXPECT_TRUE(refused(bundle_of({"none.pfm"}), {"a.bundle/none.pfm: does not exist"}));
    EXPECT_TRUE(
        refused(bundle_of({"a.pfm", "b.pfm"}), {"lights[0].maps[1]: the map has 2 × 2 texels", "first one 4 × 2"}));
    EXPECT_TRUE(refused(bundle_of({"c.pfm"}), {"c.pfm: the file is no PFM image"}));
    EXPECT_TRUE(refused(bundle_of({"d.pfm"}), {"d.pfm: ", "bytes follow the header and 32 are needed"}));
    Bundle bundle = bundle_of({"a.pfm"});
    bundle.lights[0].maps[0].image.width = 5;
    EXPECT_TRUE(refused(bundle, {"a.pfm: the image has 4 × 2 texels and frame.json states 5 × 0"}));
    bundle = bundle_of({"e.raw"});
    bundle.lights[0].maps[0].image = {"e.raw", {}, 2, 2, RawFormat::U16};
    fs::remove_all(path);
    write_bundle_files({{"frame.json", format_bundle(bundle)}, {"e.raw", std::string("\0\0\xff\xff\0\x80\1\0", 8)}},
                       path);
    EXPECT_EQ(given_maps(path)->lights[0]->images[0].data,
              (std::vector<float>{float(0x8000 / 65535.0), float(1 / 65535.0), 0, 1}));
    bundle.lights[0].maps[0].image.format = RawFormat::F32;
    EXPECT_TRUE(refused(bundle, {"e.raw: the file has 8 bytes, and 2 × 2 texels of 4 bytes make 16"}));
    bundle = bundle_of({"a.pfm"});
    bundle.lights[0].maps[0].clip.clip_from_world = glm::dmat4(0);
    EXPECT_TRUE(refused(bundle, {"frame.json: lights[0].maps[0]: the matrix: ", "; "}));
    bundle.lights[0].maps[0] = map_of_view(some_view(false, {}));
    bundle.lights[0].maps[0].image.file = "a.pfm";
    bundle.lights[0].direction = some_axes()[2];
    EXPECT_TRUE(refused(bundle, {"lights[0].maps[0]: the map looks against the light's direction"}));
    bundle.lights[0].direction.reset();
    bundle.lights[0].maps[0].clip = map_of_view(some_view(true, {})).clip;
    bundle.lights[0].maps[0].depth.convention.reversed = true;
    EXPECT_TRUE(refused(bundle, {"depth grows against its convention", "the other reversed setting fits"}));
}

TEST(GivenMaps, MapsMoveWithTheScene) {
    const fs::path path = fresh_test_folder() / "a.bundle";
    write_bundle_files({{"frame.json", format_bundle(bundle_of({"a.pfm"}))}, {"a.pfm", pfm(2, 2, 0.25f)}}, path);
    const auto maps = given_maps(path)->lights[0];
    EXPECT_EQ(placed_maps(maps, glm::dmat4(1)), maps);
    const glm::dmat4 placement = glm::scale(glm::translate(glm::dmat4(1), {100, 20, 3}), glm::dvec3(2));
    const auto moved = placed_maps(maps, placement);
    EXPECT_NE(moved->key, maps->key);
    const glm::dvec3 point(1, 2, 0.5);
    const glm::dvec4 a = maps->views->views[0].clip_from_relative(point)[3];
    const glm::dvec4 b = moved->views->views[0].clip_from_relative(glm::dvec3(placement * glm::dvec4(point, 1)))[3];
    EXPECT_LT(glm::distance(glm::dvec3(a) / a.w, glm::dvec3(b) / b.w), 1e-9);
}

}  // namespace
}  // namespace si
