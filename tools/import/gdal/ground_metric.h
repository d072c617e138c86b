// How long a step on a map is on the ground: metres to the true east and north, at one place.
#pragma once

#include <array>
#include <ogr_spatialref.h>
#include <optional>

namespace scree {

/// Steps of one unit along x, and along y.
struct GroundMetric {
  std::array<double, 2> x_m{1.0, 0.0};  ///< east, north
  std::array<double, 2> y_m{0.0, 1.0};
  std::optional<double> longitude_deg{};  ///< of the place, where the map says so
  std::optional<double> latitude_deg{};

  double scale_x() const;
  double scale_y() const;
  /// Whether its axes meet at a right angle on the ground, within a hundredth.
  bool is_right_angled() const;
  /// From the true north to the map's, degrees, clockwise.
  double convergence_deg() const;
};

/// Nothing where the place is none of the Earth's.
std::optional<GroundMetric> ground_metric(const OGRSpatialReference& crs, double x, double y);

/// A map of metres whose north is the true one, right near the place.
OGRSpatialReference local_map(const OGRSpatialReference& crs, double longitude_deg, double latitude_deg);

}  // namespace scree
