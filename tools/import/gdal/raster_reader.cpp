#include "tools/import/gdal/raster_reader.h"

#include "shared/base/regular_file.h"
#include "tools/import/gdal/gdal_library.h"
#include "tools/import/gdal/gdal_raster.h"
#include "tools/import/gdal/packed_file.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// What the import asks of the reader: a row by its number, or one of these.
constexpr int ask_check = -1, ask_said = -2;

/// A step of the bar that is worth a message.
constexpr double progress_step = 0.01;
/// Ends the answer to ask_check, which is parts from 0 to 1 until then.
constexpr double checked = 2.0;

Result<void> put_said(Raster& raster, ReaderChannel& channel) {
  const std::vector<std::string> lines = raster.said();
  TRY(channel.put(static_cast<uint32_t>(lines.size())));
  for (const std::string& line : lines) TRY(channel.put_text(line));
  return {};
}

Result<void> put_check(Raster& raster, ReaderChannel& channel) {
  double last = 0.0;
  Result<void> told;
  TRY(raster.check_values([&](double part) {
    if (part < last + progress_step || !told) return;
    last = part;
    told = channel.put(part);
    if (told) told = channel.flush();
  }));
  TRY(told);
  return channel.put(checked);
}

/// The reader's side: answers until the import ends it.
Result<void> answer(const std::string& path, const RasterChoice& choice, ReaderChannel& channel) {
  prepare_gdal();
  const auto packed = TRY(find_packed(path, choice.layer));
  TRY(channel.put(packed.has_value()));
  if (packed) return send_packed(*packed, channel);
  const auto raster = TRY(open_raster(path, choice));
  TRY(channel.put(raster->shape()));
  const auto place = raster->place();
  TRY(channel.put(place.has_value()));
  if (place) {
    TRY(channel.put(std::array{place->x, place->y}));
    TRY(channel.put_text(place->crs));
  }
  std::vector<double> row(static_cast<size_t>(raster->shape().columns));
  while (true) {
    TRY(channel.flush());
    const int asked = TRY(channel.get<int>());
    if (asked == ask_check) {
      TRY(put_check(*raster, channel));
    } else if (asked == ask_said) {
      TRY(put_said(*raster, channel));
    } else {
      TRY(raster->read_row(asked, row));
      TRY(channel.put_all(std::span<const double>(row)));
    }
  }
}

class ReaderRaster final : public Raster {
 public:
  /// The first reader may send a file out of an archive; another one reads that.
  Result<void> open(const std::string& path, const RasterChoice& choice, const ReaderLimits& bounds) {
    TRY(start(path, choice, bounds));
    if (TRY(reader_->get<bool>())) {
      unpacked_ = TRY(UnpackedFile::receive(*reader_));
      RasterChoice left = choice;
      left.layer = unpacked_->layer();
      TRY(start(unpacked_->path(), left, bounds));
      if (TRY(reader_->get<bool>())) return fail("its reader takes an unpacked file for an archive");
    }
    shape_ = TRY(reader_->get<Shape>());
    if (TRY(reader_->get<bool>())) {
      const auto at = TRY(reader_->get<std::array<double, 2>>());
      place_ = Place{TRY(reader_->get_text()), at[0], at[1]};
    }
    TRY(fetch_said());
    if (unpacked_ != nullptr) unpacked_->remove_name();
    return {};
  }

  Shape shape() const override { return shape_; }
  std::optional<Place> place() const override { return place_; }

  Result<void> check_values(const std::function<void(double)>& progress) override {
    TRY(ask(ask_check));
    for (double part = 0.0; part != checked; part = TRY(reader_->get<double>())) progress(part);
    return fetch_said();
  }

  Result<void> read_row(int row, std::span<double> heights_m) override {
    TRY(ask(row));
    TRY(reader_->get_all(heights_m));
    if (row == shape_.rows - 1) TRY(fetch_said());  // what it was warned of meanwhile
    return {};
  }

  std::vector<std::string> said() override {
    std::vector<std::string> lines = said_;
    if (unpacked_ != nullptr) lines.insert(lines.end(), unpacked_->said().begin(), unpacked_->said().end());
    return lines;
  }
  /// Empty: it is in no archive, or is read there.
  std::string unpacked_path() const { return unpacked_ == nullptr ? std::string() : unpacked_->path(); }

 private:
  Result<void> start(const std::string& path, const RasterChoice& choice, const ReaderLimits& bounds) {
    reader_ = TRY(ReaderProcess::start(
        "GDAL", bounds, [&](ReaderChannel& channel) { return answer(path, choice, channel); },
        file_and_its_namesakes(path)));
    return {};
  }

  Result<void> ask(int what) {
    TRY(reader_->put(what));
    return reader_->flush();
  }

  Result<void> fetch_said() {
    TRY(ask(ask_said));
    const auto count = TRY(reader_->get<uint32_t>());
    if (count > limits::raster_said_max) return fail("its reader says more than there can be");
    std::vector<std::string> lines;
    for (uint32_t i = 0; i < count; ++i) lines.push_back(TRY(reader_->get_text()));
    said_ = std::move(lines);
    return {};
  }

  std::unique_ptr<UnpackedFile> unpacked_;  ///< the reader has it open
  std::unique_ptr<ReaderProcess> reader_;
  Shape shape_;
  std::optional<Place> place_;
  std::vector<std::string> said_;
};

}  // namespace

Result<std::unique_ptr<Raster>> open_raster_apart(const std::string& path, const RasterChoice& choice,
                                                  const ReaderLimits& bounds) {
  if (const auto checked = check_is_file(path); !checked) return fail(path + ": " + checked.error().message);
  auto raster = std::make_unique<ReaderRaster>();
  if (const auto opened = raster->open(path, choice, bounds); !opened) {
    std::string words = opened.error().message;
    const std::string unpacked = raster->unpacked_path();
    for (size_t at = 0; !unpacked.empty() && (at = words.find(unpacked)) != std::string::npos;)
      words.replace(at, unpacked.size(), path);
    return fail(words.starts_with(path) ? words : path + ": " + words);
  }
  return raster;
}

}  // namespace scree
