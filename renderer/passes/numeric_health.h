// The search for numbers that are none: its pass, and what it found, back from the GPU.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/numeric_health.h"
#include "renderer/frame/state.h"
#include "renderer/passes/page_cache.h"

namespace si {

class PagePasses;

/// The pages of one map in a pool whose tiles are read back.
struct SearchedPages {
    NumberFinding place;
    std::vector<PlacedPage> pages;
};

struct PoolTiles {
    gl::Buffer read_back;
    glm::ivec2 tiles{0};  ///< across and up
    int page = 0;         ///< texels along a side of one
    std::vector<SearchedPages> layers;
};

/// Searches all that the frame made so far, maps and visibility, for what is no number.
class NumericHealthPass : public FramePass {
public:
    struct Targets {
        gl::Target tiles, found;  ///< RGBA32UI, a layer a kind of fault
        gl::Buffer read_back;     ///< of `found`
        GLsync done = nullptr;
        std::vector<NumberFinding> places;  ///< one a column of `found`
        std::optional<PoolTiles> pool;
        NumericHealth so_far;  ///< found by the CPU
        std::shared_ptr<const NumericHealth> health;

        Targets() = default;
        Targets(Targets&&) = delete;
        Targets& operator=(Targets&& other) noexcept {
            tiles = std::move(other.tiles);
            found = std::move(other.found);
            read_back = std::move(other.read_back);
            std::swap(done, other.done);
            places = std::move(other.places);
            pool = std::move(other.pool);
            so_far = std::move(other.so_far);
            health = std::move(other.health);
            return *this;
        }
        ~Targets() {
            if (done) glDeleteSync(done);
        }
    };

    explicit NumericHealthPass(const PagePasses& pages) : pages_(pages) {}
    void declare(FrameState& f) override;
    /// Returns what the last run found; null while the driver is not through with it. @param wait for it
    std::shared_ptr<const NumericHealth> read_result(bool wait);

private:
    void run(const FrameState& f, PassInfo& info);

    Targets targets_;
    const PagePasses& pages_;
};

}  // namespace si
