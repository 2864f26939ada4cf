// SPDX-License-Identifier: Apache-2.0
#include "gpio/gpio_error.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <charconv>
#include <cstring>

namespace telehug {

Error chip_error(std::string_view chip, int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return {fmt::format("there is no GPIO chip \"{}\": plug it in, or write into [gpio] chip what gpiodetect shows",
                          chip)};
    case EACCES:
    case EPERM:
      return {fmt::format("the GPIO chip \"{}\" may not be used by this user: add the user to the group gpio", chip)};
    case ENOTTY:
      return {fmt::format("\"{}\" is no GPIO chip: write into [gpio] chip what gpiodetect shows", chip)};
    default:
      return {fmt::format("the GPIO chip \"{}\" can't be opened ({}): look at [gpio] chip in the configuration", chip,
                          std::strerror(error))};
  }
}

Error line_error(std::string_view chip, std::string_view line, int error) {
  switch (error) {
    case ENOENT:
    case EINVAL:
      return {fmt::format("the GPIO chip \"{}\" has no line \"{}\": gpioinfo shows which it has", chip, line)};
    case EBUSY:
      return {fmt::format("another program owns the line \"{}\" of the GPIO chip \"{}\": end it (gpioinfo shows which)",
                          line, chip)};
    case EACCES:
    case EPERM:
      return {
          fmt::format("the line \"{}\" of the GPIO chip \"{}\" may not be used by this user: add the user to the "
                      "group gpio",
                      line, chip)};
    case ENODEV:
      return {
          fmt::format("the line \"{}\" is lost, the GPIO chip \"{}\" is gone: plug it in again and start "
                      "telehug-passive again",
                      line, chip)};
    default:
      return {
          fmt::format("the line \"{}\" of the GPIO chip \"{}\" can't be used ({}): look at [gpio] in the "
                      "configuration",
                      line, chip, std::strerror(error))};
  }
}

std::optional<unsigned> line_number(std::string_view line) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  if (error != std::errc() || end != line.data() + line.size()) return std::nullopt;
  return number;
}

}  // namespace telehug
