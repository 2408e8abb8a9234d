// When a surface faces a light, for C++ and GLSL alike.
#ifndef SI_SHARED_FACING_H
#define SI_SHARED_FACING_H

#ifdef __cplusplus
namespace si::shared {
#endif

// The cosine between its normal and the direction to the light up to which a surface faces away. What that leaves out
// is below a millionth of the light, and single precision cannot tell it from a surface parallel to the light.
const float FACES_AWAY_COSINE = 1e-6;

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
