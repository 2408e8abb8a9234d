// Tests that planning a frame keeps the images of other frames: only drawing replaces them.
#include "app/context/headless_context.h"
#include "renderer/render/renderer_impl.h"
#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class PlanningTest : public ::testing::Test {
protected:
    HeadlessContext context;
    RendererImpl renderer;
    Scene scene = load_scene("boxes");

    void TearDown() override {
        for (const std::string& message : renderer.messages.take_messages()) ADD_FAILURE() << "driver: " << message;
    }
    /// Returns a request for everything that a renderer caches without a reference.
    static FrameRequest request(int width, int height) {
        FrameRequest r{.width = width, .height = height};
        r.outputs = {.shadow_map = true,
                     .visibility = true,
                     .overlay = true,
                     .surface_ids = true,
                     .map_coordinates = true,
                     .evidence = true,
                     .unfiltered_map = true};
        return r;
    }
    FrameResult draw(const Settings& s, const FrameRequest& request) {
        FrameState f = renderer.prepare_frame(scene, s, request);
        renderer.plan_frame(f);
        return renderer.run_plan(f);
    }
    void plan(const Settings& s, const FrameRequest& request) {
        FrameState f = renderer.prepare_frame(scene, s, request);
        renderer.plan_frame(f);
    }
    static std::vector<Image> images(const FrameResult& f) {
        std::vector<Image> out = {f.visibility, f.map_coordinates, f.surface_ids, f.map_view, f.evidence[0]};
        for (const Pane& pane : f.panes) out.insert(out.end(), {pane.picture, pane.values});
        return out;
    }
    static std::vector<std::uint8_t> bytes(const Image& image) {
        std::vector<std::uint8_t> out(std::size_t(image.width) * std::size_t(image.height) * 4);
        gl::prepare_read_back();
        GLint format = 0;
        glGetTextureLevelParameteriv(image.texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
        if (format == GL_RG32UI) return out;  // these pixels cannot be read as colours
        glGetTextureImage(image.texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(out.size()), out.data());
        return out;
    }
};

TEST_F(PlanningTest, ADiscardedPlanKeepsTheLastFrameReusable) {
    const std::vector<Sets> frames = {
        {"light.count=2", "light.1.type=spot", "light.1.elevation=60", "filter.kernel=vsm", "map.blur_texels=1",
         "bias.raster_slope=1", "view.panes=two", "view.overlay=visibility", "view.overlay_2=n-dot-l",
         "view.slabs=both", "view.map_fit=true"},
        {"light.count=2", "light.source=volumes-zfail", "light.1.source=volumes-zfail", "map.format=colour"},
    };
    const std::vector<Sets> others = {{},
                                      {"map.resolution=96"},
                                      {"map.format=d16"},
                                      {"filter.kernel=hard"},
                                      {"map.blur_texels=0"},
                                      {"map.blur_texels=3"},
                                      {"bias.raster_slope=0"},
                                      {"light.count=1"},
                                      {"light.count=3"},
                                      {"light.type=point"},
                                      {"light.cast=false", "light.1.cast=false"},
                                      {"light.source=none"},
                                      {"light.source=none", "light.1.source=none"},
                                      {"light.azimuth=77"},
                                      {"view.panes=one", "view.slabs=none"},
                                      {"view.map_source=camera"}};
    for (const Sets& frame : frames) {
        Settings s = settings_for(scene, {"map.resolution=64"});
        set_all(s, frame);
        const FrameResult first = draw(s, request(96, 72));
        std::vector<std::vector<std::uint8_t>> before;
        for (const Image& image : images(first))
            if (image.texture) before.push_back(bytes(image));
        ASSERT_GE(before.size(), 4u);
        for (const Sets& other : others) {
            Settings changed = s;
            std::string what;
            for (const auto& [key, value] : other) {
                set_setting(changed, key, value);
                what += key + "=" + value + " ";
            }
            SCOPED_TRACE(what);
            for (const int width : {96, 120}) plan(changed, request(width, 72));
            const FrameResult again = draw(s, request(96, 72));
            for (const PassInfo& pass : again.passes) EXPECT_NE(pass.state, PassState::Drawn) << pass.name;
            std::vector<std::vector<std::uint8_t>> after;
            for (const Image& image : images(again))
                if (image.texture) after.push_back(bytes(image));
            EXPECT_EQ(before, after);
        }
    }
}

}  // namespace
}  // namespace si
