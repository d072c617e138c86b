#include "python/arrays.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "python/rows.h"
#include "server/world/body_facts.h"

namespace scree::python {

namespace py = pybind11;

namespace {

std::array<float, 3> array_of(glm::vec3 v) {
  return {v.x, v.y, v.z};
}

/// A type of named members at their places.
class RowType {
 public:
  void member(const char* name, const char* format, size_t offset) {
    names_.append(name);
    formats_.append(format);
    offsets_.append(offset);
  }
  py::dtype type(size_t bytes) const {
    return py::dtype(names_, formats_, offsets_, static_cast<py::ssize_t>(bytes));
  }

 private:
  py::list names_, formats_, offsets_;
};

py::dtype body_type() {
  RowType row;
  row.member("id", "u4", offsetof(BodyTableRow, id));
  row.member("is_piece", "?", offsetof(BodyTableRow, is_piece));
  row.member("kept", "?", offsetof(BodyTableRow, kept));
  row.member("awake", "?", offsetof(BodyTableRow, awake));
  row.member("position_m", "(3,)f4", offsetof(BodyTableRow, position_m));
  row.member("rotation", "(4,)f4", offsetof(BodyTableRow, rotation));
  row.member("velocity_m_s", "(3,)f4", offsetof(BodyTableRow, velocity_m_s));
  row.member("spin_rad_s", "(3,)f4", offsetof(BodyTableRow, spin_rad_s));
  row.member("mass_kg", "f4", offsetof(BodyTableRow, mass_kg));
  row.member("reach_m", "f4", offsetof(BodyTableRow, reach_m));
  row.member("mass_units", "i8", offsetof(BodyTableRow, mass_units));
  row.member("tag", "u8", offsetof(BodyTableRow, tag));
  return row.type(sizeof(BodyTableRow));
}

py::dtype ledger_type() {
  RowType row;
  row.member("tick", "u8", offsetof(LedgerRow, tick));
  row.member("terrain", "i8", offsetof(LedgerRow, terrain));
  row.member("pieces", "i8", offsetof(LedgerRow, pieces));
  row.member("dust", "i8", offsetof(LedgerRow, dust));
  row.member("poured", "i8", offsetof(LedgerRow, poured));
  row.member("moved", "i8", offsetof(LedgerRow, moved));
  row.member("stored", "i8", offsetof(LedgerRow, stored));
  row.member("error", "i8", offsetof(LedgerRow, error));
  return row.type(sizeof(LedgerRow));
}

py::dtype event_type() {
  RowType row;
  row.member("tick", "u8", offsetof(EventTableRow, tick));
  row.member("kind", "U16", offsetof(EventTableRow, kind));
  row.member("place_m", "(3,)f4", offsetof(EventTableRow, place_m));
  row.member("volume_m3", "f4", offsetof(EventTableRow, volume_m3));
  row.member("pieces", "u4", offsetof(EventTableRow, pieces));
  row.member("session", "u8", offsetof(EventTableRow, session));
  row.member("body", "u4", offsetof(EventTableRow, body));
  row.member("other", "u4", offsetof(EventTableRow, other));
  row.member("impulse_n_s", "f4", offsetof(EventTableRow, impulse_n_s));
  row.member("energy_j", "f4", offsetof(EventTableRow, energy_j));
  row.member("text", "U64", offsetof(EventTableRow, text));
  return row.type(sizeof(EventTableRow));
}
static_assert(event_kind_length == 16 && event_text_length == 64);

/// UTF-8 as Python reads it, cut to the length; broken bytes become U+FFFD.
template <size_t Length>
void put_text(std::string_view text, std::array<uint32_t, Length>& to) {
  to.fill(0);
  const py::object decoded = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
  if (!decoded) throw py::error_already_set();
  const auto length = std::min(static_cast<size_t>(PyUnicode_GET_LENGTH(decoded.ptr())), Length);
  for (size_t i = 0; i < length; ++i) to[i] = PyUnicode_READ_CHAR(decoded.ptr(), static_cast<Py_ssize_t>(i));
}

}  // namespace

BodyTableRow row_of_body(const BodyFacts& facts) {
  BodyTableRow row{};
  row.id = facts.id;
  row.is_piece = facts.is_piece;
  row.kept = facts.kept;
  row.awake = facts.awake;
  row.position_m = array_of(facts.pose.position_m);
  const glm::quat& turn = facts.pose.rotation;
  row.rotation = {turn.w, turn.x, turn.y, turn.z};
  row.velocity_m_s = array_of(facts.velocity_m_s);
  row.spin_rad_s = array_of(facts.spin_rad_s);
  row.mass_kg = facts.mass_kg;
  row.reach_m = facts.reach_m;
  row.mass_units = facts.mass;
  row.tag = facts.tag;
  return row;
}

LedgerRow row_of_ledger(uint64_t tick, const Ledger& ledger) {
  return {tick,          ledger.terrain, ledger.pieces, ledger.dust,
          ledger.poured, ledger.moved,   ledger.stored, ledger.error()};
}

std::vector<EventTableRow> rows_of_events(std::span<const Event> events) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<EventTableRow> rows;
  rows.reserve(events.size());
  for (const Event& event : events) {
    EventTableRow& row = rows.emplace_back();
    row.tick = event.tick;
    put_text(name_of(event.kind), row.kind);
    row.place_m = event.place_m ? array_of(*event.place_m) : std::array{none, none, none};
    row.volume_m3 = event.volume_m3;
    row.pieces = event.pieces;
    row.session = event.session;
    row.body = event.body;
    row.other = event.other;
    row.impulse_n_s = event.impulse_n_s;
    row.energy_j = event.energy_j;
    put_text(event.text, row.text);
  }
  return rows;
}

void add_row_types(py::module_& module) {
  module.attr("body_type") = body_type();
  module.attr("ledger_type") = ledger_type();
  module.attr("event_type") = event_type();
}

pybind11::array bodies_over(std::vector<BodyTableRow>&& rows) {
  const auto size = static_cast<py::ssize_t>(rows.size());
  return array_over(std::move(rows), {size}, body_type());
}

pybind11::array ledgers_over(std::vector<LedgerRow>&& rows) {
  const auto size = static_cast<py::ssize_t>(rows.size());
  return array_over(std::move(rows), {size}, ledger_type());
}

pybind11::array events_over(std::vector<EventTableRow>&& rows) {
  const auto size = static_cast<py::ssize_t>(rows.size());
  return array_over(std::move(rows), {size}, event_type());
}

}  // namespace scree::python
