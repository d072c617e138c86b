// scree-place: adds a body of voxels, from a file of another program, to a running server.
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "client/connection/endpoint_options.h"
#include "proto/operation_codec.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "shared/operation/added_piece_limits.h"
#include "tools/import/file_forms.h"
#include "tools/import/process/sandbox.h"
#include "tools/import/programs/program.h"
#include "tools/place/placed_piece.h"

namespace scree {
namespace {

/// The limits of the process that reads the file.
constexpr ReaderLimits reader_limits{uint64_t{2048} << 20U, std::chrono::seconds(600)};

struct Options {
  std::string file;
  AdminServer server;
  double timeout_s = 10.0;
  std::vector<float> at_m, turn_degrees, velocity_m_s, spin_rad_s;
  std::string material, material_map;
  bool merge = false;
  bool json = false;
  SolidsImport solids;
  std::string sheet = std::string(row_of(SheetRule::refuse).name);
};

glm::vec3 vector_of(const std::vector<float>& numbers) {
  if (numbers.empty()) return glm::vec3(0.0F);
  return {numbers[0], numbers[1], numbers[2]};
}

/// Yaw about y, then pitch about x, then roll about z.
glm::quat turn_of(const std::vector<float>& degrees) {
  const std::array<glm::vec3, 3> axes{glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)};
  glm::quat turn(1.0F, 0.0F, 0.0F, 0.0F);
  for (size_t i = 0; i < degrees.size(); ++i) turn = turn * glm::angleAxis(glm::radians(degrees[i]), axes[i]);
  return glm::normalize(turn);
}

void tell(const std::vector<std::string>& sentences) {
  for (const std::string& said : sentences) std::fprintf(stderr, "scree-place: %s\n", said.c_str());
}

/// The file as a request to a world of that voxel size and palette.
Result<AddPieceRequest> request_of(const Options& options, const WorldFacts& world) {
  SolidsImport how = options.solids;
  how.voxel_size_m = world.voxel_size_m;
  how.palette = std::make_shared<const Palette>(world.palette);
  how.colour_rows_max = materials_max - world.palette.rows.size();
  how.sheet = kind_named<SheetRule>(options.sheet).value_or(SheetRule::refuse);
  how.reader = reader_limits;
  Material otherwise{};
  if (!options.material.empty()) {
    otherwise = TRY(material_named(world.palette, options.material));
    how.material = otherwise;
    how.colour_rows_max = 0;
  }
  std::vector<MapLine> map;
  if (!options.material_map.empty()) map = TRY(read_map_lines(options.material_map, world.palette));
  how.material_map = map_of(map);
  const auto read = TRY(read_solids({options.file}, how));
  tell(read.said);
  tell(words_on_unused(options.material_map, map, read.map_used));
  const auto placed = placed_piece(read, world.palette, otherwise);
  if (!placed) return fail(options.file + ": " + placed.error().message);
  tell(placed->said);
  const size_t bytes = encode_volume(placed->volume).size();
  if (bytes > limits::added_piece_bytes_max)
    return fail(
        fmt::format("{}: its voxels take {} bytes, and a piece has at most {} "
                    "(limits.added_piece_bytes_max): --scale makes it smaller",
                    options.file, bytes, limits::added_piece_bytes_max));
  AddPieceRequest add{.volume = std::make_shared<const Volume>(placed->volume),
                      .turn = turn_of(options.turn_degrees)};
  add.place_m = vector_of(options.at_m) - add.turn * (placed->foot_voxels * world.voxel_size_m);
  add.velocity_m_s = vector_of(options.velocity_m_s);
  add.spin_rad_s = vector_of(options.spin_rad_s);
  add.kept = !options.merge;
  return add;
}

Result<void> run(const Options& options) {
  if (const auto refusal = refusal_of_form(options.file)) return fail(*refusal);
  if (!is_solid_file(options.file))
    return fail(options.file +
                ": a body is made of solids: OpenVDB (.vdb), MagicaVoxel (.vox) or a mesh; scree export "
                "writes a box of a world as .vdb");
  if (const std::string missing = missing_walls(); !missing.empty()) tell({missing});
  const auto world = TRY(read_world(options.server));
  const auto request = TRY(request_of(options, world));
  const auto reply = TRY(ask_world(options.server, request));
  const uint32_t first = reply.prop.value_or(0);
  if (options.json) {
    const nlohmann::ordered_json json{
        {"tick", reply.tick}, {"piece", first}, {"pieces", reply.pieces}, {"kept", request.kept}};
    std::printf("%s\n", json.dump(2).c_str());
    return {};
  }
  std::printf("piece %u is %s, the first of %u\n", first, request.kept ? "kept" : "added", reply.pieces);
  return {};
}

CLI::Option* add_vector(CLI::App& app, const char* name, std::vector<float>& to, const char* what) {
  return app.add_option(name, to, what)->delimiter(',')->expected(3);
}

void declare(CLI::App& app, Options& options) {
  app.add_option("FILE", options.file,
                 "MagicaVoxel (.vox), OpenVDB (.vdb, as scree export writes it) or a mesh (.obj, .ply, .stl, "
                 ".gltf, .glb, .off, .dae, .3ds, .fbx)")
      ->required();
  add_vector(app, "--at", options.at_m, "X Y Z of the middle of its lowest side, metres")->required();
  app.add_option("--turn", options.turn_degrees,
                 "YAW, or YAW PITCH ROLL: degrees about y, x and z; it turns about that place")
      ->delimiter(',')
      ->expected(1, 3);
  add_vector(app, "--velocity", options.velocity_m_s, "metres a second along X Y Z");
  add_vector(app, "--spin", options.spin_rad_s, "radians a second about X Y Z");
  app.add_flag("--merge", options.merge, "lets it become terrain where it comes to rest");
  app.add_option("--material", options.material,
                 "material of all that is none of the world's by name; default: the nearest by colour");
  app.add_option(
      "--material-map", options.material_map,
      "file with a line NAME-or-NUMBER = material for materials of the file that are to be the world's");
  app.add_option("--scale", options.solids.place.scale,
                 "length of the file's unit, metres; of a .vox, of its voxels, by default as those of the "
                 "world")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--z-up", options.solids.place.z_up, "says that z points up in a mesh or .vdb, not y");
  app.add_option("--grid", options.solids.grid, "name of the grid in an OpenVDB file");
  app.add_option("--sheet", options.sheet, "rule for open sheets of a mesh")
      ->check(
          CLI::IsMember(std::vector<std::string>(kind_names<SheetRule>.begin(), kind_names<SheetRule>.end())))
      ->capture_default_str();
  bounded(app.add_option("--timeout", options.timeout_s, "seconds to wait for the server's answers"),
          {0.1, 3600.0})
      ->capture_default_str();
  app.add_flag("--json", options.json, "prints JSON");
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  CLI::App app("Adds a body of voxels from a file to a running server.", "scree-place");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::Options options;
  scree::EndpointOptions endpoint(app, options.server, "SCREE_ADMIN_TOKEN", scree::EndpointNaming::or_socket);
  scree::declare(app, options);
  if (const auto ended = scree::parse(app, argc, argv)) return *ended;
  options.solids.has_scale = app.count("--scale") > 0;
  options.server.within = std::chrono::milliseconds(static_cast<int64_t>(options.timeout_s * 1000.0));
  if (const auto completed = endpoint.complete(); !completed) {
    scree::refuse(app, completed.error());
    return scree::exit_usage;
  }
  const auto done = scree::run(options);
  return done ? 0 : scree::refuse(app, done.error());
}
