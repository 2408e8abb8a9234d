// Writes a small bundle to the folder that the command line names. It is compiled as C99, C11 and C++, and with a
// decimal comma, and all write the same bytes.
#include <stdio.h>

#ifdef SB_TEST_COMMA
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

// Prints and reads numbers as a locale with a decimal comma does.
static int comma_snprintf(char* out, size_t size, const char* format, ...) {
    va_list arguments;
    int length;
    char* point;
    va_start(arguments, format);
    length = vsnprintf(out, size, format, arguments);
    va_end(arguments);
    for (point = strchr(format, 'g') != NULL ? strchr(out, '.') : NULL; point != NULL; point = strchr(point, '.'))
        *point = ',';
    return length;
}
static double comma_strtod(const char* text, char** end) {
    char copy[64];
    char* comma = strchr(strcpy(copy, text), ',');
    (void)end;
    if (comma != NULL) *comma = '.';
    return strtod(copy, NULL);
}
#define snprintf comma_snprintf
#define strtod comma_strtod
#endif

#define SHADOW_BUNDLE_IMPLEMENTATION
#include "assets/bundle/shadow_bundle.h"

int main(int count, char** words) {
    static const float corners[12] = {-1.5f, 0, -1.5f, 1.5f, 0, -1.5f, 1.5f, 0, 1.5f, -1.5f, 0, 1.5f};
    static const uint16_t triangles[6] = {0, 2, 1, 0, 3, 2};
    static const float depths[4] = {0.25f, 0.5f, 0.1f, 1};
    static const float place[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1f, -2.5f, 1e-20f, 1};
    static const double clip[16] = {0.1, 0, 0, 0, 0, 0, -1.0 / 3, 0, 0, 0.5, 0, 0, 0, 0, 0.75, 1};
    static const uint8_t pixels[8] = {255, 0, 0, 255, 0, 128, 0, 255};
    shadow_bundle* sb = count == 2 ? sb_begin(words[1], "write_bundle") : NULL;
    sb_mesh_data mesh;
    sb_image_data image;
    char message[512];
    int light, map, instance;
    if (sb == NULL) return 2;
    memset(&mesh, 0, sizeof mesh);
    mesh.positions = corners;
    mesh.vertex_count = 4;
    mesh.indices16 = triangles;
    mesh.index_count = 6;
    mesh.colour[0] = 0.7f;
    instance = sb_instance(sb, sb_mesh(sb, &mesh), sb_columns_f(place), "Ground", SB_RECEIVES);
    sb_camera(sb, sb_columns_d(clip), 640, 360, SB_RANGE_MINUS_1_TO_1, 0);
    light = sb_light(sb, "sun", SB_DIRECTIONAL);
    sb_light_direction(sb, light, 0.5, -1, 0.25);
    sb_lookup_bias(sb, light, SB_BIAS_CONSTANT, 0.0005, SB_UNIT_DEPTH);
    memset(&image, 0, sizeof image);
    image.texels = depths;
    image.width = 2;
    image.height = 2;
    map = sb_map(sb, light, sb_image(sb, &image), sb_columns_d(clip), SB_RANGE_MINUS_1_TO_1, 0);
    sb_map_offset(sb, map, 1.5, 4, 0);
    sb_map_drawn(sb, map, &instance, 1);
    sb_picture(sb, pixels, 2, 1, 0, SB_FIRST_ROW_TOP);
    if (sb_end(sb, message, sizeof message) == SB_OK) return 0;
    (void)fprintf(stderr, "%s\n", message);
    return 1;
}
