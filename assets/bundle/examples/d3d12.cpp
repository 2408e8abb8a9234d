// Shadow Inspector. No licence has been chosen yet; all rights are the owner's until then.
//
// Example: a bundle from an engine on Direct3D 12. Excerpt to copy from; it is compiled by no test.
//
// Traps of Direct3D:
// - Rows are padded to D3D12_TEXTURE_DATA_PITCH_ALIGNMENT (256 bytes): sb_image_data::row_bytes is the footprint's
//   RowPitch.
// - The first row in memory is the top of the map, clip y = +1.
// - Clip z goes from 0 to 1.
// - HLSL's mul(v, M) takes row vectors, mul(M, v) column vectors. XMMATRIX and XMFLOAT4X4 are for row vectors and are
//   stored by rows. Such numbers, in their order in memory, are the columns that the bundle wants: sb_columns_f(). A
//   matrix for column vectors that is stored by rows is read by sb_rows_f().
// - The depth plane of a typeless resource is copied as R32_FLOAT, R16_UNORM, or R24_UNORM_X8 with depth in the low 24
//   bits. Plane 0 is depth, plane 1 is stencil.
// - Engines with a left-handed world say so: sb_world(sb, SB_UP_Y, SB_LEFT_HANDED, 1, NULL). Positions, matrices and
//   directions stay as the engine has them.
// - Direct3D's front faces are clockwise by default, in an image whose y points down. Seen with y up, as the bundle has
//   it, FrontCounterClockwise = FALSE is clockwise, too: the picture is the same, only its rows are counted from above.
#include <d3d12.h>
#include <wrl/client.h>

#define SHADOW_BUNDLE_IMPLEMENTATION
#include "shadow_bundle.h"

using Microsoft::WRL::ComPtr;

// Helpers that every engine has.
ID3D12GraphicsCommandList* begin_commands();
void submit_and_wait(ID3D12GraphicsCommandList* commands);
ComPtr<ID3D12Resource> make_readback_buffer(UINT64 bytes);

struct ShadowMap {
    ID3D12Resource* texture;
    D3D12_RESOURCE_STATES state;  // after the frame
    DXGI_FORMAT depth_format;     // of the depth view: D16_UNORM, D24_UNORM_S8_UINT, D32_FLOAT
    bool is_reversed;
    D3D12_RASTERIZER_DESC raster;  // of the caster pass
    float clip_from_world[16];     // XMFLOAT4X4 of view * projection, for row vectors
};

int write_map(shadow_bundle* sb, ID3D12Device* device, int light, const ShadowMap& map) {
    const D3D12_RESOURCE_DESC description = map.texture->GetDesc();
    D3D12_PLACED_SUBRESOURCE_FOOTPRINT footprint = {};
    UINT64 bytes = 0;
    // Subresource 0 is the depth plane of the first mip level and slice.
    device->GetCopyableFootprints(&description, 0, 1, 0, &footprint, nullptr, nullptr, &bytes);
    const ComPtr<ID3D12Resource> buffer = make_readback_buffer(bytes);

    ID3D12GraphicsCommandList* const commands = begin_commands();
    D3D12_RESOURCE_BARRIER barrier = {};
    barrier.Transition.pResource = map.texture;
    barrier.Transition.Subresource = D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES;
    barrier.Transition.StateBefore = map.state;
    barrier.Transition.StateAfter = D3D12_RESOURCE_STATE_COPY_SOURCE;
    commands->ResourceBarrier(1, &barrier);
    D3D12_TEXTURE_COPY_LOCATION from = {map.texture, D3D12_TEXTURE_COPY_TYPE_SUBRESOURCE_INDEX, {}};
    from.SubresourceIndex = 0;
    D3D12_TEXTURE_COPY_LOCATION to = {buffer.Get(), D3D12_TEXTURE_COPY_TYPE_PLACED_FOOTPRINT, {}};
    to.PlacedFootprint = footprint;
    commands->CopyTextureRegion(&to, 0, 0, 0, &from, nullptr);
    barrier.Transition.StateBefore = D3D12_RESOURCE_STATE_COPY_SOURCE;
    barrier.Transition.StateAfter = map.state;
    commands->ResourceBarrier(1, &barrier);
    submit_and_wait(commands);

    void* texels = nullptr;
    buffer->Map(0, nullptr, &texels);
    sb_image_data image = {};
    image.texels = static_cast<const char*>(texels) + footprint.Offset;
    image.type = map.depth_format == DXGI_FORMAT_D16_UNORM   ? SB_U16
                 : map.depth_format == DXGI_FORMAT_D32_FLOAT ? SB_F32
                                                             : SB_U24;
    image.width = int(footprint.Footprint.Width);
    image.height = int(footprint.Footprint.Height);
    image.row_bytes = footprint.Footprint.RowPitch;
    image.first_row = SB_FIRST_ROW_TOP;
    const int number =
        sb_map(sb, light, sb_image(sb, &image), sb_columns_f(map.clip_from_world), SB_RANGE_0_TO_1, map.is_reversed);
    buffer->Unmap(0, nullptr);

    // DepthBias has the meaning of OpenGL's units, SlopeScaledDepthBias that of OpenGL's factor. For a D32 map the unit
    // depends on the largest depth of the triangle, in both.
    sb_map_offset(sb, number, map.raster.SlopeScaledDepthBias, map.raster.DepthBias, map.raster.DepthBiasClamp);
    sb_map_cull(sb, number,
                map.raster.CullMode == D3D12_CULL_MODE_BACK    ? SB_CULL_BACK
                : map.raster.CullMode == D3D12_CULL_MODE_FRONT ? SB_CULL_FRONT
                                                               : SB_CULL_NONE,
                map.raster.FrontCounterClockwise ? SB_FRONT_CCW : SB_FRONT_CW);
    // "Depth clip off" is the name for depth clamp.
    sb_map_depth_clamp(sb, number, !map.raster.DepthClipEnable);
    return number;
}
