// Collects GL's error messages.
#pragma once

#include <cstdint>
#include <string>

namespace scree::gl {

/// Must outlive the context's use, and stay where it is once attached.
class ErrorLog {
 public:
  /// Receives the debug output, if the context has it; else poll() is all there is.
  void attach();
  void detach();
  /// Also counts the errors that glGetError returns.
  void poll();

  uint64_t count() const { return count_; }
  const std::string& first() const { return first_; }
  void add(std::string message);

 private:
  uint64_t count_ = 0;
  std::string first_;
  bool attached_ = false;
};

}  // namespace scree::gl
