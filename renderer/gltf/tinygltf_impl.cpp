// tinygltf compiled into the program, for sanitizers; otherwise the system's library is linked and this file is empty.
#ifdef SI_TINYGLTF_HEADER_ONLY
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#define TINYGLTF_IMPLEMENTATION
#include "renderer/gltf/tinygltf_model.h"
#pragma GCC diagnostic pop
#endif
