// A plot as SVG, drawn by the program gnuplot, which gets its script and the data on its standard input.
#pragma once

#include <string>

#include "studies/report/report.h"

namespace scree {

/// The script that draws the plot into that file. Text from outside cannot end a string of it.
std::string gnuplot_script(const Plot& plot, const std::string& svg_file);

/// Runs gnuplot, which is looked for in PATH. Fails when it is missing (the error says how to get it), or
/// does not carry out the script; what it says itself goes to our standard error.
Result<void> run_gnuplot(const std::string& script);

}  // namespace scree
