// The looks of a line of the log, for spdlog's sinks.
#pragma once

#include <memory>
#include <spdlog/formatter.h>

namespace scree {

std::unique_ptr<spdlog::formatter> text_lines();
std::unique_ptr<spdlog::formatter> json_lines();

}  // namespace scree
