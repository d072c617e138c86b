#include "transport/link_config.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

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

/// Whole bytes.
std::optional<double> bytes_in(std::string_view text, double least, double most) {
  const auto bytes = quantity(text, size_units, least, most);
  return bytes && *bytes == std::floor(*bytes) ? bytes : std::nullopt;
}

bool set(std::optional<uint64_t>& to, std::string_view text) {
  const auto bytes = bytes_in(text, 0.0, limits::link_bytes_max);
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
    {"rate", "a rate a second as 100kbit or 1.5Mbit, 1kbit to 10000Mbit",
     [](LinkWay& way, std::string_view text) {
       return set(way.rate_bytes_per_s, quantity(text, rate_units, limits::link_rate_min_bytes_per_s,
                                                 limits::link_rate_max_bytes_per_s));
     }},
    {"buffer", "a size as 16kB, of whole bytes, 2kB to 1MB",
     [](LinkWay& way, std::string_view text) {
       const auto bytes = bytes_in(text, limits::link_buffer_min_bytes, limits::link_buffer_max_bytes);
       if (bytes) way.buffer_bytes = static_cast<size_t>(*bytes);
       return bytes.has_value();
     }},
    {"cut", "a number of whole bytes as 100000 or 100kB, at most 1000000MB",
     [](LinkWay& way, std::string_view text) { return set(way.cut_bytes, text); }},
    {"half-open", "a number of whole bytes as 50000 or 50kB, at most 1000000MB",
     [](LinkWay& way, std::string_view text) { return set(way.half_open_bytes, text); }},
};

tl::unexpected<Error> fail_with(std::initializer_list<std::string_view> parts) {
  std::string message;
  for (const std::string_view part : parts) message += part;
  return fail(std::move(message));
}

/// A part of the text, as "down.rate=1Mbit".
struct Part {
  std::string_view text;
  std::string_view way;   ///< "up", "down", or empty: both
  std::string_view name;  ///< without the way
  std::string_view value;
};

Result<Part> read_part(std::string_view text) {
  const size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    return fail_with(
        {"a link is described by parts such as delay=50ms, separated by commas, not by '", text, "'"});
  Part part{text, {}, text.substr(0, equals), text.substr(equals + 1)};
  for (const std::string_view way : {"up", "down"})
    if (part.name.starts_with(way) && part.name.substr(way.size()).starts_with('.')) {
      part.way = way;
      part.name.remove_prefix(way.size() + 1);
    }
  return part;
}

/// Nothing may be said twice of the same ways.
Result<std::vector<Part>> read_parts(std::string_view text) {
  std::vector<Part> parts;
  while (true) {
    const size_t comma = text.find(',');
    const auto part = TRY(read_part(text.substr(0, comma)));
    for (const Part& before : parts)
      if (before.way == part.way && before.name == part.name)
        return fail_with({"a link has two values for its ", part.text.substr(0, part.text.find('=')), ": '",
                          before.text, "' and '", part.text, "'"});
    parts.push_back(part);
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

Result<void> read_property(const Part& part, LinkConfig& link) {
  const bool up = part.way != "down", down = part.way != "up";
  for (const Property& property : properties) {
    if (property.name != part.name) continue;
    if ((up && !property.set(link.up, part.value)) || (down && !property.set(link.down, part.value)))
      return fail_with({"a link's ", part.name, " is ", property.form, ", not '", part.value, "'"});
    return {};
  }
  std::string known;
  for (const Property& property : properties) known.append(property.name).append(", ");
  return fail_with(
      {"a link has no '", part.name, "': it has ", known, "seed, as in delay=50ms,down.rate=1Mbit"});
}

Result<void> read_seed(const Part& part, LinkConfig& link) {
  if (!part.way.empty())
    return fail_with(
        {"a link has one seed for both ways: write seed=", part.value, ", not '", part.text, "'"});
  const char* const end = part.value.data() + part.value.size();
  const auto [read, error] = std::from_chars(part.value.data(), end, link.random_seed);
  if (error == std::errc() && read == end) return {};
  return fail_with({"a link's seed is a whole number, 0 to 18446744073709551615, not '", part.value, "'"});
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
  if (text.empty()) return link;
  const auto parts = TRY(read_parts(text));
  for (const bool of_one_way : {false, true})  // it overrides the value for both, whichever comes first
    for (const Part& part : parts) {
      if (part.way.empty() == of_one_way) continue;
      const Result<void> read = part.name == "seed" ? read_seed(part, link) : read_property(part, link);
      TRY(read);
    }
  return link;
}

}  // namespace scree
