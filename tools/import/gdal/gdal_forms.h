// The forms of rasters that GDAL may read here, and its file systems. Internal to what uses GDAL.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Leaves GDAL the forms whose files hold their numbers themselves, and its file systems for archives: no
/// file leads it to other files, to a database or to the network. After GDALAllRegister().
void leave_allowed_forms();

/// Refuses a file that only names others (VRT, WMS and the like), by its first bytes. `address`: as GDAL
/// opens it.
Result<void> check_holds_numbers(const std::string& address);

}  // namespace scree
