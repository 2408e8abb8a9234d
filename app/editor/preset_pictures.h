// Small pictures of presets for the gallery, drawn in the background while it is open.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/base/job.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"
#include "renderer/render/renderer.h"

namespace si {

/// Width and height of a preset's small picture, pixels.
inline constexpr int kPresetPictureWidth = 192, kPresetPictureHeight = 120;

/// Draws the small picture of a built-in preset for the gallery. Needs a current OpenGL context.
/// @param key key of the preset @throws Error
ByteImage draw_preset_picture(Renderer& renderer, const std::string& key);

/// Small pictures of the built-in presets for the gallery. A background job draws them; their textures are kept until
/// the end of the program. All calls come from the window's thread.
class PresetPictures {
public:
    /// Uploads preset pictures that the background job has drawn, and starts to draw wanted ones. Needs the window's
    /// OpenGL context. Returns true if there are new pictures.
    /// @param wanted keys of presets without a picture, the most urgent first; empty: drawing stops
    bool update(std::span<const std::string> wanted);
    /// Returns the OpenGL texture of a preset's small picture, bottom row first; 0: not drawn yet, or drawing failed.
    /// @param key key of the preset
    unsigned texture(const std::string& key) const;
    bool busy() const { return job_.busy(); }
    /// Returns true if the background job has drawn preset pictures that update() has not uploaded yet.
    bool has_new_pictures() const;
    /// Waits until the pictures under way are drawn.
    void wait() const { job_.wait(); }

private:
    /// Data shared with the background job that draws preset pictures: keys to draw, and pictures not uploaded yet.
    struct Drawn {
        mutable std::mutex mutex;
        std::vector<std::string> wanted;                          ///< keys without a picture, the most urgent first
        std::vector<std::pair<std::string, ByteImage>> pictures;  ///< key and picture; an empty picture: it failed
    };
    std::shared_ptr<Drawn> drawn_ = std::make_shared<Drawn>();
    std::map<std::string, gl::Texture> textures_;
    std::set<std::string> failed_;
    Job<int> job_;  ///< declared last, so that its thread ends first
};

}  // namespace si
