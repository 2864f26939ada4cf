// SPDX-License-Identifier: Apache-2.0
//
// How long a TouchEvent is under way between two processes on loopback, and what plain UDP needs for the same bytes in
// the same run (the lower bound). Both processes read one monotonic clock, so one way can be measured too.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "common/clock.hpp"
#include "common/latest_slot.hpp"
#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/unique_domain.hpp"

namespace {

using namespace telehug;

// A TouchEvent with two contacts and two transitions: 364 bytes of CDR, and what RTPS puts before it.
constexpr std::size_t event_bytes = 446;

struct Options {
  int samples = 2000;
  int rate_hz = 240;
  std::string json;
};

struct Figures {
  std::vector<double> one_way_us;
  std::vector<double> round_trip_us;
  std::vector<double> send_us;  // the caller's time in the send call
  int lost = 0;
};

std::int64_t now_ns() {
  return to_ns(SteadyClock().now());
}
double us(std::int64_t ns) {
  return static_cast<double>(ns) / 1000;
}

class UdpSocket {
 public:
  UdpSocket() : descriptor_(socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address_;
    if (bind(descriptor_, generic(address_), size) != 0 || getsockname(descriptor_, generic(address_), &size) != 0) {
      throw std::runtime_error("no UDP socket on loopback");
    }
    const timeval patience{.tv_sec = 0, .tv_usec = 200'000};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~UdpSocket() { close(descriptor_); }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  template <typename Bytes>
  void send_to(const UdpSocket& other, const Bytes& bytes) const {
    sockaddr_in to = other.address_;
    sendto(descriptor_, bytes.data(), bytes.size(), 0, generic(to), sizeof to);
  }
  template <typename Bytes>
  bool receive(Bytes& bytes) const {
    return recv(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  }

 private:
  static sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }
  int descriptor_;
  sockaddr_in address_{};
};

using Datagram = std::array<char, event_bytes>;

// The other process: answers touches with Felts and datagrams with the time of their arrival, until it is killed.
[[noreturn]] void answer(const DdsSettings& settings, const UdpSocket& own, const UdpSocket& other) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  DdsParticipant participant(settings);
  Writer<Felt> writer(participant);
  Felt felt = example_felt();
  const Reader<TouchEvent> reader(participant, [&](const TouchEvent& event) {
    felt.received_time_ns = now_ns();
    felt.touch_sequence = event.sequence;
    writer.write(felt);
  });
  for (Datagram datagram{};;) {
    if (!own.receive(datagram)) continue;
    const std::int64_t arrived = now_ns();
    std::memcpy(datagram.data(), &arrived, sizeof arrived);
    own.send_to(other, datagram);
  }
}

// Calls exchange once a period; it returns false if the answer did not come.
template <typename Exchange>
void pace(const Options& options, Figures& figures, Exchange exchange) {
  const SteadyClock clock;
  const Duration period = Duration(1s) / options.rate_hz;  // 1s alone counts whole seconds
  Timestamp next = clock.now();
  for (int i = 0; i < options.samples; ++i) {
    next = std::max(next + period, clock.now());
    std::this_thread::sleep_until(next);
    if (!exchange()) ++figures.lost;
  }
}

Figures measure_dds(const Options& options, const DdsSettings& settings) {
  DdsParticipant participant(settings);
  LatestSlot<Felt> felt_slot;
  const Reader<Felt> reader(participant, [&](const Felt& felt) { felt_slot.put(felt); });
  Writer<TouchEvent> writer(participant);
  TouchEvent event = example_touch();
  Figures figures;
  const auto exchange = [&] {
    ++event.sequence;
    event.sent_time_ns = now_ns();
    if (!writer.write(event)) return false;
    const std::int64_t written = now_ns();
    const Timestamp give_up = from_ns(written) + 200ms;
    auto felt = felt_slot.wait_and_take(give_up);
    while (felt && felt->touch_sequence != event.sequence)
      felt = felt_slot.wait_and_take(give_up);
    if (!felt) return false;
    figures.round_trip_us.push_back(us(now_ns() - event.sent_time_ns));
    figures.one_way_us.push_back(us(felt->received_time_ns - event.sent_time_ns));
    figures.send_us.push_back(us(written - event.sent_time_ns));
    return true;
  };
  const Timestamp give_up = SteadyClock().now() + 10s;
  while (!exchange()) {
    if (SteadyClock().now() > give_up) throw std::runtime_error("the two processes did not find each other in 10 s");
  }
  figures = {};
  pace(options, figures, exchange);
  return figures;
}

Figures measure_udp(const Options& options, const UdpSocket& own, const UdpSocket& other) {
  Figures figures;
  Datagram datagram{};
  pace(options, figures, [&] {
    const std::int64_t sent = now_ns();
    own.send_to(other, datagram);
    const std::int64_t written = now_ns();
    if (!own.receive(datagram)) return false;
    std::int64_t arrived = 0;
    std::memcpy(&arrived, datagram.data(), sizeof arrived);
    figures.round_trip_us.push_back(us(now_ns() - sent));
    figures.one_way_us.push_back(us(arrived - sent));
    figures.send_us.push_back(us(written - sent));
    return true;
  });
  return figures;
}

void report(const std::string& name, std::vector<double> values_us, int lost, nlohmann::json& json) {
  if (values_us.empty()) throw std::runtime_error("nothing came back for " + name);
  std::sort(values_us.begin(), values_us.end());
  const auto quantile = [&](double part) {
    return values_us[static_cast<std::size_t>(part * static_cast<double>(values_us.size() - 1))];
  };
  fmt::print("{:<34} {:>9.1f} {:>9.1f} {:>6}\n", name, quantile(0.5), quantile(0.99), lost);
  json[name] = {{"p50", quantile(0.5)}, {"p99", quantile(0.99)}, {"unit", "us"}};
}

void report_all(const std::string& suffix, const Figures& figures, nlohmann::json& json) {
  report("link.one_way_" + suffix, figures.one_way_us, figures.lost, json);
  report("link.round_trip_" + suffix, figures.round_trip_us, figures.lost, json);
  report("link.send_call_" + suffix, figures.send_us, figures.lost, json);
}

void run(const Options& options) {
  const UniqueDomain domain;
  DdsSettings settings{.side = Side::passive, .domain_id = domain.id(), .partition = domain.partition()};
  const UdpSocket here;
  const UdpSocket there;
  const pid_t answering = fork();
  if (answering == 0) answer(settings, there, here);

  settings.side = Side::active;
  nlohmann::json json;
  fmt::print("{:<34} {:>9} {:>9} {:>6}\n", "figure", "p50 us", "p99 us", "lost");
  report_all("plain", measure_dds(options, settings), json);
  report_all("raw_udp", measure_udp(options, here, there), json);
  kill(answering, SIGKILL);
  waitpid(answering, nullptr, 0);
  if (!options.json.empty()) std::ofstream(options.json) << json.dump(2) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Measures the way of a TouchEvent between two processes on loopback");
  app.add_option("--samples", options.samples, "touches per figure")->check(CLI::Range(1, 1'000'000));
  app.add_option("--rate", options.rate_hz, "touches a second")->check(CLI::Range(1, 1000));
  app.add_option("--json", options.json, "also write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_link: {}\n", error.what());
    return 1;
  }
  return 0;
}
