#include "tools/import/gdal/vrt_form.h"

#include <gdal_frmts.h>
#include <gdal_priv.h>

#include "tools/import/gdal/gdal_library.h"

namespace scree {

VrtForm::VrtForm() {
  prepare_gdal();
  GDALRegister_VRT();
}

VrtForm::~VrtForm() {
  for (const char* const name : {"VRT", "DERIVED"})
    if (GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(name); driver != nullptr) {
      GetGDALDriverManager()->DeregisterDriver(driver);
      delete driver;
    }
}

}  // namespace scree
