// GDAL's VRT, for tests alone.
#pragma once

namespace scree {

/// While it lives, GDAL reads VRT in this process. No raster of VRT lives longer.
class VrtForm {
 public:
  VrtForm();
  ~VrtForm();
  VrtForm(const VrtForm&) = delete;
  VrtForm& operator=(const VrtForm&) = delete;
};

}  // namespace scree
