// Tests of the map viewer with the real renderer: read texels of pixels, plots, saving.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/base/output.h"
#include "app/session/session.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/grey_range.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"
#include "tests/ui/drawn_text.h"
#include "tests/ui/test_editor.h"
#include "ui/map_view/depth_plots.h"
#include "ui/map_view/map_marks.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Editor with every panel open.
struct WideEditor : test::TestEditor {
    explicit WideEditor(std::vector<std::string> sets = {}, const std::string& scene = "boxes")
        : TestEditor(test::editor_options(scene, std::move(sets))) {
        settle_wide();
    }
    /// Settles in the wide layout, whatever the first frames, or a tab, made of the layout.
    void settle_wide() {
        state().layout = test::kWideLayout;
        settle();
    }
};

/// Returns the first position of a coarse grid over a picture for which `found` holds after the editor has settled.
std::optional<glm::vec2> hover(HeadlessEditor& editor, glm::vec2 from, glm::vec2 to, const auto& found) {
    for (float y = from.y; y < to.y; y += 23) {
        for (float x = from.x; x < to.x; x += 23) {
            editor.mouse.at = glm::vec2(x, y);
            for (int i = 0; i < 3; ++i) editor.frame();
            if (found()) return editor.mouse.at;
        }
    }
    return {};
}

std::size_t differing_pixels(const ByteImage& a, const ByteImage& b, int x1) {
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < x1; ++x) {
            const std::size_t i = (std::size_t(y) * std::size_t(a.width) + std::size_t(x)) * 4;
            count += !std::equal(&a.data[i], &a.data[i] + 3, &b.data[i]);
        }
    return count;
}

SI_TEST_IS(Later, MapViewer, FootprintOfAHoveredPixelHoldsTheProbedTexel);
TEST(MapViewer, FootprintOfAHoveredPixelHoldsTheProbedTexel) {
    WideEditor editor;
    EXPECT_EQ(editor.facts().texel_usage, nullptr) << "links are read without a mouse";
    EXPECT_FALSE(editor.frame().want_links);
    EditorState& state = editor.state();
    const auto at = hover(editor, {120, 250}, {500, 380}, [&] {
        const EditorFrame f = editor.model().facts();
        return state.viewport.hovered_pixel && f.map_coordinates &&
               f.map_coordinates->at(state.viewport.hovered_pixel->x, state.viewport.hovered_pixel->y, 3) > 0;
    });
    ASSERT_TRUE(at) << "no pixel reads the map";
    const glm::ivec2 pixel = *state.viewport.hovered_pixel;
    state.probe_pixel = pixel;
    editor.frames(3);
    const EditorFrame f = editor.facts();
    ASSERT_TRUE(f.probe && f.probe->hit && f.texel_usage);
    const glm::ivec2 texel = f.probe->lights.at(0).texel;
    EXPECT_GT(f.texel_usage->pixels(texel), 0u);
    const auto readers = f.texel_usage->readers(texel);
    EXPECT_NE(std::find(readers.begin(), readers.end(), pixel), readers.end());
}

/// Returns the middle of all that a list of draw commands has in a colour, pixels; nothing: it lacks the colour.
std::optional<glm::vec2> middle_of_colour(const ImDrawList& list, ImU32 colour) {
    glm::vec2 lo(1e9f), hi(-1e9f);
    for (const ImDrawVert& v : list.VtxBuffer) {
        if (v.col != colour) continue;
        lo = glm::min(lo, glm::vec2(v.pos.x, v.pos.y));
        hi = glm::max(hi, glm::vec2(v.pos.x, v.pos.y));
    }
    return lo.x > hi.x ? std::nullopt : std::optional(0.5f * (lo + hi));
}

// A map of 128 by 512 texels: the texels of the hovered pixel are marked where the probe marks those that it compares.
SI_TEST_IS(Later, MapViewer, MarksTexelsInAMapThatIsNotSquare);
TEST(MapViewer, MarksTexelsInAMapThatIsNotSquare) {
    WideEditor editor({}, "hard/given-strip");
    ASSERT_NE(editor.facts().result->map_size.width, editor.facts().result->map_size.height);
    EditorState& state = editor.state();
    const auto at = hover(editor, {120, 150}, {500, 380}, [&] {
        const EditorFrame f = editor.model().facts();
        const auto& pixel = state.viewport.hovered_pixel;
        if (!pixel || !f.map_coordinates || f.map_coordinates->at(pixel->x, pixel->y, 3) <= 0) return false;
        const float v = f.map_coordinates->at(pixel->x, pixel->y, 1);
        return v > 0.3f && v < 0.9f;
    });
    ASSERT_TRUE(at) << "no pixel reads the map";
    state.probe_pixel = *state.viewport.hovered_pixel;
    editor.frames(3);
    const ImDrawData& drawn = *ImGui::GetDrawData();
    int marked = 0;
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const auto linked = middle_of_colour(*drawn.CmdLists[i], theme::kLinked);
        if (!linked) continue;
        ++marked;
        const auto probed = middle_of_colour(*drawn.CmdLists[i], theme::kProbed);
        ASSERT_TRUE(probed);
        EXPECT_LT(glm::distance(*linked, *probed), 6) << "pixels of the screen";
    }
    EXPECT_EQ(marked, 1) << "the map viewer";
}

SI_TEST_IS(Later, MapViewer, HoveredTexelMarksThePixelsThatReadIt);
TEST(MapViewer, HoveredTexelMarksThePixelsThatReadIt) {
    WideEditor editor({"map.resolution=64"});  // texels read by many pixels
    const ByteImage before = editor.picture();
    EditorState& state = editor.state();
    const auto at = hover(editor, {560, 120}, {860, 400}, [&] {
        const EditorFrame f = editor.model().facts();
        return state.map.hovered_texel && f.texel_usage && f.texel_usage->pixels(*state.map.hovered_texel) > 200;
    });
    ASSERT_TRUE(at) << "no texel is read";
    const std::size_t readers = editor.model().facts().texel_usage->pixels(*state.map.hovered_texel);
    EXPECT_GE(differing_pixels(before, editor.picture(), 480), readers / 2) << "the scene picture shows no readers";
}

// The exact set equals the squares around kernels for kernels that read their whole square, and is smaller otherwise.
SI_TEST_IS(Later, MapViewer, ReadTexelsAreMarkedExactlyOnRequest);
TEST(MapViewer, ReadTexelsAreMarkedExactlyOnRequest) {
    const auto shares = [](const std::string& kernel, const char* picture) {
        WideEditor editor(
            {"filter.kernel=" + kernel, "filter.radius=8", "filter.taps=4", "map.resolution=256", "light.fit=scene"});
        EXPECT_FALSE(editor.facts().exact_utilisation) << "nobody asked";
        EXPECT_EQ(editor.facts().result->texels_read.texture, 0u);
        const ByteImage before = editor.picture();
        editor.state().map.exact_texels ^= true;
        editor.settle_wide();
        const EditorFrame exact = editor.facts();
        EXPECT_TRUE(exact.exact_utilisation && exact.result->texels_read.texture != 0);
        const double share = exact.exact_utilisation.value_or(0);
        EXPECT_GT(differing_pixels(before, editor.picture(), before.width), 5000u) << "the map shows no marks";
        write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / picture, editor.picture());
        EXPECT_TRUE(hover(editor, {560, 120}, {860, 400}, [&] { return editor.facts().texel_usage; }));
        const double squares = editor.facts().texel_usage->utilisation();
        editor.state().map.exact_texels ^= true;
        editor.settle_wide();
        EXPECT_FALSE(editor.facts().exact_utilisation);
        return std::pair(share, squares);
    };
    const auto [hard, hard_squares] = shares("hard", "texels_read_hard.png");
    EXPECT_GT(hard, 0.01);
    EXPECT_NEAR(hard, hard_squares, 1e-3);
    const auto [poisson, poisson_squares] = shares("poisson", "texels_read_poisson.png");
    EXPECT_GT(poisson, hard);
    EXPECT_LT(poisson, 0.98 * poisson_squares);
}

SI_TEST_IS(Later, MapViewer, HistogramCountsEveryTexel);
TEST(MapViewer, HistogramCountsEveryTexel) {
    WideEditor editor;
    const EditorFrame facts = editor.facts();
    ASSERT_TRUE(facts.map_facts);
    const DepthStatistics& s = facts.map_facts->statistics;
    const auto n = std::uint64_t(facts.result->map_view_size.x) * std::uint64_t(facts.result->map_view_size.y);
    EXPECT_EQ(s.drawn + s.empty, n);
    EXPECT_GT(s.drawn, 0u);
    std::uint64_t counted = facts.map_facts->histogram.below + facts.map_facts->histogram.above;
    for (const std::uint64_t c : facts.map_facts->histogram.counts) counted += c;
    EXPECT_EQ(counted, s.drawn);
}

TEST(MapViewer, GreyScaleFitNarrowsTheHistogram) {
    WideEditor editor({"view.map_fit=true"});
    const EditorFrame facts = editor.facts();
    ASSERT_TRUE(facts.map_facts);
    const DepthStatistics& s = facts.map_facts->statistics;
    EXPECT_NEAR(facts.result->map_black, s.linear_min, 1e-5);
    EXPECT_NEAR(facts.result->map_white, s.linear_max, 1e-5);
    EXPECT_LT(facts.map_facts->histogram.lo, facts.result->map_black);
    EXPECT_GT(facts.map_facts->histogram.hi, facts.result->map_white);
    EXPECT_EQ(facts.map_facts->histogram.below + facts.map_facts->histogram.above, 0u);
}

SI_TEST_IS(Later, MapViewer, ContrastFitsItselfUntilItIsSwitchedOff);
TEST(MapViewer, ContrastFitsItselfUntilItIsSwitchedOff) {
    for (const char* view : {"linear", "raw"}) {
        WideEditor editor({std::string("view.map=") + view, "light.type=spot"});
        const EditorFrame facts = editor.facts();
        ASSERT_TRUE(facts.map_facts);
        const DepthStatistics s = facts.map_facts->statistics;
        const bool raw = facts.drawn->view.map == MapView::Raw;
        EXPECT_TRUE(facts.result->map_fitted);
        EXPECT_NEAR(facts.result->map_black, raw ? s.stored_min : s.linear_min, 1e-5);
        EXPECT_NEAR(facts.result->map_white, raw ? s.stored_max : s.linear_max, 1e-5);
        editor.state().settings.view.map_contrast = MapContrast::Whole;
        editor.settle();
        EXPECT_FALSE(editor.facts().result->map_fitted);
        EXPECT_EQ(editor.facts().result->map_black, 0);
        EXPECT_EQ(editor.facts().result->map_white, 1);
        editor.state().settings.view.map_contrast = MapContrast::Auto;
        editor.state().settings.view.map_white = 0.5;
        editor.settle();
        EXPECT_EQ(editor.facts().result->map_white, 0.5f) << "a range by hand counts";
    }
}

// The scale's ends are the contrast's ends in metres; for depths as stored both numbers are given.
SI_TEST_IS(Later, MapViewer, GreyRangeHasUnits);
TEST(MapViewer, GreyRangeHasUnits) {
    for (const char* view : {"linear", "raw"}) {
        WideEditor editor({"view.map_fit=true", std::string("view.map=") + view, "light.type=spot"});
        const EditorFrame facts = editor.facts();
        ASSERT_TRUE(facts.map_facts);
        const DepthStatistics& s = facts.map_facts->statistics;
        const ViewSettings& v = facts.drawn->view;
        const std::string low = grey_value_text(v, *facts.result, facts.result->map_black);
        const std::string high = grey_value_text(v, *facts.result, facts.result->map_white);
        const bool raw = v.map == MapView::Raw;
        EXPECT_EQ(low,
                  raw ? digits_text(s.stored_min) + " (" + metres_text(s.metres_min) + ")" : metres_text(s.metres_min));
        EXPECT_EQ(high,
                  raw ? digits_text(s.stored_max) + " (" + metres_text(s.metres_max) + ")" : metres_text(s.metres_max));
        EXPECT_EQ(grey_range_text(v, *facts.result),
                  "contrast from " + low + " (black) to " + high + " (white), fitted to the stored depths");
    }
}

SI_TEST_IS(Later, MapViewer, SavesTheStoredDepth);
TEST(MapViewer, SavesTheStoredDepth) {
    const std::filesystem::path file = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "saved_map.pfm";
    std::filesystem::remove(file);
    WideEditor editor;
    EditorRequests requests = editor.frame();
    requests.export_file = ExportRequest{ExportKind::Map, file.string()};
    editor.model().fulfil(requests);
    std::ifstream in(file, std::ios::binary);
    std::string magic;
    int width = 0, height = 0;
    in >> magic >> width >> height;
    EXPECT_EQ(magic, "Pf");
    EXPECT_EQ(width, editor.model().facts().result->map_view_size.x);
    EXPECT_EQ(height, width);
    editor.settle();  // saving drew other passes: wait for the editor's picture
    EXPECT_NE(editor.model().facts().result->colour.texture, 0u);

    const std::string saved = file_bytes(file);
    std::filesystem::resize_file(file, 3);
    editor.model().fulfil(requests);
    EXPECT_TRUE(editor.model().state.files.replace) << "a file that exists is asked for";
    EXPECT_EQ(file_bytes(file).size(), 3u);
    requests.replace = true;
    editor.model().fulfil(requests);
    EXPECT_EQ(file_bytes(file), saved);

    const std::filesystem::path picture = std::filesystem::path(SI_TEST_OUTPUT_DIR) / "saved_picture.png";
    std::filesystem::remove(picture);
    requests.export_file = ExportRequest{ExportKind::Picture, picture.string()};
    editor.model().fulfil(requests);
    EXPECT_EQ(file_bytes(picture).substr(1, 3), "PNG");

    requests.export_file = ExportRequest{ExportKind::Map, "/no/such/folder/map.pfm"};
    editor.model().fulfil(requests);
    EXPECT_EQ(editor.model().state.log.lines().back().kind, LogKind::Error);
    requests.export_file =
        ExportRequest{ExportKind::Map, (std::filesystem::path(SI_TEST_OUTPUT_DIR) / "map.txt").string()};
    editor.model().fulfil(requests);
    EXPECT_NE(editor.model().state.log.lines().back().text.find(".png"), std::string::npos);
}

TEST(MapViewer, CameraDepthIsShownInItsOwnAspectRatio) {
    WideEditor editor({"view.map_source=camera"}, "plane");
    const FrameResult& result = *editor.facts().result;
    EXPECT_EQ(result.map_view_size, glm::ivec2(result.colour.width, result.colour.height));
    EXPECT_TRUE(result.map_view_curve.convention.reversed);
    EXPECT_DOUBLE_EQ(result.map_view_curve.near, result.camera.curve.near);
    write_png(std::filesystem::path(SI_TEST_OUTPUT_DIR) / "camera_depth.png", editor.picture());
}

SI_TEST_IS(Later, MapViewer, LostCastersAreReported);
TEST(MapViewer, LostCastersAreReported) {
    WideEditor editor({"caster.cull=front"});
    EXPECT_TRUE(editor.facts().lost_casters.empty()) << "sought for a panel that is hidden";
    editor.state().window.open_page = Page::Objects;
    editor.settle_wide();
    ASSERT_FALSE(editor.facts().lost_casters.empty()) << "the floor has no back";
    const Scene& scene = *editor.facts().scene;
    for (const LostCaster& lost : editor.facts().lost_casters) {
        const int node = scene.objects[std::size_t(lost.object)].node;
        editor.state().settings.objects[scene.nodes[std::size_t(node)].path].cull = ObjectCull::None;
    }
    editor.settle_wide();
    EXPECT_TRUE(editor.facts().lost_casters.empty());
}

TEST(DepthPlots, ShowTheNinetyTenRule) {
    DepthCurve curve{.perspective = true, .near = 1, .far = 100, .convention = {}};
    // Depth 0.9 is reached where (1/n - 1/z) / (1/n - 1/f) = 0.9.
    const double expected = 1 / (1 - 0.9 * (1 - 0.01));
    EXPECT_NEAR(distance_at_share(curve, 0.9), expected, 1e-9);
    curve.convention.reversed = true;
    EXPECT_NEAR(distance_at_share(curve, 0.9), expected, 1e-9);
    curve.perspective = false;
    EXPECT_NEAR(distance_at_share(curve, 0.9), 1 + 0.9 * 99, 1e-9);
}

TEST(MapMarks, ScreenAndMapCoordinatesAreInverse) {
    const MapRect rect{{100, 50}, {400, 200}, {8, 4}};
    EXPECT_EQ(rect.uv({100, 250}), glm::dvec2(0, 0));
    EXPECT_EQ(rect.uv({500, 50}), glm::dvec2(1, 1));
    const auto [lo, hi] = rect.square({7, 3});  // the last texel: upper right
    EXPECT_FLOAT_EQ(lo.x, 450);
    EXPECT_FLOAT_EQ(lo.y, 50);
    EXPECT_FLOAT_EQ(hi.x, 500);
    EXPECT_FLOAT_EQ(hi.y, 100);
}

SI_TEST_IS(Later, MapViewer, EmptyLevelOfAVirtualMapNamesTheFullestOne);
TEST(MapViewer, EmptyLevelOfAVirtualMapNamesTheFullestOne) {
    WideEditor editor({"map.virtual=true", "map.resolution=1024"});
    const std::optional<PageFacts> pages = editor.facts().result->pages;
    ASSERT_TRUE(pages);
    const std::vector<int>& levels = pages->by_level;
    const auto empty = std::ranges::find(levels, 0);
    const auto fullest = std::ranges::max_element(levels);
    if (empty == levels.end()) GTEST_SKIP() << "this view requests pages of every level";
    editor.state().settings.view.face = int(empty - levels.begin());
    editor.settle();
    const test::DrawnText text;
    editor.frame();
    EXPECT_TRUE(text.shows("No look-up requests a page of this level"));
    editor.state().settings.view.face = int(fullest - levels.begin());
    editor.settle();
    EXPECT_FALSE(text.shows("No look-up requests a page of this level"));
}

}  // namespace
}  // namespace si
