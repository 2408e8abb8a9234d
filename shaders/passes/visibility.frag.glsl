// Visibility of one light as a picture of its own.
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

layout(location = 0) out float visibility_out;

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
    visibility_out = light_visibility(make_surface(), LIGHT_INDEX);
}
