#include "app/sweep/running_sweep.h"

namespace si {

RunningSweep::RunningSweep(Inputs inputs, Renderer& renderer, const Workers& workers)
    : inputs_(std::move(inputs)),
      measurer_(renderer, inputs_.spec.width, inputs_.spec.height, workers),
      cases_(measurer_, renderer.driver(), inputs_.sessions),
      journal_(inputs_.folder, spec_json(inputs_.spec), plan_key(inputs_.plan)),
      runner_(inputs_.plan, inputs_.spec.shard, inputs_.timing, inputs_.retry, cases_, journal_, inputs_.folder) {}

}  // namespace si
