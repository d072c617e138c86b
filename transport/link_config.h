// What a simulated link is like, for tests, benches and clients told so by --link: a value, and its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// One direction of a link.
struct LinkWay {
  double delay_s = 0.0;           ///< that every byte takes
  double jitter_s = 0.0;          ///< that each packet takes at most in addition; none overtakes another
  double rate_bytes_per_s = 0.0;  ///< 0: as fast as they come
  size_t buffer_bytes = 0;        ///< of the bottleneck; 0: as of buffer_of()
  std::optional<uint64_t> cut_bytes{};        ///< after so many bytes the link breaks, both ways
  std::optional<uint64_t> half_open_bytes{};  ///< after so many bytes nothing passes, and nobody is told

  bool operator==(const LinkWay&) const = default;
};

struct LinkConfig {
  LinkWay up;    ///< from the end that is wrapped
  LinkWay down;  ///< to it
  uint64_t random_seed = 1;

  bool operator==(const LinkConfig&) const = default;
};

/// Bytes that wait at the bottleneck, at most: as given, or those of limits::link_buffer_s.
size_t buffer_of(const LinkWay& way);

/// Reads "delay=50ms,jitter=20ms,rate=1Mbit,buffer=16kB,cut=100000,half-open=50000,seed=7": any of them, in
/// any order, each once. All but the seed hold for both directions, or for one: "down.rate=100kbit",
/// "up.cut=2000", which overrides the value for both. The error names the part that is wrong, and how it is
/// written.
Result<LinkConfig> read_link(std::string_view text);

}  // namespace scree
