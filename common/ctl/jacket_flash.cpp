// SPDX-License-Identifier: Apache-2.0
//
// `telehug jacket flash`: the firmware into the jacket's microcontroller.
#include "ctl/jacket_flash.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "common/data_folder.hpp"
#include "config/load.hpp"
#include "config/locator.hpp"
#include "ctl/avrdude.hpp"
#include "ctl/port_claim.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string port;
  std::string programmer;
  std::string board = "motors16";
  std::string firmware;
  bool set_fuses = false;
  bool yes = false;
};

ExitCode fail(ExitCode code, const std::string& what) {
  fmt::print(stderr, "telehug: {}\n", what);
  return code;
}

void say(const std::string& what) {
  fmt::print("{}\n", what);
  (void)std::fflush(stdout);
}

std::string file_of_board(const std::string& board) {
  return board == "motors16" ? "telehug-jacket.hex" : fmt::format("telehug-jacket-{}.hex", board);
}

fs::path firmware_of_board(const std::string& board) {
  return data_folder() / "firmware" / file_of_board(board);
}

Status check_firmware(const fs::path& file) {
  std::ifstream stream(file);
  char first = 0;
  if (!stream.get(first))
    return Error{
        fmt::format("the firmware {} can't be read: is it there? build it, or install telehug again", file.string())};
  if (first != ':')
    return Error{fmt::format("{} is no firmware: it has to be a file in Intel's hex format", file.string())};
  return Done{};
}

// The port of the passive side's configuration; empty, and the failure told, if there is none.
std::string configured_port(ExitCode& failure) {
  const auto config = load_passive_config(usual_config_sources());
  if (!config) {
    failure = fail(ExitCode::config, config.error().message);
    return {};
  }
  const auto link = parse_jacket_link(config->jacket.link);
  if (link && link->kind == JacketLinkKind::serial) return link->path;
  failure = fail(ExitCode::usage, "where is the jacket? name its port, as in --port /dev/ttyUSB0, or a --programmer");
  return {};
}

bool confirm(const Options& options) {
  say("While it is written, and until it starts, the pins float: take the jacket off, and unplug the supply of its "
      "motors\n"
      "and heaters.");
  if (options.yes) return true;
  fmt::print("Go on? [y/N] ");
  (void)std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

std::string name_of(const BootloaderVersion& bootloader) {
  const char* maker = is_good_optiboot(bootloader) ? "optiboot" : "a bootloader";
  return fmt::format("{} {}.{}", maker, bootloader.major, bootloader.minor);
}

ExitCode written(const AvrdudeWay& way, const fs::path& firmware) {
  const auto bytes = write_flash(way, firmware);
  if (!bytes) return fail(ExitCode::device, "the firmware was not written: " + bytes.error().message);
  say(fmt::format("{} bytes are written and compared", *bytes));
  return ExitCode::ok;
}

// The bootloader has to switch off the watchdog, by which the firmware ends a hanging main loop: it stays on after the
// reset that it made (firmware/README.md, "Bootloader").
ExitCode flash_through_bootloader(const std::string& port, const fs::path& firmware) {
  say(fmt::format("asking the bootloader on {}", port));
  const auto found = find_bootloader(port);
  if (!found) return fail(ExitCode::device, "no bootloader was found, nothing was written: " + found.error().message);
  say(fmt::format("{} answers at {} baud", name_of(found->version), found->baud));
  if (!is_good_optiboot(found->version)) {
    return fail(
        ExitCode::device,
        fmt::format("nothing was written: this bootloader (hardware {}, firmware {}.{}) is not optiboot 4 or newer. "
                    "Old ones leave the watchdog running, so the jacket would reset for ever after its first "
                    "watchdog reset.\n  Write without a bootloader, by a programmer on the board's ISP pins "
                    "(`telehug jacket flash --programmer usbasp`), or burn optiboot with that first",
                    found->version.hardware, found->version.major, found->version.minor));
  }
  const ExitCode result = written({"arduino", port, found->baud}, firmware);
  if (result == ExitCode::ok) {
    say("a bootloader can't tell the fuses: whether the brown-out detector is at 4.3 V only a programmer can check");
  }
  return result;
}

ExitCode mend_fuses(const AvrdudeWay& way, const Fuses& fuses, bool set_fuses) {
  const auto faults = faults_of(fuses);
  if (faults.empty()) return ExitCode::ok;
  const auto words = mending_of(fuses);
  const std::string list = fmt::format("the fuses are wrong:\n  {}", fmt::join(faults, "\n  "));
  if (!set_fuses) {
    return fail(
        ExitCode::device,
        fmt::format("nothing was written: {}\nThis mends them (so does --set-fuses, before it writes):\n  {} {}", list,
                    fmt::join(avrdude_command(way), " "), fmt::join(words, " ")));
  }
  say(fmt::format("{}\nsetting them: {}", list, fmt::join(words, " ")));
  if (const auto done = write_fuses(way, words); !done)
    return fail(ExitCode::device, "the fuses were not set: " + done.error().message);
  return ExitCode::ok;
}

ExitCode flash_by_programmer(const AvrdudeWay& way, const fs::path& firmware, bool set_fuses) {
  const auto fuses = read_fuses(way);
  if (!fuses) return fail(ExitCode::device, "the fuses can't be read, nothing was written: " + fuses.error().message);
  say(fmt::format("fuses: low 0x{:02X}, high 0x{:02X}, extended 0x{:02X}", fuses->low, fuses->high, fuses->extended));
  if (const ExitCode result = mend_fuses(way, *fuses, set_fuses); result != ExitCode::ok) return result;
  return written(way, firmware);
}

ExitCode flash(const Options& options) {
  if (options.programmer == "arduino")
    return fail(ExitCode::usage, "arduino is no programmer but a bootloader: name its --port alone");
  const fs::path firmware = options.firmware.empty() ? firmware_of_board(options.board) : fs::path(options.firmware);
  if (const auto checked = check_firmware(firmware); !checked) return fail(ExitCode::device, checked.error().message);

  std::string port = options.port;
  if (port.empty() && options.programmer.empty()) {
    ExitCode failure = ExitCode::ok;
    port = configured_port(failure);
    if (port.empty()) return failure;
  }
  say(fmt::format("{} goes onto the board {} {}", firmware.string(), options.programmer.empty() ? "at" : "by",
                  options.programmer.empty() ? port : options.programmer));
  std::optional<PortClaim> claim;
  if (!port.empty()) {
    auto taken = PortClaim::take(port);
    if (!taken) return fail(ExitCode::device, taken.error().message);
    claim = std::move(taken).value();
  }

  if (!confirm(options)) return fail(ExitCode::refused, "nothing was written: only the answer y, or --yes, goes on");
  if (options.programmer.empty()) return flash_through_bootloader(port, firmware);
  return flash_by_programmer({options.programmer, port, 0}, firmware, options.set_fuses);
}

}  // namespace

void add_jacket_flash(CLI::App& jacket, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* flasher = jacket.add_subcommand("flash", "Write the firmware into the jacket's microcontroller");
  flasher->add_option("--port", options->port, "Serial port of the board, or of the programmer (default: the config's)")
      ->type_name("PATH");
  CLI::Option* programmer =
      flasher->add_option("--programmer", options->programmer, "Write without a bootloader, by this, such as usbasp")
          ->type_name("NAME");
  CLI::Option* board = flasher->add_option("--board", options->board, "What the jacket has (default: motors16)")
                           ->check(CLI::IsMember({"motors16", "motors12_heaters2", "legacy"}));
  flasher->add_option("--firmware", options->firmware, "Write this instead of telehug's own")
      ->type_name("FILE.hex")
      ->excludes(board);
  flasher->add_flag("--set-fuses", options->set_fuses, "Set wrong fuses right before writing")->needs(programmer);
  flasher->add_flag("--yes", options->yes, "Don't ask");
  flasher->callback([options, &result] { result = flash(*options); });
}

}  // namespace telehug
