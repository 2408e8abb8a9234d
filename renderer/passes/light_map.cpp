// Pass that uploads baked light maps: an atlas with a layer for each light, and the chart of each triangle.
#include "renderer/passes/light_map.h"

#include <fmt/format.h>

#include "renderer/base/lengths_text.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/reference/light_map.h"

namespace si {
namespace {

/// Chart of the atlas in std430 layout, see sources/light_map.glsl.
struct ChartRow {
    glm::vec4 u, v, reach;
};

/// Uploads the charts of the atlas. The first 16 bytes of the object buffer are the offset from the frame's origin,
/// which LightMapPass::bind_buffers() fills in.
void upload_layout(LightMapPass::Targets& t, const LightMapLayout& layout) {
    std::vector<glm::uvec2> objects(2);
    for (const auto& part : layout.objects) objects.emplace_back(part.first, part.count);
    t.objects = gl::make_buffer("objects of the light map", objects);
    t.triangles = gl::make_buffer("charts of the light map's triangles", layout.chart_of);
    std::vector<ChartRow> charts;
    charts.reserve(layout.charts.size());
    for (const LightMapChart& c : layout.charts) {
        const double n = layout.texels_per_metre;
        // Look-ups are clamped to the centres of the chart's outermost texels.
        const glm::vec4 reach(c.rect.x + 0.5, c.rect.y + 0.5, c.rect.x + c.rect.z - 0.5, c.rect.y + c.rect.w - 0.5);
        charts.push_back({glm::vec4(glm::vec3(c.u * n), c.at.x), glm::vec4(glm::vec3(c.v * n), c.at.y), reach});
    }
    t.charts = gl::make_buffer("charts of the light map", charts);
}

std::string described(const LightMap& map) {
    const LightMapLayout& l = *map.layout;
    const std::string made = map.from_disk
                                 ? fmt::format("read from disk in {:.0f} ms", map.bake_ms)
                                 : fmt::format("baked before the frame by {} rays in {:.0f} ms", map.rays, map.bake_ms);
    return fmt::format("{}² texels of a byte, {} a metre, {} charts; {}", l.side, digits_text(l.texels_per_metre),
                       l.charts.size(), made);
}

}  // namespace

void LightMapPass::declare(FrameState& f) {
    std::vector<const LightMap*> maps;
    for (const LightMap* map : f.light_map_of_light)
        if (map) maps.push_back(map);
    if (maps.empty()) {
        f.plan.release_later([this] { targets_ = {}; });
        return;
    }
    Targets& t = targets_;
    if (!t.bilinear) {
        t.bilinear = gl::Sampler::create("light map");
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glSamplerParameteri(t.bilinear.id(), filter, GL_LINEAR);
        for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            glSamplerParameteri(t.bilinear.id(), side, GL_CLAMP_TO_EDGE);
    }
    f.plan.place_result(Result::LightMap, {&t.atlas, shared::UNIT_LIGHT_MAP, &t.bilinear});
    Key key;
    for (const LightMap* map : maps) key.add(map->version);
    f.plan.add_pass({.name = "light map",
                     .category = PassCategory::Maps,
                     .writes = {Result::LightMap},
                     .key = key.value(),
                     .cached = &t.atlas.key,
                     .run = [this, maps](PassInfo& info) { run(maps, info); },
                     .idle_reason = "no pass reads visibility"});
}

void LightMapPass::run(const std::vector<const LightMap*>& maps, PassInfo& info) {
    const LightMapLayout& layout = *maps[0]->layout;
    targets_.atlas.ensure("light map", GL_R8, layout.side, layout.side, int(maps.size()));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        glTextureSubImage3D(targets_.atlas.texture.id(), 0, 0, 0, GLint(i), layout.side, layout.side, 1, GL_RED,
                            GL_UNSIGNED_BYTE, maps[i]->texels.data());
        info.reason += fmt::format("; {}", described(*maps[i]));
    }
    upload_layout(targets_, layout);
}

void LightMapPass::bind_buffers(const FrameState& f) const {
    const Targets& t = targets_;
    glm::dvec3 centre(0);
    for (const LightMap* map : f.light_map_of_light)
        if (map) centre = map->layout->centre;
    const glm::vec4 from_origin(glm::vec3(f.origin - centre), 0);
    glNamedBufferSubData(t.objects.id(), 0, sizeof from_origin, &from_origin);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::STORAGE_LIGHT_MAP_OBJECTS, t.objects.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::STORAGE_LIGHT_MAP_TRIANGLES, t.triangles.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::STORAGE_LIGHT_MAP_CHARTS, t.charts.id());
}

}  // namespace si
