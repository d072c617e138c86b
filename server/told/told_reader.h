// Reads a world from a bus, in an edge: a keyframe, the ticks behind it that the stream keeps, and then live
// ones, without a gap. Where one is missing, or the connection was lost, it reads what the stream has, from
// the last keyframe on where that is needed.
//
// Nothing that comes is trusted: what cannot be read is counted and left out. A thread of its own reads and
// decodes; next() and the other calls are from one other thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "server/bus/bus.h"
#include "server/formats/bus_codec.h"
#include "server/formats/recording_codec.h"

namespace scree {

/// The world after a tick, wherever the reader's owner stood.
struct ReadKeyframe {
  uint64_t run = 0;
  Tick tick = 0;
  ToldKeyframe told;
};
/// The next tick.
struct ReadTick {
  uint64_t run = 0;
  RecordedFrame frame;
};
using ReadTold = std::variant<ReadKeyframe, ReadTick>;

struct ReaderStatus {
  bool connected = false;
  std::string fault;       ///< why nothing comes; empty: nothing is known to be wrong
  uint64_t ticks = 0;      ///< read
  uint64_t keyframes = 0;  ///< read
  uint64_t catch_ups = 0;  ///< times that the stream was read
  uint64_t refused = 0;    ///< messages that could not be read, or were not the world's
  size_t waiting = 0;      ///< ticks that are read and not taken
};

class ToldReader {
 public:
  static Result<std::unique_ptr<ToldReader>> start(std::shared_ptr<Bus> bus, const std::string& world);
  ~ToldReader();
  ToldReader(const ToldReader&) = delete;
  ToldReader& operator=(const ToldReader&) = delete;

  /// What comes next; waits for it so long.
  std::optional<ReadTold> next(double wait_s);
  /// What was read does not agree with itself: only a keyframe helps. What waits is dropped.
  void begin_anew();

  ReaderStatus status() const;

 private:
  struct State;
  explicit ToldReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
