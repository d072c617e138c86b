#include "client/viewer/sound/speaker.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <thread>

#include "client/viewer/synthesis/synthesiser.h"

namespace scree {
namespace {

/// Samples of a buffer, and how many wait: 85 ms, within which an event is heard.
constexpr size_t buffer_frames = 1024;
constexpr size_t buffer_count = 4;
constexpr std::chrono::milliseconds pause{8};

}  // namespace

struct Speaker::Parts {
  std::unique_ptr<ALCdevice, ALCboolean (*)(ALCdevice*)> device{nullptr, alcCloseDevice};
  std::unique_ptr<ALCcontext, void (*)(ALCcontext*)> context{nullptr, alcDestroyContext};
  std::mutex mutex;
  Synthesiser synthesiser;  ///< guarded by mutex
  std::jthread thread;      ///< the only one that calls OpenAL after the start

  std::array<int16_t, buffer_frames * Synthesiser::channels> next();
  void run(const std::stop_token& stop);
};

std::array<int16_t, buffer_frames * Synthesiser::channels> Speaker::Parts::next() {
  std::array<float, buffer_frames * Synthesiser::channels> samples;
  {
    const std::scoped_lock lock(mutex);
    synthesiser.render(samples.data(), buffer_frames);
  }
  std::array<int16_t, samples.size()> steps;
  std::ranges::transform(samples, steps.begin(),
                         [](float sample) { return static_cast<int16_t>(std::lround(sample * 32767.0F)); });
  return steps;
}

void Speaker::Parts::run(const std::stop_token& stop) {
  ALuint source = 0;
  std::array<ALuint, buffer_count> buffers{};
  alGenSources(1, &source);
  alGenBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
  const auto fill = [&](ALuint buffer) {
    const auto steps = next();
    alBufferData(buffer, AL_FORMAT_STEREO16, steps.data(),
                 static_cast<ALsizei>(steps.size() * sizeof(int16_t)), Synthesiser::rate_hz);
    alSourceQueueBuffers(source, 1, &buffer);
  };
  for (const ALuint buffer : buffers) fill(buffer);
  while (!stop.stop_requested()) {
    ALint played = 0, state = 0;
    alGetSourcei(source, AL_BUFFERS_PROCESSED, &played);
    for (; played > 0; --played) {
      ALuint buffer = 0;
      alSourceUnqueueBuffers(source, 1, &buffer);
      fill(buffer);
    }
    alGetSourcei(source, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING) alSourcePlay(source);
    std::this_thread::sleep_for(pause);
  }
  alSourceStop(source);
  alDeleteSources(1, &source);
  alDeleteBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
}

void Speaker::silence_library_log() {
  ::setenv("ALSOFT_LOGLEVEL", "0", 0);
  if (!std::filesystem::exists("/dev/snd")) ::setenv("ALSOFT_DRIVERS", "-alsa,", 0);
}

Result<std::unique_ptr<Speaker>> Speaker::open() {
  auto parts = std::make_unique<Parts>();
  parts->device.reset(alcOpenDevice(nullptr));
  if (!parts->device) return fail("there is no device to play sound on");
  parts->context.reset(alcCreateContext(parts->device.get(), nullptr));
  if (!parts->context || alcMakeContextCurrent(parts->context.get()) != ALC_TRUE)
    return fail("the device for sound cannot be used");
  return std::unique_ptr<Speaker>(new Speaker(std::move(parts)));
}

Speaker::Speaker(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  parts_->thread = std::jthread([of = parts_.get()](const std::stop_token& stop) { of->run(stop); });
}

Speaker::~Speaker() {
  parts_->thread.request_stop();
  parts_->thread.join();
  alcMakeContextCurrent(nullptr);
}

void Speaker::play(std::span<const SoundEvent> events) {
  const std::scoped_lock lock(parts_->mutex);
  for (const SoundEvent& event : events) parts_->synthesiser.add(event);
}

}  // namespace scree
