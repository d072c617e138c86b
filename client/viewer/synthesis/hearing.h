// What a person hears of what pieces do, as a synthesiser needs it.
#pragma once

#include "client/render/scene/camera.h"
#include "client/viewer/events/piece_event.h"
#include "client/viewer/synthesis/sound_event.h"

namespace scree {

/// By ears at the camera's eye.
SoundEvent heard(const PieceEvent& event, const Camera& camera);

}  // namespace scree
