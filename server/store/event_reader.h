// Reads a recording's log of events, and what is recorded of the machine. Every byte is checked. Owned by a
// RecordingReader; one thread at a time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/formats/event_codec.h"
#include "server/store/database.h"

namespace scree {

class EventReader {
 public:
  /// `database` must outlive it.
  static Result<EventReader> open(Database& database);

  /// Looks where the log begins, unless that is known.
  Result<void> find_start();
  /// The first tick that it covers; nothing when there is none, or none yet.
  std::optional<Tick> from() const { return from_; }

  /// The world's events of the ticks from … to, in order; and what is recorded of the machine there.
  Result<std::vector<Event>> events(Tick from, Tick to);
  Result<std::vector<RecordedMachine>> machine(Tick from, Tick to);
  /// The nearest tick with an event of the world, contacts apart, after that tick, up to `last`, or before
  /// it, from `first` on.
  Result<std::optional<Tick>> next(Tick tick, Tick last);
  Result<std::optional<Tick>> previous(Tick tick, Tick first);

 private:
  explicit EventReader(Database& database) : database_(&database) {}
  Result<std::optional<Tick>> tick_of(const std::string& select);
  Result<std::optional<Tick>> beside_contacts(std::optional<Tick> tick,
                                              const std::function<std::string(Tick)>& select);
  tl::unexpected<Error> damaged(const std::string& what) const;

  Database* database_;
  std::optional<Tick> from_;
};

}  // namespace scree
