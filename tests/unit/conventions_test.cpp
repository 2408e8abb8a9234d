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

TestLight make_light(bool perspective, const DepthConvention& depth) {
    TestLight out;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.35, -1, 0.2));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.2, 1, 0.1), -forward));
    const glm::dmat3 axes(right, glm::cross(-forward, right), -forward);
    DepthCurve curve;
    curve.perspective = perspective;
    curve.near = perspective ? 9 : 6;
    curve.far = 40;
    curve.convention = depth;
    const glm::dvec3 eye = kCentre - 18.0 * forward;
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
