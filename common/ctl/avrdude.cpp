// SPDX-License-Identifier: Apache-2.0
#include "ctl/avrdude.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "ctl/run_program.hpp"

namespace telehug {
namespace {

constexpr const char* serial_bootloader = "arduino";
// A slow programmer needs two minutes for a full flash; nothing takes longer.
constexpr Duration longest_write = 180s;
// Asking takes a second, or six if there is no answer.
constexpr Duration longest_question = 20s;

// What avrdude printed if it succeeded.
Result<std::string> run_avrdude(const AvrdudeWay& way, const std::vector<std::string>& what, Duration longest) {
  std::vector<std::string> command = avrdude_command(way);
  command.insert(command.end(), what.begin(), what.end());
  auto run =
      run_program(command, longest, "avrdude, which writes the firmware, is not there: `sudo apt install avrdude`");
  if (!run) return run.error();
  if (run->timed_out) {
    return Error{fmt::format("avrdude did not end within {} s: unplug the board, plug it in and try again",
                             std::chrono::duration_cast<std::chrono::seconds>(longest).count())};
  }
  if (run->code != 0) {
    const AvrdudeFailure failure = failure_in(run->output);
    return Error{fmt::format("{}\n  {}", failure.line, failure.advice)};
  }
  return std::move(run->output);
}

}  // namespace

std::vector<std::string> avrdude_command(const AvrdudeWay& way) {
  std::vector<std::string> command{"avrdude", "-c", way.programmer, "-p", "m328p"};
  if (!way.port.empty()) command.insert(command.end(), {"-P", way.port});
  if (way.baud != 0) command.insert(command.end(), {"-b", std::to_string(way.baud)});
  return command;
}

// 115200 is the speed of optiboot on an Uno, 57600 that of the Duemilanove's and the old Nano's bootloader (boards.txt
// of the Arduino core). The second round is for a first byte that was lost after the reset.
Result<FoundBootloader> find_bootloader(const std::string& port) {
  Result<std::string> output = Error{};
  for (const int baud : {115200, 57600, 115200, 57600}) {
    output = run_avrdude({serial_bootloader, port, baud}, {"-v", "-x", "attempts=1"}, longest_question);
    if (output) {
      if (const auto version = bootloader_in(*output)) return FoundBootloader{*version, baud};
      return Error{"avrdude does not tell the bootloader's version: telehug needs avrdude 7.1 as in Debian 12"};
    }
    // Other failures would only come again.
    if (output.error().message.find("not in sync") == std::string::npos) break;
  }
  return output.error();
}

Result<Fuses> read_fuses(const AvrdudeWay& way) {
  const auto output =
      run_avrdude(way, {"-U", "lfuse:r:-:h", "-U", "hfuse:r:-:h", "-U", "efuse:r:-:h"}, longest_question);
  if (!output) return output.error();
  if (const auto fuses = fuses_in(*output)) return *fuses;
  return Error{"avrdude does not tell the fuses: telehug needs avrdude 7.1 as in Debian 12"};
}

Status write_fuses(const AvrdudeWay& way, const std::vector<std::string>& words) {
  const auto output = run_avrdude(way, words, longest_question);
  if (!output) return output.error();
  return Done{};
}

Result<int> write_flash(const AvrdudeWay& way, const std::filesystem::path& hex_file) {
  std::vector<std::string> what{"-U", "flash:w:" + hex_file.string() + ":i"};
  // A bootloader erases each page before it writes it; avrdude need not ask it to erase the chip.
  if (way.programmer == serial_bootloader) what.insert(what.begin(), "-D");
  const auto output = run_avrdude(way, what, longest_write);
  if (!output) return output.error();
  if (const auto bytes = verified_bytes_in(*output)) return *bytes;
  return Error{"avrdude does not tell whether the flash holds what was written: write it again"};
}

}  // namespace telehug
