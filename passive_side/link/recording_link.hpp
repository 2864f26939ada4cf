// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "link/jacket_link.hpp"

namespace telehug {

// No jacket at all: writes what it would be told to a CSV file, `monotonic_ns,command,channel,intensity,duration_ms`:
// one row `set` for each motor of a state, `off` for a state without any, `stop` for a stop, and `heat` for each
// heater, with its number and degrees Celsius in the columns of channel and intensity.
class RecordingLink final : public JacketLink {
 public:
  // Throws std::runtime_error if the file can't be written.
  explicit RecordingLink(const std::filesystem::path& file);

  void poll(Timestamp) override {}
  bool send(const MotorCommands& commands, Timestamp now) override;
  bool heat(const HeaterCommands& commands, Timestamp now) override;
  void stop_all(Timestamp now) override;
  [[nodiscard]] const LinkStatus& status() const override { return status_; }

 private:
  void write(const std::string& rows);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  LinkStatus status_;
};

}  // namespace telehug
