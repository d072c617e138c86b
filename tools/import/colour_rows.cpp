#include "tools/import/colour_rows.h"

#include <algorithm>

namespace scree {

namespace {

using Indices = std::vector<size_t>;

struct Extent {
  size_t channel = 0;
  float length = 0.0F;
};

Extent longest(const std::vector<FileColour>& colours, const Indices& box) {
  Extent most;
  for (size_t channel = 0; channel < 3; ++channel) {
    float lo = 1e30F, hi = -1e30F;
    for (const size_t i : box) {
      lo = std::min(lo, colours[i].linear[channel]);
      hi = std::max(hi, colours[i].linear[channel]);
    }
    if (hi - lo > most.length) most = {channel, hi - lo};
  }
  return most;
}

/// Halves the box of the longest side, by weight, as long as there may be more and colours differ.
std::vector<Indices> cut(const std::vector<FileColour>& colours, Indices all, size_t boxes_max) {
  std::vector<Indices> boxes;
  boxes.push_back(std::move(all));
  while (boxes.size() < boxes_max) {
    size_t widest = 0;
    Extent extent;
    for (size_t i = 0; i < boxes.size(); ++i)
      if (const Extent own = longest(colours, boxes[i]); own.length > extent.length) {
        widest = i;
        extent = own;
      }
    if (!(extent.length > 0.0F)) break;
    Indices& box = boxes[widest];
    const auto value = [&](size_t i) { return colours[i].linear[extent.channel]; };
    std::ranges::stable_sort(box, [&](size_t a, size_t b) { return value(a) < value(b); });
    uint64_t sum = 0, before = 0;
    for (const size_t i : box) sum += colours[i].weight;
    size_t at = 0;
    while (at + 1 < box.size() && (before + colours[box[at]].weight) * 2 <= sum)
      before += colours[box[at++]].weight;
    at = std::clamp<size_t>(at, 1, box.size() - 1);
    Indices upper(box.begin() + static_cast<std::ptrdiff_t>(at), box.end());
    box.resize(at);
    boxes.push_back(std::move(upper));
  }
  return boxes;
}

MaterialRow row_of(const std::vector<FileColour>& colours, const Indices& box) {
  std::array<double, 3> sum{};
  double weight = 0.0;
  size_t heaviest = box.front();
  for (const size_t i : box) {
    const auto own = static_cast<double>(colours[i].weight);
    for (size_t k = 0; k < 3; ++k) sum[k] += own * static_cast<double>(colours[i].linear[k]);
    weight += own;
    if (colours[i].weight > colours[heaviest].weight) heaviest = i;
  }
  return row_of_colour(colours[heaviest].name,
                       {static_cast<float>(sum[0] / weight), static_cast<float>(sum[1] / weight),
                        static_cast<float>(sum[2] / weight)});
}

}  // namespace

Result<std::vector<VoxelMaterial>> rows_of_colours(const std::vector<FileColour>& colours, size_t rows_max,
                                                   ImportPalette& palette) {
  std::vector<VoxelMaterial> rows(colours.size(), ground_own);
  Indices used;
  for (size_t i = 0; i < colours.size(); ++i)
    if (colours[i].weight > 0) used.push_back(i);
  if (used.empty() || rows_max == 0) return rows;
  std::vector<Indices> boxes;
  if (used.size() <= rows_max)
    for (const size_t i : used) boxes.push_back({i});
  else
    boxes = cut(colours, used, rows_max);
  std::ranges::sort(boxes, {}, [](const Indices& box) { return *std::ranges::min_element(box); });
  for (const Indices& box : boxes) {
    const Material row = TRY(palette.add(row_of(colours, box)));
    for (const size_t i : box) rows[i] = said(row);
  }
  return rows;
}

}  // namespace scree
