#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "client/library/call.h"
#include "client/library/handle.h"
#include "client/library/mesher.h"
#include "client/render/levels/surface_looks.h"
#include "client/render/meshing/piece_mesh.h"
#include "shared/prop/prop_solid.h"
#include "shared/query/limits.h"

namespace scree {
namespace {

constexpr float usual_reach_m = 64.0F;
constexpr float reach_least_m = 8.0F, reach_most_m = 256.0F;
constexpr std::array polygonisers{Polygoniser::nets, Polygoniser::dual, Polygoniser::cubes};

/// Rows of the palette by what the vertices look like. What looks as the ground does is of its layer.
class MaterialFinder {
 public:
  MaterialFinder(const Field& field, const Palette& palette)
      : rows_(palette.ground), layers_(layers_of(field.source())) {}

  uint8_t operator()(const SurfaceVertex& vertex, float y_m) const {
    if (vertex.look != 0) return static_cast<uint8_t>(vertex.look - 1);
    // Halfway to bare rock, as at a hole's rim, it still looks as the ground's layer does.
    const bool as_ground = std::abs(unpacked_worn(vertex.before)) < worn_all / 2;
    if (as_ground && y_m < layers_.soil_below_m) return number(rows_.soil);
    if (as_ground && y_m > layers_.ice_above_m) return number(rows_.cap);
    return number(rows_.bulk);
  }

 private:
  static uint8_t number(Material material) { return static_cast<uint8_t>(material); }

  GroundRows rows_;
  MaterialHeights layers_;
};

/// Where a mesh's positions lie: (position · step − origin) metres, and how high its ground is.
struct Placing {
  float step_m = 0.0F;
  glm::vec3 less_m{0.0F};
  float base_y_m = 0.0F;
};

constexpr size_t vertex_bytes = 6 * sizeof(float) + 2;

/// Arrays one after another, widest first, so that each is aligned. Without indices there are none.
FlatMesh flat_arrays(size_t vertices, size_t indices, const ArraySource& source) {
  FlatMesh made;
  made.mesh.size = sizeof made.mesh;
  if (indices == 0) return made;
  made.block = ArrayBlock(source, vertices * vertex_bytes + indices * sizeof(uint32_t));
  made.mesh.vertex_count = vertices;
  made.mesh.index_count = indices;
  made.mesh.positions = made.positions();
  made.mesh.normals = made.normals();
  made.mesh.indices = made.indices();
  made.mesh.materials = made.materials();
  made.mesh.shades = made.shades();
  return made;
}

FlatMesh flat(const SurfaceMesh& from, const Placing& placing, const MaterialFinder& material,
              const ArraySource& source) {
  FlatMesh made = flat_arrays(from.vertices.size(), from.indices.size(), source);
  for (size_t v = 0; v < made.mesh.vertex_count; ++v) {
    const SurfaceVertex& vertex = from.vertices[v];
    const glm::vec3 at(vertex.position[0], vertex.position[1], vertex.position[2]);
    const glm::vec3 place = at * placing.step_m - placing.less_m;
    const glm::vec3 normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
    write_vec3(place, made.positions() + 3 * v);
    write_vec3(normal / std::max(glm::length(normal), 1.0F), made.normals() + 3 * v);
    made.materials()[v] = material(vertex, place.y + placing.base_y_m);
    made.shades()[v] = vertex.openness;
  }
  std::copy_n(from.indices.data(), made.mesh.index_count, made.indices());
  return made;
}

FlatMesh flat_terrain(const SurfaceMesh& from, int level, const scree_client& owner) {
  const Mirror& mirror = *owner.client.mirror();
  const float sample_m = mirror.terrain().voxel_size_m * static_cast<float>(1 << level);
  const glm::vec3 origin = glm::vec3(from.origin.x, from.origin.y, from.origin.z) * sample_m;
  const Placing placing{sample_m / surface_steps_per_voxel, glm::vec3(0.0F), origin.y};
  FlatMesh made = flat(from, placing, MaterialFinder(mirror.field(), *mirror.palette()), owner.arrays);
  made.mesh.level = level;
  write_vec3(origin, made.mesh.origin_m);
  return made;
}

FlatMesh flat_piece(const PieceMesh& piece, const scree_client& owner) {
  const Mirror& mirror = *owner.client.mirror();
  const float voxel_m = mirror.terrain().voxel_size_m;
  const VoxelCoord o = piece.mesh.origin;
  const glm::vec3 less = (piece.piece.volume->centre_voxels - glm::vec3(o.x, o.y, o.z)) * voxel_m;
  const Placing placing{voxel_m / surface_steps_per_voxel, less,
                        piece.piece.volume->centre_voxels.y * voxel_m};
  FlatMesh made = flat(piece.mesh, placing, MaterialFinder(mirror.field(), *mirror.palette()), owner.arrays);
  made.mesh.kind = 1;
  made.mesh.id = piece.id;
  return made;
}

void name_node(const SurfaceNode& node, scree_mesh& mesh) {
  mesh.level = node.level;
  const int32_t at[3] = {node.at.x, node.at.y, node.at.z};
  std::copy_n(at, 3, mesh.node);
}

scree_mesh gone_mesh() {
  scree_mesh mesh{};
  mesh.size = sizeof mesh;
  mesh.flags = 1;
  return mesh;
}

/// The pieces that are drawn, with those of predictions.
ScenePieces pieces_of(const scree_client& owner) {
  ScenePieces pieces;
  const Mirror& mirror = *owner.client.mirror();
  for (const auto& [id, motion] : mirror.pieces()) pieces[id] = {motion.volume, motion.to};
  if (const Predictions* const shown = owner.client.predictions())
    for (const auto& [id, volume] : shown->pieces())
      pieces[id] = {volume, {volume->centre_voxels * mirror.terrain().voxel_size_m, {1, 0, 0, 0}}};
  return pieces;
}

/// The parts of a prop, one after another, as they are in its own axes.
FlatMesh flat_prop(PieceId id, const Prop& prop, const ArraySource& source) {
  std::vector<PropMesh> parts;
  size_t corners = 0;
  for (const PropPart& part : prop.parts) corners += parts.emplace_back(mesh_of(part)).corners_m.size();
  FlatMesh made = flat_arrays(corners, corners, source);
  made.mesh.kind = 2;
  made.mesh.id = id;
  size_t at = 0;
  for (const PropMesh& part : parts)
    for (size_t i = 0; i < part.corners_m.size(); ++i, ++at) {
      write_vec3(part.corners_m[i], made.positions() + 3 * at);
      write_vec3(part.normals[i], made.normals() + 3 * at);
      made.indices()[at] = static_cast<uint32_t>(at);
      made.materials()[at] = static_cast<uint8_t>(prop.material);
      made.shades()[at] = UINT8_MAX;
    }
  return made;
}

/// The mesh of a piece or a prop; nothing: neither has the id.
std::optional<FlatMesh> body_mesh(const scree_client& owner, PieceId id) {
  const Mirror& mirror = *owner.client.mirror();
  if (const auto prop = mirror.props().find(id); prop != mirror.props().end())
    return flat_prop(id, *prop->second.prop, owner.arrays);
  const ScenePieces pieces = pieces_of(owner);
  const auto piece = pieces.find(id);
  if (piece == pieces.end()) return std::nullopt;
  return flat_piece(mesh_piece(gather_piece(mirror.field(), id, piece->second)), owner);
}

/// Hands a mesh out for good. False: the struct is of no release.
bool hand_out(FlatMesh&& made, scree_mesh* mesh) {
  if (!write_struct(made.mesh, mesh)) return false;
  made.block.let_go();
  return true;
}

size_t bytes_of(const scree_mesh& mesh) {
  return mesh.vertex_count * vertex_bytes + mesh.index_count * sizeof(uint32_t);
}

std::string mesher_fault(const scree_mesher_options& options) {
  if (!(options.radius_m == 0.0F || (options.radius_m >= reach_least_m && options.radius_m <= reach_most_m)))
    return "a mesher's radius is 8 to 256 m";
  if (options.method >= polygonisers.size()) return "there is no such method";
  if (options.threads > 64) return "a mesher has 64 threads at most";
  return {};
}

}  // namespace
}  // namespace scree

using namespace scree;

scree_mesher::scree_mesher(scree_client& owner, const scree_mesher_options& options)
    : owner_(owner),
      options_(options),
      pool_(options.threads == 0 ? default_worker_threads() : options.threads) {
  if (options_.radius_m == 0.0F) options_.radius_m = usual_reach_m;
  owner_.meshers.insert(this);
  restart();
}

scree_mesher::~scree_mesher() {
  owner_.meshers.erase(this);
}

void scree_mesher::restart() {
  told_.reset();
  update_ = {};
  scheduler_.emplace(pool_, options_.radius_m, polygonisers.at(options_.method),
                     options_.rounded != 0 ? FaceEdges::rounded : FaceEdges::sharp);
  if (owner_.client.mirror() == nullptr) return;
  MirrorChanges all;
  for (const auto& [id, piece] : pieces_of(owner_)) all.pieces_added.push_back(id);
  scheduler_->changed(all);
}

bool scree_mesher::update(glm::vec3 eye_m) {
  if (left() != 0) return true;
  if (owner_.client.mirror() == nullptr) return false;
  pool_.run_for(0.004);
  update_ = scheduler_->update({owner_.client.field(), pieces_of(owner_)}, eye_m);
  return left() != 0;
}

/// What goes comes last, so that what takes its place is there before.
void scree_mesher::make_next() {
  const auto take = [](auto& list) {
    auto last = std::move(list.back());
    list.pop_back();
    return last;
  };
  if (!update_.nodes.empty()) {
    const NodeMesh node = take(update_.nodes);
    told_.emplace(flat_terrain(node.mesh, node.level, owner_));
    name_node(node.node, told_->mesh);
    if (node.mesh.empty()) told_->mesh.flags = 1;
  } else if (!update_.pieces.empty()) {
    told_.emplace(flat_piece(take(update_.pieces), owner_));
  } else if (!update_.gone.empty()) {
    told_.emplace().mesh = gone_mesh();
    name_node(take(update_.gone), told_->mesh);
  } else {
    told_.emplace().mesh = gone_mesh();
    told_->mesh.kind = 1;
    told_->mesh.id = take(update_.removed_pieces);
  }
}

const scree_mesh* scree_mesher::next() {
  told_.reset();
  if (left() == 0) return nullptr;
  try {
    make_next();
  } catch (...) {
    restart();  // or the mesh would be missing for good
    throw;
  }
  if (left() == 0) told_->mesh.flags |= 2U;
  return &told_->mesh;
}

extern "C" {

scree_result scree_mesher_options_init(scree_mesher_options* options, uint32_t size) {
  scree_mesher_options usual{};
  usual.radius_m = usual_reach_m;
  return init_struct(options, size, usual) ? done : fail(SCREE_INVALID, "no release has such options");
}

scree_result scree_mesher_create(scree_client* client, const scree_mesher_options* options,
                                 scree_mesher** mesher) {
  return guarded([&] {
    const std::optional<scree_mesher_options> given = read_struct(options);
    if (client == nullptr || !given || mesher == nullptr)
      return fail(SCREE_INVALID, "a client, options and a place are needed");
    *mesher = nullptr;
    if (const std::string fault = mesher_fault(*given); !fault.empty()) return fail(SCREE_INVALID, fault);
    *mesher = new scree_mesher(*client, *given);
    return done;
  });
}

void scree_mesher_destroy(scree_mesher* mesher) {
  delete mesher;
}

scree_result scree_mesher_update(scree_mesher* mesher, const float eye_m[3]) {
  return guarded([&] {
    if (mesher == nullptr || eye_m == nullptr || !is_finite(eye_m, 3))
      return fail(SCREE_INVALID, "a mesher and a finite place are needed");
    if (!std::all_of(eye_m, eye_m + 3, [](float v) { return std::abs(v) <= limits::query_place_max_m; }))
      return fail(SCREE_INVALID, "the eye is farther than 8192 m from the origin");
    return mesher->update(vec3_of(eye_m)) ? done : nothing;
  });
}

scree_result scree_mesher_next(scree_mesher* mesher, scree_mesh* mesh) {
  return guarded([&] {
    if (mesher == nullptr || mesh == nullptr || mesh->size < first_bytes<scree_mesh>)
      return fail(SCREE_INVALID, "a mesher and a mesh with its size are needed");
    const scree_mesh* const made = mesher->next();
    if (made == nullptr) return nothing;
    write_struct(*made, mesh);
    return done;
  });
}

scree_result scree_mesher_complete(scree_mesher* mesher, uint32_t* complete) {
  return guarded([&] {
    if (mesher == nullptr || complete == nullptr)
      return fail(SCREE_INVALID, "a mesher and a place are needed");
    *complete = mesher->complete() ? 1 : 0;
    return done;
  });
}

scree_result scree_client_mesh_chunk(scree_client* client, const int32_t chunk[3], scree_mesh* mesh) {
  return guarded([&] {
    constexpr int32_t furthest = 1 << 15;
    if (client == nullptr || chunk == nullptr || mesh == nullptr)
      return fail(SCREE_INVALID, "a client, a chunk and a mesh are needed");
    if (!std::all_of(chunk, chunk + 3, [](int32_t c) { return std::abs(c) < furthest; }))
      return fail(SCREE_INVALID, "the chunk is beyond any world");
    if (client->client.mirror() == nullptr) return fail(SCREE_NOT_CONNECTED, "no server was reached yet");
    const VoxelCoord first = first_voxel(ChunkCoord{chunk[0], chunk[1], chunk[2]});
    const std::optional<BlockWindows> windows = gather_windows(
        client->client.field(), {first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}});
    if (!windows) return nothing;
    const SurfaceMesh made = windows->mesh(FaceEdges::sharp);
    if (made.empty()) return nothing;
    FlatMesh flattened = flat_terrain(made, 0, *client);
    std::copy_n(chunk, 3, flattened.mesh.node);
    return hand_out(std::move(flattened), mesh) ? done : fail(SCREE_INVALID, "no release has such a mesh");
  });
}

scree_result scree_client_mesh_body(scree_client* client, uint32_t id, scree_mesh* mesh) {
  return guarded([&] {
    if (client == nullptr || mesh == nullptr) return fail(SCREE_INVALID, "a client and a mesh are needed");
    if (client->client.mirror() == nullptr) return fail(SCREE_NOT_CONNECTED, "no server was reached yet");
    std::optional<FlatMesh> made = body_mesh(*client, id);
    if (!made || made->mesh.index_count == 0) return nothing;
    return hand_out(std::move(*made), mesh) ? done : fail(SCREE_INVALID, "no release has such a mesh");
  });
}

void scree_mesh_release(scree_client* client, scree_mesh* mesh) {
  if (client == nullptr || mesh == nullptr || mesh->positions == nullptr) return;
  client->arrays.release(const_cast<float*>(mesh->positions), bytes_of(*mesh));
  const uint32_t size = mesh->size;
  *mesh = {};
  mesh->size = size;
}
}
