// Figures and messages over the picture, by Dear ImGui. Needs the window's GL context current.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/render/draw_method.h"
#include "client/render/gpu_timers.h"
#include "client/viewer/app_window.h"
#include "proto/messages.h"

namespace scree {

struct HudFacts {
  std::string connection;  ///< one line
  bool lost = false;       ///< the connection is gone: say so loudly
  Tick tick = 0;
  size_t pieces = 0;
  std::optional<StatusMessage> status;  ///< the server's last
  double bytes_per_s = 0.0;
  uint64_t mismatches = 0;
  float carve_radius_m = 0.0F;
  std::string notice;  ///< the server's last refusal, for a while
  std::string method;
  DrawStats draw;
  std::vector<GpuTime> gpu_times;
};

class Hud {
 public:
  explicit Hud(const AppWindow& window);
  ~Hud();
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  void toggle_help() { help_ = !help_; }
  void draw(const HudFacts& facts, float frame_ms);

 private:
  void draw_figures(const HudFacts& facts) const;
  bool help_ = true;
  float frame_ms_ = 0.0F;  ///< smoothed
};

}  // namespace scree
