// Report of driver choices: alternative settings and programs, timed in turns and written as JSON.
#include "tests/bench/gpu_report.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "app/context/headless_context.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/gl/handle.h"
#include "renderer/optimisations/optimisations.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

using Json = nlohmann::ordered_json;
struct Way {
    std::string name;
    std::function<double()> gpu_ms;  ///< function that draws once and returns GPU milliseconds
};

Json spread_json(const std::vector<double>& ms) {
    const Quartiles s(ms);
    return {{"median", s.median}, {"p25", s.p25}, {"p75", s.p75}};
}

/// Times two ways in turn. A way is preferred if its quartiles lie wholly below the other's.
Json choice(const std::string& key, const std::string& question, const Way& a, const Way& b, int rounds) {
    for (int i = 0; i < 3; ++i) {
        a.gpu_ms();
        b.gpu_ms();
    }  // first use compiles
    std::vector<double> ms_a, ms_b, wall_a, wall_b, ratios;
    for (int i = 0; i < rounds; ++i) {
        const auto take = [](const Way& way, std::vector<double>& ms, std::vector<double>& wall) {
            wall.push_back(wall_ms([&] {
                ms.push_back(way.gpu_ms());
                glFinish();
            }));
        };
        take(a, ms_a, wall_a);
        take(b, ms_b, wall_b);
        ratios.push_back(ms_b.back() / std::max(ms_a.back(), 1e-6));
    }
    const Quartiles ratio(ratios);
    const std::string preferred = ratio.p25 > 1 ? a.name : ratio.p75 < 1 ? b.name : "undecided";
    const auto way = [](const Way& w, const std::vector<double>& ms, const std::vector<double>& wall) {
        return Json{{"name", w.name}, {"ms", spread_json(ms)}, {"wall_ms", spread_json(wall)}};
    };
    return {{"key", key},
            {"question", question},
            {"a", way(a, ms_a, wall_a)},
            {"b", way(b, ms_b, wall_b)},
            {"ratio_b_to_a", spread_json(ratios)},
            {"preferred", preferred},
            {"rounds", rounds}};
}

/// Measurement of the requested choices.
class Choices {
public:
    explicit Choices(const GpuReportOptions& options) : options_(options), met_(options.choices.size(), false) {}

    void add(const std::string& key, const std::string& question, const Way& a, const Way& b) {
        bool wanted = options_.choices.empty();
        for (std::size_t i = 0; i < met_.size(); ++i)
            if (key.starts_with(options_.choices[i])) wanted = met_[i] = true;
        keys_ += (keys_.empty() ? "" : ", ") + key;
        if (wanted) rows_.push_back(choice(key, question, a, b, options_.rounds));
    }
    /// Returns the rows of the report. @throws UsageError for a requested choice that does not exist
    Json rows() const {
        for (std::size_t i = 0; i < met_.size(); ++i)
            if (!met_[i])
                throw UsageError(
                    fmt::format("--choices {}: no choice begins so; there are {}", options_.choices[i], keys_));
        return rows_;
    }
    const GpuReportOptions& options() const { return options_; }

private:
    const GpuReportOptions& options_;
    std::vector<bool> met_;  ///< whether each of options_.choices exists
    std::string keys_;       ///< all existing keys
    Json rows_ = Json::array();
};

/// Choices of the renderer on the agreed scene: two sets of settings, or an optimisation on and off.
class RendererChoices {
public:
    RendererChoices(Renderer& renderer, Choices& to) : renderer_(renderer), to_(to) {}

    void add(const std::string& key, const std::string& question, const Sets& common, const Sets& a, const Sets& b) {
        to_.add(key, question, way(common, a, {}), way(common, b, {}));
    }
    void add_optimisation(const OptimisationRow& row, Optimisation optimisation) {
        Way made = way({"filter.kernel=pcf3"}, {}, {}), forced = way({"filter.kernel=pcf3"}, {}, {optimisation});
        made.name = "made";
        forced.name = "not made";
        to_.add(fmt::format("saving/{}", row.key), std::string(row.help), made, forced);
    }
    void add_blocks(const std::string& kernel) {
        Way blocks = way({{"filter.kernel", kernel}}, {}, {}, false),
            images = way({{"filter.kernel", kernel}}, {}, {}, true);
        blocks.name = "uniform blocks";
        images.name = "images";
        to_.add("uniform_blocks_or_images/" + kernel,
                "Read the frame's numbers from uniform blocks, or four at a time from images?", blocks, images);
    }

private:
    Renderer& renderer_;
    Choices& to_;
    Scene scene_ = test::agreed_scene(test::AgreedSize::Triangles100k);

    Way way(const Sets& common, const Sets& own, const OptimisationSet& forced, std::optional<bool> as_images = {}) {
        Settings s;
        s.lights[0].elevation = 45;
        std::string name;
        for (const Sets* sets : {&common, &own}) set_all(s, *sets);
        for (const auto& [key, value] : own) name += fmt::format("{}{}={}", name.empty() ? "" : " ", key, value);
        FrameRequest request{.width = to_.options().width, .height = to_.options().height};
        request.timing = request.force = true;
        request.forced = forced;
        request.blocks_as_images = as_images;
        return {name, [this, s, request] {
                    double ms = 0;
                    for (const PassInfo& p : renderer_.render(scene_, s, request).passes) ms += p.gpu_ms;
                    return ms;
                }};
    }
};

gl::Program program_of(const std::string& fragment) {
    static constexpr const char* kVertex =
        "#version 450 core\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, "
        "1); }\n";
    gl::Program program = gl::Program::create("gpu report");
    const std::array<std::pair<GLenum, const char*>, 2> stages = {
        {{GL_VERTEX_SHADER, kVertex}, {GL_FRAGMENT_SHADER, fragment.c_str()}}};
    for (const auto& [stage, text] : stages) {
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program.id(), shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program.id());
    GLint ok = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok) throw Error("a program of the report does not link");
    return program;
}

/// Returns a fragment shader with Lambert and a highlight for each light at each pixel, with lights as unrolled
/// constants or counted by a uniform.
std::string light_loop(bool by_uniform, int lights) {
    const std::string count = by_uniform ? "uniform int count;\nuniform int kind[16];\n"
                                         : fmt::format(
                                               "const int count = {};\nconst int kind[16] = int[](0, 1, 0, 1, 0, "
                                               "1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1);\n",
                                               lights);
    return "#version 450 core\n" + count + R"(
layout(location = 0) out vec4 colour;
void main() {
    vec3 p = vec3(gl_FragCoord.xy * 0.01, 1), n = normalize(vec3(sin(p.x), 2, cos(p.y))), sum = vec3(0);
    for (int i = 0; i < count; ++i) {
        vec3 at = vec3(3 * i, 4, 2 * i), l = kind[i] == 0 ? normalize(at) : normalize(at - p);
        float fall = kind[i] == 0 ? 1 : 1 / (1 + dot(at - p, at - p));
        sum += fall * (max(dot(n, l), 0) + pow(max(dot(n, normalize(l + vec3(0, 0, 1))), 0), 32));
    }
    colour = vec4(sum, 1);
}
)";
}

/// Target picture of full-screen programs.
class Screen {
public:
    Screen(int width, int height) : width_(width), height_(height) {
        glTextureStorage2D(colour_.id(), 1, GL_RGBA8, width_, height_);
        glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, colour_.id(), 0);
    }
    /// Returns finished wall time, since one draw is too short for the clock of frames.
    double ms(GLuint program) const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
        glViewport(0, 0, width_, height_);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glBindVertexArray(vao_.id());
        glUseProgram(program);
        glFinish();
        return wall_ms([] {
                   for (int i = 0; i < 4; ++i) glDrawArrays(GL_TRIANGLES, 0, 3);
                   glFinish();
               }) /
               4;
    }

private:
    int width_, height_;
    gl::VertexArray vao_ = gl::VertexArray::create("gpu report");
    gl::Texture colour_ = gl::Texture::create("gpu report", GL_TEXTURE_2D);
    gl::Framebuffer framebuffer_ = gl::Framebuffer::create("gpu report");
};

void add_light_loops(Choices& to) {
    const Screen screen(to.options().width, to.options().height);
    for (const int lights : {1, 4, 16}) {
        const gl::Program constant = program_of(light_loop(false, lights)),
                          uniform = program_of(light_loop(true, lights));
        std::array<GLint, 16> kinds{};
        for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = GLint(i % 2);
        glProgramUniform1i(uniform.id(), glGetUniformLocation(uniform.id(), "count"), lights);
        glProgramUniform1iv(uniform.id(), glGetUniformLocation(uniform.id(), "kind"), 16, kinds.data());
        to.add(fmt::format("light_loop/{}", lights),
               "A program for each number and kind of lights, or one that branches on uniforms?",
               {"a program each", [&] { return screen.ms(constant.id()); }},
               {"uniform branches", [&] { return screen.ms(uniform.id()); }});
    }
}

void add_renderer_choices(Renderer& renderer, Choices& to) {
    RendererChoices choices(renderer, to);
    for (const char* kernel : {"hw2x2", "pcf3", "pcf5", "pcf7"})
        choices.add(fmt::format("gather_or_sampler/{}", kernel),
                    "Gather four texels and compare them in the shader, or have the shadow sampler compare?",
                    {{"filter.kernel", kernel}}, {"filter.method=gather"}, {"filter.method=sampler"});
    for (const char* kernel : {"hard", "pcf3", "pcf5"})
        choices.add(fmt::format("fused_or_separate/{}", kernel),
                    "Evaluate visibility inside shading, or in a pass of its own?", {{"filter.kernel", kernel}},
                    {"shading.separate_visibility=false"}, {"shading.separate_visibility=true"});
    GLint vertex_images = 0;  // fragments have eight everywhere
    glGetIntegerv(GL_MAX_VERTEX_IMAGE_UNIFORMS, &vertex_images);
    for (const char* kernel : {"hard", "pcf3"})
        if (vertex_images >= 2) choices.add_blocks(kernel);
    choices.add("back_faces", "Draw both faces of casters into the map, or leave out those that face away?",
                {"filter.kernel=hard"}, {"caster.cull=none"}, {"caster.cull=back"});
    choices.add("map_format", "Store depths in 32-bit floats, or in 16 bits?", {"filter.kernel=pcf3"},
                {"map.format=d32f"}, {"map.format=d16"});
    for (std::size_t i = 0; i < kOptimisations; ++i) choices.add_optimisation(optimisation_rows()[i], Optimisation(i));
}

}  // namespace

void write_gpu_report(const std::filesystem::path& file, const GpuReportOptions& options) {
    require_writable(file);
    const HeadlessContext context;
    Json report{{"what", "shadow-inspector GPU report"}, {"version", 1}, {"context", context.description()}};
    report["width"] = options.width;
    report["height"] = options.height;
    Choices choices(options);
    {
        Renderer renderer;
        const DriverInfo& driver = renderer.driver();
        report["driver"] = driver_json(driver);
        report["clock"] = {{"used", driver.clock}, {"query_share_of_wall_time", driver.query_share}};
        add_renderer_choices(renderer, choices);
    }
    add_light_loops(choices);
    report["choices"] = choices.rows();
    write_file(file, report.dump(1) + "\n");
}

}  // namespace si
