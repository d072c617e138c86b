// The paper's claims, each with what was measured of it, the rule by which it is judged, and the verdict.
#pragma once

#include <string>
#include <vector>

#include "bench/support/bench.h"
#include "studies/report/report.h"

namespace scree::paper {

enum class Verdict { confirmed, refuted, undecided };
std::string_view name_of(Verdict verdict);

/// Limits of the rules. Times up to same_ratio apart count as the same: a carved picture is another one than
/// before, with more edges and longer rays.
inline constexpr double same_ratio = 1.15;
inline constexpr double hardly_ratio = 1.25;  ///< times or bytes that hardly grow
inline constexpr double clearly_ratio = 1.5;  ///< degradation, spikes, growth
inline constexpr double steady_share = 0.95;  ///< of the time before, at least, where times rise steadily

/// Limits of a ratio, between which a claim is undecided. A claim that the ratio is large has the higher
/// limit first: it is confirmed from there on, and refuted up to the other one. A claim that it is small has
/// the lower one first.
struct RatioRule {
  double confirmed = 0.0;
  double refuted = 0.0;

  bool of_large() const { return confirmed > refuted; }
  Verdict judge(double ratio) const;
  /// "confirmed from 1.5 times on, refuted up to 1.1 times"
  std::string text() const;
  /// "wanted at least 1.5 times": for that verdict, which is not undecided.
  std::string wanted(Verdict verdict) const;
};

inline constexpr RatioRule rule_grows{clearly_ratio, hardly_ratio};
inline constexpr RatioRule rule_degrades{clearly_ratio, same_ratio};
inline constexpr RatioRule rule_hardly{hardly_ratio, clearly_ratio};
inline constexpr RatioRule rule_same{same_ratio, clearly_ratio};

struct Claim {
  std::string name;     ///< of its check: lower case and underscores
  std::string figures;  ///< the paper's: "16, 21"
  std::string says;     ///< the paper
  std::string found;    ///< here, with units
  std::string rule;     ///< "confirmed from 1.5 times on, refuted up to 1.1 times"
  Verdict verdict = Verdict::undecided;
};

/// "1 run", "3 runs"
std::string counted(int count, const std::string& what);

ReportTable claims_table(const std::vector<Claim>& claims);

}  // namespace scree::paper
