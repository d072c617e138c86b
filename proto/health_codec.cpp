#include "proto/health_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/limits.h"
#include "shared/base/text.h"

namespace scree {

void write(wire::Health& to, const HealthMessage& from) {
  to.set_alive(from.alive);
  to.set_well(from.well);
  to.set_ready(from.ready);
  to.set_tick(from.tick);
  const size_t count = std::min(from.faults.size(), limits::health_faults_max);
  for (size_t i = 0; i < count; ++i) {
    wire::HealthFault& fault = *to.add_faults();
    fault.set_name(showable(from.faults[i].name, limits::refusal_name_bytes_max));
    fault.set_words(showable(from.faults[i].words, limits::reason_bytes_max));
  }
}

HealthMessage read(const wire::Health& from, FieldChecker& check) {
  HealthMessage health{from.alive(), from.well(), from.ready(), from.tick(), {}};
  if (static_cast<size_t>(from.faults_size()) > limits::health_faults_max)
    check.refuse(fmt::format("more than {} faults", limits::health_faults_max));
  for (const wire::HealthFault& fault : from.faults()) {
    if (check.failed()) break;
    health.faults.push_back({check.text(fault.name(), limits::refusal_name_bytes_max, "name of a fault"),
                             check.text(fault.words(), limits::reason_bytes_max, "words of a fault")});
  }
  return health;
}

}  // namespace scree
