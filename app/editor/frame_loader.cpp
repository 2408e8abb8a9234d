#include "app/editor/frame_loader.h"

#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "app/editor/requests.h"
#include "renderer/gl/target.h"
#include "renderer/software/llvmpipe_queue.h"

namespace si {

/// Drawing thread: runs one function at a time, on the calling thread if there is no context.
class FrameLoader::DrawThread {
public:
    explicit DrawThread(FrameThread thread) : wake_(std::move(thread.wake)) {
        if (!thread.context) return;
        thread_ = std::jthread([this, make = std::move(thread.context)](const std::stop_token& end) {
            std::unique_ptr<ThreadContext> context;
            while (const auto work = next(end)) {
                std::exception_ptr problem;
                try {
                    if (!context) context = make();
                    work();
                } catch (...) {
                    problem = std::current_exception();
                }
                finish(problem);
            }
        });
    }
    ~DrawThread() { wait(); }

    bool has_thread() const { return thread_.joinable(); }
    /// Starts the work. The result of the work before must have been taken.
    void start(std::function<void()> work) {
        if (!has_thread()) {
            try {
                work();
                problem_ = nullptr;
            } catch (...) {
                problem_ = std::current_exception();
            }
            done_ = true;
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            work_ = std::move(work);
        }
        changed_.notify_all();
    }
    bool under_way() const {
        const std::lock_guard lock(mutex_);
        return bool(work_);
    }
    bool done() const {
        const std::lock_guard lock(mutex_);
        return done_;
    }
    void wait() const {
        std::unique_lock lock(mutex_);
        awaited_ = true;
        changed_.wait(lock, [&] { return !work_; });
        awaited_ = false;
    }
    void wait_for(std::chrono::milliseconds most) const {
        std::unique_lock lock(mutex_);
        awaited_ = true;
        changed_.wait_for(lock, most, [&] { return !work_; });
        awaited_ = false;
    }
    /// Waits for the work. @throws the work's exception
    void take() {
        std::exception_ptr problem;
        {
            const std::lock_guard lock(mutex_);
            done_ = false;
            problem = std::exchange(problem_, nullptr);
        }
        if (problem) std::rethrow_exception(problem);
    }

private:
    std::function<void()> next(const std::stop_token& end) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, end, [&] { return bool(work_); });
        return work_;  // empty: the thread ends
    }
    void finish(std::exception_ptr problem) {
        bool awaited = false;
        {
            const std::lock_guard lock(mutex_);
            problem_ = std::move(problem);
            work_ = nullptr;
            done_ = true;
            awaited = awaited_;
        }
        changed_.notify_all();
        if (!awaited && wake_) wake_();
    }

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::function<void()> work_;  ///< empty: no work is under way
    std::exception_ptr problem_;
    bool done_ = false;
    mutable bool awaited_ = false;  ///< a caller waits, so that wake_ is not called
    std::jthread thread_;           ///< last: ends before what it uses
};

/// Copies of a frame's images, shown while the next frame is drawn into the renderer's own. Two sets alternate.
class FrameLoader::Copies {
public:
    /// Replaces the images in `facts` by copies. @param changed the images differ from those of the last call
    /// @param shown fence after the editor's last use of earlier copies
    void show_copies(FrameFacts& facts, bool changed, GLsync shown) {
        std::vector<Image*> images = {&facts.result.colour, &facts.result.map_view, &facts.result.texels_read,
                                      &facts.traced_so_far};
        for (Pane& pane : facts.result.panes) images.push_back(&pane.picture);
        if (facts.picture_comparison) {
            images.push_back(&facts.picture_comparison->picture);
            images.push_back(&facts.picture_comparison->difference);
        }
        std::erase_if(images, [](const Image* image) { return image->texture == 0; });
        for (const Image* image : images) changed |= !sets_[front_].contains(image->texture);
        if (changed) {
            glWaitSync(shown, 0, GL_TIMEOUT_IGNORED);
            front_ = 1 - front_;
            auto& set = sets_[front_];
            std::map<unsigned, gl::Target> kept;
            for (const Image* image : images)
                if (!kept.contains(image->texture)) copy(*image, kept[image->texture] = std::move(set[image->texture]));
            set = std::move(kept);
            glFinish();
        }
        for (Image* image : images) image->texture = sets_[front_].at(image->texture).texture.id();
    }

private:
    static void copy(const Image& from, gl::Target& to) {
        GLint format = 0;
        glGetTextureLevelParameteriv(from.texture, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
        to.ensure("shown", GLenum(format), from.width, from.height);
        glCopyImageSubData(from.texture, GL_TEXTURE_2D, 0, 0, 0, 0, to.texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                           from.width, from.height, 1);
    }

    std::array<std::map<unsigned, gl::Target>, 2> sets_;  ///< by the renderer's texture
    std::size_t front_ = 0;
};

FrameLoader::FrameLoader(EditorState& state, FrameThread thread, SessionReport& session)
    : state_(state),
      session_(session),
      patience_(thread.patience),
      draw_thread_(std::make_unique<DrawThread>(std::move(thread))) {
    call([&] {
        if (draw_thread_->has_thread()) gl::set_background_drawing();
        loop_ = std::make_unique<FrameLoop>(draw_thread_->has_thread());
        if (draw_thread_->has_thread()) frame_copies_ = std::make_unique<Copies>();
    });
}

FrameLoader::~FrameLoader() {
    wait();
    if (draw_thread_->done()) draw_thread_->take();
    call([&] {
        frame_copies_.reset();
        loop_.reset();
    });
}

void FrameLoader::call(const std::function<void()>& work) {
    wait();
    poll();
    draw_thread_->start(work);
    draw_thread_->wait();
    draw_thread_->take();
}

bool FrameLoader::under_way() const {
    return draw_thread_->under_way();
}
bool FrameLoader::busy() const {
    return draw_thread_->under_way() || draw_thread_->done();
}
void FrameLoader::wait() const {
    draw_thread_->wait();
}

bool FrameLoader::poll() {
    if (!draw_thread_->done()) return false;
    draw_thread_->take();
    facts_ = std::move(next_facts_);
    for (const std::string& message : news_.driver) session_.note_driver(message);
    if (!news_.unsound.empty()) session_.note_unsound(news_.unsound);
    for (const LogLine& line : news_.remarks) {
        if (line.kind == LogKind::Error)
            report(state_, line.text);
        else
            state_.log.add(line.kind, line.text);
    }
    if (news_.release_frozen_camera) state_.frozen.reset();
    return std::exchange(news_, {}).changed;
}

bool FrameLoader::update(const Scene& scene, const EditorRequests& requests, const ComparisonFacts* comparison) {
    bool changed = poll();
    missed_.cancel_reference |= requests.cancel_reference;
    if (requests.save_error) missed_.save_error = requests.save_error;
    if (busy()) return changed;  // a frame that has ended since poll() is fetched by the next call
    EditorRequests requested = requests;
    requested.cancel_reference = std::exchange(missed_.cancel_reference, false);
    requested.save_error = std::exchange(missed_.save_error, {});
    const GLsync shown = frame_copies_ ? glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0) : nullptr;
    if (shown) glFlush();
    progress_.set({}, 0, 0);
    draw_thread_->start([this, &scene, shown, requested = std::move(requested), state = PictureState(state_),
                         known = comparison ? std::optional(*comparison) : std::nullopt] {
        const PassProgressScope watch(progress_);
        news_ = loop_->update(scene, state, requested, known ? &*known : nullptr);
        next_facts_ = loop_->facts();
        if (frame_copies_) show_copies(shown);
    });
    draw_thread_->wait_for(patience_);
    return poll() || changed;
}

void FrameLoader::show_copies(GLsync shown) {
    try {
        frame_copies_->show_copies(next_facts_, news_.changed, shown);
    } catch (const std::exception& e) {
        // Without copies there is no picture; the next frame may succeed.
        news_.remarks.push_back({.kind = LogKind::Error, .text = e.what()});
        next_facts_ = {};
        next_facts_.problem = e.what();
        news_.changed = true;
    }
    glDeleteSync(shown);
}

std::optional<DrawingFacts> FrameLoader::first_picture() const {
    if (facts_.driver || !busy()) return {};
    const PassProgress::State now = progress_.state();
    return DrawingFacts{now.pass, now.of == 0 ? 0 : double(now.done) / double(now.of)};
}

bool FrameLoader::first_picture_moved() {
    if (facts_.driver || !under_way()) return false;
    const PassProgress::State now = progress_.state();
    return std::exchange(seen_progress_, now) != now;
}

void FrameLoader::clear() {
    if (!facts_.driver && !busy()) return;
    call([&] { loop_->clear(); });
    facts_ = {};
}

void FrameLoader::release_unused_memory() {
    if (!busy()) call([&] { loop_->release_unused_memory(); });
}

void FrameLoader::save_view(const Scene& scene, const View& view, const std::string& path) {
    call([&] { loop_->save_view(scene, state_.settings, view, path); });
    state_.log.add(LogKind::Info, "Saved " + path);
}

}  // namespace si
