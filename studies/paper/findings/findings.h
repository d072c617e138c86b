// What the paper's experiments on Scree measured, as values: the study fills them in, and the report is
// composed of them alone. Times in milliseconds of the clock, as in the paper.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/report/report.h"

namespace scree::paper {

/// One setting of a drawing method (sections 3.1 and 3.2): a session of its own, run once a round.
struct SettingFound {
  double size = 0.0;              ///< cells along a side of the grid, or percent of the full picture's width
  std::vector<double> draw_ms{};  ///< median frame of each round
  std::vector<double> update_ms{};  ///< median tick of each round
  double heap_mib = 0.0;            ///< on the processor's side: world and method
  double gpu_mib = 0.0;             ///< as the method reports it
  double triangles = 0.0;           ///< of the last frame
  double reach_m = 0.0;             ///< distance up to which terrain is drawn
  int frames = 0;                   ///< drawn, of all rounds
  uint64_t state_hash = 0;          ///< of the world at the end: the same work has the same hash
};

/// The settings of one method in ascending order.
struct SweepFound {
  std::string name{};  ///< in legends: "uniform spacing"
  std::vector<SettingFound> settings{};
};

/// A tick of a session, and the frame that was drawn after it, if one was.
struct SessionTick {
  double time_s = 0.0;  ///< of the session, which has so many ticks a second
  double update_ms = 0.0;
  double bodies_ms = 0.0;  ///< the part of it that looks for contacts and moves the bodies
  std::optional<double> draw_ms{};
  size_t pieces = 0;    ///< alive after it
  bool edited = false;  ///< the user changed the terrain
  bool reshaped =
      false;  ///< terrain changed while pieces were there: their collision shapes of it are made anew
  bool switched = false;    ///< another drawing method was asked for
  bool merged = false;      ///< pieces became terrain
  uint64_t state_hash = 0;  ///< of the world after it
};

/// A session from its start, tick by tick.
struct SessionFound {
  std::string name{};
  std::vector<SessionTick> ticks{};
};

/// Repeated carving, then the other method, then the first again (figures 24 and 25).
struct CarvingFound {
  SessionFound atlas{};        ///< Scree's raymarch, grid, raymarch
  SessionFound list{};         ///< the paper's list of carves, Scree's grid, the list
  double fresh_until_s = 0.0;  ///< no carve before
  double switched_at_s = 0.0;  ///< all carves were before; the grid from here on
  double returned_at_s = 0.0;  ///< the first method again
  double settle_s = 0.0;       ///< after a switch, until which frames are not compared
  int carves = 0;
  /// A frame at the end of the session by the atlas that saw it, and by one that is made from the field then.
  double atlas_lived_ms = 0.0;
  double atlas_new_ms = 0.0;
  double grid_fresh_ms = 0.0;  ///< a frame by the same grid before any carve
  std::string grid{};          ///< its shape, in words
};

/// Small carves among pieces that lie about, by each terrain collider (figures 26 and 27): the same ticks,
/// each by its least time of several runs.
struct RebuildFound {
  std::vector<SessionFound> colliders{};  ///< "mesh", "field" and "rays"
  size_t pieces = 0;                      ///< alive when the carves begin
  double carving_from_s = 0.0;
  int runs = 0;
};

/// A blast whose pieces become terrain, and one whose pieces stay (figure 28).
struct MergingFound {
  SessionFound merging{};
  SessionFound staying{};
  double blast_from_s = 0.0;
};

/// How it was run.
struct Conditions {
  bool quick = false;     ///< fewer and smaller settings, only to show that it runs
  std::string driver{};   ///< of OpenGL, with its version
  bool software = false;  ///< no GPU
  int full_width = 0;     ///< of the settings' pictures at 100 %
  int full_height = 0;
  int session_width = 0;
  int session_height = 0;
  double setting_s = 0.0;  ///< length of a setting's session
  int rounds = 0;
  uint32_t tick_rate_hz = 60;
  std::string matrix{};  ///< link to the matrix study's report, if it lies beside; else empty
};

struct Findings {
  Conditions conditions{};
  std::vector<SweepFound> grids{};  ///< uniform spacing, then growing
  SweepFound raymarch{};
  CarvingFound carving{};
  RebuildFound rebuild{};
  MergingFound merging{};
};

}  // namespace scree::paper
