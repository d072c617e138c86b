// Who the sessions are: for events and requests, which say sessions alone. Filled from events of sessions as
// they come, or as a recording has them. Not thread-safe.
#pragma once

#include <map>
#include <vector>

#include "proto/event.h"

namespace scree {

namespace limits {
/// Persons that are remembered, those who left included, for what they asked for may still come. Above: the
/// oldest session is forgotten.
inline constexpr size_t roster_max = 4096;
}  // namespace limits

class Roster {
 public:
  /// Takes who joined.
  void note(const Event& event) {
    if (event.kind == EventKind::join) add({event.session, event.text, event.token_id});
  }
  void add(const Participant& person) {
    persons_[person.session] = person;
    if (persons_.size() > limits::roster_max) persons_.erase(persons_.begin());
  }
  /// Without a name where the session is not known.
  Participant find(uint64_t session) const {
    const auto found = persons_.find(session);
    return found == persons_.end() ? Participant{session} : found->second;
  }
  /// By session.
  std::vector<Participant> all() const {
    std::vector<Participant> persons;
    for (const auto& [session, person] : persons_) persons.push_back(person);
    return persons;
  }

 private:
  std::map<uint64_t, Participant> persons_;
};

}  // namespace scree
