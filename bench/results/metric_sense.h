// Which way a metric is better, as its name says. A name ends in its unit, or in its unit and "_at_SIZE";
// a peer's figure begins with "peer_", or the name of what it is measured by.
#pragma once

#include <cstdint>
#include <string_view>

namespace scree {

enum class Better : uint8_t { unknown, lower, higher };

struct MetricSense {
  Better better = Better::unknown;
  /// Differences below this share are none, whatever the runs say: the runs of one file follow each other,
  /// those of another one are of another hour.
  double floor = 0.0;
};

/// The sense of peers' figures is unknown, and so is that of counts that only say how much was done.
MetricSense sense_of(std::string_view metric);

}  // namespace scree
