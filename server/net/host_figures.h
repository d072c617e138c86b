// The network side's counts, and the copies that other threads read. counts() is the network thread's; the
// const functions below it are for any thread, and answer as of the last show().
#pragma once

#include <atomic>
#include <glm/vec3.hpp>
#include <map>
#include <mutex>
#include <vector>

#include "server/net/net_server.h"

namespace scree {

class HostFigures {
 public:
  NetStats& counts() { return counts_; }
  /// Copies the counts and the publisher's for other threads; `with_cursors`: the persons' cursors, too.
  void show(const Publisher& publisher, bool with_cursors);
  void show(const LatencyCounts& latency);

  NetStats stats() const;
  LatencyCounts latency() const;
  std::vector<glm::vec3> eyes_m() const;
  std::vector<PlayerCursor> cursors() const;
  bool wants_physics() const { return wants_physics_; }

 private:
  NetStats counts_;
  std::atomic<bool> wants_physics_{false};
  mutable std::mutex mutex_;
  NetStats stats_;  ///< guarded by mutex_, as all below
  LatencyCounts latency_;
  std::vector<glm::vec3> eyes_m_;
  std::map<uint64_t, PartyCursor> cursors_;
};

}  // namespace scree
