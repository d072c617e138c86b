#include "tools/export/vox_export.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <set>

#include "ground/whole_file.h"
#include "proto/byte_stream.h"
#include "shared/field/material_window.h"
#include "tools/export/limits.h"
#include "tools/import/import_palette.h"

namespace scree {

namespace {

using Bytes = std::vector<uint8_t>;
using Attributes = std::map<std::string, std::string>;

/// Chunks along a side of a model, of 256 voxels.
constexpr int model_chunks = 8;

struct Model {
  std::array<int, 3> lo{};  ///< of its voxels, as the file has them: z up
  std::array<int, 3> size{};
  Bytes voxels;  ///< four bytes each: place in the model, colour
};

void put_text(ByteWriter& writer, Bytes& bytes, std::string_view text) {
  writer.u32(static_cast<uint32_t>(text.size()));
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void put_attributes(ByteWriter& writer, Bytes& bytes, const Attributes& attributes) {
  writer.u32(static_cast<uint32_t>(attributes.size()));
  for (const auto& [name, value] : attributes) {
    put_text(writer, bytes, name);
    put_text(writer, bytes, value);
  }
}

void put_chunk(Bytes& to, std::string_view id, const Bytes& content) {
  to.insert(to.end(), id.begin(), id.end());
  ByteWriter writer(to);
  writer.u32(static_cast<uint32_t>(content.size()));
  writer.u32(0);
  to.insert(to.end(), content.begin(), content.end());
}

/// Whole numbers are written as they are.
Bytes numbers(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int value : values) ByteWriter(bytes).u32(static_cast<uint32_t>(value));
  return bytes;
}

Bytes transform_node(int id, int child, const Attributes& frame) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.u32(static_cast<uint32_t>(id));
  put_attributes(writer, bytes, {});
  for (const int number : {child, -1, -1, 1}) writer.u32(static_cast<uint32_t>(number));
  put_attributes(writer, bytes, frame);
  return bytes;
}

/// Node 0 moves the group 1 to nowhere; each model has a node that moves it, and one that shows it.
void put_nodes(Bytes& to, const std::vector<Model>& models) {
  put_chunk(to, "nTRN", transform_node(0, 1, {}));
  Bytes group = numbers({1, 0, static_cast<int>(models.size())});
  for (size_t i = 0; i < models.size(); ++i) ByteWriter(group).u32(static_cast<uint32_t>(2 + 2 * i));
  put_chunk(to, "nGRP", group);
  for (size_t i = 0; i < models.size(); ++i) {
    const Model& model = models[i];
    const int id = 2 + 2 * static_cast<int>(i);
    const auto middle = [&](size_t axis) { return model.lo[axis] + model.size[axis] / 2; };
    put_chunk(to, "nTRN",
              transform_node(id, id + 1, {{"_t", fmt::format("{} {} {}", middle(0), middle(1), middle(2))}}));
    put_chunk(to, "nSHP", numbers({id + 1, 0, 1, static_cast<int>(i), 0}));
  }
}

void put_palette(Bytes& to, const Palette& palette, const std::set<uint8_t>& used) {
  Bytes colours(1024, 0);
  for (size_t i = 0; i < palette.rows.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) colours[4 * i + k] = srgb_of_linear(palette.rows[i].look.colour[k]);
    colours[4 * i + 3] = 255;
  }
  put_chunk(to, "RGBA", colours);
  for (const uint8_t colour : used) {
    Bytes bytes;
    ByteWriter writer(bytes);
    writer.u32(colour);
    put_attributes(writer, bytes,
                   {{"_name", palette.row_or_first(material_of(colour)).name}, {"_type", "_diffuse"}});
    put_chunk(to, "MATL", bytes);
  }
}

class VoxWriter {
 public:
  VoxWriter(Field& field, const ChunkBox& box) : field_(field), box_(box) {}

  std::vector<Model> models;
  std::set<uint8_t> used;
  uint64_t voxels = 0;

  Result<void> read(const std::function<void(double)>& progress) {
    const double count = static_cast<double>(box_.count());
    size_t done = 0;
    for (int x = box_.lo.x; x < box_.hi.x; x += model_chunks)
      for (int y = box_.lo.y; y < box_.hi.y; y += model_chunks)
        for (int z = box_.lo.z; z < box_.hi.z; z += model_chunks) {
          const ChunkBox part{{x, y, z},
                              {std::min(x + model_chunks, box_.hi.x), std::min(y + model_chunks, box_.hi.y),
                               std::min(z + model_chunks, box_.hi.z)}};
          TRY(read_model(part));
          done += part.count();
          progress(static_cast<double>(done) / count);
        }
    return {};
  }

 private:
  struct Found {
    std::array<int, 3> at;
    uint8_t colour;
  };

  Result<void> read_model(const ChunkBox& part) {
    std::vector<Found> found;
    for_each_chunk(part.voxels(), [&](ChunkCoord chunk) {
      if (voxels + found.size() > limits::export_voxels_max) return;
      for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i)
        read_brick(brick_in_chunk(chunk, i), found);
    });
    voxels += found.size();
    if (voxels > limits::export_voxels_max)
      return fail(
          fmt::format("more than {} voxels are rock (limits.export_voxels_max): --box makes them fewer",
                      limits::export_voxels_max));
    if (found.empty()) return {};
    Model model{found.front().at, found.front().at, {}};
    for (const Found& one : found)
      for (size_t i = 0; i < 3; ++i) {
        model.lo[i] = std::min(model.lo[i], one.at[i]);
        model.size[i] = std::max(model.size[i], one.at[i]);
      }
    for (size_t i = 0; i < 3; ++i) model.size[i] += 1 - model.lo[i];
    model.voxels.reserve(4 * found.size());
    for (const Found& one : found) {
      for (size_t i = 0; i < 3; ++i) model.voxels.push_back(static_cast<uint8_t>(one.at[i] - model.lo[i]));
      model.voxels.push_back(one.colour);
      used.insert(one.colour);
    }
    models.push_back(std::move(model));
    return {};
  }

  void read_brick(BrickCoord coord, std::vector<Found>& found) {
    const Brick brick = field_.brick(coord);
    if (uniform_equivalent(brick) == &air_brick()) return;
    const BrickRock rock = materials_of(field_, coord);
    const VoxelCoord first = first_voxel(coord);
    for (int i = 0; i < brick_voxels; ++i) {
      if (brick.codes[static_cast<size_t>(i)] >= 0) continue;
      const VoxelCoord v = first + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7};
      found.push_back({{v.x, -1 - v.z, v.y}, said(rock[static_cast<size_t>(i)])});
    }
  }

  Field& field_;
  const ChunkBox box_;
};

Bytes file_of(const VoxWriter& rock, const Palette& palette) {
  Bytes chunks;
  for (const Model& model : rock.models) {
    put_chunk(chunks, "SIZE", numbers({model.size[0], model.size[1], model.size[2]}));
    Bytes voxels = numbers({static_cast<int>(model.voxels.size() / 4)});
    voxels.insert(voxels.end(), model.voxels.begin(), model.voxels.end());
    put_chunk(chunks, "XYZI", voxels);
  }
  put_nodes(chunks, rock.models);
  put_palette(chunks, palette, rock.used);
  Bytes file{'V', 'O', 'X', ' '};
  ByteWriter writer(file);
  writer.u32(150);
  for (const char c : std::string_view("MAIN")) writer.u8(static_cast<uint8_t>(c));
  writer.u32(0);
  writer.u32(static_cast<uint32_t>(chunks.size()));
  file.insert(file.end(), chunks.begin(), chunks.end());
  return file;
}

}  // namespace

Result<VoxExported> export_vox(Field& field, const Palette& palette, const ChunkBox& box,
                               const std::string& path, const std::function<void(double)>& progress) {
  VoxWriter rock(field, box);
  TRY(rock.read(progress));
  if (rock.models.empty()) return fail("there is no rock in the box");
  const Bytes file = file_of(rock, palette);
  const auto bytes = TRY(write_whole(path, [&](const std::string& unfinished) -> Result<void> {
    std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    out.close();
    if (!out) return fail(std::strerror(errno));
    return {};
  }));
  return VoxExported{rock.voxels, rock.models.size(), rock.used.size(), bytes};
}

}  // namespace scree
