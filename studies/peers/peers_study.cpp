// Scree beside today's peers: one table, and what each figure means.
#include <fmt/format.h>

#include "studies/peers/beside.h"
#include "studies/support/studies.h"

namespace scree {

namespace {

struct Peer {
  PeerFindings (*measure)(const PeerOptions&);
  double share;  ///< of the study's time, roughly
};

constexpr Peer measured_peers[] = {{beside_openvdb, 0.3},  {beside_level_set_fracture, 0.05},
                                   {beside_voronoi, 0.03}, {beside_nanovdb, 0.1},
                                   {beside_bullet, 0.22},  {beside_zstd, 0.03},
                                   {beside_luanti, 0.27}};

constexpr int runs = 3;

/// What others are measured by, and Debian 12 has no package of.
ReportSection absent_peers() {
  return {
      "Peers that Debian 12 does not have",
      {"Box3D, Jolt Physics, NVIDIA Blast, Manifold, fast-surface-nets, godot_voxel (Debian's Godot has no "
       "modules), Space Engineers, s&box and Teardown are not packaged, or not free: nothing here says how "
       "Scree compares with them. Bullet's VoronoiFracture is a demo that Debian does not build."}};
}

/// Ratios of the figures that have a label.
Plot ratios_of(const std::vector<PeerFindings>& all) {
  Plot plot;
  plot.name = "ratios";
  plot.title = "How many times better than its peer Scree is at the same work";
  plot.x_label = "figure";
  plot.y_label = "times, peer / Scree; below 1 the peer is better";
  plot.log_y = true;
  PlotSeries bars{"median of the runs", SeriesStyle::bars, {}};
  for (const PeerFindings& findings : all)
    for (const Comparison& each : findings.figures) {
      if (each.label.empty() || each.ratio() <= 0.0) continue;
      bars.points.emplace_back(static_cast<double>(plot.x_names.size()), each.ratio());
      plot.x_names.push_back(each.label);
    }
  plot.series.push_back(std::move(bars));
  return plot;
}

std::vector<std::string> summary_of(const std::vector<PeerFindings>& all) {
  std::vector<std::string> lines;
  for (const PeerFindings& findings : all) {
    std::string text;
    for (const Comparison& each : findings.figures)
      if (!each.label.empty() && each.ratio() > 0.0)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", each.label, figure(each.ratio()));
    if (!findings.missing.empty()) text = findings.missing;
    if (!text.empty())
      lines.push_back(fmt::format("**{}** (times as good as the peer): {}.", findings.peer, text));
  }
  return lines;
}

}  // namespace

Result<StudyResult> run_peers_study(const StudyOptions& options) {
  StudyResult result;
  std::vector<PeerFindings> all;
  double done = 0.0;
  for (const Peer& peer : measured_peers) {
    PeerOptions of_peer;
    of_peer.quick = options.quick;
    of_peer.runs = options.quick ? 1 : runs;
    of_peer.progress = [&](double part) { options.progress(done + part * peer.share); };
    all.push_back(peer.measure(of_peer));
    report_findings(all.back(), result.figures);
    done += peer.share;
    options.progress(done);
  }
  StudyReport& report = result.report;
  report.name = "peers";
  report.title = "Scree beside its peers";
  report.command = options.quick ? "./scree bench peers --quick" : "./scree bench peers";
  report.summary = summary_of(all);
  ReportSection whole{
      "All peers",
      {fmt::format(
          "Each figure was measured {} times, Scree and the peer in turns, in one run of one program on one "
          "machine; the ratio is the median of the runs' own. The spread is the distance of the largest from "
          "the smallest, in percent of the median. The noise is the spread that is stated for the ratio, or "
          "for the value of a figure without a ratio. A machine that is slower for a while is slower for "
          "both sides. The conditions of each peer are below.",
          options.quick ? 1 : runs)}};
  whole.tables.push_back(table_of(all));
  whole.plots.push_back(ratios_of(all));
  report.sections.push_back(std::move(whole));
  for (const PeerFindings& findings : all) report.sections.push_back(section_of(findings));
  report.sections.push_back(absent_peers());
  return result;
}

}  // namespace scree
