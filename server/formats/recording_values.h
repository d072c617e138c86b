// Converts the values that recordings and world files share between our types and Protobuf's. Internal to
// server/formats.
#pragma once

#include <google/protobuf/message_lite.h>
#include <recording.pb.h>
#include <span>
#include <string>
#include <vector>

#include "proto/wire_values.h"
#include "server/formats/recording_codec.h"

namespace scree {

namespace limits {
/// Length of a program's name and version, bytes; an encoder cuts a longer one.
inline constexpr size_t program_bytes_max = 128;

/// Ticks of a burst of merges (RecordedHeader::merge_burst_ticks); more is refused.
inline constexpr uint32_t merge_burst_ticks_max = 1000;
}  // namespace limits

std::vector<uint8_t> bytes_of(const google::protobuf::MessageLite& message);

template <typename T>
Result<T> parsed(std::span<const uint8_t> bytes, const char* what) {
  T message;
  if (bytes.size() > INT32_MAX || !message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())))
    return fail(std::string(what) + ": not of this format");
  return message;
}

template <typename T>
Result<T> checked(T value, const FieldChecker& check) {
  if (check.failed()) return tl::unexpected(check.error());
  return value;
}

void write(recorded::Ledger& to, const Ledger& from);
/// Refuses masses beyond limits::ledger_mass_max.
Ledger read(const recorded::Ledger& from, FieldChecker& check);

void write(recorded::MaterialLedger& to, const MaterialLedger& from);
MaterialLedger read(const recorded::MaterialLedger& from, FieldChecker& check);

void write(recorded::Header& to, const RecordedHeader& from);
/// Reads nothing but the number of another format, whose fields may have another meaning.
RecordedHeader read(const recorded::Header& from, FieldChecker& check);

}  // namespace scree
