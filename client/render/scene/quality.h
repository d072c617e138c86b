// Presets of how much a frame costs: how far one sees, how finely it is drawn, whether things cast shadows. A
// new one is a row, and nothing else.
#pragma once

#include <cstdint>
#include <string_view>

#include "client/render/scene/limits.h"
#include "shared/base/kind_table.h"

namespace scree {

/// How finely a renderer draws.
struct Fineness {
  float render_scale = 1.0F;  ///< pixels that are drawn, along a side, for one that is shown
  int shadow_map_side = limits::shadow_map_side;  ///< texels; 0: nothing casts a shadow
  int shadow_samples = 9;                         ///< of it for a pixel, 9 or 1
  int shadow_frames = 1;                          ///< for which the map is drawn; pictures draw their own
  int samples = 4;                                ///< a pixel, of polygons' edges; 0: its middle alone
  bool contacts = true;                           ///< loose pieces darken what they lie on
  float details_m = 40.0F;                        ///< as far as grass and stones lie about; 0: none do

  bool operator==(const Fineness&) const = default;
};

enum class Quality : uint8_t { low = 0, medium = 1, high = 2 };

struct QualityRow {
  std::string_view name;
  float view_radius_m;  ///< and with it, the distance to the horizon and the levels of detail
  Fineness fineness;
};

constexpr QualityRow row_of(Quality quality) {
  switch (quality) {
    case Quality::low:
      return {.name = "low",
              .view_radius_m = 32.0F,
              .fineness = {.render_scale = 0.5F,
                           .shadow_map_side = 512,
                           .shadow_samples = 1,
                           .shadow_frames = 4,
                           .samples = 0,
                           .contacts = false,
                           .details_m = 0.0F}};
    case Quality::medium:
      return {.name = "medium",
              .view_radius_m = 48.0F,
              .fineness = {.render_scale = 0.75F, .shadow_map_side = 1024, .samples = 0, .details_m = 20.0F}};
    case Quality::high:
      return {.name = "high", .view_radius_m = 96.0F, .fineness = {}};
  }
  return {};
}

}  // namespace scree
