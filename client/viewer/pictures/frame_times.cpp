#include "client/viewer/pictures/frame_times.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "shared/base/check.h"

namespace scree {
namespace {

std::vector<double> column(const TimeDemo& demo, double FrameTime::*field) {
  std::vector<double> times;
  times.reserve(demo.frames.size());
  for (const FrameTime& frame : demo.frames) times.push_back(frame.*field);
  return times;
}

nlohmann::ordered_json summary(std::vector<double> times) {
  std::ranges::sort(times);
  const auto quantile = [&](double part) {
    return times[static_cast<size_t>(part * static_cast<double>(times.size() - 1) + 0.5)];
  };
  const double sum = std::accumulate(times.begin(), times.end(), 0.0);
  return {{"median", quantile(0.5)},
          {"p99", quantile(0.99)},
          {"worst", times.back()},
          {"mean", sum / static_cast<double>(times.size())}};
}

}  // namespace

std::string to_json(const TimeDemo& demo) {
  CHECK(!demo.frames.empty());
  const std::vector<double> each = column(demo, &FrameTime::frame_ms);
  const nlohmann::ordered_json json{{"method", demo.method},
                                    {"driver", demo.driver},
                                    {"width", demo.width},
                                    {"height", demo.height},
                                    {"path", demo.path},
                                    {"frames", demo.frames.size()},
                                    {"frame_ms", summary(each)},
                                    {"update_ms", summary(column(demo, &FrameTime::update_ms))},
                                    {"draw_ms", summary(column(demo, &FrameTime::draw_ms))},
                                    {"each_frame_ms", each}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace scree
