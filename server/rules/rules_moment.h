// What the functions of scripts reach while a handler runs: the world between two ticks, the commands of the
// next one, the persons who are there, and what the rules want of the network side. The thread that
// simulates has it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/command/joined_person.h"
#include "server/host/host_hooks.h"
#include "server/rules/sandbox/script.h"
#include "shared/base/random.h"
#include "shared/query/scene_maker.h"

namespace scree {

/// A person who is connected.
struct RulesPerson {
  JoinedPerson who;
  std::optional<glm::vec3> eye_m{};  ///< where the client says that it looks from; nothing: it said nothing
};
using RulesPersons = std::map<uint64_t, RulesPerson>;

/// By party (Command::party): the session of it that asked for something last. Persons without access tokens
/// share one with others of their address.
using RulesParties = std::map<uint64_t, uint64_t>;

/// A function that gets the reply to a request, in the tick after it was answered.
struct AwaitedReply {
  uint32_t request = 0;
  ScriptFunction function;
};

struct RulesMoment {
  /// Null while the files of a script load: then nothing of the world can be asked.
  const World* world = nullptr;
  TickCommands* commands = nullptr;  ///< null likewise
  const RulesPersons* persons = nullptr;
  const RulesParties* parties = nullptr;
  const HostActs* acts = nullptr;
  uint32_t* next_request = nullptr;  ///< numbers of the rules' own requests

  /// The scene of this moment, and every person on foot, made when they are first asked for.
  const QueryScene& scene();
  const std::vector<PersonPlace>& places();
  /// The session of who stands for a party: who of it asked last, and is here. 0: nobody is.
  uint64_t person_of(uint64_t party) const;

 private:
  std::unique_ptr<HeldScene> held_;
  std::optional<std::vector<PersonPlace>> places_;
};

}  // namespace scree
