#include "renderer/passes/number_check.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "renderer/frame/blocks.h"

namespace si {
namespace {

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

}  // namespace

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

}  // namespace si
