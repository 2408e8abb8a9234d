// Visibility of one light as a separate picture, from the light's source.
#include "lib/surface.glsl"
#include "lib/visibility.glsl"

#include SOURCE_FILE

layout(location = 0) out float visibility_out;

void main() {
    discard_masked();
    visibility_out = source_visibility(make_surface(), LIGHT_INDEX);
}
