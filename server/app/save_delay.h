// Whether saves that are due wait for one that is being written: a disk that hangs gives no error. Time is an
// argument, seconds. Not thread-safe.
#pragma once

#include <cstdint>

#include "server/store/world_saver.h"

namespace scree {

class SaveDelay {
 public:
  /// How the saver stands; once a tick.
  void note(const SaverStatus& status, double now_s) {
    if (status.saves != saves_ || status.failures != failures_) {
      saves_ = status.saves;
      failures_ = status.failures;
      skipped_ = status.skipped;
      waits_ = false;
    }
    if (waits_ || status.skipped == skipped_) return;
    waits_ = true;
    since_s_ = now_s;
  }
  /// Seconds for which a save that is due has waited; 0: none does.
  double waited_s(double now_s) const { return waits_ ? now_s - since_s_ : 0.0; }

 private:
  uint64_t saves_ = 0;
  uint64_t failures_ = 0;
  uint64_t skipped_ = 0;
  bool waits_ = false;
  double since_s_ = 0.0;
};

}  // namespace scree
