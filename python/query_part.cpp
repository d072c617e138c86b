// Questions about space: rays, the nearest surface, overlaps, and distances at many places.
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/arguments.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/world_functions.h"
#include "shared/query/limits.h"
#include "shared/query/query.h"

namespace scree::python {

namespace py = pybind11;

namespace {

QueryMask mask_of(bool terrain, bool pieces, bool bodies) {
  return {.terrain = terrain, .pieces = pieces, .bodies = bodies};
}

const char* kind_text(HitKind kind) {
  switch (kind) {
    case HitKind::terrain:
      return "terrain";
    case HitKind::piece:
      return "piece";
    case HitKind::body:
      return "body";
  }
  return "";
}

glm::vec3 unit_of(glm::vec3 way) {
  const float length = glm::length(way);
  if (length > 1e-6F) return way / length;
  throw py::value_error("a direction has to have a length");
}

/// The answer to one question, read without Python's lock. What a question may not be is a ValueError.
template <typename Ask>
auto asked(HeldWorld& held, const Ask& ask) {
  const Use use(held);
  auto answer = [&] {
    const py::gil_scoped_release unlocked;
    const HeldScene scene = held.world().scene();
    return ask(scene.scene());
  }();
  return valid(std::move(answer)).answer;
}

py::array cast_rays(HeldWorld& held, const py::object& from_m, const py::object& directions, double most_m,
                    bool terrain, bool pieces, bool bodies) {
  const std::vector<glm::vec3> from = places_of(from_m, "from_m");
  std::vector<glm::vec3> ways = places_of(directions, "directions");
  if (ways.size() != from.size()) throw py::value_error("from_m and directions have to have as many rows");
  for (glm::vec3& way : ways) way = unit_of(way);
  const float most = number_of(most_m, "most_m");
  const QueryMask mask = mask_of(terrain, pieces, bodies);
  std::vector<float> far(from.size(), std::numeric_limits<float>::infinity());
  const Use use(held);
  Result<void> all = [&]() -> Result<void> {
    const py::gil_scoped_release unlocked;
    const HeldScene scene = held.world().scene();
    for (size_t i = 0; i < from.size(); ++i) {
      const auto found = TRY(cast_ray(scene, from[i], ways[i], most, mask));
      if (found.answer) far[i] = found.answer->distance_m;
    }
    return {};
  }();
  valid(std::move(all));
  const auto size = static_cast<py::ssize_t>(far.size());
  return array_over(std::move(far), {size});
}

py::array distance(HeldWorld& held, const py::object& places_m) {
  const std::vector<glm::vec3> places = places_of(places_m, "places_m");
  for (const glm::vec3& place : places)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(place[axis]) <= scree::limits::query_place_max_m))
        throw py::value_error("a place lies more than 8192 m from the origin");
  std::vector<float> metres(places.size());
  {
    const Use use(held);
    const py::gil_scoped_release unlocked;
    const Field& field = held.world().field();
    for (size_t i = 0; i < places.size(); ++i)
      metres[i] = sample(field, places[i] / held.voxel_m()).distance_voxels * held.voxel_m();
  }
  const auto size = static_cast<py::ssize_t>(metres.size());
  return array_over(std::move(metres), {size});
}

void add_hits(py::module_& module) {
  py::class_<Hit>(module, "Hit", "Where a question met something.")
      .def_property_readonly(
          "kind", [](const Hit& hit) { return kind_text(hit.kind); }, "terrain, piece or body")
      .def_readonly("id", &Hit::id, "The id of a piece or a body; 0: terrain.")
      .def_readonly("distance_m", &Hit::distance_m)
      .def_property_readonly("place_m", [](const Hit& hit) { return tuple_of(hit.place_m); })
      .def_property_readonly("normal", [](const Hit& hit) { return tuple_of(hit.normal); })
      .def_property_readonly("material", [](const Hit& hit) { return row_number(hit.material); })
      .def_readonly("inside", &Hit::inside, "It began inside.")
      .def("__repr__", [](const Hit& hit) {
        return std::string("<scree.Hit ") + kind_text(hit.kind) + " at " +
               std::string(py::str(tuple_of(hit.place_m))) + ">";
      });
}

template <typename... Extra>
void add_masked(WorldClass& world, const char* name, auto function, const char* doc, const Extra&... extra) {
  world.def(name, function, extra..., py::kw_only(), py::arg("terrain") = true, py::arg("pieces") = true,
            py::arg("bodies") = true, doc);
}

void add_casts(WorldClass& world) {
  add_masked(
      world, "cast_ray",
      [](HeldWorld& held, const py::object& from_m, const py::object& direction, double most_m, bool terrain,
         bool pieces, bool bodies) {
        const glm::vec3 from = vector_of(from_m, "from_m"), way = unit_of(vector_of(direction, "direction"));
        const float most = number_of(most_m, "most_m");
        return asked(held, [&](const QueryScene& scene) {
          return cast_ray(scene, from, way, most, mask_of(terrain, pieces, bodies));
        });
      },
      "The first that a ray meets, at most 1000 m away; None: nothing.", py::arg("from_m"),
      py::arg("direction"), py::arg("most_m") = 100.0);
  add_masked(world, "cast_rays", &cast_rays,
             "How far each of many rays goes: float32 metres of shape (n,), infinite where it meets nothing.",
             py::arg("from_m"), py::arg("directions"), py::arg("most_m") = 100.0);
  add_masked(
      world, "nearest_surface",
      [](HeldWorld& held, const py::object& place_m, double most_m, bool terrain, bool pieces, bool bodies) {
        const glm::vec3 place = vector_of(place_m, "place_m");
        const float most = number_of(most_m, "most_m");
        return asked(held, [&](const QueryScene& scene) {
          return nearest_surface(scene, place, most, mask_of(terrain, pieces, bodies));
        });
      },
      "The place of a surface that is nearest, at most 8 m away; None: there is none.", py::arg("place_m"),
      py::arg("most_m") = 8.0);
}

}  // namespace

void add_queries(py::module_& module, WorldClass& world) {
  add_hits(module);
  add_casts(world);
  add_masked(
      world, "overlap_sphere",
      [](HeldWorld& held, const py::object& centre_m, double radius_m, bool terrain, bool pieces,
         bool bodies) {
        const glm::vec3 centre = vector_of(centre_m, "centre_m");
        const float radius = number_of(radius_m, "radius_m");
        const Overlapping found = asked(held, [&](const QueryScene& scene) {
          return overlap_sphere(scene, centre, radius, mask_of(terrain, pieces, bodies));
        });
        return py::make_tuple(found.terrain, found.ids);
      },
      "Whether terrain has a place within a ball, and the ids of bodies that have.", py::arg("centre_m"),
      py::arg("radius_m"));
  add_masked(
      world, "overlap_box",
      [](HeldWorld& held, const py::object& lo_m, const py::object& hi_m, bool terrain, bool pieces,
         bool bodies) {
        const glm::vec3 lo = vector_of(lo_m, "lo_m"), hi = vector_of(hi_m, "hi_m");
        const Overlapping found = asked(held, [&](const QueryScene& scene) {
          return overlap_box(scene, lo, hi, mask_of(terrain, pieces, bodies));
        });
        return py::make_tuple(found.terrain, found.ids);
      },
      "The same of a box along the axes; metres.", py::arg("lo_m"), py::arg("hi_m"));
  world.def("distance", &distance, py::arg("places_m"),
            "Distances to the terrain's surface at places of shape (n, 3), metres: float32 of shape (n,), "
            "negative in "
            "rock, within 3 voxels to either side.");
}

}  // namespace scree::python
