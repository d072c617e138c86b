// Reads a recording. Every byte is checked: a file that is no recording, of another program or release, cut
// short or damaged is refused with an error that names it. No content can crash the program. One thread at a
// time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/event.h"
#include "server/store/keyframe_reader.h"
#include "server/store/recording.h"
#include "shared/base/result.h"

namespace scree {

/// What a recording without any tick is: damaged, or one whose first tick will come.
enum class WithoutTicks : uint8_t { refused, awaited };

class RecordingReader {
 public:
  /// All that is read from now on is of this moment, whatever is written or dropped meanwhile, until
  /// let_go(); as long its writer's log grows.
  static Result<std::unique_ptr<RecordingReader>> open(const std::string& path,
                                                       WithoutTicks without_ticks = WithoutTicks::refused);
  ~RecordingReader();

  const std::string& path() const;
  const RecordingHeader& header() const;
  /// As of open(), or of refresh(), while somebody still writes: the recording holds the ticks
  /// first_tick() … last_tick() without a gap, at least one, or 1 … 0 while they are awaited. Where the first
  /// is not 1, there is a state() before it, from which it is simulated: by commands alone up to the first
  /// tick.
  Tick first_tick() const;
  Tick last_tick() const;
  uint64_t keyframes() const;  ///< from which a replay can begin without the ones before
  uint64_t bytes() const;      ///< of the file, and of the log beside it, if there is one
  /// Whether who recorded came to an end: else the recording is being written, or was cut short, by a crash
  /// perhaps; it is whole up to last_tick() all the same.
  bool is_ended() const;
  /// It has not ended, and there was no log beside it: if it was copied while it was written, what came last
  /// is missing.
  bool may_lack_ticks() const;
  /// Looks again how far a recording goes that is being written, and from where on, if it is a ring; what is
  /// read from now on is of this moment. Refuses one whose last ticks were taken back, with their world.
  Result<void> refresh();
  /// Until refresh() what is read is of no one moment; a ring may drop ticks that it had.
  void let_go();

  /// The world after the tick, where the simulation of the next one began with it; most ticks have none. It
  /// has no bricks: its terrain comes chunk by chunk.
  Result<std::optional<WorldSnapshot>> state(Tick tick);
  /// The terrain of a state: KeyframeReader's functions.
  Result<void> each_chunk(Tick tick, const KeyframeReader::ChunkVisitor& visit);
  Result<bool> has_chunk(ChunkCoord chunk, uint64_t hash, Tick tick);
  Result<std::vector<BrickPatch>> chunk(ChunkCoord chunk, uint64_t hash);
  /// The latest tick up to `tick` whose state() there is; 0 when there is none: then a world begins
  /// untouched.
  Result<Tick> state_before(Tick tick);
  /// `tick` within first_tick() … last_tick().
  Result<RecordedFrame> frame(Tick tick);
  /// The commands of a tick up to last_tick(), after the state before first_tick(); most ticks have none.
  Result<std::vector<Command>> commands(Tick tick);
  /// The first tick that the log of events covers; nothing when the recording has no log.
  std::optional<Tick> events_from() const;
  /// What happened in a tick that the log covers; most ticks have nothing. The machine's events are those of
  /// machine().
  Result<std::vector<Event>> events(Tick tick);
  /// The world's events of the ticks from … to, in order; and what is recorded of the machine there.
  Result<std::vector<Event>> events(Tick from, Tick to);
  Result<std::vector<RecordedMachine>> machine(Tick from, Tick to);
  /// The nearest tick with an event of the world, contacts apart, after, or before, that tick; nothing when
  /// there is none.
  Result<std::optional<Tick>> next_event(Tick tick);
  Result<std::optional<Tick>> previous_event(Tick tick);
  /// The latest keyframe up to `tick`, which is at most last_tick(); nothing when there is none: then play
  /// from tick 1.
  Result<std::optional<RecordedKeyframe>> keyframe_before(Tick tick);
  /// The same without what is known.
  Result<std::optional<KeyframeParts>> keyframe_before(Tick tick, const KnownParts& known);
  /// Its tick; 0 when there is none.
  Result<Tick> keyframe_tick_before(Tick tick);

 private:
  struct State;
  static Result<std::unique_ptr<RecordingReader>> open_as_it_lies(const std::string& path,
                                                                  WithoutTicks without_ticks);
  explicit RecordingReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
