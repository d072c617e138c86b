// Worlds: made, stepped, saved, copied and read.
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/arguments.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/excavation.h"
#include "python/held_world.h"
#include "python/parts.h"
#include "python/step_dict.h"
#include "python/world_functions.h"
#include "server/formats/world_codec.h"
#include "server/world/settings.h"
#include "server/world/world_snapshot.h"
#include "shared/base/limits.h"
#include "shared/base/workers.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// Ticks between two looks whether somebody wants to stop the program.
constexpr int64_t ticks_per_look = 60;

size_t threads_of(int64_t threads) {
  return static_cast<size_t>(whole_of(threads, 0, static_cast<int64_t>(Workers::threads_max), "threads"));
}

Held make_world(const WorldConfig& config, size_t threads) {
  Result<std::unique_ptr<World>> world = [&] {
    const py::gil_scoped_release unlocked;
    return World::create(config, threads);
  }();
  return std::make_shared<HeldWorld>(valid(std::move(world)));
}

Held restore(const py::bytes& bytes, int64_t threads) {
  char* data = nullptr;
  py::ssize_t size = 0;
  if (PyBytes_AsStringAndSize(bytes.ptr(), &data, &size) != 0) throw py::error_already_set();
  const size_t wanted = threads_of(threads);
  Result<std::unique_ptr<World>> world = [&]() -> Result<std::unique_ptr<World>> {
    const py::gil_scoped_release unlocked;
    const WorldSnapshot value =
        TRY(decode_world({reinterpret_cast<const uint8_t*>(data), static_cast<size_t>(size)}));
    return World::restore(value, wanted);
  }();
  return std::make_shared<HeldWorld>(value_of(std::move(world)));
}

Held fork(HeldWorld& held, int64_t threads) {
  const size_t wanted = threads_of(threads);
  const Use use(held);
  Result<std::unique_ptr<World>> world = [&] {
    const py::gil_scoped_release unlocked;
    Result<std::unique_ptr<World>> copy = World::restore(held.world().snapshot(), wanted);
    // What a copy cannot have, such as contacts, the world drops as well: so that both go on alike.
    if (copy) held.world().renew();
    return copy;
  }();
  held.follow_anew();
  return std::make_shared<HeldWorld>(value_of(std::move(world)));
}

py::bytes snapshot(HeldWorld& held) {
  const Use use(held);
  const std::vector<uint8_t> bytes = [&] {
    const py::gil_scoped_release unlocked;
    return encode(held.world().snapshot());
  }();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Step step(HeldWorld& held, const py::object& commands, int64_t ticks) {
  std::vector<Command> given = commands_of(commands);
  whole_of(ticks, 1, limits::ticks_max, "ticks");
  const Use use(held);
  Step step;
  step.numbers = held.number(given);
  for (int64_t done = 0; done < ticks;) {
    {
      const py::gil_scoped_release unlocked;
      for (int64_t i = 0; i < ticks_per_look && done < ticks; ++i, ++done)
        held.advance(done == 0 ? std::span<const Command>(given) : std::span<const Command>(), step);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return step;
}

Held make(const std::string& terrain, int64_t seed, double voxel_m, int64_t tick_rate_hz, int64_t threads,
          const py::kwargs& settings) {
  return make_world(config_of(terrain, seed, voxel_m, tick_rate_hz, settings), threads_of(threads));
}

py::array bodies(HeldWorld& held, bool pieces, bool props) {
  const Use use(held);
  // Beyond any place of a world, where what leaves it becomes dust.
  const glm::vec3 far(4.0F * scree::limits::world_half_width_m);
  std::vector<BodyTableRow> rows;
  for (const PieceId id : held.world().bodies_near(-far, far))
    if (const auto facts = held.world().body(id); facts && (facts->is_piece ? pieces : props))
      rows.push_back(row_of_body(*facts));
  return bodies_over(std::move(rows));
}

py::dict stores(HeldWorld& held) {
  const Use use(held);
  py::dict all;
  const Palette& palette = *held.world().config().palette;
  for (const StoreContent& content : held.world().stores()) {
    py::dict masses;
    for (const MaterialMass& one : content.masses)
      masses[py::str(std::string(palette.row_or_first(one.material).name))] = one.mass;
    all[py::str(content.store.kind == StoreKind::named ? content.store.name : text_of(content.store))] =
        masses;
  }
  return all;
}

py::dict settings_of(HeldWorld& held) {
  const Use use(held);
  py::dict all;
  for (const SettingValue& value : print(held.world().config())) all[py::str(value.name)] = value.value;
  return all;
}

void add_state(py::class_<HeldWorld, Held>& world) {
  world.def_property_readonly("tick", [](HeldWorld& held) { return Use(held), held.world().tick(); })
      .def_property_readonly("voxel_m", &HeldWorld::voxel_m, "Side of a voxel, metres.")
      .def_property_readonly(
          "tick_rate_hz", [](HeldWorld& held) { return Use(held), held.world().config().tick_rate_hz; },
          "Ticks of a second.")
      .def_property_readonly(
          "materials",
          [](HeldWorld& held) {
            const Use use(held);
            std::vector<std::string> names;
            for (const auto name : held.world().config().palette->names()) names.emplace_back(name);
            return names;
          },
          "Names of the materials, by number.")
      .def_property_readonly("settings", &settings_of, "How every setting stands, as text.")
      .def_property_readonly("stores", &stores, "Mass in each store by material, in units of 1/254 voxel.")
      .def(
          "ledger", [](HeldWorld& held) { return Use(held), dict_of(held.world().ledger()); },
          "Where the mass is, in units of 1/254 voxel: terrain + pieces + dust + stored = poured.")
      .def_property_readonly(
          "state_hash", [](HeldWorld& held) { return Use(held), held.state_hash(); },
          "The hash of terrain, bodies and ledger: equal worlds have equal ones.")
      .def_property_readonly(
          "field_hash", [](HeldWorld& held) { return Use(held), held.world().field().hash(); },
          "The hash of the terrain's edits.")
      .def("bodies", &bodies, py::arg("pieces") = true, py::arg("props") = true,
           "All bodies by id, as an array of scree.body_type.")
      .def(
          "pieces", [](HeldWorld& held) { return bodies(held, true, false); }, "The pieces alone, likewise.")
      .def("__repr__", [](HeldWorld& held) {
        const Use use(held);
        return "<scree.World " + std::string(name_of(held.world().config().terrain.kind)) + ", tick " +
               std::to_string(held.world().tick()) + ">";
      });
}

}  // namespace

WorldConfig config_of(const std::string& terrain, int64_t seed, double voxel_m, int64_t tick_rate_hz,
                      const py::dict& settings) {
  WorldConfig config;
  config.terrain.kind = kind_of<TerrainKind>(terrain, "terrain");
  config.terrain.random_seed = static_cast<uint32_t>(whole_of(seed, 0, UINT32_MAX, "seed"));
  config.terrain.voxel_size_m = number_of(voxel_m, "voxel_m");
  config.tick_rate_hz = static_cast<uint32_t>(whole_of(tick_rate_hz, 0, UINT32_MAX, "tick_rate_hz"));
  SettingValues values;
  for (const auto& [key, value] : settings) {
    std::string name = py::str(key);
    std::ranges::replace(name, '_', '-');
    const bool is_switch = py::isinstance<py::bool_>(value);
    values.push_back(
        {std::move(name), is_switch ? (value.cast<bool>() ? "true" : "false") : std::string(py::str(value))});
  }
  valid(set_all(config, values));
  return config;
}

std::vector<Command> commands_of(const py::object& commands) {
  if (py::isinstance<Command>(commands)) return {commands.cast<Command>()};
  if (commands.is_none()) return {};
  std::vector<Command> all;
  for (const py::handle one : commands) {
    if (!py::isinstance<Command>(one)) throw py::type_error("commands have to be of scree.Command");
    all.push_back(one.cast<Command>());
  }
  return all;
}

void add_worlds(py::module_& module) {
  py::class_<HeldWorld, Held> world(
      module, "World", "A world: terrain, pieces, props and their ledger, advanced tick by tick.");
  world
      .def(py::init(&make), py::arg("terrain") = "flat", py::arg("seed") = 1, py::arg("voxel_m") = 0.25,
           py::arg("tick_rate_hz") = 60, py::arg("threads") = 1,
           "A new world of a kind of terrain (flat, noise, canyon); further arguments are settings, such as "
           "recombine='stamp'.")
      .def("step", &step, py::arg("commands") = py::tuple(), py::arg("ticks") = 1,
           "Advances so many ticks; the commands come before the first.")
      .def("snapshot", &snapshot, "The world as bytes, which restore() takes.")
      .def_static("restore", &restore, py::arg("snapshot"), py::arg("threads") = 1,
                  "The world of a snapshot. Its bodies are awake and without contacts.")
      .def("fork", &fork, py::arg("threads") = 1,
           "A copy that goes on by itself: the same commands give the same hashes in both from here on. "
           "Bodies of both "
           "are awake and without contacts afterwards.")
      .def(
          "measure_terrain",
          [](HeldWorld& held) {
            const Use use(held);
            const py::gil_scoped_release unlocked;
            return held.world().measure_terrain();
          },
          "The terrain's gain since the start, measured from every edited brick: that of the ledger.");
  add_state(world);
  add_arrays_of(world);
  add_queries(module, world);
}

}  // namespace scree::python
