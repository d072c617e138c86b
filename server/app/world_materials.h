// A world's palette from a file (--materials): of a new world, and of one that goes on.
#pragma once

#include <memory>
#include <string>

#include "server/app/live_server.h"
#include "server/formats/recording_codec.h"

namespace scree {

/// Reads the file of a palette and its images, and gives both to the server's configuration, whose ground is
/// set already. Refuses a palette that is not of the materials of the ground's stored bricks.
Result<void> set_materials(const std::string& path, LiveConfig& config);

/// Gives a kept world's header the palette with which it goes on; null: it stays. Refuses one that is not the
/// kept palette with other numbers, or with more rows.
Result<void> give_materials(RecordedHeader& header, const std::shared_ptr<const Palette>& materials);

/// Logs how many images the palette names that are not there: a world keeps its palette, but no images.
void tell_missing_images(const Palette& palette, const ContentFiles* images);

}  // namespace scree
