// Recordings, for reading alone.
#include <atomic>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/arguments.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/parts.h"
#include "python/step_dict.h"
#include "server/store/recording_reader.h"
#include "shared/operation/per_operation.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// A recording that one thread at a time reads.
class HeldRecording {
 public:
  explicit HeldRecording(std::unique_ptr<RecordingReader> reader) : reader_(std::move(reader)) {}

  /// Calls read(RecordingReader&) without Python's lock; raises where another thread does.
  template <typename Read>
  auto use(const Read& read) {
    if (in_use_.exchange(true, std::memory_order_acquire))
      throw RaisedError("this recording is in use: another thread has not ended its call yet");
    const Leave leave{in_use_};
    const py::gil_scoped_release unlocked;
    return read(*reader_);
  }
  const RecordingReader& facts() const { return *reader_; }

 private:
  struct Leave {
    std::atomic<bool>& in_use;
    ~Leave() { in_use.store(false, std::memory_order_release); }
  };
  std::unique_ptr<RecordingReader> reader_;
  std::atomic<bool> in_use_{false};
};

using SharedRecording = std::shared_ptr<HeldRecording>;

/// Its ticks from … to, by what Python says; None: from the first, to the last.
struct TickSpan {
  Tick from = 0, to = 0;
};
TickSpan span_of(const HeldRecording& held, const std::optional<int64_t>& first,
                 const std::optional<int64_t>& last) {
  const auto from = static_cast<int64_t>(held.facts().first_tick()),
             to = static_cast<int64_t>(held.facts().last_tick());
  return {static_cast<Tick>(whole_of(first.value_or(from), from, to, "first")),
          static_cast<Tick>(whole_of(last.value_or(to), from, to, "last"))};
}

SharedRecording open(const py::object& path) {
  const std::string name = py::str(py::module_::import("os").attr("fspath")(path));
  auto reader = [&] {
    const py::gil_scoped_release unlocked;
    return RecordingReader::open(name);
  }();
  return std::make_shared<HeldRecording>(value_of(std::move(reader)));
}

RecordedFrame frame(HeldRecording& held, int64_t tick) {
  const TickSpan one = span_of(held, tick, tick);
  return value_of(held.use([&](RecordingReader& reader) { return reader.frame(one.from); }));
}

py::array ledger(HeldRecording& held, std::optional<int64_t> first, std::optional<int64_t> last) {
  const TickSpan span = span_of(held, first, last);
  std::vector<LedgerRow> rows;
  value_of(held.use([&](RecordingReader& reader) -> Result<void> {
    for (Tick tick = span.from; tick <= span.to; ++tick) {
      const RecordedFrame read = TRY(reader.frame(tick));
      rows.push_back(row_of_ledger(tick, read.ledger));
    }
    return {};
  }));
  return ledgers_over(std::move(rows));
}

py::array events(HeldRecording& held, std::optional<int64_t> first, std::optional<int64_t> last) {
  const TickSpan span = span_of(held, first, last);
  const auto read =
      value_of(held.use([&](RecordingReader& reader) { return reader.events(span.from, span.to); }));
  return events_over(rows_of_events(read));
}

py::array ticks(const HeldRecording& held) {
  std::vector<uint64_t> all;
  for (Tick tick = held.facts().first_tick(); tick <= held.facts().last_tick(); ++tick) all.push_back(tick);
  const auto size = static_cast<py::ssize_t>(all.size());
  return array_over(std::move(all), {size});
}

py::array moved(const RecordedFrame& frame) {
  std::vector<BodyTableRow> rows;
  for (const PieceState& state : frame.moved) {
    const Pose pose = dequantise(state.pose);
    BodyTableRow& row = rows.emplace_back();
    row = {};
    row.id = state.id;
    row.is_piece = row.awake = true;
    row.position_m = {pose.position_m.x, pose.position_m.y, pose.position_m.z};
    row.rotation = {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z};
  }
  return bodies_over(std::move(rows));
}

py::dict header(const HeldRecording& held) {
  const RecordingHeader& header = held.facts().header();
  py::dict facts;
  facts["program"] = header.program;
  facts["terrain"] = std::string(name_of(header.world.terrain.kind));
  facts["seed"] = header.world.terrain.random_seed;
  facts["ground"] =
      header.world.ground == Digest{} ? py::none() : py::object(py::str(hex_of(header.world.ground)));
  facts["voxel_m"] = header.world.terrain.voxel_size_m;
  facts["tick_rate_hz"] = header.world.tick_rate_hz;
  std::vector<std::string> names;
  for (const auto name : header.world.palette->names()) names.emplace_back(name);
  facts["materials"] = names;
  return facts;
}

/// Goes from frame to frame.
struct Frames {
  SharedRecording recording;
  Tick next = 0;
};

RecordedFrame next_frame(Frames& frames) {
  if (frames.next > frames.recording->facts().last_tick()) throw py::stop_iteration();
  return frame(*frames.recording, static_cast<int64_t>(frames.next++));
}

void add_frames(py::module_& module) {
  py::class_<RecordedFrame>(module, "Frame", "What a recording has of a tick.")
      .def_readonly("tick", &RecordedFrame::tick)
      .def_readonly("state_hash", &RecordedFrame::state_hash)
      .def_readonly("field_hash", &RecordedFrame::field_hash)
      .def_property_readonly(
          "ledger", [](const RecordedFrame& frame) { return dict_of(frame.ledger); },
          "Where the mass is, in units of 1/254 voxel.")
      .def_property_readonly(
          "operations",
          [](const RecordedFrame& frame) {
            OperationCounts counts;
            for (const Operation& operation : frame.operations) ++counts[operation];
            py::dict all;
            counts.for_each([&](std::string_view name, uint64_t count) {
              if (count != 0) all[py::str(std::string(name))] = count;
            });
            return all;
          },
          "Changes of the terrain, and breaks: their numbers by name.")
      .def_property_readonly(
          "moved", &moved,
          "Bodies that are new or moved, as an array of scree.body_type: ids and poses alone.");
  py::class_<Frames>(module, "Frames", "Goes through a recording.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &next_frame);
}

}  // namespace

void add_recordings(py::module_& module) {
  add_frames(module);
  py::class_<HeldRecording, SharedRecording>(module, "Recording",
                                             "A recording of a server, for reading alone.")
      .def(py::init(&open), py::arg("path"), "Opens a file; scree.Error: it is damaged, or none.")
      .def_property_readonly("first_tick",
                             [](const HeldRecording& held) { return held.facts().first_tick(); })
      .def_property_readonly("last_tick", [](const HeldRecording& held) { return held.facts().last_tick(); })
      .def_property_readonly(
          "is_ended", [](const HeldRecording& held) { return held.facts().is_ended(); },
          "Whether it came to an end: else it is being written, or was cut short.")
      .def_property_readonly("keyframes", [](const HeldRecording& held) { return held.facts().keyframes(); })
      .def_property_readonly(
          "bytes", [](const HeldRecording& held) { return held.facts().bytes(); }, "The size of the file.")
      .def_property_readonly("header", &header,
                             "Program, terrain, seed, ground, voxel_m, tick_rate_hz, materials.")
      .def_property_readonly("ticks", &ticks, "Its ticks, uint64.")
      .def("ledger", &ledger, py::arg("first") = py::none(), py::arg("last") = py::none(),
           "The ledger after each tick, as an array of scree.ledger_type.")
      .def("events", &events, py::arg("first") = py::none(), py::arg("last") = py::none(),
           "What happened, as an array of scree.event_type.")
      .def("frame", &frame, py::arg("tick"), "What there is of a tick.")
      .def("__len__",
           [](const HeldRecording& held) { return held.facts().last_tick() - held.facts().first_tick() + 1; })
      .def("__iter__",
           [](const SharedRecording& held) {
             return Frames{held, held->facts().first_tick()};
           })
      .def("__repr__", [](const HeldRecording& held) {
        return "<scree.Recording " + held.facts().path() + ", ticks " +
               std::to_string(held.facts().first_tick()) + " to " + std::to_string(held.facts().last_tick()) +
               ">";
      });
}

}  // namespace scree::python
