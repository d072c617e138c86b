// Writes what a synthesiser was told and the samples that it made, for comparison with sound.wasm
// (sound.mjs): a crowd of events of all kinds and sizes, near and far. A step is a count of events, their
// bytes, a count of frames, and their samples.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "client/viewer/synthesis/synthesiser.h"

namespace {

template <typename Value>
void put(const Value* values, size_t count) {
  std::fwrite(values, sizeof(Value), count, stdout);
}

scree::SoundEvent any_event(scree::Random& random) {
  scree::SoundEvent event;
  event.kind = static_cast<scree::PieceEventKind>(random.below(7));
  event.size_m = 0.05F + 3.0F * random.unit() * random.unit();
  event.mass_kg = (300.0F + 7000.0F * random.unit()) * event.size_m * event.size_m * event.size_m;
  event.impulse_n_s = event.mass_kg * (0.4F + 9.0F * random.unit());
  event.pitch = 0.2F + 2.0F * random.unit();
  event.damping_s = 0.01F + random.unit();
  event.noise = random.unit();
  event.distance_m = 200.0F * random.unit() * random.unit();
  event.side = 2.0F * random.unit() - 1.0F;
  return event;
}

}  // namespace

int main() {
  scree::Synthesiser synthesiser;
  scree::Random random(1);
  for (int step = 0; step < 400; ++step) {
    std::vector<scree::SoundEvent> events(random.below(4) == 0 ? random.below(12) : 0);
    std::ranges::generate(events, [&] { return any_event(random); });
    const auto count = static_cast<uint32_t>(events.size());
    put(&count, 1);
    put(events.data(), count);
    for (const scree::SoundEvent& event : events) synthesiser.add(event);
    const uint32_t frames = 1 + random.below(1024);
    std::vector<float> samples(frames * scree::Synthesiser::channels);
    synthesiser.render(samples.data(), frames);
    put(&frames, 1);
    put(samples.data(), samples.size());
  }
}
