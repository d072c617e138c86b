#include "server/metrics/figure_page.h"

#include <prometheus/check_names.h>
#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>
#include <sstream>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr double ms_per_s = 1e3;

prometheus::ClientMetric metric_with(const FigureLabels& labels) {
  prometheus::ClientMetric metric;
  for (const auto& [name, value] : labels) {
    CHECK(prometheus::CheckLabelName(name), "a label's name must be one of Prometheus'");
    metric.label.push_back({name, value});
  }
  return metric;
}

}  // namespace

struct FigurePage::Families {
  std::vector<prometheus::MetricFamily> all;

  prometheus::MetricFamily& of(const std::string& name, const std::string& help,
                               prometheus::MetricType type) {
    if (all.empty() || all.back().name != name) {
      CHECK(prometheus::CheckMetricName(name), "a figure's name must be one of Prometheus'");
      for (const prometheus::MetricFamily& other : all)
        CHECK(other.name != name, "figures of one name come one after the other");
      all.push_back({name, help, type, {}});
    }
    CHECK(all.back().type == type && all.back().help == help, "figures of one name are alike");
    return all.back();
  }
};

FigurePage::FigurePage() : families_(std::make_unique<Families>()) {}
FigurePage::~FigurePage() = default;

void FigurePage::add(const Figure& figure) {
  const bool is_total = figure.kind == FigureKind::total;
  prometheus::ClientMetric metric = metric_with(figure.labels);
  (is_total ? metric.counter.value : metric.gauge.value) = figure.value;
  const auto type = is_total ? prometheus::MetricType::Counter : prometheus::MetricType::Gauge;
  families_->of(figure.name, figure.help, type).metric.push_back(std::move(metric));
}

void FigurePage::total(const char* name, const char* help, double value, const FigureLabels& labels) {
  add({name, help, FigureKind::total, value, labels});
}

void FigurePage::state(const char* name, const char* help, double value, const FigureLabels& labels) {
  add({name, help, FigureKind::state, value, labels});
}

void FigurePage::durations(const char* name, const char* help, const Durations& durations,
                           std::span<const double> bounds_s, const FigureLabels& labels) {
  prometheus::ClientMetric metric = metric_with(labels);
  for (const double bound_s : bounds_s)
    metric.histogram.bucket.push_back({durations.count_up_to(bound_s * ms_per_s), bound_s});
  metric.histogram.sample_count = durations.count();
  metric.histogram.sample_sum = durations.sum_ms() / ms_per_s;
  families_->of(name, help, prometheus::MetricType::Histogram).metric.push_back(std::move(metric));
}

std::string FigurePage::text() const {
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, families_->all);
  return text.str();
}

}  // namespace scree
