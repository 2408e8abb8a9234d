// Passes of a frame, and what they share with each other.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/frame/state.h"

namespace si {

/// Writes what rays found into a light's layer of a visibility texture of the frame's size.
void put_traced_visibility(const ReferencePicture& reference, const gl::Target& visibility, int light);
/// Defines for shaders that read the truth (lib/truth.glsl).
std::vector<gl::Define> reference_defines(const FrameState& f);
/// What a pass reads that evaluates the kernel.
std::vector<ResultRef> lookup_reads(const FrameState& f);

/// Says that shaders compare the depths of these.
void place_compared_maps(FrameState& f, const gl::Target& maps);

// One function per pass; each appends itself to the plan and says where its results will lie.
void add_light_depth_passes(FrameState& f);
/// Of virtual maps, in place of the former: which pages look-ups may read, and those drawn that are not kept.
void add_page_passes(FrameState& f);
void add_depth_blur_pass(FrameState& f);
/// Functions of the maps' depths, averaged, for kernels that read those.
void add_moments_pass(FrameState& f);
void add_camera_depth_pass(FrameState& f);
/// Draws the camera's depth and reads back its bounds, before the frame has a plan.
std::optional<DepthSpan> measure_seen_depths(FrameState& f, PassInfo& info);
void add_surface_ids_pass(FrameState& f);
void add_shadow_volume_passes(FrameState& f);
/// A soft disc below each caster, for lights whose source that is.
void add_blob_pass(FrameState& f);
/// Uploads what was baked, for lights whose source is a light map.
void add_light_map_pass(FrameState& f);
/// Binds the buffers by which shaders find a surface in it.
void bind_light_map(const FrameState& f);
void add_visibility_pass(FrameState& f);
/// One light's layer of the visibility as a plain texture.
Image visibility_image(const FrameState& f, int light);
/// Draws the maps again where what is compared is not what a caster's surface is.
void add_unfiltered_map_pass(FrameState& f);
/// The surface of every pixel, kept while the camera rests.
void add_seen_surfaces_pass(FrameState& f);
/// Binds what draws those of other pixels.
void bind_seen_surfaces(std::span<const gl::Target, kSeenImages> seen);
/// Uploads the truth, compares each pixel with it, finds why some are wrong, and sums up.
void add_reference_passes(FrameState& f);
std::shared_ptr<const LiveError> live_error(const FrameState& f);
/// All trials of every pixel of a light into eight colour attachments, see CauseEvidence.
void draw_evidence(const FrameState& f, int light, bool reference_known, PassInfo& info);
void add_true_shade_pass(FrameState& f);
void add_shade_pass(FrameState& f);
/// Holds where the shown light's map is looked up against double precision.
void add_precision_pass(FrameState& f);
std::shared_ptr<const Precision> found_precision(const FrameState& f);
void add_pane_passes(FrameState& f);
void add_map_coordinates_pass(FrameState& f);
/// Which texels of the shown map the kernels of all pixels fetch, exactly.
void add_texels_read_pass(FrameState& f);
void add_map_view_passes(FrameState& f);
/// Searches all that the frame made so far, maps and visibility, for what is no number.
void add_numeric_health_pass(FrameState& f);
/// Of one pane, over its picture so far. The caller names it and what it reads and writes.
Pass slabs_pass(FrameState& f, const FrameState::ShownPane& pane);

}  // namespace si
