// Persons and what they say to each other, as messages of the wire (proto/talk.proto).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/role.h"

namespace scree {

// ---- client to server

/// A line to all persons in the world; at most limits::line_bytes_max.
struct SayMessage {
  std::string text;
};

// ---- server to client

struct Person {
  uint64_t session = 0;
  std::string name;
  Role role = Role::viewer;

  bool operator==(const Person&) const = default;
};

/// The persons in the world, wherever they are, the receiver among them; by session.
struct PersonsMessage {
  std::vector<Person> persons;
  uint32_t more = 0;  ///< persons that are left out
  bool chat = false;  ///< the server passes lines on

  bool operator==(const PersonsMessage&) const = default;
};

/// A line that a person said to all, or the server (session 0) to the receiver alone.
struct SaidMessage {
  uint64_t session = 0;
  std::string name;
  std::string text;
};

}  // namespace scree
