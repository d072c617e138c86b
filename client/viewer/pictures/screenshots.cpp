#include "client/viewer/pictures/screenshots.h"

#include <charconv>
#include <fmt/format.h>
#include <utility>

#include "client/viewer/base/limits.h"

namespace scree {

namespace {

constexpr std::string_view pieces_prefix = "pieces>=", seconds_prefix = "after=";

/// Reads the whole number from 1 on that follows `prefix`. Returns whether the text is nothing else.
template <typename T>
bool read_after(std::string_view text, std::string_view prefix, T& number) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && number > 0;
}

}  // namespace

std::string ScreenshotOrder::description() const {
  switch (when) {
    case When::joined:
      return file + "@joined";
    case When::settled:
      return file + "@settled";
    case When::seconds:
      return fmt::format("{}@{}{}", file, seconds_prefix, seconds);
    case When::pieces:
      break;
  }
  return fmt::format("{}@{}{}", file, pieces_prefix, pieces);
}

Result<ScreenshotOrder> parse_screenshot(std::string_view text) {
  const size_t at = text.rfind('@');
  ScreenshotOrder order;
  order.file = text.substr(0, at);
  if (order.file.empty()) return fail("--screenshot: the file's name is missing");
  if (!order.file.ends_with(".png"))
    return fail("--screenshot: '" + order.file + "' is not the name of a PNG: it must end in .png");
  if (at == std::string_view::npos) return order;
  const std::string_view when = text.substr(at + 1);
  if (when == "joined") return order;
  if (when == "settled") {
    order.when = ScreenshotOrder::When::settled;
    return order;
  }
  if (read_after(when, pieces_prefix, order.pieces)) {
    order.when = ScreenshotOrder::When::pieces;
    return order;
  }
  if (read_after(when, seconds_prefix, order.seconds)) {
    order.when = ScreenshotOrder::When::seconds;
    return order;
  }
  return fail("--screenshot: '" + std::string(when) +
              "' is not a moment; use joined, after=N, pieces>=N or settled");
}

ScreenshotQueue::ScreenshotQueue(std::vector<ScreenshotOrder> orders)
    : orders_(std::move(orders)), reached_s_(orders_.size()) {}

std::vector<ScreenshotOrder> ScreenshotQueue::pop_due(const Moment& moment) {
  if (moment.joined && !joined_at_s_) joined_at_s_ = moment.now_s;
  if (moment.alive || !moment.carved) {
    calm_since_s_.reset();
  } else if (!calm_since_s_) {
    calm_since_s_ = moment.now_s;
  }
  std::vector<ScreenshotOrder> taken;
  for (size_t i = 0; i < orders_.size();) {
    const bool many = moment.joined && moment.pieces >= orders_[i].pieces;
    if (orders_[i].when == ScreenshotOrder::When::pieces && many && !reached_s_[i])
      reached_s_[i] = moment.now_s;
    const bool flown = reached_s_[i] && moment.now_s - *reached_s_[i] >= limits::flight_s;
    if (!flown && !due(orders_[i], moment)) {
      ++i;
      continue;
    }
    taken.push_back(std::move(orders_[i]));
    orders_.erase(orders_.begin() + static_cast<std::ptrdiff_t>(i));
    reached_s_.erase(reached_s_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return taken;
}

bool ScreenshotQueue::due(const ScreenshotOrder& order, const Moment& moment) const {
  if (order.when == ScreenshotOrder::When::joined) return moment.joined;
  if (order.when == ScreenshotOrder::When::seconds)
    return moment.joined && moment.now_s - *joined_at_s_ >= order.seconds;
  if (order.when != ScreenshotOrder::When::settled || !moment.joined || !moment.current) return false;
  return calm_since_s_ && moment.now_s - *calm_since_s_ >= limits::settled_s;
}

}  // namespace scree
