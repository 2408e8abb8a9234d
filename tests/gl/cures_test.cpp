// The cure table: what it offers is what one gets, and its first row cures what the scene suffers from.
#include "renderer/measure/cures.h"

#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

class CuresTest : public FrameTest {
protected:
    TruthCache cache;
    int width = 480, height = 360;

    MeasuredError measure(const Scene& scene, const Settings& s) {
        return measure_error(renderer, scene, s, {.width = width, .height = height}, 0, {}, cache);
    }
    static Settings with(Settings s, const Cure& cure) {
        for (const auto& [key, value] : cure.settings) set_setting(s, key, value);
        return s;
    }

    /// Finds cures, demands of every row that it keeps what it says, and of the first that it cures nine of ten pixels
    /// with one of the causes.
    CureTable cured(const Scene& scene, const Settings& s, std::vector<Artefact> causes, std::size_t least) {
        const CureTable table = find_cures(renderer, scene, s, width, height, {}, cache);
        const MeasuredError before = measure(scene, s);
        for (const Cure& row : table.rows) {
            if (!row.untried.empty()) continue;
            SCOPED_TRACE(row.name);
            EXPECT_FALSE(row.settings.empty());
            const MeasuredError after = measure(scene, with(s, row));
            std::size_t cured = 0, broken = 0, of = 0;
            for (std::size_t i = 0; i < before.judged.size(); ++i) {
                const bool was = before.judged[i].artefact != Artefact::None,
                           is = after.judged[i].artefact != Artefact::None;
                cured += was && !is, broken += !was && is;
            }
            for (const std::size_t n : row.cured_of) of += n;
            EXPECT_EQ(row.cured, cured) << "exactly as predicted";
            EXPECT_EQ(row.broken, broken);
            EXPECT_EQ(row.cured, of);
        }
        for (std::size_t i = 1; i < table.rows.size(); ++i)
            if (table.rows[i].untried.empty()) EXPECT_GE(table.rows[i - 1].gain(), table.rows[i].gain());
        std::size_t wrong = 0, right = 0;
        for (const Artefact a : causes)
            wrong += table.wrong_of[std::size_t(a)], right += table.rows.at(0).cured_of[std::size_t(a)];
        EXPECT_GE(wrong, least);
        EXPECT_GE(double(right), 0.9 * double(wrong)) << table.rows[0].name;
        return table;
    }
    static const Cure* row(const CureTable& table, std::string_view name) {
        for (const Cure& r : table.rows)
            if (r.name == name) return &r;
        return nullptr;
    }
};

TEST_F(CuresTest, PeterPanningIsCuredByTheLeastBias) {
    const Scene scene = test::wall_on_plane();
    const Settings s = test::low_sun_settings("pcf3", 512, 11);
    const CureTable table = cured(scene, s, {Artefact::PeterPanning}, 100);
    const Cure* least = row(table, "least bias, constant alone");
    ASSERT_TRUE(least);
    EXPECT_GT(least->cured_of[std::size_t(Artefact::PeterPanning)],
              0.9 * double(table.wrong_of[std::size_t(Artefact::PeterPanning)]));
}

TEST_F(CuresTest, AnOffsetsStripIsCured) {
    Settings s = test::texel_settings("pcf3", 2048, 2);
    s.bias.normal = 60;
    cured(test::floor_and_box(10, {1.5, 1, 2}, 0.2), s, {Artefact::PeterPanningOffset, Artefact::OffsetShadow}, 300);
}

TEST_F(CuresTest, TheStageIsCuredOfTooMuchBiasAndOfFrontCulling) {
    const Scene stage = load_scene("stage");
    width = 640, height = 360;
    cured(stage, settings_for(stage, {{"light.fit", "scene"}, {"bias.constant", "40"}, {"bias.normal", "0"}}),
          {Artefact::PeterPanning}, 500);
    cured(stage, settings_for(stage, {{"light.fit", "scene"}, {"caster.cull", "front"}}), {Artefact::LostCaster}, 500);
}

TEST_F(CuresTest, AFenceIsCuredByTheResolutionThatItNeeds) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(12, 12), grey));
    const int bar = add_mesh(scene, "bar", make_box({0.05, 1.6, 0.05}), grey);
    for (int i = 0; i < 16; ++i)
        add_object(scene, "bar " + std::to_string(i), -1, bar, moved(-3 + 0.4 * i + 0.013 * (i % 5), 0.9, 0));
    finalise(scene);
    Settings s = test::texel_settings("hard", 128, 3);
    s.camera.distance = 7;
    cured(scene, s, {Artefact::Undersampled}, 300);
}

TEST_F(CuresTest, SaysOfAPixelWhatPutsItRightAndWhatWasNotTried) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 512, 0);
    const MeasuredError m = measure(scene, s);
    glm::ivec2 pixel(-1);
    for (int i = 0; i < width * height && pixel.x < 0; ++i)
        if (m.judged[std::size_t(i + width * height / 2)].artefact == Artefact::Acne)
            pixel = {(i + width * height / 2) % width, (i + width * height / 2) / width};
    ASSERT_GE(pixel.x, 0);
    s.lights[0].type = int(LightType::Directional);
    const CureTable table =
        find_cures(renderer, scene, s, width, height, {.pixel = pixel, .time = true, .frames = 3}, cache);
    ASSERT_FALSE(table.rows.empty());
    EXPECT_TRUE(table.rows[0].pixel_right.value());
    EXPECT_TRUE(table.rows[0].ms);
    bool stays = false;
    for (const Cure& r : table.rows)
        if (r.untried.empty()) {
            const MeasuredError after = measure(scene, with(s, r));
            const std::size_t at = std::size_t(pixel.y * width + pixel.x);
            EXPECT_EQ(*r.pixel_right, after.judged[at].artefact == Artefact::None) << r.name;
            stays |= !*r.pixel_right;
        }
    EXPECT_TRUE(stays) << "not everything helps";
    s.lights[0].type = int(LightType::Spot);
    const CureTable spot = find_cures(renderer, scene, s, width, height, {}, cache);
    const Cure* fit = row(spot, "tighter fit");
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->untried.empty());
    EXPECT_EQ(&spot.rows.back(), fit) << "what was not tried stands last";
}

TEST_F(CuresTest, ATighterFitKeepsWhatIsSeenAndSaysItsTexels) {
    const Scene scene = test::floor_and_box(40, {1.5, 1, 2}, 0);
    Settings s = test::texel_settings("hard", 256, 3);
    s.camera.distance = 4;
    const CureTable table = find_cures(renderer, scene, s, width, height, {}, cache);
    const Cure* fit = row(table, "tighter fit, to the surfaces seen");
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->gain(), 0);
    EXPECT_EQ(fit->map_bytes, 0);
    const MeasuredError after = measure(scene, with(s, *fit));
    EXPECT_EQ(after.metrics.outside_map, 0);
    EXPECT_LT(after.lights[0].views[0].half_width, 0.5 * measure(scene, s).lights[0].views[0].half_width);
}

}  // namespace
}  // namespace si
