// SPDX-License-Identifier: Apache-2.0
#include "link/make_link.hpp"

#include <exception>
#include <string>

#include "link/recording_link.hpp"

namespace telehug {
namespace {

constexpr std::string_view serial_prefix = "serial:";
constexpr std::string_view record_prefix = "record:";

}  // namespace

Result<std::unique_ptr<JacketLink>> make_link(std::string_view spec, const LinkOptions& options) {
  try {
    if (spec == "simulated") return std::unique_ptr<JacketLink>(std::make_unique<SimulatedLink>(options.simulator));
    if (spec.starts_with(serial_prefix) && spec.size() > serial_prefix.size()) {
      return std::unique_ptr<JacketLink>(
          std::make_unique<SerialLink>(std::string(spec.substr(serial_prefix.size())), options.baud));
    }
    if (spec.starts_with(record_prefix) && spec.size() > record_prefix.size()) {
      return std::unique_ptr<JacketLink>(std::make_unique<RecordingLink>(spec.substr(record_prefix.size())));
    }
  } catch (const std::exception& problem) {
    return Error{problem.what()};
  }
  return Error{"\"" + std::string(spec) +
               "\" names no jacket: write serial:PATH, simulated or record:FILE (for example serial:/dev/ttyUSB0)"};
}

}  // namespace telehug
