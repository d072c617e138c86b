// The presets of servers and viewers (shared/base/preset.h), each measured under its own constraint: `laptop`
// on one core, which simulates and draws; `desktop` on all of them; `dedicated` without drawing.
#pragma once

#include <array>

#include "shared/base/preset.h"
#include "studies/matrix/drawn.h"

namespace scree {

struct ProfileFigures {
  double cores = 0.0;           ///< that it might use
  double tick_budget_ms = 0.0;  ///< a tick's length
  double tick_ms = 0.0;         ///< mean
  double tick_p99_ms = 0.0;
  double late_percent = 0.0;     ///< of the ticks, those that took longer than that
  double pieces_most = 0.0;      ///< alive at once
  double refused = 0.0;          ///< blows
  double seconds_to_rest = 0.0;  ///< until nine tenths of the pieces were terrain again; 0: they were not
  double memory_max_mb = 0.0;    ///< as the preset has it
  double resident_mb = 0.0;      ///< of the process when the session ended
  double frame_ms = 0.0;         ///< mean of update and drawing; 0: it draws nothing, as the next ones
  double frame_p99_ms = 0.0;
  double draw_mib = 0.0;
  double view_radius_m = 0.0;

  static constexpr auto fields() {
    using F = FigureField<ProfileFigures>;
    return std::array{F{"cores", &ProfileFigures::cores},
                      F{"tick_budget_ms", &ProfileFigures::tick_budget_ms},
                      F{"tick_ms", &ProfileFigures::tick_ms},
                      F{"tick_p99_ms", &ProfileFigures::tick_p99_ms},
                      F{"late_percent", &ProfileFigures::late_percent},
                      F{"pieces_most", &ProfileFigures::pieces_most},
                      F{"refused", &ProfileFigures::refused},
                      F{"seconds_to_rest", &ProfileFigures::seconds_to_rest},
                      F{"memory_max_mb", &ProfileFigures::memory_max_mb},
                      F{"resident_mb", &ProfileFigures::resident_mb},
                      F{"frame_ms", &ProfileFigures::frame_ms},
                      F{"frame_p99_ms", &ProfileFigures::frame_p99_ms},
                      F{"draw_mib", &ProfileFigures::draw_mib},
                      F{"view_radius_m", &ProfileFigures::view_radius_m}};
  }
};

/// The options are those that the programs have by `--preset`. Sixteen blows of 64 pieces, two a second, and
/// the time until all lies; quick: two blows. On a thread of its own, whose cores are those of all threads
/// that it starts; GL must not be current here.
Result<ProfileFigures> measure_profile(Preset preset, bool quick);

}  // namespace scree
