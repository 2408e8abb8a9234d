// Constants of kernels that read moments, shared by C++ and GLSL.
#ifndef SI_SHARED_MOMENTS_H
#define SI_SHARED_MOMENTS_H

// Columns of the transform of (z, z^2, z^3, z^4), 0 <= z <= 1, that spreads the moments over 0 to 1 (Peters, Klein,
// I3D 2015), and of its inverse.
#define MOMENTS_QUANTISE                                                                                               \
    -2.07224649, 13.7948857237, 0.105877704, 9.7924062118, 32.23703778, -59.4683975703, -1.9077466311, -33.7652110555, \
        -68.571074599, 82.0359750338, 9.3496555107, 47.9456096605, 39.3703274134, -35.364903257, -6.6543490743,        \
        -23.9728048165
#define MOMENTS_RESTORE                                                                                            \
    0.2227744146, 0.1549679261, 0.1451988946, 0.163127443, 0.0771972861, 0.1394629426, 0.2120202157, 0.2591432266, \
        0.7926986636, 0.7963415838, 0.7258694464, 0.6539092497, 0.0319417555, -0.1722823173, -0.2758014811,        \
        -0.3376131734
#define MOMENTS_QUANTISE_OFFSET 0.035955884801

// Maximum window of a summed-area look-up in texels, and the integer of a moment of 1 in the table. Sums over the table
// wrap around. A sum over the window with its partly covered texels does not.
#define SUMS_MAX_WINDOW 32
#define SUMS_ONE 3715370.0

#endif
