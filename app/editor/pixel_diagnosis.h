// Diagnosis of the probed pixel against its ray-traced reference. The ray hierarchy is built in the background; a few
// rays then answer.
#pragma once

#include <memory>
#include <vector>

#include "app/base/job.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/reference/ray_scenes.h"
#include "ui/panels/probe_panel.h"

namespace si {

/// Diagnoses of the probed pixel, one for each light: whether its shadow equals the ray-traced reference, why not, and
/// a fix. Also has the cross-sections of the pixel's shadow tests (cuts along the light ray).
class EditorPixelDiagnosis {
public:
    /// Updates the diagnoses of the probed pixel. Builds the ray-tracing hierarchy in the background if needed; a later
    /// call then traces the pixel. Returns true if the diagnoses have changed.
    /// @param probe the probed pixel; null: none @param fresh true: `probe` differs from that of the last call
    /// @throws Error if the hierarchy cannot be built
    bool update(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings, const DriverInfo& driver);
    std::span<const PixelDiagnosis> diagnoses() const { return diagnoses_; }
    /// Computes the cross-sections of the probed pixel's shadow tests (cuts along the light ray), once for each probe,
    /// while a panel shows them. Call after update(). Returns true if the cross-sections are new. @param shown true: a
    /// panel shows them
    bool update_sections(const Probe* probe, const Settings& settings, bool shown);
    const Sections& sections() const { return sections_; }
    /// Returns true while the ray-tracing hierarchy is being built. Once ready() returns true, the next update()
    /// computes the diagnoses.
    bool tracing() const { return building_.wanted(); }
    bool ready() const { return building_.ended(); }
    void wait() const { building_.wait(); }

private:
    using Casters = std::shared_ptr<const ReferenceScene>;

    std::vector<PixelDiagnosis> diagnoses_;
    Sections sections_;  ///< null: not computed for the present diagnoses
    Casters casters_;
    std::uint64_t building_key_ = 0;
    Job<Casters> building_;
};

}  // namespace si
