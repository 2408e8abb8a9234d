// The ray-traced truth on the GPU.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Returns defines for shaders that read the truth (lib/truth.glsl).
std::vector<gl::Define> reference_defines(const FrameState& f);
/// Draws all trials of every pixel of a light into eight colour attachments, see CauseEvidence.
void draw_evidence(const FrameState& f, int light, bool reference_known, PassInfo& info);

/// Uploads the truth, compares each pixel with it, finds why some are wrong, and sums up.
class ReferencePasses : public FramePass {
public:
    struct Targets {
        gl::Target reference, more_reference;  ///< of the truth picture
        gl::Target classified;                 ///< RG32F, see judgement() in lib/truth.glsl
        gl::Target marks;                      ///< depths MARK_* of shared/classified.h
        std::uint64_t causes_key = 0;          ///< of `judged` with the causes in it
        gl::Target error_tiles;                ///< RGBA32F, see error_tiles.frag.glsl
        std::array<gl::Target, kEvidenceImages> evidence;
        std::shared_ptr<const LiveError> error;  ///< of the error tiles
    };

    void declare(FrameState& f) override;
    /// Returns the sums of the last run; null before the first.
    const std::shared_ptr<const LiveError>& error() const { return targets_.error; }

private:
    Targets targets_;
};

}  // namespace si
