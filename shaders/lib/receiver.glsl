// Receiver: data of one fragment for one light, for kernels and overlays.
#include "lib/frame.glsl"
#include "lib/depth.glsl"
#include "lib/shadow_map.glsl"
#include "lib/view_choice.glsl"
#include "shared/facing.h"

const int INSIDE = 0, OUTSIDE_SIDES = 1, OUTSIDE_FAR = 2, BEHIND = 3, NO_MAP = 4;
const int OUTSIDE_CASTER_REGION = 5;  // outside the caster region of the light's fit: always lit

/// Visible surface at a pixel, independent of lights.
struct Surface {
    vec3 position;   // relative to the frame's origin, metres
    vec3 geometric;  // unit normal of the triangle, towards the camera
    vec3 vertex;     // unit interpolated normal, same side
    vec3 shading;    // interpolated normal with the normal map
    vec3 to_eye;     // unit
    vec2 pixel;      // centre of the pixel, in the picture
    bool receives;
#ifdef TRIANGLE_CORNERS
    vec3 corners[3];  // of the triangle, relative to the frame's origin
#endif
    bool in_map;     // its face is drawn into maps: neither culled nor of an object that casts nothing
#if BIAS_BY_DERIVATIVES
    vec3 step_x, step_y;  // change of position to the next pixel to the right and above, metres
#endif
};

/// One look-up: surface, light, place in the map, bias and compared depth.
struct Receiver {
    Surface surface;
    int light;
    int layer;          // layer of the shadow map array
    int other_layer;    // layer whose visibility is blended in
    float blend;        // weight of other_layer
    vec3 to_light;      // unit
    float distance_m;   // distance to a spot or point light; 0 for a directional light
    float n_dot_l;      // cosine between the light and the normal of bias.normal_source
    float geometric_n_dot_l;
    vec3 uvd;           // map coordinates, depth without bias
    vec3 uvd_offset;    // map coordinates and depth after the normal offset
    float w;
    float texel_m;      // world size of a texel here, along its longest direction
    float texel_short_m;  // size along the shortest direction; differs from texel_m if LIGHT_WARPED
    float relative_dw_per_m;   // relative change of w per metre across the rays if LIGHT_WARPED; else 0
    mat2 disk;          // if LIGHT_WARPED or LIGHT_STRETCHED: maps a disk across the rays to the map, in texel_short_m
    float z;            // distance along the axis from a perspective light, metres above 0; else 1
    float depth_per_m;  // |d depth / d metres along the axis| here
    float bias_depth;   // applied depth bias, depth-buffer units; >= 0 shifts towards the light
    float reference;    // compared depth; with BIAS_PER_TEXEL the one at uvd_offset
#if BIAS_PER_TEXEL
    vec2 reference_slope;  // change of the compared depth per map width
#endif
#if BIAS_HAS_REMAINDER
    float remainder;  // further bias of a tap per texel of its distance from uvd_offset; 0: the plane alone
#endif
    int where;
};

/// Signs a depth distance away from the light: negative under reversed depth.
float away_from_light(float depth_distance) {
#if map_reversed_z
    return -depth_distance;
#else
    return depth_distance;
#endif
}

/// Returns the unit vector to the light, and the distance: 0 for directional lights.
vec3 direction_to(int index, vec3 position, out float distance_m) {
    LightBlock light = light_of(index);
    int type = LIGHT_TYPE[index];
    if (type == LIGHT_DIRECTIONAL) {
        distance_m = 0.0;
        return light.to_light.xyz;
    }
    vec3 d = light.position.xyz - position;
    distance_m = length(d);
    return distance_m > 0.0 ? d / distance_m : light.to_light.xyz;
}

bool faces_light(Receiver r) { return r.geometric_n_dot_l > FACES_AWAY_COSINE; }
bool faces_light(Surface s, vec3 to_light) { return dot(s.geometric, to_light) > FACES_AWAY_COSINE; }
bool faces_light(Surface s, int light) {
    float distance_m;
    return faces_light(s, direction_to(light, s.position, distance_m));
}

const float NEAREST_SHARE = 1e-3;  // least distance from a perspective light, as a share of the near plane's

/// Converts a shift towards the light along the axis, metres, of a point at z to a change of depth;
/// DepthCurve::depth_change_towards_light(). The slope at the receiver is not enough, since depth rises faster near a perspective light.
/// @param nearest least distance along the axis, metres
/// @param own_z distance of the receiver with slope depth_per_m
float depth_change_towards_light(bool perspective, float nearest, float own_z, float depth_per_m, float z, float metres) {
    float moved = perspective ? min(metres, z - nearest) : metres;
    float steeper = perspective ? (own_z / z) * (own_z / (z - moved)) : 1.0;
    return moved * depth_per_m * steeper;
}

/// Converts a depth at a place of r's map to metres along the light's axis.
float metres_at(Receiver r, vec2 at, float depth) {
    if (LIGHT_WARPED[r.light] != 0)
        return metres_in_row(depth, view_of(r.layer).warp, at.y, map_reversed_z != 0);
    vec2 curve = view_of(r.layer).curve.xy;
    return metres_from_depth(depth, curve.x, curve.y, LIGHT_PERSPECTIVE[r.light] != 0);
}

/// Returns the distance of the map's near plane along the axis at a place of the map, metres.
float near_plane_m(Receiver r, vec2 at) {
    return LIGHT_WARPED[r.light] != 0 ? metres_at(r, at, float(map_reversed_z)) : view_of(r.layer).curve.x;
}

float nearest_z(Receiver r) { return NEAREST_SHARE * view_of(r.layer).curve.x; }

/// Converts a shift of a point at z towards r's light, metres, to a change of depth.
float depth_change_towards_light(Receiver r, float z, float metres) {
    return depth_change_towards_light(LIGHT_PERSPECTIVE[r.light] != 0, nearest_z(r), r.z, r.depth_per_m, z, metres);
}

/// Converts a change of depth at r to a shift towards the light along the axis, metres; DepthCurve::metres_towards_light().
float metres_towards_light(Receiver r, float depth) {
    float by_slope = depth / r.depth_per_m;
    if (LIGHT_PERSPECTIVE[r.light] == 0) return by_slope;
    float left = 1.0 + by_slope / r.z;
    return left > 0.0 ? by_slope / left : -uintBitsToFloat(0x7f800000u);
}

/// Converts a change of depth at r to a shift towards the light in texels (bias.unit).
float texels_nearer(Receiver r, float depth) { return metres_towards_light(r, depth) / r.texel_m; }

/// Returns the unit normal of bias.normal_source.
vec3 bias_normal_of(Surface s) {
#if bias_normal_source == bias_normal_source_mapped
    return s.shading;
#elif bias_normal_source == bias_normal_source_shading
    return s.vertex;
#else
    return s.geometric;
#endif
}

#include "lib/bias.glsl"
#include "biases/normal_offset.glsl"

/// Returns homogeneous map coordinates and depth of a position relative to the frame's origin.
vec4 uvd_from_world(ViewBlock view, vec3 position) { return view.uvd_from_relative * vec4(position, 1.0); }

/// Returns homogeneous map coordinates and depth by the texture matrix T from eye space. Everitt, Rege, Cebenoyan, Hardware Shadow Mapping, 2001.
vec4 uvd_from_eye(ViewBlock view, vec3 position) {
    mat4 t = view.uvd_from_relative * frame.relative_from_eye;
    return t * (frame.eye_from_relative * vec4(position, 1.0));
}

/// Fills texel sizes, disk and slopes of a receiver in a warped view, by the quotient rule on the view's matrix;
/// LightView::texel_size_at() and relative_dw_per_m().
void find_warped_texel(inout Receiver r, vec4 h, ViewBlock view) {
    mat4 m = transpose(view.uvd_from_relative);
    vec3 u = (m[0].xyz - h.x / h.w * m[3].xyz) / h.w, v = (m[1].xyz - h.y / h.w * m[3].xyz) / h.w;
    u *= MAP_SHAPE.x;
    v *= MAP_SHAPE.y;
    float a = dot(u, u), b = dot(u, v), c = dot(v, v);
    float larger = sqrt(0.5 * (a + c + sqrt((a - c) * (a - c) + 4.0 * b * b)));
    vec3 up = v * inversesqrt(c), right = cross(up, r.to_light);
    r.disk = mat2(dot(u, right), 0.0, dot(u, up), dot(v, up)) / larger;
    r.texel_m = 1.0 / (abs(r.disk[0].x * r.disk[1].y) * larger * float(map_resolution));
    r.texel_short_m = 1.0 / (larger * float(map_resolution));
    r.relative_dw_per_m = length(m[3].xyz) / h.w;
    r.depth_per_m = abs(dot(m[2].xyz, r.to_light)) / h.w;
}

/// Returns the receiver of a surface in one view of a light.
/// @param layer layer of the view in the shadow map array
Receiver receiver_in(Surface s, int index, int layer) {
    Receiver r;
    r.surface = s;
    r.light = index;
    r.to_light = direction_to(index, s.position, r.distance_m);
    r.geometric_n_dot_l = dot(s.geometric, r.to_light);
    vec3 bias_normal_ws = bias_normal_of(s);
    r.n_dot_l = dot(bias_normal_ws, r.to_light);
    r.layer = r.other_layer = layer;
    r.blend = 0.0;
    ViewBlock view = view_of(r.layer);

#if map_transform == map_transform_eye
    vec4 h = uvd_from_eye(view, s.position);
#else
    vec4 h = uvd_from_world(view, s.position);
#endif
    bool divides = LIGHT_PERSPECTIVE[index] != 0 || LIGHT_WARPED[index] != 0;
    if (!divides) h.w = 1.0;  // constant, so that the division below is removed
    r.w = h.w;
    float near = view.curve.x, far = view.curve.y;
    bool perspective = LIGHT_PERSPECTIVE[index] != 0;
    r.z = perspective ? max(h.w, NEAREST_SHARE * near) : 1.0;
    r.texel_m = r.texel_short_m = divides ? 2.0 * view.curve.z * r.z * view.curve.w : view.span.z;
    r.relative_dw_per_m = 0.0;
    r.depth_per_m = perspective ? near * far / ((far - near) * r.z * r.z) : view.span.w;

    if (LIGHT_WARPED[index] != 0) find_warped_texel(r, h, view);
    if (LIGHT_STRETCHED[index] != 0) {
        r.texel_short_m = r.texel_m * min(view.span.z, view.span.w);
        r.disk = mat2(view.span.z, 0.0, 0.0, view.span.w);
    }

    vec4 o = h;
    float offset_z = r.z;
#if BIAS_NORMAL_OFFSET
    o += view.uvd_from_relative * vec4(normal_offset(bias_normal_ws, r.to_light, r.texel_m), 0.0);
    if (!divides) o.w = 1.0;
    offset_z = perspective ? max(o.w, NEAREST_SHARE * near) : 1.0;
#endif

    r.uvd = h.xyz / h.w;
    r.uvd_offset = o.xyz / o.w;
    BiasInput b = bias_input(r, r.n_dot_l, offset_z);
    r.bias_depth = depth_bias(b);
    r.reference = r.uvd_offset.z - away_from_light(r.bias_depth);
#if BIAS_PER_TEXEL
    r.reference_slope = reference_slope(b);
#endif
#if BIAS_HAS_REMAINDER
    r.remainder = remainder_per_texel(b);
#endif

    // Share of the map's longer side, and of each side.
    vec2 texel = (LIGHT_CHOICE[index] == CHOICE_ONE ? view.span.x : view.curve.w) / MAP_SHAPE;
    if (LIGHT_CASTS[index] == 0)
        r.where = NO_MAP;
    else if (!(h.w > 0.0) || !(o.w > 0.0))
        r.where = BEHIND;
    else if (LIGHT_CLOSED[index] != 0 && (any(lessThan(r.uvd.xy, texel)) ||
                                          any(greaterThan(r.uvd.xy, 1.0 - texel))))
        r.where = OUTSIDE_CASTER_REGION;
    else if (away_from_light(r.uvd.z) > away_from_light(1.0 - float(map_reversed_z)))
        r.where = OUTSIDE_FAR;
    else if (any(lessThan(r.uvd.xy, vec2(0.0))) || any(greaterThan(r.uvd.xy, vec2(1.0))))
        r.where = OUTSIDE_SIDES;
    else
        r.where = INSIDE;
    return r;
}

/// Returns the receiver of a surface in the view of choose_view(), or in a coarser view if its page replaces a missing one.
Receiver make_receiver(Surface s, int index) {
    ViewPick pick = choose_view(index, s.position);
#if MAP_PAGED && !defined(MARK_PAGES)
    if (LIGHT_VIEWS[index] > 1) {
        int layer = LIGHT_FIRST_VIEW[index] + pick.view;
        vec4 at = view_of(layer).uvd_from_relative * vec4(s.position, 1.0);
        int up = entry_coarser(page_entry_at(at.xy / at.w, layer));
        if (up > 0) pick = ViewPick(pick.view + up, pick.view + up, 0.0);
    }
#endif
    Receiver r = receiver_in(s, index, LIGHT_FIRST_VIEW[index] + pick.view);
    r.other_layer = LIGHT_FIRST_VIEW[index] + pick.other;
    r.blend = pick.share;
    return r;
}
