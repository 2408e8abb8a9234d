// Pass that searches every map, its moments and the visibility for invalid numbers on the GPU, layer by layer. Only one
// record a layer is read back. Matrices and blocks are searched on the CPU.
#include "renderer/passes/numeric_health.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/base/index_of.h"
#include "renderer/frame/blocks.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/passes/pages.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr int kMinTileTexels = 32;    ///< texels that one invocation searches along a side
constexpr int kMaxTilesPerSide = 64;  ///< along a side; larger images have larger tiles

/// Tolerance of visibility outside 0 to 1, as kernel weights are rounded.
constexpr double kLightSlack = 1e-5;

/// Returns the numbers of the faults as defines for passes/numeric_health.frag.glsl.
const std::vector<gl::Define>& fault_defines() {
    static const std::vector<gl::Define> defines = {
        {"HEALTH_FAULTS", std::to_string(kNumberFaults)},
        {"FAULT_NOT_A_NUMBER", std::to_string(index_of(NumberFault::NotANumber))},
        {"FAULT_INFINITE", std::to_string(index_of(NumberFault::Infinite))},
        {"FAULT_OUTSIDE_RANGE", std::to_string(index_of(NumberFault::OutsideRange))},
        {"FAULT_NEGATIVE_VARIANCE", std::to_string(index_of(NumberFault::NegativeVariance))},
        {"FAULT_OVERFLOW", std::to_string(index_of(NumberFault::Overflow))}};
    return defines;
}

/// Requirements on the numbers of an image.
struct Demands {
    int channels = 1;
    bool in_range = false;              ///< first channel must lie in 0 to 1
    bool warped = false;                ///< channels are exponentials
    bool quantised = false;             ///< channels are quantised in a transformed space
    int variances = 0;                  ///< pairs of mean and mean square
    double relative = 0, absolute = 0;  ///< rounding error: relative to the mean square, and absolute
};

/// Image to search, with the requirements on its numbers.
struct Searched {
    Result of;
    const gl::Target* image;
    std::string name;  ///< "shadow map"
    Demands demands;
    bool of_maps = true;    ///< a layer for each view; else a layer for each light, of pixels
    bool of_pages = false;  ///< image is a page pool
    bool has_layers() const { return image->layers > 0; }
};

/// Layer of a searched image at one mip level.
struct SearchedLayer {
    NumberFinding place;  ///< place without count and value
    int layer = 0;
    glm::ivec2 size{0};
};

/// Record that the shader writes for one kind of fault.
struct FaultRecord {
    std::uint32_t count, first, worst, bits;
    glm::ivec2 first_at() const { return {int(first & 0xffffu), int(first >> 16)}; }
    glm::ivec2 worst_at() const { return {int(worst & 0xffffu), int(worst >> 16)}; }
    double value() const { return std::bit_cast<float>(bits); }
};
static_assert(sizeof(FaultRecord) == 16);

// Searched images ---------------------------------------------------------------------------------------------------

/// Returns the requirements on stored moments. A variance may fall below 0 by rounding of the stored mean and mean
/// square, of their sums, and of mip levels.
Demands moment_demands(const FrameState& f) {
    const StoredMoments& m = filter_of(f.settings).moments;
    const bool wide = f.settings.filter.moment_format == MomentFormat::Bits32;
    Demands d{.channels = int(m.names.size()), .warped = m.power > 0};
    if (m.summed) return d;
    d.variances = m.power == 2 ? int(m.names.size()) / 2 : m.power == 1 ? 0 : m.names.size() > 1 ? 1 : 0;
    const double levels = keeps_mips(f.settings) ? gl::mip_levels(f.map_size.longest()) : 0;
    const double single = std::exp2(-24), half = std::exp2(-11), step = 1.0 / 65535;
    const double terms = 2 * (2 * f.settings.filter.blur + 1) + std::max(f.settings.map.samples, 1) + 8;
    d.quantised = m.quantised && !wide;
    d.relative = 4 * terms * single + (wide || d.quantised ? single : half) * (4 + 4 * levels);
    if (!wide && !d.quantised) d.absolute = std::exp2(-24);  // smallest positive 16-bit float
    // Quantised moments are rounded in a transformed space; the inverse transform scales the error of b.y - b.x^2 by at
    // most 3.6.
    if (d.quantised) d.absolute = 3.6 * step * (1 + levels);
    return d;
}

std::vector<Searched> searched_images(const FrameState& f) {
    std::vector<Searched> out;
    const auto add = [&](Result of, std::string name, const Demands& demands, bool of_maps, bool of_pages = false) {
        if (f.result(of).texture) out.push_back({of, &f.result(of), std::move(name), demands, of_maps, of_pages});
    };
    const Demands depth{.in_range = true}, light{.in_range = true, .absolute = kLightSlack};
    if (f.view_count > 0) {
        add(Result::DrawnMaps, "shadow map", depth, true, f.paged);
        if (f.blurs_depths()) add(Result::ShadowMaps, "blurred shadow map", depth, true);
        const StoredMoments& m = filter_of(f.settings).moments;
        const bool integers = m.summed && f.settings.filter.sums == TableSums::Integer;  // always numbers
        if (filter_of(f.settings).samples() == Samples::Moments && !integers)
            add(Result::Moments, m.summed ? "table of sums" : "moments", moment_demands(f), true);
    }
    add(Result::Visibility, "visibility", light, false);
    add(Result::CameraDepth, "camera depth", depth, false);
    add(Result::Blobs, "blobs", light, false);
    return out;
}

/// Returns the place of a map layer in words.
NumberFinding place_of_view(const FrameState& f, const Searched& s, std::size_t light, std::size_t view) {
    const FittedLight& l = f.gl.fitted[light];
    const std::string name = view_name(l.chooser.choice, view, l.views.size());
    return {.image = s.of,
            .place = fmt::format("{}{}{} of light {}", s.name, name.empty() ? "" : ", ", name, light),
            .light = int(light),
            .view = int(view),
            .unit = "texel"};
}

/// Returns all layers and mip levels of an image.
std::vector<SearchedLayer> layers_of(const FrameState& f, const Searched& s) {
    std::vector<SearchedLayer> out;
    const auto add = [&](NumberFinding place, int layer) {
        for (int level = 0; level < s.image->extent.levels; ++level) {
            SearchedLayer next{place, layer, glm::max(glm::ivec2(s.image->width, s.image->height) >> level, 1)};
            next.place.level = level;
            if (level > 0) next.place.place += fmt::format(", mip level {}", level);
            out.push_back(std::move(next));
        }
    };
    if (!s.of_maps) {
        for (int layer = 0; layer < std::max(s.image->layers, 1); ++layer) {
            const bool lit = s.has_layers();
            // Layers of lights without blobs are neither drawn nor read.
            if (s.of == Result::Blobs &&
                !(f.gl.fitted[std::size_t(layer)].shadowed && source_of(f.settings, layer).needs.blobs))
                continue;
            add({.image = s.of,
                 .place = lit ? fmt::format("{} of light {}", s.name, layer) : s.name,
                 .light = lit ? layer : -1,
                 .unit = "pixel"},
                layer);
        }
        return out;
    }
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        for (std::size_t v = 0; f.gl.fitted[i].casts && v < f.gl.fitted[i].views.size(); ++v)
            if (const int layer = f.first_view[i] + int(v); !f.drawn_cells_by_layer[std::size_t(layer)].empty())
                add(place_of_view(f, s, i, v), layer);
    return out;
}

// The search ----------------------------------------------------------------------------------------------------------

std::vector<gl::Define> search_defines(const Searched& s) {
    std::vector<gl::Define> out = fault_defines();
    out.insert(out.end(), {{"HEALTH_STEP", "0"},
                           {"HEALTH_LAYERS", s.has_layers() ? "1" : "0"},
                           {"HEALTH_CHANNELS", std::to_string(s.demands.channels)},
                           {"HEALTH_IN_RANGE", s.demands.in_range ? "1" : "0"},
                           {"HEALTH_WARPED", s.demands.warped ? "1" : "0"},
                           {"HEALTH_QUANTISED", s.demands.quantised ? "1" : "0"},
                           {"HEALTH_VARIANCES", std::to_string(s.demands.variances)}});
    return out;
}

class FaultSearch {
public:
    FaultSearch(const FrameState& f, NumericHealthPass::Targets& t, PassInfo& info) : f_(f), t_(t), info_(info) {}

    /// Counts the faults in each tile of a layer.
    glm::ivec2 search(const Searched& s, const SearchedLayer& layer, int tile) {
        const glm::ivec2 tiles = (layer.size + tile - 1) / tile;
        t_.tiles.ensure("numeric health, tiles", GL_RGBA32UI, std::max(tiles.x, kMaxTilesPerSide),
                        std::max(tiles.y, kMaxTilesPerSide), int(kNumberFaults));
        const gl::Framebuffer into = gl::make_layers_framebuffer("numeric health, tiles", t_.tiles);
        f_.begin_fullscreen_pass(into.id(), tiles.x, tiles.y);
        const GLuint id = program(search_defines(s));
        glUseProgram(id);
        glBindTextureUnit(shared::UNIT_SEARCHED, s.image->texture.id());
        glBindSampler(shared::UNIT_SEARCHED, 0);
        glUniform1i(glGetUniformLocation(id, "layer"), layer.layer);
        glUniform1i(glGetUniformLocation(id, "level"), layer.place.level);
        glUniform2i(glGetUniformLocation(id, "size"), layer.size.x, layer.size.y);
        glUniform1i(glGetUniformLocation(id, "tile"), tile);
        glUniform1i(glGetUniformLocation(id, "from_top"), s.of_maps ? 0 : 1);
        glUniform2f(glGetUniformLocation(id, "slack"), float(s.demands.relative), float(s.demands.absolute));
        FrameState::draw_fullscreen(info_);
        return tiles;
    }

    /// Sums the tiles' faults into a column of the result.
    void add_up(const gl::Framebuffer& found, int column, glm::ivec2 tiles) {
        f_.begin_fullscreen_pass(found.id(), 1, 1);
        glViewport(column, 0, 1, 1);
        std::vector<gl::Define> defines = fault_defines();
        defines.push_back({"HEALTH_STEP", "1"});
        const GLuint id = program(std::move(defines));
        glUseProgram(id);
        glBindTextureUnit(shared::UNIT_SEARCHED, t_.tiles.texture.id());
        glUniform2i(glGetUniformLocation(id, "size"), tiles.x, tiles.y);
        FrameState::draw_fullscreen(info_);
    }

private:
    /// Returns a program for the search. It reads neither settings nor lights, so that one program serves all of them.
    GLuint program(std::vector<gl::Define> defines) const {
        return f_.gl.programs.get({.vertex = "passes/fullscreen.vert.glsl",
                                   .fragment = "passes/numeric_health.frag.glsl",
                                   .includes = {},
                                   .defines = std::move(defines),
                                   .preamble = {}});
    }

    const FrameState& f_;
    NumericHealthPass::Targets& t_;
    PassInfo& info_;
};

/// Starts copying a target's contents into a buffer, without waiting.
void begin_read_back(gl::Buffer& to, const gl::Target& from) {
    const auto bytes = GLsizeiptr(sizeof(FaultRecord)) * from.width * from.height * from.layers;
    to = gl::Buffer::create("numeric health");
    gl::fill_buffer(to, "numeric health", bytes, nullptr, GL_STREAM_READ);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, to.id());
    glGetTextureImage(from.texture.id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, GLsizei(bytes), nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

std::vector<FaultRecord> records_of(const gl::Buffer& buffer, std::size_t count) {
    std::vector<FaultRecord> out(count);
    glGetNamedBufferSubData(buffer.id(), 0, GLsizeiptr(count * sizeof(FaultRecord)), out.data());
    return out;
}

PoolTiles pool_tiles(const FrameState& f, const PagePasses& pages, const Searched& s) {
    PoolTiles out{.read_back = {}, .page = page_texels(f.settings), .layers = {}};
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        for (std::size_t v = 0; f.gl.fitted[i].casts && v < f.gl.fitted[i].views.size(); ++v)
            out.layers.push_back({place_of_view(f, s, i, v), {}});
    for (const PlacedPage& page : pages.read_pages()) out.layers[std::size_t(page.layer)].pages.push_back(page);
    return out;
}

/// Searches numbers for NaN and infinity. @param across numbers in a column
void check_numbers(NumericHealth& health, std::span<const float> numbers, int across, const std::string& place,
                   int light = -1, int view = -1) {
    health.numbers += numbers.size();
    for (const NumberFault fault : {NumberFault::NotANumber, NumberFault::Infinite}) {
        NumberFinding found{.fault = fault, .place = place, .light = light, .view = view, .count = 0, .unit = "number"};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const bool is_it = fault == NumberFault::NotANumber ? std::isnan(numbers[i]) : std::isinf(numbers[i]);
            if (!is_it || found.count++ > 0) continue;
            found.first = found.worst = {int(i) / across, int(i) % across};
            found.value = numbers[i];
        }
        if (found.count > 0) health.findings.push_back(std::move(found));
    }
}

/// Searches the camera's, lights' and objects' matrices and blocks for NaN and infinity.
/// @param[in,out] health receives the findings
void check_matrices_and_blocks(const FrameState& f, NumericHealth& health) {
    const auto check = [&](const auto& numbers, const std::string& place, int light = -1, int view = -1) {
        static_assert(sizeof numbers % sizeof(glm::vec4) == 0);
        const auto* first = reinterpret_cast<const float*>(&numbers);
        check_numbers(health, std::span(first, sizeof numbers / sizeof(float)), 4, place, light, view);
    };
    const shared::FrameBlock block = make_frame_block(f);
    check(block.clip_from_relative, "camera's matrix to clip space");
    check(block.eye_from_relative, "camera's matrix to its axes");
    check(block.relative_from_eye, "camera's matrix from its axes");
    check_numbers(health, std::span(&block.lens.x, &block.lights[0].position.x), 4, "frame's block, from the lens on");
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        check(block.lights[i], fmt::format("block of light {}", i), int(i));
        const FittedLight& light = f.gl.fitted[i];
        for (std::size_t v = 0; light.casts && v < light.views.size(); ++v) {
            const shared::ViewBlock& view = block.views[std::size_t(f.first_view[i]) + v];
            const std::string name = view_name(light.chooser.choice, v, light.views.size());
            const std::string whose = fmt::format("{}{}light {}", name, name.empty() ? "" : " of ", i);
            check(view.uvd_from_relative, "matrix into the map of " + whose, int(i), int(v));
            check_numbers(health, std::span(&view.curve.x, 12), 4, "block of " + whose, int(i), int(v));
        }
    }
    for (const Object& object : f.scene.objects) {
        glm::dmat4 world = object.world;
        world[3] -= glm::dvec4(f.origin, 0);
        check(glm::mat4(world), fmt::format("matrix of object {}", f.scene.nodes[std::size_t(object.node)].path));
    }
}

// The whole search --------------------------------------------------------------------------------------------------

void search_frame(const FrameState& f, const PagePasses& pages, NumericHealthPass::Targets& t, PassInfo& info) {
    t.health = nullptr;
    t.so_far = {};
    t.places.clear();
    t.pool.reset();
    check_matrices_and_blocks(f, t.so_far);
    const std::vector<Searched> images = searched_images(f);
    std::vector<std::vector<SearchedLayer>> layers;
    for (const Searched& s : images) {
        layers.push_back(s.of_pages ? std::vector<SearchedLayer>() : layers_of(f, s));
        for (const SearchedLayer& l : layers.back()) {
            t.places.push_back(l.place);
            t.so_far.numbers += std::uint64_t(l.size.x) * std::uint64_t(l.size.y);
        }
    }
    t.so_far.images = t.places.size();
    t.found.ensure("numeric health", GL_RGBA32UI, std::max(int(t.places.size()), 1), 1, int(kNumberFaults));
    FaultSearch search(f, t, info);
    int column = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const Searched& s = images[i];
        if (const auto& corrupt_image = gl::fault_injection().corrupt_image)
            corrupt_image(s.name, s.image->texture.id());
        if (s.of_pages) {
            PoolTiles pool = pool_tiles(f, pages, s);
            const glm::ivec2 size(s.image->width, s.image->height);
            // Tiles of a pool are its pages. Pages that no look-up reads may hold old numbers and are skipped on the
            // CPU.
            search.search(s, {.place = {}, .layer = 0, .size = size}, std::max(pool.page, 1));
            pool.tiles = {t.tiles.width, t.tiles.height};
            begin_read_back(pool.read_back, t.tiles);
            for (const SearchedPages& l : pool.layers) {
                t.so_far.images += l.pages.empty() ? 0 : 1;
                t.so_far.numbers += l.pages.size() * std::uint64_t(pool.page) * std::uint64_t(pool.page);
            }
            t.pool = std::move(pool);
        }
        for (const SearchedLayer& l : layers[i]) {
            const int tile =
                std::max(kMinTileTexels, (std::max(l.size.x, l.size.y) + kMaxTilesPerSide - 1) / kMaxTilesPerSide);
            const glm::ivec2 tiles = search.search(s, l, tile);
            const gl::Framebuffer found = gl::make_layers_framebuffer("numeric health", t.found);
            search.add_up(found, column++, tiles);
        }
    }
    begin_read_back(t.read_back, t.found);
    t.done.reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
    glFlush();
    info.reason += fmt::format("; {} images searched", t.so_far.images);
}

void put_found(NumberFinding place, NumberFault fault, const FaultRecord& r, NumericHealth& health) {
    if (r.count == 0) return;
    place.fault = fault;
    place.count = r.count;
    place.first = r.first_at();
    place.worst = r.worst_at();
    place.value = r.value();
    health.findings.push_back(std::move(place));
}

double amount_of(NumberFault fault, double value) {
    return fault == NumberFault::OutsideRange       ? std::max(-value, value - 1)
           : fault == NumberFault::NegativeVariance ? -value
                                                    : 0;
}

/// Adds the faults in the pages of one map to `health`.
void add_page_findings(const PoolTiles& pool, const SearchedPages& layer, std::span<const FaultRecord> tiles,
                       NumericHealth& health) {
    const std::size_t per_fault = tiles.size() / kNumberFaults;
    for (std::size_t k = 0; k < kNumberFaults; ++k) {
        NumberFinding sum = layer.place;
        sum.fault = NumberFault(k);
        const auto reads_before = [](glm::ivec2 a, glm::ivec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
        for (const PlacedPage& page : layer.pages) {
            const FaultRecord& r =
                tiles[k * per_fault + std::size_t(page.at.y) * std::size_t(pool.tiles.x) + std::size_t(page.at.x)];
            if (r.count == 0) continue;
            const glm::ivec2 from_pool = (page.page - page.at) * pool.page;
            const glm::ivec2 first = r.first_at() + from_pool, worst = r.worst_at() + from_pool;
            if (sum.count == 0 || amount_of(sum.fault, r.value()) > amount_of(sum.fault, sum.value)) {
                sum.worst = worst;
                sum.value = r.value();
            }
            if (sum.count == 0 || reads_before(first, sum.first)) sum.first = first;
            sum.count += r.count;
        }
        if (sum.count > 0) health.findings.push_back(std::move(sum));
    }
}

}  // namespace

std::shared_ptr<const NumericHealth> NumericHealthPass::read_result(bool wait) {
    Targets& t = targets_;
    if (t.health || !t.done) return t.health;
    const GLenum state = glClientWaitSync(t.done.get(), GL_SYNC_FLUSH_COMMANDS_BIT, wait ? GLuint64(60e9) : 0);
    if (state == GL_TIMEOUT_EXPIRED) return nullptr;
    NumericHealth health = std::move(t.so_far);
    const std::size_t columns = std::size_t(t.found.width);
    const std::vector<FaultRecord> records = records_of(t.read_back, columns * kNumberFaults);
    for (std::size_t i = 0; i < t.places.size(); ++i)
        for (std::size_t k = 0; k < kNumberFaults; ++k)
            put_found(t.places[i], NumberFault(k), records[k * columns + i], health);
    if (t.pool) {
        const std::size_t count = std::size_t(t.pool->tiles.x) * std::size_t(t.pool->tiles.y) * kNumberFaults;
        const std::vector<FaultRecord> tiles = records_of(t.pool->read_back, count);
        for (const SearchedPages& layer : t.pool->layers) add_page_findings(*t.pool, layer, tiles, health);
    }
    t.done.reset();
    t.read_back.reset();
    t.pool.reset();
    t.places.clear();
    t.health = std::make_shared<const NumericHealth>(std::move(health));
    return t.health;
}

void NumericHealthPass::declare(FrameState& f) {
    Pass pass{.name = "numeric health",
              .category = PassCategory::Tool,
              .reads = {Result::DrawnMaps, Result::ShadowMaps, Result::Moments, Result::Visibility, Result::CameraDepth,
                        Result::Blobs},
              .writes = {Result::Health},
              .idle_reason = "not needed: the numbers are not checked"};
    if (!f.request.outputs.health) {
        // Frames without a picture keep the findings, as a shown frame may still need them.
        if (f.request.outputs.colour) f.plan.release_later([this] { targets_ = {}; });
        return f.plan.add_pass(std::move(pass));
    }
    Targets& t = targets_;
    f.plan.place_result(Result::Health, {&t.found});
    pass.key =
        Key().add(f.geometry_key).add(f.camera_key).add(f.lights_key).add(f.gl.programs.source().generation()).value();
    pass.cached = &t.found.key;
    pass.run = [this, &f](PassInfo& info) { search_frame(f, pages_, targets_, info); };
    f.plan.add_pass(std::move(pass));
}

}  // namespace si
