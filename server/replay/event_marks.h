// Counts the events of a recording for a bar (proto/marks.h), a part of it with each call, so that no tick
// waits for a long one. The columns become longer with the recording; what they take does not. One thread at
// a time.
#pragma once

#include <array>
#include <memory>

#include "proto/marks.h"
#include "server/store/recording_reader.h"

namespace scree {

class EventMarks {
 public:
  /// Reads some more of a recording, always the same one, which may go on growing.
  Result<void> read_on(RecordingReader& recording);
  /// What has been read; the same value until it changes, once in some calls of read_on(). Null before the
  /// first.
  std::shared_ptr<const MarksMessage> message() const { return message_; }

  /// Counts one event; what read_on() does with those of a recording. In any order.
  void add(const Event& event);
  /// All that is counted.
  MarksMessage put_together() const;

 private:
  Result<void> read_up_to(RecordingReader& recording, Tick to);
  void lengthen_columns();

  using Columns = std::array<uint32_t, limits::mark_columns_max>;
  std::array<Columns, kind_count<EventKind>> counts_{};
  Tick first_ = 0;  ///< column 0 begins after it
  Tick ticks_per_column_ = 1;
  Tick read_to_ = 0;
  Tick machine_read_to_ = 0;  ///< tick of the machine's last row that was read
  Tick step_ = 0;             ///< ticks to read at once
  uint64_t calls_ = 0;
  bool begun_ = false;
  bool changed_ = false;
  std::shared_ptr<const MarksMessage> message_;
};

}  // namespace scree
