#include "server/publish/region_stream.h"

#include "server/publish/limits.h"

namespace scree {

void RegionStream::serve(const ServedTick& tick, Outlet& outlet, ServedPart& part) {
  const auto& regions = tick.changes.state.regions();
  if (regions == told_ || (told_ == nullptr && regions->empty())) return;
  const Tick wait = tick.rates.ticks_of(limits::regions_wait_s);
  if (outlet.room_bytes() <= 0 || (told_at_ != 0 && tick.tick() < told_at_ + wait)) return;
  told_ = regions;
  told_at_ = tick.tick();
  outlet.send(share(RegionsMessage{*regions}), part);
}

}  // namespace scree
