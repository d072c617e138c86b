#include "server/store/store_fault.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace scree {

namespace {

constexpr std::array all_faults{StoreFault::full,  StoreFault::too_large, StoreFault::read_only_disk,
                                StoreFault::held,  StoreFault::read_only, StoreFault::moved,
                                StoreFault::hangs, StoreFault::closed,    StoreFault::fails};

}  // namespace

std::optional<StoreFault> fault_in(std::string_view message) {
  for (const StoreFault fault : all_faults)
    if (message.find(row_of(fault).words) != std::string_view::npos) return fault;
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
  const std::string words(row_of(*fault).words);
  return error_number == 0 ? words : fmt::format("{} ({})", words, std::strerror(error_number));
}

}  // namespace scree
