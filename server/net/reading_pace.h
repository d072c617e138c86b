// How many bytes may wait for a client so that it sees the present: as many as its link takes in
// limits::outbox_wait_s, by the bytes that the socket takes. A socket that takes all it is offered tells only
// that there may be more, and that only when it was offered about as much as may wait. One that is full tells
// by its pace how fast the link is. Time is an argument (seconds). Not thread-safe.
#pragma once

#include <algorithm>
#include <cstddef>

#include "server/net/limits.h"
#include "server/publish/limits.h"

namespace scree {

class ReadingPace {
 public:
  /// limits::outbox_soft_min_bytes to outbox_soft_bytes.
  size_t bytes_max() const { return bytes_max_; }

  /// The socket took some of the bytes that it was offered `waited_s` ago.
  void took(size_t bytes, size_t offered, double waited_s) {
    if (full_) {
      staged_bytes_ += static_cast<double>(bytes);
      taken_s_ += waited_s;
      if (taken_s_ >= limits::pace_sample_s) {
        set(staged_bytes_ / taken_s_ * limits::outbox_wait_s);
        staged_bytes_ = taken_s_ = 0.0;
      }
    } else if (bytes == offered && 2 * offered >= bytes_max_) {
      set(static_cast<double>(bytes_max_ + bytes));
    }
    full_ = bytes < offered;
    if (!full_) staged_bytes_ = taken_s_ = 0.0;
  }

 private:
  void set(double bytes) {
    bytes_max_ = static_cast<size_t>(std::clamp(bytes, static_cast<double>(limits::outbox_soft_min_bytes),
                                                static_cast<double>(limits::outbox_soft_bytes)));
  }

  size_t bytes_max_ = limits::outbox_soft_bytes;
  bool full_ = false;  ///< it took less than offered, the last time
  double staged_bytes_ = 0.0;
  double taken_s_ = 0.0;  ///< while it was full
};

}  // namespace scree
