#include "renderer/inspect/effect_facts.h"

#include <fmt/format.h>

#include <utility>

#include "renderer/settings/param.h"

namespace si {

Effect part_of(const PassInfo& pass, std::string name, bool needed, std::string_view reason,
               std::optional<Optimisation> optimisation) {
    const bool lives = pass.state != PassState::Skipped;
    Effect effect{.name = std::move(name), .optimisation = optimisation, .pass = pass.name, .part = true};
    effect.state = needed ? state_of(pass.state) : EffectState::NotNeeded;
    effect.reason = as_sentence(lives || !needed ? reason : std::string_view(pass.reason));
    return effect;
}

std::string light_setting_key(std::size_t light, std::string_view setting) {
    SettingRef ref = *find_setting(fmt::format("light.{}", setting));
    ref.light = int(light);
    return setting_key(ref);
}

}  // namespace si
