// Limits on the work that is queued in llvmpipe, Mesa's CPU rasteriser, and on the images that finished work retains.
#pragma once

namespace si::gl {

/// Limits the draws that a CPU rasteriser has queued: every eighth call waits until the calling thread's draws are
/// done. Call after each of many pictures, such as a layer of a shadow map. llvmpipe (Mesa 22.3) queues up to 64
/// pictures, each in a slot that retains the picture's images until the slot is used again. Once 64 slots exist,
/// llvmpipe uses only the first, and the images in the other slots stay in memory for good.
void limit_pending_draws();

/// Marks the calling thread as one that draws in the background, while another thread, such as a window's, must not
/// wait long. throttle_background_drawing() has an effect only on threads that are marked.
/// @param on false: ends the throttling
void set_background_drawing(bool on = true);

/// Waits until all that the calling thread drew before its previous call of this function is finished. Acts only on
/// threads that set_background_drawing() marked. Call after each pass, so that other threads need not wait long.
/// llvmpipe (Mesa's CPU rasteriser) keeps the pictures of all contexts in one queue of four, and a full queue blocks
/// every thread.
void throttle_background_drawing();

/// Makes llvmpipe (Mesa's CPU rasteriser) release images that finished pictures retain (see limit_pending_draws()), by
/// drawing tiny pictures until every slot of its queue is used again. Takes some ten milliseconds: call while idle.
/// Other drivers need no such call.
/// @return false when the machine was so busy that some slots may not have been reached
bool release_finished_images();

}  // namespace si::gl
