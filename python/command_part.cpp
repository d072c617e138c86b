// Commands: a function for each request that a script may make. What is wrong with a request is the world's
// to say, in its reply; here numbers are only made sure to be numbers.
#include <cmath>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>

#include "python/arguments.h"
#include "python/errors.h"
#include "python/parts.h"
#include "server/command/command.h"
#include "shared/base/limits.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// A request with its name for people; the material is a row's number or, in a world, the row's name.
Command command_of(Request request) {
  return Command{.body = std::move(request)};
}

Material material_of(int64_t row) {
  return static_cast<Material>(whole_of(row, 0, static_cast<int64_t>(materials_max) - 1, "material"));
}

uint32_t id_of(int64_t id) {
  return static_cast<uint32_t>(whole_of(id, 0, UINT32_MAX, "the id"));
}

StoreName store_named(const std::string& name) {
  return name.empty() ? worlds_store() : named_store(name);
}

Command carve(const Shape& shape, int64_t seeds, const std::string& pattern, int64_t random_seed,
              const py::object& impact_m, double blast_speed_m_s, const py::object& authored_m,
              int64_t piece) {
  CarveRequest request{
      .shape = shape,
      .pattern = kind_of<SeedPattern>(pattern, "pattern"),
      .seeds = static_cast<uint32_t>(whole_of(seeds, 0, UINT32_MAX, "seeds")),
      .random_seed = static_cast<uint32_t>(whole_of(random_seed, 0, UINT32_MAX, "random_seed")),
      .impact_m = impact_m.is_none() ? centre_of(shape) : vector_of(impact_m, "impact_m"),
      .blast_speed_m_s = number_of(blast_speed_m_s, "blast_speed_m_s"),
      .piece = id_of(piece)};
  if (!authored_m.is_none()) {
    request.authored_m = places_of(authored_m, "authored_m");
    request.seeds = static_cast<uint32_t>(request.authored_m.size());
  }
  return command_of(std::move(request));
}

Command add_prop(const py::object& place_m, const std::string& part, const py::object& half_m,
                 const py::object& corners_m, const py::object& turn, const py::object& velocity_m_s,
                 const py::object& spin_rad_s, const std::string& motion, double mass_kg, int64_t material,
                 int64_t tag) {
  PropPart only{.kind = kind_of<PropPartKind>(part, "part"), .half_m = vector_of(half_m, "half_m")};
  if (!corners_m.is_none()) only.corners_m = places_of(corners_m, "corners_m");
  AddPropRequest request;
  request.prop.parts = {std::move(only)};
  request.prop.motion = kind_of<PropMotion>(motion, "motion");
  request.prop.mass_kg = number_of(mass_kg, "mass_kg");
  request.prop.material = material_of(material);
  request.prop.tag = static_cast<uint64_t>(whole_of(tag, 0, INT64_MAX, "tag"));
  request.place_m = vector_of(place_m, "place_m");
  if (!turn.is_none()) request.turn = rotation_of(turn, "turn");
  request.velocity_m_s = vector_of(velocity_m_s, "velocity_m_s");
  request.spin_rad_s = vector_of(spin_rad_s, "spin_rad_s");
  return command_of(std::move(request));
}

Command move_prop(int64_t prop, const py::object& place_m, const py::object& turn,
                  const py::object& velocity_m_s, const py::object& spin_rad_s) {
  MovePropRequest request{.prop = id_of(prop)};
  if (!place_m.is_none()) request.place_m = vector_of(place_m, "place_m");
  if (!turn.is_none()) request.turn = rotation_of(turn, "turn");
  if (!velocity_m_s.is_none()) request.velocity_m_s = vector_of(velocity_m_s, "velocity_m_s");
  if (!spin_rad_s.is_none()) request.spin_rad_s = vector_of(spin_rad_s, "spin_rad_s");
  return command_of(request);
}

void add_edits(py::module_& module) {
  module.def("carve", &carve, py::arg("shape"), py::arg("seeds") = CarveRequest().seeds,
             py::arg("pattern") = std::string(name_of(usual_pattern)), py::arg("random_seed") = 0,
             py::arg("impact_m") = py::none(), py::arg("blast_speed_m_s") = CarveRequest().blast_speed_m_s,
             py::arg("authored_m") = py::none(), py::arg("piece") = 0,
             "Takes the shape out of the terrain, or out of a piece, and breaks it about so many seeds into "
             "pieces.");
  module.def(
      "fill",
      [](const Shape& shape, std::optional<int64_t> material) {
        FillRequest request{shape};
        if (material) request.material = material_of(*material);
        return command_of(request);
      },
      py::arg("shape"), py::arg("material") = py::none(),
      "Pours rock into the shape; its mass is poured in.");
  module.def(
      "paint",
      [](const Shape& shape, int64_t material) {
        return command_of(PaintRequest{shape, material_of(material)});
      },
      py::arg("shape"), py::arg("material"),
      "The rock in the shape becomes this material, a row of the palette.");
  module.def(
      "blast",
      [](const py::object& centre_m, double energy_j, int64_t random_seed) {
        return command_of(
            BlastRequest{vector_of(centre_m, "centre_m"), number_of(energy_j, "energy_j"),
                         static_cast<uint32_t>(whole_of(random_seed, 0, UINT32_MAX, "random_seed"))});
      },
      py::arg("centre_m"), py::arg("energy_j") = BlastRequest().energy_j, py::arg("random_seed") = 0,
      "Sets energy free at a place; joules.");
  module.def(
      "dig",
      [](const Shape& shape, int64_t piece, const std::string& store) {
        return command_of(DigRequest{shape, id_of(piece), store_named(store)});
      },
      py::arg("shape"), py::arg("piece") = 0, py::arg("store") = "",
      "Takes the terrain in the shape, or a piece, into a store, without pieces and dust. No name: the "
      "world's store.");
  module.def(
      "place",
      [](const Shape& shape, int64_t material, bool solid, const std::string& store) {
        return command_of(PlaceRequest{shape, material_of(material), solid, store_named(store)});
      },
      py::arg("shape"), py::arg("material") = 0, py::arg("solid") = false, py::arg("store") = "",
      "Fills the shape out of a store.");
  module.def(
      "cut_out", [](const Shape& shape) { return command_of(CutOutRequest{shape}); }, py::arg("shape"),
      "The terrain in the shape becomes a body that is kept until it is released.");
}

void add_body_commands(py::module_& module) {
  module.def("add_prop", &add_prop, py::arg("place_m"), py::arg("part") = "box",
             py::arg("half_m") = py::make_tuple(0.5, 0.5, 0.5), py::arg("corners_m") = py::none(),
             py::arg("turn") = py::none(), py::arg("velocity_m_s") = py::make_tuple(0, 0, 0),
             py::arg("spin_rad_s") = py::make_tuple(0, 0, 0), py::arg("motion") = "dynamic",
             py::arg("mass_kg") = 0.0, py::arg("material") = 0, py::arg("tag") = 0,
             "Adds a body of one convex part (box, sphere, capsule, cylinder, hull); the reply has its id.");
  module.def(
      "remove_prop", [](int64_t prop) { return command_of(RemovePropRequest{id_of(prop)}); }, py::arg("prop"),
      "Removes a prop.");
  module.def("move_prop", &move_prop, py::arg("prop"), py::arg("place_m") = py::none(),
             py::arg("turn") = py::none(), py::arg("velocity_m_s") = py::none(),
             py::arg("spin_rad_s") = py::none(),
             "Puts a prop elsewhere, or changes how it moves; what is left out stays.");
  module.def(
      "push",
      [](int64_t body, const py::object& impulse_n_s, const py::object& at_m) {
        return command_of(
            PushRequest{id_of(body), vector_of(impulse_n_s, "impulse_n_s"), vector_of(at_m, "at_m")});
      },
      py::arg("body"), py::arg("impulse_n_s"), py::arg("at_m"),
      "Gives a body an impulse at a place in the world.");
  module.def(
      "break_piece",
      [](int64_t piece, const py::object& at_m, int64_t seeds, int64_t random_seed) {
        return command_of(
            BreakRequest{id_of(piece), vector_of(at_m, "at_m"),
                         static_cast<uint32_t>(whole_of(seeds, 0, UINT32_MAX, "seeds")),
                         static_cast<uint32_t>(whole_of(random_seed, 0, UINT32_MAX, "random_seed"))});
      },
      py::arg("piece"), py::arg("at_m"), py::arg("seeds") = BreakRequest().seeds, py::arg("random_seed") = 0,
      "Breaks a piece where it is, about a place in the world.");
  module.def(
      "release", [](int64_t piece) { return command_of(ReleaseRequest{id_of(piece)}); }, py::arg("piece"),
      "A piece that is kept may become terrain from now on.");
  module.def(
      "setting",
      [](const std::string& name, const py::object& value) {
        return command_of(SettingsRequest{{{name, std::string(py::str(value))}}});
      },
      py::arg("name"), py::arg("value"), "Changes a setting of the world, such as recombine.");
}

}  // namespace

void add_commands(py::module_& module) {
  py::class_<Command>(module, "Command", "A request to a world, for World.step() and Batch.advance().")
      .def("__repr__", [](const Command& command) {
        const auto shape = shape_of(command.body);
        return "<scree.Command" + (shape ? " at " + std::string(py::str(tuple_of(centre_of(*shape)))) : "") +
               ">";
      });
  add_edits(module);
  add_body_commands(module);
}

}  // namespace scree::python
