#include "studies/peers/comparison.h"

#include <algorithm>
#include <fmt/format.h>

#include "shared/base/check.h"
#include "shared/base/quantile.h"
#include "studies/report/report.h"

namespace scree {

namespace {

double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

std::string median_text(const std::vector<double>& values) {
  return values.empty() ? "–" : figure(median(values));
}

std::string ratio_text(const Comparison& comparison) {
  const double ratio = comparison.ratio();
  return ratio > 0.0 ? figure(ratio) : "–";
}

std::string spread_text(const Comparison& comparison) {
  const auto one = [](const std::vector<double>& values) {
    return values.size() < 2 ? std::string("–") : fmt::format("{:.1f}", spread_percent(values));
  };
  return one(comparison.ours) + " / " + one(comparison.theirs) + " / " + one(comparison.ratios());
}

std::vector<std::string> row_of(const PeerFindings& findings, const Comparison& comparison) {
  return {findings.peer,
          comparison.what,
          median_text(comparison.ours),
          median_text(comparison.theirs),
          ratio_text(comparison),
          spread_text(comparison),
          fmt::format("{:.0f}", comparison.noise_percent)};
}

const std::vector<std::string>& header() {
  static const std::vector<std::string> names = {
      "peer", "figure", "Scree", "the peer", "times as good", "spread, %, Scree / peer / ratio", "noise, %"};
  return names;
}

}  // namespace

std::vector<double> Comparison::ratios() const {
  if (ours.empty() || theirs.empty()) return {};
  CHECK(ours.size() == theirs.size());
  std::vector<double> all;
  for (size_t i = 0; i < ours.size(); ++i) {
    if (ours[i] <= 0.0 || theirs[i] <= 0.0) return {};
    all.push_back(more_is_better ? ours[i] / theirs[i] : theirs[i] / ours[i]);
  }
  return all;
}

double Comparison::ratio() const {
  const std::vector<double> all = ratios();
  return all.empty() ? 0.0 : median(all);
}

double Comparison::spread() const {
  const std::vector<double> all = ratios();
  return all.empty() ? std::max(spread_percent(ours), spread_percent(theirs)) : spread_percent(all);
}

double spread_percent(const std::vector<double>& values) {
  if (values.size() < 2) return 0.0;
  const auto [least, most] = std::ranges::minmax(values);
  return most == least ? 0.0 : 100.0 * (most - least) / median(values);
}

Comparison& PeerFindings::figure(const std::string& figure_name, const std::string& what,
                                 double noise_percent, bool more_is_better) {
  const auto found = std::ranges::find(figures, figure_name, &Comparison::name);
  if (found != figures.end()) return *found;
  figures.push_back({figure_name, what, noise_percent, more_is_better});
  return figures.back();
}

void PeerFindings::check(const std::string& check_name, bool passed, const std::string& detail) {
  const auto found = std::ranges::find(checks, check_name, &Check::name);
  if (found == checks.end())
    checks.push_back({check_name, passed, detail});
  else if (found->passed)
    *found = {check_name, passed, detail};
}

void report_findings(const PeerFindings& findings, BenchReport& report) {
  if (!findings.missing.empty()) report.check(findings.name + "_measured", false, findings.missing);
  for (const Comparison& each : findings.figures) {
    const std::string name = findings.name + "_" + each.name;
    if (!each.ours.empty()) report.metric("own_" + name, median(each.ours));
    if (!each.theirs.empty()) report.metric("peer_" + name, median(each.theirs));
    if (each.ratio() > 0.0) report.metric("ratio_" + name, each.ratio());
    const size_t runs = std::max(each.ours.size(), each.theirs.size());
    if (runs < 2) continue;  // one run shows no noise
    report.check(name + "_within_noise", each.spread() <= each.noise_percent,
                 fmt::format("the {} of {} runs lie {:.1f} % apart, stated: {:.0f} %; Scree's own {:.1f} %, "
                             "the peer's {:.1f} %",
                             each.ratios().empty() ? "values" : "ratios", runs, each.spread(),
                             each.noise_percent, spread_percent(each.ours), spread_percent(each.theirs)));
  }
  for (const Check& each : findings.checks)
    report.check(findings.name + "_" + each.name, each.passed, each.detail);
}

ReportTable table_of(const std::vector<PeerFindings>& all) {
  ReportTable table{
      "Medians. A ratio above 1: Scree is so many times faster, smaller or more.", header(), {}};
  for (const PeerFindings& findings : all) {
    if (!findings.missing.empty())
      table.rows.push_back({findings.peer, findings.missing, "–", "–", "–", "–", "–"});
    for (const Comparison& each : findings.figures) table.rows.push_back(row_of(findings, each));
  }
  return table;
}

ReportSection section_of(const PeerFindings& findings) {
  ReportSection section{findings.peer, findings.conditions};
  if (!findings.missing.empty()) {
    section.text.push_back("Not measured here: " + findings.missing + ".");
    return section;
  }
  ReportTable runs{"Each run", {"figure", "Scree", "the peer"}, {}};
  const auto listed = [](const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + figure(value);
    return text.empty() ? std::string("–") : text;
  };
  for (const Comparison& each : findings.figures)
    runs.rows.push_back({each.what, listed(each.ours), listed(each.theirs)});
  section.tables.push_back(std::move(runs));
  ReportTable checks{"What was checked of the results", {"check", "held", "detail"}, {}};
  for (const Check& each : findings.checks)
    checks.rows.push_back({each.name, each.passed ? "yes" : "no", each.detail});
  if (!checks.rows.empty()) section.tables.push_back(std::move(checks));
  return section;
}

}  // namespace scree
