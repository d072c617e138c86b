#include "shared/recombine/slide_columns.h"

#include <algorithm>
#include <cstdlib>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Passes over all pairs of cells: a slide is one stage of many, and what is still too steep slides again.
constexpr int sweeps = 6;

/// Flows of less than this are none.
constexpr int flow_min = 2;

/// A rise of less than this on ground of another kind would be a film.
constexpr int film_max = slide_steps / 8;

/// A step is one of a stone up to the height by which a cell may fall to the next, and this.
constexpr int step_more = slide_steps / 2;

/// By so much more is it high enough to start sliding.
constexpr int step_excess = slide_steps / 2;

/// Whether a voxel says that it is of that row: undisturbed ground, which has stood for long, says nothing.
bool is_said(const MaterialReader& materials, VoxelCoord v, Material material) {
  const MaterialReader::BrickOf& brick = materials.brick_at(materials.place_of(brick_of(v)));
  return brick.said->at(Brick::index(v.x & 7, v.y & 7, v.z & 7)) == said(material);
}

}  // namespace

SlideColumns::SlideColumns(const MaterialReader& materials, const Window& codes, const SlideTerms& terms)
    : window_(codes.box), size_(codes.box.size()), terms_(terms) {
  CHECK(materials.box() == codes.box && codes.box.covers(terms.box));
  columns_.resize(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.z));
  for (int x = 0; x < size_.x; ++x)
    for (int z = 0; z < size_.z; ++z) read_column(materials, codes, x, z);
  make_cells();
}

void SlideColumns::read_column(const MaterialReader& materials, const Window& codes, int x, int z) {
  SlideColumn& column = columns_[index(x, z)];
  const VoxelCoord foot{window_.lo.x + x, window_.lo.y, window_.lo.z + z};
  const Code* const code = &codes.codes[codes.index(foot.x, foot.y, foot.z)];
  const auto at = [&](int y) { return int{code[static_cast<ptrdiff_t>(y) * size_.z]}; };
  int top = size_.y - 1;
  while (top >= 0 && at(top) >= 0) --top;
  if (top < slide_margin || top >= size_.y - slide_margin) return;
  column.open = true;
  column.top = top;
  column.height = top * slide_steps + slide_steps * -at(top) / (at(top + 1) - at(top));
  column.now = column.height;
  int last = top + 1;
  const auto is_rubble = [&](int y) {
    return at(y) < 0 && is_said(materials, foot + VoxelCoord{0, y, 0}, terms_.material);
  };
  while (last > slide_margin && is_rubble(last - 1)) --last;
  column.last = last;
  column.floor = column.height;
  if (last > top) return;
  column.floor = std::min(last * slide_steps - slide_steps / 2, column.height);
}

void SlideColumns::make_cells() {
  const VoxelBox& box = terms_.box;
  const int side = terms_.cell, count = side * side;
  cells_x_ = box.size().x / side;
  cells_z_ = box.size().z / side;
  cells_.assign(static_cast<size_t>(cells_x_) * static_cast<size_t>(cells_z_), Cell{});
  for (int cx = 0; cx < cells_x_; ++cx)
    for (int cz = 0; cz < cells_z_; ++cz) {
      Cell& made = cell(cx, cz);
      made.open = true;
      made.rim = cx == 0 || cz == 0 || cx + 1 == cells_x_ || cz + 1 == cells_z_;
      const int x0 = box.lo.x - window_.lo.x + cx * side, z0 = box.lo.z - window_.lo.z + cz * side;
      for (int x = x0; x < x0 + side; ++x)
        for (int z = z0; z < z0 + side; ++z) {
          const SlideColumn& column = at(x, z);
          made.open = made.open && column.open;
          made.height += column.now;
          made.available += column.now - column.floor;
          made.sill = std::max(made.sill, column.floor);
        }
      made.height /= count;
      made.available /= count;
      made.before = made.height;
    }
}

int SlideColumns::threshold(const Pair& pair) const {
  return terms_.tangent * (slide_steps / 64) * terms_.cell * pair.distance / 128;
}

int SlideColumns::step_threshold(int distance) const {
  return (terms_.tangent * (slide_steps / 64) * terms_.cell + step_more) * distance / 128;
}

/// f(the places of two columns next to each other, and their distance) of those that may move.
template <typename F>
void SlideColumns::for_each_step(bool backward, F&& f) const {
  const int side = terms_.cell;
  const int x0 = terms_.box.lo.x - window_.lo.x + side, z0 = terms_.box.lo.z - window_.lo.z + side;
  const int nx = terms_.box.size().x - 2 * side, nz = terms_.box.size().z - 2 * side;
  if (nx <= 0 || nz <= 0) return;
  for (int i = 0; i < nx * nz; ++i) {
    const int at = backward ? nx * nz - 1 - i : i, x = at / nz, z = at % nz;
    for (const Pair& pair : pairs) {
      const int other_x = x + pair.dx, other_z = z + pair.dz;
      if (other_x >= nx || other_z < 0 || other_z >= nz) continue;
      f(index(x0 + x, z0 + z), index(x0 + other_x, z0 + other_z), pair.distance);
    }
  }
}

bool SlideColumns::flow_columns(SlideColumn& a, SlideColumn& b, int distance) {
  if (!a.open || !b.open) return false;
  const bool falls = a.now > b.now;
  SlideColumn &from = falls ? a : b, &to = falls ? b : a;
  const int moved = std::min((from.now - to.now - step_threshold(distance)) / 2, from.now - from.floor);
  if (moved < flow_min) return false;
  from.now -= moved;
  to.now += moved;
  return true;
}

bool SlideColumns::sweep_columns(bool backward) {
  bool moved = false;
  for_each_step(backward, [&](size_t a, size_t b, int distance) {
    moved |= flow_columns(columns_[a], columns_[b], distance);
  });
  return moved;
}

/// By how much the highest step of rubble is too high.
int SlideColumns::highest_step() const {
  int most = 0;
  for_each_step(false, [&](size_t a, size_t b, int distance) {
    const SlideColumn &one = columns_[a], &other = columns_[b];
    if (!one.open || !other.open) return;
    const bool falls = one.height > other.height;
    const SlideColumn &from = falls ? one : other, &to = falls ? other : one;
    const int drop = from.height - to.height - step_threshold(distance);
    most = std::max(most, std::min(drop, 2 * (from.height - from.floor)));
  });
  return most;
}

int SlideColumns::steepest() const {
  const int step = highest_step();
  int most = step > step_excess ? terms_.tangent + step * 64 / slide_steps : 0;
  for (int x = 0; x < cells_x_; ++x)
    for (int z = 0; z < cells_z_; ++z)
      for (const Pair& pair : pairs) {
        const int other_x = x + pair.dx, other_z = z + pair.dz;
        if (other_x >= cells_x_ || other_z < 0 || other_z >= cells_z_) continue;
        const Cell &one = cell(x, z), &other = cell(other_x, other_z);
        if (!one.open || !other.open || one.rim || other.rim) continue;
        const bool falls = one.height > other.height;
        const Cell &from = falls ? one : other, &to = falls ? other : one;
        if (from.available < flow_min || from.height <= to.sill) continue;
        const int drop = std::min(from.height - to.height, 2 * from.available + threshold(pair));
        most = std::max(most, drop * 64 * 128 / (pair.distance * terms_.cell * slide_steps));
      }
  return most;
}

bool SlideColumns::flow(Cell& a, Cell& b, const Pair& pair) {
  if (!a.open || !b.open || a.rim || b.rim) return false;
  const bool falls = a.height > b.height;
  Cell &from = falls ? a : b, &to = falls ? b : a;
  const int excess = from.height - to.height - threshold(pair);
  const int moved = std::min(excess / 2, from.available);
  if (moved < flow_min || from.height <= to.sill) return false;
  from.height -= moved;
  from.available -= moved;
  to.height += moved;
  to.available += moved;
  return true;
}

bool SlideColumns::sweep(bool backward) {
  bool moved = false;
  const int count = cells_x_ * cells_z_;
  for (int i = 0; i < count; ++i) {
    const int at = backward ? count - 1 - i : i, x = at / cells_z_, z = at % cells_z_;
    for (const Pair& pair : pairs) {
      const int other_x = x + pair.dx, other_z = z + pair.dz;
      if (other_x >= cells_x_ || other_z < 0 || other_z >= cells_z_) continue;
      moved |= flow(cell(x, z), cell(other_x, other_z), pair);
    }
  }
  return moved;
}

/// The shifts of the cells, interpolated between their middles. A cell that is closed has none, and its
/// neighbours keep their own up to it.
int SlideColumns::shift_at(int x, int z) const {
  const int side = terms_.cell;
  const int cx = x / side, cz = z / side;
  const Cell& own = cell(cx, cz);
  if (!own.open) return 0;
  const int off_x = 2 * (x - cx * side) + 1 - side, off_z = 2 * (z - cz * side) + 1 - side;
  const auto shift = [&](int dx, int dz) {
    const int other_x = cx + dx, other_z = cz + dz;
    const bool inside = other_x >= 0 && other_x < cells_x_ && other_z >= 0 && other_z < cells_z_;
    const Cell& other = inside ? cell(other_x, other_z) : own;
    return int64_t{other.open ? other.height - other.before : own.height - own.before};
  };
  const int to_x = off_x < 0 ? -1 : 1, to_z = off_z < 0 ? -1 : 1;
  const int64_t part_x = std::abs(off_x), part_z = std::abs(off_z), all = 2 * side;
  const int64_t sum = (all - part_x) * ((all - part_z) * shift(0, 0) + part_z * shift(0, to_z)) +
                      part_x * ((all - part_z) * shift(to_x, 0) + part_z * shift(to_x, to_z));
  return static_cast<int>(sum / (all * all));
}

bool SlideColumns::run() {
  bool moved = false;
  for (int i = 0; i < sweeps && sweep_columns(i % 2 != 0); ++i) moved = true;
  make_cells();
  for (int i = 0; i < sweeps && sweep(i % 2 != 0); ++i) moved = true;
  if (!moved) return false;
  wanted_.assign(columns_.size(), 0);
  const int first_x = terms_.box.lo.x - window_.lo.x, first_z = terms_.box.lo.z - window_.lo.z;
  const int highest = (size_.y - slide_margin - 1) * slide_steps;
  for (int x = 0; x < terms_.box.size().x; ++x)
    for (int z = 0; z < terms_.box.size().z; ++z) {
      const size_t i = index(first_x + x, first_z + z);
      const SlideColumn& column = columns_[i];
      if (!column.open) continue;
      int shift = column.now - column.height + shift_at(x, z);
      shift = std::clamp(shift, column.floor - column.height, std::max(0, highest - column.height));
      const Cell& own = cell(x / terms_.cell, z / terms_.cell);
      const bool bare = column.floor == column.height;
      // A post that sticks out stays bare.
      if (shift > 0 && bare && (shift < film_max || column.height > own.before + terms_.cell * slide_steps))
        shift = 0;
      wanted_[i] = shift;
    }
  return share_out(0);
}

bool SlideColumns::share_out(int64_t more) {
  int64_t lowered = 0, raised = 0;
  for (const int wanted : wanted_) (wanted < 0 ? lowered : raised) += std::abs(wanted);
  const int64_t lower = std::min(lowered, raised), raise = lower + more;
  if (lower < slide_steps || raise <= 0 || raise > 3 * raised) return false;
  for (size_t i = 0; i < columns_.size(); ++i) {
    const int64_t wanted = wanted_[i];
    columns_[i].shift = static_cast<int>(wanted < 0 ? wanted * lower / lowered : wanted * raise / raised);
  }
  return true;
}

}  // namespace scree
