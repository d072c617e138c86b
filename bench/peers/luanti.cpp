#include "bench/peers/luanti.h"

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include "bench/peers/luanti_game.h"
#include "bench/support/measured_process.h"
#include "bench/support/text_file.h"
#include "shared/base/timing.h"

namespace scree::peers {

namespace {

/// The programs themselves: Debian's command for the server logs where root alone may write.
constexpr const char* server_path = "/usr/lib/minetest/minetestserver";
constexpr const char* client_path = "/usr/games/minetest";
constexpr double ready_within_s = 60.0;
constexpr double ends_within_s = 5.0;

/// All that is not Luanti's own choice: loopback alone, nothing announced, ground without caves.
std::string server_settings() {
  return "bind_address = 127.0.0.1\n"
         "ipv6_server = false\n"
         "enable_ipv6 = false\n"
         "server_announce = false\n"
         "max_users = 200\n"
         "enable_damage = false\n"
         "mg_name = flat\n"
         "mg_flags = nocaves,nodungeons,nodecorations,light,nobiomes,noores\n"
         "mgflat_spflags = nolakes,nohills,nocaverns\n"
         "fixed_map_seed = 1\n"
         "max_block_send_distance = 12\n";
}

/// `video_driver = null`: no window, no display, no pictures; all else as a client does.
std::string client_settings(int view_nodes) {
  return "video_driver = null\n"
         "enable_sound = false\n"
         "enable_minimap = false\n"
         "enable_ipv6 = false\n"
         "enable_client_modding = false\n"
         "enable_register_confirmation = false\n"
         "fps_max = 10\n"
         "fps_max_unfocused = 10\n"
         "viewing_range = " +
         std::to_string(view_nodes) + "\n";
}

/// A file that a process writes what it says to.
class Output {
 public:
  explicit Output(const std::string& path)
      : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {}
  ~Output() {
    if (file_ >= 0) ::close(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  int file() const { return file_; }

 private:
  int file_;
};

/// A process whose home is a folder of its own: nobody's settings, nobody's cache.
std::unique_ptr<MeasuredProcess> start_at_home(const std::string& home, const char* program,
                                               std::vector<std::string> options) {
  std::filesystem::create_directories(home);
  options.insert(options.begin(), {"HOME=" + home, "MINETEST_USER_PATH=" + home + "/.minetest",
                                   "XDG_CACHE_HOME=" + home + "/.cache", program});
  const Output output(home + "/output.txt");
  return std::make_unique<MeasuredProcess>("/usr/bin/env", std::move(options), output.file(), output.file());
}

}  // namespace

struct Luanti::State {
  std::string folder;
  int view_nodes = 0;
  std::unique_ptr<MeasuredProcess> server;
  std::unique_ptr<UdpRelay> relay;
  std::vector<std::unique_ptr<MeasuredProcess>> clients;

  std::string world() const { return folder + "/server/.minetest/worlds/peer"; }
  void order(const std::string& line) const {
    std::ofstream(world() + "/orders", std::ios::app) << line << '\n';
  }
  bool has_answered(const std::string& word) const {
    std::ifstream answers(world() + "/answers");
    for (std::string line; std::getline(answers, line);)
      if (line.starts_with(word)) return true;
    return false;
  }
  ~State() {
    for (const auto& client : clients) client->end(SIGKILL);
    if (server) server->end(SIGTERM, ends_within_s);
  }
};

std::optional<std::string> Luanti::missing() {
  for (const auto& [path, package] :
       {std::pair(server_path, "minetest-server"), std::pair(client_path, "minetest")})
    if (::access(path, X_OK) != 0) return std::string(package) + " is not installed";
  return std::nullopt;
}

std::string Luanti::version() {
  const std::unique_ptr<FILE, int (*)(FILE*)> told(
      ::popen((std::string(server_path) + " --version 2>/dev/null").c_str(), "r"), ::pclose);
  std::array<char, 64> line{};
  if (told == nullptr || std::fgets(line.data(), line.size(), told.get()) == nullptr) return "Minetest";
  std::istringstream words(line.data());
  std::string name, number;
  words >> name >> number;
  return name + " " + number;
}

Result<std::unique_ptr<Luanti>> Luanti::start(const std::string& folder, int view_nodes) {
  auto state = std::make_unique<State>();
  state->folder = folder;
  state->view_nodes = view_nodes;
  const Result<uint16_t> port = free_udp_port();
  TRY(port);
  const std::string home = folder + "/server";
  TRY(write_luanti_game(home + "/.minetest/games/" + luanti_game_id));
  for (const auto& [path, text] : {std::pair(home + "/server.conf", server_settings()),
                                   std::pair(state->world() + "/orders", std::string())})
    TRY(write_text_file(path, text));
  state->server =
      start_at_home(home, server_path,
                    {"--config", home + "/server.conf", "--world", state->world(), "--gameid", luanti_game_id,
                     "--port", std::to_string(*port), "--logfile", home + "/log.txt"});
  std::unique_ptr<UdpRelay> relay = TRY(UdpRelay::start(*port));
  state->relay = std::move(relay);
  const double until_s = steady_now_s() + ready_within_s;
  while (!state->has_answered("ready")) {
    if (steady_now_s() > until_s) return fail("Luanti's server is not ready after a minute");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return std::unique_ptr<Luanti>(new Luanti(std::move(state)));
}

Luanti::Luanti(std::unique_ptr<State> state) : state_(std::move(state)) {}

Luanti::~Luanti() = default;

Result<void> Luanti::add_client() {
  const std::string name = "viewer" + std::to_string(state_->clients.size());
  const std::string home = state_->folder + "/" + name;
  TRY(write_text_file(home + "/client.conf", client_settings(state_->view_nodes)));
  state_->clients.push_back(
      start_at_home(home, client_path,
                    {"--config", home + "/client.conf", "--go", "--address", "127.0.0.1", "--port",
                     std::to_string(state_->relay->port()), "--name", name, "--logfile", home + "/log.txt"}));
  return {};
}

size_t Luanti::clients() const {
  return state_->clients.size();
}

void Luanti::carve(glm::ivec3 centre, int radius) {
  std::ostringstream line;
  line << "carve " << centre.x << ' ' << centre.y << ' ' << centre.z << ' ' << radius;
  state_->order(line.str());
}

void Luanti::start_steps() {
  state_->order("steps");
}

LuantiTold Luanti::told() const {
  LuantiTold told;
  std::ifstream answers(state_->world() + "/answers");
  for (std::string line; std::getline(answers, line);) {
    std::istringstream words(line);
    std::string word;
    double us = 0.0;
    size_t nodes = 0;
    words >> word;
    if (word == "joined") ++told.joined;
    if (word == "step" && words >> us) told.steps_ms.push_back(us * 1e-3);
    if (word != "carved" || !(words >> us >> nodes)) continue;
    told.carve_ms.push_back(us * 1e-3);
    told.carved_nodes += nodes;
  }
  return told;
}

std::vector<RelayedBytes> Luanti::bytes() const {
  return state_->relay->counts();
}

double Luanti::server_cpu_s() const {
  return state_->server->cpu_s();
}

double Luanti::server_memory_mib() const {
  return state_->server->memory_mib("VmRSS");
}

}  // namespace scree::peers
