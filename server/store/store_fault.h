// Why a file of the server cannot be written, or read, just now. The words are part of the error's message,
// so that an error of any depth still says its kind: for health, which names no files, and for trying again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shared/base/kind_table.h"

namespace scree {

/// What may pass by itself, or by somebody who makes room. All other errors are of the file's content.
enum class StoreFault : uint8_t {
  full = 0,
  too_large = 1,
  read_only_disk = 2,
  held = 3,
  read_only = 4,
  moved = 5,
  hangs = 6,
  closed = 7,
  fails = 8
};

struct StoreFaultRow {
  std::string_view name;    ///< in an error's message, for people; no other fault's name is part of it
  bool is_refusal = false;  ///< the system refused: the error says nothing of the file
};

constexpr StoreFaultRow row_of(StoreFault fault) {
  switch (fault) {
    case StoreFault::full:
      return {.name = "the disk is full", .is_refusal = true};
    case StoreFault::too_large:
      return {.name = "the file has reached a limit of its size", .is_refusal = true};
    case StoreFault::read_only_disk:
      return {.name = "the disk is read-only", .is_refusal = true};
    case StoreFault::read_only:
      return {.name = "its permissions forbid it"};
    case StoreFault::held:
      return {.name = "another program holds the file"};
    case StoreFault::moved:
      return {.name = "the file was moved or removed"};
    case StoreFault::closed:
      return {.name = "the system does not open it"};
    case StoreFault::hangs:
      return {.name = "the disk does not answer"};
    case StoreFault::fails:
      return {.name = "the disk fails"};
  }
  return {};
}

/// The fault that an error's message names.
std::optional<StoreFault> fault_in(std::string_view message);
/// The fault that the system's error number says; nothing where it is none of these.
std::optional<StoreFault> fault_of_system(int error_number);
/// The fault's words, with the system's own behind them; the system's alone where the number says no fault.
/// Number 0 has no words of the system's.
std::string words_of(std::optional<StoreFault> fault, int error_number);

}  // namespace scree
