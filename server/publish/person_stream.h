// What one client is told of persons on foot (PersonPlaces in proto/person.proto): whose bodies are which
// props, and its own person's exact state, by which it corrects what it foresaw.
#pragma once

#include <cstdint>
#include <optional>

#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class PersonStream {
 public:
  /// With poses, or when persons came or went.
  void serve(const ServedTick& tick, bool with_poses, Outlet& outlet, ServedPart& part);
  /// The client knows nobody any more.
  void forget() {
    version_ = 0;
    own_.reset();
  }

 private:
  uint64_t version_ = 0;  ///< PublishedState::persons_version() as told
  std::optional<OwnPerson> own_;
};

}  // namespace scree
