#include "renderer/scenes/hard_cases.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/bundle/builtin_bundles.h"
#include "renderer/scenes/shapes.h"
#include "renderer/scenes/stage_materials.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

// Makers of the scenes. Positions and sizes are short sums of powers of two, and no node rotates. Translations by such
// sums and scales by powers of two are therefore exact.

constexpr double kFov = 45;
const glm::dvec3 kEye(-2.5, 7, 6.5), kTarget(0, 0.5, 0);

/// Makes a scene with an empty root node, a floor, and a camera that looks at the floor's centre.
Scene on_floor(double size = 10, const glm::dvec3& eye = kEye, const glm::dvec3& target = kTarget,
               const glm::dmat4& placed = glm::dmat4(1)) {
    Scene scene;
    const int root = add_node(scene, "Case", -1, placed);
    Mesh floor = make_plane(size, size);
    for (glm::vec2& uv : floor.uv.edit()) uv /= kPavingSide_m;
    add_shape(scene, "Floor", root, std::move(floor), add_paving(scene));
    add_camera(scene, glm::dvec3(placed * glm::dvec4(eye, 1)), glm::dvec3(placed * glm::dvec4(target, 1)), kFov);
    return scene;
}

/// A mesh below the root node of its scene, with the next material of kBodyMaterials.
struct Body {
    const char* name;
    Mesh mesh;
    glm::dmat4 local;
};

constexpr const PlainMaterial* kBodyMaterials[] = {&kSlate, &kPorcelain, &kPlaster, &kHeather, &kBrass};

/// Adds bodies to a scene and completes it.
Scene with_bodies(Scene scene, std::initializer_list<Body> bodies) {
    std::size_t used = 0;
    for (const Body& body : bodies) {
        const PlainMaterial& material = *kBodyMaterials[used++ % std::size(kBodyMaterials)];
        add_shape(scene, body.name, 0, body.mesh, add_material(scene, material), body.local);
    }
    return finished(std::move(scene));
}

Scene box_under(const glm::dmat4& placed) {
    return with_bodies(on_floor(10, kEye, kTarget, placed), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)},
                                                             {"Ball", make_sphere(0.625, 24, 12), moved(-2, 1.5, 1)}});
}

Mesh box_turned(const glm::dvec3& size, double degrees, const glm::dvec3& axis = {0, 1, 0}) {
    return transformed(make_box(size), turned(degrees, axis));
}

/// Makes a box that floats a little above a floor.
Scene hard_floor_and_box() {
    return box_under(glm::dmat4(1));
}

/// Makes a fine sphere over a floor.
Scene hard_sphere() {
    return with_bodies(on_floor(6, {3.5, 2.5, 2.5}, {0, 1, 0}),
                       {{"Sphere", make_sphere(1, 96, 48), moved(0, 1.25, 0)}});
}

/// Makes a floor with a box, seen from above.
Scene hard_spot_floor() {
    return with_bodies(on_floor(10, {-2, 10, 4}, {0, 0, 0}), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)}});
}

/// Makes a thin plate over a floor: no side of it under a light straight above.
Scene hard_plate_above() {
    return with_bodies(on_floor(), {{"Plate", make_plane(3, 3), moved(0, 1, 0)}});
}

/// Makes a wall on a wide floor.
Scene hard_wall() {
    return with_bodies(on_floor(20, {-6, 22, 8}, {0, 0, 0}), {{"Wall", make_box({3, 3, 0.25}), moved(0, 1.5, -4)}});
}

/// Makes hard_floor_and_box() below a node 1,000 km off.
Scene hard_far_away() {
    return box_under(moved(1048576, -524288, 1048576));
}

/// Makes hard_floor_and_box() below a node of scale 1/100.
Scene hard_tiny() {
    return box_under(scaled(0.01, 0.01, 0.01));
}

/// Makes boxes in rows.
Scene hard_field() {
    Scene scene = on_floor(24, {-5, 5, 9}, {0, 0.5, 0});
    const int box = add_mesh(scene, "Box", box_turned({1, 1.5, 1}, 20), 0);
    for (int x = -2; x <= 2; ++x)
        for (int z = -2; z <= 2; ++z) add_object(scene, "Box", 0, box, moved(3 * x, 0.75, 3 * z));
    return finished(std::move(scene));
}

/// Makes a box some of whose triangles have no area.
Scene hard_degenerate() {
    Scene scene = on_floor();
    Mesh box = make_box({1.5, 1, 2});
    const auto first = std::uint32_t(box.positions.size());
    for (const glm::vec3& p : {glm::vec3(0), {0.5f, 0.375f, 0.75f}, {-0.75f, 0.25f, 1}, {0.25f, 0.1875f, 0.375f}}) {
        box.positions.push_back(p);
        if (!box.normals.empty()) box.normals.push_back({0, 1, 0});
        if (!box.uv.empty()) box.uv.push_back({0, 0});
    }
    // A point, lines, and three points of one line.
    for (const std::uint32_t i : {0u, 0u, 0u, 1u, 1u, 2u, 2u, 1u, 2u, 0u, 3u, 1u}) box.indices.push_back(first + i);
    return with_bodies(std::move(scene), {{"Box", std::move(box), moved(0, 0.75, 0)}});
}

/// Makes a turned box below a node of uneven scale.
Scene hard_stretched() {
    Scene scene = on_floor(10, {-1, 6, 7}, {0, 0.5, 0});
    const int root = add_node(scene, "Stretched", 0, moved(0, 0.75, 0) * scaled(4, 0.5, 1));
    add_shape(scene, "Box", root, box_turned({1, 1, 1}, 30), add_material(scene, kSlate));
    return finished(std::move(scene));
}

/// Makes a box and a single-sided plate below a node that mirrors x.
Scene hard_mirrored() {
    return with_bodies(box_under(scaled(-1, 1, 1)), {{"Plate", make_plane(3, 2), moved(2, 2, -1.5)}});
}

/// Makes three boxes, two flattened by a scale of 0 to a plate and a point.
Scene hard_flattened() {
    Scene scene = box_under(glm::dmat4(1));
    const int box = add_mesh(scene, "Cube", make_box({1, 1, 1}), 0);
    add_object(scene, "Plate", 0, box, moved(2, 1, 1) * scaled(1, 0, 1));
    add_object(scene, "Point", 0, box, moved(1, 2, 1) * scaled(0, 0, 0));
    return finished(std::move(scene));
}

/// Makes a plate 1/64 m above a floor: hardly any depth.
Scene hard_plate_on_floor() {
    return with_bodies(on_floor(10, {-2, 5, 4}, {0, 0, 0}), {{"Plate", make_plane(2, 2), moved(0, 1.0 / 64, 0)}});
}

/// Makes wires of 1/128 m over a floor.
Scene hard_wires() {
    Scene scene = on_floor(8, {-1.5, 3.5, 3}, {0, 0, 0});
    for (int i = -4; i <= 4; ++i)
        add_shape(scene, "Wire", 0, box_turned({1.0 / 128, 1.0 / 128, 4}, 10), 0, moved(0.375 * i, 0.75, 0));
    return with_bodies(std::move(scene), {{"Bar", box_turned({3.5, 0.125, 0.125}, 10), moved(0, 0.75, -1.75)}});
}

/// Makes a slope that fills the map, and a bar over it.
Scene hard_slope() {
    return with_bodies(on_floor(2, {0, 9, 9}, {0, 1.5, 0}),
                       {{"Slope", transformed(make_plane(10, 10), turned(20, {1, 0, 0})), moved(0, 2, 0)},
                        {"Bar", make_box({4, 0.25, 0.25}), moved(0, 3.5, 1)}});
}

/// Makes covers at two heights.
Scene hard_two_covers() {
    return with_bodies(on_floor(10, {-2, 6, 7}, {0.5, 0, 0}), {{"High cover", make_plane(2, 4), moved(-1, 3, 0)},
                                                               {"Low cover", make_plane(4, 2), moved(0, 1, 0.5)}});
}

/// Makes steps about a pixel high and wide.
Scene hard_stairs() {
    Scene scene = on_floor(6, {-1, 5, 5.5}, {0, 1, 0});
    Mesh stairs;
    stairs.name = "Stairs";
    constexpr int kSteps = 40;
    constexpr double kStep = 1.0 / 16;
    for (int i = 0; i < kSteps; ++i) {
        Mesh tread = transformed(make_plane(4, kStep), moved(0, kStep * (i + 1), -kStep * (i + 0.5)));
        Mesh riser = transformed(make_quad(4, kStep), moved(0, kStep * i, -kStep * i));
        tread.uv.clear();
        riser.uv.clear();
        if (i == 0)
            stairs = std::move(tread);
        else
            append(stairs, tread);
        append(stairs, riser);
    }
    return with_bodies(std::move(scene), {{"Stairs", std::move(stairs), moved(0, 0, 1.25)}});
}

/// Makes ground of strips that rise and fall by 1 in 32, with a box on it.
Scene hard_bent_ground() {
    constexpr int kStrips = 16;
    constexpr float kStrip = 0.5f, kRise = kStrip / 32, kHalf = 4;
    Mesh ground;
    ground.name = "Ground";
    for (int i = 0; i < kStrips; ++i) {
        const auto first = std::uint32_t(ground.positions.size());
        for (int side = 0; side < 2; ++side) {
            const float z = kStrip * float(i + side) - kHalf, y = (i + side) % 2 ? kRise : 0;
            ground.positions.push_back({-kHalf, y, z});
            ground.positions.push_back({kHalf, y, z});
        }
        for (const std::uint32_t corner : {0u, 2u, 1u, 1u, 2u, 3u}) ground.indices.push_back(first + corner);
    }
    return with_bodies(on_floor(8, {-2, 5, 5}, {0, 0, 0}), {{"Ground", std::move(ground), moved(0, 0.0625, 0)},
                                                            {"Box", make_box({1, 0.5, 1}), moved(0, 0.3125, 0)}});
}

/// Makes a bar that crosses the sides of a small map.
Scene hard_bar() {
    return with_bodies(on_floor(10, {-2, 12, 4}, {0, 0, 0}), {{"Bar", make_box({6, 1, 0.5}), moved(0, 0.75, 0)}});
}

/// Makes a floor, a sheet, a post and a beam about a lamp.
Scene hard_lamp() {
    return with_bodies(on_floor(16, {-3, 10, 5}, {0, 0, 0}),
                       {{"Sheet", make_plane(2.5, 5), moved(2, 1, 0.25)},
                        {"Post", make_box({0.5, 2, 0.5}), moved(-2, 1, 2)},
                        {"Beam", make_box({0.5, 0.5, 5}), moved(-2.5, 1.25, -1.5)}});
}

/// Makes a floor under a long sheet that is far above.
Scene hard_high_sheet() {
    // One long triangle: clamping a vertex to the near plane would bend it.
    Mesh sheet;
    sheet.name = "Sheet";
    sheet.positions = {{-1.5f, 30, -1.5f}, {1.5f, 2, 3}, {2.5f, 30, -1.5f}};
    sheet.indices = {0, 1, 2};
    return with_bodies(on_floor(), {{"Sheet", std::move(sheet), glm::dmat4(1)}});
}

/// Makes a sheet with holes of alpha.
Scene hard_blended_sheet() {
    Scene scene = on_floor();
    Texture holes{.name = "Holes",
                  .width = 4,
                  .height = 4,
                  .wrap_s = TextureWrap::Clamp,
                  .wrap_t = TextureWrap::Clamp,
                  .nearest_mag = true,
                  .nearest_min = true,
                  .mipmaps = false};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) holes.rgba.append({220, 220, 220, std::uint8_t((x + y) % 2 ? 0 : 255)});
    scene.textures.push_back(std::move(holes));
    for (const AlphaMode alpha : {AlphaMode::Mask, AlphaMode::Blend}) {
        const bool mask = alpha == AlphaMode::Mask;
        const int material = add_material(scene, mask ? "Mask" : "Blend", glm::vec3(0.8f));
        scene.materials[std::size_t(material)].base_colour_texture = int(scene.textures.size()) - 1;
        scene.materials[std::size_t(material)].alpha = alpha;
        scene.materials[std::size_t(material)].double_sided = true;
        Mesh sheet = make_plane(3, 4);
        sheet.uv.clear();
        for (const glm::vec3& p : sheet.positions) sheet.uv.emplace_back(p.x / 3 + 0.5f, p.z / 4 + 0.5f);
        const char* name = mask ? "Mask" : "Blend";
        add_shape(scene, name, 0, std::move(sheet), material, moved(mask ? -1.75 : 1.75, 1, 0));
    }
    return finished(std::move(scene));
}

/// Makes a box, and a mesh with a vertex that is no number.
Scene hard_not_finite() {
    Mesh broken = make_box({1, 1, 1});
    broken.positions.edit()[0].x = std::numeric_limits<float>::quiet_NaN();
    broken.positions.edit()[1].y = std::numeric_limits<float>::infinity();
    return with_bodies(
        on_floor(), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)}, {"Broken", std::move(broken), moved(2, 1, 0)}});
}

/// Makes a plate of more than 65,536 vertices.
Scene hard_many_vertices() {
    return with_bodies(on_floor(), {{"Plate", make_plane(4, 3, 260, 260), moved(0, 1.5, 0)}});
}

/// Makes a ball of few facets with smooth normals.
Scene hard_low_polygon() {
    return with_bodies(on_floor(6, {3.5, 2.5, 2.5}, {0, 1, 0}), {{"Ball", make_sphere(1, 10, 6), moved(0, 1.25, 0)}});
}

/// Makes convex bodies apart from each other.
Scene hard_convex_bodies() {
    return with_bodies(on_floor(10, {-2.5, 6, 6.5}, {0, 0.5, 0}),
                       {{"Ball", make_sphere(0.75, 32, 16), moved(-2, 1, 0)},
                        {"Box", box_turned({1, 1, 1}, 25, glm::normalize(glm::dvec3(1, 2, 1))), moved(0, 1.25, 0)},
                        {"Cone", make_cylinder(0.75, 1.5, 24, 0.25), moved(2, 0.25, 0)}});
}

/// Makes bars far above a cover that is close to the floor, seen from beneath the cover.
Scene hard_bars_over_cover() {
    Scene scene = on_floor(10, {0, 0.1875, 3.75}, {0, 0, 0});
    for (int i = -3; i <= 3; ++i) add_shape(scene, "Bar", 0, make_plane(0.5, 8), 0, moved(i, 4, 0));
    return with_bodies(std::move(scene), {{"Cover", make_plane(8, 8), moved(0, 0.25, 0)}});
}

/// Makes a smooth hill whose positions are steps of 1/32 m, as 8 bits over 8 m store them. Its normals are exact.
Scene hard_quantised() {
    constexpr double kStep = 1.0 / 32;
    Mesh hill = make_plane(8, 8, 48, 48);
    hill.uv.clear();
    std::vector<glm::vec3>&positions = hill.positions.edit(), &normals = hill.normals.edit();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3 p(positions[i]);
        const double height = 0.25 * std::exp(-0.25 * (p.x * p.x + p.z * p.z));
        normals[i] = glm::vec3(glm::normalize(glm::dvec3(0.5 * p.x * height, 1, 0.5 * p.z * height)));
        positions[i] = glm::vec3(kStep * glm::round(glm::dvec3(p.x, height, p.z) / kStep));
    }
    return with_bodies(on_floor(8, {-2, 5, 5}, {0, 0, 0}), {{"Hill", std::move(hill), moved(0, 0.0625, 0)},
                                                            {"Box", make_box({1, 0.5, 1}), moved(2.5, 0.75, 0)}});
}

/// Makes hard_floor_and_box() with a triangle below the floor, one of whose vertices is 1,000 km off.
Scene hard_stray_vertex() {
    Scene scene = box_under(glm::dmat4(1));
    Mesh stray;
    stray.name = "Stray";
    stray.positions = {{0, 0, 0}, {1.0f / 1024, 0, 0}, {0, 0, 1048576}};
    stray.indices = {0, 1, 2};
    add_shape(scene, "Stray", 0, std::move(stray), 0, moved(0, -1, 0));
    return finished(std::move(scene));
}

/// Makes hard_floor_and_box() at 1/1024 of its size: a model in kilometres that was read as metres.
Scene hard_kilometres() {
    constexpr double kScale = 1.0 / 1024;
    return with_bodies(on_floor(kScale * 10, kScale * kEye, kScale * kTarget),
                       {{"Box", make_box(kScale * glm::dvec3(1.5, 1, 2)), moved(0, kScale * 0.75, 0)},
                        {"Ball", make_sphere(kScale * 0.625, 24, 12), moved(kScale * -2, kScale * 1.5, kScale)}});
}

/// Makes the scene of the built-in bundles below a node at a place.
Scene given_scene(const glm::dmat4& placed) {
    Scene scene = on_floor(kGivenFloorSide, kEye, kTarget, placed);
    const int slate = add_material(scene, kSlate);
    for (const GivenBody& body : kGivenBodies) {
        const glm::dvec3 middle = 0.5 * (body.lo + body.hi);
        add_shape(scene, "Box", 0, make_box(body.hi - body.lo), slate, moved(middle.x, middle.y, middle.z));
    }
    return finished(std::move(scene));
}

/// Makes the scene whose maps an engine gives: boxes over a floor.
Scene hard_given() {
    return given_scene(glm::dmat4(1));
}

/// Makes hard_given() below a node 6,000 km off.
Scene hard_given_far_away() {
    return given_scene(moved(kGivenFarPlace.x, kGivenFarPlace.y, kGivenFarPlace.z));
}

constexpr std::string_view kPixels = "share of pixels", kCount = "pixels";

// Reasons of limits that several rows share.
constexpr std::string_view kExact =
    "nothing on this plane is in shadow, and the bias is the theory's upper bound: one dark pixel refutes it";
constexpr std::string_view kTwin =
    "the two differ by rounding alone, which moves texels' middles across an edge on at most 1 pixel in 2000";

constexpr HardCase kCases[] = {
    {1, "grazing", "Grazing light",
     "The flatter the light meets a surface, the more depth one texel spans. A bias that suits steep light therefore "
     "leaves stripes of acne.",
     "Each pixel gets the bias that its plane needs under this kernel and map, by a closed form (bias.kind=adaptive).",
     "lit pixels of a plane darker than lit, at the predicted least bias, 0 to 89.5 degrees", 0, kPixels, kExact,
     "share of the plane that shadows itself without bias", 0.45, hard_floor_and_box,
     "map.resolution=512 light.elevation=6 light.fit=scene filter.kernel=hard", "bias.kind=constant bias.constant=1",
     "bias.kind=adaptive"},
    {2, "terminator", "Where light ends on a ball",
     "Towards the terminator, the slope of the surface against the light grows without bound, and so does the needed "
     "bias.",
     "A normal offset stays bounded at any angle. Faces turned away from the light are dark without a look-up in the "
     "map.",
     "light lost on a ball, weighted by N·L", 1.0 / 255, "of the light", "less than one step of an 8-bit picture",
     "the same without bias", 1.0 / 255, hard_sphere,
     "map.resolution=512 light.azimuth=-40 light.elevation=30 filter.kernel=hard bias.kind=constant", "bias.normal=0",
     "bias.normal=3"},
    {3, "depth-steps", "Steps of depth",
     "Perspective depth has its finest steps near the light. With 16 bits and planes at 3 cm and 32 m, one step "
     "at 20 m from the light is 20 cm high.",
     "Add the step of the depth format to the bias, or use 32-bit floats and reversed depth, whose steps are "
     "micrometres high.",
     "lit pixels of a plane darker than lit, at the predicted least bias, far/near 10 to 100,000", 0, kPixels, kExact,
     "share of the plane that shadows itself without bias, where steps are small", 0.3, hard_spot_floor,
     "map.resolution=512 light.type=spot light.cone=60 light.elevation=75 light.distance=20 light.fit=manual "
     "light.near=0.032 light.far=32 bias.kind=constant bias.constant=2 filter.kernel=hard",
     "map.format=d16", "map.format=d32f map.reversed_z=true"},
    {4, "reversed-depth", "Reversed depth",
     "With a far plane 100,000 times as far as the near plane, 32-bit floats are coarse far from the light. Reversed "
     "depth with one wrong sign makes everything dark.",
     "Clear value, depth comparison, linearisation and sign of the bias all follow from one convention of the "
     "projection.",
     "pixels that differ from the picture of standard depth", 5e-4, kPixels, kTwin,
     "share of pixels in shadow, all of which a wrong sign would turn", 0.01, hard_spot_floor,
     "map.resolution=512 light.type=spot light.cone=60 light.elevation=75 light.distance=20 light.fit=manual "
     "light.near=0.00032 light.far=32 bias.kind=constant bias.constant=0.5 filter.kernel=hard map.format=d32f",
     "map.reversed_z=false", "map.reversed_z=true"},
    {5, "polygon-offset", "Polygon offset",
     "The depth shift by one unit of glPolygonOffset depends on driver and format. The shift by its slope factor "
     "depends on the driver.",
     "The program measures both shifts on the driver at start. The depth biases that it computes use the measured "
     "values.",
     "lit pixels of a plane darker than lit, at the polygon offset that it needs by the measured values", 0, kPixels,
     kExact, "share of the plane that shadows itself without offset", 0.4, hard_floor_and_box,
     "map.resolution=512 light.elevation=40 light.fit=scene bias.kind=constant filter.kernel=hard "
     "map.format=d24",
     "bias.raster_slope=0", "bias.raster_slope=2 bias.raster_units=2000"},
    {6, "light-above", "Light straight above",
     "Axes from a cross product of the light direction with \"up\" are 0/0 when the light comes exactly from above. "
     "The shadow is then gone.",
     "The axes are computed without a branch (Duff et al. 2017), from sines and cosines that are exact at right "
     "angles.",
     "pixels that change as the light leaves the vertical by 0.0001 rad", 1e-3, kPixels,
     "0.0001 rad moves the shadow of a plate 1 m up by 0.1 mm: only pixels on its edge may change",
     "share of pixels in shadow", 0.01, hard_plate_above, "map.resolution=512 light.elevation=90 light.azimuth=90", "",
     ""},
    {7, "light-inside", "Light inside a body",
     "A lamp within the geometry would need a near plane at or behind the lamp. The projection would then divide by "
     "0.",
     "The near plane stays in front of the lamp, at a share of the far plane's distance. Casters that this near plane "
     "cuts off are counted and named.",
     "near planes that are not before their lamp", 0, "maps", "depth has no meaning otherwise",
     "casters that reach behind the near plane", 1, hard_floor_and_box,
     "map.resolution=256 light.type=point light.elevation=90 light.distance=0.25", "", ""},
    {8, "behind-spot", "Behind a spot light",
     "Behind a spot light the clip coordinate w is negative. After a division by w, the map appears mirrored on "
     "objects there.",
     "Points with w at or below 0 count as behind the light, which is decided before the division.",
     "lit pixels behind the lamp that are darkened", 0, kCount, "the lamp's map says nothing of them",
     "pixels that would read a nearer depth there without the guard", 50, hard_wall,
     "map.resolution=512 light.type=spot light.azimuth=0 light.elevation=2 light.cone=100 light.distance=1.5", "", ""},
    {9, "spot-angle", "Spot angles without sense",
     "The tangent of half the cone angle is 0 for a cone of 0 degrees. For 180 degrees it is minus 22 million in "
     "single precision.",
     "Half angles are limited to the range from 0.001 to 1.5 rad, and the limitation is reported. Wider cones are "
     "drawn as six faces.",
     "tangent of a map's half angle, of the widest that is allowed", 1.05, "of tan 1.5", "5 % for the kernel's margin",
     "tangent of a right angle in single precision, its size", 1e7, hard_floor_and_box,
     "map.resolution=512 light.type=spot light.cone=179.8 light.distance=6", "", ""},
    {10, "far-away", "Far from the origin",
     "At 1,000 km from the origin, single precision resolves 6 cm. Absolute matrices shift shadows by tens of texels, "
     "and the shadows shake as the camera moves.",
     "Transforms are computed in double precision, relative to the camera and to the scene's centre, and rounded only "
     "afterwards.",
     "pixels that differ from the same scene at the origin", 5e-4, kPixels, kTwin,
     "texels that one absolute matrix in single precision is off there", 1, hard_far_away,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {11, "scale", "A scene of a few centimetres",
     "A bias in metres that suits a room is far too large for a model of 1/100 its size. The model's shadows are "
     "lost.",
     "Bias, normal offset, fit and near plane are given in texels or in shares of the scene's size, never in metres.",
     "pixels that differ from the same scene at scale 1, from 1/1000 to 1,000,000", 5e-4, kPixels, kTwin,
     "share of pixels that differ under a bias in metres", 0.01, hard_tiny,
     "map.resolution=512 light.azimuth=30 light.elevation=40 bias.kind=constant", "bias.unit=metres bias.constant=0.05",
     "bias.unit=texels bias.constant=5"},
    {12, "snapping", "Edges that crawl",
     "Maps fitted to the view frustum slide over the ground as the camera moves, so hard shadow edges shimmer.",
     "Each map covers the sphere around its part of the view frustum and keeps its size. It moves by whole texels, "
     "computed in double precision.",
     "probes that change their texel, in 1000 steps of less than a texel and a full turn", 0, "probes",
     "snapped maps hold the same texels, wherever they are", "share of probes that do under a tight fit", 0.5,
     hard_field, "map.resolution=256 light.cascades=2 filter.kernel=hard view.frustum=false", "light.fit=view",
     "light.fit=stabilised"},
    {13, "degenerate", "Triangles without area",
     "Triangles that are only points or lines rasterise to depths outside 0 to 1 on some drivers. A blur spreads "
     "these depths.",
     "While the scene is read, triangles without area are found by exact arithmetic, dropped and counted.",
     "pixels that differ from the mesh without them", 0, kCount, "triangles without area cast no shadow",
     "triangles whose normal would be 0/0", 4, hard_degenerate,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {14, "stretched", "Uneven scale",
     "A normal that is transformed like a point tilts under an uneven scale. The bias that uses this normal is then "
     "wrong.",
     "Normals are transformed by the cofactors of the matrix.",
     "angle between a face and the normal that the bias uses, at most", 0.1, "degrees",
     "a tenth of a degree is a quarter of the bias that flat light needs",
     "degrees that a normal transformed like a point is off", 5, hard_stretched,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {15, "mirrored", "Mirrored",
     "A node that mirrors reverses the winding of every triangle. Culling then removes the wrong side, and single "
     "planes lose their shadow.",
     "The front face follows the sign of the matrix's determinant.",
     "pixels whose shadow differs from the mirrored picture of the straight scene, at one half", 5e-4, kPixels,
     "the mirrored light's map has other axes, so that edges meet its texels elsewhere",
     "share of pixels in which the two ways of culling differ", 0.02, hard_mirrored,
     "map.resolution=512 light.azimuth=-30 light.elevation=40 caster.cull=front", "", ""},
    {16, "flattened", "A scale of 0",
     "A matrix of scale 0 has no inverse, so normals become NaN. Some engines then keep the object's old transform.",
     "Normals use cofactors, which need no division. An object scaled to a point casts no shadow, and one scaled to a "
     "plate casts the plate's shadow.",
     "pixels that an object of scale 0 changes", 0, kPixels, "a point has no area",
     "share of pixels that a box flattened to a plate changes", 1e-3, hard_flattened,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {17, "nothing-casts", "Nothing casts",
     "Bounds of no casters are infinite and inverted. The map is then mirrored and drawn at full cost.",
     "No map is drawn, everything is lit, and the plan gives the reason.",
     "draws of the shadow pass where nothing casts or receives", 0, "draws", "there is nothing to draw",
     "draws with casters", 1, hard_floor_and_box,
     "map.resolution=512 object.Case/Floor.cast=false object.Case/Box.cast=false object.Case/Ball.cast=false", "", ""},
    {18, "no-depth", "Hardly any depth",
     "Under light straight above a single plane, the near and the far plane have equal depth. The projection then "
     "divides by a depth range of 0.",
     "The depth range spans at least two texels, and at least 1024 steps of the numbers that hold it.",
     "lit pixels of a plane darker than lit under a light straight above", 0, kCount, kExact,
     "depth scales, 1 / (far - near), that are infinite by the bounds alone", 1, hard_plate_on_floor,
     "map.resolution=2048 light.elevation=90 bias.kind=constant bias.unit=metres bias.constant=0.001 "
     "filter.kernel=hard",
     "", ""},
    {19, "bad-numbers", "Settings without sense",
     "Sliders and files may contain a near plane beyond the far plane, NaN or infinities. Matrices made from these "
     "values contain NaN.",
     "Every value is repaired before it is used, and each repair is reported.",
     "bad settings that were taken without a word", 0, "settings", "a silent repair hides a mistake",
     "bad settings tried", 20, hard_floor_and_box,
     "map.resolution=512 light.azimuth=30 light.elevation=40 light.fit=manual light.near=20 light.far=2", "", ""},
    {20, "map-size", "A map of one texel",
     "A map of one texel holds one depth for the whole scene. A map beyond the driver's size limit cannot be drawn at "
     "all.",
     "Sizes are limited to what the driver supports, and kernels wider than the map stay inside it. Errors fall as "
     "texels shrink.",
     "wrong pixels more than at a quarter of the map's side", 5e-4, kPixels,
     "a coarse map may be lucky where its texels fall", "share of pixels wrong at one texel", 0.02, hard_floor_and_box,
     "light.azimuth=30 light.elevation=40 filter.kernel=hard", "map.resolution=1", "map.resolution=1024"},
    {21, "thin-caster", "Thinner than a texel",
     "A wire thinner than a texel covers the centres of only a few texels. Its shadow is a row of dots, or is "
     "missing.",
     "Only smaller texels help. Pixels that are wrong for this reason are classified as undersampled.",
     "shadow that is missing beyond the share that a width of less than a texel predicts", 0.1, "of the wires' shadow",
     "wires of one direction meet the rows of texels at like places, so that counts are not independent",
     "share of the wires' shadow missing at a quarter of a texel", 0.5, hard_wires,
     "light.azimuth=30 light.elevation=60 light.fit=scene filter.kernel=hard", "map.resolution=256",
     "map.resolution=4096"},
    {22, "variance-cancels", "Variance below zero",
     "Variance is the mean of squares minus the square of the mean, and this difference cancels in single precision. "
     "A third of the texels of flat surfaces has a variance below 0.",
     "Variance is never below a least variance, and no root is taken of the raw difference.",
     "pixels of a lit slope not lit, or not within 0 and 1", 0, kPixels, "a slope that nothing shades is lit",
     "share of the map's texels whose variance is below 0 as single precision has it", 0.1, hard_slope,
     "map.resolution=512 light.elevation=70 light.azimuth=0 light.fit=scene filter.kernel=vsm filter.blur=2 "
     "filter.bleed=0 bias.kind=constant",
     "filter.min_variance=0", "filter.min_variance=1e-5"},
    {23, "exponents", "Exponents that overflow",
     "The square of exp(c) overflows single precision for c above 44 and half precision for c above 5.5. A blur "
     "spreads the infinite values.",
     "Exponents are limited to the range of the format: 43.66 in single precision (less with a blur) and 5.54 in half "
     "precision. The limitation is reported.",
     "pixels not within 0 and 1, or lit ones below one half, at every exponent", 0, kCount,
     "nothing else is visibility", "formats in which the square of the largest exponential that can be set is infinite",
     2, hard_slope,
     "map.resolution=512 light.elevation=70 light.azimuth=0 light.fit=scene filter.kernel=evsm4 filter.blur=2 "
     "filter.exponent=88 filter.negative_exponent=88 bias.kind=constant bias.constant=0.1 bias.normal=4",
     "", ""},
    {24, "moment-steps", "Four moments in 16 bits",
     "On a plane, the depths that four moments represent lie close together. Rounding to 16 bits moves these depths "
     "past each other, and the lit floor turns grey.",
     "A small share of fixed moments is mixed in: 0.0006 with 16 bits.", "lit pixels darker than lit, away from edges",
     0.005, kPixels, "a fifth of the value without: where the roundings of neighbouring texels agree",
     "share of pixels darker than lit without that share", 0.025, hard_floor_and_box,
     "map.resolution=512 light.azimuth=30 light.elevation=40 filter.kernel=msm_hamburger filter.moment_format=16-bit "
     "filter.blur=2 filter.bleed=0 bias.kind=constant bias.constant=0.1 bias.normal=2",
     "filter.moment_bias=0", "filter.moment_bias=6e-4"},
    {25, "summed-areas", "Sums over the whole map",
     "A summed-area table in single precision gives the sum over a window as a difference of large sums, with few "
     "exact digits. The resulting noise grows with the map.",
     "The table holds sums of integers. Their differences are exact, even if the sums overflow.",
     "mean difference from a blur of the same width", 1e-4, "of visibility", "single steps of a 16-bit fraction",
     "the same of a table in single precision", 1e-3, hard_floor_and_box,
     "map.resolution=2048 light.azimuth=30 light.elevation=40 filter.kernel=savsm filter.window=3 filter.bleed=0 "
     "filter.min_variance=0 bias.kind=constant bias.constant=0.1 bias.normal=0.5",
     "filter.sums=float", "filter.sums=integer"},
    {26, "no-blockers", "A search that finds nothing",
     "The mean depth of no blockers is 0/0. A blocker at the receiver itself gives a penumbra of negative width.",
     "A receiver without blockers counts as lit before any division. Penumbra widths are clamped at 0.",
     "largest difference from 1 where nothing blocks, from 0 where all does", 0, "of visibility", "both are exact",
     "pixels whose search finds nothing, of which 0/0 is asked", 1000, hard_two_covers,
     "map.resolution=512 light.azimuth=30 light.elevation=60 light.size=1 filter.kernel=pcss", "", ""},
    {27, "edge-on-planes", "Planes seen edge-on",
     "For a plane seen edge-on, the slope from screen derivatives divides by 0. Engines add the slope over one texel "
     "as bias. On faces one pixel wide this bias exceeds the caster's thickness: light leaks.",
     "The slope comes from the triangle's plane by a quotient without an inverse matrix. No slope is added to the "
     "bias, and edge-on planes need no look-up.",
     "wrong pixels inside shadow or light, on stairs a pixel wide", 5e-4, kPixels,
     "pixels on the steps' own edges may show either face",
     "share of pixels that the slope by screen derivatives takes out of their shadow", 0.05, hard_stairs,
     "map.resolution=1024 light.azimuth=180 light.elevation=10 filter.kernel=pcf filter.size=5 bias.constant=0.5",
     "bias.kind=receiver-plane-derivatives", "bias.kind=receiver-plane"},
    {28, "split-ends", "Splits at their ends",
     "Logarithmic splits from a near plane at 0 need log(0). Equal near and far planes leave an empty slice.",
     "The near plane is at least a millionth of the far plane's distance. Each slice has a least depth. An edited "
     "split moves the splits that it passes.",
     "receivers in no cascade, and splits not beyond the one before", 0, "faults",
     "every surface that is seen must have a map", "splits that are no numbers by the bare formula", 1, hard_field,
     "map.resolution=256 light.cascades=4 light.split=logarithmic camera.near=0.0001 view.frustum=false", "", ""},
    {29, "map-border", "Beyond the map",
     "Points outside the map read its outermost texels, so streaks extend from the sides of the map.",
     "The border counts as lit, or the shader tests the coordinate range. A margin around the map is as wide as the "
     "kernel.",
     "pixels beyond the map's reach that are not lit", 0, kCount, "the map says nothing of them",
     "the same where texels are clamped or repeated", 50, hard_bar,
     "map.resolution=128 light.azimuth=30 light.elevation=40 light.fit=manual light.extent=2", "map.wrap=clamp",
     "map.wrap=border"},
    {30, "cube-seams", "Between a lamp's faces",
     "A kernel at the side of one of a point light's six faces reads texels that this face does not hold. Lines "
     "appear on the floor where faces meet.",
     "Each face is wider than a right angle by the kernel's reach.",
     "wrong pixels near a seam beyond those within the faces", 5e-4, kPixels, kTwin,
     "pixels whose kernel crosses the side of a face of exactly a right angle", 200, hard_lamp,
     "map.resolution=256 light.type=point light.distance=0.001 light.target_y=0.5 filter.kernel=pcf filter.size=5 "
     "bias.kind=constant bias.unit=metres bias.constant=0.25 bias.normal=3",
     "", ""},
    {31, "pancaking", "Casters before the near plane",
     "Casters between the light and the view frustum are cut off by a near plane behind them, or bent by clamped "
     "vertices.",
     "Depth is clamped for each texel, not for each vertex (GL_DEPTH_CLAMP).",
     "pixels that differ from the picture of a range that holds all casters", 5e-4, kPixels, kTwin,
     "share of pixels that differ where the near plane cuts", 0.02, hard_high_sheet,
     "map.resolution=512 light.azimuth=30 light.elevation=80 light.fit=view filter.kernel=hard",
     "light.near_far=manual light.near=36 light.far=64", "light.near_far=pancaking"},
    {32, "alpha", "Holes of alpha",
     "If the shadow pass ignores an alpha mask, the whole sheet casts a shadow. A blended material casts no shadow at "
     "all.",
     "Masked casters are drawn with their holes. Blended casters are drawn as masks if caster.blend says so.",
     "wrong pixels inside shadow or light, against rays that know the mask", 0, kPixels, "the same holes",
     "share of pixels that differ where the mask is ignored", 0.01, hard_blended_sheet,
     "map.resolution=1024 light.azimuth=30 light.elevation=60 filter.kernel=hard", "caster.blend=none",
     "caster.blend=mask"},
    {33, "not-finite", "Vertices that are no numbers",
     "One NaN or infinity among the vertices of a file makes the scene's bounds infinite, and with them every map.",
     "A mesh with such vertices is left out and named.", "pixels that differ from the scene without that mesh", 0,
     kCount, "the rest does not change", "meshes that are left out", 1, hard_not_finite,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {34, "large-indices", "More than 65,536 vertices",
     "16-bit indices wrap around, and index 65,535 acts as primitive restart. Triangles then span the scene, or the "
     "mesh has holes.",
     "The program uses 32-bit indices without primitive restart.",
     "pixels that differ from the same plate of two triangles", 5e-4, kPixels, kTwin,
     "share of pixels that differ where indices are cut to 16 bits", 5e-3, hard_many_vertices,
     "map.resolution=512 light.azimuth=30 light.elevation=40", "", ""},
    {35, "smooth-terminator", "A ball of few facets",
     "Some facets face away from the light where their smooth normals face it. These facets are dark with hard sides "
     "and look like acne. A bias does not remove them, and loses true shadows.",
     "Facets turned away from the light get no bias. Their pixels count as shadow terminator, which no sum of errors "
     "includes.",
     "such pixels that the overlay or the reference miss, or that count as wrong", 0, kCount,
     "the sign of two cosines decides", "shadow-terminator pixels that are as dark under a bias against them", 20,
     hard_low_polygon, "map.resolution=1024 light.azimuth=-40 light.elevation=20",
     "bias.kind=constant bias.normal=0 bias.constant=800", "bias.kind=adaptive"},
    {36, "truth", "Sanity of the reference",
     "A ray that starts on a surface may hit that same surface. A reference in which convex bodies shadow themselves "
     "is wrong everywhere.",
     "Rays start above their surface, by some steps of its coordinates in single precision. The scene is centred and "
     "scaled before.",
     "pixels of convex bodies that are turned to the light and shadowed by themselves", 0, kCount,
     "a convex body cannot shadow itself",
     "share of such rays in single precision that hit their own triangle, without that", 0.2, hard_convex_bodies,
     "light.azimuth=30 light.elevation=40 light.source=traced", "", ""},
    {37, "bent-ground", "Bent ground in grazing light",
     "Bent ground is made of flat strips. Within the kernel the neighbouring strip rises above the plane of the "
     "receiver. Dark bands appear in grazing light.",
     "Texels are compared with the receiver's plane shifted towards the light. The shift grows with a texel's distance "
     "from the look-up.",
     "lit pixels of bent ground darker than lit, with 16 reversed bits, 100 km off", 0.01, kPixels,
     "strips do not shadow each other; the foot of the box's lit sides is an inner corner",
     "share of them that the plane alone darkens", 0.05, hard_bent_ground,
     "map.resolution=128 map.format=d16 map.reversed_z=true light.azimuth=20 light.elevation=15 "
     "filter.kernel=pcf filter.size=5 bias.normal=0 bias.constant=0",
     "bias.kind=receiver-plane", "bias.kind=receiver-plane-remainder"},
    {38, "light-bleeding", "Light through a cover",
     "Mean and variance give an upper bound of the lit share. Where a blur spans casters at two depths, the floor "
     "below both is lit.",
     "Warped depths (EVSM) give casters near the light hardly any weight. Four moments, less blur or light-bleed "
     "reduction also help.",
     "share of pixels wrong by light bleeding", 1e-3, kPixels,
     "warped by e^(40 x), the bars are nothing beside the cover; a few pixels lie at the cover's own sides",
     "the same under depths that are not warped", 0.1, hard_bars_over_cover,
     "map.resolution=256 light.elevation=90 filter.blur=6 filter.bleed=0", "filter.kernel=vsm", "filter.kernel=evsm4"},
    {39, "quantised", "Quantised positions",
     "Positions in 8 bits turn a gentle hill into terraces. A bias from the stored normals is too small for facets "
     "that the light meets at a flatter angle.",
     "Use a bias that follows the triangle's plane, with an allowance for adjacent triangles (receiver plane and "
     "remainder). Positions in 14 bits make the terraces 64 times lower.",
     "share of pixels with acne", 2e-4, kPixels, "facets meet in inner corners within a pixel",
     "share of pixels with acne under a bias by stored normals, beyond that of the exact hill", 5e-4, hard_quantised,
     "map.resolution=1024 light.azimuth=30 light.elevation=20 light.fit=scene filter.kernel=hard bias.normal=0",
     "bias.kind=slope bias.slope=3 bias.constant=0.5", "bias.kind=receiver-plane-remainder"},
    {40, "stray-vertex", "One vertex far off",
     "One forgotten vertex 1,000 km away makes a map of the whole scene as wide. Each texel covers 2 km, and no "
     "shadow is left.",
     "The map is fitted to the view frustum (light.fit=view). Coordinates are relative to the centre of the scene's "
     "main part. A note about the file names the object.",
     "pixels that differ from the same scene without that vertex", 5e-4, kPixels, kTwin,
     "share of pixels that differ under a fit to the whole scene", 0.01, hard_stray_vertex,
     "map.resolution=512 light.azimuth=90 light.elevation=30", "light.fit=scene", "light.fit=view"},
    {41, "units", "Kilometres read as metres",
     "A model read in a wrong unit is 1000 times too small or too large. A bias in metres then removes every shadow, "
     "or is negligible compared with a texel.",
     "The bias is given in texels, which grow with the scene.",
     "pixels that differ from the same scene in metres, in units of 1/1024 and of 1024", 5e-4, kPixels, kTwin,
     "share of pixels that differ under a bias in metres", 0.01, hard_kilometres,
     "map.resolution=512 light.azimuth=30 light.elevation=40 bias.kind=constant", "bias.unit=metres bias.constant=0.05",
     "bias.unit=texels bias.constant=5"},
    {42, "given-strip", "A map of 1:4 sides",
     "An engine's map has 128 by 512 texels over a square region. A bias that suits the short side of a texel leaves "
     "stripes along the long side.",
     "Each pixel gets the bias that its plane needs, computed from both sides of the texel (bias.kind=adaptive).",
     "lit pixels darker than lit, at the predicted least bias", 0, kPixels, kExact,
     "share of pixels with acne under the least bias of square texels of the short side", 0.1, hard_given,
     "map.bundle_bias=entered map.bundle=builtin:strip light.azimuth=30 light.elevation=40 filter.kernel=hard",
     "bias.kind=constant bias.unit=metres bias.constant=0.014", "bias.kind=adaptive"},
    {43, "given-warped", "A map whose w is not constant",
     "An engine's directional light has a perspective matrix (LiSPSM). A texel is 16 times as long at one end of the "
     "map as at the other, so no bias in metres suits both ends.",
     "Texel size and depth range are computed from the matrix for each row of the map (bias.kind=adaptive).",
     "lit pixels darker than lit, at the predicted least bias", 0, kPixels, kExact,
     "share of pixels with acne under a bias that suits the middle row", 0.1, hard_given,
     "map.bundle_bias=entered map.bundle=builtin:warped light.azimuth=30 light.elevation=40 filter.kernel=hard",
     "bias.kind=constant bias.unit=metres bias.constant=0.028", "bias.kind=adaptive"},
    {44, "given-reversed", "A matrix from before depth was reversed",
     "An engine reverses depth on the way to the GPU, but its exported bundle states the matrix from before that step. "
     "Everything is dark.",
     "The bundle states the matrix that the caster pass uses, with depth.reversed beside it.",
     "wrong pixels inside shadow or light, under an imported map of reversed depth", 5e-4, kPixels,
     "texels' middles decide at edges, on at most 1 pixel in 2000", "share of pixels that are wrongly dark", 0.5,
     hard_given,
     "light.type=spot light.azimuth=30 light.elevation=70 light.distance=12 light.cone=60 bias.kind=adaptive "
     "filter.kernel=hard map.bundle_bias=entered",
     "map.bundle=builtin:reversed-unstated map.reversed_z=false", "map.bundle=builtin:reversed map.reversed_z=true"},
    {45, "given-16-bits", "16 bits read as floats",
     "An engine's map has 16 bits, but its bundle states 32-bit floats. The bias then lacks one step of depth, which "
     "is 3 cm on the floor.",
     "The true format of the engine's map is set (depth.format, map.format). Its step of depth is part of the least "
     "bias.",
     "lit pixels darker than lit, at the predicted least bias", 0, kPixels, kExact,
     "share of pixels with acne under the least bias of floats", 0.1, hard_given,
     "map.bundle_bias=entered map.bundle=builtin:16-bits light.type=spot light.azimuth=30 light.elevation=70 "
     "light.distance=12 light.cone=60 bias.kind=adaptive filter.kernel=hard",
     "map.format=d32f", "map.format=d16"},
    {46, "given-far-away", "An engine's matrix far from the origin",
     "At 6,000 km from the origin, an engine's absolute matrix in single precision shifts its shadows by several "
     "texels.",
     "The bundle states the matrix relative to the engine's camera, and the camera's position in double precision "
     "(world.origin).",
     "wrong pixels inside shadow or light", 5e-4, kPixels,
     "texels' middles decide at edges, on at most 1 pixel in 2000", "the same under the absolute matrix", 0.002,
     hard_given_far_away,
     "light.azimuth=30 light.elevation=40 bias.kind=adaptive filter.kernel=hard map.bundle_bias=entered",
     "map.bundle=builtin:absolute", "map.bundle=builtin:relative-to-camera"},
    {47, "engine-angle", "An engine's number in grazing light",
     "An engine's constant bias was chosen for ground at 45 degrees to the light. Where the light grazes the ground, "
     "this bias leaves stripes of acne.",
     "Convert the engine's bias for the angle of this ground. A polygon offset by slope helps too, since it grows with "
     "the angle.",
     "lit pixels of a plane at 89 degrees darker than lit, under each engine's converted number", 0, kPixels, kExact,
     "the same under the number for 45 degrees", 0.3, hard_floor_and_box,
     "map.resolution=512 map.format=d24 light.elevation=6 light.fit=scene filter.kernel=hard bias.kind=constant "
     "bias.normal=0",
     "bias.constant=1", "bias.constant=7"},
    {48, "engine-depth-range", "An engine's number after the map was fitted again",
     "Some engines give the bias as a share of the map's depth range. After a fit to a tenth of that range, the same "
     "number is a tenth of the bias.",
     "Convert the number again for the present depth range, or give the bias in texels.",
     "lit pixels of a plane darker than lit, under each engine's number for the present range", 0, kPixels, kExact,
     "the same under the number for ten times the range", 0.2, hard_floor_and_box,
     "map.resolution=512 map.format=d24 light.azimuth=30 light.elevation=40 filter.kernel=hard bias.kind=constant "
     "bias.normal=0",
     "bias.unit=depth bias.constant=0.0002", "bias.unit=texels bias.constant=1.2"},
    {49, "engine-cascades", "Cascades that share one map",
     "Some engines give each of several cascades half of the map's stated width. A bias in metres for texels of the "
     "whole map is half of what these cascades need.",
     "Convert the bias with the texel size of each cascade.",
     "lit pixels of a plane darker than lit, under each engine's number for half of the map", 0, kPixels, kExact,
     "the same under the number for the whole map", 0.05, hard_field,
     "map.resolution=512 light.azimuth=30 light.elevation=40 light.cascades=2 light.fit=view filter.kernel=hard "
     "bias.kind=constant bias.normal=0",
     "bias.constant=0.45", "bias.constant=0.9"},
};

/// Calls `use` with key and value of each setting of a view. Settings that both views of a case share come first.
template <class Use>
void each_setting(const HardCaseView& view, Use use) {
    for (const std::string_view list : {view.row->view, view.fixed ? view.row->fixed : view.row->broken})
        for (std::size_t from = 0, end = 0; from < list.size(); from = end + 1) {
            end = std::min(list.find(' ', from), list.size());
            const std::string_view one = list.substr(from, end - from);
            if (const auto equals = one.rfind('='); equals != std::string_view::npos)
                use(one.substr(0, equals), one.substr(equals + 1));
        }
}

}  // namespace

std::span<const HardCase> hard_cases() {
    return kCases;
}

std::string HardCaseView::name() const {
    const bool mended = fixed && !row->broken.empty();
    return fmt::format("{}{}{}", kHardPrefix, row->key, mended ? kFixedSuffix : std::string_view());
}

std::string HardCaseView::about() const {
    if (row->broken.empty()) return fmt::format("{} Expected here: {}", row->fault, row->fix);
    return fixed ? fmt::format("Fixed. {} Without: {}", row->fix, row->fault)
                 : fmt::format("{} Fix (Page down): {}", row->fault, row->fix);
}

Settings HardCaseView::settings() const {
    Settings s;
    each_setting(*this, [&](std::string_view key, std::string_view value) { set_setting(s, key, value); });
    return s;
}

Scene HardCaseView::scene() const {
    Scene scene = row->make();
    scene.name = name();
    scene.about = about();
    each_setting(*this,
                 [&](std::string_view key, std::string_view value) { scene.suggested.emplace_back(key, value); });
    return scene;
}

std::span<const HardCaseView> hard_case_views() {
    static const std::vector<HardCaseView> views = [] {
        std::vector<HardCaseView> list;
        for (const HardCase& row : kCases) {
            if (!row.broken.empty()) list.push_back({&row, false});
            list.push_back({&row, true});
        }
        return list;
    }();
    return views;
}

std::optional<HardCaseView> find_hard_case(std::string_view name) {
    for (const HardCaseView& view : hard_case_views())
        if (view.name() == name) return view;
    return {};
}

}  // namespace si
