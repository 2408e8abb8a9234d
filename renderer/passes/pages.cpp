// Passes of virtual shadow maps: finding the pages that look-ups may read, and drawing those that are not cached.
#include "renderer/passes/pages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/caster_findings.h"
#include "renderer/passes/casters.h"
#include "renderer/projection/projection.h"
#include "renderer/scene/clusters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/settings/paging.h"
#include "renderer/view/cascades/clip_levels.h"
#include "shaders/shared/pages.h"

namespace si {
namespace {

/// Returns true when two rectangles overlap: metres on a light's plane, or texels of a map.
bool overlap(const Bounds2& a, const Bounds2& b) {
    return a.lo.x <= b.hi.x && a.lo.y <= b.hi.y && a.hi.x >= b.lo.x && a.hi.y >= b.lo.y;
}

using Casters = PagedCasters;

/// Rectangles of all casters across a light.
struct Across {
    std::vector<Bounds2> whole;
    std::vector<std::vector<Bounds2>> parts;
    Across() = default;
    /// @param projected_rect function from the corners of a box to its rectangle
    template <typename RectOf>
    Across(const Casters& casters, RectOf projected_rect)
        : whole(casters.corners.size()), parts(casters.corners.size()) {
        for (std::size_t i = 0; i < whole.size(); ++i) {
            if (!casters.content[i]) continue;
            whole[i] = projected_rect(casters.corners[i]);
            for (const Box& part : casters.parts[i]) parts[i].push_back(projected_rect(part));
        }
    }
    InstanceParts seen(std::size_t i, const Bounds2& by, std::size_t indices, std::vector<IndexRange>& out) const {
        if (!overlap(whole[i], by)) return InstanceParts::Nothing;
        if (parts[i].empty()) return InstanceParts::Whole;
        out.clear();
        for (std::size_t k = 0; k < parts[i].size(); ++k) {
            if (!overlap(parts[i][k], by)) continue;
            append_index_range(out, {k * kRunIndices, GLsizei(std::min(kRunIndices, indices - k * kRunIndices))});
        }
        return InstanceParts::Parts;
    }
};

/// Finds boxes and content keys of all casters. Keys depend on content alone, so that cached pages outlast changes
/// elsewhere.
void update_paged_casters(const FrameState& f, Casters& casters) {
    const CasterContent& content = caster_content(f);
    if (casters.key == content.key) return;
    const Scene& scene = f.scene;
    const auto& order = f.gl.scene->instance_objects();
    casters.content = content.of;
    casters.corners.assign(order.size(), {});
    casters.indices.assign(order.size(), 0);
    casters.parts.assign(order.size(), {});
    for (const Batch& batch : f.gl.scene->batches()) {
        if (!is_drawn_into_maps(f, batch)) continue;
        const std::vector<Bounds> parts =
            index_run_boxes(scene.meshes[std::size_t(scene.objects[order[batch.first_instance]].mesh)]);
        for (GLuint i = batch.first_instance; i < batch.first_instance + GLuint(batch.instances); ++i) {
            const Object& object = scene.objects[order[i]];
            const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
            casters.corners[i] = mesh.bounds.corners(object.world);
            casters.indices[i] = mesh.indices.size();
            for (const Bounds& part : parts) casters.parts[i].push_back(part.corners(object.world));
        }
    }
    casters.key = content.key;
}

/// Layer of the virtual maps, for drawing its pages.
class PagedLayer {
public:
    PagedLayer(const FrameState& f, std::size_t light, std::size_t view, const Casters& casters, const Across& across)
        : light_(f.gl.fitted[light]),
          view_(light_.views[view]),
          level_(light_.levels.empty() ? nullptr : &light_.levels[view]),
          casters_(casters),
          page_(page_texels(f.settings)),
          resolution_(f.map_size.longest()) {
        grid.side = (resolution_ + page_ - 1) / page_;
        if (level_) {
            grid.corner = level_->corner;
            if (view + 1 < light_.levels.size()) grid.coarser = f.first_view[light] + int(view) + 1;
            across_ = across;
        } else {
            find_in_map();
        }
        identity_ = f.with_settings({}, ReadBy::Maps);
        identity_.add(f.gl.programs.source().generation()).add(light_.map_origin).add(page_);
        identity_.add(f.request.forced.value());
        const DepthConvention& convention = view_.curve.convention;
        identity_.add(view_.clamps_near).add(convention.zero_to_one).add(convention.reversed).add(bool(level_));
        if (level_)
            identity_.add(view_.axes[0])
                .add(view_.axes[2])
                .add(level_->exponent)
                .add(level_->eye_m)
                .add(view_.curve.near)
                .add(view_.curve.far);
        else
            identity_.add(view_.clip_from_relative(light_.map_origin)).add(resolution_);
    }

    /// Returns the casters' rectangles on the plane of a directional light.
    static Across across_light(const Casters& casters, const glm::dmat3& axes) {
        return Across(casters, [&](const Box& corners) {
            Bounds2 rect;
            for (const glm::dvec3& p : corners) rect.add(glm::dvec2(glm::dot(axes[0], p), glm::dot(axes[1], p)));
            return rect;
        });
    }

    PageGrid grid;

    std::uint64_t key_of(glm::ivec2 page) const {
        Key key = identity_;
        key.add(grid.corner.x + page.x).add(grid.corner.y + page.y);
        const Bounds2 rect = projected_rect(page);
        for (std::size_t i = 0; i < across_.whole.size(); ++i)
            if (casters_.content[i] && overlap(across_.whole[i], rect)) key.add(casters_.content[i]);
        return key.value();
    }

    /// Returns the place of a page in the block of pages, in texels.
    glm::ivec2 place_in_block(const PlacedPage& page) const {
        const glm::i64vec2 at = grid.corner + glm::i64vec2(page.page), wide(kBlockPages);
        return glm::ivec2((at % wide + wide) % wide) * page_;
    }

    /// Draws a page into the bound framebuffer, a block of pages. Its place follows from the page's number, as
    /// rasterisation must not depend on the page's place in the pool.
    void draw(FrameState& f, const PlacedPage& page, GLuint framebuffer, bool unfiltered, PassInfo& info) const {
        glm::ivec2 in_view = page.page;
        const LightView view =
            level_ ? block_view(view_, *level_, page_, grid.corner + glm::i64vec2(page.page), in_view) : view_;
        const int across = level_ ? kBlockPages * page_ : resolution_;
        const glm::ivec2 first = place_in_block(page), viewport = first - in_view * page_;
        glScissor(first.x, first.y, page_, page_);
        glViewport(viewport.x, viewport.y, across, across);
        clear_casters(f, framebuffer, view_.curve.convention);
        const Bounds2 rect = projected_rect(page.page);
        draw_casters(
            f,
            {view.clip_from_relative(light_.map_origin), view_.curve, light_.map_origin, unfiltered, view_.clamps_near,
             across},
            [&](std::size_t i, std::vector<IndexRange>& parts) {
                return across_.seen(i, rect, casters_.indices[i], parts);
            },
            info);
    }

    /// Returns the largest texel size of the view, metres.
    double texel_m() const { return view_.texel_size_range(resolution_).longest; }
    /// Returns the side of the square that contains these pages, metres; for other views that of the whole map.
    double width_m(glm::ivec2 lo, glm::ivec2 hi) const {
        if (!level_) return texel_m() * resolution_;
        const glm::ivec2 pages = hi - lo + 1;
        return std::max(pages.x, pages.y) * page_ * texel_m();
    }
    const ClipLevel* level() const { return level_; }

private:
    Bounds2 projected_rect(glm::ivec2 page) const {
        const double texel = level_ ? level_->texel_m() : 1;
        const glm::dvec2 lo = glm::dvec2(grid.corner + glm::i64vec2(page)) * (page_ * texel);
        return {lo - texel, lo + (page_ + 1) * texel};
    }

    void find_in_map() {
        const glm::dmat4 uvd_from_relative =
            uvd_from_clip(view_.curve.convention) * view_.clip_from_relative(light_.map_origin);
        constexpr double kFar = std::numeric_limits<double>::infinity();
        across_ = Across(casters_, [&](const Box& corners) {
            Bounds2 rect;
            for (const glm::dvec3& p : corners) {
                const glm::dvec4 h = uvd_from_relative * glm::dvec4(p - light_.map_origin, 1);
                // A corner beside or behind the light may project anywhere.
                if (!(h.w > 1e-6 * (view_.warped() ? 1 : view_.curve.near)))
                    return Bounds2{glm::dvec2(-kFar), glm::dvec2(kFar)};
                rect.add(glm::dvec2(h) / h.w * double(resolution_));
            }
            return rect;
        });
    }

    const FittedLight& light_;
    const LightView& view_;
    const ClipLevel* level_;
    const Casters& casters_;
    int page_, resolution_;
    Across across_;
    Key identity_;
};

/// Returns all layers of the virtual maps, in order.
std::vector<PagedLayer> paged_layers(const FrameState& f, const Casters& casters) {
    std::vector<PagedLayer> out;
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        if (!light.casts) continue;
        Across across;
        if (!light.levels.empty()) across = PagedLayer::across_light(casters, light.views[0].axes);
        for (std::size_t v = 0; v < light.views.size(); ++v) out.emplace_back(f, i, v, casters, across);
    }
    return out;
}

int pages_per_side(const FrameState& f) {
    const int page = page_texels(f.settings);
    return (f.map_size.longest() + page - 1) / page;
}

/// Returns the capacity of the page pool, limited by the setting, the driver and the memory budget.
int most_pages(const FrameState& f) {
    const double page = page_texels(f.settings), bytes = drawn_texel_bytes(f.settings.map.format);
    const double side = std::floor(f.driver.max_texture_size / page);
    const double most = std::min(side * side, std::floor(kMapBudgetBytes / (page * page * bytes)));
    return int(std::clamp(double(f.settings.map.page_pool), 1.0, std::max(most, 1.0)));
}

/// Marks the pages that blended surfaces read. The images of visible surfaces do not contain them, as they are drawn on
/// top.
void mark_blended(FrameState& f, PagePasses::Targets& t, PassInfo& info) {
    const auto& batches = f.gl.scene->seen_batches();
    if (std::none_of(batches.begin(), batches.end(), [](const Batch& b) { return b.blend; })) return;
    CameraDrawing(f).draw("passes/camera_depth.frag.glsl", {}, info);
    const CameraDrawing pass(f, "nothing", GL_R8, t.nothing);
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    for (const Batch& b : batches) {
        if (!b.blend) continue;
        glUseProgram(f.batch_program("passes/scene.vert.glsl", "passes/pages_wanted.frag.glsl",
                                     {{"MARK_PAGES", "1"}, {"FROM_SCENE", "1"}}, b, false));
        f.bind_textures(b);
        f.draw_batch(b, info);
    }
    glDepthMask(GL_TRUE);
}

Pass wanted_pass(FrameState& f, PagePasses::Targets& t) {
    Pass pass{.name = "pages requested",
              .category = PassCategory::Maps,
              .reads = {Result::VisibleSurfaces},
              .writes = {Result::PagesWanted},
              .key = f.lighting_key().value(),
              .cached = &t.wanted.key,
              .idle_reason = "no pass samples a shadow map"};
    pass.run = [&f, &t](PassInfo& info) {
        const int side = pages_per_side(f);
        t.wanted.ensure("pages wanted", GL_R8UI, side, side, f.view_count);
        t.nothing.ensure("nothing", GL_R8, f.request.width, f.request.height);
        const std::uint8_t none = 0;
        glClearTexImage(t.wanted.texture.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, &none);
        const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("pages wanted", t.nothing);
        glBindImageTexture(shared::IMAGE_PAGES_WANTED, t.wanted.texture.id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R8UI);
        f.use_fullscreen("passes/pages_wanted.frag.glsl", {{"MARK_PAGES", "1"}});
        FrameState::draw_fullscreen(info);
        mark_blended(f, t, info);
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    };
    return pass;
}

/// Draws pages into the pool by way of a block of pages.
void draw_into_pool(FrameState& f, PagePasses::Targets& t, const std::vector<PagedLayer>& layers, gl::Target& pool,
                    const std::vector<const PlacedPage*>& pages, bool unfiltered, PassInfo& info) {
    const bool colour = is_colour(f.settings.map.format);
    const int width = t.cache.side() * t.page, block = kBlockPages * t.page;
    pool.ensure(unfiltered ? "pool of unfiltered pages" : "pool of pages", f.map_format(), width, width);
    t.block.ensure("block of pages", f.map_format(), block, block);
    if (colour)
        t.depth.ensure("depth of the block of colour pages", GL_DEPTH_COMPONENT32F, block, block);
    else
        t.depth = {};
    const gl::Framebuffer framebuffer = colour ? gl::make_framebuffer("block of pages", &t.block, &t.depth)
                                               : gl::make_framebuffer("block of pages", nullptr, &t.block);
    struct Copy {
        glm::ivec2 from, to;
    };
    std::vector<Copy> drawn;
    // Flushes before and after, as zink of Mesa 22.3 sometimes copies a page before it is drawn, or mixes it with the
    // next one.
    const auto copy = [&] {
        glFlush();
        for (const Copy& c : drawn)
            glCopyImageSubData(t.block.texture.id(), GL_TEXTURE_2D, 0, c.from.x, c.from.y, 0, pool.texture.id(),
                               GL_TEXTURE_2D, 0, c.to.x, c.to.y, 0, t.page, t.page, 1);
        glFlush();
        drawn.clear();
    };
    for (const PlacedPage* page : pages) {
        const PagedLayer& layer = layers[std::size_t(page->layer)];
        const glm::ivec2 at = layer.place_in_block(*page);
        if (std::any_of(drawn.begin(), drawn.end(), [&](const Copy& c) { return c.from == at; })) copy();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
        glEnable(GL_SCISSOR_TEST);
        layer.draw(f, *page, framebuffer.id(), unfiltered, info);
        glDisable(GL_SCISSOR_TEST);
        drawn.push_back({at, page->at * t.page});
    }
    copy();
}

/// Computes the statistics of the frame's pages. The unpaged map for comparison has the texel size of the light's
/// finest page, over the square around its pages.
PageFacts facts_of(const FrameState& f, const PagePasses::Targets& t, const std::vector<PagedLayer>& layers) {
    const PageChoice& choice = t.choice;
    PageFacts facts{.page_texels = t.page,
                    .wanted = choice.wanted,
                    .drawn = int(choice.drawn.size()),
                    .coarser = choice.coarser,
                    .evicted = choice.evicted,
                    .held = t.cache.held(),
                    .pool = t.cache.room()};
    facts.kept = int(choice.read.size()) - facts.drawn;
    facts.smallest_texel_m = std::numeric_limits<double>::infinity();
    int layer = 0, most = -1;
    for (const FittedLight& light : f.gl.fitted) {
        if (!light.casts) continue;
        const int first = layer;
        layer += int(light.views.size());
        std::vector<int> by_level(choice.wanted_by_layer.begin() + first, choice.wanted_by_layer.begin() + layer);
        int all = 0;
        for (const int count : by_level) all += count;
        double finest = std::numeric_limits<double>::infinity(), width = 0;
        for (int l = first; l < layer; ++l) {
            glm::ivec2 lo(std::numeric_limits<int>::max()), hi(-1);
            for (const PlacedPage& p : choice.read)
                if (p.layer == l) {
                    lo = glm::min(lo, p.page);
                    hi = glm::max(hi, p.page);
                }
            if (hi.x < 0) continue;
            const PagedLayer& of = layers[std::size_t(l)];
            finest = std::min(finest, of.texel_m());
            width = std::max(width, of.width_m(lo, hi));
            if (!of.level()) facts.fixed_map_texels += double(f.map_size.longest()) * f.map_size.longest();
        }
        facts.smallest_texel_m = std::min(facts.smallest_texel_m, finest);
        if (!light.levels.empty() && width > 0) facts.fixed_map_texels += width / finest * (width / finest);
        if (all > most) {
            most = all;
            facts.by_level = std::move(by_level);
        }
    }
    if (!std::isfinite(facts.smallest_texel_m)) facts.smallest_texel_m = 0;
    return facts;
}

void upload_table(const FrameState& f, PagePasses::Targets& t) {
    const int side = t.choice.table_side;
    t.table.ensure("page table", GL_RGBA16UI, side, side, f.view_count);
    static_assert(std::endian::native == std::endian::little, "two bytes of an entry are a texel's channel");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(t.table.texture.id(), 0, 0, 0, 0, side, side, f.view_count, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT,
                        t.choice.table.data());
}

void choose_and_draw(FrameState& f, PagePasses::Targets& t, PassInfo& info) {
    const int side = pages_per_side(f), page = page_texels(f.settings);
    if (f.request.force || t.page != page || t.pool.format != f.map_format()) t.cache.clear();
    t.page = page;
    const std::size_t count = std::size_t(side) * std::size_t(side) * std::size_t(f.view_count);
    const auto wanted = gl::read_texture<std::uint8_t>(t.wanted.texture.id(), count, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
    update_paged_casters(f, t.casters);
    const std::vector<PagedLayer> layers = paged_layers(f, t.casters);
    std::vector<PageGrid> grids;
    for (const PagedLayer& layer : layers) grids.push_back(layer.grid);
    t.choice = t.cache.choose_pages(grids, wanted, side, most_pages(f),
                                    [&](int layer, glm::ivec2 at) { return layers[std::size_t(layer)].key_of(at); });
    std::vector<const PlacedPage*> missing;
    for (const std::size_t i : t.choice.drawn) missing.push_back(&t.choice.read[i]);
    draw_into_pool(f, t, layers, t.pool, missing, false, info);
    upload_table(f, t);
    t.facts = facts_of(f, t, layers);
    info.reason += "; " + page_facts_text(t.facts);
}

Pass pages_pass(FrameState& f, PagePasses::Targets& t) {
    Pass pass{.name = "pages of shadow maps",
              .category = PassCategory::Maps,
              .reads = {Result::PagesWanted},
              .writes = {Result::Pages, Result::DrawnMaps, Result::ShadowMaps},
              .cached = &t.pool.key,
              .idle_reason = "no pass samples a shadow map"};
    Key key = f.with_settings(f.with_settings(f.geometry_key, ReadBy::Maps), ReadBy::Pages);
    key.add(f.gl.fit_key).add(f.view_count).add(f.gl.programs.source().generation());
    pass.key = key.add(f.settings.caster.blend).add(f.request.forced.value()).value();
    pass.run = [&f, &t](PassInfo& info) {
        try {
            choose_and_draw(f, t, info);
        } catch (...) {
            t.cache.clear();  // places are taken that nothing was drawn into
            throw;
        }
    };
    return pass;
}

}  // namespace

void PagePasses::declare(FrameState& f) {
    if (!f.paged) {
        f.plan.release_later([this] { targets_ = {}; });
        return;
    }
    Targets& t = targets_;
    f.plan.place_result(Result::PagesWanted, {&t.wanted});
    f.plan.place_result(Result::DrawnMaps, {&t.pool, shared::UNIT_SHADOW_MAP, &f.gl.map_nearest});
    f.plan.place_result(Result::DrawnMaps, {&t.table, shared::UNIT_PAGE_TABLE});
    f.place_compared_maps(t.pool);
    f.plan.place_result(Result::ShadowMaps, {&t.table, shared::UNIT_PAGE_TABLE});
    f.plan.add_pass(wanted_pass(f, t));
    f.plan.add_pass(pages_pass(f, t));
}

void PagePasses::declare_unfiltered(FrameState& f, Pass pass) {
    Targets& t = targets_;
    const bool own = f.needs_unfiltered_map();
    f.plan.place_result(Result::UnfilteredMap,
                        {own ? &t.unfiltered : &t.pool, shared::UNIT_UNFILTERED_MAP, &f.gl.map_nearest});
    if (!own) {
        f.plan.release_later([&t] { t.unfiltered = {}; });
        return f.plan.skip_pass(std::move(pass),
                                "equal to the pages as drawn: no polygon offset, no mask with mip levels");
    }
    pass.key = Key().add("unfiltered").value();
    pass.cached = &t.unfiltered.key;
    pass.run = [&f, &t](PassInfo& info) {
        const int width = t.cache.side() * t.page;
        if (t.unfiltered.ensure("pool of unfiltered pages", f.map_format(), width, width) || f.request.force ||
            t.unfiltered_pages.size() != std::size_t(t.cache.room()))
            t.unfiltered_pages.assign(std::size_t(t.cache.room()), 0);
        const std::vector<PagedLayer> layers = paged_layers(f, t.casters);
        std::vector<const PlacedPage*> missing;
        for (const PlacedPage& page : t.choice.read) {
            if (t.unfiltered_pages[page.slot] == page.key) continue;
            t.unfiltered_pages[page.slot] = page.key;
            missing.push_back(&page);
        }
        draw_into_pool(f, t, layers, t.unfiltered, missing, true, info);
    };
    f.plan.add_pass(std::move(pass));
}

PageFacts PagePasses::page_facts(bool drawn) const {
    PageFacts facts = targets_.facts;
    if (!drawn) {
        facts.kept += facts.drawn;
        facts.drawn = facts.evicted = 0;
    }
    return facts;
}

std::vector<float> PagePasses::read_map_depths(const gl::Target& maps, const MapLayer& of, glm::ivec2 first,
                                               glm::ivec2 size) const {
    std::vector<float> out;
    if (of.paged) {
        out = read_depths(of.layer, first, size, float(of.curve.convention.far_depth()));
    } else if (const std::size_t texels = std::size_t(size.x) * std::size_t(size.y); texels > 0) {
        const GLsizei bytes = gl::read_back_size(texels * sizeof(float));
        out.resize(texels);
        gl::prepare_read_back();
        glGetTextureSubImage(maps.texture.id(), 0, first.x, first.y, of.layer, size.x, size.y, 1,
                             gl::single_channel_format(maps.format), GL_FLOAT, bytes, out.data());
    }
    if (of.holds_distances)
        for (float& d : out) d = float(of.curve.depth_at_fraction(double(d)));
    return out;
}

std::vector<float> PagePasses::read_depths(int layer, glm::ivec2 first, glm::ivec2 size, float empty_depth) const {
    const Targets& t = targets_;
    const GLenum format = gl::single_channel_format(t.pool.format);
    std::vector<float> out(std::size_t(size.x) * std::size_t(size.y), empty_depth);
    std::vector<float> depths(std::size_t(t.page) * std::size_t(t.page));
    gl::prepare_read_back();
    const glm::ivec2 last = first + size - 1;
    for (int y = first.y / t.page; size.y > 0 && y <= last.y / t.page; ++y)
        for (int x = first.x / t.page; size.x > 0 && x <= last.x / t.page; ++x) {
            const PageEntry& entry = t.choice.entry(layer, {x, y});
            if (entry.state == shared::PAGE_ABSENT) continue;
            glGetTextureSubImage(t.pool.texture.id(), 0, entry.at.x * t.page, entry.at.y * t.page, 0, t.page, t.page, 1,
                                 format, GL_FLOAT, GLsizei(depths.size() * sizeof(float)), depths.data());
            const glm::ivec2 page(x, y), from = glm::max(page * t.page, first);
            const glm::ivec2 to = glm::min((page + 1) * t.page - 1, last);
            for (glm::ivec2 at = from; at.y <= to.y; ++at.y)
                for (at.x = from.x; at.x <= to.x; ++at.x) {
                    const glm::ivec2 in = (glm::ivec2(entry.part) * t.page + at - page * t.page) >> int(entry.coarser);
                    out[std::size_t(at.y - first.y) * std::size_t(size.x) + std::size_t(at.x - first.x)] =
                        depths[std::size_t(in.y) * std::size_t(t.page) + std::size_t(in.x)];
                }
        }
    return out;
}

}  // namespace si
