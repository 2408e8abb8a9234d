// File that describes the light of one shadow map: a light of a frame.json, or less.
#pragma once

#include <string_view>

#include "renderer/bundle/bundle.h"
#include "renderer/bundle/conventions.h"

namespace si {

/// Content of a light file, the JSON file with the light of an imported map image, and which conventions it states.
struct LightFile {
    Bundle bundle;            ///< `world` and one light, whose maps all read the image
    bool type_known = false;  ///< false: the file does not state BundleLight::type, which is then a guess
    KnownConvention known;    ///< stated conventions; a file never states `product` and `matrix`
};

/// Parses a light file, which describes the light of an imported map image. It is a JSON object like those in `lights`
/// of frame.json, but also has frame.json's member `world` (axes and unit). The members of a single map may be in the
/// light's object itself. The light's matrix alone is enough: members that frame.json requires may be missing here.
/// @param file name of the file, for messages
/// @param image_file name that the image gets in the bundle
/// @throws Error "FILE: PLACE: what is wrong; what to do"
LightFile parse_light_file(std::string_view text, std::string_view file, std::string_view image_file);

}  // namespace si
