// What a synthesiser needs of an event, from the ears of who hears it: plain numbers, whose bytes the page
// hands from scree.wasm to sound.wasm.
#pragma once

#include "client/viewer/events/piece_event_kind.h"

namespace scree {

struct SoundEvent {
  PieceEventKind kind = PieceEventKind::strike;
  float size_m = 1.0F;       ///< side of a cube of its volume
  float mass_kg = 2600.0F;   ///< above 0
  float impulse_n_s = 0.0F;  ///< that it had, gave or lost
  float pitch = 1.0F;        ///< of its modes, relative to rock of the same size
  float damping_s = 0.05F;   ///< time in which the ringing of a cube of 1 m falls to 1/e
  float noise = 0.6F;        ///< share of noise in a blow, 0 to 1
  float distance_m = 3.0F;   ///< to the ears
  float side = 0.0F;         ///< −1: on the left; 1: on the right
};
static_assert(sizeof(SoundEvent) == 9 * sizeof(float), "no padding: its bytes are passed on");

}  // namespace scree
