// SPDX-License-Identifier: Apache-2.0
#include "link/recording_link.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "link/protocol.hpp"

namespace telehug {

RecordingLink::RecordingLink(const std::filesystem::path& file) : file_(std::fopen(file.c_str(), "we"), &std::fclose) {
  if (!file_) {
    throw std::runtime_error(fmt::format("can't write the jacket's commands to {}: {}; choose another file",
                                         file.string(), std::strerror(errno)));
  }
  fmt::print(file_.get(), "monotonic_ns,command,channel,intensity,duration_ms\n");
  status_.state = LinkState::armed;
  status_.device = file.string();
  status_.motor_count = protocol::motor_count;
}

bool RecordingLink::send(const MotorCommands& commands, Timestamp now) {
  ++status_.frames_sent;
  if (commands.empty()) fmt::print(file_.get(), "{},off,,,\n", to_ns(now));
  for (const MotorCommand& command : commands) {
    fmt::print(file_.get(), "{},set,{},{},{:.3f}\n", to_ns(now), command.channel, command.intensity,
               to_ms(command.duration));
  }
  return std::fflush(file_.get()) == 0;
}

void RecordingLink::stop_all(Timestamp now) {
  ++status_.frames_sent;
  fmt::print(file_.get(), "{},stop,,,\n", to_ns(now));
  std::fflush(file_.get());
}

}  // namespace telehug
