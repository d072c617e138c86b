// The facts of a session and its view that the HUD shows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/viewer/viewing/viewing.h"

namespace scree {

struct HudFacts {
  std::string connection;  ///< one line
  bool lost = false;       ///< the connection is gone: shown in large letters
  Tick tick = 0;
  size_t pieces = 0;
  std::optional<StatusMessage> status;  ///< the server's last
  double bytes_per_s = 0.0;
  uint64_t mismatches = 0;
  std::string notice;                     ///< the server's last refusal, for a while
  std::optional<RequestLatency> latency;  ///< of one's own last request
  size_t predictions = 0;                 ///< own carves that the server has not answered
  std::string method;
  std::string driver;
  DrawStats draw;
  std::vector<GpuTime> gpu_times;
  size_t held_chunks = 0;    ///< that follow the server
  size_t edited_chunks = 0;  ///< of them with edits
  size_t edited_bricks = 0;
  MemoryCounts memory;  ///< of the drawing method, of the mirror, and of waiting messages
};

/// Caches costly counts for limits::count_interval_s.
class FactFinder {
 public:
  HudFacts find(Viewing& viewing, double now_s);

 private:
  void count(const Mirror& mirror, const ViewerSession& session);

  MemoryCounts mirror_memory_;
  double next_count_s_ = 0.0;
  HudFacts counted_;
};

}  // namespace scree
