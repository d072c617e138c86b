// For tests that draw, under LeakSanitizer.
#pragma once

#include <dlfcn.h>
#include <link.h>

namespace scree {

/// Keeps every loaded library until the process ends. Otherwise Mesa's driver is unloaded with the context,
/// and LeakSanitizer reports the memory of its globals as leaks.
inline void pin_libraries() {
  dl_iterate_phdr(
      [](dl_phdr_info* library, size_t, void*) {
        ::dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        return 0;
      },
      nullptr);
}

}  // namespace scree
