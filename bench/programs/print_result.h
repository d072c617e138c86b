// Prints the result of a bench or a study as a table, and writes it to a file.
#pragma once

#include <map>
#include <string>

#include "bench/results/stored_result.h"

namespace scree {

/// Metrics and checks stand in the order of `run`, which a result does not keep.
void print_result(const std::string& summary, const BenchReport& run, const StoredResult& result);

/// The options that a result keeps, by name.
std::map<std::string, std::string> asked_options(const BenchOptions& options);

/// Writes the file. An error goes to stderr and returns false.
bool write_stored(const StoredResult& result, const std::string& path);

}  // namespace scree
