// How a Recorder begins.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "server/log/log.h"
#include "server/store/recorder_state.h"
#include "server/store/schema.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

namespace scree {

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path, const RecordingHeader& header,
                                                   RingLimit limit) {
  auto writer = TRY(RecordingWriter::create(path, header, limit));
  auto state = std::make_unique<State>(path, header, limit);
  state->begin_at(std::move(writer), 0);
  return start(std::move(state));
}

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path, const RecordingHeader& header,
                                                   const RecordingStart& from, RingLimit limit) {
  std::error_code ignored;
  auto writer = std::filesystem::exists(path, ignored) ? RecordingWriter::resume(path, header, from, limit)
                                                       : RecordingWriter::create(path, header, from, limit);
  TRY(writer);
  auto state = std::make_unique<State>(path, header, limit);
  state->begin_at(std::move(*writer), from.keyframe.tick);
  return start(std::move(state));
}

namespace {

using Made = Result<std::unique_ptr<RecordingWriter>>;

Made new_part(const std::string& path, const RecordingHeader& header, const RecordingStart* from,
              RingLimit limit) {
  return from == nullptr ? RecordingWriter::create(path, header, limit)
                         : RecordingWriter::create(path, header, *from, limit);
}

/// Goes on with the newest part that the world reaches to; else begins another one.
Made fitting_part(const std::string& path, const RecordingHeader& header, const RecordingStart* from,
                  RingLimit limit) {
  const std::vector<std::string> parts = recording_parts(path);
  std::string why = (parts.empty() ? path : parts.back()) + " is there already";
  for (auto part = parts.rbegin(); part != parts.rend() && from != nullptr; ++part) {
    auto resumed = RecordingWriter::resume(*part, header, *from, limit);
    if (resumed || Database::may_pass(resumed.error())) return resumed;
    if (part == parts.rbegin()) why = resumed.error().message;
  }
  const std::string part = TRY(next_recording_part(path));
  auto made = new_part(part, header, from, limit);
  if (made && part != path) log_of(LogPart::store).warn("the session is recorded to {}: {}", part, why);
  return made;
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::open(const std::string& path, const RecordingHeader& header,
                                                 const RecordingStart* from, RingLimit limit) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (is_foreign(path, schema::recording))
    return fail(path + " is no recording, and is not overwritten: choose another name (--record)");
  if (const fs::path folder = fs::path(path).parent_path();
      !folder.empty() && !fs::is_directory(folder, ignored))
    return fail(path + " cannot be made: there is no folder " + folder.string() + " (--record)");
  const bool is_first = recording_parts(path).empty();  // a path that never served may be mistaken
  LeftParts left(path);
  left.find();
  auto made = fitting_part(path, header, from, limit);
  const auto is_passing = [&](const Error& error) {
    return is_first ? Database::is_refusal(error) : Database::may_pass(error);
  };
  if (!made && !is_passing(made.error())) return tl::unexpected(made.error());
  auto state = std::make_unique<State>(path, header, limit);
  state->left = std::move(left);
  if (made)
    state->begin_at(std::move(*made), from == nullptr ? 0 : from->keyframe.tick);
  else
    state->fails_from_the_start(made.error());
  return start(std::move(state));
}

void Recorder::State::fails_from_the_start(const Error& why) {
  accepts = false;
  note(tl::unexpected(why));
}

std::unique_ptr<Recorder> Recorder::start(std::unique_ptr<State> state) {
  state->thread = std::thread([s = state.get()] { s->run(); });
  return std::unique_ptr<Recorder>(new Recorder(std::move(state)));
}

}  // namespace scree
