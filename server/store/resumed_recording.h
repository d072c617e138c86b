// Whether a world may go on with a recording. Internal to RecordingWriter.
#pragma once

#include <string>

#include "server/store/recording.h"

namespace scree {

/// The header of the recording, if it is of this world and reaches to the tick of `start`, whose state it
/// had; else the error says what it is.
Result<RecordingHeader> header_to_resume(const std::string& path, const RecordingHeader& header,
                                         const TickDelta& start);

}  // namespace scree
