// How the kinds of events of a session look in a plot: the paper's colours (section 3.3).
#pragma once

#include <string_view>

#include "studies/report/report.h"

namespace scree {

struct EventStyle {
  std::string_view colour;  ///< as "#rrggbb"
  std::string_view name;    ///< in the legend
};

constexpr EventStyle style_of(PlotEventKind kind) {
  switch (kind) {
    case PlotEventKind::physics:
      return {"#e03131", "collision shapes made anew"};
    case PlotEventKind::edit:
      return {"#f2b705", "terrain changed by the user"};
    case PlotEventKind::method:
      return {"#6741d9", "drawing method switched"};
    case PlotEventKind::recombination:
      return {"#2f9e44", "pieces merged into terrain"};
  }
  return {};
}

}  // namespace scree
