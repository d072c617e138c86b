#include "client/viewer/sound/speaker.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <thread>

#include "client/viewer/sound/synthesiser.h"

namespace scree {
namespace {

/// Samples of a buffer, and how many wait: 90 ms, within which an event is heard.
constexpr size_t buffer_frames = 1024;
constexpr size_t buffer_count = 4;
constexpr std::chrono::milliseconds pause{8};

/// Before other threads begin, for it sets variables of the environment. Where there is no card, ALSA says so
/// in ten lines on the standard error, and OpenAL in one; a person's own choice stays.
void silence_library_log() {
  ::setenv("ALSOFT_LOGLEVEL", "0", 0);
  if (!std::filesystem::exists("/dev/snd")) ::setenv("ALSOFT_DRIVERS", "-alsa,", 0);
}

}  // namespace

struct Speaker::Parts {
  std::unique_ptr<ALCdevice, ALCboolean (*)(ALCdevice*)> device{nullptr, alcCloseDevice};
  std::unique_ptr<ALCcontext, void (*)(ALCcontext*)> context{nullptr, alcDestroyContext};
  std::mutex mutex;
  Synthesiser synthesiser;  ///< guarded by mutex
  std::jthread thread;      ///< the only one that calls OpenAL after the start

  std::vector<int16_t> next();
  void run(const std::stop_token& stop);
};

std::vector<int16_t> Speaker::Parts::next() {
  const std::scoped_lock lock(mutex);
  std::vector<int16_t> steps;
  for (const float sample : synthesiser.render(buffer_frames))
    steps.push_back(static_cast<int16_t>(std::lround(sample * 32767.0F)));
  return steps;
}

void Speaker::Parts::run(const std::stop_token& stop) {
  ALuint source = 0;
  std::array<ALuint, buffer_count> buffers{};
  alGenSources(1, &source);
  alGenBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
  const auto fill = [&](ALuint buffer) {
    const std::vector<int16_t> steps = next();
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

Result<std::unique_ptr<Speaker>> Speaker::open() {
  silence_library_log();
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

void Speaker::play(const std::vector<PieceEvent>& events, const Ears& ears) {
  const std::scoped_lock lock(parts_->mutex);
  for (const PieceEvent& event : events) parts_->synthesiser.add(event, ears);
}

}  // namespace scree
