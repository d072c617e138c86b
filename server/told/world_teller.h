// Tells a world over a bus, tick by tick, as a recording keeps it (server/formats/bus.proto), so that edges
// can show it. A stream of bounded size keeps the ticks and a keyframe every so often, from which edges
// begin.
//
// A thread of its own encodes and sends. The simulation hands over a pointer and never waits. Where the bus
// is away or slow, ticks are given up and counted, and a keyframe follows as soon as it is back. Where the
// thread itself falls behind by limits::told_waiting_max ticks, it asks for the world anew (wants_start()).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/bus/bus.h"
#include "server/store/recording.h"
#include "server/store/retry_pause.h"
#include "server/told/limits.h"
#include "server/world/tick_delta.h"
#include "shared/base/result.h"

namespace scree {

struct TellerConfig {
  std::string world;         ///< its name on the bus (is_bus_name)
  uint32_t stream_mb = 256;  ///< of the stream
  /// Between two keyframes of a world that changes.
  double keyframe_s = limits::told_keyframe_s;
  uint64_t world_number = 0;  ///< as of WelcomeMessage::world
  bool in_memory = false;     ///< the stream is in the memory of the server of NATS
};

struct TellerStatus {
  StoreHealth health;  ///< `lost`: ticks that were not told
  bool connected = false;
  uint64_t ticks = 0;  ///< told
  uint64_t keyframes = 0;
  uint64_t bytes = 0;  ///< of ticks
  uint64_t keyframe_bytes = 0;
  uint64_t last_keyframe_bytes = 0;
  size_t waiting = 0;  ///< ticks
};

class WorldTeller {
 public:
  /// `bus` is used by the teller's thread until stop(). `run`: as of ToldPart.
  static Result<std::unique_ptr<WorldTeller>> start(std::shared_ptr<Bus> bus, const TellerConfig& config,
                                                    const RecordingHeader& header, uint64_t run);
  /// Calls stop().
  ~WorldTeller();
  WorldTeller(const WorldTeller&) = delete;
  WorldTeller& operator=(const WorldTeller&) = delete;

  /// Whether begin() is due: at first, and after ticks were given up. From any thread.
  bool wants_start() const;
  /// The world as it stands after the last tick that was pushed (World::keyframe). `read`: as of
  /// RecordingStart; it is used by the teller's thread. From one thread, as push().
  void begin(TickDelta keyframe, ReadChunk read);
  /// The next tick. It is given up, and counted, while wants_start().
  void push(std::shared_ptr<const TickDelta> delta);

  /// From any thread.
  TellerStatus status() const;

  /// Tells what waits, as far as the bus takes it now, and joins the thread.
  void stop();

 private:
  struct State;
  explicit WorldTeller(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
