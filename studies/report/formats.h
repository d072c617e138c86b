// A report in its formats.
#pragma once

#include <string>
#include <vector>

#include "bench/support/machine.h"
#include "studies/report/report.h"

namespace scree {

/// Links to the plots' files in the folder that has the report's name.
std::string report_markdown(const StudyReport& report, const Machine& machine);

/// One page, whole in itself. `svgs`: of the plots, in their order, as gnuplot wrote them.
std::string report_html(const StudyReport& report, const Machine& machine,
                        const std::vector<std::string>& svgs);

/// A row for each point (its series, x and y; the spread and the name at x where the plot has such), and one
/// for each event, whose series is its kind. A number that is not finite is left out.
std::string plot_csv(const Plot& plot);

/// What both say of the machine: name and value.
std::vector<std::pair<std::string, std::string>> machine_rows(const Machine& machine);

}  // namespace scree
