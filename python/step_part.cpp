// What came of ticks: replies, events, the ledger and the hashes.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/held_world.h"
#include "python/parts.h"
#include "python/step_dict.h"

namespace scree::python {

namespace py = pybind11;

namespace {

template <typename T>
py::object or_none(const std::optional<T>& value) {
  return value ? py::cast(*value) : py::none();
}

}  // namespace

py::dict dict_of(const Ledger& ledger) {
  py::dict dict;
  dict["terrain"] = ledger.terrain;
  dict["pieces"] = ledger.pieces;
  dict["dust"] = ledger.dust;
  dict["poured"] = ledger.poured;
  dict["moved"] = ledger.moved;
  dict["stored"] = ledger.stored;
  dict["error"] = ledger.error();
  return dict;
}

void add_steps(py::module_& module) {
  py::class_<Reply>(module, "Reply", "The answer to a command.")
      .def_readonly("number", &Reply::request, "The command's number, as Step.numbers has it.")
      .def_property_readonly(
          "accepted", [](const Reply& reply) { return reply.refusal.empty(); }, "Whether it was carried out.")
      .def_readonly("refusal", &Reply::refusal, "Why it was refused, in words; empty: it was not.")
      .def_property_readonly("reason", &refusal_name,
                             "The refusal's name, such as carve_invalid; empty likewise.")
      .def_readonly("pieces", &Reply::pieces, "Pieces that it made.")
      .def_property_readonly(
          "body", [](const Reply& reply) { return or_none(reply.prop); }, "Id of the body added.")
      .def_property_readonly(
          "mass_units", [](const Reply& reply) { return or_none(reply.mass); },
          "Mass dug or placed, in units of 1/254 voxel.")
      .def("__repr__", [](const Reply& reply) {
        return "<scree.Reply " + std::to_string(reply.request) + ": " +
               (reply.refusal.empty() ? "accepted" : reply.refusal) + ">";
      });
  py::class_<Step>(module, "Step", "What came of some ticks in a row.")
      .def_readonly("tick", &Step::tick, "The last of them.")
      .def_readonly("replies", &Step::replies, "In order; a command that waits is answered in a later step.")
      .def_readonly("numbers", &Step::numbers, "The numbers of the commands that were given, in their order.")
      .def_property_readonly(
          "refused",
          [](const Step& step) {
            std::vector<Reply> refused;
            for (const Reply& reply : step.replies)
              if (!reply.refusal.empty()) refused.push_back(reply);
            return refused;
          },
          "The replies that refuse.")
      .def_property_readonly(
          "events", [](const Step& step) { return events_over(rows_of_events(step.events)); },
          "What happened, as an array of scree.event_type.")
      .def_property_readonly(
          "ledger", [](const Step& step) { return dict_of(step.ledger); },
          "Where the mass is, in units of 1/254 voxel.")
      .def_readonly("operations", &Step::operations, "Changes of the terrain, and breaks.")
      .def_readonly("state_hash", &Step::state_hash)
      .def_readonly("field_hash", &Step::field_hash)
      .def("__repr__", [](const Step& step) {
        return "<scree.Step tick " + std::to_string(step.tick) + ", " + std::to_string(step.replies.size()) +
               " replies, " + std::to_string(step.events.size()) + " events>";
      });
}

}  // namespace scree::python
