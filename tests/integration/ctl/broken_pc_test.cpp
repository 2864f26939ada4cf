// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor` on what is broken of a PC: configuration, disk, kernel, network, pairs, daemons.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>

#include "doubles/crafted_pair.hpp"
#include "doubles/unique_domain.hpp"
#include "integration/ctl/broken_pc.hpp"
#include "service/control_server.hpp"

namespace telehug {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;

class BrokenPcByItself : public BrokenPc {
 protected:
  // Those of bin/ go before the system's.
  void use_own_programs() {
    const fs::path bin = root().parent_path() / "bin";
    for (const auto& program : fs::directory_iterator(bin))
      fs::permissions(program, fs::perms::owner_all | fs::perms::others_exec | fs::perms::others_read);
    set("PATH=" + bin.string() + ":" + std::getenv("PATH"));
  }
};

// Bound to this port (0: any) until it ends.
class TakenPort {
 public:
  TakenPort(int type, int port) : fd_(::socket(AF_INET, type | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("the port is taken already");
    if (type == SOCK_STREAM && ::listen(fd_, 1) != 0) throw std::runtime_error("nobody can listen");
    socklen_t length = sizeof address;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
  }
  ~TakenPort() { ::close(fd_); }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  [[nodiscard]] int port() const { return port_; }

 private:
  int fd_;
  int port_ = 0;
};

// In a network of its own, made by these commands.
std::string inside_network(const std::string& commands) {
  const std::string unshare = ::geteuid() == 0 ? "unshare -n" : "unshare -rn";
  return unshare + " sh -c '" + commands + "; exec \"$@\"' sh";
}

TEST_F(BrokenPcByItself, AWrongValueIsNamedByFileAndLine) {
  configure("active", "[body_map]\npicture = \"chat.jpg\"\n[camera]\nfps = 1000\n");
  expect("active", {"a value out of range", "fail", "config", "active.toml:4: camera.fps", "telehug config check"});
}

TEST_F(BrokenPcByItself, AFullDiskIsNamed) {
  const std::string unshare = ::geteuid() == 0 ? "unshare -m" : "unshare -rm";
  const std::string pairs = (state() / "pairs/passive").string();
  before = unshare + " sh -c 'mount -t tmpfs -o size=1m,mode=700 none " + pairs + " && head -c 900k /dev/zero >" +
           pairs + "/filler; exec \"$@\"' sh";
  expect("passive", {"disk full", "fail", "disk", "only 0 MiB are free", "make room"});
}

TEST_F(BrokenPcByItself, AStateFolderOfAnotherUserIsNamedWithItsOwner) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder to somebody else";
  as_nobody = true;
  // After the chown of all to nobody: this one is root's again.
  before = "sh -c 'chown 0:0 " + (state() / "pairs/passive").string() + "; exec \"$@\"' sh";
  expect("passive", {"state folder made by root", "fail", "state folder", "is root's", "sudo chown -R nobody:"});
}

TEST_F(BrokenPcByItself, AKernelThatCrashesItsBluetoothIsNamed) {
  write("root/proc/version", "Linux version 6.1.0-56-amd64 (x) #1 SMP Debian 6.1.192-2 (2026-10-01)");
  expect("passive", {"known-bad kernel", "warn", "kernel", "6.1.192", "linux-image-6.1.0-50"});
}

TEST_F(BrokenPcByItself, APortThatAnotherProgramHasIsNamed) {
  const UniqueDomain domain;
  const TakenPort taken(SOCK_DGRAM, 7400 + 250 * static_cast<int>(domain.id()) + 10);
  configure("passive",
            "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[peer]\ndomain = " + std::to_string(domain.id()) + "\n");
  expect("passive", {"UDP port taken", "warn", "ports", "UDP port " + std::to_string(taken.port()), "ss -ulpn"});
}

TEST_F(BrokenPcByItself, APagePortThatAnotherProgramHasIsNamed) {
  const TakenPort taken(SOCK_STREAM, 0);
  configure("passive",
            "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[web]\nport = " + std::to_string(taken.port()) + "\n");
  expect("passive",
         {"TCP port of the pages taken", "fail", "ports", "TCP port " + std::to_string(taken.port()), "set web.port"});
}

TEST_F(BrokenPcByItself, AFirewallThatKeepsTelehugOutIsNamed) {
  before = inside_network(
      "nft add table inet f; nft \"add chain inet f in { type filter hook input priority 0; policy drop; }\"; "
      "nft add rule inet f in ct state established,related accept; nft add rule inet f in tcp dport 22 accept");
  expect("passive", {"firewall closed", "fail", "firewall", "UDP port 26650", "let UDP ports 26650 to 26679 in"});
}

TEST_F(BrokenPcByItself, APeerThatIsNotThereIsNamed) {
  configure("passive", "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[peer]\naddresses = \"10.9.0.2\"\n");
  before = inside_network(
      "ip link set lo up; ip link add home type veth peer name street; ip address add 10.9.0.1/24 dev home; ip link "
      "set home up; "
      "ip link set street up");
  expect("passive", {"peer gone", "fail", "peer", "10.9.0.2 is not there", "switch the other PC on"});
}

TEST_F(BrokenPcByItself, ANetworkThatIsDownIsNamed) {
  configure("passive", "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[peer]\naddresses = \"10.9.0.2\"\n");
  before = inside_network("true");
  expect("passive", {"no network", "fail", "peer", "no way to 10.9.0.2", "connect this PC to the network"});
}

TEST_F(BrokenPcByItself, APeerOnWhichTelehugDoesNotRunIsNamed) {
  const UniqueDomain domain;
  configure("passive", "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[peer]\naddresses = \"127.0.0.1\"\ndomain = " +
                           std::to_string(domain.id()) + "\n");
  expect("passive",
         {"telehug not running there", "fail", "peer", "telehug does not run on it", "start telehug on the other"});
}

TEST_F(BrokenPcByItself, AnExpiredCertificateIsNamed) {
  CraftedSide side;
  side.certificate = {wall_time() - hours(24 * 400), wall_time() - hours(24 * 3)};
  side.permissions = side.certificate;
  CraftedPair("00112233445566aa").keep(state() / "pairs/passive", Side::passive, side);
  expect("passive", {"certificate expired", "fail", "pairs", "has expired", "telehug pair renew 00112233445566aa"});
}

TEST_F(BrokenPcByItself, AClockThatIsDaysSlowIsNamed) {
  // To the certificates it makes no difference which of the two clocks is wrong.
  CraftedSide side;
  side.certificate = {wall_time() + hours(24 * 3), wall_time() + hours(24 * 30)};
  side.permissions = side.certificate;
  CraftedPair("00112233445566bb").keep(state() / "pairs/passive", Side::passive, side);
  expect("passive", {"clock three days slow", "fail", "pairs", "is not valid before", "clock: `date`"});
}

TEST_F(BrokenPcByItself, ADaemonThatDoesNotRunIsNamed) {
  expect("passive", {"daemon not running", "warn", "daemon", "telehug-passive does not run", "telehug-passive run"});
}

// What root has of telehug is nothing: all is in the home of who asks.
TEST_F(BrokenPcByItself, SudoHasTheFirewallReadAndAllElseLookedAtAsWhoAsks) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can stand for somebody else";
  const fs::path home = root().parent_path();
  write(".config/telehug/active.toml", "[body_map]\npicture = \"chat.jpg\"\n[peer]\ndomain = 78\n");
  fs::create_directories(home / ".local/state");
  fs::rename(state(), home / ".local/state/telehug");
  write("passwd", "root:x:0:0::/root:/bin/sh\nmia:x:65534:65534::" + home.string() + ":/bin/sh\n");
  for (const char* variable : {"HOME=/root", "XDG_CONFIG_HOME=", "XDG_STATE_HOME=", "SUDO_UID=65534", "SUDO_USER=mia"})
    set(variable);
  before = "chown -R --no-dereference 65534:65534 " + home.string() + "; chmod 700 " + home.string() +
           "; unshare -n -m sh -c 'mount --bind " + (home / "passwd").string() +
           " /etc/passwd; nft add table inet f; nft \"add chain inet f in { type filter hook input priority 0; policy "
           "drop; }\"; exec \"$@\"' sh";
  expect("active",
         {"firewall closed, by sudo", "fail", "firewall", "UDP port 26900", "let UDP ports 26900 to 26929 in"});
}

// The user's unit is there, too, as the package installs it, and not used.
TEST_F(BrokenPcByItself, AFixedRigWhoseUnitHasFailedIsNamed) {
  fs::create_directories(root() / "run/systemd/system");
  write(
      "bin/systemctl",
      "#!/bin/sh\necho LoadState=loaded\ncase \"$*\" in\n"
      "*--user*) echo ActiveState=inactive; echo UnitFileState=disabled; echo Result=success;;\n"
      "*' telehug-active-rig.service '*) echo ActiveState=failed; echo UnitFileState=enabled; echo Result=exit-code;;\n"
      "*) exit 1;;\nesac\n");
  use_own_programs();
  expect("active", {"a fixed rig's unit failed", "fail", "unit", "telehug-active-rig.service has failed (exit-code)",
                    "sudo systemctl restart telehug-active-rig.service"});
}

TEST_F(BrokenPcByItself, ADaemonThatThisUserMayNotAskIsNamedAndNotItsPorts) {
  const UniqueDomain domain;
  configure("passive",
            "[jacket]\nlink = \"serial:/dev/ttyACM0\"\n[peer]\ndomain = " + std::to_string(domain.id()) + "\n");
  const TakenPort its(SOCK_DGRAM, 7400 + 250 * static_cast<int>(domain.id()) + 10);
  const ControlServer daemon({.socket = runtime() / "telehug/passive.sock", .group = {}});
  fs::permissions(runtime() / "telehug/passive.sock", fs::perms::none);
  as_nobody = true;
  expect("passive",
         {"daemon of another group", "warn", "daemon", "passive.sock may not be used by ", "then log in again"});
  expect("passive", {"", "ok", "ports", "telehug's are free, or its own", ""});
}

// A `systemctl` that says what systemd 252's said of a unit that could not start.
TEST_F(BrokenPcByItself, AUnitThatHasFailedIsNamed) {
  fs::create_directories(root() / "run/systemd/system");
  write("bin/systemctl",
        "#!/bin/sh\necho Result=exit-code\necho NRestarts=5\necho LoadState=loaded\necho ActiveState=failed\n"
        "echo UnitFileState=enabled\n");
  use_own_programs();
  expect("passive", {"systemd unit failed", "fail", "unit", "telehug-passive.service has failed (exit-code)",
                     "journalctl -u telehug-passive.service -e"});
}

}  // namespace
}  // namespace telehug
