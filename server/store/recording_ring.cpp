#include "server/store/recording_ring.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>

#include "server/store/limits.h"

namespace scree {

namespace {

struct Unit {
  char letter;
  double seconds;
  uint64_t bytes;
};
constexpr std::array units = {Unit{'s', 1.0, 0},
                              Unit{'m', 60.0, 0},
                              Unit{'h', 3600.0, 0},
                              Unit{'M', 0.0, 1'000'000},
                              Unit{'G', 0.0, 1'000'000'000},
                              Unit{'T', 0.0, 1'000'000'000'000}};

}  // namespace

Result<RingLimit> ring_limit_of(const std::string& text) {
  const auto refused = [&] {
    return fail(
        fmt::format("'{}' is not a length of a ring: write 10s to 10000000s (s, m or h), or 64M to 100T (M, "
                    "G or T bytes)",
                    text));
  };
  if (text.size() < 2) return refused();
  uint32_t number = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto [read, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || read != end) return refused();
  for (const Unit& unit : units) {
    if (unit.letter != text.back()) continue;
    const RingLimit limit{number * unit.seconds, number * unit.bytes};
    const bool is_time = unit.bytes == 0;
    if (is_time && (limit.seconds < limits::ring_seconds_min || limit.seconds > limits::ring_seconds_max))
      return refused();
    if (!is_time && (limit.bytes < limits::ring_bytes_min || limit.bytes > limits::ring_bytes_max))
      return refused();
    return limit;
  }
  return refused();
}

uint64_t RingLimit::log_bytes() const {
  return bytes == 0 ? limits::log_bytes_max : std::min(bytes / 8, limits::log_bytes_max);
}

void RecordingRing::begin(const Part& part, uint64_t bytes) {
  parts_.push_back(part);
  bytes_before_ = bytes;
}

PartWish RecordingRing::wish(Tick tick, uint64_t bytes) const {
  if (parts_.empty() || !limit_.is_on()) return PartWish::none;
  double parts = seconds_since(parts_.back().tick, tick) / limit_.part_seconds();
  if (limit_.bytes > 0)
    parts = std::min(parts, static_cast<double>(bytes - std::min(bytes, bytes_before_)) /
                                static_cast<double>(limit_.part_bytes()));
  if (parts < 1.0) return PartWish::none;
  return parts < 2.0 ? PartWish::soon : PartWish::now;
}

const RecordingRing::Part* RecordingRing::first_to_stay(Tick tick, uint64_t bytes) const {
  if (parts_.size() < 2) return nullptr;
  if (limit_.bytes > 0) {
    const bool may_go = seconds_since(parts_[1].tick, tick) >= limits::ring_seconds_min;
    return bytes > room() && may_go ? &parts_[1] : nullptr;
  }
  const Part* first = nullptr;
  for (size_t i = 1; limit_.seconds > 0.0 && i < parts_.size(); ++i)
    if (seconds_since(parts_[i].tick, tick) >= limit_.seconds) first = &parts_[i];
  return first;
}

void RecordingRing::drop_before(Tick tick, uint64_t bytes) {
  while (!parts_.empty() && parts_.front().tick < tick) parts_.pop_front();
  bytes_before_ = std::min(bytes_before_, bytes);
}

std::string RecordingRing::over_limit(const RecordingSize& size, uint64_t bytes) const {
  if (limit_.bytes == 0 || size.bytes() <= limit_.bytes) return {};
  constexpr uint64_t megabyte = 1'000'000;
  const auto mb = [](uint64_t n) { return fmt::format("{} MB", (n + megabyte / 2) / megabyte); };
  const std::string ring = fmt::format("its ring of {} takes {}", mb(limit_.bytes), mb(size.bytes()));
  if (size.log_bytes > 2 * limit_.log_bytes())
    return fmt::format(
        "{}: the log beside it has {}, as long as somebody reads the recording (replay verify, cut)", ring,
        mb(size.log_bytes));
  if (bytes > room())
    return fmt::format(
        "{}: the terrain's edits and the last {} s are always kept, and they need so much (--record-ring)",
        ring, static_cast<int>(limits::ring_seconds_min));
  return {};
}

}  // namespace scree
