// Choice of a light's view for a point: renderer/projection/view_choice.h in single precision. LIGHT_CHOICE and LIGHT_VIEWS
// are constants, so that code that no light needs is removed.
#include "lib/frame.glsl"

const int CHOICE_ONE = 0, CHOICE_FACE = 1, CHOICE_INTERVAL = 2, CHOICE_MAP = 3, CHOICE_DISTANCE = 4;

/// Chosen view, counted among the light's views, and a second view `other` that is blended in by `share`. Without a blend
/// `other` equals `view`.
struct ViewPick {
    int view, other;
    float share;
};

/// Returns the cube face of a direction, in the order +x -x +y -y +z -z.
int face_of(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0.0 ? 2 : 3;
    return d.z >= 0.0 ? 4 : 5;
}

/// Returns the quantity that a view's span limits: camera depth, distance from the camera, or the larger distance from the
/// map's centre in map coordinates.
float along_span(int light, int layer, vec3 position) {
    if (LIGHT_CHOICE[light] == CHOICE_INTERVAL) return dot(position - frame.divided_eye.xyz, frame.divided_forward.xyz);
    if (LIGHT_CHOICE[light] == CHOICE_DISTANCE) return distance(position, frame.divided_eye.xyz);
    vec4 h = view_of(layer).uvd_from_relative * vec4(position, 1.0);
    if (LIGHT_WARPED[light] != 0 && !(h.w > 0.0)) return 3e38;
    vec3 uvd = LIGHT_WARPED[light] != 0 ? h.xyz / h.w : h.xyz;  // parallel rays
    vec2 aside = abs(uvd.xy - 0.5);
    return uvd.z >= 0.0 && uvd.z <= 1.0 ? max(aside.x, aside.y) : 3e38;
}

/// Returns the view of a light in which a point is looked up.
/// @param position relative to the frame's origin, metres
ViewPick choose_view(int light, vec3 position) {
    if (LIGHT_CHOICE[light] == CHOICE_ONE) return ViewPick(0, 0, 0.0);
    if (LIGHT_CHOICE[light] == CHOICE_FACE) {
        int face = face_of(position - light_of(light).position.xyz);
        return ViewPick(face, face, 0.0);
    }
    int last = LIGHT_VIEWS[light] - 1;
    ViewPick pick = ViewPick(last, last, 0.0);
    bool held = false;
    for (int i = last; i >= 0; --i) {
        int layer = LIGHT_FIRST_VIEW[light] + i;
        vec2 span = view_of(layer).span.xy;
        float at = along_span(light, layer, position);
        if (at < span.x) {
            bool blends = held && at > span.y;
            pick = ViewPick(i, blends ? pick.view : i, blends ? (at - span.y) / (span.x - span.y) : 0.0);
            held = true;
        }
    }
    return pick;
}
