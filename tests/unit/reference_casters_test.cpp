// Tests of casters in the ray-traced reference: masks, blended surfaces, culled faces, shared meshes. A trace can be
// stopped, and its result does not depend on threads.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stop_token>
#include <thread>

#include "renderer/base/directions.h"
#include "renderer/reference/traced_so_far.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/support/traced.h"

namespace si {
namespace {

using test::geometry_of;
using test::query_for;
using test::receiver_on;
using test::row_of;
using test::sun;

/// Makes a picture of floor points over [-half, half]^2 at y = 0; object 0 is the floor.
Receivers floor_points(double half, int size) {
    Receivers receivers{size, size, {}};
    for (int z = 0; z < size; ++z)
        for (int x = 0; x < size; ++x) {
            const glm::dvec3 at(half * (2 * (x + 0.5) / size - 1), 0, half * (2 * (z + 0.5) / size - 1));
            receivers.pixels.push_back(test::floor_receiver(at, 4 * half));
        }
    return receivers;
}

Scene floor_and(Mesh mesh, const std::vector<glm::dmat4>& places) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.5f, 0.5f, 0.5f});
    scene.materials.push_back({});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(20, 20), grey));
    const int index = add_mesh(scene, "caster", std::move(mesh), 1);
    for (const glm::dmat4& place : places) add_object(scene, "caster", -1, index, place);
    finalise(scene);
    return scene;
}

Texture stripes(int width, int height) {
    Texture t;
    t.width = width;
    t.height = height;
    t.nearest_mag = true;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) t.rgba.append({255, 255, 255, std::uint8_t(x % 2 ? 255 : 0)});
    return t;
}

double lit_share(const Reference& reference) {
    double sum = 0;
    for (const float v : reference.hard().data) sum += v;
    return sum / double(reference.hard().data.size());
}

TEST(AlphaTexture, WrapsAndFiltersLikeOpenGl) {
    Texture t;
    t.width = 2;
    t.height = 1;
    t.rgba = {0, 0, 0, 0, 0, 0, 0, 255};
    t.nearest_mag = true;
    const auto at = [&](double u) { return AlphaTexture(t).sample({u, 0.5}); };
    EXPECT_EQ(at(0.25), 0);
    EXPECT_EQ(at(0.75), 1);
    EXPECT_EQ(at(1.25), 0);
    EXPECT_EQ(at(-0.25), 1);
    EXPECT_EQ(at(1e6 + 0.25), 0);
    t.wrap_s = TextureWrap::Clamp;
    EXPECT_EQ(at(7), 1);
    EXPECT_EQ(at(-7), 0);
    t.wrap_s = TextureWrap::Mirror;
    EXPECT_EQ(at(1.25), 1);
    EXPECT_EQ(at(1.75), 0);
    EXPECT_EQ(at(-0.25), 0);
    EXPECT_EQ(at(2.25), 0);
    t.nearest_mag = false;
    t.wrap_s = TextureWrap::Clamp;
    EXPECT_DOUBLE_EQ(at(0.5), 0.5);
    EXPECT_DOUBLE_EQ(at(0.375), 0.25);
    EXPECT_DOUBLE_EQ(at(0), 0);
    t.wrap_s = TextureWrap::Repeat;
    EXPECT_DOUBLE_EQ(at(0), 0.5);
    EXPECT_DOUBLE_EQ(at(1), 0.5);
    t.wrap_s = TextureWrap::Mirror;
    EXPECT_DOUBLE_EQ(at(1), 1);
}

TEST(Casters, MasksHaveTheirHoles) {
    // Stripes 1 m apart over x in [-4, 4] lie over the floor.
    Scene scene = floor_and(make_quad(8, 8), {moved(0, 1, 4) * turned(-90, {1, 0, 0})});
    scene.materials[1] = {.base_colour_texture = 0, .alpha = AlphaMode::Mask, .alpha_cutoff = 0.5f};
    scene.textures.push_back(stripes(8, 1));
    const auto shares = [&](const Settings& settings = {}) {
        finalise(scene);
        const auto geometry = geometry_of(scene, settings);
        const Reference reference =
            trace_visibility(ReferenceScene(geometry), floor_points(3, 60), query_for(scene, sun({0, 1, 0})), {});
        std::size_t wrong = 0;
        for (int z = 0; z < 60; ++z)
            for (int x = 0; x < 60; ++x) {
                const bool solid = std::lround(std::floor(3 * (2 * (x + 0.5) / 60 - 1))) & 1;
                wrong += (reference.hard().at(x, z) < 0.5f) != solid;
            }
        return std::pair(lit_share(reference), wrong);
    };
    EXPECT_EQ(shares(), std::pair(0.5, std::size_t(0)));
    Material& m = scene.materials[1];
    m.alpha = AlphaMode::Opaque;
    EXPECT_EQ(shares().first, 0);
    m.alpha = AlphaMode::Blend;
    EXPECT_EQ(shares().first, 1) << "blended surfaces cast nothing";
    Settings as_mask;
    set_setting(as_mask, "caster.blend", "mask");
    EXPECT_EQ(shares(as_mask).first, 0.5);
    m.base_colour.a = 0.4f;
    EXPECT_EQ(shares(as_mask).first, 1) << "0.4 of 1 is below one half";
    m.alpha = AlphaMode::Mask;
    m.alpha_cutoff = 0.3f;
    EXPECT_EQ(shares().first, 0.5);
    scene.meshes[1].colours.assign(scene.meshes[1].positions.size(), glm::vec4(1, 1, 1, 0.5f));
    EXPECT_EQ(shares().first, 1) << "the vertices' alpha counts";
}

TEST(Casters, NonCastingObjectsBlockNoRay) {
    const Scene scene = floor_and(make_box({2, 1, 2}), {moved(0, 2, 0)});
    Settings settings;
    const auto lit = [&] {
        const auto geometry = geometry_of(scene, settings);
        EXPECT_EQ(ReferenceScene(geometry).triangle_count(), geometry->caster_triangles());
        return lit_share(
            trace_visibility(ReferenceScene(geometry), floor_points(2, 40), query_for(scene, sun({0, 1, 0})), {}));
    };
    EXPECT_NEAR(lit(), 0.75, 0.01);
    const std::uint64_t before = geometry_of(scene, settings)->key;
    set_setting(settings, "object.caster.cast", "false");
    EXPECT_EQ(lit(), 1);
    EXPECT_NE(geometry_of(scene, settings)->key, before);
}

struct CullCase {
    const char* cull;
    const char* object_cull;
    bool mirrored, from_below;
    bool casts;  ///< whether a plane casts that faces up, under a light from above
};

TEST(Casters, CulledFacesCastUnlessAsRasterised) {
    const CullCase cases[] = {{"none", "inherit", false, false, true},   {"back", "inherit", false, false, true},
                              {"front", "inherit", false, false, false}, {"front", "inherit", true, false, false},
                              {"back", "inherit", true, false, true},    {"back", "inherit", false, true, false},
                              {"front", "inherit", false, true, true},   {"front", "none", false, false, true},
                              {"none", "front", false, false, false},    {"back", "inherit", true, true, false}};
    for (const Instancing instancing : {Instancing::Never, Instancing::Always})
        for (const CullCase& c : cases) {
            glm::dmat4 place = c.from_below ? turned(180, {1, 0, 0}) : glm::dmat4(1);
            if (c.mirrored) place = place * scaled(-1, 1, 1);
            const Scene scene = floor_and(make_plane(2, 2), {moved(0, 1, 0) * place, moved(9, 9, 9) * place});
            Settings settings;
            set_setting(settings, "caster.cull", c.cull);
            set_setting(settings, "object.caster.cull", c.object_cull);
            const auto geometry = geometry_of(scene, settings);
            const ReferenceScene casters(geometry, {}, instancing);
            EXPECT_EQ(casters.instance_count(), instancing == Instancing::Always ? 2u : 0u);
            ReferenceQuery query = query_for(scene, sun({0, 1, 0}));
            query.traits = object_traits(scene, settings);
            const Receivers receivers = floor_points(0.9, 8);
            const Reference reference = trace_visibility(casters, receivers, query, {});
            query.options.as_rasterised = true;
            const Reference raster = trace_visibility(casters, receivers, query, {});
            const std::string what = std::string(c.cull) + "/" + c.object_cull + (c.mirrored ? " mirrored" : "") +
                                     (c.from_below ? " below" : "") + (casters.instance_count() ? " instanced" : "");
            EXPECT_EQ(lit_share(reference), 0) << what << ": every triangle is two-sided in truth";
            EXPECT_EQ(lit_share(raster), c.casts ? 0 : 1) << what;
            if (c.casts)
                EXPECT_NEAR(reference.nearest_m.at(3, 3), 1, 1e-5) << what;
            else
                EXPECT_TRUE(std::isnan(reference.nearest_m.at(3, 3))) << what << ": the map stores nothing there";
        }
}

TEST(Casters, MapStoresTheSurfaceNearestTheLight) {
    const Scene scene = floor_and(make_plane(2, 2), {moved(0, 1, 0), moved(0, 3, 0), moved(0, 2, 0)});
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry);
    Emitter lamp = sun({0, 1, 0});
    lamp.type = LightType::Point;
    lamp.position_ws = {0, 10, 0};
    for (const Emitter& light : {sun({0, 1, 0}), sun({0, 1, 0.1}), lamp}) {
        ReferenceQuery query = query_for(scene, light);
        const Reference reference = trace_visibility(casters, floor_points(0.5, 9), query, {});
        double distance = 0;
        const double rises = light.direction_from({0, 0, 0}, distance).y;
        EXPECT_EQ(lit_share(reference), 0);
        EXPECT_NEAR(reference.nearest_m.at(4, 4), 3 / rises, 1e-5);
    }
    // A near plane between the upper two planes hides the topmost from the map.
    LightView view;
    view.eye = {0, 10, 0};
    view.axes = orthonormal_basis({0, 1, 0});
    view.curve = {.perspective = false, .near = 7.5, .far = 11};
    ReferenceQuery query = query_for(scene, sun({0, 1, 0}));
    query.views = {view};
    EXPECT_NEAR(trace_visibility(casters, floor_points(0.5, 9), query, {}).nearest_m.at(4, 4), 2, 1e-5);
    const Reference beside = trace_visibility(casters, floor_points(8, 9), query, {});
    EXPECT_TRUE(std::isnan(beside.nearest_m.at(0, 0)));
    EXPECT_EQ(beside.hard().at(0, 0), 1);
}

Scene many_rings() {
    Random random(3);
    std::vector<glm::dmat4> places;
    for (int i = 0; i < 60; ++i) {
        const double s = random.in(0.4, 1.2);
        places.push_back(moved(random.in(-6, 6), random.in(0.5, 3), random.in(-6, 6)) *
                         turned(random.in(0, 360), random.direction()) * scaled(i % 3 ? s : -s, s, s * 0.7));
    }
    places.push_back(moved(0, 4, 0) * scaled(5, 1e-9, 5));  // too flat to be shared safely
    return floor_and(make_torus(0.6, 0.2, 24, 12), places);
}

TEST(Instances, SharedAndFlattenedScenesAgree) {
    const Scene scene = many_rings();
    const auto geometry = geometry_of(scene);
    const ReferenceScene flat(geometry, {}, Instancing::Never), shared(geometry, {}, Instancing::Always);
    EXPECT_EQ(flat.instance_count(), 0u);
    EXPECT_EQ(shared.instance_count(), 60u);
    EXPECT_EQ(flat.triangle_count(), scene.triangle_count());
    EXPECT_EQ(shared.triangle_count(), scene.triangle_count());
    const Receivers receivers = floor_points(7, 200);
    const ReferenceQuery query = query_for(scene, sun({0.4, 1, 0.2}));
    const Reference a = trace_visibility(flat, receivers, query, {}),
                    b = trace_visibility(shared, receivers, query, {});
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.hard().data.size(); ++i) differing += a.hard().data[i] != b.hard().data[i];
    EXPECT_LE(differing, 2u) << "of 40000, at edges that rounding moves";
    EXPECT_GT(lit_share(a), 0.2);
    EXPECT_LT(lit_share(a), 0.8);
}

TEST(Instances, DoNotShadowThemselves) {
    const Scene scene = floor_and(
        make_sphere(1, 24, 12), {moved(300, 2, -200) * turned(30, {1, 2, 3}) * scaled(1, 2, 0.5), moved(-1e3, 500, 0)});
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry, {}, Instancing::Always);
    ASSERT_EQ(casters.instance_count(), 2u);
    std::vector<Receiver> pixels;
    for (std::uint32_t object : {1u, 2u})
        for (std::uint32_t t = 0; t < geometry->objects[object].mesh->triangles(); ++t)
            for (const double u : {1e-6, 0.3, 0.999999}) pixels.push_back(receiver_on(*geometry, object, t, u, 0));
    Random random(2);
    std::size_t counted = 0, dark = 0;
    for (int i = 0; i < 10; ++i) {
        glm::dvec3 d = random.direction();
        d.y = std::abs(d.y);
        const Reference reference = trace_visibility(casters, row_of(pixels), query_for(scene, sun(d)), {});
        for (std::size_t k = 0; k < pixels.size(); ++k)
            if (reference.state[k] == PixelState::Counted) {
                ++counted;
                dark += reference.hard().data[k] < 0.5f;
            }
    }
    EXPECT_GT(counted, 5000u);
    EXPECT_EQ(dark, 0u);
}

TEST(Tracing, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = many_rings();
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry);
    const Receivers receivers = floor_points(6, 100);
    const ReferenceQuery query = query_for(scene, sun({0.4, 1, 0.2}, 3), {.area = true, .samples = 256});
    const Reference one = trace_visibility(casters, receivers, query, {.threads = 1});
    EXPECT_GT(one.partial, 300u);
    for (const int threads : {2, 7}) {
        const Reference many = trace_visibility(casters, receivers, query, {.threads = threads});
        EXPECT_EQ(one.visibility.data, many.visibility.data);
        EXPECT_EQ(one.pixels, many.pixels);
        EXPECT_EQ(one.rays, many.rays);
        EXPECT_EQ(one.noise, many.noise);
        EXPECT_EQ(one.partial, many.partial);
    }
}

TEST(Tracing, PixelsAppearWhileTheyAreTraced) {
    const Scene scene = many_rings();
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry);
    const Receivers receivers = floor_points(6, 160);
    const ReferenceQuery query = query_for(scene, sun({0.4, 1, 0.2}), {});
    TracedSoFar so_far;
    const TileDone add = [&](const Reference& part, glm::ivec2 first, glm::ivec2 end) {
        so_far.add_tile(part, first, end);
    };
    EXPECT_TRUE(so_far.picture().data.empty());
    EXPECT_EQ(so_far.share(), 0);
    std::stop_source stop;
    Workers workers{.threads = 1, .stop = stop.get_token()};
    workers.progress = [&](double t) {
        if (t > 0.5) stop.request_stop();
    };
    EXPECT_THROW(trace_visibility(casters, receivers, query, workers, add), Cancelled);
    EXPECT_GT(so_far.share(), 0.3);
    EXPECT_LT(so_far.share(), 1) << "what was traced before the stop stays";
    const ByteImage part = so_far.picture();
    const auto shown = [](const ByteImage& image) {
        std::size_t count = 0;
        for (std::size_t i = 3; i < image.data.size(); i += 4) count += image.data[i] > 0;
        return double(count) / double(image.data.size() / 4);
    };
    EXPECT_NEAR(shown(part), so_far.share(), 1e-9);

    const Reference whole = trace_visibility(casters, receivers, query, {.threads = 2}, add);
    EXPECT_EQ(so_far.share(), 1);
    const ByteImage all = so_far.picture();
    ASSERT_EQ(all.data.size(), 4 * whole.visibility.data.size());
    std::size_t dark = 0;
    for (std::size_t i = 0; i < whole.visibility.data.size(); ++i) {
        const bool is_dark = whole.visibility.data[i] < 0.5f;
        dark += is_dark;
        EXPECT_EQ(all.data[4 * i] < 128, is_dark) << "dark blue in shadow, yellow in light";
    }
    EXPECT_GT(dark, 100u);
}

TEST(Tracing, StopsWithinATile) {
    const Scene scene = many_rings();
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry);
    const Receivers receivers = floor_points(6, 64);
    // More rays in one tile than any machine traces before the request.
    const ReferenceQuery query =
        query_for(scene, sun({0.4, 1, 0.2}, 20), {.area = true, .samples = 1 << 20, .noise = 0});
    constexpr int kTiles = 16;  // of the rays to the light's centre
    std::atomic<int> tiles = 0;
    std::stop_source stop;
    std::jthread request([&](const std::stop_token& end) {
        while (tiles < kTiles && !end.stop_requested()) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        stop.request_stop();
    });
    const TileDone count = [&](const Reference&, glm::ivec2, glm::ivec2) { ++tiles; };
    EXPECT_THROW(trace_visibility(casters, receivers, query, {.threads = 1, .stop = stop.get_token()}, count),
                 Cancelled);
    EXPECT_EQ(tiles, kTiles);
}

TEST(Tracing, StopsOnRequestAndReportsProgress) {
    const Scene scene = many_rings();
    const auto geometry = geometry_of(scene);
    const ReferenceScene casters(geometry);
    const Receivers receivers = floor_points(6, 320);
    const ReferenceQuery query = query_for(scene, sun({0.4, 1, 0.2}, 3), {.area = true});
    std::stop_source stop;
    double last = 0;
    Workers workers{.threads = 2, .stop = stop.get_token()};
    workers.progress = [&](double t) {
        EXPECT_GE(t, last);
        last = t;
        if (t > 0.2) stop.request_stop();
    };
    EXPECT_THROW(trace_visibility(casters, receivers, query, workers), Cancelled);
    EXPECT_GT(last, 0.2);
    EXPECT_LT(last, 0.9) << "it went on";
    EXPECT_THROW(ReferenceScene(geometry, workers), Cancelled);
    last = 0;
    workers = {.progress = [&](double t) { last = t; }};
    trace_visibility(casters, receivers, query_for(scene, sun({0.4, 1, 0.2})), workers);
    EXPECT_EQ(last, 1);
}

TEST(Tracing, OutlivesItsScene) {
    auto scene = std::make_unique<Scene>(many_rings());
    const auto geometry = geometry_of(*scene);
    const ReferenceQuery query = query_for(*scene, sun({0.4, 1, 0.2}));
    const Reference before = trace_visibility(ReferenceScene(geometry), floor_points(6, 64), query, {});
    scene.reset();
    EXPECT_EQ(trace_visibility(ReferenceScene(geometry), floor_points(6, 64), query, {}).hard().data,
              before.hard().data);
}

TEST(Workers, RethrowExceptions) {
    EXPECT_THROW(parallel_for_blocks(100, {.threads = 3},
                                     [](std::size_t i) {
                                         if (i == 40) throw Error("no");
                                     }),
                 Error);
    std::atomic<int> sum{0};
    parallel_for_blocks(100, {.threads = 5}, [&](std::size_t i) { sum += int(i); });
    EXPECT_EQ(sum, 4950);
    parallel_for_blocks(0, {}, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace si
