// Before a world's file of an older format is saved for the first time, a copy of it is kept: an older
// release may refuse what a newer one has saved.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// The copy's name, "hill.world.before-v5"; further ones, of other moments, have a number behind it.
std::string name_of_older(const std::string& path, int number = 1);

/// Makes the checked copy, unless one of this moment is there already: who died between the copy and the save
/// has one.
Result<void> keep_older_world(const std::string& path);

}  // namespace scree
