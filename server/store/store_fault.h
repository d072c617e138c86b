// Why a file of the server cannot be written, or read, just now. The words are part of the error's message,
// so that an error of any depth still says its kind: for health, which names no files, and for trying again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scree {

/// What may pass by itself, or by somebody who makes room. All other errors are of the file's content.
enum class StoreFault : uint8_t {
  full,
  too_large,
  read_only_disk,
  read_only,
  held,
  moved,
  closed,
  hangs,
  fails
};

struct StoreFaultRow {
  std::string_view words;
  bool is_refusal = false;  ///< the system refused: the error says nothing of the file
};

constexpr StoreFaultRow row_of(StoreFault fault) {
  switch (fault) {
    case StoreFault::full:
      return {.words = "the disk is full", .is_refusal = true};
    case StoreFault::too_large:
      return {.words = "the file has reached a limit of its size", .is_refusal = true};
    case StoreFault::read_only_disk:
      return {.words = "the disk is read-only", .is_refusal = true};
    case StoreFault::read_only:
      return {.words = "its permissions forbid it"};
    case StoreFault::held:
      return {.words = "another program holds the file"};
    case StoreFault::moved:
      return {.words = "the file was moved or removed"};
    case StoreFault::closed:
      return {.words = "the system does not open it"};
    case StoreFault::hangs:
      return {.words = "the disk does not answer"};
    case StoreFault::fails:
      return {.words = "the disk fails"};
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
