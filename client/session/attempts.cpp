#include "client/session/attempts.h"

#include <algorithm>
#include <cmath>

#include "client/connection/come_again.h"
#include "client/session/limits.h"

namespace scree {

void Attempts::lost(double now_s, std::string_view refusal) {
  gave_up_ = !may_come_again(refusal);
  if (joined_s_ && now_s - *joined_s_ >= limits::reconnect_worth_s) failures_ = 0;
  joined_s_.reset();
  const int doubled = static_cast<int>(failures_) + 1 - static_cast<int>(limits::reconnect_first);
  next_s_ = now_s + std::min(std::ldexp(limits::reconnect_min_s, std::clamp(doubled, 0, 30)),
                             limits::reconnect_max_s);
  ++failures_;
}

}  // namespace scree
