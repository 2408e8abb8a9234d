// Compiles every shader text that the program can make with the reference compiler, as GLSL 4.50.
//
// Frames run without drawing: texts passed to glShaderSource are kept, the driver gets an empty shader instead, and
// draw calls do nothing. Texts differ by defines, so frames go through
//   - every choice of every setting (and of light, overlay, ...),
//   - alternating rows of the tables of techniques,
//   - in the stage slow, every choice with every kind of material,
//   - every two choices that programs of any technique can meet (with SI_LONG, label `long`, every
// three that a file shared by all techniques mentions), as many of them in a frame as possible,
//   - and each technique with all combinations of the choices that its own files mention.
// A new row costs as many frames as its own files have combinations. Each text is compiled once.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <regex>
#include <set>
#include <span>
#include <sstream>
#include <thread>
#include <unordered_set>

#include "renderer/base/key.h"
#include "renderer/gl/shader_source.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/sources.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

struct ShaderText {
    bool vertex = false;
    std::string text;
};

/// Returns glslangValidator's messages on these texts; empty: none. Files with errors stay in the folder.
std::string validate(const fs::path& folder, const std::vector<ShaderText>& texts) {
    fs::create_directories(folder);
    std::string command = "cd '" + folder.string() + "' && glslangValidator";
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const std::string name = std::to_string(i) + (texts[i].vertex ? ".vert" : ".frag");
        std::ofstream(folder / name) << texts[i].text;
        command += " " + name;
    }
    const bool valid = std::system((command + " > log.txt 2>&1").c_str()) == 0;
    if (valid) {
        fs::remove_all(folder);
        return {};
    }
    std::istringstream log(file_bytes(folder / "log.txt"));
    std::string out, file;
    std::set<std::string> seen_errors;
    for (std::string line; std::getline(log, line);) {
        if (line.ends_with(".frag") || line.ends_with(".vert"))
            file = line;
        else if (line.starts_with("ERROR: ") && !line.ends_with("No code generated.") &&
                 seen_errors.insert(line).second)
            out += fmt::format("{}: {}\n", (folder / file).string(), line);
    }
    return out.empty() ? file_bytes(folder / "log.txt") : out;
}

/// Replaces the functions by which shaders and draws reach the driver, during its lifetime.
class Recorder {
public:
    explicit Recorder(fs::path folder) : folder_(std::move(folder)) {
        current = this;
        source_ = epoxy_glShaderSource;
        arrays_ = epoxy_glDrawArrays;
        instanced_ = epoxy_glDrawArraysInstanced;
        elements_ = epoxy_glDrawElementsInstancedBaseVertexBaseInstance;
        read_ = epoxy_glGetTextureImage;
        // Without drawing a probe finds nothing and stops: its block of 2x2 pixels is full of ones instead, and the
        // picture shows the triangle that they name.
        epoxy_glGetTextureImage = [](GLuint texture, GLint level, GLenum format, GLenum type, GLsizei size, void* out) {
            if (current->probes_hit && format == GL_RGBA && type == GL_FLOAT && size == GLsizei(4 * sizeof(glm::vec4)))
                std::fill_n(static_cast<float*>(out), 16, 1.f);
            else if (current->probes_hit && format == GL_RG_INTEGER)
                std::fill_n(static_cast<glm::uvec2*>(out), std::size_t(size) / sizeof(glm::uvec2),
                            glm::uvec2(1, 1u << 16));
            else
                current->read_(texture, level, format, type, size, out);
        };
        epoxy_glShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* parts, const GLint* lengths) {
            GLint stage = 0;
            glGetShaderiv(shader, GL_SHADER_TYPE, &stage);
            std::string text;
            for (GLsizei i = 0; i < count; ++i)
                text += lengths && lengths[i] >= 0 ? std::string(parts[i], std::size_t(lengths[i])) : parts[i];
            current->add({stage == GL_VERTEX_SHADER, std::move(text)});
            const char* empty = stage == GL_VERTEX_SHADER
                                    ? "#version 450 core\nvoid main() { gl_Position = vec4(2.0); }"
                                    : "#version 450 core\nvoid main() {}";
            current->source_(shader, 1, &empty, nullptr);
        };
        epoxy_glDrawArrays = [](GLenum, GLint, GLsizei) {};
        epoxy_glDrawArraysInstanced = [](GLenum, GLint, GLsizei, GLsizei) {};
        epoxy_glDrawElementsInstancedBaseVertexBaseInstance = [](GLenum, GLsizei, GLenum, const void*, GLsizei, GLint,
                                                                 GLuint) {};
    }
    ~Recorder() {
        epoxy_glShaderSource = source_;
        epoxy_glDrawArrays = arrays_;
        epoxy_glDrawArraysInstanced = instanced_;
        epoxy_glDrawElementsInstancedBaseVertexBaseInstance = elements_;
        epoxy_glGetTextureImage = read_;
        current = nullptr;
    }
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    bool probes_hit = false;

    std::size_t texts() const { return seen_.size(); }
    /// Compiles the remaining texts. @returns all errors
    std::string finish() {
        check();
        while (!running_.empty()) collect();
        return errors_;
    }
    /// Returns whether some text contains this line of a shader file.
    bool has_line(const std::string& line) const { return lines_.contains(Key().add(line).value()); }

private:
    void add(ShaderText text) {
        if (!seen_.insert(Key().add(text.vertex).add(text.text).value()).second) return;
        std::istringstream in(text.text);
        for (std::string line; std::getline(in, line);) lines_.insert(Key().add(line).value());
        batch_.push_back(std::move(text));
        if (batch_.size() == 250) check();
    }
    void check() {
        if (batch_.empty()) return;
        if (running_.size() >= std::max(std::thread::hardware_concurrency(), 1u)) collect();
        running_.push_back(
            std::async(std::launch::async, validate, folder_ / std::to_string(batches_++), std::move(batch_)));
        batch_.clear();
    }
    void collect() {
        const std::string errors = running_.front().get();
        if (errors_.size() < 4000) errors_ += errors;  // further errors repeat these
        running_.erase(running_.begin());
    }

    static inline Recorder* current = nullptr;
    fs::path folder_;
    int batches_ = 0;
    std::unordered_set<std::uint64_t> seen_, lines_;
    std::vector<ShaderText> batch_;
    std::vector<std::future<std::string>> running_;
    std::string errors_;
    decltype(epoxy_glShaderSource) source_;
    decltype(epoxy_glDrawArrays) arrays_;
    decltype(epoxy_glDrawArraysInstanced) instanced_;
    decltype(epoxy_glDrawElementsInstancedBaseVertexBaseInstance) elements_;
    decltype(epoxy_glGetTextureImage) read_;
};

/// Choices with the settings that make each of them.
using Change = Sets;

struct Axis {
    std::set<std::string> names;  ///< names in shaders
    std::vector<Change> choices;
    std::vector<std::string> files = {};  ///< files of each row of a table of techniques; included by the choice
    bool number = false;                  ///< plain number, on which no code branches
    bool owned = false;                   ///< no effect except under techniques whose files mention it
    bool hides = false;                   ///< no map in the programs under all but the first choice
};

std::string identifier(std::string_view key) {
    std::string out(key);
    std::replace(out.begin(), out.end(), '.', '_');
    return out;
}

std::vector<Axis> axes() {
    std::vector<Axis> out;
    for (const Param& p : params()) {
        if (!p.shader || p.scope != Scope::Scene || (p.cost != Cost::Program && !p.choices)) continue;
        Axis axis{{identifier(p.key)}, {}};
        const std::string key(p.key);
        if (p.choices)
            for (const auto& choice : p.choices()) axis.choices.push_back({{key, std::string(choice.key)}});
        else if (axis.number = std::holds_alternative<int>(default_value({&p, 0, {}})); axis.number)
            for (const double v : {std::max(p.min, 1.0), std::min(p.max, 15.0)})
                axis.choices.push_back({{key, std::to_string(int(v))}});
        else
            axis.choices = {{{key, "false"}}, {{key, "true"}}};
        if (p.key == "filter.method") axis.names.insert("FILTER_SAMPLER");
        if (p.key == "filter.size") axis.names.insert("KERNEL_SIZE");
        if (p.key == "filter.point" || p.key == "filter.bilinear") axis.names.insert("SAMPLER_BILINEAR");
        if (p.key == "filter.kernel") {
            axis.names.insert({"KERNEL_SIZE", "SAMPLER_BILINEAR", "FILTER_FILE", "BLUR_COLUMNS"});
            for (const Filter& row : filters()) axis.files.emplace_back(row.file);
        }
        if (p.key == "bias.kind") {
            axis.names.insert({"BIAS_FILE", "BIAS_PER_TEXEL"});
            for (const Bias& row : biases().first(axis.choices.size())) axis.files.emplace_back(row.file);
        }
        for (const Filter& row : filters()) axis.owned |= std::ranges::find(row.settings, p.key) != row.settings.end();
        for (const Bias& row : biases()) axis.owned |= std::ranges::find(row.settings, p.key) != row.settings.end();
        out.push_back(std::move(axis));
    }
    EXPECT_GE(out.size(), 10u);
    out.push_back({{"BIAS_NORMAL_OFFSET"}, {{"bias.normal=0"}, {"bias.normal=3"}}});
    out.push_back({{"SURFACE_FLAGS"}, {{}, {"object.plain.receive=false"}}});
    out.push_back({{"SEPARATE_VISIBILITY"}, {{}, {"shading.separate_visibility=true"}}});
    out.push_back({{"SKY_LIGHTS", "CURVE_FILMIC", "EXPOSED", "GROUND", "STUDIO_FLOOR"},
                   {{},
                    {"view.look=plain"},
                    {"shading.sky=plain"},
                    {"shading.curve=plain", "shading.exposure=1"},
                    {"shading.sky=plain", "shading.exposure=1"}}});
    out.push_back({{"BLUR_COLUMNS"}, {{}, {"map.blur_texels=3"}}});
    out.push_back({{"HAS_CONTACTS"}, {{}, {"light.contact=1"}}});
    out.push_back({{"MOMENTS_FROM"}, {{}, {"map.samples=4"}}});
    out.push_back({{"FROM_CHANNEL"}, {{}, {"view.map_channel=moment-1"}}});
    out.push_back({{"FROM_CAMERA"}, {{}, {"view.map_source=camera"}}});
    out.push_back({{}, {{}, {"caster.blend=mask"}}});
    out.push_back({{}, {{}, {"view.slabs=both"}}});
    out.push_back({{}, {{}, {"view.map_fit=true"}}});
    out.push_back({{"MAP_LAYERS", "LIGHT_TYPE", "LIGHT_CLOSED", "LIGHT_CHOICE", "LIGHT_PERSPECTIVE", "VIEWS_BLEND"},
                   {{},
                    {"light.type=spot"},
                    {"light.type=point"},
                    {"light.projection=perspective"},
                    {"light.type=spot", "light.projection=orthographic", "light.range=9"},
                    {"light.cascades=3"},
                    {"light.cascades=2", "light.cascade_choice=map", "light.cascade_blend=0"},
                    {"light.fit=casters"},
                    {"light.count=2", "light.1.type=point", "view.light=1"}}});
    out.push_back({.names = {"PAGE_SIZE"},
                   .choices = {{},
                               {"map.virtual=true", "map.virtual_levels=1"},
                               {"map.virtual=true", "map.page_size=32", "map.resolution=256"}}});
    out.push_back({.names = {"LIGHT_CASTS"}, .choices = {{}, {"light.cast=false"}}, .hides = true});
    Axis source{.names = {"SOURCE_FILE", "HAS_MAP"}, .hides = true};
    for (const Source& row : sources()) {
        source.choices.push_back({{"light.source", std::string(row.key)}});
        source.files.emplace_back(row.file);
    }
    out.push_back(std::move(source));
    Axis overlay{.names = {"OVERLAY_FILE"}, .choices = {{}}, .files = {""}};
    for (const Overlay& row : overlays()) {
        overlay.choices.push_back({{"view.overlay", std::string(row.key)}});
        overlay.files.push_back(row.file());
    }
    out.push_back(std::move(overlay));
    return out;
}

/// Makes one small quad per kind of material that shaders distinguish, or a plain one and one with all features.
Scene scene_of(bool every_kind) {
    Scene scene;
    scene.textures.push_back({.name = "white", .width = 2, .height = 2, .rgba = std::vector<std::uint8_t>(16, 255)});
    scene.textures.push_back({.name = "flat", .width = 1, .height = 1, .rgba = {128, 128, 255, 255}, .srgb = false});
    const auto add = [&](AlphaMode alpha, bool textured, bool mapped, bool tangents) {
        const std::string name = scene.nodes.empty() ? "plain" : std::to_string(scene.nodes.size());
        Material material{
            .name = name, .base_colour_texture = textured ? 0 : -1, .normal_texture = mapped ? 1 : -1, .alpha = alpha};
        scene.materials.push_back(material);
        Mesh mesh = make_quad(1, 1);
        mesh.material = int(scene.materials.size()) - 1;
        if (tangents) mesh.tangents.assign(mesh.positions.size(), glm::vec4(1, 0, 0, 1));
        scene.meshes.push_back(mesh);
        scene.nodes.push_back({.name = name, .local = moved(0, 0, -double(scene.nodes.size()))});
        scene.objects.push_back({.node = int(scene.nodes.size()) - 1, .mesh = int(scene.meshes.size()) - 1});
    };
    add(AlphaMode::Opaque, false, false, false);
    if (every_kind) {
        for (const AlphaMode alpha : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend})
            for (const bool textured : {false, true})
                for (const auto& [mapped, tangents] : {std::pair{false, false}, {true, false}, {true, true}})
                    add(alpha, textured, mapped, tangents);
    } else {
        add(AlphaMode::Mask, true, true, true);
        add(AlphaMode::Blend, true, true, true);
    }
    scene.objects.push_back(scene.objects.front());
    scene.objects.back().ground = true;
    finalise(scene);
    return scene;
}

std::vector<const Change*> pointers(const std::vector<Change>& choices) {
    std::vector<const Change*> out;
    for (const Change& c : choices) out.push_back(&c);
    return out;
}

/// Returns one row per kind that shared code distinguishes; overlays do not matter to it.
std::vector<const Change*> kinds_of(const Axis& table) {
    std::vector<const Change*> out;
    std::set<std::string> seen;
    for (const Change& choice : table.choices) {
        Settings s;
        set_all(s, choice);
        const Filter& filter = filter_of(s);
        const SourceNeeds& needs = source_of(s, 0).needs;
        const Bias& bias = bias_of(s);
        const std::string kind =
            fmt::format("{} {} {} {} | {} {} {} | {} {} {} {}", int(filter.samples()), is_bilinear(filter, s),
                        filter.linear, filter.moments.summed, bias.per_texel, bias.remainder != nullptr,
                        int(bias.stage), needs.map, source_of(s, 0).fused, needs.reference, needs.light_map);
        if (seen.insert(kind).second) out.push_back(&choice);
    }
    return out;
}

bool mentions_any(const std::string& text, const std::set<std::string>& names) {
    return std::ranges::any_of(names, [&](const std::string& name) { return gl::mentions(text, name); });
}

/// Include graph of the shader files.
class ShaderFiles {
public:
    ShaderFiles() {
        const fs::path root = SI_SOURCE_DIR "/shaders";
        for (const auto& entry : fs::recursive_directory_iterator(root))
            if (entry.is_regular_file())
                texts_[fs::relative(entry.path(), root).generic_string()] = file_bytes(entry.path());
        for (const auto& [file, text] : texts_)
            if (file.starts_with("passes/")) add_included(file, shared_);
    }
    const std::string& text(const std::string& file) const { return texts_.at(file); }
    /// Returns the files that passes include under every technique.
    const std::set<std::string>& shared() const { return shared_; }
    /// Returns a technique's file and the files that only techniques include.
    std::string own_text(const std::string& file) const {
        std::set<std::string> included;
        if (!file.empty()) add_included(file, included);
        std::string out;
        for (const std::string& f : included)
            if (!shared_.contains(f)) out += texts_.at(f);
        return out;
    }

private:
    void add_included(const std::string& file, std::set<std::string>& out) const {
        if (!texts_.contains(file) || !out.insert(file).second) return;
        static const std::regex include("#include \"([^\"]+)\"");
        const std::string& text = texts_.at(file);
        for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at)
            add_included((*at)[1], out);
    }

    std::map<std::string, std::string> texts_;
    std::set<std::string> shared_;
};

class Permutations : public testing::Test {
protected:
    /// Makes the texts of all passes that these choices draw.
    void draw(const Scene& scene, const std::vector<const Change*>& chosen) {
        if (++frames_ % 400 == 0) {  // limits the programs in memory
            renderer_.reset();
            renderer_ = std::make_unique<Renderer>();
        }
        Settings s;
        const Change always = {"map.resolution=16", "filter.kernel=hard", "truth.samples=1"};
        try {
            set_all(s, always);
            for (const Change* choice : chosen) set_all(s, *choice);
            FrameRequest request{.width = 8,
                                 .height = 8,
                                 .outputs = {.colour = true,
                                             .shadow_map = true,
                                             .visibility = true,
                                             .overlay = true,
                                             .map_coordinates = true,
                                             .texels_read = true,
                                             .error = true,
                                             .true_colour = true},
                                 .smoothed = 1};
            if (chosen.size() == 1) {
                // Draws a probe's passes after a hit, and the passes that run without a reference.
                FrameRequest untold = request;
                untold.outputs.evidence = untold.with_look = true;
                untold.outputs.true_colour = false;  // which is drawn plain
                untold.force = true;                 // also passes with cached results
                renderer_->render(scene, s, untold);
                request.outputs.evidence = request.outputs.health = true;
            }
            render_with_reference(*renderer_, scene, s, request, references_);
            if (recorder_) recorder_->probes_hit = chosen.size() == 1;
            renderer_->probe(scene, s, request, 4, 4);
            if (recorder_) recorder_->probes_hit = false;
        } catch (const std::exception& e) {
            ADD_FAILURE() << e.what();
        }
    }

    /// Keeps all texts from now on.
    void record() {
        ASSERT_EQ(std::system("command -v glslangValidator > /dev/null"), 0) << "install the package glslang-tools";
        glDrawArrays(GL_POINTS, 0, 0);  // epoxy looks functions up when they are first called
        FrameRequest request{.width = 8, .height = 8};
        Settings s;
        set_setting(s, "view.slabs", "both");
        renderer_->render(every_kind_, s, request);
        renderer_ = std::make_unique<Renderer>();
        glDrawArraysInstanced(GL_POINTS, 0, 0, 0);
        glGetTextureImage(0, 0, GL_RGBA, GL_FLOAT, 0, nullptr);
        while (glGetError() != GL_NO_ERROR) {
        }
        recorder_ = std::make_unique<Recorder>(fresh_test_folder());
        renderer_->driver();  // the calibrations' shaders
    }
    /// Compiles what is left of the texts, and expects many texts and no errors.
    void expect_valid() {
        EXPECT_EQ(recorder_->finish(), "");
        EXPECT_GT(recorder_->texts(), 1000u);
        std::printf("%zu texts from %d frames\n", recorder_->texts(), frames_);
    }

    /// Draws each choice by itself.
    void draw_each_choice(const Scene& scene) {
        for (const Axis& axis : all_)
            for (const Change& choice : axis.choices) draw(scene, {&choice});
        // A kernel's stored values are shown by code of its own, which some third choice may leave out of the frame.
        const Change moment = {"view.map_channel=moment-1"};
        for (const Axis& axis : all_)
            if (axis.names.contains("FILTER_FILE"))
                for (const Change* kernel : kinds_of(axis)) draw(scene, {kernel, &moment});
    }

    /// Draws every two choices in one frame, in long runs every three that one of the shared files mentions. Each
    /// frame takes as many new ones as possible. Choices that remove the map from programs meet the others one at a
    /// time.
    void draw_combined() {
        struct Plain {
            const Axis* axis;
            std::vector<const Change*> choices;
            std::vector<int> numbers = {};  ///< indices among all choices; addresses would order them by chance
        };
        std::vector<Plain> plain;
        std::vector<const Change*> hiding;
        for (const Axis& axis : all_) {
            if (axis.owned) continue;
            std::vector<const Change*> choices = axis.files.empty() ? pointers(axis.choices) : kinds_of(axis);
            if (axis.hides)
                hiding.insert(hiding.end(), choices.begin() + 1, choices.end());
            else
                plain.push_back({&axis, std::move(choices)});
        }
        for (const Change* hides : hiding)
            for (const Plain& p : plain)
                for (const Change* other : p.choices) draw(few_kinds_, {hides, other});

        std::vector<const Change*> numbered;
        for (Plain& p : plain)
            for (const Change* choice : p.choices) {
                p.numbers.push_back(int(numbered.size()));
                numbered.push_back(choice);
            }
        using Together = std::set<int>;
        std::set<Together> left;
        const auto leave = [&](const auto& self, std::span<const Plain* const> axes, Together chosen) -> void {
            if (axes.empty()) {
                left.insert(chosen);
                return;
            }
            for (const int c : axes.front()->numbers) {
                Together more = chosen;
                more.insert(c);
                self(self, axes.subspan(1), more);
            }
        };
        for (std::size_t i = 0; i < plain.size(); ++i)
            for (std::size_t j = i + 1; j < plain.size(); ++j)
                leave(leave, std::array<const Plain*, 2>{&plain[i], &plain[j]}, {});
        for (const std::string& file : std::getenv("SI_LONG") ? files_.shared() : std::set<std::string>()) {
            std::vector<const Plain*> mentioned;
            for (const Plain& p : plain)
                if (mentions_any(files_.text(file), p.axis->names)) mentioned.push_back(&p);
            for (std::size_t i = 0; i < mentioned.size(); ++i)
                for (std::size_t j = i + 1; j < mentioned.size(); ++j)
                    for (std::size_t k = j + 1; k < mentioned.size(); ++k)
                        leave(leave, std::array<const Plain*, 3>{mentioned[i], mentioned[j], mentioned[k]}, {});
        }
        while (!left.empty()) {
            Together chosen = *std::ranges::max_element(left, {}, &Together::size);
            for (const Plain& p : plain) {
                if (std::ranges::any_of(p.numbers, [&](int c) { return chosen.contains(c); })) continue;
                const auto gain = [&](int c) {
                    int gained = 0;
                    for (auto i = chosen.begin(); i != chosen.end(); ++i) {
                        gained += left.contains({c, *i});
                        for (auto j = std::next(i); j != chosen.end(); ++j) gained += left.contains({c, *i, *j});
                    }
                    return gained;
                };
                chosen.insert(*std::ranges::max_element(p.numbers, {}, gain));
            }
            std::erase_if(left, [&](const Together& t) { return std::ranges::includes(chosen, t); });
            std::vector<const Change*> choices;
            for (const int c : chosen) choices.push_back(numbered[std::size_t(c)]);
            draw(few_kinds_, choices);
        }
    }

    /// Draws each row of each table of techniques with all combinations of the choices in its own files.
    void draw_techniques() {
        for (const Axis& table : all_)
            for (std::size_t row = 0; row < table.files.size(); ++row) {
                const std::string text = files_.own_text(table.files[row]);
                std::vector<std::vector<const Change*>> mentioned = {{&table.choices[row]}}, numbers;
                for (const Axis& axis : all_) {
                    const bool of_table = !axis.files.empty();
                    const bool named = mentions_any(text, axis.names);
                    if (&axis == &table || (!named && (!of_table || axis.hides))) continue;
                    (axis.number || !named ? numbers : mentioned)
                        .push_back(of_table ? kinds_of(axis) : pointers(axis.choices));
                }
                draw_product(mentioned, numbers);
            }
    }

    /// Draws frames of one row of each table of techniques, until each row was in one.
    void draw_alternating_techniques() {
        std::size_t most = 0;
        for (const Axis& table : all_) most = std::max(most, table.files.size());
        for (std::size_t turn = 0; turn < most; ++turn) {
            std::vector<const Change*> chosen;
            for (const Axis& table : all_)
                if (!table.files.empty() && !table.hides) chosen.push_back(&table.choices[turn % table.choices.size()]);
            draw(few_kinds_, chosen);
        }
    }

    /// Draws all combinations of one choice of each list, with alternating values of `numbers`.
    void draw_product(const std::vector<std::vector<const Change*>>& lists,
                      const std::vector<std::vector<const Change*>>& numbers) {
        std::vector<std::size_t> at(lists.size(), 0);
        std::size_t turn = 0;
        for (bool more = true; more; ++turn) {
            std::vector<const Change*> chosen;
            for (std::size_t i = 0; i < at.size(); ++i) chosen.push_back(lists[i][at[i]]);
            for (const auto& choices : numbers) chosen.push_back(choices[turn % choices.size()]);
            draw(few_kinds_, chosen);
            more = false;
            for (std::size_t i = 0; i < at.size() && !more; ++i) {
                more = ++at[i] < lists[i].size();
                if (!more) at[i] = 0;
            }
        }
    }

    const HeadlessContext context_;
    std::unique_ptr<Renderer> renderer_ = std::make_unique<Renderer>();
    ReferenceCache references_;
    std::unique_ptr<Recorder> recorder_;
    const Scene every_kind_ = scene_of(true), few_kinds_ = scene_of(false);
    const std::vector<Axis> all_ = axes();
    const ShaderFiles files_;
    int frames_ = 0;
};

TEST_F(Permutations, EveryChoiceCompilesWithTheReferenceCompiler) {
    ASSERT_NO_FATAL_FAILURE(record());
    draw_each_choice(few_kinds_);
    // Blobs belong to casters that are small beside the scene.
    for (const Axis& axis : all_)
        if (axis.names.contains("SOURCE_FILE"))
            for (const Change& choice : axis.choices) draw(every_kind_, {&choice});
    // Bounds of depths are found for kernels of many taps, once the map is known.
    const Change wide = {"filter.kernel=vogel", "filter.taps=64"};
    for (int frame = 0; frame < 2; ++frame) draw(few_kinds_, {&wide});
    draw_alternating_techniques();
    expect_valid();
    for (const auto& entry : fs::recursive_directory_iterator(SI_SOURCE_DIR "/shaders")) {
        if (!entry.is_regular_file() || entry.path().extension() != ".glsl") continue;
        std::istringstream in(file_bytes(entry.path()));
        std::string last;
        for (std::string line; std::getline(in, line);)
            if (line.size() > last.size() && !line.starts_with("#")) last = line;  // the longest line names the file
        EXPECT_TRUE(recorder_->has_line(last)) << entry.path() << " is in no program: " << last;
    }
}

SI_TEST_IS(Later, Permutations, EveryChoiceAndMaterialCompileWithTheReferenceCompiler);
TEST_F(Permutations, EveryChoiceAndMaterialCompileWithTheReferenceCompiler) {
    ASSERT_NO_FATAL_FAILURE(record());
    draw_each_choice(every_kind_);
    expect_valid();
}

SI_TEST_IS(Later, Permutations, EveryTwoChoicesCompileWithTheReferenceCompiler);
TEST_F(Permutations, EveryTwoChoicesCompileWithTheReferenceCompiler) {
    ASSERT_NO_FATAL_FAILURE(record());
    draw_combined();
    draw_techniques();
    expect_valid();
}

// Faults are found and named.
TEST(ReferenceCompiler, RejectsWrongShaders) {
    const std::string head = "#version 450 core\nlayout(location = 0) out vec4 c;\n";
    const std::vector<ShaderText> texts = {{false, head + "void main() { c = vec4(1.0); }\n"},
                                           {false, head + "void main() { c = 1; }\n"}};
    const std::string errors = validate(fresh_test_folder(), texts);
    EXPECT_NE(errors.find("1.frag: ERROR: 0:3"), std::string::npos) << errors;
    EXPECT_EQ(errors.find("0.frag"), std::string::npos) << errors;
}

}  // namespace
}  // namespace si
