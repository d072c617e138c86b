// What a server asks of Agones' side-car, and how long it waits.
#pragma once

namespace scree::limits {

/// Milliseconds for one request, its connection included: the side-car is on the same machine.
inline constexpr long agones_request_ms = 2000;
/// Seconds from one sign of life to the next. Agones expects one in periodSeconds of the fleet, 5 by default.
inline constexpr double agones_health_s = 2.0;
/// Seconds until something that failed is tried again.
inline constexpr double agones_retry_s = 1.0;

}  // namespace scree::limits
