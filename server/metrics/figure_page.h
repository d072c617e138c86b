// The figures of a program in Prometheus' text form (its documentation: "Exposition formats"). Not
// thread-safe.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "server/metrics/durations.h"
#include "server/metrics/figure.h"

namespace scree {

/// What the page is served as.
inline constexpr const char* figure_page_type = "text/plain; version=0.0.4; charset=utf-8";

class FigurePage {
 public:
  FigurePage();
  ~FigurePage();
  FigurePage(const FigurePage&) = delete;
  FigurePage& operator=(const FigurePage&) = delete;

  /// Figures of one name come one after the other, with the same help and kind. A name or a label that
  /// Prometheus would refuse is a programmer's error.
  void add(const Figure& figure);
  void total(const char* name, const char* help, double value, const FigureLabels& labels = {});
  void state(const char* name, const char* help, double value, const FigureLabels& labels = {});
  /// A histogram in seconds, counted up to each of the bounds, ascending. Durations within 2 % of a bound may
  /// count on either side of it.
  void durations(const char* name, const char* help, const Durations& durations,
                 std::span<const double> bounds_s, const FigureLabels& labels = {});

  std::string text() const;

 private:
  struct Families;
  std::unique_ptr<Families> families_;
};

}  // namespace scree
