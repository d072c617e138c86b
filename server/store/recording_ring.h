// How much of a recording is kept: of a ring the last minutes, or bytes. It consists of parts that begin with
// a world's value, and the oldest are dropped whole, so that what remains plays and verifies. One thread at a
// time.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "shared/base/ids.h"
#include "shared/base/result.h"

namespace scree {

namespace limits {
/// Bounds of a ring. A shorter one would begin parts all the time and tell little. A ring of bytes keeps as
/// many seconds, whatever they take. More seconds are refused as mistaken.
inline constexpr double ring_seconds_min = 10.0, ring_seconds_max = 1.0e7;
/// A minute of a storm of ten carves a second takes 50 MB (bench replay): less keeps next to nothing, and is
/// refused. So are more bytes, as mistaken.
inline constexpr uint64_t ring_bytes_min = 64'000'000, ring_bytes_max = 100'000'000'000'000;
}  // namespace limits

/// At most one of them; neither: all is kept.
struct RingLimit {
  double seconds = 0.0;
  uint64_t bytes = 0;

  bool is_on() const { return seconds > 0.0 || bytes > 0; }
  double part_seconds() const { return (seconds > 0.0 ? seconds : limits::ring_seconds_min) / 8.0; }
  uint64_t part_bytes() const { return bytes / 8; }
  /// The bytes of SQLite's log beside the file, which count, too; for all recordings.
  uint64_t log_bytes() const;
  bool operator==(const RingLimit&) const = default;
};

/// Whether a part should begin: soon, in a tick in which that costs little, or now, since the last one is
/// twice as long as parts should be.
enum class PartWish : uint8_t { none, soon, now };

/// What a recording takes on the disk.
struct RecordingSize {
  uint64_t file_bytes = 0, log_bytes = 0;
  uint64_t disk_free_bytes = 0;  ///< where the file lies, by a Recorder; 0: nobody knows
  std::string over_limit;        ///< why a ring takes more than it may, in words; empty: it does not
  uint64_t bytes() const { return file_bytes + log_bytes; }
};

/// "90s", "10m" or "2h"; "500M", "2G" or "1T" (of 10^6, 10^9 and 10^12 bytes).
Result<RingLimit> ring_limit_of(const std::string& text);

class RecordingRing {
 public:
  /// From the tick of a world's value on.
  struct Part {
    Tick tick = 0;
    PieceId next_piece = 0;  ///< to be made, at that tick
  };

  RecordingRing(RingLimit limit, uint32_t tick_rate_hz) : limit_(limit), tick_rate_hz_(tick_rate_hz) {}

  /// `bytes`: that the recording's pages take now, without the log.
  void begin(const Part& part, uint64_t bytes);
  PartWish wish(Tick tick, uint64_t bytes) const;
  /// The first part that stays, when those before it are to be dropped.
  const Part* first_to_stay(Tick tick, uint64_t bytes) const;
  /// Those before the first one that stays are gone.
  void drop_before(Tick tick, uint64_t bytes);
  /// Why the limit is not kept, after what could be dropped was; empty: it is kept.
  std::string over_limit(const RecordingSize& size, uint64_t bytes) const;

 private:
  double seconds_since(Tick tick, Tick now) const {
    return static_cast<double>(now - tick) / static_cast<double>(tick_rate_hz_);
  }

  /// For pages.
  uint64_t room() const { return limit_.bytes - limit_.log_bytes(); }

  RingLimit limit_;
  uint32_t tick_rate_hz_;
  std::deque<Part> parts_;
  uint64_t bytes_before_ = 0;  ///< at the beginning of the last part
};

}  // namespace scree
