// Marks that stand for different things are told apart by their hue, and so are the colours of numbers.
#include "ui/widgets/theme.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "shaders/shared/colours.h"

namespace si {
namespace {

double linear(unsigned c) {
    const double v = c / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* (D65).
glm::dvec3 lab(ImU32 c) {
    const glm::dvec3 rgb(linear(c & 255), linear(c >> 8 & 255), linear(c >> 16 & 255));
    const glm::dvec3 xyz(glm::dot(rgb, {0.4124, 0.3576, 0.1805}) / 0.9505, glm::dot(rgb, {0.2126, 0.7152, 0.0722}),
                         glm::dot(rgb, {0.0193, 0.1192, 0.9505}) / 1.0890);
    glm::dvec3 f;
    for (int i = 0; i < 3; ++i) f[i] = xyz[i] > 0.008856 ? std::cbrt(xyz[i]) : 7.787 * xyz[i] + 16 / 116.0;
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

TEST(Theme, MarksOfDifferentThingsHaveColoursOfTheirOwn) {
    const std::map<std::string, ImU32> marks = {
        {"light", theme::kLight},   {"lit", theme::kLit},       {"shadowed", theme::kShadowed},
        {"offset", theme::kOffset}, {"linked", theme::kLinked}, {"probed", theme::kProbed},
        {"frozen", theme::kFrozen}, {"live", theme::kLive},     {"selected", theme::kSelected}};
    for (auto a = marks.begin(); a != marks.end(); ++a)
        for (auto b = std::next(a); b != marks.end(); ++b)
            EXPECT_GT(glm::distance(lab(a->second), lab(b->second)), 22) << a->first << " and " << b->first;
}

TEST(Theme, ColoursOfShadersArriveUnchanged) {
    EXPECT_EQ(theme::colour({1, 0, 0.5}), IM_COL32(255, 0, 128, 255));
    // From dark to bright, as grey too.
    EXPECT_LT(lab(theme::colour(shared::SEQUENTIAL_LOW)).x, 25);
    EXPECT_GT(lab(theme::colour(shared::SEQUENTIAL_HIGH)).x, 80);
    EXPECT_GT(lab(theme::colour(shared::DIVERGING_MIDDLE)).x, lab(theme::colour(shared::DIVERGING_HIGH)).x + 30);
    EXPECT_GT(lab(theme::colour(shared::DIVERGING_MIDDLE)).x, lab(theme::colour(shared::DIVERGING_LOW)).x + 30);
}

}  // namespace
}  // namespace si
