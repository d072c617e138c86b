// `Client`: a client of a running server, over libscree_client's own objects (client/library).
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>

#include "client/library/handle.h"
#include "python/arguments.h"
#include "python/arrays.h"
#include "python/errors.h"
#include "python/held_client.h"
#include "python/parts.h"
#include "server/command/command.h"
#include "shared/base/timing.h"
#include "shared/query/query.h"

namespace scree::python {

namespace py = pybind11;

namespace {

constexpr double wait_max_s = 86400.0;

double seconds_of(double value, const char* what) {
  if (!(value >= 0.0) || value > wait_max_s) throw py::value_error(std::string(what) + " is 0 to a day");
  return value;
}

uint32_t flags_of(bool at_spawn, bool tls, bool predict, bool stones, bool meets, bool once,
                  bool insecure_token) {
  const auto flag = [](bool on, uint32_t bit) { return on ? bit : 0U; };
  return flag(at_spawn, SCREE_AT_SPAWN) | flag(tls, SCREE_TLS) | flag(predict, SCREE_PREDICT) |
         flag(stones, SCREE_STONES) | flag(meets, SCREE_MEETS) | flag(once, SCREE_ONCE) |
         flag(insecure_token, SCREE_INSECURE_TOKEN);
}

std::unique_ptr<HeldClient> connect(const std::string& host, int64_t port, const std::string& name,
                                    const std::string& token, const py::object& eye_m, double radius_m,
                                    bool tls, const std::string& ca_file, const std::string& fingerprint,
                                    bool predict, bool stones, bool once, bool insecure_token) {
  scree_options options{};
  options.size = sizeof options;
  options.host = host.c_str();
  options.port = static_cast<uint32_t>(whole_of(port, 1, UINT16_MAX, "port"));
  options.name = name.c_str();
  options.token = token.c_str();
  options.program = "python";
  options.ca_file = ca_file.c_str();
  options.fingerprint = fingerprint.c_str();
  options.radius_m = number_of(radius_m, "radius_m");
  options.flags = flags_of(eye_m.is_none(), tls, predict, stones, !name.empty(), once, insecure_token);
  if (!eye_m.is_none()) {
    const glm::vec3 eye = vector_of(eye_m, "eye_m");
    for (int i = 0; i < 3; ++i) options.eye_m[i] = eye[i];
  }
  if (const std::string fault = fault_of(options); !fault.empty()) throw py::value_error(fault);
  return std::make_unique<HeldClient>(valid(make_connector(options)), options);
}

uint32_t ask(HeldClient& held, const Command& command) {
  if (!held.client().client.connected()) throw RaisedError(held.why_lost());
  if (const std::string fault = fault_of(command.body); !fault.empty()) throw py::value_error(fault);
  return held.client().ask(command.body, {});
}

py::dict carry_out(HeldClient& held, const Command& command, double within_s) {
  const ClientUse use(held);
  const uint32_t number = ask(held, command);
  std::optional<py::dict> reply;
  held.poll_until(seconds_of(within_s, "within_s"), "the reply", [&] {
    reply = held.find_reply(number);
    return reply.has_value();
  });
  return *std::move(reply);
}

void wait_until_loaded(HeldClient& held, double within_s) {
  const ClientUse use(held);
  held.poll_until(seconds_of(within_s, "within_s"), "the world around", [&] {
    if (held.is_over()) throw RaisedError(held.why_lost());
    return held.client().client.loaded(steady_now_s());
  });
}

py::dict client_status(HeldClient& held) {
  const ClientUse use(held);
  const scree_status now = status_of(held.client());
  py::dict told;
  told["connected"] = now.connected != 0;
  told["session"] = now.session;
  told["tick"] = now.tick;
  told["tick_rate_hz"] = now.tick_rate_hz;
  told["role"] = held.client().client.welcome() == nullptr
                     ? ""
                     : std::string(name_of(held.client().client.welcome()->role));
  told["voxel_m"] = now.voxel_m;
  told["eye_m"] = three(now.eye_m);
  told["radius_m"] = now.radius_m;
  told["loaded"] = now.loaded != 0;
  told["pieces"] = now.pieces;
  told["bodies"] = now.bodies;
  told["field_hash"] = now.field_hash;
  told["server_tick"] = now.server_tick;
  told["server_hash"] = now.server_hash;
  told["mismatches"] = now.mismatches;
  told["received_bytes"] = now.received_bytes;
  told["sent_bytes"] = now.sent_bytes;
  return told;
}

py::array client_bodies(HeldClient& held) {
  const ClientUse use(held);
  held.mirror();
  std::vector<scree_body> rows(bodies_of(held.client(), -1.0, nullptr, 0));
  bodies_of(held.client(), -1.0, rows.data(), rows.size());
  const auto count = static_cast<py::ssize_t>(rows.size());
  py::list names, formats, offsets;
  const auto member = [&](const char* name, const char* format, size_t offset) {
    names.append(name);
    formats.append(format);
    offsets.append(offset);
  };
  member("id", "u4", offsetof(scree_body, id));
  member("kind", "u4", offsetof(scree_body, kind));
  member("position_m", "(3,)f4", offsetof(scree_body, position));
  member("rotation_xyzw", "(4,)f4", offsetof(scree_body, rotation));
  const py::dtype type(names, formats, offsets, static_cast<py::ssize_t>(sizeof(scree_body)));
  return array_over(std::move(rows), {count}, type);
}

py::array client_codes(HeldClient& held, const py::object& lo, const py::object& hi) {
  const ClientUse use(held);
  const Mirror& mirror = held.mirror();
  const VoxelBox box = box_of(lo, hi, mirror.terrain().voxel_size_m);
  Window window = [&] {
    const py::gil_scoped_release unlocked;
    return gather(mirror.field(), box);
  }();
  const VoxelCoord size = box.size();
  return array_over(std::move(window.codes), {size.x, size.y, size.z});
}

std::optional<Hit> client_ray(HeldClient& held, const py::object& from_m, const py::object& direction,
                              double most_m) {
  const ClientUse use(held);
  const glm::vec3 way = vector_of(direction, "direction");
  const float length = glm::length(way);
  if (!(length > 1e-6F)) throw py::value_error("a direction has to have a length");
  return valid(scree::cast_ray(held.mirror().scene(), vector_of(from_m, "from_m"), way / length,
                               number_of(most_m, "most_m")))
      .answer;
}

py::array client_distances(HeldClient& held, const py::object& places_m) {
  const ClientUse use(held);
  const std::vector<glm::vec3> places = places_of(places_m, "places_m");
  held.mirror();
  std::vector<float> far(places.size());
  if (!places.empty() &&
      scree_client_distances(&held.client(), &places.front().x, places.size(), far.data()) != SCREE_OK)
    throw py::value_error(scree_error());
  const auto count = static_cast<py::ssize_t>(far.size());
  return array_over(std::move(far), {count});
}

std::vector<std::string> client_materials(HeldClient& held) {
  const ClientUse use(held);
  std::vector<std::string> names;
  for (const std::string_view name : held.mirror().palette()->names()) names.emplace_back(name);
  return names;
}

py::dict client_carried(HeldClient& held) {
  const ClientUse use(held);
  const Mirror& mirror = held.mirror();
  py::dict told;
  for (const MaterialMass& one : mirror.carried())
    told[py::str(std::string(mirror.palette()->row_or_first(one.material).name))] = one.mass;
  return told;
}

template <typename T>
py::array copied(const T* from, size_t rows, py::ssize_t columns) {
  std::vector<T> values(from, from + rows * static_cast<size_t>(columns));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows)};
  if (columns > 1) shape.push_back(columns);
  return array_over(std::move(values), std::move(shape));
}

py::object client_mesh(HeldClient& held, const py::object& chunk) {
  const ClientUse use(held);
  held.mirror();
  constexpr int32_t furthest = 1 << 15;
  const glm::vec3 given = vector_of(chunk, "chunk");
  std::array<int32_t, 3> at{};
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(given[i]) < furthest) || given[i] != std::floor(given[i]))
      throw py::value_error("a chunk is three whole numbers");
    at.at(static_cast<size_t>(i)) = static_cast<int32_t>(given[i]);
  }
  scree_mesh mesh{};
  mesh.size = sizeof mesh;
  const scree_result made = scree_client_mesh_chunk(&held.client(), at.data(), &mesh);
  if (made < SCREE_OK) throw py::value_error(scree_error());
  if (made == SCREE_NOTHING) return py::none();
  py::dict told;
  told["origin_m"] = three(mesh.origin_m);
  told["positions"] = copied(mesh.positions, mesh.vertex_count, 3);
  told["normals"] = copied(mesh.normals, mesh.vertex_count, 3);
  told["materials"] = copied(mesh.materials, mesh.vertex_count, 1);
  told["shades"] = copied(mesh.shades, mesh.vertex_count, 1);
  told["triangles"] = copied(mesh.indices, mesh.index_count / 3, 3);
  scree_mesh_release(&held.client(), &mesh);
  return told;
}

void client_follow(HeldClient& held, const py::object& eye_m, double radius_m) {
  const ClientUse use(held);
  if (!held.client().client.connected()) throw RaisedError(held.why_lost());
  const float radius = number_of(radius_m, "radius_m");
  if (radius < 0.0F) throw py::value_error("radius_m is not below 0");
  held.client().follow(vector_of(eye_m, "eye_m"), radius);
}

void say(HeldClient& held, const std::string& text) {
  const ClientUse use(held);
  const scree_result said = scree_client_say(&held.client(), text.c_str());
  if (said == SCREE_INVALID) throw py::value_error(scree_error());
  if (said != SCREE_OK) throw RaisedError(scree_error());
}

void send(HeldClient& held, const std::string& channel, const std::string& data) {
  const ClientUse use(held);
  const scree_result sent = scree_client_send(&held.client(), channel.c_str(), data.data(), data.size());
  if (sent == SCREE_INVALID) throw py::value_error(scree_error());
  if (sent != SCREE_OK) throw RaisedError(scree_error());
}

}  // namespace

void add_clients(py::module_& module) {
  py::class_<HeldClient> type(
      module, "Client",
      "A client of a running server: it keeps an exact copy of the world around its eye. "
      "One thread at a time uses it; poll() often.");
  type.def(py::init(&connect), py::arg("host") = "127.0.0.1", py::arg("port") = 4177, py::kw_only(),
           py::arg("name") = "", py::arg("token") = "", py::arg("eye_m") = py::none(),
           py::arg("radius_m") = 96.0, py::arg("tls") = false, py::arg("ca_file") = "",
           py::arg("fingerprint") = "", py::arg("predict") = false, py::arg("stones") = false,
           py::arg("once") = true, py::arg("insecure_token") = false);
  type.def(
      "poll",
      [](HeldClient& held, double wait_s) {
        const ClientUse use(held);
        held.poll(static_cast<uint32_t>(std::lround(seconds_of(wait_s, "wait_s") * 1000.0)));
        return held.take_events();
      },
      py::arg("wait_s") = 0.0,
      "The events since the last call, as dicts; waits up to so many seconds for one.");
  type.def("wait_until_loaded", &wait_until_loaded, py::arg("within_s") = 30.0,
           "Returns when the edits around the eye are here. Raises Error where the server refuses.");
  type.def(
      "ask",
      [](HeldClient& held, const Command& command) {
        const ClientUse use(held);
        return ask(held, command);
      },
      py::arg("command"), "Sends a request; its reply comes as an event with this number.");
  type.def("carry_out", &carry_out, py::arg("command"), py::arg("within_s") = 30.0,
           "Sends a request and waits for its reply, an event whose `text` is the refusal, or ''.");
  type.def("status", &client_status, "What the client knows of itself, the copy and the server, as a dict.");
  type.def(
      "bodies", &client_bodies,
      "Structured array of pieces (kind 0), props (1) and persons (2): id, kind, position_m, rotation_xyzw.");
  type.def("codes", &client_codes, py::arg("lo"), py::arg("hi"),
           "int8 of shape hi - lo: the codes of a box of voxels, below 0 in rock, z fastest.");
  type.def("cast_ray", &client_ray, py::arg("from_m"), py::arg("direction"), py::arg("most_m") = 100.0,
           "What a ray hits, or None.");
  type.def("distances", &client_distances, py::arg("places_m"),
           "float32 of shape (n,): metres from places of shape (n, 3) to the terrain, below 0 in rock.");
  type.def_property_readonly("materials", &client_materials,
                             "Names of the palette's rows, by their numbers.");
  type.def_property_readonly("carried", &client_carried, "Units of mass in the own store, by material.");
  type.def("mesh_chunk", &client_mesh, py::arg("chunk"),
           "The triangles of a chunk of 32 voxels a side, as arrays; None where it has no surface.");
  type.def("follow", &client_follow, py::arg("eye_m"), py::arg("radius_m") = 96.0,
           "Moves the middle of what the client follows.");
  type.def("say", &say, py::arg("text"), "A line to all persons.");
  type.def("send", &send, py::arg("channel"), py::arg("data"), "Bytes for the game's rules.");
  type.def("close", &HeldClient::close, "Says goodbye. Other calls raise Error from then on.");
  type.def("__enter__", [](py::object self) { return self; });
  type.def("__exit__", [](HeldClient& held, const py::args&) { held.close(); });
}

}  // namespace scree::python
