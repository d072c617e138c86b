// The walls around the process that reads a foreign file: each hostile act of it is refused, and it still
// reads what it was started for.
#include "tools/import/process/sandbox.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/io_uring.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/support/holds.h"
#include "tests/support/run_program.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_gltf.h"
#include "tools/import/process/reader_process.h"

namespace scree {
namespace {

class Sandbox : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!missing_walls().empty()) GTEST_SKIP() << missing_walls();
    std::filesystem::create_directories(folder_ / "own/below");
    std::filesystem::create_directories(folder_ / "other");
    for (const char* const file :
         {"own/hill.bil", "own/hill.hdr", "own/hills.hdr", "own/below/hill.hdr", "other/secret"})
      std::ofstream(folder_ / file) << "bytes";
    std::filesystem::create_symlink(folder_ / "other/secret", folder_ / "own/hill.prj");
  }

  /// What the child says of an act: 0, or the number of the error.
  static int error_of(const std::function<bool()>& act, const Readable& readable = {}) {
    auto reader = ReaderProcess::start(
        "libthing", {},
        [&](ReaderChannel& channel) -> Result<void> {
          errno = 0;
          return channel.put(act() ? 0 : errno);
        },
        readable);
    if (!reader) return -1;
    const auto said = (*reader)->get<int>();
    return said ? *said : -1;
  }
  static int error_of_opening(const std::string& path, int how, const Readable& readable = {}) {
    return error_of([&] { return ::open(path.c_str(), how, 0600) >= 0; }, readable);
  }

  TestFolder folder_;
};

TEST_F(Sandbox, reads_the_file_and_its_namesakes_alone) {
  const Readable namesakes = file_and_its_namesakes(folder_ / "own/hill.bil");
  const auto error = [&](const std::string& path) { return error_of_opening(path, O_RDONLY, namesakes); };
  EXPECT_EQ(error(folder_ / "own/hill.bil"), 0);
  EXPECT_EQ(error(folder_ / "own/hill.hdr"), 0);
  EXPECT_EQ(error(folder_ / "own/hills.hdr"), EACCES);
  EXPECT_EQ(error(folder_ / "own/below/hill.hdr"), EACCES);
  EXPECT_EQ(error(folder_ / "own/hill.prj"), EACCES) << "a link to another folder";
  EXPECT_EQ(error(folder_ / "own/../other/secret"), EACCES);
  EXPECT_EQ(error("/etc/passwd"), EACCES);
  EXPECT_EQ(error("/proc/self/environ"), EACCES);
  EXPECT_EQ(error("/usr/share/doc"), 0) << "tables of libraries lie there";
}

TEST_F(Sandbox, reads_the_folder_of_the_file_and_none_above) {
  const Readable below = file_and_its_folder(folder_ / "own/hill.bil");
  EXPECT_EQ(error_of_opening(folder_ / "own/below/hill.hdr", O_RDONLY, below), 0);
  EXPECT_EQ(error_of_opening(folder_ / "own/hill.prj", O_RDONLY, below), EACCES) << "a link";
  EXPECT_EQ(error_of_opening(folder_ / "other/secret", O_RDONLY, below), EACCES);
  EXPECT_EQ(error_of([&] { return ::open((folder_ / "other").c_str(), O_RDONLY | O_DIRECTORY) >= 0; }, below),
            EACCES);
}

TEST_F(Sandbox, writes_nothing) {
  const Readable below = file_and_its_folder(folder_ / "own/hill.bil");
  const std::string own = folder_ / "own/hill.bil", fresh = folder_ / "own/fresh";
  EXPECT_EQ(error_of_opening(own, O_WRONLY, below), EACCES);
  EXPECT_EQ(error_of_opening(own, O_RDWR, below), EACCES);
  EXPECT_EQ(error_of_opening(own, O_RDONLY | O_TRUNC, below), EACCES);
  EXPECT_EQ(error_of_opening(fresh, O_RDONLY | O_CREAT, below), EACCES);
  const std::vector<std::function<bool()>> acts{
      [&] { return ::unlink(own.c_str()) == 0; },
      [&] { return ::rename(own.c_str(), fresh.c_str()) == 0; },
      [&] { return ::link(own.c_str(), fresh.c_str()) == 0; },
      [&] { return ::symlink(own.c_str(), fresh.c_str()) == 0; },
      [&] { return ::mkdir(fresh.c_str(), 0700) == 0; },
      [&] { return ::mkfifo(fresh.c_str(), 0600) == 0; },
      [&] { return ::chmod(own.c_str(), 0777) == 0; },
      [&] { return ::truncate(own.c_str(), 0) == 0; },
      [&] { return ::utimensat(AT_FDCWD, own.c_str(), nullptr, 0) == 0; },
  };
  for (size_t i = 0; i < acts.size(); ++i) EXPECT_EQ(error_of(acts[i], below), EACCES) << "act " << i;
  EXPECT_EQ(std::filesystem::file_size(own), 5U);
  EXPECT_FALSE(std::filesystem::exists(fresh));
}

TEST_F(Sandbox, reaches_no_network_and_starts_nothing) {
  const std::vector<std::function<bool()>> acts{
      [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; },
      [] { return ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0; },
      [] {
        io_uring_params ring{};
        return ::syscall(SYS_io_uring_setup, 4, &ring) >= 0;
      },
      [] { return ::execl("/bin/true", "true", nullptr) == 0; },
      [] { return ::fork() >= 0; },
      [] { return ::vfork() >= 0; },
      [] { return ::kill(::getppid(), 0) == 0; },
      [] { return ::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr) == 0; },
      [] { return ::unshare(CLONE_NEWUSER) == 0; },
      [] { return ::setpriority(PRIO_PROCESS, 0, 19) == 0; },
  };
  for (size_t i = 0; i < acts.size(); ++i) EXPECT_EQ(error_of(acts[i]), EACCES) << "act " << i;
}

TEST_F(Sandbox, has_none_of_the_descriptors_of_the_import) {
  const int secret = ::open((folder_ / "other/secret").c_str(), O_RDONLY);
  ASSERT_GE(secret, 0);
  char byte = 0;
  EXPECT_EQ(error_of([&] { return ::read(secret, &byte, 1) == 1; }), EBADF);
  EXPECT_EQ(::read(secret, &byte, 1), 1);
  ::close(secret);
}

TEST_F(Sandbox, may_start_threads) {
  EXPECT_EQ(error_of([] {
              bool done = false;
              std::thread([&] { done = true; }).join();
              return done;
            }),
            0);
}

/// Its exit status and words, as on a kernel without Landlock.
std::pair<int, std::string> run_without_landlock(const std::vector<std::string>& command) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {-1, "no pipe"};
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    std::array rules{
        sock_filter{BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
        sock_filter{BPF_JMP | BPF_JEQ | BPF_K, 0, 1, SYS_landlock_create_ruleset},
        sock_filter{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | ENOSYS},
        sock_filter{BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
    };
    sock_fprog program{static_cast<unsigned short>(rules.size()), rules.data()};
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(ends[1], stream);
    ::close(ends[0]);
    ::close(ends[1]);
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0)
      ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string said;
  std::array<char, 512> part{};
  for (ssize_t got = 0; (got = ::read(ends[0], part.data(), part.size())) > 0;)
    said.append(part.data(), static_cast<size_t>(got));
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
}

TEST_F(Sandbox, without_landlock_import_says_so_and_names_are_still_checked) {
  const auto import = [&](const std::string& file) {
    return run_without_landlock({SCREE_IMPORT_PROGRAM, file, "-o", folder_ / "a.ground"});
  };
  const auto [honest, words] = import(SCREE_SOURCE_DIR "/tests/data/rasters/south_up.tif");
  EXPECT_EQ(honest, 0) << words;
  EXPECT_TRUE(holds(words, "scree-import: this kernel has no Landlock: ")) << words;
  std::ofstream(folder_ / "own/a.gltf") << gltf_of(R"([{"mesh":0}])", "../other/secret");
  const auto [hostile, refusal] = import(folder_ / "own/a.gltf");
  EXPECT_EQ(hostile, 1);
  EXPECT_TRUE(holds(refusal, "it names the file '")) << refusal;
  const auto [quiet, said] =
      run_program(SCREE_IMPORT_PROGRAM " " SCREE_SOURCE_DIR "/tests/data/rasters/south_up.tif -o " +
                  (folder_ / "b.ground"));
  EXPECT_EQ(quiet, 0);
  EXPECT_FALSE(holds(said, "Landlock")) << said;
}

}  // namespace
}  // namespace scree
