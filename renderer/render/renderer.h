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

/// Renderer of one OpenGL context: draws frames of a scene, reads their images back, and probes single pixels.
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
    /// Sets a callback that receives the invalid numbers (NaN, infinite, out of range) found in drawn frames. Every
    /// frame that draws a picture is then searched as with Outputs::health, except timed frames.
    /// @param watch function to call, also for frames without invalid numbers; empty: stops the search
    void set_number_watcher(NumberWatcher watch);

    /// Returns a key of the shader programs that render() would use. Frames with equal keys need the same programs:
    /// after one of them, the others have nothing to compile. Draws nothing, with one exception. If the fit (the rule
    /// for what a map covers) reads depths of the camera, those are drawn (light.depth_bounds=sdsm).
    std::uint64_t programs_key(const Scene& scene, const Settings& settings, const FrameRequest& request);

    /// Reads back an RGBA8 image of a frame, top row first.
    ByteImage read_colour(const Image& image);
    /// Reads back a float image of a frame, top row first.
    /// @param channels number of channels to read, 1 (red) to 4
    FloatImage read_float(const Image& image, int channels);
    /// Reads back the object and triangle number of each pixel of a frame, top row first.
    /// @param image FrameResult::surface_ids
    SurfaceIds read_surface_ids(const Image& image);
    /// Returns true when no later frame has overwritten the images of `frame`. If false, draw the frame again before
    /// its images are shown or read back.
    bool has_images_of(const FrameResult& frame) const;
    /// Reads back one shadow map that a light used in a frame: stored depths in [0, 1], top row first.
    /// @param light index of the light
    /// @param face index of a cube face or cascade; 0 for a single map
    /// @throws Error when the frame has no such map or drew only parts of it (FrameResult::maps_are_whole), or when a
    /// later frame has overwritten the map
    FloatImage read_shadow_map(const FrameResult& frame, int light, int face);
    /// Reads back the image that a frame's map viewer shows, top row first: stored depths in [0, 1], or one channel of
    /// the kernel's moments (FrameResult::shown_map).
    /// @throws Error when the frame drew no map view or only parts of the map (FrameResult::maps_are_whole), or when a
    /// later frame has overwritten the image
    FloatImage read_map_view_depth(const FrameResult& frame);
    /// Returns the invalid numbers (NaN, infinite, out of range) found in a frame with Outputs::health; null while the
    /// GPU has not finished the search.
    /// @param wait true: waits for the GPU
    /// @throws Error when the frame has no such output, or a later frame has overwritten it
    std::shared_ptr<const NumericHealth> numeric_health(const FrameResult& frame, bool wait = true);
    /// Evaluates the shadow test at one pixel of a frame in detail: inputs, taps, bias and result. Draws the maps and
    /// surface ids (object and triangle of each pixel) that the test needs, and leaves the last frame's picture as it
    /// is.
    /// @param x, y pixel, row 0 at the top
    Probe probe(const Scene& scene, const Settings& settings, const FrameRequest& request, int x, int y);

    /// Returns abilities and measured traits of the OpenGL driver. The first call takes longer: it measures the clock
    /// of passes and the polygon offsets of every map format.
    const DriverInfo& driver() const;
    /// Returns the driver's errors and high-severity messages since the last call, and clears them.
    std::vector<std::string> take_gl_messages();
    /// Gives unused memory of the driver and the heap back to the operating system. Takes some milliseconds: call while
    /// nothing is drawn.
    void release_unused_memory();
    /// Returns the error of the last shader compilation; empty if it succeeded. Development builds compile shader files
    /// again when they are saved.
    std::string shader_log() const;
    /// Reads again the shader files that were saved since the last call (development builds). Returns true if any was
    /// read: the picture must be drawn again.
    bool reload_changed_shaders();

private:
    std::unique_ptr<RendererImpl> impl_;
};

}  // namespace si
