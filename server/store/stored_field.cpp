#include "server/store/stored_field.h"

#include <deque>
#include <fmt/format.h>
#include <utility>

#include "server/store/ground_mass.h"

namespace scree {

namespace {

/// Reads a chunk of the file, in place of those that were read first.
class Shelf {
 public:
  Shelf(std::unique_ptr<WorldFile> file, Field& field, size_t bricks_max)
      : file_(std::move(file)), field_(field), bricks_max_(bricks_max) {}

  Result<std::vector<BrickPatch>> read(ChunkCoord chunk) {
    while (field_.bricks_in() >= bricks_max_ && !read_.empty()) {
      field_.page_out(read_.front());
      read_.pop_front();
    }
    auto bricks = file_->read_bricks(chunk);
    if (bricks) read_.push_back(chunk);
    return bricks;
  }

 private:
  std::unique_ptr<WorldFile> file_;
  Field& field_;
  const size_t bricks_max_;
  std::deque<ChunkCoord> read_;  ///< that are in, the first one first
};

}  // namespace

PagedTerrain terrain_of(WorldFile& file, ReadChunk read, GroundMasses& ground, size_t bricks_max) {
  const auto each = [&file, &ground](const PagedTerrain::Visit& visit) -> Result<void> {
    const auto bytes = file.each_chunk([&](const WorldChunk& chunk) {
      if (chunk.ground_mass) ground[chunk.chunk] = *chunk.ground_mass;
      return visit(chunk.chunk, chunk.bricks);
    });
    return bytes ? Result<void>() : tl::unexpected(bytes.error());
  };
  return {each, std::move(read), bricks_max};
}

Result<void> create_world(const std::string& path, const WorldHeader& header, World& world) {
  const ReadChunk read = reader_of(world);
  const auto each = [&](const WorldFile::PutChunk& put) -> Result<void> {
    for (const ChunkCoord chunk : world.field().edited_chunks()) {
      auto bricks = TRY(read(chunk));
      const MassUnits ground = measured_ground(world.field().source(), bricks).at(chunk);
      const WorldChunk row{chunk, world.tick(), world.field().chunk_hash(chunk), std::move(bricks), ground};
      TRY(put(row));
    }
    return {};
  };
  const auto made = WorldFile::create(path, header, world.moment(), each);
  return made ? Result<void>() : tl::unexpected(made.error());
}

Result<std::unique_ptr<Field>> stored_field(std::unique_ptr<WorldFile> file, const TerrainSource& source,
                                            size_t bricks_max) {
  auto field = std::make_unique<MapField>(source);
  WorldFile& rows = *file;
  const auto shelf = std::make_shared<Shelf>(std::move(file), *field, bricks_max);
  field->page_by([shelf](ChunkCoord chunk) { return shelf->read(chunk); });
  const auto read = rows.each_chunk([&](const WorldChunk& chunk) -> Result<void> {
    const auto left = paged_of(source, chunk.chunk, chunk.bricks);
    if (!left) return fail(fmt::format("{}: damaged: {}", rows.path(), left.error().message));
    field->add_out(chunk.chunk, *left);
    return {};
  });
  TRY(read);
  return field;
}

}  // namespace scree
