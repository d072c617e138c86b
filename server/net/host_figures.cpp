#include "server/net/host_figures.h"

namespace scree {

void HostFigures::show(const Publisher& publisher, bool with_cursors) {
  wants_physics_ = publisher.has_physics_subscribers();
  counts_.published = publisher.stats();
  const std::scoped_lock lock(mutex_);
  stats_ = counts_;
  eyes_m_ = publisher.eyes_m();
  if (with_cursors) cursors_ = publisher.cursors();
}

void HostFigures::show(const LatencyCounts& latency) {
  const std::scoped_lock lock(mutex_);
  latency_ = latency;
}

NetStats HostFigures::stats() const {
  const std::scoped_lock lock(mutex_);
  return stats_;
}

LatencyCounts HostFigures::latency() const {
  const std::scoped_lock lock(mutex_);
  return latency_;
}

std::vector<glm::vec3> HostFigures::eyes_m() const {
  const std::scoped_lock lock(mutex_);
  return eyes_m_;
}

std::vector<PlayerCursor> HostFigures::cursors() const {
  std::vector<PlayerCursor> cursors;
  const std::scoped_lock lock(mutex_);
  for (const auto& [session, cursor] : cursors_) cursors.push_back(cursor.cursor);
  return cursors;
}

}  // namespace scree
