#include "app/report/memory_json.h"

namespace si {

using Json = nlohmann::ordered_json;

Json memory_json(const MemoryReport& facts) {
    const ProcessMemory& p = facts.process;
    Json json = {{"resident", p.resident},   {"peak", p.peak},       {"heap", p.heap},
                 {"heap_free", p.heap_free}, {"held", facts.held()}, {"holders", Json::array()}};
    for (const MemoryUse& h : facts.holders)
        json["holders"].push_back({{"holder", h.holder}, {"bytes", h.bytes}, {"most", h.most}, {"count", h.count}});
    return json;
}

}  // namespace si
