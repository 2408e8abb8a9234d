// A frame of this program as a bundle, as an engine would write it.
#pragma once

#include <string>

#include "renderer/bundle/bundle_files.h"
#include "renderer/render/renderer.h"

namespace si {

/// File format of the shadow maps in a bundle (the files of one frame) that this program writes. Both formats hold the
/// stored depths as 32-bit floats.
enum class MapFile {
    Pfm,
    Exr  ///< losslessly compressed
};

/// Returns a copy of the scene for writing to a file. It contains the objects that settings hide, but not the ground
/// that the program adds (add_ground()).
Scene written_scene(const Scene& shown);

/// Draws a frame and returns the files of its bundle: scene, camera, picture, settings, and the lights' shadow maps.
/// Each map comes with its matrix, and each light with its shadow look-up (bias, kernel, comparison). The program can
/// read the bundle back as the same frame.
/// @param shown scene as drawn; written_scene() of it goes into the bundle @param maps file format of the shadow maps
/// @throws Error if no light has a shadow map, for virtual maps, and for cascades that are chosen by the depth seen
/// from FrameRequest::map_camera, if it is another camera than the picture's
BundleContents frame_bundle(Renderer& renderer, const Scene& shown, const Settings& settings, FrameRequest request,
                            MapFile maps = MapFile::Pfm);

/// Checks that a bundle (the files of one frame) to be written contains no file that the frame reads: no file of the
/// scene, and no imported map.
/// @param bundle path of the bundle to write @throws UsageError
void require_other_bundle(const std::string& bundle, const Scene& scene, const Settings& settings);

}  // namespace si
