#include "server/doors/socket_file.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <thread>
#include <unistd.h>

#include "server/doors/limits.h"

namespace scree {

namespace {

constexpr mode_t owners_mode = S_IRUSR | S_IWUSR;
constexpr mode_t permissions = 07777;

/// A descriptor that is closed with its scope.
class OpenDescriptor {
 public:
  explicit OpenDescriptor(int number) : number_(number) {}
  ~OpenDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  OpenDescriptor(const OpenDescriptor&) = delete;
  OpenDescriptor& operator=(const OpenDescriptor&) = delete;

  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

tl::unexpected<Error> cannot_listen(const std::string& path, const std::string& why) {
  return fail(fmt::format("cannot listen on {}: {} (--admin-socket)", path, why));
}

tl::unexpected<Error> cannot_listen(const std::string& path, int error) {
  return cannot_listen(path, std::strerror(error));
}

/// Waits a little for another server that begins in this folder. A user who may read the folder may hold the
/// lock, so a start does not wait for long.
Result<void> lock_folder(const std::string& path, int folder) {
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(limits::socket_folder_wait_ms);
  while (::flock(folder, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return cannot_listen(path, errno);
    if (std::chrono::steady_clock::now() > until)
      return cannot_listen(path, "another program holds a lock on its folder");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {};
}

/// Whether nobody listens there any more; an error: somebody may.
Result<bool> is_left_behind(const std::string& path, const sockaddr_un& address) {
  const OpenDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (probe.number() < 0) return cannot_listen(path, errno);
  if (::connect(probe.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ||
      errno == EAGAIN)
    return cannot_listen(path, "another server listens there; stop it, or choose another file");
  if (errno == ECONNREFUSED) return true;
  if (errno == ENOENT) return false;
  return cannot_listen(path, fmt::format("a socket is there: {}", std::strerror(errno)));
}

Result<void> make_room(const std::string& path, const sockaddr_un& address) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0)
    return errno == ENOENT ? Result<void>() : Result<void>(cannot_listen(path, errno));
  if (!S_ISSOCK(there.st_mode)) return cannot_listen(path, "a file is there that is no socket");
  const bool left = TRY(is_left_behind(path, address));
  if (left && ::unlink(path.c_str()) != 0 && errno != ENOENT) return cannot_listen(path, errno);
  return {};
}

/// The mode is that of the socket itself when it is bound, and so the file never has another (unix(7) says
/// umask alone; Linux takes both).
Result<int> bind_and_listen(const std::string& path, const sockaddr_un& address) {
  OpenDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.number() < 0 || ::fchmod(socket.number(), owners_mode) != 0) return cannot_listen(path, errno);
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return cannot_listen(path, errno);
  struct stat made {};
  if (::lstat(path.c_str(), &made) != 0 || (made.st_mode & permissions) != owners_mode ||
      ::listen(socket.number(), SOMAXCONN) != 0) {
    ::unlink(path.c_str());
    return cannot_listen(path, "its file cannot be kept from others there; choose another folder");
  }
  return socket.release();
}

}  // namespace

std::optional<SocketFile::Identity> SocketFile::identity_at(const std::string& path) {
  struct stat there {};
  if (::lstat(path.c_str(), &there) != 0) return std::nullopt;
  return Identity{there.st_dev, there.st_ino};
}

Result<int> SocketFile::listen(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    return cannot_listen(
        path, fmt::format("the path of a Unix socket has at most {} bytes", sizeof address.sun_path - 1));
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
  const OpenDescriptor locked(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (locked.number() < 0) return cannot_listen(path, errno);
  TRY(lock_folder(path, locked.number()));
  TRY(make_room(path, address));
  const int descriptor = TRY(bind_and_listen(path, address));
  path_ = std::filesystem::absolute(path, ignored);
  made_ = identity_at(path_);
  return descriptor;
}

void SocketFile::remove() {
  if (made_ && identity_at(path_) == made_) ::unlink(path_.c_str());
  made_.reset();
}

}  // namespace scree
