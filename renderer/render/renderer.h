// Draws frames: a function of scene, settings and request. Needs a current OpenGL 4.5 core context.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "renderer/frame/driver_info.h"
#include "renderer/frame/frame.h"

namespace si {

struct Probe;
namespace gl {
class ProgramCache;
}

struct RendererImpl;  // renderer/render/renderer_impl.h

class Renderer {
public:
    /// @throws Error when the context lacks OpenGL 4.5.
    Renderer();
    /// Compiles into a cache that outlives the renderer, so that the next one in the same context finds its programs
    /// there. @param programs of the current context, not null
    explicit Renderer(std::shared_ptr<gl::ProgramCache> programs);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws what `request` asks for. @throws Error (out of memory, shader compile errors in release builds).
    FrameResult render(const Scene& scene, const Settings& settings, const FrameRequest& request);

    /// Has every picture that is drawn or judged searched as Outputs::health asks for, but for those that are timed.
    /// @param watch is told what was found, soundness too; empty: no more
    using NumberWatcher = std::function<void(const Settings&, const NumericHealth&)>;
    void set_number_watcher(NumberWatcher watch);

    /// Names the programs that render() would draw this frame with: frames of one key need no others. Draws nothing but
    /// what fits go by.
    std::uint64_t programs_key(const Scene& scene, const Settings& settings, const FrameRequest& request);

    ByteImage read_colour(const Image& image);
    FloatImage read_float(const Image& image, int channels);
    SurfaceIds read_surface_ids(const Image& image);
    /// Whether all that the frame drew is still there. Frames share images: one that shows something else takes the
    /// place of those before it, and their images are to be drawn anew before they are shown or read.
    bool has_images_of(const FrameResult& frame) const;
    /// The stored depth of a light's map of that frame, raw, in [0,1].
    /// @throws Error when the frame has no such map, did not ask for whole ones (FrameResult::maps_are_whole), or
    /// another one was drawn in its place
    FloatImage read_shadow_map(const FrameResult& frame, int light, int face);
    /// The depth image behind that frame's `map_view`, as stored, in [0,1]. @throws Error as read_shadow_map() does
    FloatImage read_map_view_depth(const FrameResult& frame);
    /// What a frame's numbers are worth; that was asked for Outputs::health. Null: the driver is not through with it.
    /// @param wait for the driver @throws Error when the frame did not ask, or another one was drawn in its place
    std::shared_ptr<const NumericHealth> numeric_health(const FrameResult& frame, bool wait = true);
    /// Evaluates the shadow test at a pixel of the frame of these (row 0 at the top). It draws what it needs of it, and
    /// leaves images of that frame as they are.
    Probe probe(const Scene& scene, const Settings& settings, const FrameRequest& request, int x, int y);

    /// Measures on the first call what only drawing tells: the clock, and polygon offsets of every map format.
    const DriverInfo& driver() const;
    /// Errors and high-severity messages of the driver since the last call; tests demand none.
    std::vector<std::string> take_gl_messages();
    /// Gives back memory that is nobody's and costs some milliseconds to find: call while nothing is drawn for a while.
    void release_unused_memory();
    /// The last compile error of hot-reloaded shaders; empty when all compiled.
    std::string shader_log() const;
    /// True when a shader file on disk changed since the last frame (dev builds).
    bool shaders_changed();

private:
    std::unique_ptr<RendererImpl> impl_;
};

}  // namespace si
