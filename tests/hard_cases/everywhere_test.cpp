// Compares every hard case far from the origin, at all scales, mirrored, and under lights along every axis with the
// unmoved case: picture, reference and causes must be equal.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>

#include "renderer/measure/measured_error.h"
#include "tests/support/hard_view.h"
#include "tests/support/placements.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

constexpr int kAcross = 96, kDown = 72, kMaxTexels = 256;
/// Share of all pixels of a case that rounding may move across an edge.
constexpr double kMaxDifferingShare = 5e-4;
constexpr double kMaxDifferingShareOfOne = 1.5e-3;  ///< share of one picture's pixels: ten
constexpr double kSameCause = 0.99;                 ///< least share of wrong pixels with equal cause
// Resolution of a double at the offset, in radii of the scene. Above the first limit no picture can be equal. Above
// the second the light's position, no sum of few powers of two, and some last bits of floats round differently from
// the unmoved case.
constexpr double kFinestPlace = 1e-6, kFinestSameBytes = 1e-9;
// Difference of visibility between the two limits: up to 6e-5, and 1.1e-4 for moments in steps of 16 bits. One tap of
// a kernel, or one pixel of an edge, would be a hundredth or more.
constexpr double kLastBits = 1e-3;

std::string key_name(const testing::TestParamInfo<const HardCase*>& info) {
    return identifier(info.param->key);
}

/// Case whose picture may differ by more than rounding, with the reason.
struct Allowance {
    std::string_view key, why;
    double look = 0.02;  ///< smallest difference of visibility that counts
    bool mirrors = true;
    std::size_t inside = 0;  ///< accepted pixels of one picture away from edges of the unmoved case
    double same_cause = kSameCause;
    double finest_place = kFinestPlace;
};
constexpr Allowance kAllowances[] = {
    {"no-blockers", "the places of its taps turn by pixel, and are no mirror image", 0.02, false},
    {"edge-on-planes",
     "kernels span several steps, whose depths lie at all distances from the plane: a tap of 25 may turn, and whether "
     "the least bias leaves a whole row of them dark hangs on what positions are rounded by, which is more off the "
     "grid",
     0.1, true, 0, 0.98},
    {"thin-caster",
     "a wire that no texel caught at home is an edge that no pixel shows; corners snap otherwise in a mirror", 0.02,
     true, 4},
    {"smooth-terminator",
     "facets lie exactly along the light from -z, 45 up: which of their sides it meets is rounding's to say", 0.02,
     true, 0, kSameCause, 3e-7},
};

/// Cases whose faults are rounding errors of single precision: the affected pixels depend on the rounding of
/// positions.
constexpr std::string_view kRoundingIsTheFault[] = {"reversed-depth", "variance-cancels", "moment-steps",
                                                    "summed-areas", "edge-on-planes"};

Allowance allowance_of(std::string_view key) {
    for (const Allowance& a : kAllowances)
        if (a.key == key) return a;
    return {key, ""};
}

/// Returns the resolution of a double at the placement, in radii of the scene.
double resolved(const HardCase& row, const Placement& placement) {
    const glm::dvec3& at = distances()[placement.distance].offset;
    return glm::length(at) * 0x1p-53 / (row.make().bounds.radius() * scales()[placement.scale].factor);
}

/// Picture with its reference.
struct ClassifiedPicture {
    std::vector<float> visibility, reference;
    std::vector<PixelState> state;
    std::vector<Artefact> cause;
    bool operator==(const ClassifiedPicture&) const = default;
};

/// Draws and classifies a placed case. @param turn change of the light's elevation, degrees
std::optional<ClassifiedPicture> classified(const HardCase& row, bool fixed, const Placement& placement,
                                            double turn = 0) {
    DrawnCase c = hard_view(row.key, fixed);
    c.settings.map.resolution = std::min(c.settings.map.resolution, kMaxTexels);
    if (!place_settings(c.settings, placement) || resolved(row, placement) > allowance_of(row.key).finest_place)
        return {};
    c.settings.lights[0].elevation += turn;
    if (!placement.is_unmoved()) place_scene(c.scene, placement.matrix());
    ReferenceCache cache;
    const MeasuredError e =
        measure_error(hard_renderer(), c.scene, c.settings, {.width = kAcross, .height = kDown}, 0, {}, cache);
    ClassifiedPicture out;
    for (int y = 0; y < kDown; ++y)
        for (int x = 0; x < kAcross; ++x) {
            const auto i = std::size_t(y * kAcross + (placement.mirrored ? kAcross - 1 - x : x));
            out.visibility.push_back(e.classified[i].visibility);
            out.reference.push_back(e.traced.reference->visibility.data[i]);
            out.state.push_back(e.traced.reference->state[i]);
            out.cause.push_back(e.classified[i].artefact);
        }
    for (const std::string& message : hard_renderer().take_gl_messages()) ADD_FAILURE() << "driver: " << message;
    return out;
}

/// Returns whether the unmoved picture changes within two pixels, where rounding may show.
bool near_edge(const ClassifiedPicture& home, std::size_t i) {
    const int x = int(i) % kAcross, y = int(i) / kAcross;
    for (int v = std::max(y - 2, 0); v <= std::min(y + 2, kDown - 1); ++v)
        for (int u = std::max(x - 2, 0); u <= std::min(x + 2, kAcross - 1); ++u) {
            const auto k = std::size_t(v * kAcross + u);
            if (std::abs(home.visibility[k] - home.visibility[i]) > 0.02f || home.reference[k] != home.reference[i] ||
                home.state[k] != home.state[i])
                return true;
        }
    return false;
}

struct Differences {
    std::size_t pixels = 0, visibility = 0, reference = 0, inside = 0, wrong = 0, other_cause = 0;
    void add(const ClassifiedPicture& home, const ClassifiedPicture& there, double look) {
        pixels += home.state.size();
        for (std::size_t i = 0; i < home.state.size(); ++i) {
            const bool seen = std::abs(home.visibility[i] - there.visibility[i]) > look;
            // Outside a cone, where no reference counts, a ray may run within a plane and meet it or not.
            const bool counts = home.state[i] != PixelState::OutsideCone;
            const bool known =
                (counts && std::abs(home.reference[i] - there.reference[i]) > 0.02f) || home.state[i] != there.state[i];
            visibility += seen;
            reference += known;
            inside += (seen || known) && !near_edge(home, i);
            if (home.cause[i] == Artefact::None || there.cause[i] == Artefact::None) continue;
            ++wrong;
            other_cause += home.cause[i] != there.cause[i];
        }
    }
};

/// Returns the differences of two pictures in words.
std::string bytes_off(const ClassifiedPicture& a, const ClassifiedPicture& b) {
    std::size_t visibility = 0, reference = 0, state = 0, cause = 0;
    float most = 0;
    for (std::size_t i = 0; i < a.state.size(); ++i) {
        visibility += a.visibility[i] != b.visibility[i];
        reference += a.reference[i] != b.reference[i];
        state += a.state[i] != b.state[i];
        cause += a.cause[i] != b.cause[i];
        most = std::max(most, std::abs(a.visibility[i] - b.visibility[i]));
    }
    return std::to_string(visibility) + " visibilities by up to " + std::to_string(most) + ", " +
           std::to_string(reference) + " references, " + std::to_string(state) + " states and " +
           std::to_string(cause) + " causes differ";
}

/// Pictures of unmoved cases, by case, fix and light.
class UnmovedPictures {
public:
    const ClassifiedPicture& picture_of(const HardCase& row, bool fixed, std::size_t light) {
        const auto key = std::tuple(row.number, fixed, light);
        if (const auto it = pictures_.find(key); it != pictures_.end()) return it->second;
        return pictures_[key] = *classified(row, fixed, {.light = light});
    }

private:
    std::map<std::tuple<int, bool, std::size_t>, ClassifiedPicture> pictures_;
};

/// Compares placements of a case with the unmoved case. Returns the number of comparisons.
int compare_places(const HardCase& row, bool fixed, const std::vector<Placement>& placements,
                   UnmovedPictures& unmoved_pictures, Differences& all) {
    const Allowance allowed = allowance_of(row.key);
    const bool rounding = !fixed && std::ranges::find(kRoundingIsTheFault, row.key) != std::end(kRoundingIsTheFault);
    const double look = rounding ? 1 : allowed.look;
    int compared = 0;
    for (const Placement& placement : placements) {
        if (placement.is_unmoved() || (placement.mirrored && !allowed.mirrors)) continue;
        SCOPED_TRACE(std::string(row.key) + ": " + placement.name());
        const ClassifiedPicture& home = unmoved_pictures.picture_of(row, fixed, placement.light);
        const auto there = classified(row, fixed, placement);
        if (!there) continue;
        ++compared;
        if (placement.exact() && resolved(row, placement) <= kFinestSameBytes) {
            EXPECT_TRUE(home == *there) << "no number is rounded on the way: the same bytes are due, of which "
                                        << bytes_off(home, *there);
        }
        if (placement.exact() && placement.light == 0 && !rounding) {
            double most = 0;
            for (std::size_t i = 0; i < home.state.size(); ++i)
                most = std::max(most, std::abs(double(home.visibility[i]) - there->visibility[i]));
            EXPECT_LE(most, kLastBits) << "an edge moved where the scene is rounded by nothing";
        }
        Differences here;
        here.add(home, *there, look);
        EXPECT_LE(here.inside, allowed.inside)
            << "of " << here.visibility << " pixels that look and " << here.reference << " that are otherwise";
        EXPECT_LE(std::max(here.visibility, here.reference),
                  std::size_t(kMaxDifferingShareOfOne * double(here.pixels)));
        all.add(home, *there, look);
    }
    return compared;
}

void expect_alike(const HardCase& row, const Differences& d) {
    testing::Test::RecordProperty("differing", std::to_string(d.visibility) + " look and " +
                                                   std::to_string(d.reference) + " are otherwise of " +
                                                   std::to_string(d.pixels) + "; " + std::to_string(d.other_cause) +
                                                   " of " + std::to_string(d.wrong) + " wrong ones have another cause");
    EXPECT_LE(double(d.visibility), kMaxDifferingShare * double(d.pixels))
        << "pixels that look otherwise, of " << d.pixels;
    EXPECT_LE(double(d.reference), kMaxDifferingShare * double(d.pixels))
        << "pixels that are otherwise, of " << d.pixels;
    EXPECT_GE(double(d.wrong - d.other_cause), allowance_of(row.key).same_cause * double(d.wrong))
        << "wrong pixels of one cause";
}

constexpr std::uint32_t kSeed = 20260101;

/// Returns the cases that can be moved. Maps that an engine gives stay where they are, and those
/// cases have tests of their own.
std::vector<const HardCase*> all_rows() {
    std::vector<const HardCase*> rows;
    for (const HardCase& row : hard_cases())
        if (hard_view(row.key, true).settings.map.bundle.empty()) rows.push_back(&row);
    return rows;
}

/// Returns the placements of a case in the pairwise table of cases and placements.
std::vector<Placement> in_pairs(const HardCase& row) {
    static const std::vector<const HardCase*> rows = all_rows();
    static const std::vector<PlacedCase> array = pairwise_placements(rows.size(), kSeed);
    std::vector<Placement> out;
    for (const PlacedCase& c : array)
        if (rows[c.case_index]->number == row.number) out.push_back(c.placement);
    return out;
}

// Exactly along an axis, where sines are 0 and faces stand parallel to the light, results equal those a millionth of a
// radian off the axis.
void expect_axes_nothing_special(const HardCase& row, UnmovedPictures& unmoved_pictures) {
    // A larger turn would move the shadows of grazing light; upwards, it would light a strip below tops of one height.
    const double turn = -1e-6 * 180 / M_PI;
    std::size_t pixels = 0, look = 0, wrong = 0, other_cause = 0;
    for (std::size_t light = 1; light < light_directions().size(); ++light) {
        const ClassifiedPicture& exact = unmoved_pictures.picture_of(row, true, light);
        const auto off_axis = classified(row, true, {.light = light}, turn);
        ASSERT_TRUE(off_axis);
        for (std::size_t i = 0; i < exact.state.size(); ++i) {
            // Faces parallel to the light face away from it, and a little towards it off the axis.
            if (exact.state[i] != PixelState::Counted || off_axis->state[i] != PixelState::Counted) continue;
            ++pixels;
            look += std::abs(exact.visibility[i] - off_axis->visibility[i]) > 0.5f;
            if (exact.cause[i] == Artefact::None || off_axis->cause[i] == Artefact::None) continue;
            ++wrong;
            other_cause += exact.cause[i] != off_axis->cause[i];
        }
    }
    EXPECT_LE(double(look), 1e-3 * double(pixels)) << "pixels that look different off an axis";
    EXPECT_LE(double(other_cause), std::max(1.0, (1 - kSameCause) * double(wrong))) << "of another cause there";
}

class HardCasesEverywhere : public testing::TestWithParam<const HardCase*> {};

// One test draws all placements of a case, so that one process compiles its programs.
SI_TEST_IS(Later, HardCasesEverywhere, LookAndErrAsInPlace);
TEST_P(HardCasesEverywhere, LookAndErrAsInPlace) {
    const HardCase& row = *GetParam();
    UnmovedPictures unmoved_pictures;
    Differences d;
    EXPECT_GE(compare_places(row, true, single_factor_placements(), unmoved_pictures, d), 14)
        << "most placements must lie in settings' ranges";
    EXPECT_GE(compare_places(row, true, exact_placements(), unmoved_pictures, d), 6);
    EXPECT_GE(compare_places(row, true, in_pairs(row), unmoved_pictures, d), 4);
    expect_alike(row, d);
    expect_axes_nothing_special(row, unmoved_pictures);
    // The case with its fault is compared too: errors and their causes are equal everywhere.
    if (row.broken.empty()) return;
    Differences faults;
    compare_places(row, false, single_factor_placements(), unmoved_pictures, faults);
    compare_places(row, false, exact_placements(), unmoved_pictures, faults);
    expect_alike(row, faults);
}

INSTANTIATE_TEST_SUITE_P(Each, HardCasesEverywhere, testing::ValuesIn(all_rows()), key_name);

// SI_LONG=1, or ctest -L long, runs this test.
TEST_P(HardCasesEverywhere, LookAndErrAsInPlaceInEveryPlacement) {
    if (!std::getenv("SI_LONG")) GTEST_SKIP() << "some 800 pictures a case: SI_LONG=1";
    UnmovedPictures unmoved_pictures;
    Differences d;
    compare_places(*GetParam(), true, all_placements(), unmoved_pictures, d);
    expect_alike(*GetParam(), d);
}

// The table covers all pairs.
TEST(HardCasesPlacements, PairsAreComplete) {
    const auto rows = pairwise_placements(36, kSeed);
    std::set<std::array<std::size_t, 4>> pairs;
    for (const PlacedCase& c : rows) {
        const Placement& p = c.placement;
        const std::size_t v[] = {c.case_index, p.distance, p.scale, p.light, p.mirrored ? 1u : 0u};
        for (std::size_t a = 0; a < 5; ++a)
            for (std::size_t b = a + 1; b < 5; ++b) pairs.insert({a, v[a], b, v[b]});
    }
    const std::size_t d = distances().size(), s = scales().size(), l = light_directions().size();
    // Left out are mirrored placements under lights without mirror symmetry, and unmoved rows, which compare nothing.
    const std::size_t whole = 36 * (d + s + l + 2) + d * s + d * l + 2 * d + s * l + 2 * s + 2 * l;
    EXPECT_GE(pairs.size() + 60, whole);
    RecordProperty("rows", int(rows.size()));
    EXPECT_LT(rows.size(), 500u);
}

}  // namespace
}  // namespace si::test
