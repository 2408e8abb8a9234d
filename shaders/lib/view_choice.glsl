// Which of a light's views a point is looked up in: renderer/view/view_choice.h in single precision. LIGHT_CHOICE is known
// when the program is made, so what no light of the scene needs costs nothing.
#include "lib/frame.glsl"

const int CHOICE_ONE = 0, CHOICE_FACE = 1;

/// Of the faces +x -x +y -y +z -z the one that a direction leads into.
int face_of(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0.0 ? 2 : 3;
    return d.z >= 0.0 ? 4 : 5;
}

/// Counted among the light's views. @param position relative to the frame's origin
int choose_view(int light, vec3 position) {
    return LIGHT_CHOICE[light] == CHOICE_FACE ? face_of(position - frame.lights[light].position.xyz) : 0;
}
