// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Example: a bundle from an engine on Vulkan. Excerpt to copy from; it is compiled by no test.
// It writes one cascaded directional light, whose maps are the layers of one image.
//
// Traps of Vulkan:
// - Row order. Vulkan's clip y = -1 is the top row of an image. With the usual negative viewport height, or a
//   projection whose y is flipped, it is the bottom. "First row" below is about the clip space of the matrix that is
//   written: see first_row_of().
// - Depth range. Clip z goes from 0 to 1, unless VK_EXT_depth_clip_control says otherwise.
// - Depth of combined formats is copied alone: aspectMask is VK_IMAGE_ASPECT_DEPTH_BIT, and D24 comes in the low 24
//   bits of four bytes.
// - The image needs VK_IMAGE_USAGE_TRANSFER_SRC_BIT, and its pass needs VK_ATTACHMENT_STORE_OP_STORE.
// - Copying several layers at once packs them one after another. Each layer is an image of the bundle.
#include <vulkan/vulkan.h>

#include <utility>
#include <vector>

#define SHADOW_BUNDLE_IMPLEMENTATION
#include "shadow_bundle.h"

// Facts that the engine has of its shadow map when the key is pressed, after the frame was submitted.
struct ShadowMap {
    VkImage image;
    VkFormat format;       // D16_UNORM, X8_D24_UNORM_PACK32, D24_UNORM_S8_UINT, D32_SFLOAT
    VkImageLayout layout;  // after the frame, such as SHADER_READ_ONLY_OPTIMAL
    uint32_t size, layers;
    bool is_reversed;                             // VK_COMPARE_OP_GREATER while casters are drawn
    bool viewport_flipped;                        // VkViewport::height is below 0 while casters are drawn
    float bias_constant, bias_slope, bias_clamp;  // vkCmdSetDepthBias
    VkCullModeFlags cull;
    VkFrontFace front;
    bool depth_clamp;
    std::vector<float> clip_from_world;  // 16 numbers a layer, by columns, as glm and GLSL have them
    std::vector<float> intervals;        // two camera depths a layer, metres
};

// Helpers that every engine has.
VkCommandBuffer begin_commands();
void submit_and_wait(VkCommandBuffer commands);
VkBuffer make_host_buffer(VkDeviceSize bytes, const void** mapped);  // TRANSFER_DST, host visible and coherent

static size_t texel_bytes(VkFormat format) {
    return format == VK_FORMAT_D16_UNORM ? 2 : 4;
}

// The first row in memory is row 0 of the image, its top. The bundle asks which clip y of the written matrix it shows:
// "bottom" is clip y = -1. Vulkan's viewport takes clip y = -1 to row 0, so that is "bottom" in the bundle's words. A
// viewport of negative height takes clip y = +1 to row 0, and that is "top".
static sb_first_row first_row_of(const ShadowMap& map) {
    return map.viewport_flipped ? SB_FIRST_ROW_TOP : SB_FIRST_ROW_BOTTOM;
}

// Winding in the bundle is that of clip space with y up, as in OpenGL. Vulkan's is that of the framebuffer with y down,
// so that it turns unless the viewport is flipped.
static sb_front front_of(const ShadowMap& map) {
    const bool is_ccw = (map.front == VK_FRONT_FACE_COUNTER_CLOCKWISE) == map.viewport_flipped;
    return is_ccw ? SB_FRONT_CCW : SB_FRONT_CW;
}

static const char* read_layers(const ShadowMap& map) {
    const void* mapped = nullptr;
    const VkDeviceSize layer_bytes = VkDeviceSize(map.size) * map.size * texel_bytes(map.format);
    const VkBuffer buffer = make_host_buffer(layer_bytes * map.layers, &mapped);
    const VkCommandBuffer commands = begin_commands();

    VkImageMemoryBarrier barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    barrier.oldLayout = map.layout;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = map.image;
    // Barriers of combined formats name both aspects.
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, map.layers};
    if (map.format == VK_FORMAT_D24_UNORM_S8_UINT) barrier.subresourceRange.aspectMask |= VK_IMAGE_ASPECT_STENCIL_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                         nullptr, 0, nullptr, 1, &barrier);
    VkBufferImageCopy copy = {};
    copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, map.layers};
    copy.imageExtent = {map.size, map.size, 1};
    vkCmdCopyImageToBuffer(commands, map.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    std::swap(barrier.oldLayout, barrier.newLayout);
    std::swap(barrier.srcAccessMask, barrier.dstAccessMask);
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &barrier);
    submit_and_wait(commands);
    return static_cast<const char*>(mapped);
}

// Call it after sb_begin(), sb_mesh(), sb_instance() and sb_camera(), and before sb_end().
void write_sun(shadow_bundle* sb, const ShadowMap& map, const float direction[3]) {
    const int light = sb_light(sb, "sun", SB_DIRECTIONAL);
    sb_light_direction(sb, light, direction[0], direction[1], direction[2]);
    const char* const texels = read_layers(map);
    const size_t layer_bytes = size_t(map.size) * map.size * texel_bytes(map.format);
    for (uint32_t layer = 0; layer < map.layers; ++layer) {
        sb_image_data image = {};
        image.texels = texels + layer * layer_bytes;
        image.type = map.format == VK_FORMAT_D16_UNORM ? SB_U16 : map.format == VK_FORMAT_D32_SFLOAT ? SB_F32 : SB_U24;
        image.width = image.height = int(map.size);
        image.first_row = first_row_of(map);
        const int number = sb_map(sb, light, sb_image(sb, &image), sb_columns_f(&map.clip_from_world[16 * layer]),
                                  SB_RANGE_0_TO_1, map.is_reversed);
        // Vulkan's constant factor has the meaning of OpenGL's units, its slope factor that of OpenGL's factor.
        sb_map_offset(sb, number, map.bias_slope, map.bias_constant, map.bias_clamp);
        sb_map_cull(sb, number,
                    map.cull == VK_CULL_MODE_BACK_BIT    ? SB_CULL_BACK
                    : map.cull == VK_CULL_MODE_FRONT_BIT ? SB_CULL_FRONT
                                                         : SB_CULL_NONE,
                    front_of(map));
        sb_map_depth_clamp(sb, number, map.depth_clamp);
        sb_map_interval(sb, number, map.intervals[2 * layer], map.intervals[2 * layer + 1]);
    }
    // State what the look-up shader does, term by term. What is not known is left out, not set to 0.
    sb_lookup_bias(sb, light, SB_BIAS_CONSTANT, 0.0005, SB_UNIT_DEPTH);
    sb_lookup_compare(sb, light, map.is_reversed ? SB_GREATER_EQUAL : SB_LESS_EQUAL);
}
