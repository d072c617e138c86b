// The files of one recording. A recording that could not be written for a while goes on in another part,
// beside the file that was named: session.scree, session-2.scree, session-3.scree. Each part plays and
// verifies by itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

/// "session.scree" for part 1, "session-2.scree" for part 2.
std::string recording_part(const std::string& path, uint32_t part);
/// The parts that there are, the oldest first; some may be gone. Files that stand beside one, as logs, count.
std::vector<std::string> recording_parts(const std::string& path);
/// The file of a new part, after all that there are.
Result<std::string> next_recording_part(const std::string& path);

/// Removes a recording's file, and those beside it.
void remove_recording(const std::string& path);

}  // namespace scree
