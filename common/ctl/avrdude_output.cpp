// SPDX-License-Identifier: Apache-2.0
#include "ctl/avrdude_output.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    line.remove_suffix(line.size() - std::min(line.find_last_not_of(" \t") + 1, line.size()));
    if (!line.empty()) lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

// A number at the beginning of the text, which loses it.
std::optional<int> take_number(std::string_view& text, int base = 10) {
  int number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (problem != std::errc{} || number < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

// What follows these words in their line.
std::optional<std::string_view> after(std::string_view output, std::string_view words) {
  for (std::string_view line : lines_of(output)) {
    if (!line.starts_with(words)) continue;
    line.remove_prefix(words.size());
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    return line;
  }
  return std::nullopt;
}

// "0x" and one or two digits, and nothing else.
std::optional<std::uint8_t> fuse_in(std::string_view line) {
  if (!line.starts_with("0x") || line.size() > 4) return std::nullopt;
  line.remove_prefix(2);
  const auto value = take_number(line, 16);
  if (!value || !line.empty()) return std::nullopt;
  return static_cast<std::uint8_t>(*value);
}

struct Symptom {
  std::string_view words;
  std::string_view advice;
};

// The first that is met counts, so the cause stands above its consequence.
constexpr std::array symptoms{
    Symptom{"expected signature for", "telehug's firmware runs on an ATmega328P and no other chip"},
    Symptom{"verification mismatch",
            "write it again; if that does not help, the chip is worn out. Don't wear the jacket before it is written"},
    Symptom{"verification error",
            "write it again; if that does not help, the chip is worn out. Don't wear the jacket before it is written"},
    Symptom{"Permission denied", "`sudo adduser $USER dialout`, then log in again"},
    Symptom{"cannot open port", "plug the board in, or name its port by --port"},
    Symptom{"cannot find programmer id", "`avrdude -c '?'` lists the programmers"},
    Symptom{"cannot find USB device",
            "plug the programmer in; if it is, this user may not use it: run as root, or add a udev rule"},
    Symptom{"initialization failed", "check the programmer's cable to the board, and that the board has power"},
    Symptom{
        "not in sync",
        "nothing answers as a bootloader does: check the cable and the port, take a Bluetooth module off D0 and D1, "
        "press the board's reset button and try again, or use --programmer"},
    Symptom{"unable to open programmer",
            "plug the programmer in; if it is, this user may not use it: run as root, or add a udev rule"},
    Symptom{"invalid record", "the file is damaged: install telehug again, or build the firmware again"},
    Symptom{"checksum mismatch", "the file is damaged: install telehug again, or build the firmware again"},
};

// avrdude notes this of a port without a reset line, and goes on.
bool is_harmless(std::string_view line) {
  return line.find("ioctl(\"TIOCMGET\")") != std::string_view::npos;
}

}  // namespace

std::optional<BootloaderVersion> bootloader_in(std::string_view output) {
  auto hardware_text = after(output, "Hardware Version:");
  auto firmware_text = after(output, "Firmware Version:");
  if (!hardware_text || !firmware_text) return std::nullopt;
  const auto hardware = take_number(*hardware_text);
  const auto major = take_number(*firmware_text);
  if (!hardware || !major || !firmware_text->starts_with('.')) return std::nullopt;
  firmware_text->remove_prefix(1);
  const auto minor = take_number(*firmware_text);
  if (!minor) return std::nullopt;
  return BootloaderVersion{*hardware, *major, *minor};
}

// optiboot answers 3 as hardware version, and its own version since 4.4 (optiboot.c, STK_GET_PARAMETER; 3.3 before
// that); github.com/Optiboot/optiboot/issues/207. ATmegaBOOT answers 2 and 1.16 (ATmegaBOOT_168.c, HW_VER, SW_MAJOR,
// SW_MINOR), whether it was built with WATCHDOG_MODS or, for the Duemilanove and the old Nano, without
// (github.com/arduino/Arduino/issues/4492).
bool is_good_optiboot(const BootloaderVersion& bootloader) {
  return bootloader.hardware == 3 && bootloader.major >= 4;
}

std::optional<Fuses> fuses_in(std::string_view output) {
  std::vector<std::uint8_t> values;
  for (const std::string_view line : lines_of(output))
    if (const auto value = fuse_in(line)) values.push_back(*value);
  if (values.size() != 3) return std::nullopt;
  return Fuses{values[0], values[1], values[2]};
}

std::optional<int> verified_bytes_in(std::string_view output) {
  for (std::string_view line : lines_of(output)) {
    if (!line.ends_with(" bytes of flash verified")) continue;
    line.remove_prefix(std::min(line.find_first_of("0123456789"), line.size()));
    return take_number(line);
  }
  return std::nullopt;
}

AvrdudeFailure failure_in(std::string_view output) {
  std::vector<std::string_view> lines = lines_of(output);
  std::erase_if(lines, is_harmless);
  for (const Symptom& symptom : symptoms)
    for (const std::string_view line : lines)
      if (line.find(symptom.words) != std::string_view::npos) return {plain_text(line), std::string(symptom.advice)};
  const auto error =
      std::ranges::find_if(lines, [](std::string_view line) { return line.find("error") != std::string_view::npos; });
  if (error != lines.end()) return {plain_text(*error), "avrdude's manual may tell more"};
  if (!lines.empty()) return {plain_text(lines.back()), "avrdude's manual may tell more"};
  return {"avrdude says nothing", "run it by hand with -v"};
}

}  // namespace telehug
