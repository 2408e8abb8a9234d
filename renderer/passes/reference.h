// Passes that compare the picture with the ray-traced reference.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Returns the defines for shaders that compare with the ray-traced reference (lib/truth.glsl).
std::vector<gl::Define> reference_defines(const FrameState& f);
/// Returns the reason why a frame has no ray-traced reference, for reports on skipped passes: not needed, or not
/// traced.
std::string missing_reference_reason(const FrameState& f);
/// Repeats the shadow test of every pixel under varied conditions (no bias, no filter, ...) and draws the results into
/// eight colour attachments, see CauseEvidence. They show the causes of wrong pixels.
/// @param light light index
/// @param reference_known true: a reference of this light is uploaded
/// @param[out] info draw and triangle counts
void draw_evidence(const FrameState& f, int light, bool reference_known, PassInfo& info);

/// Passes that compare the picture with the ray-traced reference. They upload the reference, compare each pixel with
/// it, classify wrong pixels by cause, and compute error metrics.
class ReferencePasses : public FramePass {
public:
    /// Images that ReferencePasses draws and keeps between frames: the uploaded ray-traced reference, the comparison of
    /// the picture with it, causes of errors, and metrics.
    struct Targets {
        gl::Target reference, more_reference;  ///< uploaded values of the reference
        gl::Target classified;                 ///< RG32F, see classification() in lib/truth.glsl
        gl::Target marks;                      ///< depths MARK_* of wrong pixels, for early depth tests
        std::uint64_t causes_key = 0;          ///< cache key of `classified` with causes filled in
        gl::Target error_tiles;                ///< RGBA32F, see error_tiles.frag.glsl
        std::array<gl::Target, kEvidenceImages> evidence;
        std::shared_ptr<const LiveError> error;  ///< metrics from the error tiles
    };

    void declare(FrameState& f) override;
    /// Returns the shadow error metrics that the last run computed; null before the first run.
    const std::shared_ptr<const LiveError>& error() const { return targets_.error; }

private:
    Targets targets_;
};

}  // namespace si
