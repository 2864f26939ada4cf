// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor` on what is broken of the wearer's side: port, firmware, bootloader, Bluetooth.
#include <gmock/gmock.h>

#include <thread>

#include "doubles/child_program.hpp"
#include "doubles/fake_bluez.hpp"
#include "doubles/private_bus.hpp"
#include "doubles/unique_domain.hpp"
#include "integration/cli/shell.hpp"
#include "integration/ctl/broken_pc.hpp"
#include "integration/ctl/simulated_board.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;

class BrokenJacket : public BrokenPc {
 protected:
  void use_bluetooth() const { configure("passive", "[jacket]\nlink = \"rfcomm:00:1A:7D:DA:71:13\"\n"); }

  // Waits until the daemon is as `expected` says.
  [[nodiscard]] bool status_tells(const std::string& expected) const {
    std::string command = "env";
    for (const std::string& variable : variables())
      command += " '" + variable + "'";
    command += " " TELEHUG_BIN "/telehug status --json 2>/dev/null";
    for (int attempt = 0; attempt < 300; ++attempt) {
      if (shell(command).text.find(expected) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
};

TEST_F(BrokenJacket, AJacketThatIsNotPluggedInIsNamed) {
  fs::remove(root() / "dev/ttyACM0");
  expect("passive",
         {"jacket not plugged in", "fail", "jacket port", "/dev/ttyACM0 is not there", "plug the jacket in"});
}

TEST_F(BrokenJacket, ASimulatedJacketIsNamed) {
  configure("passive", "");  // as installed
  expect("passive", {"jacket still simulated", "warn", "jacket", "the jacket is a simulated one",
                     "link of [jacket] in ~/.config/telehug/passive.toml"});
}

TEST_F(BrokenJacket, APortWithoutRightsIsNamed) {
  fs::permissions(root() / "dev/ttyACM0", fs::perms::none);
  as_nobody = true;
  expect("passive",
         {"jacket's port without rights", "fail", "jacket port", "may not be used", "sudo usermod -aG dialout "});
}

TEST_F(BrokenJacket, AnOlderFirmwareIsNamed) {
  const UniqueDomain domain;
  const std::string port = (runtime() / "jacket").string();
  ChildProgram jacket({TELEHUG_BIN "/telehug-jacket-sim", "--die-with-parent", "--link", port, "--firmware",
                       TELEHUG_FIRMWARE_FOLDER "/telehug-jacket-older.elf"});
  ASSERT_EQ(jacket.read_line(), "ready " + port);
  fs::create_symlink(port, root() / "dev/jacket");
  configure("passive", "[jacket]\nlink = \"serial:" + port +
                           "\"\nprofile = \"" TELEHUG_SOURCE
                           "/deploy/jackets/duemilanove-16.toml\"\n[peer]\nloopback_only = true\ndomain = " +
                           std::to_string(domain.id()) + "\n[web]\nenabled = false\n");
  write("root" + port, "");
  const ChildProgram daemon({TELEHUG_BIN "/telehug-passive", "run"}, variables());
  ASSERT_TRUE(status_tells("\"armed\""));
  expect("passive", {"older firmware", "warn", "firmware", "version 2; 3 is the newest", "telehug jacket flash"});
}

TEST_F(BrokenJacket, ABootloaderThatLeavesTheWatchdogRunningIsNamed) {
  const SimulatedBoard board(
      {.bootloader = "/usr/share/arduino/hardware/arduino/avr/bootloaders/atmega/ATmegaBOOT_168_atmega328.hex"});
  configure("passive", "[jacket]\nlink = \"serial:" + board.port() + "\"\n");
  write("root" + board.port(), "");
  options = "--bootloader";
  expect("passive", {"bootloader too old", "fail", "bootloader", "leaves the watchdog running", "--programmer usbasp"});
}

TEST_F(BrokenJacket, AMissingBluetoothAdapterIsNamed) {
  use_bluetooth();
  fs::remove_all(root() / "sys/class/bluetooth");
  expect("passive", {"no Bluetooth adapter", "fail", "bluetooth", "no Bluetooth adapter", "plug one in"});
}

TEST_F(BrokenJacket, MissingBlueZIsNamed) {
  use_bluetooth();
  const PrivateBus bus;
  set("DBUS_SYSTEM_BUS_ADDRESS=" + bus.address());
  expect("passive", {"no BlueZ", "fail", "bluetooth", "BlueZ does not answer", "package bluez"});
}

TEST_F(BrokenJacket, BluetoothThatIsOffIsNamed) {
  use_bluetooth();
  const PrivateBus bus;
  const FakeBluez bluez(bus.address(), {.powered = false});
  set("DBUS_SYSTEM_BUS_ADDRESS=" + bus.address());
  expect("passive", {"Bluetooth switched off", "fail", "bluetooth", "switched off", "bluetoothctl power on"});
}

TEST_F(BrokenJacket, AJacketThatIsNotPairedIsNamedAndAPairedOneIsNot) {
  use_bluetooth();
  const PrivateBus bus;
  FakeBluez bluez(bus.address(), {.paired = false});
  set("DBUS_SYSTEM_BUS_ADDRESS=" + bus.address());
  expect("passive", {"jacket not paired", "fail", "bluetooth", "00:1A:7D:DA:71:13 is not paired", "`pair 00:1A"});
  bluez.rewrite([](FakeBluez::Script& script) { script.paired = true; });
  expect("passive", {"", "ok", "bluetooth", "the jacket is paired", ""});
}

}  // namespace
}  // namespace telehug
