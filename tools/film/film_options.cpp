#include "tools/film/film_options.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "client/render/draw_flags.h"
#include "client/viewer/base/camera_text.h"
#include "shared/base/option_check.h"
#include "tools/film/encoded_film.h"
#include "tools/film/limits.h"

namespace scree {
namespace {

constexpr int usage_error = 2;

/// For CLI::Option::check(): what a parser says is wrong, if anything.
template <typename Parse>
auto understood_by(Parse parse) {
  return [parse](const std::string& text) {
    const auto parsed = parse(text);
    return parsed ? std::string() : parsed.error().message;
  };
}

Result<void> check_method(const std::string& name) {
  if (method_named(name) != nullptr) return {};
  return fail("there is no '" + name + "'; there are\n" + describe_methods());
}

Result<void> check_quality(const std::string& name) {
  if (kind_named<Quality>(name)) return {};
  return fail("there is no '" + name + "'; there are " + listed(kind_names<Quality>));
}

/// In place of a place.
constexpr const char* at_spawn = "spawn";

Result<void> check_place(const std::string& text) {
  if (text == at_spawn) return {};
  TRY(parse_camera(text));
  return {};
}

/// Nothing where the option was not given.
template <typename Value, typename Parse>
std::optional<Value> if_given(const std::string& text, Parse parse) {
  if (text.empty()) return std::nullopt;
  auto value = parse(text);
  return value ? std::optional<Value>(*value) : std::nullopt;  // the option's check has told
}

/// Declares the options, and understands them once they are parsed.
class FilmOptionParser {
 public:
  explicit FilmOptionParser(CLI::App& app);

  /// After parsing. The error names the option.
  Result<FilmOptions> understand();

 private:
  void declare_moments(CLI::App& app);
  void declare_camera(CLI::App& app);
  void declare_pictures(CLI::App& app);
  Result<void> understand_camera();

  FilmOptions options_;
  std::string from_, to_, camera_, path_, eye_, orbit_;
  std::string size_ = "1280x720";
  std::string method_{all_methods().front().name};
  std::map<const DrawOption*, std::string> method_options_;
  std::string quality_{name_of(Quality::high)};
  float view_radius_m_ = 0.0F;  ///< 0: the quality's
  int encoder_quality_ = 80;
  CLI::Option* encoder_quality_given_ = nullptr;
  CLI::Option* sound_given_ = nullptr;
};

FilmOptionParser::FilmOptionParser(CLI::App& app) {
  app.add_option("RECORDING", options_.recording, "a recording")->required();
  app.add_option(
         "-o,--out", options_.format.file,
         "the film: a file whose name ends in .mp4, .webp or .gif, or a folder of PNGs, whose name ends in /")
      ->required()
      ->check(understood_by(check_film_name), "FILE");
  app.add_option("--ground", options_.ground, "its ground file; default: found in the same folder");
  declare_moments(app);
  declare_camera(app);
  declare_pictures(app);
  refuse_empty(app);
}

void FilmOptionParser::declare_moments(CLI::App& app) {
  const auto moment = understood_by(parse_tick_or_time);
  app.add_option(
         "--from", from_,
         "the first moment: a tick (600) or a time (10s, 1.5m or 1:30); default: by the camera, see --to")
      ->check(moment, "MOMENT");
  app.add_option("--to", to_,
                 "the last moment; default: an orbit shows 8 s around its event, a path is shown once, any "
                 "other camera shows the whole recording")
      ->check(moment, "MOMENT");
  bounded(app.add_option("--fps", options_.order.frames_per_s, "frames a second"),
          {limits::film_fps_min, limits::film_fps_max})
      ->capture_default_str();
  bounded(
      app.add_option("--speed", options_.order.speed, "seconds of the recording in one second of the film"),
      {limits::film_speed_min, limits::film_speed_max})
      ->capture_default_str();
}

void FilmOptionParser::declare_camera(CLI::App& app) {
  CLI::Option_group* const places =
      app.add_option_group("camera",
                           "the camera, at most one of these; default: an orbit around the largest event, or "
                           "spawn without events");
  places
      ->add_option("--camera", camera_,
                   "a fixed camera: x,y,z,yaw,pitch in metres and degrees, as in the viewer; "
                   "spawn: the place where the world's visitors begin")
      ->check(understood_by(check_place), "PLACE");
  places->add_option("--path", path_,
                     "FILE with key frames of the camera, as in the viewer (key K records one)");
  places->add_option(
      "--eye", eye_,
      "the view of a person in the recording: the name, or the session's number if there is no name");
  places
      ->add_option("--orbit", orbit_,
                   "an orbit around an event: its number in `scree replay events`, from 1, or the largest of "
                   "a kind: " +
                       listed(kind_names<EventKind>))
      ->check(understood_by(parse_event), "EVENT");
  places->require_option(0, 1);
  refuse_empty(*places);
}

void FilmOptionParser::declare_pictures(CLI::App& app) {
  app.add_option("--size", size_, "WIDTHxHEIGHT, pixels")
      ->check(understood_by(parse_size), "SIZE")
      ->capture_default_str();
  app.add_option("--method", method_, "drawing method:\n" + describe_methods())
      ->check(understood_by(check_method), "METHOD")
      ->capture_default_str();
  for (const DrawOption* option : all_draw_options()) add_draw_option(app, *option, method_options_[option]);
  app.add_option("--quality", quality_, "quality: " + listed(kind_names<Quality>))
      ->check(understood_by(check_quality), "QUALITY")
      ->capture_default_str();
  bounded(app.add_option("--view-radius", view_radius_m_,
                         "distance of detailed terrain, metres; default: by the quality"),
          {limits::view_radius_min_m, limits::view_radius_max_m});
  app.add_option("--particles", options_.drawn.particles,
                 "draw dust, grit and splinters where rock breaks, strikes and settles: true or false")
      ->capture_default_str();
  app.add_option("--details", options_.drawn.details,
                 "draw grass, bushes and stones on the ground, where the quality has them: true or false")
      ->capture_default_str();
  sound_given_ =
      app.add_option("--sound", options_.sound,
                     "the sound at the camera, in .mp4 and as sound.wav in a folder of PNGs: true or false")
          ->capture_default_str();
  encoder_quality_given_ =
      bounded(
          app.add_option(
              "--encoder-quality", encoder_quality_,
              "quality of .mp4 and .webp, 1 to 100; a higher one gives better pictures and a larger file"),
          whole_within(1, 100))
          ->capture_default_str();
}

Result<void> FilmOptionParser::understand_camera() {
  options_.order.camera = if_given<WhichEvent>(orbit_, parse_event).value_or(WhichEvent());
  if (camera_ == at_spawn)
    options_.order.camera = AtSpawn{};
  else if (const auto camera = if_given<Camera>(camera_, parse_camera))
    options_.order.camera = *camera;
  if (!eye_.empty()) options_.order.camera = PersonsEye{eye_};
  if (path_.empty()) return {};
  auto path = TRY(CameraPath::read(path_));
  options_.order.camera = std::move(path);
  return {};
}

Result<FilmOptions> FilmOptionParser::understand() {
  TRY(understand_camera());
  options_.order.from = if_given<TickOrTime>(from_, parse_tick_or_time);
  options_.order.to = if_given<TickOrTime>(to_, parse_tick_or_time);
  DrawChoice& drawn = options_.drawn;
  drawn.size = if_given<PictureSize>(size_, parse_size).value_or(PictureSize());
  drawn.method = method_named(method_);
  drawn.method_options = values_of_texts(method_options_);
  drawn.quality = kind_named<Quality>(quality_).value_or(Quality::high);
  drawn.view_radius_m = view_radius_m_ > 0.0F ? view_radius_m_ : traits_of(drawn.quality).view_radius_m;
  FilmFormat& format = options_.format;
  const Encoding* encoding = encoding_of(format.file);
  if (encoder_quality_given_->count() > 0 && (encoding == nullptr || !encoding->has_quality))
    return fail("--encoder-quality is only for .mp4 and .webp");
  const bool can = can_sound(format.file);
  if (options_.sound && !can && sound_given_->count() > 0)
    return fail("--sound is only for .mp4 and folders of PNGs");
  options_.sound = options_.sound && can;
  format.width = drawn.size.width;
  format.height = drawn.size.height;
  format.frames_per_s = options_.order.frames_per_s;
  format.quality = encoder_quality_;
  return options_;
}

}  // namespace

std::variant<FilmOptions, int> parse_film_options(int argc, const char* const* argv) {
  CLI::App app("Makes a film of a recording.", "scree-render");
  app.set_version_flag("--version", SCREE_VERSION);
  FilmOptionParser parser(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  auto options = parser.understand();
  if (options) return std::move(*options);
  std::fprintf(stderr, "scree-render: %s\n", options.error().message.c_str());
  return usage_error;
}

}  // namespace scree
