// A film as a folder of PNGs.
#pragma once

#include "tools/film/frame_sink.h"

namespace scree {

/// Makes the folder where it is missing. Refuses one that has numbered pictures already: a shorter film would
/// be mixed with them. Pictures of an unfinished film stay: each is whole. `sound`: a
/// file beside the folder that becomes its sound.wav in the end; empty: none.
Result<std::unique_ptr<FrameSink>> open_picture_folder(const std::string& folder, const std::string& sound);

}  // namespace scree
