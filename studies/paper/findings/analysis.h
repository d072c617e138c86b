// Figures of sessions and settings from which the report's claims follow.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "studies/paper/findings/findings.h"

namespace scree::paper {

/// A value of a tick; nothing where the tick has none.
using TickValue = std::function<std::optional<double>(const SessionTick&)>;
std::optional<double> draw_of(const SessionTick& tick);
std::optional<double> update_of(const SessionTick& tick);
std::optional<double> bodies_of(const SessionTick& tick);
/// Draw and update, of ticks after which a frame was drawn: the paper's overall frame time.
std::optional<double> frame_of(const SessionTick& tick);

/// The middle one of the values, or the mean of the two in the middle; 0 without values.
double median_of(std::vector<double> values);

/// The median over from_s ≤ time < until_s; nothing without values.
std::optional<double> median_between(const SessionFound& session, double from_s, double until_s,
                                     const TickValue& value);
/// The same of the nearest ticks with a value: the largest in any window of so many.
double worst_median(const SessionFound& session, double from_s, const TickValue& value, size_t window);

/// How far the ticks in which collision shapes were made anew stand out from the others beside them.
struct Spikes {
  size_t ticks = 0;           ///< that were compared
  double median_ratio = 0.0;  ///< of a tick to the median of its neighbours that are none
  double worst_ratio = 0.0;
  double median_extra_ms = 0.0;
};
Spikes spikes_of(const SessionFound& session, double from_s, const TickValue& value);

/// Medians over the rounds, and half of what the rounds lie apart: of two rounds, their mean, and the bar
/// from one to the other.
double draw_ms_of(const SettingFound& setting);
double update_ms_of(const SettingFound& setting);
double half_spread(const std::vector<double>& rounds);
double memory_mib_of(const SettingFound& setting);

/// The exponent p of value = factor · size^p through the first and the last setting.
double exponent_between(const SweepFound& sweep, double (*value)(const SettingFound&));
/// A setting's draw time over the one's before it, where that is least.
double least_step(const SweepFound& sweep);
/// Whether the least step is at least `share`, and the last draw time longer than the first.
bool rises_steadily(const SweepFound& sweep, double share);
/// The last setting's value over the first's, of the sweep where that is largest.
double growth_of(const std::vector<const SweepFound*>& sweeps, double (*value)(const SettingFound&));
/// The largest of the values over the smallest.
double range_ratio(const std::vector<const SweepFound*>& sweeps, double (*value)(const SettingFound&));
/// The size at which the sweep's draw time reaches `draw_ms`, on a straight line between two settings in
/// logarithms; nothing where it lies outside.
std::optional<double> size_at(const SweepFound& sweep, double draw_ms);
/// Whether every setting did the same work in its world.
bool same_work(const std::vector<const SweepFound*>& sweeps);

}  // namespace scree::paper
