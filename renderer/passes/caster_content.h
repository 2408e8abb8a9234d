// What casters are, whichever scene they are of: by it what is drawn of them outlasts what moves elsewhere.
#pragma once

#include "renderer/frame/state.h"
#include "renderer/passes/caster_findings.h"

namespace si {

/// Found once for each arrangement of a scene; meshes and textures that poses share once for all of these.
const CasterContent& caster_content(const FrameState& f);

}  // namespace si
