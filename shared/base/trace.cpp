#include "shared/base/trace.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>

#include "shared/base/check.h"

namespace scree {
namespace {

void append(std::string& text, std::string_view more) {
  text.append(more.data(), more.size());
}

void append_number(std::string& text, double number) {
  char digits[40];
  const int length = std::snprintf(digits, sizeof digits, "%.3f", number);
  text.append(digits, static_cast<size_t>(std::max(length, 0)));
}

/// Perfetto shows a track by its thread's name.
void append_track_names(std::string& text, const std::map<std::string_view, int>& tracks) {
  for (const auto& [name, number] : tracks) {
    append(text, R"({"ph":"M","pid":1,"name":"thread_name","tid":)");
    append(text, std::to_string(number));
    append(text, R"(,"args":{"name":")");
    append(text, name);
    append(text, "\"}},\n");
  }
}

}  // namespace

void Trace::add(const Event& event) {
  CHECK(!event.name.empty());
  const std::lock_guard lock(mutex_);
  if (events_.size() < trace_spans_max) {
    events_.push_back(event);
    return;
  }
  events_[next_] = event;
  next_ = (next_ + 1) % trace_spans_max;
}

void Trace::span(std::string_view track, std::string_view name, Clock::time_point begin, double duration_ms) {
  CHECK(!track.empty());  // an event without a track is a value
  add({track, name, begin, duration_ms});
}

void Trace::value(std::string_view name, Clock::time_point at, double value) {
  add({{}, name, at, value});
}

std::vector<Trace::Event> Trace::in_order() const {
  std::vector<Event> events;
  {
    const std::lock_guard lock(mutex_);
    events = events_;
  }
  std::ranges::stable_sort(events, {}, &Event::begin);
  return events;
}

std::string Trace::to_json() const {
  const std::vector<Event> events = in_order();
  std::map<std::string_view, int> tracks;
  for (const Event& event : events)
    if (!event.track.empty()) tracks.try_emplace(event.track, static_cast<int>(tracks.size()) + 1);
  std::string text = "{\"traceEvents\":[\n";
  append_track_names(text, tracks);
  for (const Event& event : events) {
    const bool counts = event.track.empty();
    append(text, counts ? R"({"ph":"C","pid":1,"name":")" : R"({"ph":"X","pid":1,"name":")");
    append(text, event.name);
    append(text, R"(","ts":)");
    append_number(text,
                  std::chrono::duration<double, std::micro>(event.begin - events.front().begin).count());
    if (counts) {
      append(text, R"(,"args":{"value":)");
      append_number(text, event.amount);
      append(text, "}},\n");
    } else {
      append(text, R"(,"tid":)");
      append(text, std::to_string(tracks.at(event.track)));
      append(text, R"(,"dur":)");
      append_number(text, event.amount * 1000.0);
      append(text, "},\n");
    }
  }
  append(text, R"({"ph":"M","pid":1,"name":"process_name","args":{"name":"scree"}}]})");
  append(text, "\n");
  return text;
}

Result<void> Trace::write(const std::string& file) const {
  std::ofstream out(file, std::ios::binary);
  out << to_json();
  if (out.flush()) return {};
  return fail("the trace cannot be written to " + file + " (--trace)");
}

}  // namespace scree
