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

/// Draws the small picture of a preset. Needs an OpenGL context of its own thread. @throws Error
ByteImage draw_preset_picture(Renderer& renderer, const std::string& key);

/// Small pictures of presets, kept until the end of the program. All calls come from the window's thread.
class PresetPictures {
public:
    /// Fetches pictures that were drawn, and begins to draw wanted ones. Stops drawing when none are wanted. Returns
    /// true if there are new pictures. Needs the window's OpenGL context.
    /// @param wanted keys of presets that lack a picture, the most urgent first
    bool update(std::span<const std::string> wanted);
    /// Returns the texture of a preset's picture, bottom row first; 0: not drawn yet.
    unsigned texture(const std::string& key) const;
    bool busy() const { return job_.busy(); }
    /// Returns true if update() would find new pictures.
    bool moved() const;
    /// Waits until the pictures under way are drawn.
    void wait() const { job_.wait(); }

private:
    /// Exchange with the job: what it shall draw next, and the pictures that update() has not fetched yet.
    struct Drawn {
        mutable std::mutex mutex;
        std::vector<std::string> wanted;                          ///< keys without a picture, the most urgent first
        std::vector<std::pair<std::string, ByteImage>> pictures;  ///< key and picture; an empty picture: it failed
    };
    std::shared_ptr<Drawn> drawn_ = std::make_shared<Drawn>();
    std::map<std::string, gl::Texture> textures_;
    std::set<std::string> failed_;
    Job<int> job_;  ///< last: joined first
};

}  // namespace si
