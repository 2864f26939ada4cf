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
  status_.state = LinkState::armed;
  status_.device = file.string();
  status_.motor_count = protocol::motor_count;
  status_.heater_count = protocol::heater_count;
  write("monotonic_ns,command,channel,intensity,duration_ms\n");
}

bool RecordingLink::send(const MotorCommands& commands, Timestamp now) {
  std::string rows;
  if (commands.empty()) rows = fmt::format("{},off,,,\n", to_ns(now));
  for (const MotorCommand& command : commands) {
    rows +=
        fmt::format("{},set,{},{},{:.3f}\n", to_ns(now), command.channel, command.intensity, to_ms(command.duration));
  }
  write(rows);
  return status_.state == LinkState::armed;
}

bool RecordingLink::heat(const HeaterCommands& commands, Timestamp now) {
  std::string rows;
  for (const HeaterCommand& command : commands) {
    rows +=
        fmt::format("{},heat,{},{:.1f},{:.3f}\n", to_ns(now), command.heater, command.celsius, to_ms(command.duration));
  }
  write(rows);
  return status_.state == LinkState::armed;
}

void RecordingLink::stop_all(Timestamp now) {
  write(fmt::format("{},stop,,,\n", to_ns(now)));
}

// A recording with a gap would lie: after the first row that does not fit on the disk there is no jacket any more.
void RecordingLink::write(const std::string& rows) {
  if (status_.state == LinkState::absent) return;
  ++status_.frames_sent;
  const bool whole = std::fwrite(rows.data(), 1, rows.size(), file_.get()) == rows.size();
  if (whole && std::fflush(file_.get()) == 0) return;
  status_.state = LinkState::absent;
  status_.problem =
      fmt::format("can't write to {}: {}; make room and start again", status_.device, std::strerror(errno));
}

}  // namespace telehug
