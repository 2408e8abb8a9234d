#include "app/editor/frame_desk.h"

#include <epoxy/gl.h>

#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "app/editor/wishes.h"
#include "renderer/gl/pace.h"
#include "renderer/gl/target.h"

namespace si {

/// Does one thing at a time: on its thread, or, where it has none, at once.
class FrameDesk::Hand {
public:
    explicit Hand(FrameThread thread) : wake_(std::move(thread.wake)) {
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
    ~Hand() { wait(); }

    bool has_thread() const { return thread_.joinable(); }
    /// What was started before is to be taken first.
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
    /// @throws what the work threw
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
        return work_;  // empty at the end
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
    std::function<void()> work_;  ///< until it is done
    std::exception_ptr problem_;
    bool done_ = false;
    mutable bool awaited_ = false;  ///< somebody waits: nobody is to be woken
    std::jthread thread_;           ///< last: ends before what it uses
};

/// What is shown of a frame while the next one is drawn into the renderer's images: two sets, in turn.
class FrameDesk::Copies {
public:
    /// Has `facts` name copies. @param changed the images hold something else than at the last call
    /// @param shown what was drawn of earlier ones until then
    void stand_in(FrameFacts& facts, bool changed, GLsync shown) {
        std::vector<Image*> images = {&facts.result.colour, &facts.result.map_view, &facts.result.texels_read};
        for (Pane& pane : facts.result.panes) images.push_back(&pane.picture);
        if (facts.against) {
            images.push_back(&facts.against->picture);
            images.push_back(&facts.against->difference);
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

FrameDesk::FrameDesk(EditorState& state, FrameThread thread, SessionReport& session)
    : state_(state), session_(session), patience_(thread.patience), hand_(std::make_unique<Hand>(std::move(thread))) {
    call([&] {
        if (hand_->has_thread()) gl::let_others_draw();
        loop_ = std::make_unique<FrameLoop>(hand_->has_thread());
        if (hand_->has_thread()) copies_ = std::make_unique<Copies>();
    });
}

FrameDesk::~FrameDesk() {
    wait();
    if (hand_->done()) hand_->take();
    call([&] {
        copies_.reset();
        loop_.reset();
    });
}

void FrameDesk::call(const std::function<void()>& work) {
    wait();
    poll();
    hand_->start(work);
    hand_->wait();
    hand_->take();
}

bool FrameDesk::under_way() const {
    return hand_->under_way();
}
bool FrameDesk::busy() const {
    return hand_->under_way() || hand_->done();
}
void FrameDesk::wait() const {
    hand_->wait();
}

bool FrameDesk::poll() {
    if (!hand_->done()) return false;
    hand_->take();
    facts_ = std::move(next_facts_);
    for (const std::string& message : news_.driver) session_.note_driver(message);
    if (!news_.unsound.empty()) session_.note_unsound(news_.unsound);
    for (const LogLine& line : news_.remarks) {
        if (line.kind == LogKind::Error)
            report(state_, line.text);
        else
            state_.log.add(line.kind, line.text);
    }
    if (news_.thaw) state_.frozen.reset();
    return std::exchange(news_, {}).changed;
}

bool FrameDesk::update(const Scene& scene, const EditorActions& actions, const ComparisonFacts* comparison) {
    bool changed = poll();
    missed_.cancel_reference |= actions.cancel_reference;
    if (actions.save_error) missed_.save_error = actions.save_error;
    if (under_way()) return changed;
    EditorActions wished = actions;
    wished.cancel_reference = std::exchange(missed_.cancel_reference, false);
    wished.save_error = std::exchange(missed_.save_error, {});
    const GLsync shown = copies_ ? glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0) : nullptr;
    if (shown) glFlush();
    progress_.set({}, 0, 0);
    hand_->start([this, &scene, shown, wished = std::move(wished), state = PictureState(state_),
                  known = comparison ? std::optional(*comparison) : std::nullopt] {
        const WatchPasses watch(progress_);
        news_ = loop_->update(scene, state, wished, known ? &*known : nullptr);
        next_facts_ = loop_->facts();
        if (copies_) stand_in(shown);
    });
    hand_->wait_for(patience_);
    return poll() || changed;
}

void FrameDesk::stand_in(GLsync shown) {
    try {
        copies_->stand_in(next_facts_, news_.changed, shown);
    } catch (const std::exception& e) {
        // Without its copies there is no picture; settings stay, and the next frame may find memory.
        news_.remarks.push_back({.kind = LogKind::Error, .text = e.what()});
        next_facts_ = {};
        next_facts_.problem = e.what();
        news_.changed = true;
    }
    glDeleteSync(shown);
}

std::optional<DrawingFacts> FrameDesk::first_picture() const {
    if (facts_.driver || !busy()) return {};
    const PassProgress::State now = progress_.state();
    return DrawingFacts{now.pass, now.of == 0 ? 0 : double(now.done) / double(now.of)};
}

bool FrameDesk::first_picture_moved() {
    if (facts_.driver || !under_way()) return false;
    const PassProgress::State now = progress_.state();
    return std::exchange(seen_progress_, now) != now;
}

void FrameDesk::clear() {
    if (!facts_.driver && !busy()) return;
    call([&] { loop_->clear(); });
    facts_ = {};
}

void FrameDesk::rest() {
    if (!busy()) call([&] { loop_->rest(); });
}

void FrameDesk::save_map(const Scene& scene, const std::string& path) {
    call([&] { loop_->save_map(scene, state_.settings, path); });
    state_.log.add(LogKind::Info, "Saved " + path);
}

}  // namespace si
