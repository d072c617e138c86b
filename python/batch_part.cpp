// Batches, and the environment of an excavation over one, in the form of Gymnasium's vector environments.
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/arguments.h"
#include "python/arrays.h"
#include "python/batch.h"
#include "python/errors.h"
#include "python/parts.h"
#include "python/vector_env.h"
#include "python/world_functions.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// Worlds of one batch. Above: refused; each has some megabytes.
constexpr int64_t batch_worlds_max = 65536;

using Actions = py::array_t<float, py::array::c_style | py::array::forcecast>;

py::object filled(const std::vector<py::ssize_t>& shape, float value) {
  return py::module_::import("numpy").attr("full")(py::cast(shape), value, py::arg("dtype") = "float32");
}

/// The environment: a batch, how its worlds are made, and its spaces.
class BatchEnvironment {
 public:
  BatchEnvironment(size_t count, py::object make, size_t threads, const Episode& episode)
      : make_(std::move(make)), batch_(count, threads, episode) {
    const Excavation& task = episode.task;
    const py::ssize_t cells = task.cells, n = static_cast<py::ssize_t>(count);
    const auto actions = [&](float sign, bool of_one) {
      py::object limits =
          filled(of_one ? std::vector<py::ssize_t>{3} : std::vector<py::ssize_t>{n, 3}, sign * task.half_m);
      limits[py::make_tuple(py::ellipsis(), 2)] = sign < 0.0F ? 0.0F : task.depth_max_m;
      return limits;
    };
    single_action_space = box_space(actions(-1.0F, true), actions(1.0F, true));
    action_space = box_space(actions(-1.0F, false), actions(1.0F, false));
    single_observation_space =
        box_space(filled({cells, cells}, task.floor_m), filled({cells, cells}, task.top_m));
    observation_space =
        box_space(filled({n, cells, cells}, task.floor_m), filled({n, cells, cells}, task.top_m));
    restart(std::vector<uint32_t>());
  }

  WorldBatch& batch() { return batch_; }

  /// New worlds of these seeds; of none: of the next ones.
  py::array reset(const std::vector<uint32_t>& seeds) {
    restart(seeds);
    return heights();
  }

  py::tuple step(const py::object& given) {
    const Actions actions = Actions::ensure(given);
    const auto n = static_cast<py::ssize_t>(batch_.size());
    if (!actions || actions.ndim() != 2 || actions.shape(0) != n || actions.shape(1) != 3) {
      PyErr_Clear();
      throw py::value_error("actions have to be an array of shape (" + std::to_string(n) +
                            ", 3): x, z and depth");
    }
    for (py::ssize_t i = 0; i < actions.size(); ++i)
      (void)number_of(static_cast<double>(actions.data()[i]), "an action");
    BatchUse use(batch_, false);
    std::vector<char> begins(batch_.size());
    for (size_t i = 0; i < begins.size(); ++i) begins[i] = static_cast<char>(batch_.is_over(i));
    begin_where(begins, {});
    use.take_worlds();
    std::vector<Outcome> outcomes(batch_.size());
    std::vector<float> seen = room_for_heights();
    {
      const py::gil_scoped_release unlocked;
      batch_.act({actions.data(), static_cast<size_t>(actions.size())}, begins, outcomes, seen);
    }
    return results(outcomes, std::move(seen));
  }

  std::vector<Step> advance(const py::object& commands, int64_t ticks) {
    whole_of(ticks, 1, limits::ticks_max, "ticks");
    std::vector<std::vector<Command>> given(batch_.size());
    if (!commands.is_none()) {
      if (py::len(commands) != batch_.size())
        throw py::value_error("there have to be commands for each of the " + std::to_string(batch_.size()) +
                              " worlds");
      size_t i = 0;
      for (const py::handle of_one : commands)
        given[i++] = commands_of(py::reinterpret_borrow<py::object>(of_one));
    }
    std::vector<Step> steps(batch_.size());
    const BatchUse use(batch_);
    for (size_t i = 0; i < given.size(); ++i) steps[i].numbers = batch_.worlds()[i]->number(given[i]);
    const py::gil_scoped_release unlocked;
    batch_.advance(given, ticks, steps);
    return steps;
  }

  py::object single_action_space, action_space, single_observation_space, observation_space;

 private:
  std::vector<float> room_for_heights() const {
    const auto cells = static_cast<size_t>(batch_.episode().task.cells);
    return std::vector<float>(batch_.size() * cells * cells);
  }
  py::array heights_over(std::vector<float>&& seen) const {
    const py::ssize_t cells = batch_.episode().task.cells;
    return array_over(std::move(seen), {static_cast<py::ssize_t>(batch_.size()), cells, cells});
  }
  py::array heights() {
    std::vector<float> seen = room_for_heights();
    const BatchUse use(batch_);
    {
      const py::gil_scoped_release unlocked;
      batch_.observe(seen);
    }
    return heights_over(std::move(seen));
  }
  void restart(const std::vector<uint32_t>& seeds) {
    const BatchUse use(batch_, false);
    begin_where(std::vector<char>(batch_.size(), 1), seeds);
  }

  /// New worlds where they are marked. By who has the use of the batch.
  void begin_where(const std::vector<char>& marked, const std::vector<uint32_t>& seeds) {
    std::vector<uint32_t> own(marked.size());
    for (size_t i = 0; i < marked.size(); ++i)
      if (marked[i] != 0) own[i] = seeds.empty() ? next_seed_++ : seeds[i];
    std::vector<Held> made(marked.size());
    if (make_.is_none()) {
      const py::gil_scoped_release unlocked;
      batch_.each([&](size_t i) {
        if (marked[i] == 0) return;
        WorldConfig config;
        config.terrain.kind = TerrainKind::flat;
        config.terrain.random_seed = own[i];
        made[i] = std::make_shared<HeldWorld>(std::make_unique<World>(config));
      });
    } else {
      for (size_t i = 0; i < marked.size(); ++i)
        if (marked[i] != 0) made[i] = made_by_caller(own[i]);
    }
    for (size_t i = 0; i < made.size(); ++i)
      if (made[i]) batch_.begin(i, std::move(made[i]));
  }
  Held made_by_caller(uint32_t seed) const {
    const py::object world = make_(seed);
    if (!py::isinstance<HeldWorld>(world)) throw py::type_error("make(seed) has to return a scree.World");
    return world.cast<Held>();
  }

  py::tuple results(const std::vector<Outcome>& outcomes, std::vector<float>&& seen) const {
    const auto n = static_cast<py::ssize_t>(outcomes.size());
    std::vector<double> rewards;
    std::vector<uint64_t> hashes;
    std::vector<uint8_t> cut_off, refused;
    for (size_t i = 0; i < outcomes.size(); ++i) {
      rewards.push_back(outcomes[i].moved_m3);
      hashes.push_back(outcomes[i].state_hash);
      refused.push_back(static_cast<uint8_t>(outcomes[i].refused));
      cut_off.push_back(static_cast<uint8_t>(batch_.is_over(i)));
    }
    py::dict infos;
    infos["state_hash"] = array_over(std::move(hashes), {n});
    infos["refused"] = bools_over(std::move(refused), {n});
    return py::make_tuple(heights_over(std::move(seen)), array_over(std::move(rewards), {n}),
                          bools_over(std::vector<uint8_t>(outcomes.size()), {n}),
                          bools_over(std::move(cut_off), {n}), infos);
  }

  py::object make_;
  WorldBatch batch_;
  uint32_t next_seed_ = 1;
};

std::unique_ptr<BatchEnvironment> make_batch(int64_t count, const py::object& make, int64_t ticks,
                                             int64_t steps, int64_t cells, double half_m, double reach_m,
                                             double depth_max_m, int64_t threads) {
  if (!make.is_none() && PyCallable_Check(make.ptr()) == 0)
    throw py::type_error("make has to be a function of a seed");
  const auto within = [](double value, double least, double most, const char* what) {
    if (value >= least && value <= most) return static_cast<float>(value);
    throw py::value_error(std::string(what) + " has to be within " + std::to_string(least) + " to " +
                          std::to_string(most) + " m");
  };
  Episode episode;
  episode.ticks = static_cast<int>(whole_of(ticks, 1, limits::ticks_max, "ticks"));
  episode.steps = static_cast<int>(whole_of(steps, 1, limits::ticks_max, "steps"));
  episode.task.cells = static_cast<int>(whole_of(cells, 1, 1024, "cells"));
  episode.task.half_m = within(half_m, 1.0, 1024.0, "half_m");
  episode.task.reach_m = within(reach_m, 0.25, 4.0, "reach_m");
  episode.task.depth_max_m = within(depth_max_m, 0.1, 8.0, "depth_max_m");
  return std::make_unique<BatchEnvironment>(
      static_cast<size_t>(whole_of(count, 1, batch_worlds_max, "n")), make,
      static_cast<size_t>(whole_of(threads, 0, static_cast<int64_t>(Workers::threads_max), "threads")),
      episode);
}

std::vector<uint32_t> seeds_of(const py::object& seed, size_t count) {
  std::vector<uint32_t> seeds;
  if (seed.is_none()) return seeds;
  const auto one = [](int64_t value) {
    return static_cast<uint32_t>(whole_of(value, 0, UINT32_MAX, "seed"));
  };
  if (py::isinstance<py::sequence>(seed)) {
    for (const py::handle each : seed) seeds.push_back(one(each.cast<int64_t>()));
    if (seeds.size() != count) throw py::value_error("there has to be a seed for each world");
    return seeds;
  }
  const uint32_t first = one(seed.cast<int64_t>());
  for (size_t i = 0; i < count; ++i) seeds.push_back(first + static_cast<uint32_t>(i));
  return seeds;
}

}  // namespace

void add_batches(py::module_& module) {
  py::class_<BatchEnvironment> batch(
      module, "Batch",
      "Many worlds, stepped on all cores without Python's lock; and an excavation as an environment.");
  batch
      .def(py::init(&make_batch), py::arg("n"), py::arg("make") = py::none(), py::kw_only(),
           py::arg("ticks") = 6, py::arg("steps") = 100, py::arg("cells") = 16, py::arg("half_m") = 8.0,
           py::arg("reach_m") = 1.0, py::arg("depth_max_m") = 2.0, py::arg("threads") = 0,
           "n worlds of make(seed), flat ones without it. An action takes so many ticks, an episode so many "
           "steps.")
      .def(
          "reset",
          [](BatchEnvironment& held, const py::object& seed, const py::object&) {
            return py::make_tuple(held.reset(seeds_of(seed, held.batch().size())), py::dict());
          },
          py::kw_only(), py::arg("seed") = py::none(), py::arg("options") = py::none(),
          "New worlds; returns (heights, {}). Heights: float32 metres of shape (n, cells, cells), x before "
          "z.")
      .def("step", &BatchEnvironment::step, py::arg("actions"),
           "Digs at actions (n, 3): x, z and depth, metres. Returns heights, rewards (m³ dug), terminated, "
           "truncated, "
           "infos. A world whose episode was cut off begins the next one in the following step.")
      .def("advance", &BatchEnvironment::advance, py::arg("commands") = py::none(), py::arg("ticks") = 1,
           "So many ticks of every world, with a list of commands for each; returns a Step for each.")
      .def(
          "close", [](BatchEnvironment&, const py::kwargs&) {},
          "Nothing is left to do: worlds end with the batch.")
      .def_property_readonly("num_envs", [](BatchEnvironment& held) { return held.batch().size(); })
      .def_property_readonly("threads", [](BatchEnvironment& held) { return held.batch().threads(); })
      .def_property_readonly(
          "worlds", [](BatchEnvironment& held) { return held.batch().worlds(); },
          "The worlds as they are now.")
      .def_readonly("single_action_space", &BatchEnvironment::single_action_space)
      .def_readonly("action_space", &BatchEnvironment::action_space)
      .def_readonly("single_observation_space", &BatchEnvironment::single_observation_space)
      .def_readonly("observation_space", &BatchEnvironment::observation_space)
      .def("__len__", [](BatchEnvironment& held) { return held.batch().size(); });
  join_gymnasium(module, "Batch");
}

}  // namespace scree::python
