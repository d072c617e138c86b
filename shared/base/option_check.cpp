#include "shared/base/option_check.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "shared/base/regular_file.h"

namespace scree {

namespace {

/// The shortest text of a bound, which may have been a float.
std::string text_of(double number) {
  char text[32];
  const auto as_float = static_cast<float>(number);
  if (number == std::floor(number))
    return {text, std::to_chars(text, text + sizeof text, static_cast<long long>(number)).ptr};
  if (static_cast<double>(as_float) == number)
    return {text, std::to_chars(text, text + sizeof text, as_float).ptr};
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// Bounds of floats are compared as floats: 0.15 is not below 0.15F.
template <typename Number>
bool within(double number, double least, double most) {
  return static_cast<Number>(number) >= static_cast<Number>(least) &&
         static_cast<Number>(number) <= static_cast<Number>(most);
}

}  // namespace

std::string NumberWithin::says() const {
  return (whole ? "a whole number, " : "a number, ") + text_of(least) + " to " + text_of(most);
}

std::string NumberWithin::operator()(const std::string& text) const {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, number);
  const bool good = error == std::errc() && read == end && std::isfinite(number) &&
                    (whole ? number == std::floor(number) && within<double>(number, least, most)
                           : within<float>(number, least, most));
  return good ? std::string() : "'" + text + "' is not " + says();
}

std::string check_finite(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && !std::isfinite(number) ? "'" + text + "' is not a finite number"
                                                       : std::string();
}

NumberWithin whole_within(double least, double most) {
  return {least, most, true};
}

Result<void> can_be_written(const std::string& path) {
  std::error_code ignored;
  const bool was_there = std::filesystem::exists(path, ignored);
  if (std::filesystem::is_fifo(path, ignored) || std::filesystem::is_socket(path, ignored))
    return fail(path + " cannot be written: it is a pipe or a socket, not a file");
  errno = 0;
  if (!std::ofstream(path, std::ios::app))
    return fail(path + " cannot be written: " + std::strerror(errno != 0 ? errno : EIO));
  if (!was_there) std::filesystem::remove(path, ignored);
  return {};
}

std::string check_replaceable(const std::string& path) {
  const Result<void> replaceable = check_no_device(path);
  return replaceable ? std::string() : replaceable.error().message;
}

std::string check_writable(const std::string& path) {
  const Result<void> writable = can_be_written(path);
  return writable ? std::string() : writable.error().message;
}

}  // namespace scree
