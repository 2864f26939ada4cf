// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/exchange.hpp"

#include <fmt/format.h>
#include <time.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "bench/homes/broker.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

constexpr const char* loopback_address = "127.0.0.1";
// TLS and DDS Security both need several round trips, which may be lost. Where a round trip takes longer than Fast DDS
// waits for an answer (500 ms) its handshake may not end; the daemons then replace the participant (LinkSupervisor).
constexpr Duration longest_start = 20s;
constexpr int most_starts = 5;
constexpr Duration aftermath = 1s;  // so long the receiver hears what was sent late

void pair_up(const std::filesystem::path& folder) {
  PairStore parent(folder / parents_pairs, Side::active);
  PairStore wearer(folder / wearers_pairs, Side::passive);
  const auto granted = wearer.grant(parent.request("Parent").value(), "Child", wall_time()).value();
  (void)parent.accept(granted.grant, wall_time()).value();
}

// What a running process has used of the processors, all its threads and the kernel for it: what getrusage() would tell
// it itself.
Duration processor_time(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) {
    throw std::runtime_error("a process of the benchmark has ended by itself");
  }
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

bool something_arrives(const std::filesystem::path& log) {
  const Timestamp give_up = SteadyClock{}.now() + longest_start;
  while (arrivals_in(log).empty()) {
    if (SteadyClock{}.now() > give_up) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

}  // namespace

Exchanges::Exchanges(std::uint32_t seed) : homes_(seed), random_(seed) {
  pair_up(folder_.path());
  make_broker_certificate(folder_.path(), {loopback_address, TwoHomes::address(Home::child)});
}

Exchanges::Programs Exchanges::start(const Meeting& meeting, const ExchangePlan& plan,
                                     const std::filesystem::path& log) const {
  const auto role = [&](const char* name, Home home) {
    std::vector<std::string> words{"/proc/self/exe",
                                   "--role",
                                   name,
                                   "--way",
                                   name_of(plan.way),
                                   "--folder",
                                   meeting.folder,
                                   "--address",
                                   meeting.address,
                                   "--log",
                                   log,
                                   "--rate",
                                   std::to_string(plan.rate_hz)};
    if (meeting.loopback) words.emplace_back("--loopback");
    const InsideNamespace inside(homes_.network(home));
    return std::make_unique<ChildProgram>(words);
  };
  Programs programs;
  if (plan.way == Way::mqtt) {
    const InsideNamespace inside(homes_.network(Home::child));
    programs.broker = start_broker(meeting);
  }
  programs.receiver = role("receive", Home::child);
  programs.sender = role("send", meeting.loopback ? Home::child : Home::parent);
  return programs;
}

Exchange Exchanges::run(const Network& network, const ExchangePlan& plan) {
  const bool loopback = !network.faults;
  homes_.set_both(network.faults.value_or(WayFaults{}));
  const Meeting meeting{.address = loopback ? loopback_address : TwoHomes::address(Home::child),
                        .loopback = loopback,
                        .folder = folder_.path()};
  const std::filesystem::path log = folder_ / fmt::format("arrivals-{}", ++count_);
  Programs programs = start(meeting, plan, log);
  for (int starts = 1; !something_arrives(log); ++starts) {
    const std::string what = fmt::format("{}, {}: nothing arrived", network.name, name_of(plan.way));
    if (starts == most_starts) throw std::runtime_error(what);
    fmt::print(stderr, "{}; both sides are started again\n", what);
    programs = {};  // mosquitto's port is free before it is taken again
    programs = start(meeting, plan, log);
  }
  std::this_thread::sleep_for(plan.settle);

  const auto cpu_of_receiver = [&] {
    const auto& broker = programs.broker;
    return processor_time(programs.receiver->pid()) + (broker != nullptr ? processor_time(broker->pid()) : Duration{});
  };
  const Duration sender_before = processor_time(programs.sender->pid());
  const Duration receiver_before = cpu_of_receiver();
  Span span{SteadyClock{}.now(), {}};
  std::this_thread::sleep_for(plan.lasts);
  span.until = SteadyClock{}.now();
  const double seconds = to_ms(span.until - span.from) / 1000;
  const auto share = [&](Duration spent) { return to_ms(spent) / 1000 / seconds; };
  Exchange exchange;
  exchange.sender_cpu = share(processor_time(programs.sender->pid()) - sender_before);
  exchange.receiver_cpu = share(cpu_of_receiver() - receiver_before);
  std::this_thread::sleep_for(aftermath);
  exchange.figures = link_figures(arrivals_in(log), span, plan.rate_hz, random_);
  return exchange;
}

}  // namespace telehug
