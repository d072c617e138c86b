// sound.wasm: the synthesiser (client/viewer/synthesis) alone, for a browser's thread of sound. It has its
// own memory and no imports, so that any thread of a page can make one of it. page/sound_worklet.js calls it.
//
//   memory                     its bytes
//   _initialize()              first
//   sound_events()             place of 96 events, as scree.wasm's scree_sounds() gives them
//   sound_event_bytes()        of one
//   sound_add(count)           the first `count` of these sound from the next sample on
//   sound_render(frames)       makes so many samples, 1024 at most; their place: 32-bit floats, left and
//   right in turn
#include "client/viewer/synthesis/synthesiser.h"

namespace {

constexpr size_t frames_max = 1024;

scree::Synthesiser synthesiser;
scree::SoundEvent events[scree::limits::sound_events_max];
float samples[frames_max * scree::Synthesiser::channels];

}  // namespace

extern "C" {

scree::SoundEvent* sound_events() {
  return events;
}

uint32_t sound_event_bytes() {
  return sizeof(scree::SoundEvent);
}

void sound_add(uint32_t count) {
  for (uint32_t i = 0; i < count && i < scree::limits::sound_events_max; ++i) synthesiser.add(events[i]);
}

const float* sound_render(uint32_t frames) {
  synthesiser.render(samples, frames < frames_max ? frames : frames_max);
  return samples;
}
}
