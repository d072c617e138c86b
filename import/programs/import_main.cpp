// scree-import: makes a ground file of an elevation model.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "ground/ground_header.h"
#include "import/gdal/gdal_raster.h"
#include "import/heights_import.h"

namespace scree {
namespace {

constexpr int failed = 1;
constexpr int usage_error = 2;

struct Options {
  std::string file;
  std::string out;
  std::string preview;
  HeightsImport how;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("file", options.file,
                 "elevation model: GeoTIFF, ESRI ASCII, 16-bit PNG, whatever GDAL reads")
      ->required();
  app.add_option("-o,--out", options.out, "the ground file to write")->required();
  HeightsImport& how = options.how;
  app.add_option("--cell", how.cell_m, "metres between the file's samples; unless said, as the file says")
      ->check(CLI::PositiveNumber);
  app.add_option("--sample", how.sample_m, "metres between the ground's samples; unless said, as the file's")
      ->check(CLI::PositiveNumber);
  app.add_option("--vertical-scale", how.vertical_scale, "times the file's heights, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--zero", how.zero_m,
                 "height, after the scale, that becomes y = 0; unless said, the lowest");
  app.add_option("--nodata", how.nodata_m,
                 "height, after the scale, where the file has none; unless said, the lowest");
  app.add_option("--soil-below", how.soil_below_m,
                 "a metre of soil covers ground below this y; unless said, all");
  app.add_option("--ice-above", how.ice_above_m, "ice covers ground above this y; unless said, none");
  app.add_option("--preview", options.preview, "draws a shaded relief to this PNG file");
}

/// On standard error, when it is a terminal.
class ProgressBar {
 public:
  void show(double part) {
    const int percent = static_cast<int>(part * 100.0);
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    std::fprintf(stderr, "\r[%-50.*s] %3d %%", percent / 2,
                 "##################################################", percent);
  }
  void end() const {
    if (percent_ >= 0) std::fprintf(stderr, "\n");
  }

 private:
  const bool shown_ = isatty(STDERR_FILENO) != 0;
  int percent_ = -1;
};

int refuse(const Error& error) {
  std::fprintf(stderr, "scree-import: %s\n", error.message.c_str());
  return failed;
}

void print(const Options& options, const HeightsImported& imported, double seconds) {
  const HeightLayout& layout = imported.header.ground.layout;
  const nlohmann::ordered_json line{{"ground", options.out},
                                    {"hash", hex_of(name_of(imported.header))},
                                    {"bytes", imported.bytes},
                                    {"columns", layout.columns},
                                    {"rows", layout.rows},
                                    {"sample_m", layout.cell_m},
                                    {"tiles", layout.tiles()},
                                    {"lowest_m", imported.lowest_m},
                                    {"highest_m", imported.highest_m},
                                    {"zero_m", imported.header.zero_m},
                                    {"cells_without_data", imported.nodata},
                                    {"volume_m3", imported.volume_m3},
                                    {"seconds", seconds}};
  std::printf("%s\n", line.dump().c_str());
}

int run(const Options& options) {
  const auto began = std::chrono::steady_clock::now();
  auto raster = open_raster(options.file);
  if (!raster) return refuse(raster.error());
  ProgressBar bar;
  const auto imported =
      import_heights(**raster, options.out, options.how, [&](double part) { bar.show(part); });
  bar.end();
  if (!imported) return refuse({options.file + ": " + imported.error().message});
  if (!options.preview.empty()) {
    const std::vector<uint8_t> pixels = shaded_relief(*imported);
    const int columns = imported->preview_columns;
    const auto written =
        write_grey_png(options.preview, columns, static_cast<int>(pixels.size()) / columns, pixels);
    if (!written) return refuse(written.error());
  }
  print(options, *imported, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  return 0;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  CLI::App app("Makes a ground file of an elevation model: what scree-server --ground hosts.",
               "scree-import");
  app.set_version_flag("--version", SCREE_VERSION);
  scree::Options options;
  scree::declare(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : scree::usage_error;
  }
  return scree::run(options);
}
