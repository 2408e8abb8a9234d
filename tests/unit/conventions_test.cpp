// Tests of conventions that are found: each combination is written into a map, and found again from matrix and scene.
#include "renderer/bundle/conventions.h"

#include <gtest/gtest.h>

#include "renderer/bundle/light_file.h"
#include "renderer/projection/projection.h"
#include "tests/support/error_text.h"
#include "tests/support/ray_traced_map.h"

namespace si {
namespace {

const glm::dvec3 kCentre{1000, 50, -2000};

/// Matrices and facts of a light over test::unequal_boxes(kCentre).
struct TestLight {
    test::TracedMap map;
    glm::dmat4 view{1.0}, projection{1.0};
    BundleLight light;
};

TestLight make_light(bool perspective, const DepthConvention& depth, const glm::dvec3& centre = kCentre,
                     const glm::dvec3& forward = glm::normalize(glm::dvec3(0.35, -1, 0.2))) {
    TestLight out;
    // The sun of a symmetric scene has a symmetric map.
    const glm::dvec3 up = forward.x == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(0.2, 1, 0.1);
    const glm::dvec3 right = glm::normalize(glm::cross(up, -forward));
    const glm::dmat3 axes(right, glm::cross(-forward, right), -forward);
    DepthCurve curve;
    curve.perspective = perspective;
    curve.near = perspective ? 9 : 6;
    curve.far = 40;
    curve.convention = depth;
    const glm::dvec3 eye = centre - 18.0 * forward;
    out.view = clip_from_relative(glm::dmat4(1), axes, eye, glm::dvec3(0));
    out.projection = projection_matrix(curve, perspective ? 0.7 : 9, perspective ? 0.35 : 7);
    out.map.clip_from_world = out.projection * out.view;
    out.map.depth = depth;
    out.map.eye = eye;
    out.map.forward = forward;
    out.map.near = curve.near;
    out.map.far = curve.far;
    out.light.type = perspective ? LightType::Spot : LightType::Directional;
    out.light.maps.resize(1);
    return out;
}

/// Writes a map by a convention, and finds it again. @param known parts that are stated
ConventionFits found(TestLight light, const Convention& c, const KnownConvention& known = {}, int bits = 0,
                     bool scene = true) {
    const auto boxes = test::unequal_boxes(kCentre);
    light.map.stored = c.stored;
    light.map.bits = bits;
    FloatImage image = test::traced_map(light.map, boxes);
    if (c.first_row == FirstRow::Bottom) image = test::upside_down(image);
    BundleMap& map = light.light.maps.front();
    const glm::dmat4 m = light.map.clip_from_world;
    map.clip.clip_from_world = c.matrix == MatrixOrder::Rows ? glm::transpose(m) : m;
    if (bits == 16) map.depth.format = BundleDepthFormat::D16;
    return fit_conventions(light.light, true, glm::dmat4(1), image, known,
                           scene ? test::casters_of(boxes) : FirstCasters());
}

std::string shown(const ConventionFits& fits) {
    std::string out;
    for (std::size_t i = 0; i < std::min<std::size_t>(fits.fits.size(), 4); ++i) {
        const ConventionFit& f = fits.fits[i];
        out += "\n" + std::to_string(f.convention.depth.zero_to_one) + std::to_string(f.convention.depth.reversed) +
               std::to_string(int(f.convention.first_row)) + std::to_string(int(f.convention.matrix)) +
               std::to_string(int(f.convention.stored)) + " " + fit_sentence(f, fits.over_scene);
    }
    return out;
}

TEST(Conventions, EachCombinationIsFoundOverASceneFarFromTheOrigin) {
    for (const bool perspective : {true, false})
        for (const bool zero_to_one : {true, false})
            for (const bool reversed : {true, false})
                for (const FirstRow first_row : {FirstRow::Bottom, FirstRow::Top})
                    for (const MatrixOrder matrix : {MatrixOrder::Columns, MatrixOrder::Rows})
                        for (const int bits : {0, 16}) {
                            const Convention c{{zero_to_one, reversed}, first_row, matrix};
                            const ConventionFits fits = found(make_light(perspective, c.depth), c, {}, bits);
                            ASSERT_EQ(fits.equal, 1u) << perspective << shown(fits);
                            EXPECT_EQ(fits.fits.front().convention, c) << perspective << bits << shown(fits);
                            EXPECT_LT(fits.fits.front().share_off(), 0.01) << shown(fits);
                            EXPECT_LT(fits.fits.front().median_m, bits ? 2e-3 : 1e-4) << shown(fits);
                        }
}

TEST(Conventions, EachStoredKindIsFound) {
    for (const BundleStored stored : {BundleStored::Depth, BundleStored::Linear, BundleStored::AxisMetres,
                                      BundleStored::DistanceMetres, BundleStored::DistanceShare})
        for (const FirstRow first_row : {FirstRow::Bottom, FirstRow::Top}) {
            Convention c{{true, false}, first_row};
            c.stored = stored;
            const ConventionFits fits = found(make_light(true, c.depth), c);
            ASSERT_EQ(fits.equal, 1u) << int(stored) << shown(fits);
            EXPECT_EQ(fits.fits.front().convention.stored, stored) << shown(fits);
            EXPECT_EQ(fits.fits.front().convention.first_row, first_row) << shown(fits);
            EXPECT_EQ(fits.fits.front().convention.range_m.has_value(), stored == BundleStored::DistanceShare);
        }
}

TEST(Conventions, TheProductOfViewAndProjectionIsFound) {
    const auto boxes = test::unequal_boxes(kCentre);
    for (const bool perspective : {true, false})
        for (const MatrixOrder matrix : {MatrixOrder::Columns, MatrixOrder::Rows})
            for (const ProductOrder product : {ProductOrder::ProjectionView, ProductOrder::ViewProjection}) {
                TestLight light = make_light(perspective, {true, false});
                BundleMatrix& clip = light.light.maps.front().clip;
                clip.view = matrix == MatrixOrder::Rows ? glm::transpose(light.view) : light.view;
                clip.projection = matrix == MatrixOrder::Rows ? glm::transpose(light.projection) : light.projection;
                if (product == ProductOrder::ViewProjection) std::swap(clip.view, clip.projection);
                const ConventionFits fits = fit_conventions(
                    light.light, true, glm::dmat4(1), test::traced_map(light.map, boxes), {}, test::casters_of(boxes));
                ASSERT_EQ(fits.equal, 1u) << shown(fits);
                EXPECT_EQ(fits.fits.front().convention.matrix, matrix) << shown(fits);
                EXPECT_EQ(fits.fits.front().convention.product, product) << shown(fits);
                const BundleLight read = with_convention(light.light, fits.fits.front().convention);
                EXPECT_EQ(read.maps.front().clip.matrix(), light.projection * light.view);
            }
}

TEST(Conventions, AnEngineInCentimetresWithZUpIsCompared) {
    const glm::dmat3 y_up_from_z_up({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    const glm::dmat4 world(0.01 * y_up_from_z_up);
    const auto boxes = test::unequal_boxes(kCentre);
    TestLight light = make_light(true, {false, true});
    light.light.maps.front().clip.clip_from_world = light.map.clip_from_world * world;
    const ConventionFits fits =
        fit_conventions(light.light, true, world, test::traced_map(light.map, boxes), {}, test::casters_of(boxes));
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    EXPECT_EQ(fits.fits.front().convention.depth, (DepthConvention{false, true})) << shown(fits);
}

/// Makes the light of a file in other axes, whose map shows boxes of the scene.
BundleLight light_in_axes(const TestLight& light, const LightAxes& axes) {
    BundleLight out = light.light;
    out.maps.front().clip.clip_from_world = light.map.clip_from_world * axes.scene_from_light();
    return out;
}

TEST(Conventions, AxesHandAndUnitOfTheLightsFileAreFound) {
    const LightAxes kTried[] = {{UpAxis::Z, MirroredAxis::None, 1},      {UpAxis::MinusZ, MirroredAxis::None, 1},
                                {UpAxis::X, MirroredAxis::None, 1},      {UpAxis::MinusX, MirroredAxis::None, 1},
                                {UpAxis::MinusY, MirroredAxis::None, 1}, {UpAxis::Y, MirroredAxis::X, 1},
                                {UpAxis::Y, MirroredAxis::Y, 1},         {UpAxis::Y, MirroredAxis::Z, 1},
                                {UpAxis::Y, MirroredAxis::None, 0.01},   {UpAxis::Y, MirroredAxis::None, 100},
                                {UpAxis::Y, MirroredAxis::None, 0.001},  {UpAxis::Y, MirroredAxis::None, 1000},
                                {UpAxis::Y, MirroredAxis::None, 0.0254}, {UpAxis::Y, MirroredAxis::None, 1 / 0.0254},
                                {UpAxis::Y, MirroredAxis::None, 0.3048}, {UpAxis::Y, MirroredAxis::None, 1 / 0.3048},
                                {UpAxis::Z, MirroredAxis::X, 0.01},      {UpAxis::Z, MirroredAxis::Y, 0.0254}};
    for (const glm::dvec3& centre : {kCentre, glm::dvec3(0)})
        for (const LightAxes& axes : kTried) {
            const bool perspective = axes.unit == 1;
            const DepthConvention depth{perspective, !perspective};
            TestLight light = make_light(perspective, depth, centre);
            const auto boxes = test::unequal_boxes(centre);
            const FloatImage image = test::upside_down(test::traced_map(light.map, boxes));
            const BundleLight own = light_in_axes(light, axes);
            const ConventionFits fits = fit_conventions(own, true, glm::dmat4(1), image, {}, test::casters_of(boxes));
            ASSERT_EQ(fits.equal, 1u) << int(axes.up) << int(axes.mirrored) << " " << axes.unit << shown(fits);
            const Convention& found = fits.fits.front().convention;
            EXPECT_EQ(found.axes, axes) << shown(fits);
            EXPECT_EQ(found.depth, depth) << shown(fits);
            EXPECT_LT(fits.fits.front().share_off(), 0.01) << shown(fits);
            // The light that is written has the scene's axes.
            const glm::dmat4 read = with_convention(own, found).maps.front().clip.matrix();
            const glm::dvec4 there = light.map.clip_from_world * glm::dvec4(centre, 1);
            EXPECT_LT(glm::distance(read * glm::dvec4(centre, 1), there), 1e-6 * glm::length(there));
        }
}

TEST(Conventions, StatedAxesAreNotSearched) {
    const LightAxes axes{UpAxis::Z, MirroredAxis::X, 0.01};
    const TestLight light = make_light(true, {true, false});
    const auto boxes = test::unequal_boxes(kCentre);
    const FloatImage image = test::traced_map(light.map, boxes);
    KnownConvention known;
    known.up = UpAxis::Z;
    known.mirrored = MirroredAxis::X;
    known.unit = 0.01;
    const auto found_of = [&](const KnownConvention& k) {
        return fit_conventions(light_in_axes(light, axes), true, glm::dmat4(1), image, k, test::casters_of(boxes));
    };
    ConventionFits fits = found_of(known);
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    for (const ConventionFit& fit : fits.fits) EXPECT_EQ(fit.convention.axes, axes);
    known.unit = 100;
    fits = found_of(known);
    EXPECT_EQ(fits.equal, 0u) << shown(fits);
    known.unit.reset();
    fits = found_of(known);
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    EXPECT_EQ(fits.fits.front().convention.axes, axes);
    // A unit that is none of those tried is taken where it is stated.
    TestLight other = make_light(true, {true, false});
    const LightAxes odd{UpAxis::Y, MirroredAxis::None, 0.37};
    known = {};
    known.unit = 0.37;
    fits = fit_conventions(light_in_axes(other, odd), true, glm::dmat4(1), image, known, test::casters_of(boxes));
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    EXPECT_EQ(fits.fits.front().convention.axes, odd);
}

TEST(Conventions, ASymmetricSceneLeavesOtherAxesToTheUser) {
    // A floor and a box about the origin look the same with x mirrored, from a light in the plane x = 0.
    const std::vector<test::TestBox> boxes = {{{-8, -1, -8}, {8, 0, 8}}, {{-1, 0, -2}, {1, 3, 1}}};
    TestLight light = make_light(false, {true, false}, glm::dvec3(0), glm::normalize(glm::dvec3(0, -1, 0.4)));
    const FloatImage image = test::traced_map(light.map, boxes);
    const auto found_of = [&](const LightAxes& axes) {
        return fit_conventions(light_in_axes(light, axes), true, glm::dmat4(1), image, {}, test::casters_of(boxes));
    };
    const ConventionFits own = found_of({});
    ASSERT_EQ(own.equal, 1u) << shown(own);
    EXPECT_EQ(own.fits.front().convention.axes, LightAxes());
    EXPECT_GE(own.other_axes, 1u) << shown(own);
    const ConventionFits turned = found_of({UpAxis::Z, MirroredAxis::None, 1});
    EXPECT_GE(turned.equal, 2u) << "nothing tells x from -x" << shown(turned);
}

TEST(Conventions, AWrongStatedPartIsNamedByItsEffect) {
    KnownConvention known;
    known.stored = BundleStored::Linear;
    const Convention truth{{true, false}};
    const ConventionFits fits = found(make_light(true, truth.depth), truth, known);
    EXPECT_EQ(fits.equal, 0u) << shown(fits);
    EXPECT_TRUE(fits.fits.front().known);
    EXPECT_GT(fits.fits.front().share_off(), 0.5);
    const auto other = std::ranges::find_if(fits.fits, [](const ConventionFit& f) { return !f.known; });
    ASSERT_NE(other, fits.fits.end());
    EXPECT_EQ(other->convention, truth);
    EXPECT_LT(other->share_off(), 0.01);

    // A map whose values run the other way.
    TestLight light = make_light(false, truth.depth);
    FloatImage image = test::traced_map(light.map, test::unequal_boxes(kCentre));
    for (float& v : image.data) v = 0.5f * v;
    light.light.maps.front().clip.clip_from_world = light.map.clip_from_world;
    known.stored = BundleStored::Depth;
    known.zero_to_one = true;
    known.reversed = false;
    const ConventionFits near =
        fit_conventions(light.light, true, glm::dmat4(1), image, known, test::casters_of(test::unequal_boxes(kCentre)));
    EXPECT_TRUE(test::mentions(fit_sentence(near.fits.front(), true), {"lies behind the map", "reversed depth?"}));
}

TEST(Conventions, WithoutASceneOnlyTheRangeTells) {
    const Convention truth{{true, false}, FirstRow::Bottom};
    KnownConvention known;
    known.first_row = FirstRow::Bottom;
    known.stored = BundleStored::Depth;
    const ConventionFits open = found(make_light(true, truth.depth), truth, known, 0, false);
    EXPECT_GE(open.equal, 1u) << shown(open);
    known.zero_to_one = true;
    const ConventionFits fits = found(make_light(true, truth.depth), truth, known, 0, false);
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    EXPECT_EQ(fits.fits.front().convention, truth);
}

TEST(Conventions, AStatedDirectionDecidesBetweenBothEndsOfParallelRays) {
    const Convention truth{{true, true}, FirstRow::Bottom};
    TestLight light = make_light(false, truth.depth);
    KnownConvention known;
    known.first_row = FirstRow::Bottom;
    known.stored = BundleStored::Depth;
    known.zero_to_one = true;
    EXPECT_EQ(found(light, truth, known, 0, false).equal, 2u) << "no texel is empty";
    std::vector<test::TestBox> no_ground = test::unequal_boxes(kCentre);
    no_ground.erase(no_ground.begin());
    BundleLight with_sky = light.light;
    with_sky.maps.front().clip.clip_from_world = light.map.clip_from_world;
    const FloatImage image = test::upside_down(test::traced_map(light.map, no_ground));
    const ConventionFits by_sky = fit_conventions(with_sky, true, glm::dmat4(1), image, known, {});
    EXPECT_EQ(by_sky.equal, 1u) << "empty texels lie on one plane" << shown(by_sky);
    EXPECT_EQ(by_sky.fits.front().convention.depth, truth.depth) << shown(by_sky);
    light.light.direction = 5.0 * light.map.forward;
    const ConventionFits fits = found(light, truth, known, 0, false);
    ASSERT_EQ(fits.equal, 1u) << shown(fits);
    EXPECT_EQ(fits.fits.front().convention, truth);
    const auto other = std::ranges::find_if(fits.fits, [](const ConventionFit& f) {
        return f.convention.depth == DepthConvention{true, false} && f.convention.matrix == MatrixOrder::Columns;
    });
    ASSERT_NE(other, fits.fits.end());
    EXPECT_TRUE(test::mentions(other->refusal, {"the matrix", "not along the direction"}));
}

TEST(LightFile, AMatrixAloneIsEnough) {
    const std::string matrix = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";
    const LightFile light = parse_light_file("{\"clip_from_world\": " + matrix + "}", "LIGHT.json", "map.pfm");
    EXPECT_FALSE(light.type_known);
    EXPECT_FALSE(light.known.zero_to_one || light.known.reversed || light.known.first_row || light.known.stored);
    ASSERT_EQ(light.bundle.lights.size(), 1u);
    ASSERT_EQ(light.bundle.lights[0].maps.size(), 1u);
    EXPECT_EQ(light.bundle.lights[0].maps[0].image.file, "map.pfm");
    EXPECT_EQ(light.bundle.lights[0].maps[0].clip.clip_from_world, glm::dmat4(1));

    const LightFile stated = parse_light_file(
        "{\"type\": \"spot\", \"world\": {\"up\": \"z\"}, \"maps\": [{\"clip_from_world\": " + matrix +
            ", \"image\": {\"file\": \"engine.exr\", \"first_row\": \"top\"}, \"depth\": {\"range\": \"-1..1\", "
            "\"reversed\": true, \"stored\": \"linear\"}}]}",
        "LIGHT.json", "map.exr");
    EXPECT_TRUE(stated.type_known);
    EXPECT_EQ(stated.bundle.world.up, UpAxis::Z);
    EXPECT_EQ(stated.known.zero_to_one, false);
    EXPECT_EQ(stated.known.reversed, true);
    EXPECT_EQ(stated.known.stored, BundleStored::Linear);
    EXPECT_EQ(stated.known.first_row, FirstRow::Top);
}

TEST(LightFile, FaultsNameFileAndPlace) {
    const auto fault = [](const std::string& text) {
        return test::error_text([&] { parse_light_file(text, "LIGHT.json", "map.pfm"); });
    };
    EXPECT_TRUE(test::mentions(fault("{"), {"LIGHT.json: ", "repair the JSON"}));
    EXPECT_TRUE(test::mentions(fault("[]"), {"LIGHT.json: ", "no object"}));
    EXPECT_TRUE(test::mentions(fault("{}"), {"LIGHT.json", "the matrix is missing"}));
    EXPECT_TRUE(test::mentions(fault("{\"maps\": []}"), {"the light has no map"}));
    EXPECT_TRUE(test::mentions(fault("{\"lights\": []}"), {"open it as a bundle"}));
    EXPECT_TRUE(test::mentions(fault("{\"clip_from_world\": [1, 2]}"), {"LIGHT.json", "clip_from_world"}));
    EXPECT_TRUE(test::mentions(fault("{\"clip_from_world\": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1], \"dept\": 1}"),
                               {"LIGHT.json", "dept"}));
    EXPECT_TRUE(test::mentions(fault("{\"maps\": [3], \"depth\": 4}"), {"LIGHT.json"}));
    EXPECT_TRUE(test::mentions(fault("{\"depth\": 4, \"image\": \"x\"}"), {"LIGHT.json"}));
    EXPECT_TRUE(test::mentions(fault(std::string(200, '[')), {"LIGHT.json: ", "nests too deep"}));
}

}  // namespace
}  // namespace si
