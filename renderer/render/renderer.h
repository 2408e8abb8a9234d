// Renderer of frames: a function of scene, settings and request. Needs a current OpenGL 4.5 core context.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "renderer/frame/driver_info.h"
#include "renderer/frame/frame.h"

namespace si {

struct Probe;
struct RendererImpl;

/// Draws frames of a scene, reads their images back, and probes single pixels.
class Renderer {
public:
    /// Creates a renderer in the current context.
    /// @throws Error when the context lacks OpenGL 4.5
    Renderer();
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws one frame with the outputs that `request` lists.
    /// @throws Error when memory runs out, or a shader does not compile in release builds
    FrameResult render(const Scene& scene, const Settings& settings, const FrameRequest& request);

    /// Callback that receives the invalid numbers found in a frame (NaN, infinite, out of range), and the frame's
    /// settings.
    using NumberWatcher = std::function<void(const Settings&, const NumericHealth&)>;
    /// Sets a callback that receives the invalid numbers (NaN, infinite, out of range) found in every drawn frame.
    /// Every frame is then searched as Outputs::health does, except timed frames.
    /// @param watch the function to call, for faultless frames too; empty: stops watching
    void set_number_watcher(NumberWatcher watch);

    /// Returns a key of the shader programs that render() would use. Frames of equal keys need no further compilation.
    /// Draws nothing except depths that fits need.
    std::uint64_t programs_key(const Scene& scene, const Settings& settings, const FrameRequest& request);

    /// Reads back an RGBA8 image of a frame, top row first.
    ByteImage read_colour(const Image& image);
    /// Reads back a float image of a frame, top row first.
    /// @param channels 1 to 4, from red on
    FloatImage read_float(const Image& image, int channels);
    /// Reads back FrameResult::surface_ids, top row first.
    SurfaceIds read_surface_ids(const Image& image);
    /// Returns true when no later frame has overwritten the images of `frame`. Otherwise draw the frame again before
    /// showing or reading them.
    bool has_images_of(const FrameResult& frame) const;
    /// Reads back a light's shadow map of a frame: stored depths in [0, 1], top row first.
    /// @param face index of a cube face or cascade
    /// @throws Error when the frame has no such map, holds only parts (FrameResult::maps_are_whole), or was overwritten
    FloatImage read_shadow_map(const FrameResult& frame, int light, int face);
    /// Reads back the depth image behind the map viewer's picture: stored depths in [0, 1], top row first.
    /// @throws Error as read_shadow_map() does
    FloatImage read_map_view_depth(const FrameResult& frame);
    /// Returns the invalid numbers (NaN, infinite, out of range) found in a frame with Outputs::health; null while the
    /// GPU has not finished the search.
    /// @param wait true: waits for the GPU
    /// @throws Error when the frame has no such output or was overwritten
    std::shared_ptr<const NumericHealth> numeric_health(const FrameResult& frame, bool wait = true);
    /// Evaluates the shadow test at one pixel of a frame in detail: inputs, taps, bias and result. Draws the maps and
    /// surface ids that the test needs, and leaves the last frame's picture as it is.
    /// @param x, y pixel, row 0 at the top
    Probe probe(const Scene& scene, const Settings& settings, const FrameRequest& request, int x, int y);

    /// Returns abilities and traits of the driver. The first call measures the clock and the polygon offsets of every
    /// map format.
    const DriverInfo& driver() const;
    /// Returns and clears the driver's errors and high-severity messages since the last call.
    std::vector<std::string> take_gl_messages();
    /// Returns memory to the system that the driver and the heap hold but no result uses. Takes some milliseconds: call
    /// while nothing is drawn.
    void release_unused_memory();
    /// Returns the last compile error of hot-reloaded shaders; empty when all compiled.
    std::string shader_log() const;
    /// Returns true when a shader file on disk changed since the last frame (development builds).
    bool shaders_changed();

private:
    std::unique_ptr<RendererImpl> impl_;
};

}  // namespace si
