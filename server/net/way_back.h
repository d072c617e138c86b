// The way from the persons of an edge to the server that simulates their world: an edge shows a world that it
// cannot change, and hands on what its persons ask. Answers come by NetServer::send(). All calls are on the
// network thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "proto/messages.h"
#include "server/command/refusal.h"

namespace scree {

class WayBack {
 public:
  virtual ~WayBack() = default;

  /// Who has joined, with what he showed at the door: the simulating server looks at it itself.
  virtual void joined(uint64_t session, const HelloMessage& hello) = 0;
  virtual void left(uint64_t session) = 0;
  /// Hands a request on, which `message` is, and by its number; a refusal is the answer. `eye_m`: where the
  /// session's person looks from.
  virtual tl::expected<void, Refused> ask(uint64_t session, glm::vec3 eye_m, uint32_t request,
                                          const ClientMessage& message) = 0;
};

}  // namespace scree
