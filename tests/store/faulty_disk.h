// A disk for SQLite that fills up, fails for a while, dies at a write, and forgets what was not synced: a VFS
// over the usual one.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sqlite3.h>
#include <string>
#include <thread>
#include <vector>

namespace scree {

/// While it lives, all of SQLite's files of this process lie on it. One at a time; one thread at a time.
class FaultyDisk {
 public:
  FaultyDisk() : real_(sqlite3_vfs_find(nullptr)) {
    current() = this;
    vfs_ = *real_;
    vfs_.zName = "faulty";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.xOpen = open;
    vfs_.xDelete = remove;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~FaultyDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real_, 1);
    current() = nullptr;
  }
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;

  std::atomic<bool> full = false;       ///< nothing more fits
  std::atomic<bool> broken = false;     ///< writes and syncs fail
  std::atomic<bool> read_only = false;  ///< nothing may be written
  std::atomic<bool> hangs = false;      ///< writes do not come back as long as it is so
  uint64_t dies_after = 0;              ///< writes until nothing works any more; 0: never
  uint64_t writes = 0;
  bool dead() const { return dies_after != 0 && writes > dies_after; }

  /// What was not synced is gone; then the disk works again. No file may be open.
  void crash() {
    for (auto& [path, undo] : unsynced_)
      for (; !undo.empty(); undo.pop_back()) undo.back().apply(path);
    dies_after = 0;
    full = broken = read_only = false;
  }

 private:
  /// The bytes that a write replaced, and the file's size before.
  struct Undo {
    int64_t at;
    std::vector<char> bytes;
    int64_t size;

    void apply(const std::string& path) const {
      std::error_code gone;
      if (!std::filesystem::exists(path, gone)) return;
      {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(at);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      }
      std::filesystem::resize_file(path, static_cast<uintmax_t>(size), gone);
    }
  };
  struct File {
    sqlite3_file base;
    const char* path;  ///< null: a temporary one
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  static FaultyDisk*& current() {
    static FaultyDisk* disk = nullptr;
    return disk;
  }
  static File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    of(file).base.pMethods = nullptr;
    of(file).path = name;
    const int code = current()->real_->xOpen(current()->real_, name, of(file).real(), flags, out_flags);
    if (code == SQLITE_OK) of(file).base.pMethods = &methods();
    return code;
  }
  static int remove(sqlite3_vfs*, const char* name, int sync) {
    if (current()->dead()) return SQLITE_IOERR_DELETE;
    current()->unsynced_.erase(name);
    return current()->real_->xDelete(current()->real_, name, sync);
  }
  static int write(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 at) {
    FaultyDisk& disk = *current();
    while (disk.hangs) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++disk.writes;
    if (disk.dead()) return SQLITE_IOERR_WRITE;
    if (disk.full) return SQLITE_FULL;
    if (disk.broken) return SQLITE_IOERR_WRITE;
    if (disk.read_only) return SQLITE_READONLY;
    disk.remember(of(file), at, count);
    return of(file).real()->pMethods->xWrite(of(file).real(), bytes, count, at);
  }
  static int truncate(sqlite3_file* file, sqlite3_int64 size) {
    FaultyDisk& disk = *current();
    if (disk.dead()) return SQLITE_IOERR_TRUNCATE;
    sqlite3_int64 now = 0;
    of(file).real()->pMethods->xFileSize(of(file).real(), &now);
    if (now > size) disk.remember(of(file), size, static_cast<int>(now - size));
    return of(file).real()->pMethods->xTruncate(of(file).real(), size);
  }
  static int sync(sqlite3_file* file, int) {
    if (current()->dead() || current()->broken) return SQLITE_IOERR_FSYNC;
    if (of(file).path != nullptr) current()->unsynced_.erase(of(file).path);
    return SQLITE_OK;
  }
  void remember(File& file, sqlite3_int64 at, int count) {
    if (file.path == nullptr) return;
    sqlite3_int64 size = 0;
    file.real()->pMethods->xFileSize(file.real(), &size);
    const int64_t old = std::max<int64_t>(0, std::min<int64_t>(count, size - at));
    std::vector<char> bytes(static_cast<size_t>(old));
    if (old > 0) file.real()->pMethods->xRead(file.real(), bytes.data(), static_cast<int>(old), at);
    unsynced_[file.path].push_back({at, std::move(bytes), size});
  }

  /// Everything else is the real file's.
  template <auto member, typename... Args>
  static auto pass(sqlite3_file* file, Args... args) {
    return (of(file).real()->pMethods->*member)(of(file).real(), args...);
  }
  static const sqlite3_io_methods& methods() {
    using M = sqlite3_io_methods;
    static const sqlite3_io_methods table = {2,
                                             pass<&M::xClose>,
                                             pass<&M::xRead, void*, int, sqlite3_int64>,
                                             write,
                                             truncate,
                                             sync,
                                             pass<&M::xFileSize, sqlite3_int64*>,
                                             pass<&M::xLock, int>,
                                             pass<&M::xUnlock, int>,
                                             pass<&M::xCheckReservedLock, int*>,
                                             pass<&M::xFileControl, int, void*>,
                                             pass<&M::xSectorSize>,
                                             pass<&M::xDeviceCharacteristics>,
                                             pass<&M::xShmMap, int, int, int, void volatile**>,
                                             pass<&M::xShmLock, int, int, int>,
                                             pass<&M::xShmBarrier>,
                                             pass<&M::xShmUnmap, int>,
                                             nullptr,
                                             nullptr};
    return table;
  }

  sqlite3_vfs* real_;
  sqlite3_vfs vfs_{};
  std::map<std::string, std::vector<Undo>> unsynced_;
};

}  // namespace scree
