// systemd's journal, by its own protocol.
#pragma once

#include <memory>
#include <spdlog/sinks/sink.h>
#include <string>

namespace scree {

/// Whether the descriptor leads to the journal: `stream` is JOURNAL_STREAM as systemd sets it,
/// "device:inode", or null. A program that has sent its standard error elsewhere inherits the variable all
/// the same.
bool is_journal(const char* stream, int descriptor);

/// Each line is an entry with MESSAGE, PRIORITY, SYSLOG_IDENTIFIER (the program), SCREE_PART, and
/// SCREE_SESSION where the line is about one.
spdlog::sink_ptr journal_sink(const std::string& program);

}  // namespace scree
