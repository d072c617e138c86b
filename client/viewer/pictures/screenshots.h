// The ordered screenshots, and the conditions for taking each. No GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/result.h"

namespace scree {

struct ScreenshotOrder {
  enum class When { joined, pieces, seconds, settled };
  std::string file;
  When when = When::joined;
  size_t pieces = 0;     ///< at least so many, for When::pieces
  uint32_t seconds = 0;  ///< after it has joined, for When::seconds

  /// "blast.png@pieces>=40": for people.
  std::string description() const;
};

/// FILE, FILE@joined, FILE@after=N, FILE@pieces>=N or FILE@settled.
Result<ScreenshotOrder> parse_screenshot(std::string_view text);

/// The state of the viewer at some moment (seconds of any clock).
struct Moment {
  double now_s = 0.0;
  bool joined =
      false;  ///< every other moment waits for it: the terrain around the camera has arrived and is shown
  size_t pieces = 0;     ///< in sight
  bool carved = false;   ///< pieces were made at some time
  bool alive = false;    ///< pieces exist, shown or not
  bool current = false;  ///< the picture shows the newest state
};

class ScreenshotQueue {
 public:
  explicit ScreenshotQueue(std::vector<ScreenshotOrder> orders);

  bool empty() const { return orders_.empty(); }
  const std::vector<ScreenshotOrder>& waiting() const { return orders_; }
  /// The orders due now; they leave the queue.
  std::vector<ScreenshotOrder> pop_due(const Moment& moment);

 private:
  bool due(const ScreenshotOrder& order, const Moment& moment) const;

  std::vector<ScreenshotOrder> orders_;
  std::vector<std::optional<double>> reached_s_;  ///< per order: when its number of pieces was first shown
  std::optional<double> joined_at_s_;             ///< first
  std::optional<double> calm_since_s_;            ///< no piece alive since then
};

}  // namespace scree
