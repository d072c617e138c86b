#include "studies/scale/served_load.h"

#include <utility>

#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr double ticks_per_s_min = 59.0;
constexpr double carried_share_to_hold = 0.95;  ///< of the bots' turns
constexpr double carried_share_to_fit = 0.9;

}  // namespace

bool ServedLoad::holds() const {
  return carried_out() && reply_p99_ms <= reply_max_ms && carves_per_s >= carried_share_to_hold * turns_per_s;
}

bool ServedLoad::carried_out() const {
  return refused == 0.0 && lost == 0 && ticks_per_s >= ticks_per_s_min &&
         carves_per_s >= carried_share_to_fit * turns_per_s;
}

double reply_p99_of(std::vector<double> answered_ms, size_t unanswered) {
  answered_ms.insert(answered_ms.end(), unanswered, unanswered_ms);
  return quantile(std::move(answered_ms), 0.99);
}

}  // namespace scree
