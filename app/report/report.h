// Facts of a frame as JSON, for scripts (docs/cli.md).
#pragma once

#include <nlohmann/json.hpp>

#include "app/session/session.h"
#include "renderer/frame/frame.h"
#include "renderer/render/renderer.h"

namespace si {

/// Column-major GLM matrices become arrays of rows.
nlohmann::ordered_json matrix_json(const glm::dmat4& m);
nlohmann::ordered_json vector_json(const glm::dvec3& v);

nlohmann::ordered_json pages_json(const PageFacts& pages);
nlohmann::ordered_json driver_json(const DriverInfo& driver);
/// @param view key of the view that was drawn
nlohmann::ordered_json report_json(const Session& session, const std::string& view, const FrameRequest& request,
                                   const FrameResult& frame, const DriverInfo& driver);

/// The text of a report; numbers that are not finite become null.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace si
