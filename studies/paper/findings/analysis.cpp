#include "studies/paper/findings/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree::paper {
namespace {

/// Ticks to each side of one that are its neighbours: half a second.
constexpr size_t neighbours = 30;
/// Fewer values say nothing about what is usual.
constexpr size_t neighbours_min = 4;

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<double> draw_of(const SessionTick& tick) {
  return tick.draw_ms;
}

std::optional<double> update_of(const SessionTick& tick) {
  return tick.update_ms;
}

std::optional<double> bodies_of(const SessionTick& tick) {
  return tick.bodies_ms;
}

std::optional<double> frame_of(const SessionTick& tick) {
  if (!tick.draw_ms) return std::nullopt;
  return *tick.draw_ms + tick.update_ms;
}

std::optional<double> median_between(const SessionFound& session, double from_s, double until_s,
                                     const TickValue& value) {
  std::vector<double> values;
  for (const SessionTick& tick : session.ticks)
    if (const auto found = value(tick); found && tick.time_s >= from_s && tick.time_s < until_s)
      values.push_back(*found);
  if (values.empty()) return std::nullopt;
  return median_of(values);
}

double worst_median(const SessionFound& session, double from_s, const TickValue& value, size_t window) {
  std::vector<double> last;
  double worst = 0.0;
  for (const SessionTick& tick : session.ticks) {
    const auto found = value(tick);
    if (!found || tick.time_s < from_s) continue;
    last.push_back(*found);
    if (last.size() > window) last.erase(last.begin());
    if (last.size() == window) worst = std::max(worst, median_of(last));
  }
  return worst;
}

Spikes spikes_of(const SessionFound& session, double from_s, const TickValue& value) {
  const auto& ticks = session.ticks;
  std::vector<double> ratios, extras_ms;
  for (size_t i = 0; i < ticks.size(); ++i) {
    const auto here = value(ticks[i]);
    if (!ticks[i].reshaped || ticks[i].time_s < from_s || !here) continue;
    std::vector<double> others;
    for (size_t j = i > neighbours ? i - neighbours : 0; j < std::min(i + neighbours + 1, ticks.size()); ++j)
      if (const auto beside = value(ticks[j]); beside && !ticks[j].reshaped) others.push_back(*beside);
    if (others.size() < neighbours_min || median_of(others) <= 0.0) continue;
    ratios.push_back(*here / median_of(others));
    extras_ms.push_back(*here - median_of(others));
  }
  if (ratios.empty()) return {};
  return {ratios.size(), median_of(ratios), *std::ranges::max_element(ratios), median_of(extras_ms)};
}

double draw_ms_of(const SettingFound& setting) {
  return median_of(setting.draw_ms);
}

double update_ms_of(const SettingFound& setting) {
  return median_of(setting.update_ms);
}

double half_spread(const std::vector<double>& rounds) {
  if (rounds.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax_element(rounds);
  return 0.5 * (*most - *least);
}

double memory_mib_of(const SettingFound& setting) {
  return setting.heap_mib + setting.gpu_mib;
}

double exponent_between(const SweepFound& sweep, double (*value)(const SettingFound&)) {
  const SettingFound &first = sweep.settings.front(), &last = sweep.settings.back();
  return std::log(value(last) / value(first)) / std::log(last.size / first.size);
}

double least_step(const SweepFound& sweep) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < sweep.settings.size(); ++i)
    least = std::min(least, draw_ms_of(sweep.settings[i]) / draw_ms_of(sweep.settings[i - 1]));
  return least;
}

bool rises_steadily(const SweepFound& sweep, double share) {
  return least_step(sweep) >= share && draw_ms_of(sweep.settings.back()) > draw_ms_of(sweep.settings.front());
}

double growth_of(const std::vector<const SweepFound*>& sweeps, double (*value)(const SettingFound&)) {
  double most = 0.0;
  for (const SweepFound* sweep : sweeps)
    most = std::max(most, value(sweep->settings.back()) / value(sweep->settings.front()));
  return most;
}

double range_ratio(const std::vector<const SweepFound*>& sweeps, double (*value)(const SettingFound&)) {
  std::vector<double> values;
  for (const SweepFound* sweep : sweeps)
    for (const SettingFound& setting : sweep->settings) values.push_back(value(setting));
  const auto [least, most] = std::ranges::minmax_element(values);
  return *most / *least;
}

std::optional<double> size_at(const SweepFound& sweep, double draw_ms) {
  for (size_t i = 1; i < sweep.settings.size(); ++i) {
    const SettingFound &a = sweep.settings[i - 1], &b = sweep.settings[i];
    const double low = draw_ms_of(a), high = draw_ms_of(b);
    if (low > draw_ms || high < draw_ms || low >= high) continue;
    const double part = std::log(draw_ms / low) / std::log(high / low);
    return a.size * std::pow(b.size / a.size, part);
  }
  return std::nullopt;
}

bool same_work(const std::vector<const SweepFound*>& sweeps) {
  for (const SweepFound* sweep : sweeps)
    for (const SettingFound& setting : sweep->settings)
      if (setting.state_hash != sweeps.front()->settings.front().state_hash) return false;
  return true;
}

}  // namespace scree::paper
