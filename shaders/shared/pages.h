// A texel of the page table, for C++ and GLSL alike: x, y of the page in the pool, in pages; z: which part of it, where
// it is of a coarser level, x | y << 8; w: its state | levels coarser << 8.
#ifndef SI_SHARED_PAGES_H
#define SI_SHARED_PAGES_H

#ifdef __cplusplus
namespace si::shared {
#endif

const int PAGE_ABSENT = 0;  // nobody asked for it
const int PAGE_CACHED = 1;    // drawn before the pages last changed
const int PAGE_DRAWN = 2;   // drawn then

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
