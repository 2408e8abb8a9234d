// A frame of this program as a bundle, as an engine would write it.
#pragma once

#include <string>

#include "renderer/bundle/bundle_files.h"
#include "renderer/render/renderer.h"

namespace si {

/// File format of the maps in a bundle that this program writes. Both hold the stored depths as 32-bit floats.
enum class MapFile {
    Pfm,
    Exr  ///< losslessly compressed
};

/// Returns a scene as it is written to files: with the objects that settings hide, and without the ground of
/// add_ground().
Scene written_scene(const Scene& shown);

/// Draws a frame and returns the files of its bundle: written_scene(), camera, maps with their matrices, look-up,
/// picture, and the settings by which it reads back as the same frame.
/// @throws Error where no light has a shadow map, and for virtual maps
BundleContents frame_bundle(Renderer& renderer, const Scene& shown, const Settings& settings, FrameRequest request,
                            MapFile maps = MapFile::Pfm);

/// Checks that no file of the scene or its given maps lies in the bundle to be written. @throws UsageError
void require_other_bundle(const std::string& bundle, const Scene& scene, const Settings& settings);

}  // namespace si
