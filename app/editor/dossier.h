// The truth of the probed pixel, for the editor: the hierarchy of rays is built in the background, a few rays then
// answer.
#pragma once

#include <memory>
#include <vector>

#include "app/base/job.h"
#include "renderer/inspect/dossier.h"
#include "renderer/reference/ray_scenes.h"
#include "ui/panels/probed.h"

namespace si {

class EditorDiagnosis {
public:
    /// @param probe null: none. `fresh`: it is another one than at the last call. Returns whether dossiers came or
    /// went.
    /// @throws Error when the hierarchy cannot be built
    bool update(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings, const DriverInfo& driver);
    std::span<const PixelDiagnosis> diagnoses() const { return diagnoses_; }
    /// Draws the probed pixel's test as cross-sections, one a light, after update() and by what is known by then: once
    /// while they are shown. Returns whether they are new.
    bool update_sections(const Probe* probe, const Settings& settings, bool shown);
    const Sections& sections() const { return sections_; }
    /// The hierarchy is being built; it is worth asking again when ready() says so.
    bool tracing() const { return building_.wanted(); }
    bool ready() const { return building_.ended(); }
    void wait() const { building_.wait(); }

private:
    using Casters = std::shared_ptr<const ReferenceScene>;

    bool update_reference(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings,
                          const DriverInfo& driver);

    std::vector<PixelDiagnosis> diagnoses_;
    Sections sections_;  ///< null: of what is known now, none were drawn
    Casters casters_;
    std::uint64_t building_key_ = 0;
    Job<Casters> building_;
};

}  // namespace si
