#include "tests/support/hard_case.h"

#include <cmath>
#include <optional>

#include "app/context/headless_context.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "tests/support/box_scene.h"
#include "tests/support/requested_driver.h"
#include "tests/support/sets.h"

namespace si::test {
namespace {

/// Fails for values outside [0, most] or NaN, and names the first.
testing::AssertionResult all_within(const FloatImage& image, float most, const char* what) {
    std::size_t bad = 0, first = 0;
    for (std::size_t i = 0; i < image.data.size(); ++i)
        if (!(image.data[i] >= 0 && image.data[i] <= most) && bad++ == 0) first = i;  // NaN fails both
    if (bad == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << what << ": " << bad << " values outside of [0,1] or NaN, the first is "
                                       << image.data[first] << " = 1 + " << image.data[first] - 1 << " at "
                                       << first % std::size_t(image.width) << ", " << first / std::size_t(image.width);
}

// The mean of up to a hundred weighted comparisons rounds: a few float steps above 1 are accepted.
constexpr float kMaxVisibility = 1 + 0x1p-21f;

int overlay_row(std::string_view key) {
    for (std::size_t i = 0; i < overlays().size(); ++i)
        if (overlays()[i].key == key) return int(i) + 1;
    ADD_FAILURE() << "no overlay " << key;
    return 0;
}

void expect_finite(const FrameResult& frame) {
    const auto finite = [](const glm::dmat4& m) {
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                if (!std::isfinite(float(m[i][j]))) return false;
        return true;
    };
    EXPECT_TRUE(finite(frame.camera.clip_from_relative(frame.camera.origin()))) << "camera matrix";
    for (const FittedLight& light : frame.lights)
        for (const LightView& view : light.views) {
            EXPECT_TRUE(finite(view.clip_from_relative(frame.camera.origin()))) << "light matrix";
            EXPECT_LT(view.curve.near, view.curve.far);
        }
}

}  // namespace

Renderer& hard_renderer() {
    // Static objects and exit handlers would end too late: parts of the driver may be gone, while its threads still
    // draw.
    struct Shared : testing::EmptyTestEventListener {
        std::optional<HeadlessContext> context{std::in_place};
        std::optional<Renderer> renderer{std::in_place};
        void OnTestProgramEnd(const testing::UnitTest&) override {
            context->make_current();
            renderer.reset();
            context.reset();
        }
    };
    static Shared* shared = nullptr;
    // the test framework owns it
    if (!shared) testing::UnitTest::GetInstance()->listeners().Append(shared = new Shared);
    shared->context->make_current();
    expect_requested_driver();
    return *shared->renderer;
}

Shot draw_shot(const Scene& scene, const Settings& settings, int width, int height) {
    Renderer& renderer = hard_renderer();
    Shot shot;
    shot.width = width;
    shot.height = height;
    ReferenceCache cache;
    FrameRequest request;
    request.width = width;
    request.height = height;
    request.outputs = {.colour = false, .shadow_map = true, .visibility = true, .overlay = true};
    Settings s = settings;
    s.view.overlay = overlay_row("non-finite");
    s.view.overlay_opacity = 0;
    shot.frame = render_with_reference(renderer, scene, s, request, cache);
    expect_finite(shot.frame);
    if (shot.frame.visibility.texture) shot.visibility = renderer.read_float(shot.frame.visibility, 1);
    EXPECT_EQ(shot.visibility.data.size(), std::size_t(width) * std::size_t(height));
    EXPECT_TRUE(all_within(shot.visibility, kMaxVisibility, "visibility"));
    const std::size_t light = std::size_t(std::max(s.view.light, 0));
    if (light < shot.frame.lights.size() && shot.frame.lights[light].casts)
        for (std::size_t face = 0; face < shot.frame.lights[light].views.size(); ++face) {
            shot.maps.push_back(renderer.read_shadow_map(shot.frame, int(light), int(face)));
            EXPECT_TRUE(all_within(shot.maps.back(), 1, "map")) << "face " << face;
        }
    if (shot.frame.overlay.texture) {
        const FloatImage broken = renderer.read_float(shot.frame.overlay, 4);
        int count = 0;
        for (std::size_t i = 3; i < broken.data.size(); i += 4) count += !(broken.data[i] == 0);
        EXPECT_EQ(count, 0) << "fragments under the NaN overlay";
    }
    for (const std::string& message : renderer.take_gl_messages()) ADD_FAILURE() << "driver: " << message;
    return shot;
}

BiasBreakdown breakdown_at(const FrameResult& frame, const Settings& settings, const RasterTraits& driver,
                           const glm::dvec3& point_ws, const glm::dvec3& normal) {
    return bias_breakdown(frame.lights.at(0), settings, frame.map_size,
                          {point_ws, normal, normal, frame.camera.origin()}, driver);
}

double differing_share(const Shot& a, const Shot& b, double tolerance) {
    EXPECT_EQ(a.visibility.data.size(), b.visibility.data.size());
    if (a.visibility.data.size() != b.visibility.data.size() || a.visibility.data.empty()) return 1;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.visibility.data.size(); ++i)
        differing += std::abs(a.visibility.data[i] - b.visibility.data[i]) > tolerance;
    return double(differing) / double(a.visibility.data.size());
}

double shadow_share(const Shot& shot) {
    std::size_t dark = 0;
    for (float v : shot.visibility.data) dark += v < 0.5f;
    return shot.visibility.data.empty() ? 0 : double(dark) / double(shot.visibility.data.size());
}

ReferenceErrors compare_with_reference(const Shot& shot, const Scene& scene, double reach_texels) {
    const RayReference rays(scene);
    EXPECT_EQ(rays.triangle_count(), scene.triangle_count()) << "reference and picture have different scenes";
    const ReferenceImage reference = trace_reference(rays, shot, reach_texels);
    ReferenceErrors e;
    for (int y = 0; y < shot.height; ++y)
        for (int x = 0; x < shot.width; ++x) {
            const ReferenceState lit = reference.state_at(x, y);
            if (lit == ReferenceState::Nothing || lit == ReferenceState::Away) continue;
            ++e.domain;
            const float v = shot.visibility.at(x, y);
            if (lit == ReferenceState::Shadow) {
                ++e.shadow;
                e.false_light += v >= 0.5f;
                e.any_leak += v > 1e-3f;
            }
            if (lit == ReferenceState::Lit) {
                e.false_shadow += v < 0.5f;
                e.any_acne += v < 1 - 1e-3f;
            }
            if (lit == ReferenceState::Boundary) ++e.boundary;
        }
    return e;
}

int kernel_row(std::string_view key) {
    for (std::size_t i = 0; i < filters().size(); ++i)
        if (filters()[i].key == key) return int(i);
    ADD_FAILURE() << "no kernel " << key;
    return 0;
}

Scene floor_and_box(double size, const glm::dvec3& box, double gap) {
    return grey_scene({{"floor", make_plane(size, size)}, {"box", make_box(box), moved(0, 0.5 * box.y + gap, 0)}});
}

Scene sheet_over_floor(double height_m) {
    return grey_scene({{"floor", make_plane(10, 10)}, {"sheet", make_plane(3, 3), moved(0, height_m, 0)}});
}

std::string light_name(LightType type) {
    const char* names[] = {"directional", "spot", "point"};
    return names[int(type)];
}

std::string identifier(std::string_view key) {
    std::string name(key);
    std::ranges::replace(name, '-', '_');
    return name;
}

std::string format_name(MapFormat format) {
    const char* names[] = {"d16", "d24", "d32f", "colour", "linear", "linear16"};
    return names[int(format)];
}

Settings hard_settings() {
    return settings_with({}, {"map.resolution=512", "light.azimuth=30", "light.elevation=40", "camera.source=manual",
                              "camera.azimuth=-20", "camera.elevation=55", "camera.distance=9", "camera.target_y=0.5"});
}

Settings texel_settings(std::string_view filter, int resolution, double constant_texels) {
    Settings s = hard_settings();
    s.lights[0].fit = LightFit::Scene;
    s.map.resolution = resolution;
    set_setting(s, "filter.kernel", filter);
    s.bias = no_bias();
    s.bias.unit = BiasUnit::Texels;
    s.bias.constant = constant_texels;
    return s;
}

Scene wall_on_plane() {
    return grey_scene({{"floor", make_plane(20, 20)}, {"wall", make_box({6, 2, 0.3}), moved(0, 1, 0)}});
}

Settings low_sun_settings(std::string_view filter, int resolution, double constant_texels) {
    return settings_with(
        texel_settings(filter, resolution, constant_texels),
        {"light.azimuth=0", "light.elevation=15", "camera.distance=18", "camera.elevation=35", "camera.azimuth=150"});
}

void move_scene(Scene& scene, const glm::dvec3& by) {
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local[3] += glm::dvec4(by, 0);
    for (SceneCamera& camera : scene.cameras) camera.world[3] += glm::dvec4(by, 0);
    finalise(scene);
}

void move_camera(Settings& settings, const glm::dvec3& by) {
    settings.camera.target_x += by.x;
    settings.camera.target_y += by.y;
    settings.camera.target_z += by.z;
}

void place_light(Settings& settings, LightType type, const Place& place) {
    LightSettings& light = settings.lights[0];
    light.type = type;
    light.azimuth = place.azimuth;
    light.elevation = place.elevation;
    light.distance = type == LightType::Directional ? 0 : 9;
    light.cone = 80;
    move_camera(settings, place.at);
}

Scene floor_under_sheet(const Place& place) {
    Scene scene = grey_scene({{"floor", make_plane(10, 10)}, {"cover", make_plane(4, 4), moved(0, 2.25, 0)}});
    move_scene(scene, place.at);
    return scene;
}

BiasSettings no_bias() {
    BiasSettings b = slope_settings().bias;
    b.unit = BiasUnit::Depth;
    b.constant = b.slope = b.normal = b.raster_slope = b.raster_units = b.raster_clamp = 0;
    return b;
}

}  // namespace si::test
