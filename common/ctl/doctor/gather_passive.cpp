// SPDX-License-Identifier: Apache-2.0
//
// Of the passive side: the jacket's port and bootloader, Bluetooth.
#include <fmt/core.h>

#include "config/locator.hpp"
#include "ctl/avrdude.hpp"
#include "ctl/doctor/gather.hpp"
#include "ctl/port_claim.hpp"
#include "wire/bluez_objects.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

void ask_bootloader(DoctorFacts& facts) {
  const bool any = facts.serial_port == "auto";
  if (any && facts.serial_ports.size() != 1) return;  // what is wrong there is told by itself
  const std::string port = any ? facts.serial_ports.front().path : facts.serial_port;
  facts.bootloader = BootloaderKind::none;
  const auto claim = PortClaim::take(port);
  if (!claim) {
    facts.bootloader_text = claim.error().message;
    return;
  }
  const auto found = find_bootloader(port);
  if (!found) {
    facts.bootloader_text = found.error().message;
    return;
  }
  const bool good = is_good_optiboot(found->version);
  facts.bootloader = good ? BootloaderKind::good : BootloaderKind::old;
  facts.bootloader_text = fmt::format("{} {}.{}, at {} baud", good ? "optiboot" : "a bootloader", found->version.major,
                                      found->version.minor, found->baud);
}

std::string bluetooth_trouble(const std::string& text) {
  const auto peer = parse_rfcomm_peer(text);
  if (!peer) return "";  // a fault of the configuration
  const auto objects = ask_bluez();
  return objects ? bluez_trouble(*objects, *peer) : objects.error().message;
}

}  // namespace

void gather_passive(DoctorFacts& facts, const DoctorWishes& wishes, SideFacts& side) {
  const fs::path& root = wishes.root;
  const PassiveConfig config = readable_passive_config(wishes.sources);
  gather_either(facts, side, config.peer, config.web);
  const auto link = parse_jacket_link(config.jacket.link);
  facts.jacket_is_simulated = link && link->kind == JacketLinkKind::simulated;
  facts.wants_bluetooth = link && link->kind == JacketLinkKind::bluetooth;
  if (link && link->kind == JacketLinkKind::serial) facts.serial_port = link->path;
  for (const fs::path& port : entries(root / "dev/serial/by-id"))
    facts.serial_ports.push_back(device_node(root, port, side.account));
  add_named(facts.serial_ports, root, facts.serial_port, side.account);
  if (wishes.ask_bootloader && !facts.serial_port.empty()) ask_bootloader(facts);
  facts.bluetooth_adapters = static_cast<int>(entries(root / "sys/class/bluetooth").size());
  for (const fs::path& one : entries(root / "sys/class/rfkill"))
    if (content_of(one / "type").starts_with("bluetooth") &&
        (content_of(one / "soft").starts_with("1") || content_of(one / "hard").starts_with("1")))
      facts.bluetooth_blocked = true;
  if (facts.wants_bluetooth && facts.bluetooth_adapters > 0) facts.bluez_trouble = bluetooth_trouble(link->path);
}

}  // namespace telehug
