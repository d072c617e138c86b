// Who is meant by what a host's rules show or tell.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "shared/base/kind_table.h"

namespace scree {

/// The numbers are those on the wire and in files.
enum class AudienceKind : uint8_t { all, session, team };

struct AudienceKindRow {
  std::string_view name;
};

constexpr AudienceKindRow row_of(AudienceKind kind) {
  switch (kind) {
    case AudienceKind::all:
      return {"all"};
    case AudienceKind::session:
      return {"session"};
    case AudienceKind::team:
      return {"team"};
  }
  return {};
}

struct Audience {
  AudienceKind kind = AudienceKind::all;
  uint64_t session = 0;  ///< of AudienceKind::session; else 0
  std::string team{};    ///< of AudienceKind::team; else empty

  bool operator==(const Audience&) const = default;
  bool operator<(const Audience& other) const {
    return std::tie(kind, session, team) < std::tie(other.kind, other.session, other.team);
  }
};

/// Whether someone of that session and team is meant.
bool is_meant(const Audience& audience, uint64_t session, const std::string& team);

}  // namespace scree
