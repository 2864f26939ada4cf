// SPDX-License-Identifier: Apache-2.0
//
// Of the passive side: the jacket's port, its bootloader, Bluetooth, and kernels that break that.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "ctl/doctor/checks.hpp"
#include "ctl/doctor/device_finding.hpp"

namespace telehug {
namespace {

// As /proc/version tells them. passive_side/wire/README.md: RFCOMM is dead after the first connection that fails.
constexpr std::array<std::string_view, 1> kernels_without_rfcomm{"Debian 6.1.192-"};

Finding two_part(const std::string& check, const std::string& trouble) {
  const std::size_t cut = trouble.find("; ");
  return {check, Level::fail, trouble.substr(0, cut), cut == std::string::npos ? "" : trouble.substr(cut + 2)};
}

}  // namespace

Findings check_jacket(const DoctorFacts& facts) {
  const SideFacts* side = find_side(facts, Side::passive);
  if (side == nullptr || !facts.jacket_is_simulated) return {};
  return {{"jacket", Level::warn,
           "the jacket is a simulated one: nobody feels anything, and the other side is told that touches are felt",
           fmt::format("name the real one: set link of [jacket] in {}/passive.toml, as \"serial:auto\"; then start "
                       "telehug-passive again",
                       side->account.service ? "/etc/telehug" : "~/.config/telehug")}};
}

Findings check_serial(const DoctorFacts& facts) {
  const SideFacts* side = find_side(facts, Side::passive);
  if (side == nullptr || facts.serial_port.empty()) return {};
  const bool any = facts.serial_port == "auto";
  if (any && facts.serial_ports.size() > 1)
    return {{"jacket port", Level::fail, "there are several serial ports, and jacket.link is serial:auto",
             "name the jacket's in jacket.link, as in /dev/serial/by-id"}};
  return {device_finding("jacket port", "jacket", any ? "" : facts.serial_port, facts.serial_ports, "dialout", *side,
                         talks(facts, Side::passive))};
}

Findings check_bootloader(const DoctorFacts& facts) {
  if (find_side(facts, Side::passive) == nullptr || facts.serial_port.empty()) return {};
  switch (facts.bootloader) {
    case BootloaderKind::not_asked:
      return {
          {"bootloader",
           Level::ok,
           "not asked, since that resets the jacket: take it off, stop telehug-passive, telehug doctor --bootloader",
           {}}};
    case BootloaderKind::none:
      return {{"bootloader", Level::warn, "none was found: " + facts.bootloader_text,
               "the jacket works without; new firmware needs a programmer: telehug jacket flash --programmer usbasp"}};
    case BootloaderKind::old:
      return {{"bootloader", Level::fail,
               facts.bootloader_text + " leaves the watchdog running: after its first watchdog reset the jacket resets "
                                       "for ever",
               "telehug jacket flash --programmer usbasp, or burn optiboot with a programmer first"}};
    case BootloaderKind::good:
      break;
  }
  return {{"bootloader", Level::ok, facts.bootloader_text, {}}};
}

Findings check_bluetooth(const DoctorFacts& facts) {
  if (find_side(facts, Side::passive) == nullptr || !facts.wants_bluetooth) return {};
  if (facts.bluetooth_adapters == 0)
    return {
        {"bluetooth", Level::fail, "this PC has no Bluetooth adapter", "plug one in, or use the jacket's USB cable"}};
  if (facts.bluetooth_blocked)
    return {{"bluetooth", Level::fail, "Bluetooth is switched off", "rfkill unblock bluetooth"}};
  if (!facts.bluez_trouble.empty()) return {two_part("bluetooth", facts.bluez_trouble)};
  return {{"bluetooth", Level::ok, "an adapter is on, and the jacket is paired", {}}};
}

Findings check_kernel(const DoctorFacts& facts) {
  const bool bad = std::ranges::any_of(kernels_without_rfcomm, [&](std::string_view version) {
    return facts.kernel.find(version) != std::string::npos;
  });
  if (!bad) return {{"kernel", Level::ok, "none that is known to be bad for telehug", {}}};
  return {{"kernel", facts.wants_bluetooth ? Level::fail : Level::warn,
           "this kernel (6.1.192) crashes its Bluetooth when the jacket is off",
           "boot linux-image-6.1.0-50-amd64, or 6.12 from the backports; a jacket by USB is not concerned"}};
}

}  // namespace telehug
