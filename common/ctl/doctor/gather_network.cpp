// SPDX-License-Identifier: Apache-2.0
//
// Between the two PCs: clock, ports, firewall, and how the other one answers.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/timex.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>

#include "common/clock.hpp"
#include "config/locator.hpp"
#include "ctl/doctor/gather.hpp"
#include "ctl/run_program.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

// A neighbour that does not answer is given up by the kernel after three seconds (arp(7)).
constexpr Duration longest_probe = 4500ms;

// /proc/net/udp: "  sl  local_address rem_address st ...", the address as hexadecimal ADDRESS:PORT. `state`: only
// these; empty: all.
void add_ports(std::vector<int>& ports, const fs::path& file, const std::string& state) {
  std::istringstream lines(content_of(file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string number;
    std::string address;
    std::string other;
    std::string its_state;
    fields >> number >> address >> other >> its_state;
    const std::size_t colon = address.find(':');
    if (colon == std::string::npos || (!state.empty() && its_state != state)) continue;
    ports.push_back(static_cast<int>(std::strtol(address.c_str() + colon + 1, nullptr, 16)));
  }
}

class Probe {
 public:
  Probe(const std::string& text, int domain) : text_(text) {
    const std::size_t colon = text.find(':');
    sockaddr_in address{};
    address.sin_family = AF_INET;
    // Where the first participant is found (DDSI-RTPS 2.2, 9.6.1.1).
    const int port = colon == std::string::npos ? 7400 + 250 * domain + 10 : std::atoi(text.c_str() + colon + 1);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, text.substr(0, colon).c_str(), &address.sin_addr);
    fd_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd_ < 0) {
      settle(errno);
      return;
    }
    // Else Linux keeps to itself that a host is not there (ip(7)).
    const int on = 1;
    ::setsockopt(fd_, IPPROTO_IP, IP_RECVERR, &on, sizeof on);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || ::send(fd_, "", 0, 0) < 0)
      settle(errno);
  }
  ~Probe() {
    if (fd_ >= 0) ::close(fd_);
  }
  Probe(Probe&& other) noexcept
      : text_(std::move(other.text_)),
        fd_(std::exchange(other.fd_, -1)),
        answer_(other.answer_),
        settled_(other.settled_) {}
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;
  Probe& operator=(Probe&&) = delete;

  [[nodiscard]] int fd() const { return settled_ ? -1 : fd_; }
  [[nodiscard]] PeerProbe result() const { return {text_, answer_}; }

  void read_answer() {
    char byte = 0;
    settle(::recv(fd_, &byte, 1, 0) < 0 ? errno : 0);
  }

 private:
  void settle(int error) {
    if (error == EAGAIN || error == EINTR) return;
    settled_ = true;
    if (error == ECONNREFUSED) answer_ = PeerAnswer::refused;
    if (error == EHOSTUNREACH || error == EHOSTDOWN) answer_ = PeerAnswer::unreachable;
    if (error == ENETUNREACH || error == ENETDOWN) answer_ = PeerAnswer::no_route;
  }

  std::string text_;
  int fd_ = -1;
  PeerAnswer answer_ = PeerAnswer::silent;
  bool settled_ = false;
};

}  // namespace

std::vector<PeerProbe> probe_peers(const std::string& addresses, int domain) {
  const auto list = parse_addresses(addresses);
  if (!list) return {};
  std::vector<Probe> probes;
  probes.reserve(list->size());
  for (const std::string& address : *list)
    probes.emplace_back(address, domain);
  const SteadyClock clock;
  const Timestamp deadline = clock.now() + longest_probe;
  for (;;) {
    std::vector<pollfd> waiting;
    waiting.reserve(probes.size());
    for (const Probe& probe : probes)
      waiting.push_back({probe.fd(), POLLIN, 0});
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - clock.now()).count();
    const bool all = std::ranges::all_of(probes, [](const Probe& probe) { return probe.fd() < 0; });
    if (all || left <= 0 || ::poll(waiting.data(), waiting.size(), static_cast<int>(left)) == 0) break;
    for (std::size_t i = 0; i < probes.size(); ++i)
      if (waiting[i].fd >= 0 && waiting[i].revents != 0) probes[i].read_answer();
  }
  std::vector<PeerProbe> results;
  results.reserve(probes.size());
  for (const Probe& probe : probes)
    results.push_back(probe.result());
  return results;
}

void gather_firewall(DoctorFacts& facts) {
  for (const char* program : {"nft", "/usr/sbin/nft"}) {  // which is not in everybody's PATH
    const auto run = run_program({program, "-j", "list", "ruleset"}, 5s, "there is no nft");
    if (!run) continue;
    auto rules = nlohmann::json::parse(run->output, nullptr, false);
    facts.firewall_is_secret = run->code != 0;
    if (run->code == 0 && rules.is_object()) facts.firewall = std::move(rules);
    return;
  }
}

void gather_network(DoctorFacts& facts, const DoctorWishes& wishes) {
  timex clock{};
  if (const int state = ::adjtimex(&clock); state >= 0) facts.clock_synchronised = state != TIME_ERROR;
  const fs::path net = wishes.root / "proc/net";
  for (const char* file : {"udp", "udp6"})
    add_ports(facts.udp_ports, net / file, "");
  for (const char* file : {"tcp", "tcp6"})
    add_ports(facts.tcp_ports, net / file, "0A");  // TCP_LISTEN
  facts.legacy_firewall = content_of(net / "ip_tables_names").find("filter") != std::string::npos;
}

}  // namespace telehug
