// Tests of lengths as text with metric prefixes.
#include "renderer/base/lengths_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace si {
namespace {

TEST(LengthsText, HasTheSuitablePrefix) {
    EXPECT_EQ(metres_text(0), "0 m");
    EXPECT_EQ(metres_text(4.2e-7), "0.42 µm");
    EXPECT_EQ(metres_text(-0.05596561193998717), "-56 mm");
    EXPECT_EQ(metres_text(1.5), "1.5 m");
    EXPECT_EQ(metres_text(1250), "1250 m");
    EXPECT_EQ(metres_text(12500), "12.5 km");
    EXPECT_EQ(metres_text(INFINITY), "no distance");
    EXPECT_EQ(texels_text(1), "1 texel");
    EXPECT_EQ(texels_text(0.628), "0.628 texels");
    EXPECT_EQ(texels_text(1250), "1250 texels");
    EXPECT_EQ(texels_text(2.5e6), "2.5 million texels");
    EXPECT_EQ(texels_text(INFINITY), "infinitely many texels");
}

TEST(LengthsText, RoundsToTheNextPrefixWithoutExponents) {
    EXPECT_EQ(metres_text(0.99996e-3), "1 mm");
    EXPECT_EQ(metres_text(0.99996), "1 m");
    EXPECT_EQ(metres_text(999.96), "1000 m");
    EXPECT_EQ(metres_text(9999.9), "10 km");
    EXPECT_EQ(texels_text(999.9), "1000 texels");
    EXPECT_EQ(texels_text(999'999), "1 million texels");
    EXPECT_EQ(texels_text(6e-5), "0.00006 texels");
    EXPECT_EQ(texels_text(1.0e-5), "0.00001 texels");
    EXPECT_EQ(digits_text(1e-20), "0");
    EXPECT_EQ(digits_text(NAN), "nan");
    EXPECT_EQ(signed_text(-INFINITY), "-inf");
    EXPECT_EQ(signed_text(1e-5), "+0.00001");
    EXPECT_EQ(signed_text(-1250.4), "-1250");
    EXPECT_EQ(metres_text(2e18), "2000000000 million km");
    for (double v = 1e-17; v < 1e19; v *= 1.0173)
        for (const std::string& text : {metres_text(v), metres_text(-v), texels_text(v), signed_text(v)})
            EXPECT_FALSE(text.find("e+") != text.npos || text.find("e-") != text.npos) << text;
}

}  // namespace
}  // namespace si
