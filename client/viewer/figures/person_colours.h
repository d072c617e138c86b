// Colours of persons, as unlike each other as there is room: each keeps its own as long as it is there, and
// no two have the same.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "client/render/scene/line_list.h"

namespace scree {

class PersonColours {
 public:
  /// Who is there from now on, by session: who comes gets a colour far from all others, who goes gives it
  /// back.
  void follow(std::span<const uint64_t> sessions);
  /// White of who is not there.
  LineColour of(uint64_t session) const;

 private:
  std::map<uint64_t, int> places_;  ///< in the row of colours
};

}  // namespace scree
