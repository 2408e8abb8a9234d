// Compares the GPU's causes of wrong pixels with C++ decisions from the same trials, and scenes with one or two faults
// with their repaired twins.
#include <cstring>
#include <map>

#include "renderer/measure/measured_error.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

std::string_view name(Artefact a) {
    for (const ArtefactStyle& style : artefact_styles())
        if (style.artefact == a) return style.key;
    return "none";
}

class CausesTest : public FrameTest {
protected:
    ReferenceCache cache;
    FrameRequest request{.width = 320, .height = 240};

    MeasuredError measure(const Scene& scene, const Settings& s, const ReferenceOptions& options = {}) {
        return measure_error(renderer, scene, s, request, 0, options, cache);
    }
    static std::size_t count(const MeasuredError& m, Artefact a) { return m.metrics.artefacts[std::size_t(a)]; }
    static std::string counts(const MeasuredError& m) {
        std::string text;
        for (const ArtefactStyle& style : artefact_styles())
            if (const std::size_t n = count(m, style.artefact))
                text += std::string(style.key) + " " + std::to_string(n) + "  ";
        return text;
    }

    std::vector<CauseEvidence> read_evidence(const FrameResult& frame, int step) {
        std::vector<CauseEvidence> out;
        for (int i = 0; i < kEvidenceImages; ++i) {
            const FloatImage image = subsample(renderer.read_float(frame.evidence[std::size_t(i)], 4), step);
            out.resize(image.data.size() / 4);
            for (std::size_t p = 0; p < out.size(); ++p)
                std::memcpy(reinterpret_cast<char*>(&out[p]) + i * 16, &image.data[4 * p], 16);
        }
        return out;
    }

    /// Decides in C++ from the GPU's trials and expects the GPU's own decisions. @returns the GPU's decisions
    MeasuredError agree(const Scene& scene, const Settings& s, const char* what, const ReferenceOptions& options = {}) {
        SCOPED_TRACE(what);
        const MeasuredError gpu = measure(scene, s, options);
        FrameRequest all = request;
        all.outputs = {.colour = false, .evidence = true};
        const FrameResult frame = render_with_reference(renderer, scene, s, all, cache, {}, options);
        EXPECT_TRUE(frame.reference.met);
        std::vector<CauseEvidence> evidence = read_evidence(frame, options.step);
        const CauseContext known = cause_context(s, frame.lights[std::size_t(s.view.light)], s.view.light,
                                                 MapSize(frame.map_resolution), frame.mask_levels);
        const Reference& reference = *gpu.traced.reference;
        std::size_t differ = 0;
        for (std::size_t i = 0; i < reference.state.size(); ++i) {
            if (reference.state[i] != PixelState::Counted) continue;
            const ClassifiedPixel& p = gpu.classified[i];
            if (known.has_contact) evidence[i].visibility = p.visibility;  // trials are of the map alone
            const Cause cause = cause_of(evidence[i], reference_pixel(reference, i), known);
            const bool acne = cause.faint || (cause.artefact == Artefact::Acne && reference.visibility.data[i] == 1);
            const bool same =
                cause.artefact == p.artefact && cause.also == p.also() && cause.seam == p.has(ClassifiedPixel::kSeam) &&
                acne == p.has(ClassifiedPixel::kAnyAcne) &&
                (p.bits & ~(ClassifiedPixel::kAnyAcne | ClassifiedPixel::kSeam)) % (1 << ClassifiedPixel::kAlsoShift) ==
                    compared_bits(p.visibility, reference_pixel(reference, i),
                                  evidence[i].place == CauseEvidence::kOutside);
            if (!same && ++differ <= 3)
                ADD_FAILURE() << "pixel " << i << ": " << name(p.artefact) << " on the GPU, here "
                              << name(cause.artefact) << ", also " << p.also() << " and " << cause.also << ", bits "
                              << p.bits;
        }
        EXPECT_EQ(differ, 0u);
        return gpu;
    }

    double named_share(const Scene& scene, const Settings& wrong, const Settings& twin,
                       const std::vector<Artefact>& causes, std::size_t least = 100) {
        return named_share(measure(scene, wrong), measure(scene, twin), causes, least);
    }
    /// Returns the share of pixels with one of the causes, among pixels that are wrong here and right in the twin.
    double named_share(const MeasuredError& a, const MeasuredError& b, const std::vector<Artefact>& causes,
                       std::size_t least = 100) {
        std::size_t cured = 0, named = 0;
        std::map<std::string_view, int> others;
        for (std::size_t i = 0; i < a.classified.size(); ++i) {
            if (a.classified[i].artefact == Artefact::None || b.classified[i].artefact != Artefact::None) continue;
            ++cured;
            bool hit = false;
            for (const Artefact c : causes)
                hit |= a.classified[i].artefact == c || (a.classified[i].also() >> int(c) & 1) != 0;
            named += hit;
            if (!hit) ++others[name(a.classified[i].artefact)];
        }
        EXPECT_GE(cured, least) << "the twin shows what was wrong";
        std::string text;
        for (const auto& [key, n] : others) text += std::string(key) + " " + std::to_string(n) + "  ";
        last_ = std::to_string(cured) + " fixed, not named: " + text;
        return cured ? double(named) / double(cured) : 0;
    }
    std::string last_;
};

SI_TEST_IS(Slow, CausesTest, LightBleedingIsTheCauseUnderKernelsByMoments);
TEST_F(CausesTest, LightBleedingIsTheCauseUnderKernelsByMoments) {
    std::size_t bleeding = 0;
    const Scene box = test::floor_and_box(10, {1.5, 1, 2}, 0.1);
    for (const char* kernel : {"vsm", "savsm", "esm", "evsm2", "evsm4", "msm_hamburger"}) {
        Settings s = test::texel_settings(kernel, 256, 0);
        set_all(s, {"filter.exponent=3", "filter.negative_exponent=3", "filter.blur=6", "filter.window=12",
                    "filter.bleed=0"});
        const MeasuredError m = agree(box, s, kernel);
        bleeding += count(m, Artefact::LightBleeding);
        EXPECT_EQ(count(m, Artefact::Leak), 0u) << kernel << ": " << counts(m);
        s.map.blur_texels = 2;
        agree(box, s, "with depth blur");
    }
    EXPECT_GT(bleeding, 100u);
}

// Rays that take each surface for 20 m thick darken pixels beside the box.
TEST_F(CausesTest, CpuAndGpuAgreeUnderContactShadows) {
    const Scene box = test::floor_and_box(10, {1.5, 1, 2});
    std::size_t contacts = 0;
    for (const char* azimuth : {"-110", "-20", "70", "160"}) {
        Settings s = test::texel_settings("pcf3", 512, 40);
        set_all(s, {{"camera.azimuth", azimuth}, "light.contact=3", "contact.steps=64", "contact.thickness=20"});
        contacts += count(agree(box, s, azimuth), Artefact::Contact);
    }
    EXPECT_GT(contacts, 10u);
}

SI_TEST_IS(Repeated, CausesTest, CpuAndGpuAgree);
SI_TEST_IS(Product, CausesTest, CpuAndGpuAgree);
SI_TEST_IS(Slow, CausesTest, CpuAndGpuAgree);
TEST_F(CausesTest, CpuAndGpuAgree) {
    const Scene box = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* kernel : test::portion<const char*>({"hard", "hw2x2", "pcf3", "pcf5_nearest", "pcf9"}, 3)) {
        Settings s = test::texel_settings(kernel, 256, 0.4);
        EXPECT_GT(count(agree(box, s, kernel), Artefact::Acne), 100u);
        set_all(s, {"bias.constant=30", "bias.normal=4"});
        EXPECT_GT(count(agree(box, s, "much bias"), Artefact::PeterPanning), 10u);
        set_all(s, {"bias.constant=1", "bias.normal=20"});
        EXPECT_GT(count(agree(box, s, "much offset"), Artefact::PeterPanningOffset), 100u);
        set_all(s, {"bias.raster_units=4000", "bias.raster_slope=3", "bias.normal=0"});
        agree(box, s, "polygon offset");
        s.map.blur_texels = 2;
        agree(box, s, "polygon offset and depth blur");
        for (const char* units : {"40000", "60000"}) {
            s = test::texel_settings(kernel, 256, 0);
            set_all(s, {"map.format=d32f", {"bias.raster_units", units}, "bias.normal=2"});
            agree(box, s, "polygon offset in a float format");
        }
        s = test::texel_settings(kernel, 256, 30);
        for (const char* plane : {"receiver-plane", "receiver-plane-derivatives", "receiver-plane-remainder"}) {
            s.bias.constant = 30;
            set_setting(s, "bias.kind", plane);
            EXPECT_GT(count(agree(box, s, "much beyond the plane"), Artefact::PeterPanning), 10u);
            s.bias.constant = 0;
            EXPECT_EQ(count(agree(box, s, "the plane alone"), Artefact::Acne), 0u);
        }
        set_setting(s, "bias.kind", "adaptive");
        EXPECT_EQ(count(agree(box, s, "what the plane needs"), Artefact::Acne), 0u);
    }
    Settings s = settings_with(test::texel_settings("pcf3", 256, 3), {"light.fit=manual", "light.extent=1.2"});
    EXPECT_GT(count(agree(box, s, "outside of the map"), Artefact::OutsideMap), 10u);
    for (const LightType type : {LightType::Spot, LightType::Point})
        for (const bool reversed : {false, true}) {
            s = test::texel_settings("pcf3", 256, 0.5);
            s.lights[0].type = type;
            s.map.reversed_z = reversed;
            s.bias.normal = 1;
            agree(box, s, type == LightType::Spot ? "spot" : "point");
        }
    for (const bool reversed : {false, true}) {
        s = test::texel_settings("pcf3", 128, 0.4);
        s.lights[0].fit = LightFit::Lispsm;
        s.map.reversed_z = reversed;
        EXPECT_GT(count(agree(box, s, "warped"), Artefact::Acne), 100u);
        set_all(s, {"bias.constant=1", "bias.normal=20"});
        EXPECT_GT(count(agree(box, s, "much offset in a warped map"), Artefact::PeterPanningOffset), 10u);
        s.bias.constant = s.bias.normal = 0;
        for (const char* plane :
             {"receiver-plane", "receiver-plane-derivatives", "receiver-plane-remainder", "adaptive"}) {
            set_setting(s, "bias.kind", plane);
            EXPECT_EQ(count(agree(box, s, "the plane alone in a warped map"), Artefact::Acne), 0u);
        }
    }
    for (const CascadeChoice choice : {CascadeChoice::Interval, CascadeChoice::Map}) {
        s = test::texel_settings("pcf3", 64, 0.4);
        set_all(s, {"light.cascades=3", "light.cascade_blend=0.3"});
        s.lights[0].cascade_choice = choice;
        EXPECT_GT(count(agree(box, s, "cascades"), Artefact::Acne), 100u);
        set_all(s, {"bias.constant=1", "bias.normal=20"});
        EXPECT_GT(count(agree(box, s, "much offset in cascades"), Artefact::PeterPanningOffset), 10u);
    }
    s = test::texel_settings("pcf5", 256, 2);
    s.lights[0].size = 6;
    EXPECT_GT(count(agree(box, s, "a light of size", {.area = true, .samples = 256}), Artefact::Penumbra), 10u);
    agree(box, s, "a light of size, one look at it", {.area = true, .samples = 1});
    s.caster.cull = Cull::Front;
    agree(box, s, "front culling", {.step = 2});
    const Scene teapot = load_scene("teapot");
    for (const char* slope : test::portion<const char*>({"1", "3", "10"}, 3))
        EXPECT_GT(count(agree(teapot,
                              settings_for(teapot, {"light.fit=scene",
                                                    "bias.normal_source=shading",
                                                    "bias.constant=0",
                                                    {"bias.slope", slope},
                                                    "bias.normal=1",
                                                    "map.resolution=512"}),
                              "vertices' normals"),
                        Artefact::EdgeAliasing),
                  20u);
    const Scene stage = load_scene("stage");
    for (const char* extra : test::portion<const char*>(
             {"bias.constant=40", "caster.cull=front", "map.resolution=256", "bias.normal=30"}, 2))
        agree(stage, settings_for(stage, {extra}), extra);
}

TEST_F(CausesTest, TrialsOfOneTexelObeyTheGuards) {
    const Scene box = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = settings_with(test::texel_settings("hard", 256, 1),
                               {"light.fit=manual", "light.extent=1.2", "bias.normal=40", "map.wrap=range"});
    for (const Outside outside : {Outside::Lit, Outside::Unlit}) {
        s.map.outside = outside;
        FrameRequest all = request;
        all.outputs = {.colour = false, .evidence = true};
        const FrameResult frame = render_with_reference(renderer, box, s, all, cache);
        int led = 0;
        for (const CauseEvidence& e : read_evidence(frame, 1))
            if (e.place == CauseEvidence::kLedOutside) {
                ++led;
                EXPECT_EQ(e.nearest_kept, outside == Outside::Lit ? 1.f : 0.f);
            }
        EXPECT_GT(led, 100);
    }
}

TEST_F(CausesTest, FalseLightOfAWallUnderLowSunIsPeterPanning) {
    const Scene scene = test::wall_on_plane();
    const Settings s = test::low_sun_settings("pcf3", 512, 11);
    Settings least = s;
    least.bias.constant = 7.6;
    const MeasuredError m = measure(scene, s);
    const double by_bias = m.metrics.bias_false_light / m.metrics.false_light;
    EXPECT_GT(m.metrics.false_light, 0.002);
    EXPECT_GT(by_bias, 0.6) << "not an edge's: " << counts(m);
    EXPECT_GE(named_share(scene, s, least, {Artefact::PeterPanning}), 0.95) << last_;
}

TEST_F(CausesTest, TheStripOfALargeNormalOffsetIsAttributedToTheOffset) {
    const Scene scene = test::wall_on_plane();
    Settings s = settings_with(test::low_sun_settings("pcf3", 4096, 2), {"light.elevation=40", "bias.normal=100"});
    Settings without = settings_with(s, {"bias.normal=0", "bias.constant=6"});
    const MeasuredError m = measure(scene, s);
    EXPECT_GT(count(m, Artefact::PeterPanningOffset), 300u);
    EXPECT_LT(count(m, Artefact::EdgeAliasing) + count(m, Artefact::PeterPanning), 20u);
    EXPECT_GE(named_share(scene, s, without, {Artefact::PeterPanningOffset, Artefact::OffsetShadow}), 0.95) << last_;
}

TEST_F(CausesTest, AFenceFinerThanATexelIsUndersampled) {
    const Scene scene = test::fence(24, 0.03, 0.25);
    request = {.width = 800, .height = 600};
    Settings s = test::texel_settings("hard", 128, 3);
    s.camera.distance = 7;
    const MeasuredError m = measure(scene, s);
    const std::size_t undersampled = count(m, Artefact::Undersampled);
    EXPECT_GT(undersampled, 500u);
    EXPECT_GT(double(undersampled), 0.9 * (m.metrics.false_light + m.metrics.false_shadow) * double(m.metrics.counted))
        << counts(m) << "bars of 3 cm under texels of " << m.lights[0].views[0].texel_size(1, 128) << " m";
    s.map.resolution = 4096;
    EXPECT_LT(count(measure(scene, s), Artefact::Undersampled), undersampled / 20);
}

SI_TEST_IS(Repeated, CausesTest, EdgesOfABoxOnAPlaneAreClassifiedAsEdges);
TEST_F(CausesTest, EdgesOfABoxOnAPlaneAreClassifiedAsEdges) {
    for (const char* kernel : {"hard", "pcf3"}) {
        const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0);
        Settings s = test::texel_settings(kernel, 4096, kernel[0] == 'h' ? 2.2 : 5.2);
        request = {.width = 640, .height = 480};
        s.camera.distance = 5;
        const MeasuredError m = measure(scene, s);
        const double n = double(m.metrics.counted);
        EXPECT_EQ(count(m, Artefact::Acne), 0u) << kernel;
        EXPECT_GT(count(m, Artefact::EdgeAliasing), 8u) << counts(m);
        EXPECT_LE(double(count(m, Artefact::LostCaster) + count(m, Artefact::PeterPanningOffset) +
                         count(m, Artefact::OffsetShadow)),
                  0)
            << kernel;
        EXPECT_GE(double(count(m, Artefact::EdgeAliasing) + count(m, Artefact::Filter) + count(m, Artefact::Leak)),
                  0.9 * n * (m.metrics.false_light + m.metrics.false_shadow))
            << counts(m);
    }
}

/// Fault of a scene: settings that cause the fault, settings that repair it, and its cause.
struct Fault {
    const char* what;
    Assignment wrong;
    std::vector<Artefact> causes;
};

const std::vector<Fault>& faults() {
    static const std::vector<Fault> all = {
        {"little bias", "bias.constant=0.3", {Artefact::Acne}},
        {"much bias", "bias.constant=60", {Artefact::PeterPanning}},
        {"much offset", "bias.normal=30", {Artefact::PeterPanningOffset, Artefact::OffsetShadow}},
        {"polygon offset", "bias.raster_slope=60", {Artefact::PeterPanningRaster}},
        {"front culling", "caster.cull=front", {Artefact::LostCaster, Artefact::PeterPanning}},
        // At the bias of a narrow kernel the scene shadows itself, which more bias fixes as well.
        {"wide kernel", "filter.kernel=pcf9", {Artefact::Filter, Artefact::Leak, Artefact::Acne}},
    };
    return all;
}

SI_TEST_IS(Repeated, CausesTest, FaultsAndPairsOfFaultsAreClassifiedAsTheirRepairedTwinShows);
SI_TEST_IS(Later, CausesTest, FaultsAndPairsOfFaultsAreClassifiedAsTheirRepairedTwinShows);
TEST_F(CausesTest, FaultsAndPairsOfFaultsAreClassifiedAsTheirRepairedTwinShows) {
    Scene scene = test::floor_and_box(10, {1.5, 0.6, 2}, 0.3);
    const int grey = add_material(scene, "more grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "sheet", -1, add_mesh(scene, "sheet", make_plane(1.5, 1.5), grey), moved(2.5, 1.1, 1));
    finalise(scene);
    std::string table;
    for (std::size_t a = 0; a < faults().size(); ++a)
        for (std::size_t b = 0; b < faults().size(); ++b) {
            Settings both = test::texel_settings("hw2x2", 512, 3.2), twin = both;
            if (a != b) {
                set_all(both, {faults()[b].wrong});
                set_all(twin, {faults()[b].wrong});
            }
            set_all(both, {faults()[a].wrong});
            if (both == twin) continue;
            // Thirty texels of normal offset exceed the plane's need: its constant bias is not too little then.
            if (faults()[a].what == std::string("little bias") && faults()[b].what == std::string("much offset"))
                continue;
            const double share = named_share(scene, both, twin, faults()[a].causes, 0);
            const std::string line = std::string(faults()[a].what) +
                                     (a == b ? "" : std::string(" with ") + faults()[b].what) + ": " +
                                     std::to_string(share) + " of " + last_;
            table += line + "\n";
            if (std::stoul(last_) < 30) continue;  // the other fault hides this one
            EXPECT_GE(share, 0.95) << line;
        }
    RecordProperty("table", table);
    if (HasFailure()) std::puts(table.c_str());
}

/// Makes a room as one mesh of joined walls and floor, with a box that touches the floor.
Scene room() {
    const auto wall = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
        return std::vector<glm::dvec3>{a, b, c, d};
    };
    Mesh all = make_polygons("room", {wall({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}),
                                      wall({-3, 0, -3}, {3, 0, -3}, {3, 2, -3}, {-3, 2, -3}),
                                      wall({-3, 0, 3}, {-3, 0, -3}, {-3, 2, -3}, {-3, 2, 3})});
    append(all, transformed(make_box({1.2, 0.8, 1}), moved(-0.4, 0.4, 0.2)));
    return test::grey_scene({{"room", std::move(all)}});
}

/// Makes four tiles of hills that meet in the middle, with a box over the seams.
Scene tiles() {
    std::vector<test::GreyPart> parts;
    for (const double x : {-2.5, 2.5})
        for (const double z : {-2.5, 2.5}) {
            Mesh tile = make_plane(5, 5, 12, 12);
            for (glm::vec3& p : tile.positions.edit())
                p.y = float(0.2 * std::sin(1.3 * (p.x + x)) * std::cos(1.1 * (p.z + z)));
            parts.push_back({"tile " + std::to_string(parts.size()), std::move(tile), moved(x, 0, z)});
        }
    parts.push_back({"box", make_box({1.5, 0.6, 2}), moved(0, 0.8, 0)});
    return test::grey_scene(std::move(parts));
}

/// Makes a sheet with fine holes over a floor; the holes are as fine as a coarse map can draw. @param levels gives the
/// mask coarser mip levels
Scene masked_sheet(bool levels) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    Texture mask{.name = "mask", .width = 64, .height = 64, .mipmaps = levels};
    for (int i = 0; i < 64 * 64; ++i) {
        const bool hole = i % 64 % 8 < 6 && i / 64 % 8 < 6;
        mask.rgba.append({255, 255, 255, std::uint8_t(hole ? 0 : 255)});
    }
    scene.textures.push_back(std::move(mask));
    scene.materials.push_back({.name = "lattice", .base_colour_texture = 0, .alpha = AlphaMode::Mask});
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(10, 10), grey));
    add_object(scene, "sheet", -1, add_mesh(scene, "sheet", make_plane(3, 3), int(scene.materials.size()) - 1),
               moved(0, 1, 0));
    finalise(scene);
    return scene;
}

TEST_F(CausesTest, MasksThinnedByCoarserMipLevelsAreLostCasters) {
    Settings s = test::texel_settings("hard", 128, 2);
    s.camera.distance = 7;
    const MeasuredError coarse = measure(masked_sheet(true), s), fine = measure(masked_sheet(false), s);
    EXPECT_GT(count(coarse, Artefact::LostCaster), 300u) << counts(coarse);
    EXPECT_EQ(count(fine, Artefact::LostCaster), 0u) << "there are no other levels: " << counts(fine);
    const double share = named_share(coarse, fine, {Artefact::LostCaster, Artefact::Filter});
    EXPECT_GE(share, 0.95) << last_;
}

TEST_F(CausesTest, TapsOutsideTheMapAreClassifiedAsItsSeam) {
    const Scene scene = test::floor_and_box(10, {0.5, 0.5, 0.5}, 0);
    Settings s = settings_with(test::texel_settings("pcf9", 64, 12),
                               {"light.fit=manual", "light.extent=2", "map.outside=unlit"});
    Settings twin = s;
    twin.map.outside = Outside::Lit;
    const MeasuredError dark = measure(scene, s), lit = measure(scene, twin);
    EXPECT_GE(named_share(dark, lit, {Artefact::OutsideMap}), 0.95) << last_;
    std::size_t seams = 0;
    for (std::size_t i = 0; i < dark.classified.size(); ++i)
        if (!dark.classified[i].has(ClassifiedPixel::kOutside)) seams += dark.classified[i].has(ClassifiedPixel::kSeam);
    EXPECT_GT(seams, 50u);
}

TEST_F(CausesTest, ACubeMapHasNoSeams) {
    const Scene scene = test::floor_and_box(10, {0.5, 0.5, 0.5}, 0);
    Settings s = settings_with(test::texel_settings("pcf9", 64, 8), {"light.type=point", "light.distance=3"});
    for (const Outside outside : {Outside::Lit, Outside::Unlit}) {
        s.map.outside = outside;
        const MeasuredError m = measure(scene, s);
        EXPECT_EQ(count(m, Artefact::OutsideMap), 0u) << "its faces overlap by more than the widest kernel";
        EXPECT_GT(count(m, Artefact::PeterPanning), 50u);
    }
}

SI_TEST_IS(Repeated, CausesTest, EachFaultIsClassifiedInCornersOnTerrainAndUnderEveryLight);
SI_TEST_IS(Later, CausesTest, EachFaultIsClassifiedInCornersOnTerrainAndUnderEveryLight);
TEST_F(CausesTest, EachFaultIsClassifiedInCornersOnTerrainAndUnderEveryLight) {
    struct Place {
        const char* what;
        Scene scene;
        Sets sets;
    };
    const Scene box = test::floor_and_box(10, {1.5, 0.6, 2}, 0.3);
    const Place places[] = {{"room", room(), {"light.azimuth=40", "light.elevation=50"}},
                            {"terrain in tiles", tiles(), {"light.elevation=55"}},
                            {"straight above", box, {"light.azimuth=90", "light.elevation=80"}},
                            {"spot", box, {"light.type=spot", "light.distance=9"}},
                            {"point", box, {"light.type=point", "light.distance=6"}},
                            {"far away",
                             test::grey_scene({{"floor", make_plane(10, 10), moved(1150, 30, -820)},
                                               {"box", make_box({1.5, 0.6, 2}), moved(1150, 30.6, -820)}}),
                             {"camera.target_x=1150", "camera.target_y=30.2", "camera.target_z=-820"}}};
    for (const Place& place : places)
        for (std::size_t a = 0; a < faults().size(); ++a) {
            if (faults()[a].what == std::string("front culling") || faults()[a].what == std::string("wide kernel"))
                continue;
            const Settings twin = settings_with(test::texel_settings("hw2x2", 512, 4), place.sets);
            const Settings wrong = settings_with(twin, {faults()[a].wrong});
            const double share = named_share(place.scene, wrong, twin, faults()[a].causes, 0);
            if (std::stoul(last_) < 30) continue;
            EXPECT_GE(share, 0.95) << place.what << ", " << faults()[a].what << ": " << share << " of " << last_;
        }
}

}  // namespace
}  // namespace si
