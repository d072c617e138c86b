#include "client/viewer/pictures/screenshots.h"

#include <charconv>
#include <utility>

#include "client/viewer/base/limits.h"

namespace scree {

std::string ScreenshotOrder::description() const {
  switch (when) {
    case When::joined:
      return file + "@joined";
    case When::settled:
      return file + "@settled";
    case When::pieces:
      break;
  }
  return file + "@pieces>=" + std::to_string(pieces);
}

Result<ScreenshotOrder> parse_screenshot(std::string_view text) {
  constexpr std::string_view pieces_prefix = "pieces>=";
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
  if (when.starts_with(pieces_prefix)) {
    order.when = ScreenshotOrder::When::pieces;
    const std::string_view number = when.substr(pieces_prefix.size());
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), order.pieces);
    if (error == std::errc{} && end == number.data() + number.size() && order.pieces > 0) return order;
  }
  return fail("--screenshot: '" + std::string(when) + "' is not a moment; use joined, pieces>=N or settled");
}

ScreenshotQueue::ScreenshotQueue(std::vector<ScreenshotOrder> orders)
    : orders_(std::move(orders)), reached_s_(orders_.size()) {}

std::vector<ScreenshotOrder> ScreenshotQueue::pop_due(const Moment& moment) {
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
  if (order.when != ScreenshotOrder::When::settled || !moment.joined || !moment.current) return false;
  return calm_since_s_ && moment.now_s - *calm_since_s_ >= limits::settled_s;
}

}  // namespace scree
