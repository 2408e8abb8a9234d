// Facts of a frame, of the driver and of memory as JSON (docs/cli.md).
#pragma once

#include "app/base/json_text.h"
#include "app/session/session.h"
#include "renderer/base/held_memory.h"
#include "renderer/frame/frame.h"
#include "renderer/inspect/lost_casters.h"
#include "renderer/render/renderer.h"

namespace si {

/// Converts a 4x4 matrix to JSON as an array of rows (GLM stores columns).
nlohmann::ordered_json matrix_json(const glm::dmat4& m);
/// Converts a vector to JSON as an array of three numbers.
nlohmann::ordered_json vector_json(const glm::dvec3& v);

/// Converts the statistics of the pages of virtual shadow maps in one frame to JSON.
nlohmann::ordered_json pages_json(const PageFacts& pages);
/// Converts the OpenGL driver's names and limits to JSON.
nlohmann::ordered_json driver_json(const DriverInfo& driver);
/// Converts the program's use of memory to JSON {resident, peak, heap, heap_free, held, holders: [{holder, bytes, most,
/// count}]}, in bytes.
nlohmann::ordered_json memory_json(const MemoryReport& facts);
/// Converts lost casters to JSON. A lost caster should cast a shadow but leaves nothing in a light's map.
nlohmann::ordered_json lost_casters_json(const Scene& scene, const std::vector<LostCaster>& lost);
/// Makes the JSON report of a drawn frame for `render --report`: scene, settings, camera, fit of each light (what its
/// maps cover), passes and driver. @param view key of the view that was drawn
nlohmann::ordered_json report_json(const Session& session, const std::string& view, const FrameRequest& request,
                                   const FrameResult& frame, const DriverInfo& driver);

/// Formats JSON as indented text; numbers that are not finite become null.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace si
