// Texel of the page table, shared by C++ and GLSL. x, y: place of the page in the pool, in pages; z: part of a coarser
// page, x | y << 8; w: state | levels coarser << 8.
#ifndef SI_SHARED_PAGES_H
#define SI_SHARED_PAGES_H

#ifdef __cplusplus
namespace si::shared {
#endif

const int PAGE_ABSENT = 0;  // not requested
const int PAGE_CACHED = 1;  // drawn before the last update of pages
const int PAGE_DRAWN = 2;   // drawn in the last update of pages

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
