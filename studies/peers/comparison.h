// What was measured beside one peer: each figure several times, Scree's and the peer's in turns, with the
// noise within which their ratio is said to lie. What is claimed is the ratio: a machine that is slower for a
// while is so for both sides.
#pragma once

#include <string>
#include <vector>

#include "bench/support/bench.h"

namespace scree {

struct ReportSection;
struct ReportTable;

struct Comparison {
  std::string name;                 ///< of its metrics: snake_case, unit last
  std::string what;                 ///< for people, with its unit
  double noise_percent = 0.0;       ///< stated: largest spread()
  bool more_is_better = false;      ///< of rates; all else costs
  std::string label = {};           ///< of the plot of ratios; empty: it is not in it
  std::vector<double> ours = {};    ///< a value of each run; empty: Scree does no such thing
  std::vector<double> theirs = {};  ///< likewise, of the peer; as many, when there are any of both

  /// How many times better Scree is than the peer, run by run; empty: there is no such figure, as where one
  /// side has nothing, or a value that is not above 0.
  std::vector<double> ratios() const;
  /// Their median; 0: there are none.
  double ratio() const;
  /// The spread of the ratios, in percent; where there are none, that of the side that has values.
  double spread() const;
};

/// Distance of the largest value from the smallest, in percent of the median; 0 of less than two values.
double spread_percent(const std::vector<double>& values);

/// One peer.
struct PeerFindings {
  std::string peer;                     ///< with its version
  std::string name;                     ///< of its metrics and checks: snake_case
  std::vector<std::string> conditions;  ///< paragraphs: what each side did
  std::vector<Comparison> figures = {};
  std::vector<Check> checks = {};  ///< of the results that were timed
  std::string missing = {};        ///< why nothing was measured; empty: it was

  /// The figure of that name, made if need be by the first run.
  Comparison& figure(const std::string& name, const std::string& what, double noise_percent,
                     bool more_is_better = false);
  /// A check over all runs: it fails if it failed once.
  void check(const std::string& check_name, bool passed, const std::string& detail);
};

/// Metrics of each figure (medians as "own_…" and "peer_…", and "ratio_…"), a check that its runs lie within
/// its noise, where there are two runs at least, and the peer's own checks.
void report_findings(const PeerFindings& findings, BenchReport& report);

/// All peers in one table, and a section for each with its conditions.
ReportTable table_of(const std::vector<PeerFindings>& all);
ReportSection section_of(const PeerFindings& findings);

}  // namespace scree
