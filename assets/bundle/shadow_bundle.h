// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Writer of bundles: one frame of an engine, with its scene, camera, lights and shadow maps, for Shadow Inspector.
// docs/bundle.md describes the format. The header needs C99 or C++11 and the C library alone.
//
// In one source file of the engine:
//
//     #define SHADOW_BUNDLE_IMPLEMENTATION
//     #include "shadow_bundle.h"
//
// At a key press, after the frame was drawn:
//
//     shadow_bundle *sb = sb_begin("frame1.bundle", "my engine 3.1");
//     sb_mesh_data box = {0};
//     box.positions = positions;          // three floats a vertex
//     box.vertex_count = 8;
//     box.indices32 = indices;            // a list of triangles
//     box.index_count = 36;
//     sb_instance(sb, sb_mesh(sb, &box), sb_columns_f(world), "Box", SB_CASTS | SB_RECEIVES);
//     sb_camera(sb, sb_columns_f(camera_clip_from_world), 1280, 720, SB_RANGE_0_TO_1, 0);
//     int sun = sb_light(sb, "sun", SB_DIRECTIONAL);
//     sb_image_data image = {0};
//     image.texels = depths;              // floats, the first row is the bottom of the map
//     image.width = image.height = 1024;
//     int map = sb_map(sb, sun, sb_image(sb, &image), sb_columns_f(light_clip_from_world), SB_RANGE_0_TO_1, 0);
//     sb_map_format(sb, map, SB_D32F);
//     sb_map_offset(sb, map, 2, 4, 0);
//     char message[512];
//     if (sb_end(sb, message, sizeof message) != SB_OK) fprintf(stderr, "%s\n", message);
//
// - All data is copied or written at once. No pointer has to stay valid after a call.
// - The first error is kept and all later calls do nothing, so that sb_end() alone needs a check.
// - Anything that no call states is unknown to the inspector. It is never taken as 0.
// - A bundle is whole once it has its frame.json, which is written last under another name and then renamed.
// - Positions, matrices, directions and places are in one space, the world of the engine. See sb_world().
// - A bundle is written by one thread at a time.
#ifndef SHADOW_BUNDLE_H
#define SHADOW_BUNDLE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bundle that is being written.
typedef struct shadow_bundle shadow_bundle;

/// Results of sb_end().
typedef enum { SB_OK, SB_BAD_INPUT, SB_NO_MEMORY, SB_FILE_ERROR } sb_code;

/// Matrix by columns: m[4 * column + row]. It multiplies columns: clip = M * position.
typedef struct {
    double m[16];
} sb_matrix;

/// Axis of the engine's world that points up.
typedef enum { SB_UP_X, SB_UP_Y, SB_UP_Z, SB_DOWN_X, SB_DOWN_Y, SB_DOWN_Z } sb_up;
/// Hand of the engine's world.
typedef enum { SB_RIGHT_HANDED, SB_LEFT_HANDED } sb_hand;
/// Clip z over w of the depth range: Vulkan, Direct3D and Metal have 0 to 1, OpenGL has -1 to 1 without glClipControl.
typedef enum { SB_RANGE_0_TO_1, SB_RANGE_MINUS_1_TO_1 } sb_range;
/// End of a map or picture that its first stored row shows: bottom is clip y = -1, top is clip y = +1.
typedef enum { SB_FIRST_ROW_BOTTOM, SB_FIRST_ROW_TOP } sb_first_row;
/// Type of a light.
typedef enum { SB_DIRECTIONAL, SB_SPOT, SB_POINT } sb_light_type;
/// Choice of the map that a point reads: the only one, the first that contains it, by camera depth, by cube face.
typedef enum { SB_CHOICE_ONE, SB_CHOICE_MAP, SB_CHOICE_INTERVAL, SB_CHOICE_FACE } sb_choice;
/// Number type of texels in memory. SB_U24 has its value in the low 24 bits of four bytes, as Vulkan and Direct3D copy
/// it. SB_U24_HIGH has it in the high 24 bits, as glReadPixels returns GL_UNSIGNED_INT_24_8.
typedef enum { SB_F32, SB_F16, SB_U16, SB_U24, SB_U24_HIGH, SB_U32 } sb_texel;
/// Storage of depth in the engine, for the step of depth.
typedef enum { SB_D16, SB_D24, SB_D32F, SB_R16F, SB_R32F } sb_format;
/// Meaning of a stored texel: see depth.stored in docs/bundle.md.
typedef enum {
    SB_STORED_DEPTH,
    SB_STORED_LINEAR,
    SB_STORED_AXIS_METRES,
    SB_STORED_DISTANCE_METRES,
    SB_STORED_DISTANCE_SHARE,
    SB_STORED_EXPONENTIAL,
    SB_STORED_MOMENTS
} sb_stored;
/// Faces that were not drawn into a map.
typedef enum { SB_CULL_NONE, SB_CULL_BACK, SB_CULL_FRONT } sb_cull;
/// Winding of front faces in the map's image.
typedef enum { SB_FRONT_CCW, SB_FRONT_CW } sb_front;
/// Term of the look-up's bias, and its unit.
typedef enum { SB_BIAS_CONSTANT, SB_BIAS_SLOPE, SB_BIAS_NORMAL } sb_bias_term;
typedef enum { SB_UNIT_DEPTH, SB_UNIT_TEXELS, SB_UNIT_METRES } sb_unit;
/// Dependence of the normal offset on the angle between normal and light: the whole offset along the normal, times the
/// sine of the angle, times 1 minus its cosine, or without the part along the light's ray.
typedef enum {
    SB_NORMAL_BY_LENGTH,
    SB_NORMAL_BY_SINE,
    SB_NORMAL_BY_ONE_MINUS_COSINE,
    SB_NORMAL_BY_SIDEWAYS
} sb_normal_by;
/// Comparison of own depth with the stored one, for lit.
typedef enum { SB_LESS, SB_LESS_EQUAL, SB_GREATER, SB_GREATER_EQUAL } sb_compare;
/// Sampler that reads the map.
typedef enum { SB_NEAREST, SB_LINEAR } sb_filter;
typedef enum { SB_BORDER, SB_CLAMP, SB_REPEAT } sb_wrap;

/// Flags of an instance.
enum { SB_CASTS = 1, SB_RECEIVES = 2 };

/// Mesh of triangles. Members that are 0 are left out.
typedef struct {
    const char* name;
    const float* positions;  ///< three floats a vertex, required
    size_t position_stride;  ///< bytes from a vertex to the next; 0: packed
    size_t vertex_count;
    const float* normals;  ///< three floats a vertex
    size_t normal_stride;
    const float* uv;  ///< two floats a vertex, for the mask
    size_t uv_stride;
    const uint16_t* indices16;  ///< list of triangles; without any indices the vertices are one
    const uint32_t* indices32;
    size_t index_count;
    float colour[3];           ///< linear; 0 0 0: light grey
    int two_sided;             ///< both sides of the surface are drawn in the picture
    const uint8_t* mask_rgba;  ///< texture whose alpha decides where the mesh is; its first row is shown at v = 0
    int mask_width, mask_height;
    size_t mask_row_bytes;  ///< 0: packed
    float mask_cutoff;      ///< alpha below it is a hole; 0: 0.5
    int mask_clamp;         ///< the texture is clamped; 0: it repeats
} sb_mesh_data;

/// Image of one map, or of several in an atlas.
typedef struct {
    const void* texels;
    sb_texel type;
    int width, height;
    size_t row_bytes;  ///< bytes from a row to the next; 0: packed. Direct3D 12 pads rows to 256 bytes.
    int channels;      ///< numbers a texel; 0: 1
    int channel;       ///< channel that holds depth
    sb_first_row first_row;
} sb_image_data;

/// Returns a matrix from 16 numbers by columns (OpenGL, glm, Vulkan, three.js) or by rows (many engines on Direct3D). A
/// matrix for row vectors, position * M, is the transposed one: by rows in memory it is read by columns.
sb_matrix sb_columns_f(const float* m);
sb_matrix sb_columns_d(const double* m);
sb_matrix sb_rows_f(const float* m);
sb_matrix sb_rows_d(const double* m);
/// Returns the product a * b, such as projection * view.
sb_matrix sb_multiply(sb_matrix a, sb_matrix b);

/// Begins a bundle. The folder is made and may not exist before; the folder above it exists. The name ends in .bundle.
/// Returns null where memory lacks. Other errors are kept for sb_end().
/// @param made_by program and version, or null
shadow_bundle* sb_begin(const char* folder, const char* made_by);
/// Returns the text of the first error; an empty text where there is none.
const char* sb_error(const shadow_bundle* sb);
/// Writes scene.glb and then frame.json, and frees the bundle. @param message receives the text of an error, or null
sb_code sb_end(shadow_bundle* sb, char* message, size_t message_size);
/// Frees a bundle without frame.json. Files that are written already stay.
void sb_cancel(shadow_bundle* sb);

/// States how the engine's world lies. Without it: y up, right-handed, metres.
/// @param origin place of the world's origin, three numbers, where an engine draws relative to its camera; or null
void sb_world(shadow_bundle* sb, sb_up up, sb_hand hand, double metres_per_unit, const double* origin);
/// Adds a mesh and returns its number; -1 after an error.
int sb_mesh(shadow_bundle* sb, const sb_mesh_data* mesh);
/// Places a mesh in the world and returns the number of the instance; -1 after an error. Equal names get a number.
/// @param name text, or null @param flags SB_CASTS, SB_RECEIVES, both or 0
int sb_instance(shadow_bundle* sb, int mesh, sb_matrix world_from_mesh, const char* name, unsigned flags);
/// States the camera of the picture. @param reversed the near plane is stored as 1
void sb_camera(shadow_bundle* sb, sb_matrix clip_from_world, int width, int height, sb_range range, int reversed);
/// Writes the engine's picture as a PNG of 8 bits. @param row_bytes bytes from a row to the next; 0: packed
void sb_picture(shadow_bundle* sb, const uint8_t* rgba, int width, int height, size_t row_bytes, sb_first_row first);
/// Adds a remark, a sentence.
void sb_note(shadow_bundle* sb, const char* text);

/// Adds a light and returns its number; -1 after an error. @param name text, or null
int sb_light(shadow_bundle* sb, const char* name, sb_light_type type);
/// States in which direction a light shines, of any length.
void sb_light_direction(shadow_bundle* sb, int light, double x, double y, double z);
/// States the place of a spot or point light.
void sb_light_position(shadow_bundle* sb, int light, double x, double y, double z);
/// States the full outer angle of a spot light's cone.
void sb_light_cone(shadow_bundle* sb, int light, double degrees);
/// States which map of a light a point reads.
void sb_light_choice(shadow_bundle* sb, int light, sb_choice choice);

/// States a term of the bias of a light's look-up, and its unit. An engine without a term states 0.
void sb_lookup_bias(shadow_bundle* sb, int light, sb_bias_term term, double amount, sb_unit unit);
/// States what the angle does to the normal offset. Without a call it is SB_NORMAL_BY_LENGTH.
void sb_lookup_normal_by(shadow_bundle* sb, int light, sb_normal_by by);
/// States the kernel of the inspector that is nearest to the engine's, such as "hard" or "pcf3": see docs/settings.md.
void sb_lookup_kernel(shadow_bundle* sb, int light, const char* kernel);
/// States which comparison of own depth with the stored one is lit.
void sb_lookup_compare(shadow_bundle* sb, int light, sb_compare compare);
/// States how the sampler reads texels and wraps outside the map.
void sb_lookup_sampler(shadow_bundle* sb, int light, sb_filter filter, sb_wrap wrap);
/// Writes the source text of the look-up, which is shown as text.
void sb_lookup_shader(shadow_bundle* sb, int light, const char* source);

/// Writes an image of depths and returns its number; -1 after an error. Maps of an atlas share one image.
int sb_image(shadow_bundle* sb, const sb_image_data* image);
/// Adds a map to a light, in the order of its choice, and returns its number; -1 after an error. Cube faces come as +x,
/// -x, +y, -y, +z, -z. @param reversed the near plane is stored as 1
int sb_map(shadow_bundle* sb, int light, int image, sb_matrix clip_from_world, sb_range range, int reversed);
/// States the part of an atlas that is this map, in texels from the image's first stored row and its left side.
void sb_map_region(shadow_bundle* sb, int map, int x, int y, int width, int height);
/// States the engine's storage of depth. Without it integers and half floats say their own.
void sb_map_format(shadow_bundle* sb, int map, sb_format format);
/// States the meaning of a stored texel. @param parameter range in metres of SB_STORED_DISTANCE_SHARE, exponent of
/// SB_STORED_EXPONENTIAL, else 0
void sb_map_stored(shadow_bundle* sb, int map, sb_stored stored, double parameter);
/// States the stored value of texels without a caster.
void sb_map_clear(shadow_bundle* sb, int map, double value);
/// States the polygon offset while casters were drawn. An engine without one states 0, 0, 0.
void sb_map_offset(shadow_bundle* sb, int map, double factor, double units, double clamp);
/// States how far the casters' shader moved them along the map's axis, away from the light.
/// @param shift_m metres at any angle @param grazing_shift_m metres times 1 - |n . axis|, with the vertex's normal
void sb_map_caster_shift(shadow_bundle* sb, int map, double shift_m, double grazing_shift_m);
/// States which faces of casters were not drawn.
void sb_map_cull(shadow_bundle* sb, int map, sb_cull cull, sb_front front);
/// States whether casters before the near plane were drawn onto it.
void sb_map_depth_clamp(shadow_bundle* sb, int map, int on);
/// States between which camera depths a point reads this cascade: metres along the view.
void sb_map_interval(shadow_bundle* sb, int map, double from, double to);
/// States which instances were drawn into this map. @param instances numbers of sb_instance()
void sb_map_drawn(shadow_bundle* sb, int map, const int* instances, size_t count);

#ifdef __cplusplus
}
#endif
#endif  // SHADOW_BUNDLE_H

#if defined(SHADOW_BUNDLE_IMPLEMENTATION) && !defined(SHADOW_BUNDLE_IMPLEMENTED)
#define SHADOW_BUNDLE_IMPLEMENTED

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <direct.h>
#else
#include <sys/stat.h>
#include <sys/types.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define SB_MOST_LIGHTS 16
#define SB_MOST_MAPS 16
#define SB_MOST_TEXELS 16384
#define SB_MOST_NAME_BYTES 200
#define SB_MOST_JSON_BYTES ((size_t)4 << 20)
#define SB_COUNT(names) ((int)(sizeof(names) / sizeof((names)[0])))

typedef struct {
    char* data;
    size_t size, capacity;
} sb_buffer;

/// Number that may be unknown.
typedef struct {
    int known;
    double value;
} sb_number;

/// Choice among names that may be unknown.
typedef struct {
    int known;
    int value;
} sb_option;

typedef struct {
    char* name;
    sb_light_type type;
    int has_direction, has_position;
    double direction[3], position[3];
    sb_number cone_deg;
    sb_option choice;
    int maps[SB_MOST_MAPS];
    int map_count;
    sb_number bias[3];
    int bias_units[3];
    int normal_by;
    char* kernel;
    sb_option compare, filter, wrap;
    int has_shader;
} sb_light_state;

typedef struct {
    int width, height, channels, channel;
    sb_texel type;
    sb_first_row first_row;
} sb_image_state;

typedef struct {
    int light, image;
    sb_matrix clip_from_world;
    sb_range range;
    int reversed, has_region;
    int region[4];
    sb_option format;
    sb_stored stored;
    double stored_parameter;
    sb_number clear;
    int has_offset, has_shift;
    double offset[3], shift_m[2];
    sb_option cull, front, depth_clamp;
    int has_interval, has_drawn;
    double interval[2];
    int* drawn;
    size_t drawn_count;
} sb_map_state;

struct shadow_bundle {
    char *folder, *made_by;
    sb_code code;
    char message[512];
    sb_buffer bin;                                                                      ///< binary chunk of scene.glb
    sb_buffer views, accessors, images, textures, materials, meshes, nodes, suggested;  ///< elements of its JSON
    size_t view_count, accessor_count, texture_count, material_count;
    int mesh_count;
    char** names;        ///< of instances, each once
    size_t* name_slots;  ///< hash table of names: number of the instance + 1, or 0
    size_t name_capacity, slot_count, name_count;
    int has_world, has_camera, has_picture;
    sb_up up;
    sb_hand hand;
    double metres_per_unit, origin[3];
    sb_matrix camera;
    int camera_width, camera_height, camera_reversed;
    sb_range camera_range;
    sb_light_state lights[SB_MOST_LIGHTS];
    int light_count;
    sb_image_state* map_images;
    size_t image_count, image_capacity;
    sb_map_state* maps;
    size_t map_count, map_capacity;
    sb_buffer notes;
};

static const char* const sb_up_names[] = {"x", "y", "z", "-x", "-y", "-z"};
static const char* const sb_hand_names[] = {"right", "left"};
static const char* const sb_range_names[] = {"0..1", "-1..1"};
static const char* const sb_first_row_names[] = {"bottom", "top"};
static const char* const sb_type_names[] = {"directional", "spot", "point"};
static const char* const sb_choice_names[] = {"one", "map", "interval", "face"};
static const char* const sb_texel_names[] = {"f32", "f16", "u16", "u24", "u24", "u32"};
static const char* const sb_format_names[] = {"d16", "d24", "d32f", "r16f", "r32f"};
static const char* const sb_stored_names[] = {"depth",          "linear",      "axis-metres", "distance-metres",
                                              "distance-share", "exponential", "moments"};
static const char* const sb_cull_names[] = {"none", "back", "front"};
static const char* const sb_front_names[] = {"ccw", "cw"};
static const char* const sb_bias_names[] = {"constant", "slope", "normal"};
static const char* const sb_unit_names[] = {"depth", "texels", "metres"};
static const char* const sb_normal_by_names[] = {"length", "sine", "one-minus-cosine", "sideways"};
static const char* const sb_compare_names[] = {"less", "less-equal", "greater", "greater-equal"};
static const char* const sb_filter_names[] = {"nearest", "linear"};
static const char* const sb_wrap_names[] = {"border", "clamp", "repeat"};

/// Keeps the first error.
static void sb_fail(shadow_bundle* sb, sb_code code, const char* format, ...) {
    va_list arguments;
    if (sb->code != SB_OK) return;
    sb->code = code;
    va_start(arguments, format);
    (void)vsnprintf(sb->message, sizeof sb->message, format, arguments);
    va_end(arguments);
}

/// Returns whether a bundle takes further calls.
static int sb_open(const shadow_bundle* sb) {
    return sb != NULL && sb->code == SB_OK;
}

/// Returns `array` with room for `count` elements; unchanged after an error.
static void* sb_with_room(shadow_bundle* sb, void* array, size_t* capacity, size_t count, size_t element) {
    size_t wanted = *capacity > 0 ? *capacity : 16;
    void* grown;
    if (count <= *capacity) return array;
    while (wanted < count && wanted <= SIZE_MAX / 2 / element) wanted *= 2;
    grown = wanted < count ? NULL : realloc(array, wanted * element);
    if (grown == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks; write fewer meshes", sb->folder);
        return array;
    }
    *capacity = wanted;
    return grown;
}

static void sb_append(shadow_bundle* sb, sb_buffer* out, const void* data, size_t size) {
    if (sb->code != SB_OK || size == 0) return;
    if (size > SIZE_MAX - out->size) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks; write fewer meshes", sb->folder);
        return;
    }
    out->data = (char*)sb_with_room(sb, out->data, &out->capacity, out->size + size, 1);
    if (sb->code != SB_OK) return;
    memcpy(out->data + out->size, data, size);
    out->size += size;
}

static void sb_text(shadow_bundle* sb, sb_buffer* out, const char* text) {
    sb_append(sb, out, text, strlen(text));
}

static void sb_whole(shadow_bundle* sb, sb_buffer* out, size_t value) {
    char digits[24];
    size_t at = sizeof digits;
    do {
        digits[--at] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    sb_append(sb, out, digits + at, sizeof digits - at);
}

/// Appends a finite number with as few digits as read back as the same one. The locale's decimal sign becomes a point.
static void sb_real(shadow_bundle* sb, sb_buffer* out, double value) {
    static const int digits[] = {6, 9, 15, 16, 17};
    char text[64];
    const char* from = text;
    int i;
    for (i = 0; i < SB_COUNT(digits); ++i) {
        (void)snprintf(text, sizeof text, "%.*g", digits[i], value);
        if (strtod(text, NULL) == value) break;
    }
    while (*from != '\0') {
        if (strchr("0123456789+-eE", *from) != NULL) {
            sb_append(sb, out, from++, 1);
            continue;
        }
        sb_text(sb, out, ".");
        while (*from != '\0' && strchr("0123456789+-eE", *from) == NULL) ++from;
    }
}

static void sb_reals(shadow_bundle* sb, sb_buffer* out, const double* values, int count) {
    int i;
    sb_text(sb, out, "[");
    for (i = 0; i < count; ++i) {
        if (i > 0) sb_text(sb, out, ", ");
        sb_real(sb, out, values[i]);
    }
    sb_text(sb, out, "]");
}

/// Returns the length in bytes of the UTF-8 sequence at `text`; 0 where there is none.
static size_t sb_utf8_length(const char* text) {
    const unsigned char* p = (const unsigned char*)text;
    const size_t length = p[0] < 0x80                   ? 1
                          : p[0] >= 0xc2 && p[0] < 0xe0 ? 2
                          : p[0] >= 0xe0 && p[0] < 0xf0 ? 3
                          : p[0] >= 0xf0 && p[0] < 0xf5 ? 4
                                                        : 0;
    size_t i;
    for (i = 1; i < length; ++i)
        if ((p[i] & 0xc0) != 0x80) return 0;
    if ((p[0] == 0xe0 && p[1] < 0xa0) || (p[0] == 0xed && p[1] >= 0xa0)) return 0;
    if ((p[0] == 0xf0 && p[1] < 0x90) || (p[0] == 0xf4 && p[1] >= 0x90)) return 0;
    return length;
}

/// Appends a JSON string. Bytes that are no UTF-8 become question marks.
static void sb_string(shadow_bundle* sb, sb_buffer* out, const char* text) {
    char escape[8];
    sb_text(sb, out, "\"");
    while (*text != '\0') {
        const unsigned char c = (unsigned char)*text;
        const size_t length = sb_utf8_length(text);
        if (c == '"' || c == '\\') {
            sb_text(sb, out, "\\");
            sb_append(sb, out, text, 1);
        } else if (c == '\n') {
            sb_text(sb, out, "\\n");
        } else if (c == '\t') {
            sb_text(sb, out, "\\t");
        } else if (c < 32 || c == 127) {
            (void)snprintf(escape, sizeof escape, "\\u%04x", (unsigned)c);
            sb_text(sb, out, escape);
        } else if (length == 0) {
            sb_text(sb, out, "?");
        } else {
            sb_append(sb, out, text, length);
        }
        text += length > 0 ? length : 1;
    }
    sb_text(sb, out, "\"");
}

/// Appends a comma unless the buffer is empty.
static void sb_next(shadow_bundle* sb, sb_buffer* out) {
    if (out->size > 0) sb_text(sb, out, ",\n");
}

static char* sb_copy(shadow_bundle* sb, const char* text) {
    const size_t size = strlen(text) + 1;
    char* const copy = (char*)malloc(size);
    if (copy == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "memory lacks");
        return NULL;
    }
    memcpy(copy, text, size);
    return copy;
}

/// Returns whether a choice is one of its names.
static int sb_valid(shadow_bundle* sb, const char* function, int value, int count) {
    if (value >= 0 && value < count) return 1;
    sb_fail(sb, SB_BAD_INPUT, "%s: %d is none of the %d choices; pass one of the enumeration", function, value, count);
    return 0;
}

static int sb_all_finite(shadow_bundle* sb, const char* function, const double* values, int count) {
    int i;
    for (i = 0; i < count; ++i) {
        if (isfinite(values[i])) continue;
        sb_fail(sb, SB_BAD_INPUT, "%s: number %d is not finite; pass the values of the frame that was drawn", function,
                i);
        return 0;
    }
    return 1;
}

static int sb_is_clip_matrix(shadow_bundle* sb, const char* function, const sb_matrix* matrix) {
    int i;
    if (!sb_all_finite(sb, function, matrix->m, 16)) return 0;
    for (i = 0; i < 16; ++i)
        if (matrix->m[i] != 0) return 1;
    sb_fail(sb, SB_BAD_INPUT, "%s: the matrix is 0; pass the matrix of the frame that was drawn", function);
    return 0;
}

sb_matrix sb_columns_d(const double* m) {
    sb_matrix out;
    int i;
    for (i = 0; i < 16; ++i) out.m[i] = m[i];
    return out;
}

sb_matrix sb_columns_f(const float* m) {
    sb_matrix out;
    int i;
    for (i = 0; i < 16; ++i) out.m[i] = (double)m[i];
    return out;
}

static sb_matrix sb_transposed(sb_matrix a) {
    sb_matrix out;
    int i;
    for (i = 0; i < 16; ++i) out.m[i] = a.m[i % 4 * 4 + i / 4];
    return out;
}

sb_matrix sb_rows_d(const double* m) {
    return sb_transposed(sb_columns_d(m));
}

sb_matrix sb_rows_f(const float* m) {
    return sb_transposed(sb_columns_f(m));
}

sb_matrix sb_multiply(sb_matrix a, sb_matrix b) {
    sb_matrix out;
    int column, row, i;
    for (column = 0; column < 4; ++column) {
        for (row = 0; row < 4; ++row) {
            double sum = 0;
            for (i = 0; i < 4; ++i) sum += a.m[4 * i + row] * b.m[4 * column + i];
            out.m[4 * column + row] = sum;
        }
    }
    return out;
}

/// Returns the path of a file of the bundle, to be freed.
static char* sb_path(shadow_bundle* sb, const char* name) {
    const size_t folder = strlen(sb->folder), length = strlen(name);
    char* const path = (char*)malloc(folder + length + 2);
    if (path == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks", sb->folder);
        return NULL;
    }
    memcpy(path, sb->folder, folder);
    path[folder] = '/';
    memcpy(path + folder + 1, name, length + 1);
    return path;
}

static FILE* sb_create(shadow_bundle* sb, const char* name) {
    char* const path = sb->code == SB_OK ? sb_path(sb, name) : NULL;
    FILE* file = NULL;
    if (path == NULL) return NULL;
    file = fopen(path, "wb");
    if (file == NULL) sb_fail(sb, SB_FILE_ERROR, "%s: %s; choose a folder that can be written", path, strerror(errno));
    free(path);
    return file;
}

static void sb_write(shadow_bundle* sb, FILE* file, const char* name, const void* data, size_t size) {
    if (file == NULL || sb->code != SB_OK || size == 0) return;
    if (fwrite(data, 1, size, file) != size)
        sb_fail(sb, SB_FILE_ERROR, "%s/%s: %s; free space on the disk or choose another folder", sb->folder, name,
                strerror(errno));
}

static void sb_close(shadow_bundle* sb, FILE* file, const char* name) {
    if (file == NULL) return;
    if (fclose(file) != 0)
        sb_fail(sb, SB_FILE_ERROR, "%s/%s: %s; free space on the disk or choose another folder", sb->folder, name,
                strerror(errno));
}

static void sb_save(shadow_bundle* sb, const char* name, const sb_buffer* bytes) {
    FILE* const file = sb_create(sb, name);
    sb_write(sb, file, name, bytes->data, bytes->size);
    sb_close(sb, file, name);
}

static void sb_release(sb_buffer* buffer) {
    free(buffer->data);
    buffer->data = NULL;
    buffer->size = 0;
    buffer->capacity = 0;
}

static void sb_little(unsigned char* out, uint32_t value, int bytes) {
    int i;
    for (i = 0; i < bytes; ++i) out[i] = (unsigned char)(value >> (8 * i) & 0xff);
}

static void sb_append_little(shadow_bundle* sb, sb_buffer* out, uint32_t value) {
    unsigned char bytes[4];
    sb_little(bytes, value, 4);
    sb_append(sb, out, bytes, 4);
}

static void sb_append_big(shadow_bundle* sb, sb_buffer* out, uint32_t value) {
    unsigned char bytes[4];
    int i;
    for (i = 0; i < 4; ++i) bytes[i] = (unsigned char)(value >> (24 - 8 * i) & 0xff);
    sb_append(sb, out, bytes, 4);
}

static void sb_append_float(shadow_bundle* sb, sb_buffer* out, float value) {
    uint32_t bits;
    memcpy(&bits, &value, 4);
    sb_append_little(sb, out, bits);
}

/// Returns the CRC-32 of PNG.
static uint32_t sb_crc(const char* data, size_t size) {
    uint32_t table[256], crc = 0xffffffffu;
    uint32_t i;
    size_t at;
    int bit;
    for (i = 0; i < 256; ++i) {
        table[i] = i;
        for (bit = 0; bit < 8; ++bit) table[i] = table[i] & 1 ? 0xedb88320u ^ table[i] >> 1 : table[i] >> 1;
    }
    for (at = 0; at < size; ++at) crc = table[(crc ^ (unsigned char)data[at]) & 0xff] ^ crc >> 8;
    return crc ^ 0xffffffffu;
}

/// Appends a chunk of a PNG, whose data is given in `data`.
static void sb_png_chunk(shadow_bundle* sb, sb_buffer* out, const char* type, const sb_buffer* data) {
    size_t start;
    if (data->size > 0x7fffffffu) {
        sb_fail(sb, SB_BAD_INPUT, "%s: a picture has more than 2 GiB; write a smaller one", sb->folder);
        return;
    }
    sb_append_big(sb, out, (uint32_t)data->size);
    start = out->size;
    sb_append(sb, out, type, 4);
    sb_append(sb, out, data->data, data->size);
    if (sb->code == SB_OK) sb_append_big(sb, out, sb_crc(out->data + start, out->size - start));
}

/// Appends a PNG without compression. @param channels 3 or 4 of the four channels of the input
static void sb_png(shadow_bundle* sb, sb_buffer* out, const uint8_t* rgba, int width, int height, size_t row_bytes,
                   int from_last_row, int channels) {
    const size_t line = (size_t)width * (size_t)channels + 1;
    sb_buffer raw = {NULL, 0, 0}, data = {NULL, 0, 0};
    uint32_t a = 1, b = 0;
    size_t at, i;
    int x, y;
    unsigned char header[5] = {8, 0, 0, 0, 0};
    for (y = 0; y < height && sb->code == SB_OK; ++y) {
        const uint8_t* from = rgba + (size_t)(from_last_row ? height - 1 - y : y) * row_bytes;
        raw.data = (char*)sb_with_room(sb, raw.data, &raw.capacity, raw.size + line, 1);
        if (sb->code != SB_OK) break;
        raw.data[raw.size++] = 0;
        for (x = 0; x < width; ++x, from += 4) {
            memcpy(raw.data + raw.size, from, (size_t)channels);
            raw.size += (size_t)channels;
        }
    }
    sb_append(sb, out, "\x89PNG\r\n\x1a\n", 8);
    header[1] = channels == 4 ? 6 : 2;
    sb_append_big(sb, &data, (uint32_t)width);
    sb_append_big(sb, &data, (uint32_t)height);
    sb_append(sb, &data, header, sizeof header);
    sb_png_chunk(sb, out, "IHDR", &data);
    data.size = 0;
    sb_append(sb, &data, "\x78\x01", 2);
    for (at = 0; at < raw.size && sb->code == SB_OK;) {
        const size_t part = raw.size - at < 65535 ? raw.size - at : 65535;
        unsigned char block[5];
        block[0] = at + part == raw.size;
        sb_little(block + 1, (uint32_t)part, 2);
        sb_little(block + 3, (uint32_t)part ^ 0xffffu, 2);
        sb_append(sb, &data, block, sizeof block);
        sb_append(sb, &data, raw.data + at, part);
        for (i = at; i < at + part; ++i) {
            a = (a + (unsigned char)raw.data[i]) % 65521;
            b = (b + a) % 65521;
        }
        at += part;
    }
    sb_append_big(sb, &data, b << 16 | a);
    sb_png_chunk(sb, out, "IDAT", &data);
    data.size = 0;
    sb_png_chunk(sb, out, "IEND", &data);
    sb_release(&data);
    sb_release(&raw);
}

shadow_bundle* sb_begin(const char* folder, const char* made_by) {
    shadow_bundle* const sb = (shadow_bundle*)calloc(1, sizeof(shadow_bundle));
    int made;
    if (sb == NULL) return NULL;
    sb->metres_per_unit = 1;
    sb->up = SB_UP_Y;
    sb->folder = sb_copy(sb, folder != NULL ? folder : "");
    sb->made_by = sb_copy(sb, made_by != NULL ? made_by : "");
    if (sb->code != SB_OK) return sb;
    if (folder == NULL || *folder == '\0') {
        sb_fail(sb, SB_BAD_INPUT, "sb_begin: the folder has no name; pass a path that ends in .bundle");
        return sb;
    }
#ifdef _WIN32
    made = _mkdir(folder);
#else
    made = mkdir(folder, 0777);
#endif
    if (made != 0 && errno == EEXIST)
        sb_fail(sb, SB_FILE_ERROR, "%s: it exists already; choose another name", folder);
    else if (made != 0)
        sb_fail(sb, SB_FILE_ERROR, "%s: %s; choose a folder that can be written", folder, strerror(errno));
    return sb;
}

const char* sb_error(const shadow_bundle* sb) {
    return sb != NULL ? sb->message : "memory lacks";
}

void sb_cancel(shadow_bundle* sb) {
    size_t i;
    if (sb == NULL) return;
    for (i = 0; i < sb->name_count; ++i) free(sb->names[i]);
    for (i = 0; i < sb->map_count; ++i) free(sb->maps[i].drawn);
    for (i = 0; i < (size_t)sb->light_count; ++i) {
        free(sb->lights[i].name);
        free(sb->lights[i].kernel);
    }
    free(sb->names);
    free(sb->name_slots);
    free(sb->map_images);
    free(sb->maps);
    sb_release(&sb->bin);
    sb_release(&sb->views);
    sb_release(&sb->accessors);
    sb_release(&sb->images);
    sb_release(&sb->textures);
    sb_release(&sb->materials);
    sb_release(&sb->meshes);
    sb_release(&sb->nodes);
    sb_release(&sb->suggested);
    sb_release(&sb->notes);
    free(sb->folder);
    free(sb->made_by);
    free(sb);
}

void sb_world(shadow_bundle* sb, sb_up up, sb_hand hand, double metres_per_unit, const double* origin) {
    int i;
    if (!sb_open(sb)) return;
    if (!sb_valid(sb, "sb_world: up", (int)up, SB_COUNT(sb_up_names))) return;
    if (!sb_valid(sb, "sb_world: hand", (int)hand, SB_COUNT(sb_hand_names))) return;
    if (!isfinite(metres_per_unit) || metres_per_unit <= 0) {
        sb_fail(sb, SB_BAD_INPUT, "sb_world: metres_per_unit is not above 0; pass the length of one unit in metres");
        return;
    }
    if (origin != NULL && !sb_all_finite(sb, "sb_world: origin", origin, 3)) return;
    sb->has_world = 1;
    sb->up = up;
    sb->hand = hand;
    sb->metres_per_unit = metres_per_unit;
    for (i = 0; i < 3; ++i) sb->origin[i] = origin != NULL ? origin[i] : 0;
}

/// Begins a view of the binary chunk at a multiple of four bytes and returns its place.
static size_t sb_begin_view(shadow_bundle* sb) {
    static const char zeros[4] = {0, 0, 0, 0};
    if (sb->bin.size % 4 != 0) sb_append(sb, &sb->bin, zeros, 4 - sb->bin.size % 4);
    return sb->bin.size;
}

/// Ends a view and returns its number. @param target of glTF, 0: none
static size_t sb_end_view(shadow_bundle* sb, size_t start, int target) {
    sb_next(sb, &sb->views);
    sb_text(sb, &sb->views, "{\"buffer\": 0, \"byteOffset\": ");
    sb_whole(sb, &sb->views, start);
    sb_text(sb, &sb->views, ", \"byteLength\": ");
    sb_whole(sb, &sb->views, sb->bin.size - start);
    if (target != 0) {
        sb_text(sb, &sb->views, ", \"target\": ");
        sb_whole(sb, &sb->views, (size_t)target);
    }
    sb_text(sb, &sb->views, "}");
    return sb->view_count++;
}

/// Ends an accessor without its closing brace and returns its number.
static size_t sb_begin_accessor(shadow_bundle* sb, size_t view, int component, size_t count, const char* type) {
    sb_next(sb, &sb->accessors);
    sb_text(sb, &sb->accessors, "{\"bufferView\": ");
    sb_whole(sb, &sb->accessors, view);
    sb_text(sb, &sb->accessors, ", \"componentType\": ");
    sb_whole(sb, &sb->accessors, (size_t)component);
    sb_text(sb, &sb->accessors, ", \"count\": ");
    sb_whole(sb, &sb->accessors, count);
    sb_text(sb, &sb->accessors, ", \"type\": ");
    sb_string(sb, &sb->accessors, type);
    return sb->accessor_count++;
}

/// Adds an attribute of floats and returns the number of its accessor.
static size_t sb_attribute(shadow_bundle* sb, const char* what, const float* values, size_t stride, size_t count,
                           int width, int with_bounds) {
    const size_t start = sb_begin_view(sb);
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    size_t i, accessor;
    int c;
    if (stride == 0) stride = (size_t)width * sizeof(float);
    for (i = 0; i < count && sb->code == SB_OK; ++i) {
        float vertex[3];
        memcpy(vertex, (const char*)values + i * stride, (size_t)width * sizeof(float));
        for (c = 0; c < width; ++c) {
            if (!isfinite((double)vertex[c])) {
                sb_fail(sb, SB_BAD_INPUT, "mesh %d: %s %lu is not finite; check pointer and stride", sb->mesh_count,
                        what, (unsigned long)i);
                return 0;
            }
            if (i == 0 || (double)vertex[c] < low[c]) low[c] = (double)vertex[c];
            if (i == 0 || (double)vertex[c] > high[c]) high[c] = (double)vertex[c];
            sb_append_float(sb, &sb->bin, vertex[c]);
        }
    }
    accessor = sb_begin_accessor(sb, sb_end_view(sb, start, 34962), 5126, count, width == 3 ? "VEC3" : "VEC2");
    if (with_bounds) {
        sb_text(sb, &sb->accessors, ", \"min\": ");
        sb_reals(sb, &sb->accessors, low, 3);
        sb_text(sb, &sb->accessors, ", \"max\": ");
        sb_reals(sb, &sb->accessors, high, 3);
    }
    sb_text(sb, &sb->accessors, "}");
    return accessor;
}

/// Adds the indices of a mesh and returns the number of their accessor.
static size_t sb_indices(shadow_bundle* sb, const sb_mesh_data* mesh) {
    const size_t start = sb_begin_view(sb);
    const int wide = mesh->vertex_count > 65535;
    unsigned char bytes[4];
    size_t i, accessor;
    for (i = 0; i < mesh->index_count && sb->code == SB_OK; ++i) {
        const uint32_t index = mesh->indices32 != NULL ? mesh->indices32[i] : mesh->indices16[i];
        if (index >= mesh->vertex_count) {
            sb_fail(sb, SB_BAD_INPUT,
                    "mesh %d: index %lu is %lu, the mesh has %lu vertices; pass a list of triangles without restarts",
                    sb->mesh_count, (unsigned long)i, (unsigned long)index, (unsigned long)mesh->vertex_count);
            return 0;
        }
        sb_little(bytes, index, wide ? 4 : 2);
        sb_append(sb, &sb->bin, bytes, wide ? 4 : 2);
    }
    accessor = sb_begin_accessor(sb, sb_end_view(sb, start, 34963), wide ? 5125 : 5123, mesh->index_count, "SCALAR");
    sb_text(sb, &sb->accessors, "}");
    return accessor;
}

/// Adds the material of a mesh and returns its number.
static size_t sb_material(shadow_bundle* sb, const sb_mesh_data* mesh) {
    const int has_colour = mesh->colour[0] != 0 || mesh->colour[1] != 0 || mesh->colour[2] != 0;
    sb_buffer* const out = &sb->materials;
    double colour[4];
    int c;
    for (c = 0; c < 3; ++c) colour[c] = has_colour ? (double)mesh->colour[c] : mesh->mask_rgba != NULL ? 1.0 : 0.8;
    colour[3] = 1;
    for (c = 0; c < 3; ++c) {
        if (isfinite(colour[c]) && colour[c] >= 0 && colour[c] <= 1) continue;
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: a colour is outside 0 to 1; pass linear shares", sb->mesh_count);
        return 0;
    }
    if (mesh->mask_rgba != NULL) {
        const size_t start = sb_begin_view(sb);
        sb_png(sb, &sb->bin, mesh->mask_rgba, mesh->mask_width, mesh->mask_height,
               mesh->mask_row_bytes != 0 ? mesh->mask_row_bytes : (size_t)mesh->mask_width * 4, 0, 4);
        sb_next(sb, &sb->images);
        sb_text(sb, &sb->images, "{\"mimeType\": \"image/png\", \"bufferView\": ");
        sb_whole(sb, &sb->images, sb_end_view(sb, start, 0));
        sb_text(sb, &sb->images, "}");
        sb_next(sb, &sb->textures);
        sb_text(sb, &sb->textures, "{\"sampler\": ");
        sb_whole(sb, &sb->textures, mesh->mask_clamp ? 1 : 0);
        sb_text(sb, &sb->textures, ", \"source\": ");
        sb_whole(sb, &sb->textures, sb->texture_count++);
        sb_text(sb, &sb->textures, "}");
    }
    sb_next(sb, out);
    sb_text(sb, out,
            "{\"pbrMetallicRoughness\": {\"metallicFactor\": 0, \"roughnessFactor\": 0.8, \"baseColorFactor\": ");
    sb_reals(sb, out, colour, 4);
    if (mesh->mask_rgba != NULL) {
        sb_text(sb, out, ", \"baseColorTexture\": {\"index\": ");
        sb_whole(sb, out, sb->texture_count - 1);
        sb_text(sb, out, "}}, \"alphaMode\": \"MASK\", \"alphaCutoff\": ");
        sb_real(sb, out, mesh->mask_cutoff > 0 ? (double)mesh->mask_cutoff : 0.5);
    } else {
        sb_text(sb, out, "}");
    }
    sb_text(sb, out, mesh->two_sided ? ", \"doubleSided\": true}" : "}");
    return sb->material_count++;
}

/// Checks all of a mesh that can be checked before its data is read.
static int sb_is_mesh(shadow_bundle* sb, const sb_mesh_data* mesh) {
    const size_t corners = mesh->indices16 != NULL || mesh->indices32 != NULL ? mesh->index_count : mesh->vertex_count;
    if (mesh->positions == NULL || mesh->vertex_count == 0) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: it has no positions; set positions and vertex_count", sb->mesh_count);
    } else if (mesh->vertex_count > 0x7fffffffu || corners > 0x7fffffffu) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: it has more than 2^31 vertices or indices; split it", sb->mesh_count);
    } else if (mesh->indices16 != NULL && mesh->indices32 != NULL) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: both indices16 and indices32 are set; set one", sb->mesh_count);
    } else if (mesh->index_count > 0 && mesh->indices16 == NULL && mesh->indices32 == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: index_count is set without indices; set indices16 or indices32",
                sb->mesh_count);
    } else if (corners == 0 || corners % 3 != 0) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: %lu corners are no list of triangles; pass three a triangle",
                sb->mesh_count, (unsigned long)corners);
    } else if (mesh->mask_rgba != NULL && mesh->uv == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: it has a mask without texture coordinates; set uv", sb->mesh_count);
    } else if (mesh->mask_rgba != NULL && (mesh->mask_width < 1 || mesh->mask_height < 1 ||
                                           mesh->mask_width > SB_MOST_TEXELS || mesh->mask_height > SB_MOST_TEXELS)) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: a mask has 1 to %d texels a side, this one %d x %d", sb->mesh_count,
                SB_MOST_TEXELS, mesh->mask_width, mesh->mask_height);
    } else if (!isfinite((double)mesh->mask_cutoff) || mesh->mask_cutoff < 0 || mesh->mask_cutoff > 1) {
        sb_fail(sb, SB_BAD_INPUT, "mesh %d: mask_cutoff is outside 0 to 1", sb->mesh_count);
    } else {
        return 1;
    }
    return 0;
}

int sb_mesh(shadow_bundle* sb, const sb_mesh_data* mesh) {
    size_t accessor;
    if (!sb_open(sb)) return -1;
    if (mesh == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "sb_mesh: there is no mesh; pass a pointer to one");
        return -1;
    }
    if (!sb_is_mesh(sb, mesh)) return -1;
    sb_next(sb, &sb->meshes);
    sb_text(sb, &sb->meshes, "{");
    if (mesh->name != NULL) {
        sb_text(sb, &sb->meshes, "\"name\": ");
        sb_string(sb, &sb->meshes, mesh->name);
        sb_text(sb, &sb->meshes, ", ");
    }
    sb_text(sb, &sb->meshes, "\"primitives\": [{\"attributes\": {\"POSITION\": ");
    accessor = sb_attribute(sb, "position", mesh->positions, mesh->position_stride, mesh->vertex_count, 3, 1);
    sb_whole(sb, &sb->meshes, accessor);
    if (mesh->normals != NULL) {
        accessor = sb_attribute(sb, "normal", mesh->normals, mesh->normal_stride, mesh->vertex_count, 3, 0);
        sb_text(sb, &sb->meshes, ", \"NORMAL\": ");
        sb_whole(sb, &sb->meshes, accessor);
    }
    if (mesh->uv != NULL) {
        accessor = sb_attribute(sb, "texture coordinate", mesh->uv, mesh->uv_stride, mesh->vertex_count, 2, 0);
        sb_text(sb, &sb->meshes, ", \"TEXCOORD_0\": ");
        sb_whole(sb, &sb->meshes, accessor);
    }
    sb_text(sb, &sb->meshes, "}");
    if (mesh->index_count > 0) {
        accessor = sb_indices(sb, mesh);
        sb_text(sb, &sb->meshes, ", \"indices\": ");
        sb_whole(sb, &sb->meshes, accessor);
    }
    accessor = sb_material(sb, mesh);
    sb_text(sb, &sb->meshes, ", \"material\": ");
    sb_whole(sb, &sb->meshes, accessor);
    sb_text(sb, &sb->meshes, "}]}");
    return sb->code == SB_OK ? sb->mesh_count++ : -1;
}

static size_t sb_hash(const char* text) {
    uint32_t hash = 2166136261u;
    for (; *text != '\0'; ++text) hash = (hash ^ (unsigned char)*text) * 16777619u;
    return hash;
}

/// Returns the slot that holds a name or could.
static size_t sb_slot(const shadow_bundle* sb, const char* name) {
    size_t slot = sb_hash(name) & (sb->slot_count - 1);
    while (sb->name_slots[slot] != 0 && strcmp(sb->names[sb->name_slots[slot] - 1], name) != 0)
        slot = (slot + 1) & (sb->slot_count - 1);
    return slot;
}

/// Makes room for one more name.
static void sb_grow_names(shadow_bundle* sb) {
    size_t i, count = sb->slot_count;
    size_t* slots;
    sb->names = (char**)sb_with_room(sb, sb->names, &sb->name_capacity, sb->name_count + 1, sizeof(char*));
    if (sb->code != SB_OK || (sb->name_count + 1) * 2 <= sb->slot_count) return;
    count = count > 0 ? count * 2 : 64;
    slots = (size_t*)calloc(count, sizeof(size_t));
    if (slots == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks; write fewer instances", sb->folder);
        return;
    }
    free(sb->name_slots);
    sb->name_slots = slots;
    sb->slot_count = count;
    for (i = 0; i < sb->name_count; ++i) slots[sb_slot(sb, sb->names[i])] = i + 1;
}

/// Adds the name of an instance: no slash, no control character, UTF-8, and each name once.
static const char* sb_add_name(shadow_bundle* sb, const char* name) {
    char clean[SB_MOST_NAME_BYTES + 32];
    size_t length = 0, slot;
    unsigned long number = 1;
    for (; name != NULL && *name != '\0' && length < SB_MOST_NAME_BYTES; ++name) {
        size_t bytes = sb_utf8_length(name);
        const unsigned char c = (unsigned char)*name;
        if (c < 32 || c == 127 || c == '/') {
            clean[length++] = '_';
        } else if (bytes == 0) {
            clean[length++] = '?';
        } else if (length + bytes <= SB_MOST_NAME_BYTES) {
            while (bytes-- > 1) clean[length++] = *name++;
            clean[length++] = *name;
        } else {
            break;
        }
    }
    clean[length] = '\0';
    if (length == 0) length = (size_t)snprintf(clean, sizeof clean, "node %lu", (unsigned long)sb->name_count);
    sb_grow_names(sb);
    if (sb->code != SB_OK) return NULL;
    slot = sb_slot(sb, clean);
    while (sb->name_slots[slot] != 0) {
        (void)snprintf(clean + length, sizeof clean - length, " #%lu", ++number);
        slot = sb_slot(sb, clean);
    }
    sb->names[sb->name_count] = sb_copy(sb, clean);
    if (sb->code != SB_OK) return NULL;
    sb->name_slots[slot] = ++sb->name_count;
    return sb->names[sb->name_count - 1];
}

/// Adds a setting with which the scene opens: object.NAME.cast or object.NAME.receive.
static void sb_suggest(shadow_bundle* sb, const char* name, const char* member) {
    sb_buffer key = {NULL, 0, 0};
    sb_text(sb, &key, "object.");
    sb_text(sb, &key, name);
    sb_append(sb, &key, member, strlen(member) + 1);
    sb_next(sb, &sb->suggested);
    if (sb->code == SB_OK) sb_string(sb, &sb->suggested, key.data);
    sb_text(sb, &sb->suggested, ": \"false\"");
    sb_release(&key);
}

int sb_instance(shadow_bundle* sb, int mesh, sb_matrix world, const char* name, unsigned flags) {
    const char* own;
    if (!sb_open(sb)) return -1;
    if (mesh < 0 || mesh >= sb->mesh_count) {
        sb_fail(sb, SB_BAD_INPUT, "sb_instance: there is no mesh %d; pass a number of sb_mesh()", mesh);
        return -1;
    }
    if (!sb_all_finite(sb, "sb_instance: world matrix", world.m, 16)) return -1;
    if (world.m[3] != 0 || world.m[7] != 0 || world.m[11] != 0 || world.m[15] != 1) {
        sb_fail(sb, SB_BAD_INPUT,
                "sb_instance: the last row of a world matrix is 0 0 0 1, this one's is not; choose between "
                "sb_columns_f() and sb_rows_f()");
        return -1;
    }
    if (sb->name_count >= 1000000) {
        sb_fail(sb, SB_BAD_INPUT, "sb_instance: a scene has at most 1,000,000 instances; merge meshes");
        return -1;
    }
    own = sb_add_name(sb, name);
    if (own == NULL) return -1;
    sb_next(sb, &sb->nodes);
    sb_text(sb, &sb->nodes, "{\"name\": ");
    sb_string(sb, &sb->nodes, own);
    sb_text(sb, &sb->nodes, ", \"mesh\": ");
    sb_whole(sb, &sb->nodes, (size_t)mesh);
    sb_text(sb, &sb->nodes, ", \"matrix\": ");
    sb_reals(sb, &sb->nodes, world.m, 16);
    sb_text(sb, &sb->nodes, "}");
    if ((flags & SB_CASTS) == 0) sb_suggest(sb, own, ".cast");
    if ((flags & SB_RECEIVES) == 0) sb_suggest(sb, own, ".receive");
    return sb->code == SB_OK ? (int)sb->name_count - 1 : -1;
}

static int sb_is_size(shadow_bundle* sb, const char* function, int width, int height) {
    if (width >= 1 && height >= 1 && width <= SB_MOST_TEXELS && height <= SB_MOST_TEXELS) return 1;
    sb_fail(sb, SB_BAD_INPUT, "%s: %d x %d is no size; 1 to %d a side are allowed", function, width, height,
            SB_MOST_TEXELS);
    return 0;
}

/// Returns whether rows of a stated length are long enough. `row_bytes` 0 becomes that of packed rows.
static int sb_is_row(shadow_bundle* sb, const char* function, size_t packed, size_t* row_bytes) {
    if (*row_bytes == 0) *row_bytes = packed;
    if (*row_bytes >= packed) return 1;
    sb_fail(sb, SB_BAD_INPUT, "%s: row_bytes is %lu, a row has %lu bytes; pass bytes, or 0 for packed rows", function,
            (unsigned long)*row_bytes, (unsigned long)packed);
    return 0;
}

void sb_camera(shadow_bundle* sb, sb_matrix clip_from_world, int width, int height, sb_range range, int reversed) {
    if (!sb_open(sb) || !sb_is_clip_matrix(sb, "sb_camera", &clip_from_world)) return;
    if (!sb_is_size(sb, "sb_camera", width, height)) return;
    if (!sb_valid(sb, "sb_camera: range", (int)range, SB_COUNT(sb_range_names))) return;
    sb->has_camera = 1;
    sb->camera = clip_from_world;
    sb->camera_width = width;
    sb->camera_height = height;
    sb->camera_range = range;
    sb->camera_reversed = reversed;
}

void sb_picture(shadow_bundle* sb, const uint8_t* rgba, int width, int height, size_t row_bytes, sb_first_row first) {
    sb_buffer png = {NULL, 0, 0};
    if (!sb_open(sb) || !sb_is_size(sb, "sb_picture", width, height)) return;
    if (!sb_valid(sb, "sb_picture: first row", (int)first, SB_COUNT(sb_first_row_names))) return;
    if (!sb_is_row(sb, "sb_picture", (size_t)width * 4, &row_bytes)) return;
    if (rgba == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "sb_picture: there are no pixels; pass a pointer to them");
        return;
    }
    sb_png(sb, &png, rgba, width, height, row_bytes, first == SB_FIRST_ROW_BOTTOM, 3);
    sb_save(sb, "picture.png", &png);
    sb_release(&png);
    sb->has_picture = 1;
}

void sb_note(shadow_bundle* sb, const char* text) {
    if (!sb_open(sb) || text == NULL) return;
    if (sb->notes.size > 0) sb_text(sb, &sb->notes, ", ");
    sb_string(sb, &sb->notes, text);
}

int sb_light(shadow_bundle* sb, const char* name, sb_light_type type) {
    sb_light_state* light;
    if (!sb_open(sb) || !sb_valid(sb, "sb_light: type", (int)type, SB_COUNT(sb_type_names))) return -1;
    if (sb->light_count == SB_MOST_LIGHTS) {
        sb_fail(sb, SB_BAD_INPUT, "sb_light: a bundle has at most %d lights; write those that are looked at",
                SB_MOST_LIGHTS);
        return -1;
    }
    light = &sb->lights[sb->light_count];
    light->type = type;
    light->name = sb_copy(sb, name != NULL ? name : "");
    return sb->code == SB_OK ? sb->light_count++ : -1;
}

static sb_light_state* sb_light_at(shadow_bundle* sb, const char* function, int light) {
    if (!sb_open(sb)) return NULL;
    if (light >= 0 && light < sb->light_count) return &sb->lights[light];
    sb_fail(sb, SB_BAD_INPUT, "%s: there is no light %d; pass a number of sb_light()", function, light);
    return NULL;
}

void sb_light_direction(shadow_bundle* sb, int light, double x, double y, double z) {
    sb_light_state* const state = sb_light_at(sb, "sb_light_direction", light);
    double direction[3];
    if (state == NULL) return;
    direction[0] = x;
    direction[1] = y;
    direction[2] = z;
    if (!sb_all_finite(sb, "sb_light_direction", direction, 3)) return;
    if (x == 0 && y == 0 && z == 0) {
        sb_fail(sb, SB_BAD_INPUT, "sb_light_direction: the direction is 0 0 0; pass the way in which the light shines");
        return;
    }
    memcpy(state->direction, direction, sizeof direction);
    state->has_direction = 1;
}

void sb_light_position(shadow_bundle* sb, int light, double x, double y, double z) {
    sb_light_state* const state = sb_light_at(sb, "sb_light_position", light);
    double position[3];
    if (state == NULL) return;
    position[0] = x;
    position[1] = y;
    position[2] = z;
    if (!sb_all_finite(sb, "sb_light_position", position, 3)) return;
    memcpy(state->position, position, sizeof position);
    state->has_position = 1;
}

void sb_light_cone(shadow_bundle* sb, int light, double degrees) {
    sb_light_state* const state = sb_light_at(sb, "sb_light_cone", light);
    if (state == NULL) return;
    if (!isfinite(degrees) || degrees <= 0 || degrees >= 180) {
        sb_fail(sb, SB_BAD_INPUT, "sb_light_cone: the angle is outside 0 to 180; pass the full angle in degrees");
        return;
    }
    state->cone_deg.known = 1;
    state->cone_deg.value = degrees;
}

void sb_light_choice(shadow_bundle* sb, int light, sb_choice choice) {
    sb_light_state* const state = sb_light_at(sb, "sb_light_choice", light);
    if (state == NULL || !sb_valid(sb, "sb_light_choice", (int)choice, SB_COUNT(sb_choice_names))) return;
    state->choice.known = 1;
    state->choice.value = (int)choice;
}

void sb_lookup_bias(shadow_bundle* sb, int light, sb_bias_term term, double amount, sb_unit unit) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_bias", light);
    if (state == NULL || !sb_valid(sb, "sb_lookup_bias: term", (int)term, SB_COUNT(sb_bias_names))) return;
    if (!sb_valid(sb, "sb_lookup_bias: unit", (int)unit, SB_COUNT(sb_unit_names))) return;
    if (!sb_all_finite(sb, "sb_lookup_bias", &amount, 1)) return;
    state->bias[term].known = 1;
    state->bias[term].value = amount;
    state->bias_units[term] = (int)unit;
}

void sb_lookup_normal_by(shadow_bundle* sb, int light, sb_normal_by by) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_normal_by", light);
    if (state == NULL || !sb_valid(sb, "sb_lookup_normal_by", (int)by, SB_COUNT(sb_normal_by_names))) return;
    state->normal_by = (int)by;
}

void sb_lookup_kernel(shadow_bundle* sb, int light, const char* kernel) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_kernel", light);
    if (state == NULL || kernel == NULL) return;
    free(state->kernel);
    state->kernel = sb_copy(sb, kernel);
}

void sb_lookup_compare(shadow_bundle* sb, int light, sb_compare compare) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_compare", light);
    if (state == NULL || !sb_valid(sb, "sb_lookup_compare", (int)compare, SB_COUNT(sb_compare_names))) return;
    state->compare.known = 1;
    state->compare.value = (int)compare;
}

void sb_lookup_sampler(shadow_bundle* sb, int light, sb_filter filter, sb_wrap wrap) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_sampler", light);
    if (state == NULL || !sb_valid(sb, "sb_lookup_sampler: filter", (int)filter, SB_COUNT(sb_filter_names))) return;
    if (!sb_valid(sb, "sb_lookup_sampler: wrap", (int)wrap, SB_COUNT(sb_wrap_names))) return;
    state->filter.known = 1;
    state->filter.value = (int)filter;
    state->wrap.known = 1;
    state->wrap.value = (int)wrap;
}

void sb_lookup_shader(shadow_bundle* sb, int light, const char* source) {
    sb_light_state* const state = sb_light_at(sb, "sb_lookup_shader", light);
    char name[32];
    FILE* file;
    if (state == NULL || source == NULL) return;
    (void)snprintf(name, sizeof name, "lookup%d.txt", light);
    file = sb_create(sb, name);
    sb_write(sb, file, name, source, strlen(source));
    sb_close(sb, file, name);
    state->has_shader = 1;
}

/// Writes the numbers of one row of an image, little-endian.
static void sb_write_row(shadow_bundle* sb, FILE* file, const char* name, const unsigned char* row, size_t count,
                         sb_texel type, unsigned char* line) {
    const size_t bytes = type == SB_F16 || type == SB_U16 ? 2 : 4;
    size_t i;
    for (i = 0; i < count; ++i) {
        uint32_t bits = 0;
        uint16_t half = 0;
        if (bytes == 2) {
            memcpy(&half, row + 2 * i, 2);
            bits = half;
        } else {
            memcpy(&bits, row + 4 * i, 4);
        }
        if (type == SB_U24) bits &= 0xffffffu;
        if (type == SB_U24_HIGH) bits >>= 8;
        sb_little(line + bytes * i, bits, (int)bytes);
    }
    sb_write(sb, file, name, line, bytes * count);
}

static void sb_image_name(const sb_image_state* image, int number, char* name, size_t size) {
    const int is_pfm = image->type == SB_F32 && image->channels == 1;
    (void)snprintf(name, size, "map%d.%s", number, is_pfm ? "pfm" : "raw");
}

int sb_image(shadow_bundle* sb, const sb_image_data* image) {
    sb_image_state state;
    size_t count, row_bytes;
    unsigned char* line;
    char name[32], header[64];
    FILE* file;
    int y;
    if (!sb_open(sb)) return -1;
    if (image == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "sb_image: there is no image; pass a pointer to one");
        return -1;
    }
    if (!sb_is_size(sb, "sb_image", image->width, image->height)) return -1;
    if (!sb_valid(sb, "sb_image: type", (int)image->type, SB_COUNT(sb_texel_names))) return -1;
    if (!sb_valid(sb, "sb_image: first_row", (int)image->first_row, SB_COUNT(sb_first_row_names))) return -1;
    state.width = image->width;
    state.height = image->height;
    state.channels = image->channels == 0 ? 1 : image->channels;
    state.channel = image->channel;
    state.type = image->type;
    state.first_row = image->first_row;
    if (state.channels < 1 || state.channels > 4 || state.channel < 0 || state.channel >= state.channels) {
        sb_fail(sb, SB_BAD_INPUT, "sb_image: there is no channel %d of %d; an image has 1 to 4", state.channel,
                state.channels);
        return -1;
    }
    count = (size_t)state.width * (size_t)state.channels;
    row_bytes = image->row_bytes;
    if (!sb_is_row(sb, "sb_image", count * (state.type == SB_F16 || state.type == SB_U16 ? 2 : 4), &row_bytes))
        return -1;
    if (image->texels == NULL) {
        sb_fail(sb, SB_BAD_INPUT, "sb_image: there are no texels; pass a pointer to them");
        return -1;
    }
    sb->map_images = (sb_image_state*)sb_with_room(sb, sb->map_images, &sb->image_capacity, sb->image_count + 1,
                                                   sizeof(sb_image_state));
    line = sb->code == SB_OK ? (unsigned char*)malloc(count * 4) : NULL;
    if (line == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks", sb->folder);
        return -1;
    }
    sb_image_name(&state, (int)sb->image_count, name, sizeof name);
    file = sb_create(sb, name);
    if (state.type == SB_F32 && state.channels == 1) {
        (void)snprintf(header, sizeof header, "Pf\n%d %d\n-1.0\n", state.width, state.height);
        sb_write(sb, file, name, header, strlen(header));
    }
    for (y = 0; y < state.height && sb->code == SB_OK; ++y)
        sb_write_row(sb, file, name, (const unsigned char*)image->texels + (size_t)y * row_bytes, count, state.type,
                     line);
    sb_close(sb, file, name);
    free(line);
    if (sb->code != SB_OK) return -1;
    sb->map_images[sb->image_count] = state;
    return (int)sb->image_count++;
}

/// Returns the storage that integers and half floats imply.
static sb_option sb_format_of_texels(sb_texel type) {
    sb_option out = {0, 0};
    out.known = type == SB_U16 || type == SB_U24 || type == SB_U24_HIGH || type == SB_F16;
    out.value = type == SB_U16 ? (int)SB_D16 : type == SB_F16 ? (int)SB_R16F : (int)SB_D24;
    return out;
}

int sb_map(shadow_bundle* sb, int light, int image, sb_matrix clip_from_world, sb_range range, int reversed) {
    sb_light_state* const state = sb_light_at(sb, "sb_map", light);
    sb_map_state* map;
    if (state == NULL || !sb_is_clip_matrix(sb, "sb_map", &clip_from_world)) return -1;
    if (!sb_valid(sb, "sb_map: range", (int)range, SB_COUNT(sb_range_names))) return -1;
    if (image < 0 || (size_t)image >= sb->image_count) {
        sb_fail(sb, SB_BAD_INPUT, "sb_map: there is no image %d; pass a number of sb_image()", image);
        return -1;
    }
    if (state->map_count == SB_MOST_MAPS) {
        sb_fail(sb, SB_BAD_INPUT, "sb_map: light %d has more than %d maps; write those that are looked at", light,
                SB_MOST_MAPS);
        return -1;
    }
    sb->maps = (sb_map_state*)sb_with_room(sb, sb->maps, &sb->map_capacity, sb->map_count + 1, sizeof(sb_map_state));
    if (sb->code != SB_OK) return -1;
    map = &sb->maps[sb->map_count];
    memset(map, 0, sizeof *map);
    map->light = light;
    map->image = image;
    map->clip_from_world = clip_from_world;
    map->range = range;
    map->reversed = reversed;
    map->format = sb_format_of_texels(sb->map_images[image].type);
    state->maps[state->map_count++] = (int)sb->map_count;
    return (int)sb->map_count++;
}

static sb_map_state* sb_map_at(shadow_bundle* sb, const char* function, int map) {
    if (!sb_open(sb)) return NULL;
    if (map >= 0 && (size_t)map < sb->map_count) return &sb->maps[map];
    sb_fail(sb, SB_BAD_INPUT, "%s: there is no map %d; pass a number of sb_map()", function, map);
    return NULL;
}

void sb_map_region(shadow_bundle* sb, int map, int x, int y, int width, int height) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_region", map);
    const sb_image_state* image;
    if (state == NULL) return;
    image = &sb->map_images[state->image];
    if (x < 0 || y < 0 || width < 1 || height < 1 || width > image->width || height > image->height ||
        x > image->width - width || y > image->height - height) {
        sb_fail(sb, SB_BAD_INPUT, "sb_map_region: %d %d %d %d is no part of an image of %d x %d texels", x, y, width,
                height, image->width, image->height);
        return;
    }
    state->has_region = 1;
    state->region[0] = x;
    state->region[1] = y;
    state->region[2] = width;
    state->region[3] = height;
}

void sb_map_format(shadow_bundle* sb, int map, sb_format format) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_format", map);
    if (state == NULL || !sb_valid(sb, "sb_map_format", (int)format, SB_COUNT(sb_format_names))) return;
    state->format.known = 1;
    state->format.value = (int)format;
}

void sb_map_stored(shadow_bundle* sb, int map, sb_stored stored, double parameter) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_stored", map);
    if (state == NULL || !sb_valid(sb, "sb_map_stored", (int)stored, SB_COUNT(sb_stored_names))) return;
    if ((stored == SB_STORED_DISTANCE_SHARE || stored == SB_STORED_EXPONENTIAL) &&
        (!isfinite(parameter) || parameter <= 0)) {
        sb_fail(sb, SB_BAD_INPUT,
                "sb_map_stored: the parameter is not above 0; pass the range in metres or the exponent");
        return;
    }
    state->stored = stored;
    state->stored_parameter = parameter;
}

void sb_map_clear(shadow_bundle* sb, int map, double value) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_clear", map);
    if (state == NULL || !sb_all_finite(sb, "sb_map_clear", &value, 1)) return;
    state->clear.known = 1;
    state->clear.value = value;
}

void sb_map_offset(shadow_bundle* sb, int map, double factor, double units, double clamp) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_offset", map);
    double offset[3];
    if (state == NULL) return;
    offset[0] = factor;
    offset[1] = units;
    offset[2] = clamp;
    if (!sb_all_finite(sb, "sb_map_offset", offset, 3)) return;
    memcpy(state->offset, offset, sizeof offset);
    state->has_offset = 1;
}

void sb_map_caster_shift(shadow_bundle* sb, int map, double shift_m, double grazing_shift_m) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_caster_shift", map);
    double shift[2];
    if (state == NULL) return;
    shift[0] = shift_m;
    shift[1] = grazing_shift_m;
    if (!sb_all_finite(sb, "sb_map_caster_shift", shift, 2)) return;
    memcpy(state->shift_m, shift, sizeof shift);
    state->has_shift = 1;
}

void sb_map_cull(shadow_bundle* sb, int map, sb_cull cull, sb_front front) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_cull", map);
    if (state == NULL || !sb_valid(sb, "sb_map_cull: cull", (int)cull, SB_COUNT(sb_cull_names))) return;
    if (!sb_valid(sb, "sb_map_cull: front", (int)front, SB_COUNT(sb_front_names))) return;
    state->cull.known = 1;
    state->cull.value = (int)cull;
    state->front.known = 1;
    state->front.value = (int)front;
}

void sb_map_depth_clamp(shadow_bundle* sb, int map, int on) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_depth_clamp", map);
    if (state == NULL) return;
    state->depth_clamp.known = 1;
    state->depth_clamp.value = on != 0;
}

void sb_map_interval(shadow_bundle* sb, int map, double from, double to) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_interval", map);
    if (state == NULL) return;
    if (!isfinite(from) || !isfinite(to) || to <= from) {
        sb_fail(sb, SB_BAD_INPUT, "sb_map_interval: the interval is empty or not finite; pass camera depths in metres");
        return;
    }
    state->has_interval = 1;
    state->interval[0] = from;
    state->interval[1] = to;
}

void sb_map_drawn(shadow_bundle* sb, int map, const int* instances, size_t count) {
    sb_map_state* const state = sb_map_at(sb, "sb_map_drawn", map);
    size_t i;
    if (state == NULL) return;
    if (instances == NULL) count = 0;
    for (i = 0; i < count; ++i) {
        if (instances[i] >= 0 && (size_t)instances[i] < sb->name_count) continue;
        sb_fail(sb, SB_BAD_INPUT, "sb_map_drawn: there is no instance %d; pass numbers of sb_instance()", instances[i]);
        return;
    }
    free(state->drawn);
    state->drawn_count = 0;
    state->drawn = (int*)malloc(count > 0 ? count * sizeof(int) : 1);
    if (state->drawn == NULL) {
        sb_fail(sb, SB_NO_MEMORY, "%s: memory lacks", sb->folder);
        return;
    }
    if (count > 0) memcpy(state->drawn, instances, count * sizeof(int));
    state->drawn_count = count;
    state->has_drawn = 1;
}

/// Appends `"key": [elements]` unless there are none.
static void sb_list(shadow_bundle* sb, sb_buffer* out, const char* key, const sb_buffer* elements) {
    if (elements->size == 0) return;
    sb_text(sb, out, ",\n");
    sb_string(sb, out, key);
    sb_text(sb, out, ": [");
    sb_append(sb, out, elements->data, elements->size);
    sb_text(sb, out, "]");
}

static void sb_write_scene(shadow_bundle* sb) {
    sb_buffer json = {NULL, 0, 0}, head = {NULL, 0, 0};
    FILE* file;
    size_t i, total;
    sb_text(sb, &json,
            "{\"asset\": {\"version\": \"2.0\", \"generator\": \"shadow_bundle.h\"},\n\"scene\": 0,\n\"scenes\": "
            "[{\"nodes\": [");
    for (i = 0; i < sb->name_count; ++i) {
        if (i > 0) sb_text(sb, &json, ", ");
        sb_whole(sb, &json, i);
    }
    sb_text(sb, &json, "]");
    if (sb->suggested.size > 0) {
        sb_text(sb, &json, ", \"extras\": {\"shadow_inspector\": {\"suggested\": {");
        sb_append(sb, &json, sb->suggested.data, sb->suggested.size);
        sb_text(sb, &json, "}}}");
    }
    sb_text(sb, &json, "}]");
    sb_begin_view(sb);
    sb_text(sb, &json, ",\n\"buffers\": [{\"byteLength\": ");
    sb_whole(sb, &json, sb->bin.size);
    sb_text(sb, &json, "}]");
    sb_list(sb, &json, "bufferViews", &sb->views);
    sb_list(sb, &json, "accessors", &sb->accessors);
    sb_list(sb, &json, "images", &sb->images);
    if (sb->texture_count > 0)
        sb_text(sb, &json,
                ",\n\"samplers\": [{\"magFilter\": 9729, \"minFilter\": 9729, \"wrapS\": 10497, \"wrapT\": 10497},\n"
                "{\"magFilter\": 9729, \"minFilter\": 9729, \"wrapS\": 33071, \"wrapT\": 33071}]");
    sb_list(sb, &json, "textures", &sb->textures);
    sb_list(sb, &json, "materials", &sb->materials);
    sb_list(sb, &json, "meshes", &sb->meshes);
    sb_list(sb, &json, "nodes", &sb->nodes);
    sb_text(sb, &json, "}");
    while (json.size % 4 != 0 && sb->code == SB_OK) sb_text(sb, &json, " ");
    total = 28 + json.size + sb->bin.size;
    if (json.size > 0xfffffff0u || sb->bin.size > 0xfffffff0u || total > 0xfffffff0u)
        sb_fail(sb, SB_BAD_INPUT, "%s/scene.glb: the scene has more than 4 GiB; write fewer meshes", sb->folder);
    sb_append(sb, &head, "glTF", 4);
    sb_append_little(sb, &head, 2);
    sb_append_little(sb, &head, (uint32_t)total);
    sb_append_little(sb, &head, (uint32_t)json.size);
    sb_append(sb, &head, "JSON", 4);
    file = sb_create(sb, "scene.glb");
    sb_write(sb, file, "scene.glb", head.data, head.size);
    sb_write(sb, file, "scene.glb", json.data, json.size);
    head.size = 0;
    sb_append_little(sb, &head, (uint32_t)sb->bin.size);
    sb_append(sb, &head, "BIN\0", 4);
    sb_write(sb, file, "scene.glb", head.data, head.size);
    sb_write(sb, file, "scene.glb", sb->bin.data, sb->bin.size);
    sb_close(sb, file, "scene.glb");
    sb_release(&head);
    sb_release(&json);
}

/// Appends `"key": ` after a comma, unless an object has begun with `{`.
static void sb_key(shadow_bundle* sb, sb_buffer* out, const char* key) {
    if (sb->code != SB_OK) return;
    if (out->data[out->size - 1] != '{') sb_text(sb, out, ", ");
    sb_string(sb, out, key);
    sb_text(sb, out, ": ");
}

static void sb_key_text(shadow_bundle* sb, sb_buffer* out, const char* key, const char* text) {
    sb_key(sb, out, key);
    sb_string(sb, out, text);
}

static void sb_key_option(shadow_bundle* sb, sb_buffer* out, const char* key, sb_option option,
                          const char* const* names) {
    if (option.known) sb_key_text(sb, out, key, names[option.value]);
}

static void sb_key_number(shadow_bundle* sb, sb_buffer* out, const char* key, double value) {
    sb_key(sb, out, key);
    sb_real(sb, out, value);
}

static void sb_key_truth(shadow_bundle* sb, sb_buffer* out, const char* key, int value) {
    sb_key(sb, out, key);
    sb_text(sb, out, value ? "true" : "false");
}

static void sb_write_map(shadow_bundle* sb, sb_buffer* out, const sb_map_state* map) {
    const sb_image_state* const image = &sb->map_images[map->image];
    const int is_raw = image->type != SB_F32 || image->channels != 1;
    char name[32];
    size_t i;
    sb_image_name(image, map->image, name, sizeof name);
    sb_text(sb, out, "\n        {\"image\": {");
    sb_key_text(sb, out, "file", name);
    sb_key_text(sb, out, "first_row", sb_first_row_names[image->first_row]);
    if (is_raw) {
        sb_key_number(sb, out, "width", image->width);
        sb_key_number(sb, out, "height", image->height);
        sb_key_text(sb, out, "format", sb_texel_names[image->type]);
        if (image->channels != 1) {
            sb_key_number(sb, out, "channels", image->channels);
            sb_key_number(sb, out, "channel", image->channel);
        }
    }
    sb_text(sb, out, "}");
    if (map->has_region) {
        double region[4];
        for (i = 0; i < 4; ++i) region[i] = map->region[i];
        sb_key(sb, out, "region");
        sb_reals(sb, out, region, 4);
    }
    sb_key(sb, out, "clip_from_world");
    sb_reals(sb, out, map->clip_from_world.m, 16);
    sb_key(sb, out, "depth");
    sb_text(sb, out, "{");
    sb_key_text(sb, out, "range", sb_range_names[map->range]);
    sb_key_truth(sb, out, "reversed", map->reversed);
    sb_key_text(sb, out, "stored", sb_stored_names[map->stored]);
    sb_key_option(sb, out, "format", map->format, sb_format_names);
    if (map->stored == SB_STORED_DISTANCE_SHARE) sb_key_number(sb, out, "range_m", map->stored_parameter);
    if (map->stored == SB_STORED_EXPONENTIAL) sb_key_number(sb, out, "exponent", map->stored_parameter);
    if (map->clear.known) sb_key_number(sb, out, "clear", map->clear.value);
    sb_text(sb, out, "}");
    if (map->has_offset || map->has_shift || map->cull.known || map->depth_clamp.known) {
        sb_key(sb, out, "raster");
        sb_text(sb, out, "{");
        if (map->has_offset) {
            sb_key_number(sb, out, "offset_factor", map->offset[0]);
            sb_key_number(sb, out, "offset_units", map->offset[1]);
            sb_key_number(sb, out, "offset_clamp", map->offset[2]);
        }
        if (map->has_shift) {
            sb_key_number(sb, out, "shift_m", map->shift_m[0]);
            sb_key_number(sb, out, "grazing_shift_m", map->shift_m[1]);
        }
        sb_key_option(sb, out, "cull", map->cull, sb_cull_names);
        sb_key_option(sb, out, "front", map->front, sb_front_names);
        if (map->depth_clamp.known) sb_key_truth(sb, out, "depth_clamp", map->depth_clamp.value);
        sb_text(sb, out, "}");
    }
    if (map->has_interval) {
        sb_key(sb, out, "interval");
        sb_reals(sb, out, map->interval, 2);
    }
    if (map->has_drawn) {
        sb_key(sb, out, "drawn");
        sb_text(sb, out, "[");
        for (i = 0; i < map->drawn_count; ++i) {
            if (i > 0) sb_text(sb, out, ", ");
            sb_string(sb, out, sb->names[map->drawn[i]]);
        }
        sb_text(sb, out, "]");
    }
    sb_text(sb, out, "}");
}

static void sb_write_bias(shadow_bundle* sb, sb_buffer* out, const sb_light_state* light) {
    char units[64];
    int i, known = 0;
    for (i = 0; i < 3; ++i) known |= light->bias[i].known;
    if (!known) return;
    sb_key(sb, out, "bias");
    sb_text(sb, out, "{");
    for (i = 0; i < 3; ++i)
        if (light->bias[i].known) sb_key_number(sb, out, sb_bias_names[i], light->bias[i].value);
    (void)snprintf(units, sizeof units, "%s, %s, %s", sb_unit_names[light->bias_units[0]],
                   sb_unit_names[light->bias_units[1]],
                   sb_unit_names[light->bias[2].known ? light->bias_units[2] : (int)SB_UNIT_METRES]);
    sb_key_text(sb, out, "units", units);
    if (light->bias[2].known && light->normal_by != 0)
        sb_key_text(sb, out, "normal_by", sb_normal_by_names[light->normal_by]);
    sb_text(sb, out, "}");
}

static void sb_write_light(shadow_bundle* sb, sb_buffer* out, int number) {
    const sb_light_state* const light = &sb->lights[number];
    char shader[32];
    int i;
    sb_text(sb, out, "\n    {");
    sb_key_text(sb, out, "name", light->name);
    sb_key_text(sb, out, "type", sb_type_names[light->type]);
    if (light->has_direction) {
        sb_key(sb, out, "direction");
        sb_reals(sb, out, light->direction, 3);
    }
    if (light->has_position) {
        sb_key(sb, out, "position");
        sb_reals(sb, out, light->position, 3);
    }
    if (light->cone_deg.known) sb_key_number(sb, out, "cone_deg", light->cone_deg.value);
    sb_key_option(sb, out, "choice", light->choice, sb_choice_names);
    sb_key(sb, out, "maps");
    sb_text(sb, out, "[");
    for (i = 0; i < light->map_count; ++i) {
        if (i > 0) sb_text(sb, out, ",");
        sb_write_map(sb, out, &sb->maps[light->maps[i]]);
    }
    sb_text(sb, out, "]");
    sb_key(sb, out, "lookup");
    sb_text(sb, out, "{");
    sb_write_bias(sb, out, light);
    if (light->kernel != NULL) sb_key_text(sb, out, "kernel", light->kernel);
    sb_key_option(sb, out, "compare", light->compare, sb_compare_names);
    sb_key_option(sb, out, "filter", light->filter, sb_filter_names);
    sb_key_option(sb, out, "wrap", light->wrap, sb_wrap_names);
    if (light->has_shader) {
        (void)snprintf(shader, sizeof shader, "lookup%d.txt", number);
        sb_key_text(sb, out, "shader", shader);
    }
    sb_text(sb, out, "}}");
}

static void sb_write_frame(shadow_bundle* sb) {
    sb_buffer json = {NULL, 0, 0};
    char *part, *whole;
    int i;
    sb_text(sb, &json, "{\n  \"bundle\": 1");
    sb_text(sb, &json, ",\n  \"made_by\": ");
    sb_string(sb, &json, sb->made_by);
    if (sb->name_count > 0) sb_text(sb, &json, ",\n  \"scene\": \"scene.glb\"");
    if (sb->has_world) {
        sb_text(sb, &json, ",\n  \"world\": {");
        sb_key_text(sb, &json, "up", sb_up_names[sb->up]);
        sb_key_text(sb, &json, "hand", sb_hand_names[sb->hand]);
        sb_key_number(sb, &json, "metres_per_unit", sb->metres_per_unit);
        sb_key(sb, &json, "origin");
        sb_reals(sb, &json, sb->origin, 3);
        sb_text(sb, &json, "}");
    }
    if (sb->has_camera) {
        sb_text(sb, &json, ",\n  \"camera\": {");
        sb_key(sb, &json, "clip_from_world");
        sb_reals(sb, &json, sb->camera.m, 16);
        sb_key_number(sb, &json, "width", sb->camera_width);
        sb_key_number(sb, &json, "height", sb->camera_height);
        sb_key(sb, &json, "depth");
        sb_text(sb, &json, "{");
        sb_key_text(sb, &json, "range", sb_range_names[sb->camera_range]);
        sb_key_truth(sb, &json, "reversed", sb->camera_reversed);
        sb_text(sb, &json, "}}");
    }
    if (sb->has_picture) sb_text(sb, &json, ",\n  \"picture\": \"picture.png\"");
    sb_text(sb, &json, ",\n  \"lights\": [");
    for (i = 0; i < sb->light_count; ++i) {
        if (i > 0) sb_text(sb, &json, ",");
        sb_write_light(sb, &json, i);
    }
    sb_text(sb, &json, "]");
    if (sb->notes.size > 0) {
        sb_text(sb, &json, ",\n  \"notes\": [");
        sb_append(sb, &json, sb->notes.data, sb->notes.size);
        sb_text(sb, &json, "]");
    }
    sb_text(sb, &json, "\n}\n");
    if (json.size > SB_MOST_JSON_BYTES)
        sb_fail(sb, SB_BAD_INPUT, "%s/frame.json: it has more than 4 MiB; leave sb_map_drawn() out", sb->folder);
    sb_save(sb, "frame.json.part", &json);
    sb_release(&json);
    if (sb->code != SB_OK) return;
    part = sb_path(sb, "frame.json.part");
    whole = sb_path(sb, "frame.json");
    if (part != NULL && whole != NULL && rename(part, whole) != 0)
        sb_fail(sb, SB_FILE_ERROR, "%s: %s; choose a folder that can be written", whole, strerror(errno));
    free(part);
    free(whole);
}

/// Checks what single calls cannot: each light has its maps, and all maps have one size.
static void sb_check(shadow_bundle* sb) {
    int width = 0, height = 0, i;
    size_t m;
    if (sb->code != SB_OK) return;
    if (sb->light_count == 0) sb_fail(sb, SB_BAD_INPUT, "%s: there is no light; call sb_light()", sb->folder);
    for (i = 0; i < sb->light_count; ++i) {
        const sb_light_state* const light = &sb->lights[i];
        if (light->map_count == 0) sb_fail(sb, SB_BAD_INPUT, "%s: light %d has no map; call sb_map()", sb->folder, i);
        if (light->choice.known && light->choice.value == SB_CHOICE_ONE && light->map_count > 1)
            sb_fail(sb, SB_BAD_INPUT, "%s: light %d has %d maps and the choice SB_CHOICE_ONE", sb->folder, i,
                    light->map_count);
        if (light->choice.known && light->choice.value == SB_CHOICE_FACE && light->map_count != 6)
            sb_fail(sb, SB_BAD_INPUT, "%s: light %d has %d maps, the choice SB_CHOICE_FACE needs 6", sb->folder, i,
                    light->map_count);
    }
    for (m = 0; m < sb->map_count; ++m) {
        const sb_map_state* const map = &sb->maps[m];
        const int own_width = map->has_region ? map->region[2] : sb->map_images[map->image].width;
        const int own_height = map->has_region ? map->region[3] : sb->map_images[map->image].height;
        const sb_light_state* const light = &sb->lights[map->light];
        if (m == 0) {
            width = own_width;
            height = own_height;
        } else if (own_width != width || own_height != height) {
            sb_fail(sb, SB_BAD_INPUT,
                    "%s: map %lu has %d x %d texels, map 0 has %d x %d; all maps of a bundle have one size", sb->folder,
                    (unsigned long)m, own_width, own_height, width, height);
        }
        if (light->choice.known && light->choice.value == SB_CHOICE_INTERVAL && !map->has_interval)
            sb_fail(sb, SB_BAD_INPUT, "%s: map %lu has no interval; call sb_map_interval()", sb->folder,
                    (unsigned long)m);
    }
}

sb_code sb_end(shadow_bundle* sb, char* message, size_t message_size) {
    sb_code code;
    if (message != NULL && message_size > 0) message[0] = '\0';
    if (sb == NULL) {
        if (message != NULL && message_size > 0) (void)snprintf(message, message_size, "memory lacks");
        return SB_NO_MEMORY;
    }
    sb_check(sb);
    if (sb->code == SB_OK && sb->name_count > 0) sb_write_scene(sb);
    if (sb->code == SB_OK) sb_write_frame(sb);
    code = sb->code;
    if (message != NULL && message_size > 0) (void)snprintf(message, message_size, "%s", sb->message);
    sb_cancel(sb);
    return code;
}

#ifdef __cplusplus
}
#endif
#endif  // SHADOW_BUNDLE_IMPLEMENTATION
