// SPDX-License-Identifier: Apache-2.0
//
// How old what a receiver knows of the touching fingers is: our secured touches, MQTT with QoS 0 over TLS, and raw UDP
// (the lower bound) with the same payload, in turn, on loopback and through networks that delay and lose. README.md
// beside tests/bench/run says what is measured how.
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "bench/homes/report.hpp"
#include "bench/homes/roles.hpp"

namespace {

using namespace telehug;

constexpr std::uint32_t seed = 20261129;
constexpr int exit_skipped = 77;  // ctest's SKIP_RETURN_CODE
constexpr int state_rate_hz = 120;
constexpr int cpu_rate_hz = 60;
constexpr std::array ways{Way::secured, Way::mqtt, Way::udp};
const std::string loopback = "loopback";
const std::string lossy = "80 ms, 5 % lost each way";

struct Options {
  int rounds = 3;
  int seconds = 10;
  int cpu_seconds = 20;
  bool smoke = false;
  std::string json;

  // of the processes that it starts
  std::string role;
  std::string way;
  std::string log;
  int rate_hz = state_rate_hz;
  Meeting meeting;
};

std::vector<Network> networks(bool smoke) {
  std::vector<Network> all{{loopback, std::nullopt}, {lossy, WayFaults{.delay = 80ms, .loss = 0.05}}};
  if (smoke) return all;
  all.push_back({"80 ms, 20 % lost each way", WayFaults{.delay = 80ms, .loss = 0.2}});
  all.push_back({"270 to 330 ms, overtaking, none lost", WayFaults{.delay = 270ms, .jitter = 60ms}});
  return all;
}

void compare(const Options& options) {
  Exchanges exchanges(seed);
  const Duration settle = options.smoke ? Duration(200ms) : Duration(1s);
  std::vector<Row> rows;
  for (const Network& network : networks(options.smoke)) {
    std::array<LinkFigures, ways.size()> sums;
    // In turn, so that a busy minute of the PC befalls all of them.
    for (int round = 0; round < options.rounds; ++round) {
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const ExchangePlan plan{ways[i], state_rate_hz, settle, std::chrono::seconds(options.seconds)};
        add(sums[i], exchanges.run(network, plan).figures);
        if (sums[i].one_way_ms.empty()) throw std::runtime_error(network.name + ": nothing arrived");
      }
    }
    for (std::size_t i = 0; i < ways.size(); ++i)
      rows.push_back({network.name, ways[i], std::move(sums[i])});
  }
  std::vector<CpuRow> cpu;
  for (const Way way : ways) {
    const ExchangePlan plan{way, cpu_rate_hz, settle, std::chrono::seconds(options.cpu_seconds)};
    const Exchange exchange = exchanges.run({loopback, std::nullopt}, plan);
    cpu.push_back({way, exchange.sender_cpu, exchange.receiver_cpu});
  }
  fmt::print("{}\n{}\n{}", tables_text(rows), cpu_text(cpu, cpu_rate_hz), goals_text(rows, cpu, loopback, lossy));
  if (!options.json.empty()) std::ofstream(options.json) << figures_json(rows, cpu).dump(2) << '\n';
}

[[noreturn]] void play_role(const Options& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const Way way : ways) {
    if (options.way != name_of(way)) continue;
    if (options.role == "send") send_touches(way, options.meeting, options.rate_hz);
    note_touches(way, options.meeting, options.log);
  }
  throw std::runtime_error("there is no way \"" + options.way + "\"");
}

int run(const Options& options) {
  if (!options.role.empty()) play_role(options);
  try {
    compare(options);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::operation_not_permitted) throw;
    fmt::print("skipped: network namespaces are not permitted here: {}\n", error.what());
    return exit_skipped;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    CLI::App app("Compares telehug's secured touches with MQTT over TLS and raw UDP");
    app.add_option("--rounds", options.rounds, "exchanges of each way in each network")->check(CLI::Range(1, 1000));
    app.add_option("--seconds", options.seconds, "that are measured of each")->check(CLI::Range(1, 3600));
    app.add_option("--cpu-seconds", options.cpu_seconds, "in which CPU time is measured")->check(CLI::Range(1, 3600));
    app.add_flag("--smoke", options.smoke, "only whether everything arrives: the two most important networks");
    app.add_option("--json", options.json, "also write the figures to this file");
    const std::string hidden;
    app.add_option("--role", options.role)->group(hidden);
    app.add_option("--way", options.way)->group(hidden);
    app.add_option("--log", options.log)->group(hidden);
    app.add_option("--rate", options.rate_hz)->group(hidden)->check(CLI::Range(1, 1000));
    app.add_option("--folder", options.meeting.folder)->group(hidden);
    app.add_option("--address", options.meeting.address)->group(hidden);
    app.add_flag("--loopback", options.meeting.loopback)->group(hidden);
    CLI11_PARSE(app, argc, argv);
    return run(options);
  } catch (const std::exception& error) {
    std::fputs("bench_homes: ", stderr);
    std::fputs(error.what(), stderr);
    std::fputs("\n", stderr);
    return 1;
  }
}
