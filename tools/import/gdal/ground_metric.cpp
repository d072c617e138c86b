#include "tools/import/gdal/ground_metric.h"

#include <cmath>
#include <memory>

namespace scree {

namespace {

constexpr double degree = M_PI / 180.0;

/// Metres of a radian along the meridian and along the parallel, on the ellipsoid.
struct Radii {
  double north_m;
  double east_m;
};

Radii radii_at(const OGRSpatialReference& crs, double latitude) {
  const double a = crs.GetSemiMajor();
  const double flattening = crs.GetInvFlattening() > 0.0 ? 1.0 / crs.GetInvFlattening() : 0.0;
  const double e2 = flattening * (2.0 - flattening);
  const double root = std::sqrt(1.0 - e2 * std::sin(latitude) * std::sin(latitude));
  return {a * (1.0 - e2) / (root * root * root), a / root * std::cos(latitude)};
}

std::optional<GroundMetric> of_degrees(const OGRSpatialReference& crs, double x, double y) {
  const double unit = crs.GetAngularUnits();
  const double latitude = y * unit;
  if (!(std::abs(latitude) < 90.0 * degree) || !(std::abs(x * unit) <= 540.0 * degree)) return std::nullopt;
  const Radii radii = radii_at(crs, latitude);
  GroundMetric metric;
  metric.x_m = {radii.east_m * unit, 0.0};
  metric.y_m = {0.0, radii.north_m * unit};
  metric.longitude_deg = x * unit / degree;
  metric.latitude_deg = latitude / degree;
  return metric;
}

/// From a map to degrees of its own ellipsoid.
class ToDegrees {
 public:
  explicit ToDegrees(const OGRSpatialReference& crs) : map_(crs) {
    map_.StripVertical();
    if (map_.IsDerivedGeographic() != 0) {
      degrees_.SetWellKnownGeogCS("WGS84");
    } else {
      const std::unique_ptr<OGRSpatialReference> own(map_.CloneGeogCS());
      if (own == nullptr) return;
      degrees_ = *own;
    }
    degrees_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    transformation_.reset(OGRCreateCoordinateTransformation(&map_, &degrees_));
  }
  const OGRSpatialReference& degrees() const { return degrees_; }
  /// Longitude and latitude, radians.
  std::optional<std::array<double, 2>> at(double x, double y) const {
    if (!transformation_ || transformation_->Transform(1, &x, &y) == 0) return std::nullopt;
    const double unit = degrees_.GetAngularUnits();
    if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return std::array{x * unit, y * unit};
  }

 private:
  struct Destroy {
    void operator()(OGRCoordinateTransformation* transformation) const {
      OGRCoordinateTransformation::DestroyCT(transformation);
    }
  };
  OGRSpatialReference map_;
  OGRSpatialReference degrees_;
  std::unique_ptr<OGRCoordinateTransformation, Destroy> transformation_;
};

/// By differences over some metres: what a map does to a region, and not only to a point.
std::optional<GroundMetric> by_differences(const OGRSpatialReference& crs, double x, double y) {
  const ToDegrees to_degrees(crs);
  constexpr double step_m = 50.0;
  const double unit = crs.IsProjected() != 0 ? crs.GetLinearUnits() : 111'000.0;
  const double step = step_m / unit;
  const auto middle = to_degrees.at(x, y);
  if (!middle || !(std::abs((*middle)[1]) < 90.0 * degree)) return std::nullopt;
  const Radii radii = radii_at(to_degrees.degrees(), (*middle)[1]);
  const auto along = [&](double dx, double dy) -> std::optional<std::array<double, 2>> {
    const auto from = to_degrees.at(x - dx, y - dy), to = to_degrees.at(x + dx, y + dy);
    if (!from || !to) return std::nullopt;
    const double longitude = std::remainder((*to)[0] - (*from)[0], 2.0 * M_PI);
    return std::array{longitude * radii.east_m / (2.0 * step),
                      ((*to)[1] - (*from)[1]) * radii.north_m / (2.0 * step)};
  };
  const auto x_m = along(step, 0.0), y_m = along(0.0, step);
  if (!x_m || !y_m) return std::nullopt;
  return GroundMetric{*x_m, *y_m, (*middle)[0] / degree, (*middle)[1] / degree};
}

}  // namespace

double GroundMetric::scale_x() const {
  return std::hypot(x_m[0], x_m[1]);
}

double GroundMetric::scale_y() const {
  return std::hypot(y_m[0], y_m[1]);
}

bool GroundMetric::is_right_angled() const {
  return std::abs(x_m[0] * y_m[0] + x_m[1] * y_m[1]) < 0.01 * scale_x() * scale_y();
}

double GroundMetric::convergence_deg() const {
  return std::atan2(y_m[0], y_m[1]) / degree;
}

std::optional<GroundMetric> ground_metric(const OGRSpatialReference& crs, double x, double y) {
  if (crs.IsGeographic() != 0 && crs.IsDerivedGeographic() == 0) return of_degrees(crs, x, y);
  if (crs.IsProjected() != 0 || crs.IsDerivedGeographic() != 0) return by_differences(crs, x, y);
  const double unit_m = crs.GetLinearUnits();
  GroundMetric metric;
  if (unit_m > 0.0 && std::isfinite(unit_m)) {
    metric.x_m = {unit_m, 0.0};
    metric.y_m = {0.0, unit_m};
  }
  return metric;
}

OGRSpatialReference local_map(const OGRSpatialReference& crs, double longitude_deg, double latitude_deg) {
  OGRSpatialReference map;
  const std::unique_ptr<OGRSpatialReference> degrees(crs.IsDerivedGeographic() != 0 ? nullptr
                                                                                    : crs.CloneGeogCS());
  map.SetProjCS("local");
  if (degrees)
    map.CopyGeogCSFrom(degrees.get());
  else
    map.SetWellKnownGeogCS("WGS84");
  map.SetTM(latitude_deg, longitude_deg, 1.0, 0.0, 0.0);
  return map;
}

}  // namespace scree
