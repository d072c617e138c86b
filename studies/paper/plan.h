// How long and how finely the experiments are run.
#pragma once

#include <vector>

#include "client/viewer/pictures/picture_size.h"
#include "server/world/world_config.h"

namespace scree::paper {

/// The paper's window.
inline constexpr int full_width = 1280;
inline constexpr int full_height = 720;

struct Plan {
  std::vector<int> grid_cells;
  std::vector<int> percents;
  int rounds = 2;
  Tick setting_ticks = 600;  ///< the paper's 10 s
  Tick setting_ticks_a_frame = 1;
  double session_seconds_scale = 1.0;
  int carves = 96;
  Tick carve_every = 10;
  Tick ticks_a_frame = 1;  ///< of the carving and merging sessions
  int rebuild_runs = 3;
  Tick rebuild_ticks_a_frame = 1;
  int rebuild_carves = 24;
  uint32_t blast_seeds = 40;  ///< a blow, of nine
  int session_percent = 100;  ///< of the full picture's width, for sessions

  PictureSize picture(int percent) const { return {full_width * percent / 100, full_height * percent / 100}; }
  PictureSize session_picture() const { return picture(session_percent); }
};

/// By a GPU a frame is drawn after each tick, and sessions at the paper's resolution; by software fewer are
/// drawn, and sessions at three tenths of it.
Plan plan_of(bool quick, bool software);

}  // namespace scree::paper
