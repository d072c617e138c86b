// A client's own person on foot, foreseen: inputs are carried out at once over the mirror, by the kernel that
// the server has, and carried out again from the server's state whenever that is another one than was
// foreseen. On ground that lies still both get the same bits, so there is nothing to correct. No clock: one
// step is one tick of the server's.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "client/mirror/mirror.h"
#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"

namespace scree {

/// The ground of a walker there, as of the mirror's last frame: without the bodies of persons, who do not
/// stand in each other's way. It holds until the next message is applied.
SolidGround ground_of(const Mirror& mirror, glm::vec3 about_m);

/// Whether the server's settings say that it moves persons on foot. False before the first status.
bool persons_walk(const std::optional<StatusMessage>& status);

struct WalkCorrections {
  uint64_t inputs = 0;  ///< sent
  uint64_t count = 0;   ///< the foreseen place was off by more than a millimetre
  double sum_m = 0.0;
  float worst_m = 0.0F;
};

class WalkPrediction {
 public:
  explicit WalkPrediction(uint32_t tick_rate_hz);

  /// Takes what the server has told of the person since the last call, and corrects by it.
  void follow(const Mirror& mirror);
  /// Whether the server has put the person on foot. The others need it.
  bool on_foot() const { return told_.has_value(); }
  const Walker& walker() const { return walker_; }
  /// Carries out an input, which is to be sent. Nothing while the server has not taken the inputs of
  /// limits::walk_untaken_max_s.
  std::optional<WalkMessage> step(const WalkInput& input, glm::vec3 look, const Mirror& mirror);
  const WalkCorrections& corrections() const { return corrections_; }

 private:
  struct Untaken {
    uint32_t number = 0;
    WalkInput input;
    WalkerState after;  ///< as foreseen
  };

  bool was_foreseen(const OwnPerson& told);
  void carry_out_again(const Mirror& mirror);

  float tick_s_;
  size_t untaken_max_;
  Walker walker_{glm::vec3(0.0F)};
  std::optional<OwnPerson> told_;
  std::deque<Untaken> untaken_;
  uint32_t last_ = 0;  ///< number of the last input
  WalkCorrections corrections_;
};

}  // namespace scree
