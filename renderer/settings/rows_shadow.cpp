// Rows of the shadow technique: map, caster, bias and filter.
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/rows.h"

namespace si {
namespace {

using namespace rows;

constexpr Choice kFormats[] = {
    {"d16", "16-bit depth", "65536 equal steps of depth. Half the memory of d32f; a long depth range shows its steps."},
    {"d24", "24-bit depth", "2^24 equal steps of depth, the usual choice of hardware."},
    {"d32f", "32-bit float depth", "Floating point; finest when depth is reversed."},
    {"colour", "depth as colour",
     "The depth written to a 32-bit float colour target by the fragment shader, as before depth textures were common. "
     "The sampler cannot compare it."},
    {"linear", "distance, 32 bits",
     "The distance along the light's axis between near and far, written to a 32-bit float colour target and converted "
     "to depth when read. Under parallel light it is the depth. The sampler cannot compare it, and polygon offset does "
     "not move it."},
    {"linear16", "distance, 16 bits",
     "The same in 65536 equal steps of distance: a spot light's far half keeps the steps that d16 spends near the "
     "light."},
};
constexpr Choice kWraps[] = {
    {"border", "clamp to border", "Texels outside of the map count as map.outside says."},
    {"clamp", "clamp to edge", "The outermost texels continue outwards: streaks along the map's edge."},
    {"repeat", "repeat",
     "The map tiles the world: copies of the shadow outside of the light's frustum (over-sampling)."},
    {"range", "test the range", "The shader tests whether the coordinate lies in [0,1] and does not sample outside."},
};
constexpr Choice kOutside[] = {
    {"lit", "lit", "Surfaces that the map does not reach count as lit."},
    {"unlit", "unlit", "Surfaces that the map does not reach get ambient light only."},
};
constexpr Choice kRadiusUnits[] = {
    {"texels", "texels", "Widths of a texel of the shadow map at the receiver."},
    {"metres", "metres", "Metres at the receiver, at most filter.max_radius texels of them."},
};
constexpr Choice kDisks[] = {
    {"table", "Poisson table", "At most 64 places, each as far as possible from the earlier ones."},
    {"spiral", "Vogel's spiral", "Golden angles: any number of places, evenly spread."},
};
constexpr Choice kCompares[] = {
    {"less", "less", "Lit when the fragment's depth is strictly nearer to the light than the stored depth."},
    {"lequal", "less or equal", "Lit when the fragment's depth is nearer than or equal to the stored depth."},
};

constexpr Choice kOrigins[] = {
    {"near", "the camera",
     "A place near the camera, and for the maps the middle of the scene: differences are taken in double precision, "
     "before anything is rounded."},
    {"world", "the world's origin", "The choice of many engines: positions become coarser with distance."},
};

constexpr Choice kTransforms[] = {
    {"world", "from the world",
     "A surface's place in the map from its place in the scene, by one matrix that was multiplied in double "
     "precision."},
    {"eye", "from the eye",
     "The place before the camera times T = B * P_light * V_light * inverse(V_camera), multiplied in single precision, "
     "as texture matrices of fixed-function OpenGL were."},
};

constexpr Choice kBundleMaps[] = {
    {"given", "as given", "The images of the bundle."},
    {"drawn", "drawn again",
     "The program draws the scene's casters with the bundle's matrices, viewports and raster state. Resolution, "
     "format, culling and polygon offset then act."},
};
constexpr Choice kBundleBiases[] = {
    {"file", "as the file states", "The bias that the bundle states; unknown where it does not state all of it."},
    {"entered", "entered by hand", "bias.* hold the engine's bias, as you have entered it."},
    {"unknown", "unknown", "Nobody knows it. No verdict claims that the engine's pixel is wrong."},
};

/// Returns the reason why map.bundle_maps has no effect.
std::string_view bundle_maps_idle(const Settings& s, int) {
    return s.map.bundle.empty() ? "without effect: no maps are given (map.bundle)" : "";
}

/// Returns the reason why map.bundle_bias has no effect.
std::string_view bundle_bias_idle(const Settings& s, int light) {
    return s.map.bundle_maps == BundleMaps::Drawn ? "without effect: the program draws the maps (map.bundle_maps)"
                                                  : bundle_maps_idle(s, light);
}

/// Returns the reason why map.outside has no effect. It also applies behind the far plane and behind spot lights.
std::string_view outside_idle(const Settings& s, int) {
    if (s.map.far_guard || s.map.wrap == MapWrap::Border || s.map.wrap == MapWrap::Range) return "";
    for (int i = 0; i < s.light_count && i < kMaxLights; ++i) {
        if (s.lights[std::size_t(i)].type != LightType::Directional) return "";
    }
    return "without effect: map.wrap finds a texel everywhere and map.far_guard is off";
}

/// Returns true when a light's virtual map may have clip levels.
bool may_have_levels(const LightSettings& light) {
    return light.type == LightType::Directional && light.fit != LightFit::Manual &&
           light.projection != LightProjection::Perspective;
}

/// Returns the reason why map.virtual_levels has no effect.
std::string_view levels_idle(const Settings& s, int) {
    for (int i = 0; i < s.light_count && i < kMaxLights; ++i) {
        if (may_have_levels(s.lights[std::size_t(i)])) return "";
    }
    return "without effect: only a directional light has clip levels, with a fitted and orthographic map";
}

std::string_view level_bias_idle(const Settings& s, int light) {
    return s.map.virtual_levels < 2 ? "without effect: map.virtual_levels is 1" : levels_idle(s, light);
}

/// Returns true when a light's map may have six faces. A wide spot light's has them.
bool may_have_faces(const LightSettings& light) {
    return light.type == LightType::Point || (light.type == LightType::Spot && light.cone > 171);
}

/// Returns the reason why map.wrap has no effect: every look-up stays within its face.
std::string_view wrap_idle(const Settings& s, int) {
    if (!s.map.face_guard || s.light_count == 0) return "";
    for (int i = 0; i < s.light_count && i < kMaxLights; ++i) {
        if (s.lights[std::size_t(i)].type != LightType::Point) return "";
    }
    return "without effect: the six faces of a point light leave nothing outside; set map.face_guard off to show seams";
}

std::string_view face_guard_idle(const Settings& s, int) {
    for (int i = 0; i < s.light_count && i < kMaxLights; ++i) {
        if (may_have_faces(s.lights[std::size_t(i)])) return "";
    }
    return "without effect: no light's map has six faces";
}

std::string_view compare_idle(const Settings& s, int) {
    return filter_of(s).samples() == Samples::Moments
               ? "without effect: this kernel compares with the mean and variance of depths, not with single depths"
               : "";
}

std::string_view method_idle(const Settings& s, int light) {
    if (draws_pages(s)) return "without effect: with map.virtual the shader finds each texel's page and compares";
    if (is_colour(s.map.format)) return "without effect: the sampler cannot compare a map that is a colour image";
    return compare_idle(s, light);
}

constexpr std::string_view kNoOffset =
    "without effect: polygon offset does not move the distances that map.format stores";

constexpr auto kMap = only_of_maps(std::to_array<Param>({
    {SI_FIELD(map.resolution), .label = "Resolution", .unit = "texels", .min = 1, .max = 16384, .logarithmic = true,
     .cost = Cost::Target,
     .help = "Width and height of each shadow map image, in texels. Twice the resolution halves the size of a texel on "
             "the ground and takes four times the memory. A size beyond what the driver can allocate is clamped. While "
             "some casters move in an unchanged map, the cache of static casters takes the same memory again. With "
             "map.virtual, only pages that are read take memory.",
     .also = "shadow map size, shadow resolution, texture size, atlas size, mapSize, cube size, cascade size, "
             "shadow.mapSize",
     .shader = true, .read_by = ReadBy::Maps},
    {SI_FIELD(map.format), .label = "Format", .cost = Cost::Target, SI_CHOICES(kFormats),
     .help = "The storage of depth in the map. Fewer bits make larger steps of depth, which need more bias.",
     .also = "depth precision, depth bits, depth buffer format", .shader = true, .read_by = ReadBy::Maps},
    {SI_FIELD(map.wrap), .label = "Addressing", .cost = Cost::Program, SI_CHOICES(kWraps), .idle = wrap_idle,
     .help = "The result of a look-up outside the map's square.",
     .also = "wrap mode, address mode, clamp, oversampling", .shader = true},
    {SI_FIELD(map.outside), .label = "Out-of-map result", .cost = Cost::Program, SI_CHOICES(kOutside),
     .idle = outside_idle,
     .help = "The lighting of surfaces that the map does not hold: beside it, behind its far plane with map.far_guard, "
             "or behind the light.",
     .also = "border colour, border color, frustumEdgeFalloff", .shader = true},
    {SI_FIELD(map.far_guard), .label = "Far-plane test", .cost = Cost::Program,
     .help = "Surfaces beyond the light's far plane count as map.outside says. Off: they are compared like all others, "
             "farther away than anything stored, and turn dark.",
     .also = "far plane, beyond far, shadow distance", .shader = true},
    {SI_FIELD(map.face_guard), .label = "Guard of faces", .idle = face_guard_idle,
     .help = "Draws each of the six faces of a point light's map wider than 90 degrees. The margin is as many texels "
             "as look-ups reach, at least 6. Off: a look-up near a face's side leaves the face, its result follows "
             "map.wrap, and seams show. A spot light wider than 171 degrees also has six faces.",
     .also = "cube map seams, seamless, face border, guard band"},
    {SI_FIELD(map.compare), .label = "Depth test", .cost = Cost::Program, SI_CHOICES(kCompares), .idle = compare_idle,
     .help = "Comparison of the fragment's depth with the stored depth: less, or less or equal (greater, or greater "
             "or equal, under reversed depth). The two choices differ where both depths are equal, as on surfaces "
             "that cast onto themselves without bias.",
     .also = "depth func, compare function, comparison", .shader = true},
    {SI_FIELD(map.reversed_z), .label = "Reversed depth", .cost = Cost::Program,
     .help = "The near plane maps to depth 1 and the far plane to 0. With d32f the fine steps of floating point near 0 "
             "then offset the perspective's coarse steps far away.",
     .also = "reverse z, reversed z, inverted depth buffer", .shader = true},
    {SI_FIELD(map.blur_texels), .label = "Depth blur", .unit = "texels", .min = 0, .max = 32, .cost = Cost::Target,
     .help = "Wrong on purpose: each stored depth becomes the mean of the depths up to this many texels away, along x "
             "and y. The comparison then uses false slopes between caster and receiver. Shadows grow and lose their "
             "corners, thin shadows vanish, and every edge stays hard. To soften edges, filter the comparisons "
             "instead (filter.kernel). 0 is off.",
     .read_by = ReadBy::DepthBlur},
    {SI_FIELD(map.samples), .label = "Samples", .unit = "a texel", .min = 1, .max = 32, .logarithmic = true,
     .cost = Cost::Target,
     SI_IDLE(s.map.blur_texels > 0, "without effect: moments come from the depths that map.blur_texels blurs"),
     .help = "Number of samples for each texel while casters are drawn (MSAA). Moments are the mean over all samples, "
             "so a caster's edge covers a share of a texel. If the driver does not support a number, that is "
             "reported, and the next lower supported number is used.",
     .also = "MSAA, multisampling, antialiasing, msaaSamples", .read_by = ReadBy::Moments},
    {SI_FIELD(map.transform), .label = "Texture matrix", .cost = Cost::Program, SI_CHOICES(kTransforms),
     .help = "The computation of a surface's place in the map. Both ways agree in exact numbers. The overlay "
             "transform-difference shows by how many texels they differ in single precision.",
     .also = "bias matrix, texture matrix, texture projection", .shader = true},
    {SI_FIELD(map.origin), .label = "Positions relative to", SI_CHOICES(kOrigins),
     .help = "The origin of positions on the GPU. Both choices agree in exact numbers. Single precision has some seven "
             "digits, and far from the world's origin the distance uses them up."},
    {.key = "map.virtual",
     .field = [](Settings& s, int, ObjectSettings*) -> FieldRef { return &s.map.paged; },
     .label = "Virtual map",
     .cost = Cost::Target,
     .idle = paging_idle_reason,
     .help = "Draws only those pages of each map that visible surfaces read, and caches them until a caster or the "
             "light moves. A directional light has clip levels around the camera, each twice as wide as the one "
             "before. A texel then covers about a pixel everywhere. Maps of other lights, and maps of light.fit "
             "manual, keep their region and are drawn by pages. The method is that of Sakmary, Ryan, Hall and Lustri: "
             "Virtual Shadow Maps, GPU Zen 3.",
     .also = "virtual shadow maps, clipmap, sparse, paged, VSM, virtual texture",
     .read_by = ReadBy::Pages},
    {SI_FIELD(map.page_size), .label = "Page", .unit = "texels", .min = 16, .max = 1024, .logarithmic = true,
     .cost = Cost::Target,
     .help = "Width and height of a page, rounded down to a power of two and to an eighth of map.resolution. Small "
             "pages draw fewer unread texels, and large pages need fewer draws.",
     .read_by = ReadBy::Pages},
    {SI_FIELD(map.page_pool), .label = "Page pool", .unit = "pages", .min = 1, .max = 16384, .logarithmic = true,
     .cost = Cost::Target,
     .help = "Maximum number of cached pages. If a picture reads more, coarser pages replace the finest. Shadows then "
             "lose sharpness, and no place of the map is missing.",
     .read_by = ReadBy::Pages},
    {SI_FIELD(map.virtual_levels), .label = "Clip levels", .unit = "maps", .min = 1, .max = kMaxClipLevels,
     .idle = levels_idle,
     .help = "Number of maps around the camera for a directional light. The coarsest map covers the view frustum, and "
             "each finer map has texels half as wide. With 1 there is only the map fitted by light.fit, drawn page by "
             "page."},
    {SI_FIELD(map.virtual_bias), .label = "Level bias", .unit = "levels", .min = -4, .max = 4, .idle = level_bias_idle,
     .help = "Level offset. With 0 a texel covers half a pixel to a pixel. 1 halves sharpness and draws about a "
             "quarter of the pages; below 0 is finer."},
    {SI_FIELD(map.bundle), .label = "Given maps", .max = 4096, .cost = Cost::Target,
     .help = "Path of a bundle: a folder or zip file with shadow maps, written by an engine (see docs/bundle.md). The "
             "bundle's maps are read instead of drawn maps. Maps of the bundle's first light belong to light.0, and "
             "so on. If the path is empty, maps are drawn. In a preset the path is relative to the preset's folder.",
     .also = "import, capture, engine's shadow map, external shadow map, baked depth, frame capture, RenderDoc",
     .file = true},
    {SI_FIELD(map.bundle_maps), .label = "Bundle's maps", .cost = Cost::Target, SI_CHOICES(kBundleMaps),
     .idle = bundle_maps_idle,
     .help = "Choice between the images in map.bundle and maps that this program draws again for the same light. Drawn "
             "maps use the bundle's matrices, sizes and raster state. So changes can be tried for which the engine "
             "would have to draw another map. map.resolution, bias.raster_* and caster.cull begin with the bundle's "
             "values.",
     .also = "same light, redraw, beside theirs"},
    {SI_FIELD(map.bundle_bias), .label = "Engine's bias", SI_CHOICES(kBundleBiases), .idle = bundle_bias_idle,
     .help = "Source of the bias with which the engine reads the maps of map.bundle. A bundle may leave this bias "
             "out. Then set bias.* to the engine's values and choose entered, so that causes of wrong pixels are those "
             "of the engine's picture. Choosing a source does not change the drawn picture.",
     .also = "engine bias, known bias, unknown bias, shadow bias of the engine"},
}));
static_assert(kMap.size() == member_count<MapSettings>(), "a member of MapSettings has no row");

constexpr Choice kCulls[] = {
    {"none", "none", "Every triangle casts."},
    {"back", "back faces", "Faces turned away from the light do not cast; single planes lose a side."},
    {"front", "front faces",
     "Faces turned to the light do not cast: less acne on lit sides, but floors, single planes and close contacts lose "
     "their shadow."},
};
constexpr Choice kUnits[] = {
    {"depth", "depth",
     "Units of the map's depth range [0,1], as the lectures write it (0.005). Its size in metres depends on near and "
     "far."},
    {"texels", "texels",
     "World size of one map texel at the fragment; grows and shrinks with resolution and distance."},
    {"metres", "metres", "World units along the light's axis."},
};
constexpr Choice kOffsetUnits[] = {
    {"texels", "texels", "World size of one map texel at the fragment: the offset grows with it."},
    {"metres", "metres", "World units: the same length at any resolution and distance."},
};
constexpr Choice kOffsetBys[] = {
    {"length", "whole length",
     "The whole offset along the normal at any angle: three.js, Bevy, O3DE, PlayCanvas, Unity HDRP."},
    {"sine", "times the sine",
     "The offset times the sine of the angle between normal and light: Filament at receivers, Babylon at casters."},
    {"one-minus-cosine", "times 1 - N·L",
     "The offset times 1 - N·L, with N·L the cosine between normal and light: OGRE-Next at receivers, Unity URP at "
     "casters."},
    {"sideways", "across the light",
     "The offset without its part along the light's ray, so that the depth of parallel light stays: Godot 4."},
};
constexpr Choice kNormals[] = {
    {"geometric", "geometric", "The triangle's own plane normal: the surface that the map stores."},
    {"shading", "shading",
     "The interpolated vertex normal, as the lectures do; wrong where it leaves the triangle's plane."},
    {"mapped", "normal-mapped",
     "The interpolated normal with its normal map (shading.textures): bumps that the shadow map does not hold change "
     "the bias from pixel to pixel, and the shadow test with it."},
};
constexpr Choice kMethods[] = {
    {"auto", "automatic", "Gather, which was measured to be faster."},
    {"gather", "gather",
     "The shader fetches depths, four a call where the kernel allows (textureGather), and compares them itself."},
    {"sampler", "sampler", "The texture unit compares, and blends 2x2 for bilinear kernels (sampler2DShadow)."},
};

constexpr Choice kBlurShapes[] = {
    {"box", "box", "All texels have the same weight."},
    {"gaussian", "Gaussian", "A bell curve with the outermost texels at two standard deviations."},
};
constexpr Choice kMomentFormats[] = {
    {"32-bit", "32-bit", "32-bit floats."},
    {"16-bit", "16-bit",
     "Half the memory. 16-bit floats leave little precision for a variance, and exponents must be small. Four moments "
     "are stored as 16-bit integers of a transform that spreads them (Peters, Klein 2015)."},
};
constexpr Choice kSums[] = {
    {"integer", "32-bit integers", "Moments in steps of 3e-7. Sums wrap around, and the sum over a window is exact."},
    {"float", "32-bit floats",
     "Sums of millions leave few digits for the window, which is their difference. Noise grows with the distance from "
     "the table's first corner."},
};

constexpr Choice kBlends[] = {
    {"none", "nothing", "Blended surfaces, such as glass, cast no shadow."},
    {"mask", "as a mask", "Blended surfaces cast where their alpha is at least 0.5."},
};

constexpr auto kCaster = std::to_array<Param>({
    {SI_FIELD(caster.cull), .label = "Cull casters", SI_CHOICES(kCulls),
     .help = "The faces that are left out of the shadow map. Objects may differ (object.PATH.cull).",
     .also = "shadow side, shadowSide, cullFace, double sided, two-sided, cull mode, front face culling, back face "
             "culling, "
             "shadow reverse cull face, face culling",
     .map_only = true,
     .read_by = ReadBy::Maps | ReadBy::SurfacesSeen | ReadBy::OneLight | ReadBy::Shading | ReadBy::Visibility},
    {SI_FIELD(caster.blend), .label = "Blended casters", SI_CHOICES(kBlends),
     .help = "The shadow of materials whose alpha blends (glTF: BLEND). A shadow map holds one depth a texel, so there "
             "is no half shadow.",
     .also = "transparent shadows, translucent, alpha blend, foliage"},
});
static_assert(kCaster.size() == member_count<CasterSettings>(), "a member of CasterSettings has no row");

constexpr const char* kNoNormalOffset = "without effect: bias.normal is 0";

bool slope_acts(const Settings& s) {
    return reads_setting(bias_of(s), "bias.slope") && s.bias.slope > s.bias.constant;
}

constexpr auto kBias = only_of_maps(std::to_array<Param>({
    {SI_FIELD(bias.kind), .label = "Kind", .cost = Cost::Program, .choices = bias_choices,
     .help = "Rule for the amount that is subtracted from the fragment's depth before the comparison. Normal offset "
             "and polygon offset act in addition. Choosing another kind also sets bias.constant and bias.normal to "
             "starting values, depending on the kind: 0.1 and 3 texels for slope and constant, 0 and 0 for all other "
             "kinds. Values given in the same command line or sweep are kept.",
     .also = "receiver plane depth bias, adaptive bias, bias type", .shader = true},
    {SI_FIELD(bias.unit), .label = "Unit", .cost = Cost::Program, SI_CHOICES(kUnits),
     .help = "The unit of bias.constant and bias.slope.", .shader = true, .read_by = ReadBy::Slabs},
    {SI_FIELD(bias.constant), .label = "Constant bias", .unit = "bias.unit", .min = 0, .max = 1000, .slider_max = 20,
     .help = "Constant part of the bias. With bias.kind slope the bias is max(slope bias * (1 - N·L), constant bias), "
             "with N·L the cosine between surface normal and light. The bias is subtracted from the fragment's depth "
             "before the comparison. Too small a bias leaves acne. Too large a bias detaches shadows from their "
             "casters (peter-panning).",
     .also = "depth bias, shadow bias, constantBias, shadow.bias, shadow acne, r.Shadow.CSMDepthBias", .shader = true,
     .read_by = ReadBy::Slabs},
    {SI_FIELD(bias.slope), .label = "Slope bias", .unit = "bias.unit", .min = 0, .max = 1000, .slider_max = 20,
     SI_IDLE(s.bias.slope <= s.bias.constant,
             "without effect: bias = max(slope bias * (1 - N·L), constant bias), and slope bias is not above constant "
             "bias"),
     .help = "Bias at grazing light. Bias = max(slope bias * (1 - N·L), constant bias), with N·L the cosine between "
             "surface normal and light.",
     .also = "slope scale, slope-scaled depth bias, shadow slope bias", .shader = true},
    {SI_FIELD(bias.plane_clamp), .label = "Plane clamp", .unit = "texels", .min = 0, .max = 10000, .logarithmic = true,
     .help = "Limit of the depth difference along the receiver plane between a texel of the kernel and the look-up. "
             "The limit is a number of texel widths, taken as a distance along the light's axis; 0 is no limit. In "
             "grazing light the slope of a plane grows without bound. Beyond the limit the plane may show acne.",
     .shader = true},
    {SI_FIELD(bias.normal), .label = "Normal offset", .unit = "bias.normal_unit", .min = 0, .max = 100,
     .slider_max = 20,
     .help = "Shifts the point of the look-up along its surface normal (normal-offset shadows). This cures acne at "
             "any angle of light. Too large an offset lets light in at inner edges. bias.normal_by sets how the "
             "offset depends on the angle.",
     .also = "normal bias, normalBias, shadowNormalBias, shadow normal bias, normal-offset shadows, shadow.normalBias, "
             "normal offset bias",
     .shader = true},
    {SI_FIELD(bias.normal_unit), .label = "Offset unit", .cost = Cost::Program, SI_CHOICES(kOffsetUnits),
     SI_IDLE(s.bias.normal == 0, kNoNormalOffset), .help = "The unit of bias.normal.",
     .also = "normal bias unit, world space normal bias", .shader = true},
    {SI_FIELD(bias.normal_by), .label = "Offset by angle", .cost = Cost::Program, SI_CHOICES(kOffsetBys),
     SI_IDLE(s.bias.normal == 0, kNoNormalOffset),
     .help = "The dependence of the normal offset on the angle between the light and the normal that "
             "bias.normal_source chooses. Engines differ in it.",
     .also = "normal bias scale, sine, slope-scaled normal offset", .shader = true},
    {SI_FIELD(bias.normal_source), .label = "Normal", .cost = Cost::Program, SI_CHOICES(kNormals),
     SI_IDLE(!slope_acts(s) && s.bias.normal == 0, "without effect: neither slope nor normal offset acts"),
     .help = "The normal that slope bias and normal offset use.", .also = "shadow terminator, smooth normals",
     .shader = true},
    {SI_FIELD(bias.raster_slope), .label = "Polygon offset factor", .unit = "x depth slope", .min = -100, .max = 100,
     SI_IDLE(holds_distances(s.map.format), kNoOffset),
     .help = "glPolygonOffset factor while the map is drawn: depth per texel of the triangle's own slope, times this. "
             "Towards the far plane when positive, under reversed depth too.",
     .also = "slope scale, slope-scaled depth bias, SlopeScaledDepthBias, depthBiasSlopeScale, glPolygonOffset, "
             "polygonOffset, "
             "polygonOffsetFactor, polygonOffsetSlope",
     .shader = true, .read_by = ReadBy::Maps},
    {SI_FIELD(bias.raster_units), .label = "Polygon offset units", .unit = "depth steps", .min = -1e7, .max = 1e7,
     .logarithmic = true, SI_IDLE(holds_distances(s.map.format), kNoOffset),
     .help = "glPolygonOffset units while the map is drawn: smallest steps of the depth format, as the driver defines "
             "them. Towards the far plane when positive, under reversed depth too.",
     .also = "depth bias, DepthBias, glPolygonOffset, polygonOffset, polygonOffsetUnits, polygonOffsetConstant",
     .shader = true, .read_by = ReadBy::Maps},
    {SI_FIELD(bias.raster_clamp), .label = "Polygon offset clamp", .unit = "depth", .min = 0, .max = 1,
     SI_IDLE(!offsets_polygons(s), holds_distances(s.map.format)
                                       ? kNoOffset
                                       : "without effect: bias.raster_slope and bias.raster_units are 0"),
     .help = "Largest offset that polygon offset factor and units may add, in depth [0,1]; 0 is no limit. Needs "
             "glPolygonOffsetClamp.",
     .also = "DepthBiasClamp, glPolygonOffsetClamp", .needs = DriverFeature::PolygonOffsetClamp, .shader = true,
     .read_by = ReadBy::Maps},
}));
static_assert(kBias.size() == member_count<BiasSettings>(), "a member of BiasSettings has no row");

constexpr auto kFilter = only_of_maps(std::to_array<Param>({
    {SI_FIELD(filter.kernel), .label = "Kernel", .cost = Cost::Program, .choices = choices_of<filters>,
     .swept = sweep_kernels,
     .help = "The filter of the shadow test. Wider kernels blur the stair steps and need more bias.",
     .also = "softness, soft shadows, shadow type, shadow quality, filter quality, filter mode, contact hardening, "
             "hard shadows, shadowMap.type, PCFSoftShadowMap, PCFShadowMap, BasicShadowMap, VSMShadowMap, "
             "percentage-closer filtering, usePoissonSampling",
     .shader = true},
    {SI_FIELD(filter.method), .label = "Method", .cost = Cost::Program, SI_CHOICES(kMethods), .idle = method_idle,
     .help = "The way in which the kernel reads the map. All give the same picture at different cost.",
     .also = "sampler2DShadow, textureGather, comparison sampler, hardware PCF", .shader = true},
    {SI_FIELD(filter.size), .label = "Size", .unit = "texels", .min = 2, .max = 15, .cost = Cost::Program,
     .help = "Width of the kernel: comparisons, or texels that the weights span, along each axis. An even width is "
             "centred between texels.",
     .also = "kernel size, filter size, softness, PCF 3x3, 5x5, 7x7", .shader = true},
    {SI_FIELD(filter.point), .label = "Points", .cost = Cost::Program,
     .help = "Compares single texels, as the lectures write it by hand: size^2 + 1 grey levels. Off: each comparison "
             "blends 2x2 texels, and edges are without steps.",
     .shader = true},
    {SI_FIELD(filter.bilinear), .label = "Bilinear taps", .cost = Cost::Program,
     .help = "Blends 2x2 texels in each comparison, as a shadow sampler with linear filtering does in most engines. "
             "Edges are smoother. The kernel reaches half a texel farther, so it needs more bias. Off: each comparison "
             "takes the nearest texel.",
     .also = "linear shadow sampler, hardware PCF, sampler2DShadow", .shader = true},
    {SI_FIELD(filter.taps), .label = "Taps", .unit = "taps", .min = 1, .max = 4096, .logarithmic = true,
     .cost = Cost::Program,
     .help = "Number of places of the disk that are compared. Few of them show as steps in each edge, or as noise if "
             "each pixel rotates the disk. The Poisson table ends at 64.",
     .also = "samples, sample count, SampleCount, filter samples", .shader = true},
    {SI_FIELD(filter.radius), .label = "Radius", .unit = "filter.radius_unit", .min = 0, .max = 32, .logarithmic = true,
     .help = "Radius of the disk of taps. A wider kernel is softer and needs more bias.",
     .also = "softness, filter radius, shadow radius, shadow blur, shadow.radius, shadow filter sharpen",
     .shader = true},
    {SI_FIELD(filter.radius_unit), .label = "Radius unit", .cost = Cost::Program, SI_CHOICES(kRadiusUnits),
     .help = "The unit of filter.radius. In metres the shadow is equally soft at any resolution and at any distance "
             "from a spot or point light.",
     .shader = true},
    {SI_FIELD(filter.rotate), .label = "Rotate per pixel", .cost = Cost::Program,
     .help = "Rotates the disk of taps by an angle for each pixel: noise in place of the steps of few taps. Off: the "
             "same taps everywhere.",
     .also = "jitter, dither, random rotation, noise, interleaved gradient noise", .shader = true},
    {SI_FIELD(filter.disk), .label = "Sample pattern", .cost = Cost::Program, SI_CHOICES(kDisks),
     .help = "The places of the disk that are searched and compared.", .shader = true},
    {SI_FIELD(filter.blocker_taps), .label = "Blocker taps", .unit = "taps", .min = 1, .max = 4096, .logarithmic = true,
     .cost = Cost::Program,
     .help = "Number of texels that are searched for casters between surface and light. The casters' mean distance "
             "gives the penumbra's width. Without a caster the surface is lit.",
     .also = "blocker search samples, blocker samples", .shader = true},
    {SI_FIELD(filter.max_radius), .label = "Max radius", .unit = "texels", .min = 1, .max = 64, .logarithmic = true,
     SI_IDLE(!filter_of(s).reads_light_size && s.filter.radius_unit == RadiusUnit::Texels,
             "without effect: filter.radius itself is in texels"),
     .help = "Maximum reach of the kernel to each side: search, penumbra, or a radius in metres. Wider penumbrae "
             "become too narrow. The bias must suffice for this reach.",
     .also = "penumbra limit, max penumbra", .shader = true},
    {SI_FIELD(filter.rays), .label = "Rays", .unit = "rays", .min = 1, .max = 4096, .logarithmic = true,
     .cost = Cost::Program,
     .help = "Number of rays to places of the light. Few rays show as noise, or as steps if filter.rotate is off.",
     .also = "SMRT ray count, samples", .shader = true},
    {SI_FIELD(filter.steps), .label = "Steps", .unit = "steps", .min = 1, .max = 64, .logarithmic = true,
     .cost = Cost::Program,
     .help = "Number of texels compared along each ray through the widest penumbra. Steps wider than a caster make its "
             "shadow too narrow or ragged.",
     .shader = true},
    {SI_FIELD(filter.thickness), .label = "Thickness", .unit = "m", .min = 0, .max = 100, .logarithmic = true,
     .help = "Assumed thickness of the surfaces in the map. A ray through the map that passes farther behind a surface "
             "continues. Too small a thickness lets light leak through solid objects. Too large a thickness widens the "
             "shadows of thin objects.",
     .shader = true},
    {SI_FIELD(filter.blur), .label = "Blur", .unit = "texels", .min = 0, .max = 32, .cost = Cost::Target,
     .help = "The moments of each texel become the mean of the moments up to this many texels away, along x and y. "
             "The map is blurred once, however many pixels read it. With 0 only bilinear sampling blends 2x2 texels.",
     .also = "blur radius, softness, blurSamples, blurWidth, shadow.blurSamples", .shader = true,
     .read_by = ReadBy::Moments},
    {SI_FIELD(filter.bleed), .label = "Light-bleed reduction", .min = 0, .max = 0.99,
     .help = "Visibility below this share counts as shadow, and the remainder is stretched to 0 to 1. Removes light "
             "that leaks in where shadows overlap, and hardens every edge.",
     .also = "light bleeding, lightBleedReduction, bleed bias, light leaking", .shader = true},
    {SI_FIELD(filter.min_variance), .label = "Minimum variance", .unit = "range^2", .min = 0, .max = 0.01,
     .logarithmic = true,
     .help = "Minimum variance of every texel, in squares of the map's depth range. It covers rounding: too little "
             "leaves acne, too much lets light in near contacts.",
     .also = "minVarianceScale, variance bias, vsmBias", .shader = true},
    {SI_FIELD(filter.blur_shape), .label = "Blur shape", .cost = Cost::Program, SI_CHOICES(kBlurShapes),
     SI_IDLE(s.filter.blur == 0, "without effect: filter.blur is 0"), .help = "The weights of the blur's texels.",
     .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.mips), .label = "Mip levels", .cost = Cost::Program,
     .help = "Coarser copies of the moments, blended by the pixel's footprint in the map: distant shadows turn soft "
             "instead of noisy. A third more memory.",
     .also = "mipmaps, mipmapping", .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.anisotropy), .label = "Anisotropy", .unit = "samples", .min = 1, .max = 16, .logarithmic = true,
     SI_IDLE(!s.filter.mips, "without effect: filter.mips is off"),
     .help = "Most samples along the footprint's long side, in grazing light or in a grazing view: less blur across "
             "it. A value beyond the driver's limit is reported, and the limit is used.",
     .shader = true},
    {SI_FIELD(filter.moment_format), .label = "Moments", .cost = Cost::Program, SI_CHOICES(kMomentFormats),
     .help = "The storage of each moment.", .also = "highPrecision", .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.exponent), .label = "Exponent", .min = 0.5, .max = 88, .logarithmic = true,
     .help = "The exponent c of e^(c x), where x runs from -1 at the near plane to 1 at the far plane. A higher "
             "exponent reduces light bleeding and sharpens contacts. The stored format limits it: in 32 bits to 87.3 "
             "for esm and 43.6 for evsm, less with a blur. In 16 bits the limits are 11 and 5.54. A value beyond the "
             "limit is reported, and the limit is used.",
     .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.negative_exponent), .label = "Negative exponent", .min = 0.5, .max = 88, .logarithmic = true,
     .help = "d of -e^(-d x), the second warp. It separates near casters, and darkens slopes if it is high. Limits as "
             "filter.exponent.",
     .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.moment_bias), .label = "Moment bias", .min = 0, .max = 0.1, .logarithmic = true,
     .help = "Share by which each moment is blended with one half. A share of about 3e-6 covers rounding in 32 bits, "
             "and 3e-5 in 16 bits. Rounding leaves moments that no depths can have. Too small a share leaves noise. "
             "Too large a share lets light bleed in.",
     .shader = true},
    {SI_FIELD(filter.sums), .label = "Table", .cost = Cost::Program, SI_CHOICES(kSums),
     .help = "The number type of the summed-area table.", .shader = true, .read_by = ReadBy::Moments},
    {SI_FIELD(filter.window), .label = "Window", .unit = "texels", .min = 1, .max = 32, .logarithmic = true,
     .help = "Width of the square of texels that each look-up averages; any number costs the same.", .shader = true},
    {SI_FIELD(filter.footprint), .label = "Widen by footprint", .cost = Cost::Program,
     .help = "Widens the window to the pixel's footprint where that spans more texels, up to 32.", .shader = true},
}));
static_assert(kFilter.size() == member_count<FilterSettings>(), "a member of FilterSettings has no row");

}  // namespace

std::vector<Param> shadow_rows() {
    return joined(kMap, kCaster, kBias, kFilter);
}

}  // namespace si
