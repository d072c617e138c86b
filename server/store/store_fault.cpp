#include "server/store/store_fault.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace scree {

static_assert([] {
  for (const StoreFault a : all_kinds<StoreFault>)
    for (const StoreFault b : all_kinds<StoreFault>)
      if (a != b && row_of(a).name.find(row_of(b).name) != std::string_view::npos) return false;
  return true;
}());

std::optional<StoreFault> fault_in(std::string_view message) {
  for (const StoreFault fault : all_kinds<StoreFault>)
    if (message.find(name_of(fault)) != std::string_view::npos) return fault;
  return std::nullopt;
}

std::optional<StoreFault> fault_of_system(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return StoreFault::full;
    case EFBIG:
      return StoreFault::too_large;
    case EROFS:
      return StoreFault::read_only_disk;
    case EACCES:
    case EPERM:
      return StoreFault::read_only;
    case EIO:
      return StoreFault::fails;
    default:
      return std::nullopt;
  }
}

std::string words_of(std::optional<StoreFault> fault, int error_number) {
  if (!fault) return std::strerror(error_number);
  const std::string words(name_of(*fault));
  return error_number == 0 ? words : fmt::format("{} ({})", words, std::strerror(error_number));
}

}  // namespace scree
