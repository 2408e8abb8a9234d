#include "app/editor/preset_pictures.h"

#include <algorithm>
#include <utility>

#include "app/context/headless_context.h"
#include "app/editor/upload_picture.h"
#include "app/session/session.h"
#include "renderer/render/renderer.h"

namespace si {
namespace {

constexpr int kOversampling = 2;  ///< pixels that are drawn for each pixel of a picture, along each side

/// Returns a picture of half the width and height, each pixel the mean of four.
ByteImage halved(const ByteImage& from) {
    ByteImage to{from.width / 2, from.height / 2, {}};
    to.data.resize(std::size_t(to.width) * std::size_t(to.height) * 4);
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x)
            for (int c = 0; c < 4; ++c) {
                int sum = 0;
                for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
                    sum += from.data[(std::size_t(2 * y + dy) * std::size_t(from.width) + std::size_t(2 * x + dx)) * 4 +
                                     std::size_t(c)];
                to.data[(std::size_t(y) * std::size_t(to.width) + std::size_t(x)) * 4 + std::size_t(c)] =
                    std::uint8_t(sum / 4);
            }
    return to;
}

}  // namespace

ByteImage draw_preset_picture(Renderer& renderer, const std::string& key) {
    Session session = open_session({.scene = {}, .preset = key, .sets = {}});
    session.settings.view.panes = Panes::One;
    FrameRequest request;
    request.width = kOversampling * kPresetPictureWidth;
    request.height = kOversampling * kPresetPictureHeight;
    request.outputs.colour = request.outputs.overlay = true;
    const FrameResult frame = renderer.render(session.scene, session.settings, request);
    return halved(renderer.read_colour(frame.panes.empty() ? frame.colour : frame.panes.front().picture));
}

bool PresetPictures::has_new_pictures() const {
    const std::lock_guard lock(drawn_->mutex);
    return !drawn_->pictures.empty();
}

unsigned PresetPictures::texture(const std::string& key) const {
    const auto found = textures_.find(key);
    return found == textures_.end() ? 0 : found->second.id();
}

bool PresetPictures::update(std::span<const std::string> wanted) {
    std::vector<std::pair<std::string, ByteImage>> fresh;
    {
        const std::lock_guard lock(drawn_->mutex);
        fresh = std::exchange(drawn_->pictures, {});
    }
    for (const auto& [key, picture] : fresh)
        if (picture.width > 0)
            textures_[key] = upload_picture(picture);
        else
            failed_.insert(key);
    job_.poll();
    std::vector<std::string> missing;
    for (const std::string& key : wanted)
        if (!textures_.contains(key) && !failed_.contains(key)) missing.push_back(key);
    const bool idle = missing.empty();
    {
        const std::lock_guard lock(drawn_->mutex);
        drawn_->wanted = std::move(missing);
    }
    if (wanted.empty()) job_.cancel();
    if (idle || job_.busy()) return !fresh.empty();
    job_.start([drawn = drawn_](const Workers& workers, const auto&) {
        const HeadlessContext context;
        Renderer renderer;
        std::set<std::string> done;
        // The list changes while the gallery is scrolled or searched.
        for (;;) {
            if (workers.stop.stop_requested()) throw Cancelled();
            std::string key;
            {
                const std::lock_guard lock(drawn->mutex);
                const auto next = std::ranges::find_if(
                    drawn->wanted, [&](const std::string& wanted_key) { return !done.contains(wanted_key); });
                if (next == drawn->wanted.end()) return int(done.size());
                key = *next;
            }
            ByteImage picture;
            try {
                picture = draw_preset_picture(renderer, key);
            } catch (const std::exception&) {
                picture = {};  // the card stays without a picture
            }
            done.insert(key);
            const std::lock_guard lock(drawn->mutex);
            drawn->pictures.emplace_back(key, std::move(picture));
        }
    });
    return !fresh.empty();
}

}  // namespace si
