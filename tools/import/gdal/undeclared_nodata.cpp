#include "tools/import/gdal/undeclared_nodata.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Cells with the same extreme value, from which on it may be a value that fills.
constexpr uint64_t repeated_min = 4;
/// Distance from the next value, metres, from which on such a value is named.
constexpr double named_gap_m = 20.0;

/// The two extreme values of one side. `sign` is 1 for the lowest, -1 for the highest.
class Extreme {
 public:
  explicit Extreme(double sign) : sign_(sign) {}

  void add(double stored) {
    const double value = sign_ * std::clamp(stored, -limits::raster_fill_min, limits::raster_fill_min);
    if (value > second_) return;
    if (value == first_) {
      ++count_;
    } else if (value < first_) {
      second_ = first_;
      first_ = value;
      stored_ = stored;
      count_ = 1;
    } else {
      second_ = value;
    }
  }
  double stored() const { return stored_; }
  uint64_t count() const { return count_; }
  /// The next value; nothing when all are the same.
  std::optional<double> next() const {
    return std::isfinite(second_) ? std::optional(sign_ * second_) : std::nullopt;
  }

 private:
  double sign_;
  double first_ = infinite;
  double second_ = infinite;
  double stored_ = 0.0;
  uint64_t count_ = 0;
};

/// 999, 9999, 9999.9 and so on, of either sign.
bool is_of_nines(double stored) {
  const double size = std::abs(stored);
  for (double power = 1000.0; power < 1.0e10; power *= 10.0)
    if (size > power * (1.0 - 1.01e-3) && size < power) return true;
  return false;
}

bool is_too_high(const HeightValues& values, double stored) {
  return std::abs(values.height_m(stored)) > limits::raster_height_max_m;
}

/// Whether people mark cells without data by such a number: no height of the Earth, the ends of 16 bits, or
/// nines.
bool looks_like_fill(const HeightValues& values, double stored, std::optional<double> next) {
  constexpr double end_of_16_bits = 32767.0;
  const auto is_misdeclared = [&](double nodata) {
    const double wrapped = std::fmod(nodata, 65536.0);
    return stored == wrapped || stored == wrapped + 65536.0 || stored == wrapped - 65536.0;
  };
  return is_of_nines(stored) || std::abs(stored) >= end_of_16_bits ||
         (is_too_high(values, stored) && next && !is_too_high(values, *next)) ||
         std::ranges::any_of(values.misdeclared(), is_misdeclared);
}

Result<void> judge(const HeightValues& values, const Extreme& extreme, const Extreme& other,
                   std::vector<std::string>& said) {
  const double stored = extreme.stored();
  const bool fill = looks_like_fill(values, stored, extreme.next());
  const std::string text = values.text_of(stored);
  const std::string ways =
      fmt::format("--nodata {} says that they have no height, --nodata none that they do", text);
  if (!extreme.next()) {
    if (!fill || std::abs(stored) < 9000.0) return {};
    return fail(fmt::format("all cells hold {}, and the file does not declare it as nodata: {}", text, ways));
  }
  const double gap_m = std::abs(values.height_m(*extreme.next()) - values.height_m(stored));
  const std::string found =
      fmt::format("{} cells hold {}, {:.6g} m from the next height", extreme.count(), text, gap_m);
  if (fill && gap_m > limits::undeclared_gap_m)
    return fail(found + fmt::format(": it looks like nodata that the file does not declare: {}", ways));
  const double rest_m = std::abs(values.height_m(*extreme.next()) - values.height_m(other.stored()));
  if (extreme.count() >= repeated_min && gap_m > std::max(rest_m, named_gap_m))
    said.push_back(found +
                   fmt::format("; it was taken as a height (--nodata {} says that it is none)", text));
  return {};
}

/// Whether most cells, but for those with the extreme values, hold what is too high: then all heights are in
/// another unit, or none, and the import says so.
bool are_all_too_high(const HeightValues& values, const Extreme& lowest, const Extreme& highest,
                      uint64_t too_high, uint64_t all) {
  for (const Extreme* const extreme : {&lowest, &highest}) {
    if (extreme == &highest && highest.stored() == lowest.stored()) break;
    all -= extreme->count();
    too_high -= is_too_high(values, extreme->stored()) ? extreme->count() : 0;
  }
  return all > 0 && too_high > all / 2;
}

}  // namespace

Result<void> check_undeclared_nodata(HeightValues& values, std::vector<std::string>& said,
                                     const std::function<void(double)>& progress) {
  const int columns = values.band().GetXSize(), rows = values.band().GetYSize();
  Extreme lowest(1.0), highest(-1.0);
  uint64_t too_high = 0, all = 0;
  std::vector<double> row(static_cast<size_t>(columns));
  for (int z = 0; z < rows; ++z) {
    TRY(values.read_stored(0, z, columns, 1, row));
    for (const double stored : row)
      if (!std::isnan(stored)) {
        ++all;
        too_high += is_too_high(values, stored) ? 1 : 0;
        lowest.add(stored);
        highest.add(stored);
      }
    progress(static_cast<double>(z + 1) / rows);
  }
  if (lowest.count() == 0) return {};  // the import says so
  if (are_all_too_high(values, lowest, highest, too_high, all)) return {};
  TRY(judge(values, lowest, highest, said));
  return judge(values, highest, lowest, said);
}

}  // namespace scree
