// What keeps a server from what it promised, as a fixed set of kinds, and the health that follows
// (proto/health.h). Names stay as they are, because programs that watch servers know them. Words are for
// everybody, so they name no file and no person. Values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/health.h"

namespace scree {

/// What a fault is about: everything; what was promised to those who are there; newcomers.
enum class HealthLevel : uint8_t { life, promise, place };

enum class HealthKind : uint8_t {
  simulation,
  saving,
  recording,
  events,
  stopping,
  starting,
  full,
  backups,
  history,
  bus
};

struct HealthRow {
  std::string_view name;
  HealthLevel level;
};

constexpr HealthRow row_of(HealthKind kind) {
  switch (kind) {
    case HealthKind::simulation:
      return {"simulation", HealthLevel::life};
    case HealthKind::saving:
      return {"saving", HealthLevel::promise};
    case HealthKind::recording:
      return {"recording", HealthLevel::promise};
    case HealthKind::events:
      return {"events", HealthLevel::promise};
    case HealthKind::stopping:
      return {"stopping", HealthLevel::place};
    case HealthKind::starting:
      return {"starting", HealthLevel::place};
    case HealthKind::full:
      return {"full", HealthLevel::place};
    case HealthKind::backups:
      return {"backups", HealthLevel::promise};
    case HealthKind::history:
      return {"history", HealthLevel::promise};
    case HealthKind::bus:
      return {"bus", HealthLevel::promise};
  }
  return {};
}

class ServerHealth {
 public:
  void add(HealthKind kind, std::string words);
  /// `tick`: the last one.
  HealthMessage as_of(Tick tick) const;

 private:
  HealthMessage found_;
};

/// For programs that ask by HTTP (docs/host.md), with a line's end.
std::string health_answer(const HealthMessage& health);

}  // namespace scree
