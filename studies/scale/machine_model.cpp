#include "studies/scale/machine_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree {

namespace {

constexpr size_t terms = 4;
constexpr double ms_per_s = 1000.0;
constexpr double most_ever = 1e7;  ///< bots or viewers that are looked for at most

using Terms = std::array<double, terms>;

Terms terms_of(const MachineLoad& load) {
  return {1.0, load.bots, load.onlookers(), load.bots * load.onlookers()};
}

/// Solves the symmetric equations of the terms that are used, by Gauss's elimination with pivots; the others
/// are zero. Nothing when they are singular.
std::optional<Terms> solve(std::array<Terms, terms> matrix, Terms right,
                           const std::array<bool, terms>& used) {
  for (size_t i = 0; i < terms; ++i)
    if (!used[i]) {
      for (size_t j = 0; j < terms; ++j) matrix[i][j] = matrix[j][i] = 0.0;
      matrix[i][i] = 1.0;
      right[i] = 0.0;
    }
  for (size_t i = 0; i < terms; ++i) {
    size_t pivot = i;
    for (size_t row = i + 1; row < terms; ++row)
      if (std::abs(matrix[row][i]) > std::abs(matrix[pivot][i])) pivot = row;
    if (std::abs(matrix[pivot][i]) < 1e-15) return std::nullopt;
    std::swap(matrix[i], matrix[pivot]);
    std::swap(right[i], right[pivot]);
    for (size_t row = i + 1; row < terms; ++row) {
      const double by = matrix[row][i] / matrix[i][i];
      for (size_t j = i; j < terms; ++j) matrix[row][j] -= by * matrix[i][j];
      right[row] -= by * right[i];
    }
  }
  Terms found{};
  for (size_t i = terms; i-- > 0;) {
    found[i] = right[i];
    for (size_t j = i + 1; j < terms; ++j) found[i] -= matrix[i][j] * found[j];
    found[i] /= matrix[i][i];
  }
  return found;
}

/// The largest number, by halving, up to which every share stays within 1; shares rise with it.
double largest(const std::function<double(double)>& share) {
  if (share(0.0) > 1.0) return 0.0;
  if (share(most_ever) <= 1.0) return most_ever;
  double holds = 0.0, fails = most_ever;
  while (fails - holds > 1e-6 * (1.0 + holds)) {
    const double middle = 0.5 * (holds + fails);
    (share(middle) <= 1.0 ? holds : fails) = middle;
  }
  return holds;
}

constexpr std::array all_limits = {MachineLimit::processors, MachineLimit::simulation_thread,
                                   MachineLimit::work, MachineLimit::memory, MachineLimit::bandwidth};

Held least(const std::function<double(MachineLimit, double)>& share) {
  Held held{most_ever, MachineLimit::processors};
  for (const MachineLimit limit : all_limits) {
    const double most = largest([&](double count) { return share(limit, count); });
    if (most < held.most) held = {most, limit};
  }
  return held;
}

}  // namespace

std::string_view name_of(MachineLimit limit) {
  switch (limit) {
    case MachineLimit::processors:
      return "the processors' time";
    case MachineLimit::simulation_thread:
      return "the simulation's thread";
    case MachineLimit::work:
      return "the tick's budget, `work-percent`";
    case MachineLimit::memory:
      return "memory";
    case MachineLimit::bandwidth:
      return "bandwidth";
  }
  return "";
}

std::optional<LoadCosts> fit_load_costs(std::span<const MeasuredLoad> measured) {
  std::array<Terms, terms> matrix{};
  Terms right{};
  for (const MeasuredLoad& one : measured) {
    const Terms row = terms_of(one.load);
    for (size_t i = 0; i < terms; ++i) {
      for (size_t j = 0; j < terms; ++j) matrix[i][j] += row[i] * row[j] / (one.ms_per_s * one.ms_per_s);
      right[i] += row[i] / one.ms_per_s;
    }
  }
  std::array<bool, terms> used{true, true, true, true};
  for (;;) {
    const auto found = solve(matrix, right, used);
    if (!found) return std::nullopt;
    const auto lowest = std::ranges::min_element(*found);
    if (*lowest >= 0.0) return LoadCosts{(*found)[0], (*found)[1], (*found)[2], (*found)[3]};
    used[static_cast<size_t>(lowest - found->begin())] = false;
  }
}

double relative_error(std::span<const MeasuredLoad> measured,
                      const std::function<double(const MachineLoad&)>& fitted) {
  double squares = 0.0;
  for (const MeasuredLoad& one : measured) {
    const double off = one.ms_per_s / fitted(one.load) - 1.0;
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(std::max<size_t>(1, measured.size())));
}

SimulatedLoad SimulationCosts::at(double bots) const {
  SimulatedLoad before;
  for (SimulatedLoad next : loads) {
    // Measured by a clock: more bots do not take less.
    next.serial_ms_s = std::max(before.serial_ms_s, next.serial_ms_s);
    next.shared_ms_s = std::max(before.shared_ms_s, next.shared_ms_s);
    if (bots < next.bots) {
      const double part = (bots - before.bots) / (next.bots - before.bots);
      const auto between = [part](double from, double to) { return from + part * (to - from); };
      return {bots, between(before.serial_ms_s, next.serial_ms_s),
              between(before.shared_ms_s, next.shared_ms_s), between(before.pieces_alive, next.pieces_alive)};
    }
    before = next;
  }
  before.bots = bots;
  return before;
}

double MachineModel::simulation_thread_ms_s(double bots, double cores) const {
  const SimulatedLoad alone = simulation.at(bots);
  return simulation.idle_ms_s + simulation.in_server * (alone.serial_ms_s + alone.shared_ms_s / cores);
}

double MachineModel::ms_s(const MachineLoad& load) const {
  return simulation_thread_ms_s(load.bots, 1.0) + others.of(load);
}

double MachineModel::share(MachineLimit limit, const MachineLoad& load, const MachineLimits& limits) const {
  switch (limit) {
    case MachineLimit::processors:
      return ms_s(load) / (limits.cores * limits.usable * ms_per_s);
    case MachineLimit::simulation_thread:
      return simulation_thread_ms_s(load.bots, limits.cores) / (limits.usable * ms_per_s);
    case MachineLimit::work:
      return load.bots / simulation.bots_most;
    case MachineLimit::memory:
      return (sizes.mib + sizes.mib_onlooker * load.onlookers()) / limits.memory_mib;
    case MachineLimit::bandwidth:
      return sizes.kbit_s_shown * load.bots * load.onlookers() / (1000.0 * limits.mbit_s);
  }
  return 0.0;
}

Held MachineModel::bots_held(double viewers, const MachineLimits& limits) const {
  return least([&](MachineLimit limit, double bots) { return share(limit, {bots, viewers}, limits); });
}

Held MachineModel::viewers_held(double bots, const MachineLimits& limits) const {
  return least([&](MachineLimit limit, double viewers) { return share(limit, {bots, viewers}, limits); });
}

}  // namespace scree
