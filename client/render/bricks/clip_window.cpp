#include "client/render/bricks/clip_window.h"

#include <algorithm>
#include <bit>

#include "shared/base/check.h"

namespace scree {

ClipWindow::ClipWindow(int side) : side_(side) {
  CHECK(side >= 8 && side <= 64 && std::has_single_bit(static_cast<unsigned>(side)));
  entries_.resize(static_cast<size_t>(side) * slab());
  occupied_.resize(slab());
  changed_.resize(static_cast<size_t>(side), true);
}

bool ClipWindow::holds(BrickCoord brick) const {
  const BrickCoord p = brick - origin_;
  return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < side_ && p.y < height() && p.z < side_;
}

size_t ClipWindow::index(BrickCoord brick) const {
  const int x = brick.x & (side_ - 1), y = brick.y & (height() - 1), z = brick.z & (side_ - 1);
  return static_cast<size_t>((x * height() + y) * side_ + z);
}

void ClipWindow::write(size_t at, ClipEntry entry) {
  if (entries_[at] == entry) return;
  touched_ += entry.is_touched() ? 1 : 0;
  touched_ -= entries_[at].is_touched() ? 1 : 0;
  entries_[at] = entry;
  changed_[at / slab()] = true;
}

void ClipWindow::note(int x, int y) {
  if (!anything_dirty_) {
    dirty_ = {x, y, x + 1, y + 1};
    anything_dirty_ = true;
    return;
  }
  dirty_ = {std::min(dirty_.lo_x, x), std::min(dirty_.lo_y, y), std::max(dirty_.hi_x, x + 1),
            std::max(dirty_.hi_y, y + 1)};
}

void ClipWindow::move_to(BrickCoord origin, const std::function<void(const ClipEntry&)>& left) {
  if (placed_ && origin == origin_) return;
  const BrickCoord old = origin_;
  origin_ = origin;
  for (int x = 0; x < side_; ++x)
    for (int y = 0; y < height(); ++y) {
      uint64_t bits = 0;
      for (int z = 0; z < side_; ++z) {
        const BrickCoord brick = origin + BrickCoord{x, y, z};
        const BrickCoord in_old = brick - old;
        const bool stays = placed_ && in_old.x >= 0 && in_old.y >= 0 && in_old.z >= 0 && in_old.x < side_ &&
                           in_old.y < height() && in_old.z < side_;
        const size_t at = index(brick);
        if (!stays) {
          if (placed_) left(entries_[at]);
          write(at, {});
        }
        bits |= static_cast<uint64_t>(!entries_[at].is_empty()) << z;
      }
      row(x, y) = bits;
    }
  placed_ = true;
  dirty_ = {0, 0, side_, height()};
  anything_dirty_ = true;
}

void ClipWindow::set(BrickCoord brick, ClipEntry entry) {
  const size_t at = index(brick);
  const BrickCoord p = brick - origin_;
  // A brick that stays empty keeps the distance that it has.
  if (entry.is_empty() && entries_[at].is_empty()) entry.field = entries_[at].field;
  write(at, entry);
  const uint64_t bit = uint64_t{1} << p.z;
  const uint64_t bits = entry.is_empty() ? row(p.x, p.y) & ~bit : row(p.x, p.y) | bit;
  if (bits == row(p.x, p.y)) return;
  row(p.x, p.y) = bits;
  note(p.x, p.y);
}

std::vector<uint64_t> ClipWindow::dilated(const std::vector<uint64_t>& rows, const Columns& within) const {
  const uint64_t mask = side_ == 64 ? ~uint64_t{0} : (uint64_t{1} << side_) - 1;
  std::vector<uint64_t> wide(rows.size()), out(rows.size());
  const auto at = [this](int x, int y) { return static_cast<size_t>(x * height() + y); };
  for (int x = within.lo_x; x < within.hi_x; ++x) {
    for (int y = within.lo_y; y < within.hi_y; ++y) {
      uint64_t bits = rows[at(x, y)];
      if (y > within.lo_y) bits |= rows[at(x, y - 1)];
      if (y + 1 < within.hi_y) bits |= rows[at(x, y + 1)];
      wide[at(x, y)] = (bits | bits << 1U | bits >> 1U) & mask;
    }
  }
  for (int x = within.lo_x; x < within.hi_x; ++x) {
    for (int y = within.lo_y; y < within.hi_y; ++y) {
      uint64_t bits = wide[at(x, y)];
      if (x > within.lo_x) bits |= wide[at(x - 1, y)];
      if (x + 1 < within.hi_x) bits |= wide[at(x + 1, y)];
      out[at(x, y)] = bits;
    }
  }
  return out;
}

void ClipWindow::write_distances(uint64_t bits, int x, int y, uint32_t distance) {
  for (; bits != 0; bits &= bits - 1) {
    const BrickCoord brick = origin_ + BrickCoord{x, y, std::countr_zero(bits)};
    const size_t at = index(brick);
    write(at, {distance << 24U, entries_[at].before, entries_[at].looks});
  }
}

void ClipWindow::settle() {
  if (!anything_dirty_) return;
  anything_dirty_ = false;
  const auto grown = [this](const Columns& c, int by) {
    return Columns{std::max(c.lo_x - by, 0), std::max(c.lo_y - by, 0), std::min(c.hi_x + by, side_),
                   std::min(c.hi_y + by, height())};
  };
  const Columns written = grown(dirty_, empty_distance_max);
  const Columns read = grown(dirty_, 2 * empty_distance_max);
  std::vector<uint64_t> covered = occupied_;
  const uint64_t mask = side_ == 64 ? ~uint64_t{0} : (uint64_t{1} << side_) - 1;
  for (uint32_t distance = 1; distance < empty_distance_max; ++distance) {
    std::vector<uint64_t> next = dilated(covered, read);
    for (int x = written.lo_x; x < written.hi_x; ++x)
      for (int y = written.lo_y; y < written.hi_y; ++y) {
        const auto at = static_cast<size_t>(x * height() + y);
        write_distances(next[at] & ~covered[at], x, y, distance);
      }
    covered = std::move(next);
  }
  for (int x = written.lo_x; x < written.hi_x; ++x)
    for (int y = written.lo_y; y < written.hi_y; ++y)
      write_distances(~covered[static_cast<size_t>(x * height() + y)] & mask, x, y, empty_distance_max);
}

}  // namespace scree
