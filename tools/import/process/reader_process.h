// A child process that reads a foreign file. Libraries that parse other people's files may crash, hang or
// want all memory; in a child of their own they take nothing with them. The child's end becomes words: a
// refusal, a signal, a limit.
//
// The child is a fork of the import, so it needs no program of its own; it runs `work` and ends. The library
// (GDAL, assimp, OpenVDB) is used there alone. It lives in a sandbox (sandbox.h): no network, no programs,
// and no files but those that it was started for.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <sys/types.h>

#include "tools/import/process/frame_socket.h"
#include "tools/import/process/reader_channel.h"
#include "tools/import/process/sandbox.h"

namespace scree {

struct ReaderLimits {
  /// Beyond the memory of this process. Builds with sanitizers do not bound it.
  uint64_t memory_bytes = limits::reader_memory_bytes_max;
  /// That this process waits for the child, in all.
  std::chrono::milliseconds time = limits::reader_time_max;
};

class ReaderProcess final : public ReaderChannel {
 public:
  /// In the child: reads, and answers through the channel. An error, and an exception, reach the import as
  /// the error of its next get(). It has none of the descriptors that the import has open.
  using Work = std::function<Result<void>(ReaderChannel&)>;

  /// `library` is named where the child ends by a signal.
  static Result<std::unique_ptr<ReaderProcess>> start(const std::string& library, const ReaderLimits& bounds,
                                                      const Work& work, const Readable& readable = {});
  /// Kills the child if it has not ended.
  ~ReaderProcess() override;
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

 protected:
  Result<void> send(std::span<const uint8_t> bytes) override;
  Result<std::vector<uint8_t>> receive() override;

 private:
  ReaderProcess(std::string library, pid_t process, int socket, const ReaderLimits& bounds)
      : library_(std::move(library)),
        process_(process),
        socket_(socket),
        left_(bounds.time),
        bounds_(bounds) {}

  /// The words for an exchange that did not succeed.
  Error fault(FrameSocket::Outcome outcome);
  Error end_in_words();
  Error out_of_time() const;
  void kill_child();

  std::string library_;
  pid_t process_;  ///< 0: it was waited for
  FrameSocket socket_;
  std::chrono::nanoseconds left_;
  ReaderLimits bounds_;
};

}  // namespace scree
