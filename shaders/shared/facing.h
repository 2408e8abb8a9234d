// Limit of the angle at which a surface faces a light, shared by C++ and GLSL.
#ifndef SI_SHARED_FACING_H
#define SI_SHARED_FACING_H

#ifdef __cplusplus
namespace si::shared {
#endif

// Cosine between normal and light direction up to which a surface faces away. The omitted light is below a millionth,
// and single precision cannot distinguish such a surface from one parallel to the light.
const float FACES_AWAY_COSINE = 1e-6;

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
