// Binding points of textures, images, storage and uniform blocks, shared by C++ and GLSL. Each texture has its own
// unit.
#ifndef SI_SHARED_UNITS_H
#define SI_SHARED_UNITS_H

#ifdef __cplusplus
namespace si::shared {
#endif

const int UNIT_SHADOW_MAP = 0;          // as stored
const int UNIT_SHADOW_MAP_COMPARE = 1;  // by a sampler that compares
const int UNIT_BASE_COLOUR = 2;
const int UNIT_NORMAL_MAP = 3;
const int UNIT_VISIBILITY = 4;
const int UNIT_SHADED = 5;
const int UNIT_OVERLAY_VALUES = 6;
const int UNIT_REFERENCE = 7;
const int UNIT_MORE_REFERENCE = 8;
const int UNIT_CLASSIFIED = 9;
const int UNIT_UNFILTERED_MAP = 10;
const int UNIT_MAP_BOUNDS = 12;
const int UNIT_PRECISION = 13;
const int UNIT_SEARCHED = 21;  // image searched for invalid numbers
const int UNIT_MOMENTS = 14;
const int UNIT_LIGHT_MAP = 11;
const int UNIT_VOLUMES = 15;
const int UNIT_CAMERA_DEPTH = 16;
const int UNIT_BLURRED_ROWS = 17;  // result of a blur along x
const int UNIT_MAP_SAMPLES = 18;   // samples of a multisampled map
const int UNIT_MAP_CHANNEL = 19;   // moment in the map viewer
const int UNIT_PAGE_TABLE = 20;
const int UNIT_FLIP = 22;
const int UNIT_BLOBS = 23;
const int UNIT_SEEN_SURFACES = 24;  // and four after it

const int IMAGE_TEXELS_READ = 0;
const int IMAGE_PAGES_WANTED = 1;
const int IMAGE_FRAME_BLOCK = 2;  // frame and settings block as images
const int IMAGE_SETTINGS_BLOCK = 3;
const int IMAGE_DISK_PLACES = 4;

const int STORAGE_LIGHT_MAP_OBJECTS = 0;
const int STORAGE_LIGHT_MAP_TRIANGLES = 1;
const int STORAGE_LIGHT_MAP_CHARTS = 2;
const int STORAGE_SCENE_POSITIONS = 3;
const int STORAGE_SCENE_INDICES = 4;

const int BLOCK_FRAME = 0;
const int BLOCK_SETTINGS = 1;

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
