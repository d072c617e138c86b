// For tests that draw, under LeakSanitizer.
#pragma once

#include <dlfcn.h>
#include <link.h>

namespace scree {

/// Keeps every library that is loaded now until the process ends. Mesa's driver is unloaded with the context,
/// and what its globals point to would look like leaks of nobody's to LeakSanitizer.
inline void keep_libraries_loaded() {
  dl_iterate_phdr(
      [](dl_phdr_info* library, size_t, void*) {
        ::dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        return 0;
      },
      nullptr);
}

}  // namespace scree
