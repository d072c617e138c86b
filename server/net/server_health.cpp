#include "server/net/server_health.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace scree {

void ServerHealth::add(HealthKind kind, std::string words) {
  const HealthRow row = row_of(kind);
  found_.faults.push_back({std::string(row.name), std::move(words)});
  if (row.level == HealthLevel::life) found_.alive = false;
  if (row.level != HealthLevel::place) found_.well = false;
  if (row.level != HealthLevel::promise) found_.ready = false;
}

HealthMessage ServerHealth::as_of(Tick tick) const {
  HealthMessage health = found_;
  health.tick = tick;
  return health;
}

std::string health_answer(const HealthMessage& health) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const HealthFault& fault : health.faults)
    faults.push_back({{"name", fault.name}, {"words", fault.words}});
  const nlohmann::ordered_json json{{"alive", health.alive},
                                    {"well", health.well},
                                    {"ready", health.ready},
                                    {"tick", health.tick},
                                    {"faults", std::move(faults)}};
  return json.dump() + "\n";
}

}  // namespace scree
