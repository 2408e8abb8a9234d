#include "app/sweep/running_sweep.h"

namespace si {

RunningSweep::RunningSweep(Of of, Renderer& renderer, const Workers& workers)
    : of_(std::move(of)),
      measurer_(renderer, of_.spec.width, of_.spec.height, workers),
      cases_(measurer_, renderer.driver(), of_.sessions),
      journal_(of_.folder, spec_json(of_.spec), plan_key(of_.plan)),
      runner_(of_.plan, of_.spec.shard, of_.timing, of_.retry, cases_, journal_, of_.folder) {}

}  // namespace si
