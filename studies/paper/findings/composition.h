// The report of the paper's experiments, composed of what they measured: every figure in its text, every
// verdict and every check follows from the findings. Pure: no clock, no drawing.
#pragma once

#include "studies/paper/findings/claims.h"
#include "studies/paper/findings/findings.h"
#include "studies/support/study.h"

namespace scree::paper {

/// What the sections add to besides themselves.
struct Conclusions {
  std::vector<Claim> claims;
  BenchReport figures;
};

/// "what the paper found", "what Scree shows" and "why", under the number of the paper's figure.
struct FigureText {
  std::string title;
  std::string paper;
  std::string scree;
  std::string why;
};
ReportSection figure_section(const FigureText& text, std::vector<Plot> plots,
                             std::vector<ReportTable> tables = {});

/// A note on the paper's list of carves (bench/peers/csg_list.h), wherever it stands beside the atlas.
inline constexpr std::string_view list_draws_otherwise =
    "The list draws a terrain of its own noise, by a plain sun and without pieces: how much slower it gets "
    "can "
    "be compared with the atlas, its milliseconds cannot.";

/// Figures 16 to 18 and 21 to 23.
std::vector<ReportSection> baseline_sections(const Findings& found, Conclusions& conclusions);
/// Figures 24 and 25.
std::vector<ReportSection> carving_sections(const Findings& found, Conclusions& conclusions);
/// Figures 26 to 28.
std::vector<ReportSection> physics_sections(const Findings& found, Conclusions& conclusions);

/// All of it.
StudyResult compose(const Findings& found);

}  // namespace scree::paper
