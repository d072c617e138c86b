#include "transport/link_config.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <utility>

#include "transport/limits.h"

namespace scree {

namespace {

struct Unit {
  std::string_view name;
  double factor;
};

constexpr Unit time_units[] = {{"ms", 1e-3}, {"s", 1.0}};
constexpr Unit rate_units[] = {{"kbit", 125.0}, {"Mbit", 125000.0}};  // bytes a second
constexpr Unit size_units[] = {{"", 1.0}, {"B", 1.0}, {"kB", 1e3}, {"MB", 1e6}};

/// A number with one of the units; nothing when it is none, or not within the bounds.
template <size_t count>
std::optional<double> quantity(std::string_view text, const Unit (&units)[count], double least, double most) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  const std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
  for (const Unit& known : units)
    if (unit == known.name && number * known.factor >= least && number * known.factor <= most)
      return number * known.factor;
  return std::nullopt;
}

std::optional<double> seconds(std::string_view text) {
  return quantity(text, time_units, 0.0, limits::link_delay_max_s);
}

bool set(std::optional<uint64_t>& to, std::string_view text) {
  const auto bytes = quantity(text, size_units, 0.0, limits::link_bytes_max);
  if (bytes) to = static_cast<uint64_t>(*bytes);
  return bytes.has_value();
}

bool set(double& to, std::optional<double> value) {
  if (value) to = *value;
  return value.has_value();
}

/// What a part of the text says of one direction.
struct Property {
  std::string_view name;
  std::string_view form;
  bool (*set)(LinkWay& way, std::string_view text);
};

constexpr Property properties[] = {
    {"delay", "a time as 50ms or 0.2s, at most 10s",
     [](LinkWay& way, std::string_view text) { return set(way.delay_s, seconds(text)); }},
    {"jitter", "a time as 20ms or 0.1s, at most 10s",
     [](LinkWay& way, std::string_view text) { return set(way.jitter_s, seconds(text)); }},
    {"rate", "a rate a second as 100kbit or 1.5Mbit, at least 1kbit",
     [](LinkWay& way, std::string_view text) {
       return set(way.rate_bytes_per_s,
                  quantity(text, rate_units, limits::link_rate_min_bytes_per_s, limits::link_bytes_max));
     }},
    {"buffer", "a size as 16kB, 2kB to 1MB",
     [](LinkWay& way, std::string_view text) {
       const auto bytes =
           quantity(text, size_units, limits::link_buffer_min_bytes, limits::link_buffer_max_bytes);
       if (bytes) way.buffer_bytes = static_cast<size_t>(*bytes);
       return bytes.has_value();
     }},
    {"cut", "a number of bytes as 100000 or 100kB",
     [](LinkWay& way, std::string_view text) { return set(way.cut_bytes, text); }},
    {"half-open", "a number of bytes as 50000 or 50kB",
     [](LinkWay& way, std::string_view text) { return set(way.half_open_bytes, text); }},
};

tl::unexpected<Error> fail_with(std::initializer_list<std::string_view> parts) {
  std::string message;
  for (const std::string_view part : parts) message += part;
  return fail(std::move(message));
}

Result<void> read_property(std::string_view name, std::string_view value, LinkConfig& link) {
  const bool up = !name.starts_with("down."), down = !name.starts_with("up.");
  if (!up || !down) name.remove_prefix(name.find('.') + 1);
  for (const Property& property : properties) {
    if (property.name != name) continue;
    if ((up && !property.set(link.up, value)) || (down && !property.set(link.down, value)))
      return fail_with({"a link's ", name, " is ", property.form, ", not '", value, "'"});
    return {};
  }
  std::string known;
  for (const Property& property : properties) known.append(property.name).append(", ");
  return fail_with({"a link has no '", name, "': it has ", known, "seed, as in delay=50ms,down.rate=1Mbit"});
}

Result<void> read_seed(std::string_view value, LinkConfig& link) {
  const char* const end = value.data() + value.size();
  const auto [read, error] = std::from_chars(value.data(), end, link.random_seed);
  if (error == std::errc() && read == end) return {};
  return fail_with({"a link's seed is a whole number, not '", value, "'"});
}

}  // namespace

size_t buffer_of(const LinkWay& way) {
  if (way.buffer_bytes != 0) return way.buffer_bytes;
  if (way.rate_bytes_per_s == 0.0) return static_cast<size_t>(limits::link_buffer_max_bytes);
  const double bytes = std::clamp(way.rate_bytes_per_s * limits::link_buffer_s, limits::link_buffer_min_bytes,
                                  limits::link_buffer_max_bytes);
  return static_cast<size_t>(bytes);
}

Result<LinkConfig> read_link(std::string_view text) {
  LinkConfig link;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    const size_t equals = part.find('=');
    if (equals == std::string_view::npos)
      return fail_with(
          {"a link is described by parts as delay=50ms, with commas between, not by '", part, "'"});
    const std::string_view name = part.substr(0, equals), value = part.substr(equals + 1);
    const Result<void> read = name == "seed" ? read_seed(value, link) : read_property(name, value, link);
    if (!read) return tl::unexpected(read.error());
  }
  return link;
}

}  // namespace scree
