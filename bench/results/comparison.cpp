#include "bench/results/comparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "bench/results/metric_sense.h"

namespace scree {

namespace {

/// The keys of both, in order.
template <typename Value>
std::set<std::string> names_in(const std::map<std::string, Value>& a, const std::map<std::string, Value>& b) {
  std::set<std::string> names;
  for (const auto* map : {&a, &b})
    for (const auto& [name, value] : *map) names.insert(name);
  return names;
}

template <typename Value>
std::optional<Value> value_in(const std::map<std::string, Value>& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? std::nullopt : std::optional(found->second);
}

/// Times of whole stages: where code lies in memory is worth as much.
constexpr double told_apart_ms = 0.001;

Change change_of(const std::string& metric, const MetricRange& before, const MetricRange& after,
                 bool noise_known) {
  const bool had = std::isfinite(before.value), has = std::isfinite(after.value);
  if (!had || !has) return had == has ? Change::same : had ? Change::worse : Change::changed;
  const MetricSense sense = sense_of(metric);
  const double floor = noise_known ? sense.floor : std::max(sense.floor, unknown_noise);
  const double larger = std::max(std::abs(before.value), std::abs(after.value));
  const double told_apart = metric.ends_with("_ms") ? told_apart_ms : 0.0;
  const double bound = std::max({before.spread() + after.spread(), floor * larger, told_apart});
  if (std::abs(after.value - before.value) <= bound) return Change::same;
  if (sense.better == Better::unknown) return Change::changed;
  return (after.value < before.value) == (sense.better == Better::lower) ? Change::better : Change::worse;
}

MetricChange metric_change(const std::string& metric, const StoredResult& before, const StoredResult& after) {
  MetricChange change{metric, value_in(before.metrics, metric), value_in(after.metrics, metric)};
  const bool noise_known = before.runs >= runs_for_noise && after.runs >= runs_for_noise;
  if (!change.after)
    change.change = Change::gone;
  else if (!change.before)
    change.change = Change::added;
  else
    change.change = change_of(metric, *change.before, *change.after, noise_known);
  return change;
}

CheckChange check_change(const std::string& check, const StoredResult& before, const StoredResult& after) {
  const auto was = value_in(before.checks, check), is = value_in(after.checks, check);
  if (!is && was->passed) return {check, Change::worse, "not checked any more; before: " + was->detail};
  if (!is) return {check, Change::gone, was->detail};
  if (!was) return {check, is->passed ? Change::added : Change::worse, is->detail};
  const Change change = was->passed == is->passed ? Change::same
                        : is->passed              ? Change::better
                                                  : Change::worse;
  return {check, change, is->detail};
}

std::string options_text(const std::map<std::string, std::string>& options) {
  std::string text;
  for (const auto& [name, value] : options) text += (text.empty() ? "" : ", ") + name + " " + value;
  return text.empty() ? "no options" : text;
}

std::vector<std::string> notes_of(const StoredResult& before, const StoredResult& after) {
  std::vector<std::string> notes;
  const auto differ = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is) notes.push_back(fmt::format("{}: {} before, {} after", what, was, is));
  };
  const Machine &a = before.machine, &b = after.machine;
  differ("the machines differ", a.processor, b.processor);
  differ("the threads differ", std::to_string(a.threads), std::to_string(b.threads));
  differ("the compilers differ", a.compiler, b.compiler);
  for (const std::string& condition : names_in(before.conditions, after.conditions))
    differ("the condition " + condition + " differs",
           value_in(before.conditions, condition).value_or("unknown"),
           value_in(after.conditions, condition).value_or("unknown"));
  const std::string advice = before.kind == ResultKind::bench
                                 ? fmt::format(" (run --repeat {})", runs_for_noise)
                                 : std::string();  // studies have no such option
  for (const StoredResult* result : {&before, &after})
    if (result->runs < runs_for_noise)
      notes.push_back(fmt::format(
          "{} has {} of the {} runs that show its noise: differences up to {:.0f} % count as none{}",
          result == &before ? "before" : "after", result->runs, runs_for_noise, 100.0 * unknown_noise,
          advice));
  return notes;
}

std::string number_text(const std::optional<MetricRange>& range) {
  if (!range || !std::isfinite(range->value)) return "-";
  return fmt::format("{:.4g}", range->value);
}

std::string spread_text(const std::optional<MetricRange>& range) {
  if (!range || !std::isfinite(range->value) || range->spread() <= 0.0) return "";
  return fmt::format("({:.4g} … {:.4g})", range->min, range->max);
}

}  // namespace

std::optional<double> MetricChange::ratio() const {
  if (!before || !after) return std::nullopt;
  if (before->value == after->value) return 1.0;
  const double ratio = after->value / before->value;
  return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

size_t ResultComparison::count(Change change) const {
  return static_cast<size_t>(std::ranges::count(metrics, change, &MetricChange::change) +
                             std::ranges::count(checks, change, &CheckChange::change));
}

Result<ResultComparison> compare_results(const StoredResult& before, const StoredResult& after) {
  if (before.kind != after.kind || before.name != after.name)
    return fail(fmt::format("they measure different work: {} {}, and {} {}", name_of(before.kind),
                            before.name, name_of(after.kind), after.name));
  if (before.options != after.options)
    return fail(fmt::format("{} was run with different options: {}; and {}", before.name,
                            options_text(before.options), options_text(after.options)));
  ResultComparison comparison{.name = before.name, .notes = notes_of(before, after)};
  for (const std::string& metric : names_in(before.metrics, after.metrics))
    comparison.metrics.push_back(metric_change(metric, before, after));
  for (const std::string& check : names_in(before.checks, after.checks))
    comparison.checks.push_back(check_change(check, before, after));
  return comparison;
}

std::string text_of(const ResultComparison& comparison) {
  std::string text = comparison.name + "\n";
  for (const std::string& note : comparison.notes) text += "  note: " + note + "\n";
  text += fmt::format("  {:<44} {:>10} {:>10} {:>7}\n", "metric", "before", "after", "ratio");
  for (const MetricChange& row : comparison.metrics) {
    const std::optional<double> ratio = row.ratio();
    text +=
        fmt::format("  {:<44} {:>10} {:>10} {:>7}  {:<8}", row.metric, number_text(row.before),
                    number_text(row.after), ratio ? fmt::format("{:.3f}", *ratio) : "-", name_of(row.change));
    if (row.change != Change::same)
      text += fmt::format(" {} {}", spread_text(row.before), spread_text(row.after));
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  for (const CheckChange& row : comparison.checks)
    if (row.change != Change::same)
      text += fmt::format("  check {:<38} {:<8} {}\n", row.check, name_of(row.change), row.detail);
  text += " ";
  for (const Change change : all_kinds<Change>)
    if (const size_t count = comparison.count(change); count > 0)
      text += fmt::format(" {} {},", count, name_of(change));
  text.back() = '\n';
  return text;
}

}  // namespace scree
