// Elevation models that lead elsewhere: to other files of the machine, and to the network. None is followed,
// and honest files are read beside them.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/holds.h"
#include "tests/support/quiet_port.h"
#include "tests/support/run_program.h"
#include "tests/support/vrt_raster.h"
#include "tools/import/gdal/raster_reader.h"

namespace scree {
namespace {

const std::string honest_tif = SCREE_SOURCE_DIR "/tests/data/rasters/south_up.tif";

/// A number of the secret file, which no ground may hold.
constexpr int secret = 77;

class HostileRasters : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(port_.listens());
    std::filesystem::create_directories(folder_ / "given");
    std::ofstream(folder_ / "secret.bin") << std::string(64, static_cast<char>(secret));
  }
  void TearDown() override { EXPECT_FALSE(port_.was_called()) << "a connection came"; }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / ("given/" + name), std::ios::binary) << text;
    return folder_ / ("given/" + name);
  }
  /// As import reads it: in a process of its own.
  static WholeRaster read_apart(const std::string& path, const RasterChoice& choice = {}) {
    const auto raster = open_raster_apart(path, choice, {});
    if (raster) return read_whole(**raster);
    WholeRaster none;
    none.refusal = raster.error().message;
    return none;
  }
  std::string raw_vrt(const std::string& source) const {
    return "<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"><VRTRasterBand dataType=\"Byte\" band=\"1\" "
           "subClass=\"VRTRawRasterBand\"><SourceFilename relativeToVRT=\"1\">" +
           source +
           "</SourceFilename><ImageOffset>0</ImageOffset><PixelOffset>1</PixelOffset><LineOffset>8</"
           "LineOffset>"
           "</VRTRasterBand></VRTDataset>";
  }
  std::string source_vrt(const std::string& source) const {
    return "<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"><VRTRasterBand dataType=\"Byte\" band=\"1\">"
           "<SimpleSource><SourceFilename relativeToVRT=\"0\">" +
           source + "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
  }

  TestFolder folder_;
  QuietPort port_;
};

TEST_F(HostileRasters, a_vrt_is_refused_by_name_whatever_it_is_called) {
  for (const char* const name : {"hill.tif", "hill.vrt", "hill.asc", "hill.png"})
    for (const std::string& text :
         {raw_vrt("../secret.bin"), raw_vrt(folder_ / "secret.bin"), source_vrt("/vsicurl/" + port_.url()),
          "\xEF\xBB\xBF \n" + source_vrt(honest_tif)}) {
      const WholeRaster read = read_apart(write(name, text));
      EXPECT_TRUE(read.refuses("a VRT, which holds no heights but names where they lie")) << read.refusal;
      EXPECT_TRUE(read.refuses("gdal_translate")) << read.refusal;
      EXPECT_TRUE(read.heights_m.empty());
    }
  const VrtForm form;
  const std::string leaks = write("hill.tif", raw_vrt("../secret.bin"));
  const WholeRaster whole = read_whole(leaks);
  EXPECT_EQ(whole.at(0, 0), secret) << "GDAL by itself gives the secret away: " << whole.refusal;
}

TEST_F(HostileRasters, the_program_makes_no_ground_of_a_vrt) {
  const std::string file = write("hill.tif", raw_vrt("../secret.bin")), ground = folder_ / "hill.ground";
  const auto [code, said] =
      run_program(std::string(SCREE_IMPORT_PROGRAM) + " " + file + " --cell 1 -o " + ground);
  EXPECT_EQ(code, 1);
  EXPECT_TRUE(holds(said, "a VRT")) << said;
  EXPECT_FALSE(std::filesystem::exists(ground));
}

TEST_F(HostileRasters, descriptions_of_services_are_refused_by_name) {
  const std::string url = port_.url();
  EXPECT_TRUE(read_apart(write("a.tif", "<GDAL_WMS><Service name=\"TMS\"><ServerUrl>" + url +
                                            "${z}/${x}/${y}.png</ServerUrl></Service></GDAL_WMS>"))
                  .refuses("a WMS"));
  EXPECT_TRUE(read_apart(write("b.tif", "<WCS_GDAL><ServiceURL>" + url +
                                            "</ServiceURL><CoverageName>a</CoverageName></WCS_GDAL>"))
                  .refuses("a WCS"));
  EXPECT_TRUE(read_apart(write("c.tif",
                               "<GDAL_WMTS><GetCapabilitiesUrl>" + url + "</GetCapabilitiesUrl></GDAL_WMTS>"))
                  .refuses("a WMTS"));
  EXPECT_TRUE(read_apart(write("d.tif", "{\"stac_version\":\"1.0.0\",\"href\":\"" + url + "\"}"))
                  .refuses("not an elevation model"));
}

TEST_F(HostileRasters, names_that_are_no_files_are_refused) {
  const std::vector<std::string> names{"/vsicurl/" + port_.url() + "a.tif",
                                       "/vsizip/vsicurl/" + port_.url() + "a.zip",
                                       port_.url() + "a.tif",
                                       "WCS:" + port_.url(),
                                       "WMS:" + port_.url(),
                                       "PLScenes:api_key=a",
                                       "NETCDF:" + port_.url(),
                                       source_vrt(folder_ / "secret.bin"),
                                       "GTIFF_DIR:1:" + honest_tif};
  for (const std::string& name : names) {
    const WholeRaster read = read_apart(name);
    EXPECT_TRUE(read.refuses("there is no such file")) << read.refusal;
  }
}

TEST_F(HostileRasters, files_beside_a_raster_lead_nowhere) {
  const std::string hill = folder_ / "given/hill.tif", other = "/vsicurl/" + port_.url() + "a.tif";
  std::filesystem::copy_file(honest_tif, hill);
  const WholeRaster honest = read_apart(hill);
  ASSERT_EQ(honest.refusal, "");
  const auto metadata = [](const std::string& domain, const std::string& key, const std::string& value) {
    return "<Metadata domain=\"" + domain + "\"><MDI key=\"" + key + "\">" + value + "</MDI></Metadata>";
  };
  const std::vector<std::string> within{
      metadata("OVERVIEWS", "OVERVIEW_FILE", other),
      metadata("OVERVIEWS", "OVERVIEW_FILE", folder_ / "secret.bin"),
      metadata("SUBDATASETS", "SUBDATASET_1_NAME", other) +
          metadata("SUBDATASETS", "SUBDATASET_2_NAME", folder_ / "secret.bin"),
  };
  for (const std::string& element : within) {
    write("hill.tif.aux.xml", "<PAMDataset>" + element + "</PAMDataset>");
    const WholeRaster read = read_apart(hill);
    EXPECT_EQ(read.refusal, "") << element;
    EXPECT_EQ(read.heights_m, honest.heights_m) << element;
    EXPECT_FALSE(read_apart(hill, {.layer = "2"}).refusal.empty()) << element;
  }
  std::filesystem::remove(folder_ / "given/hill.tif.aux.xml");
  for (const char* const beside : {"hill.tif.ovr", "hill.tif.msk"})
    for (const std::string& source : {other, folder_ / "secret.bin"}) {
      write(beside, source_vrt(source));
      EXPECT_EQ(read_apart(hill).heights_m, honest.heights_m) << beside;
    }
}

TEST_F(HostileRasters, a_geolocation_table_elsewhere_is_not_read) {
  const std::string hill = folder_ / "given/hill.tif";
  std::filesystem::copy_file(SCREE_SOURCE_DIR "/tests/data/rasters/feet_band.tif", hill);
  for (const std::string& table : {"/vsicurl/" + port_.url() + "x.tif", folder_ / "secret.bin"})
    write("hill.tif.aux.xml",
          "<PAMDataset><Metadata domain=\"GEOLOCATION\"><MDI key=\"X_DATASET\">" + table +
              "</MDI><MDI key=\"Y_DATASET\">" + table +
              "</MDI><MDI key=\"X_BAND\">1</MDI><MDI key=\"Y_BAND\">1</MDI></Metadata></PAMDataset>");
  const WholeRaster read = read_apart(hill);
  EXPECT_FALSE(holds(read.said + read.refusal, "secret.bin: ")) << read.said << read.refusal;
}

TEST_F(HostileRasters, a_pipe_and_a_device_are_no_files) {
  const std::string pipe = folder_ / "given/hill.tif";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(read_apart(pipe).refuses("hill.tif: it is a pipe, not a file"));
  EXPECT_TRUE(read_apart("/dev/zero").refuses("it is a device, not a file"));
  EXPECT_TRUE(read_apart(folder_ / "given").refuses("it is a folder, not a file"));
}

}  // namespace
}  // namespace scree
