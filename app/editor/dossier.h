// The truth of the probed pixel, for the editor: the hierarchy of rays is built in the background, a few rays then
// answer.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "renderer/inspect/dossier.h"
#include "renderer/reference/truth_scene.h"

namespace si {

class EditorDossier {
public:
    EditorDossier() = default;
    ~EditorDossier();
    EditorDossier(const EditorDossier&) = delete;
    EditorDossier& operator=(const EditorDossier&) = delete;

    /// @param probe null: none. `fresh`: it is another one than at the last call. Returns whether dossiers came or
    /// went.
    /// @throws Error when the hierarchy cannot be built
    bool update(const Probe* probe, bool fresh, const Scene& scene, const Settings& settings, const DriverInfo& driver);
    std::span<const Dossier> dossiers() const { return dossiers_; }
    /// The hierarchy is being built; it is worth asking again when ready() says so.
    bool tracing() const { return building_.valid(); }
    bool ready() const;
    void wait() const;

private:
    void build(const Scene& scene, const Settings& settings);
    void stop();

    std::vector<Dossier> dossiers_;
    std::shared_ptr<const TruthScene> casters_;
    std::future<std::shared_ptr<const TruthScene>> building_;
    std::uint64_t building_key_ = 0;
    std::stop_source stop_;
};

}  // namespace si
