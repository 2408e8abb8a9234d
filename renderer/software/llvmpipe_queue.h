// Limits on the work that is queued in llvmpipe, Mesa's CPU rasteriser, and on the images that finished work retains.
#pragma once

namespace si::gl {

/// Limits the draws that a CPU rasteriser has queued: every eighth call waits until the calling thread's draws are
/// done. Call after each of many pictures, such as a layer of a shadow map. llvmpipe (Mesa 22.3) queues up to 64
/// pictures, each in a slot that retains the images it used until the slot is needed again. Once it has 64 slots it
/// uses the first alone, and the images of the others stay in memory for good.
void limit_pending_draws();

/// Marks the calling thread as drawing in the background of another thread that must not wait long, such as a window's.
/// From then on throttle_background_drawing() waits on this thread. False ends the throttling.
void set_background_drawing(bool on = true);

/// Waits until the previous picture of a background thread is done; does nothing on other threads. Call after each
/// pass. llvmpipe draws the pictures of all contexts in one queue of four, and a full queue blocks every thread.
void throttle_background_drawing();

/// Makes llvmpipe release images that finished pictures retain (see limit_pending_draws()), by drawing tiny pictures
/// until every slot of its queue is used again. Takes some ten milliseconds: call while idle. Other drivers need no
/// such call.
/// @return false when the machine was so busy that some slots may not have been reached
bool release_finished_images();

}  // namespace si::gl
