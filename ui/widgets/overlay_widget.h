// The choice of an overlay, by what it is looked at for.
#pragma once

#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// A combo for a row whose choices are the overlays. @param width of it, pixels. Returns whether it changed.
bool overlay_widget(Settings& settings, std::string_view key, float width);

}  // namespace si
