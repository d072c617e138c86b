#include "studies/paper/findings/claims.h"

#include <fmt/format.h>

#include "shared/base/check.h"

namespace scree::paper {

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::confirmed:
      return "confirmed";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

Verdict RatioRule::judge(double ratio) const {
  if (of_large() ? ratio >= confirmed : ratio <= confirmed) return Verdict::confirmed;
  return (of_large() ? ratio <= refuted : ratio >= refuted) ? Verdict::refuted : Verdict::undecided;
}

std::string RatioRule::text() const {
  return of_large()
             ? fmt::format("confirmed from {:g} times on, refuted up to {:g} times", confirmed, refuted)
             : fmt::format("confirmed up to {:g} times, refuted from {:g} times on", confirmed, refuted);
}

std::string RatioRule::wanted(Verdict verdict) const {
  CHECK(verdict != Verdict::undecided);
  const bool least = of_large() == (verdict == Verdict::confirmed);
  return fmt::format("wanted at {} {:g} times", least ? "least" : "most",
                     verdict == Verdict::confirmed ? confirmed : refuted);
}

std::string counted(int count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

ReportTable claims_table(const std::vector<Claim>& claims) {
  ReportTable table{"", {"the paper says", "its figure", "here", "rule", "verdict"}, {}};
  for (const Claim& claim : claims)
    table.rows.push_back({claim.says, claim.figures, claim.found, claim.rule,
                          "**" + std::string(name_of(claim.verdict)) + "**"});
  return table;
}

}  // namespace scree::paper
