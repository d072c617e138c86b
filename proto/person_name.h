// What a person is called.
#pragma once

#include <cstdint>
#include <string>

namespace scree {

/// By the name that the person gave, else by the number of the session.
inline std::string called(uint64_t session, const std::string& name) {
  return name.empty() ? "client " + std::to_string(session) : name;
}

}  // namespace scree
