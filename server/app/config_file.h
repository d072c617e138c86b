// The configuration file that a command line names, and what is wrong in it, with the line: CLI11 reads the
// file, but does not tell at which line it is wrong.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace scree {

/// The file that the option names; empty where it names none, or several. Does not throw, so that it can be
/// asked while an error is handled; Option::as() throws where parsing threw.
std::string named_file(const CLI::Option& config);

/// Why a file is no file of options, before a line of it is read: a pipe, a device, or more bytes or lines
/// than limits.h says. Empty where there is no such file, too: CLI11 says that.
std::string fault_of_file(const std::string& path);

/// What is wrong with an entry, taken alone; empty: nothing.
using EntryCheck = std::function<std::string(const CLI::ConfigItem&)>;

/// The first entry at fault of a refused file, with file and line; empty if no entry is at fault by itself,
/// or there is no such file.
std::string fault_in_file(const std::string& path, const EntryCheck& fault_of);

}  // namespace scree
