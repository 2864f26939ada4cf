// SPDX-License-Identifier: Apache-2.0
//
// How many pairs one network bears: two PCs with a program for each end of each pair, as in a care home whose residents
// each have a jacket and a family. Every end is a secured participant with heartbeats, as the daemons have at rest. All
// in one DDS domain, and each pair in a domain of its own (peer.domain).
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>
#include <thread>

#include "dds/participant.hpp"
#include "doubles/child_program.hpp"
#include "doubles/temporary_folder.hpp"
#include "netlab/two_homes.hpp"
#include "pairing/pairing.hpp"
#include "peer/session_id.hpp"
#include "peer_link/peer_link.hpp"

namespace {

using namespace telehug;

constexpr std::uint32_t seed = 20261129;
constexpr int exit_skipped = 77;  // ctest's SKIP_RETURN_CODE
constexpr auto longest_meeting = std::chrono::seconds(90);
constexpr Duration pipeline_round = 20ms;

struct Options {
  std::vector<int> pairs{1, 10, 50};
  int seconds = 20;
  // of the programs that it starts
  std::string end;
  std::string store;
  int domain = 0;
};

Side side_of(const std::string& end) {
  return end == "active" ? Side::active : Side::passive;
}

// One end of a pair, until it is killed: says when the other end is heard.
[[noreturn]] void be_an_end(const Options& options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Side side = side_of(options.end);
  const Pair pair = PairStore(options.store, side).list().at(0);
  DdsParticipant participant({.side = side,
                              .domain_id = static_cast<std::uint32_t>(options.domain),
                              .partition = pair.partition,
                              .loopback_only = false,
                              .security = pair.files});
  const SteadyClock clock;
  PeerLink link(participant, side, new_session_id(), 250ms, clock);
  for (bool said = false;; std::this_thread::sleep_for(pipeline_round)) {
    link.serve(clock.now());
    if (said || !link.alive(clock.now())) continue;
    said = true;
    std::puts("heard");
    std::fflush(stdout);
  }
}

// Of all processes together.
struct Usage {
  double cpu_s = 0;
  double memory_mb = 0;
};

Usage usage(const std::vector<std::unique_ptr<ChildProgram>>& ends) {
  Usage sum;
  for (const auto& end : ends) {
    std::ifstream stat(fmt::format("/proc/{}/stat", end->pid()));
    const std::string text{std::istreambuf_iterator<char>(stat), {}};
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::vector<std::string> words{std::istream_iterator<std::string>(fields), {}};
    if (words.size() < 22) continue;  // it has ended
    // proc(5): utime and stime are the 14th and 15th field, rss is the 24th; the first here is the 3rd.
    sum.cpu_s += (std::stod(words[11]) + std::stod(words[12])) / static_cast<double>(sysconf(_SC_CLK_TCK));
    sum.memory_mb += std::stod(words[21]) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
  }
  return sum;
}

// What came in at a home's interface, in bytes.
double received_bytes(const NetNamespace& network) {
  const InsideNamespace inside(network);
  std::ifstream table("/proc/thread-self/net/dev");
  for (std::string line; std::getline(table, line);) {
    const auto colon = line.find(':');
    if (colon != std::string::npos && line.substr(0, colon).ends_with("home")) return std::stod(line.substr(colon + 1));
  }
  return 0;
}

void pair_up(const std::filesystem::path& folder) {
  PairStore parent(folder / "active", Side::active);
  PairStore wearer(folder / "passive", Side::passive);
  const WallTime now = wall_time();
  const auto granted = wearer.grant(parent.request("Parent").value(), "Child", now);
  if (!granted || !parent.accept(granted->grant, now)) throw std::runtime_error("a pair can't be made");
}

void measure(const Options& options, int pairs, bool own_domains) {
  const TemporaryFolder folder;
  for (int i = 0; i < pairs; ++i)
    pair_up(folder / std::to_string(i));
  TwoHomes homes(seed);
  std::vector<std::unique_ptr<ChildProgram>> ends;
  const auto begun = std::chrono::steady_clock::now();
  const auto since_begun_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  };
  for (int i = 0; i < pairs; ++i) {
    for (const auto& [end, home] : {std::pair{"active", Home::parent}, std::pair{"passive", Home::child}}) {
      const InsideNamespace inside(homes.network(home));
      ends.push_back(std::make_unique<ChildProgram>(std::vector<std::string>{
          "/proc/self/exe", "--end", end, "--store", (folder / std::to_string(i) / end).string(), "--domain",
          std::to_string(own_domains ? i + 1 : 77)}));
    }
  }
  const double started_s = since_begun_s();
  int heard = 0;
  double all_heard_s = 0;
  for (const auto& end : ends) {
    const auto left = longest_meeting - std::chrono::duration<double>(since_begun_s());
    const auto left_ms =
        std::max(std::chrono::milliseconds(1), std::chrono::duration_cast<std::chrono::milliseconds>(left));
    if (!end->read_line_within(left_ms)) continue;
    ++heard;
    all_heard_s = since_begun_s();
  }
  const Usage before = usage(ends);
  const double bytes_before = received_bytes(homes.network(Home::child));
  std::this_thread::sleep_for(std::chrono::seconds(options.seconds));
  const Usage after = usage(ends);
  const double bytes = received_bytes(homes.network(Home::child)) - bytes_before;
  const auto count = static_cast<double>(ends.size());
  fmt::print("| {} | {} | {:.1f} | {} of {} | {:.1f} | {:.1f} | {:.2f} | {:.1f} |\n", pairs,
             own_domains ? "one each" : "one for all", started_s, heard, ends.size(), all_heard_s,
             after.memory_mb / count, 100 * (after.cpu_s - before.cpu_s) / options.seconds / count,
             bytes / options.seconds * 1e-3);
  std::fflush(stdout);
}

int run(const Options& options) {
  if (!options.end.empty()) be_an_end(options);
  fmt::print(
      "| pairs | domains | all started after, s | ends that hear theirs | the last after, s | memory of an end, MB | "
      "CPU "
      "of an end at rest, % of a core | traffic into one PC, kB/s |\n|---|---|---|---|---|---|---|---|\n");
  try {
    for (const bool own_domains : {false, true})
      for (const int pairs : options.pairs)
        measure(options, pairs, own_domains);
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
    CLI::App app("Measures how many pairs one network bears");
    app.add_option("--pairs", options.pairs, "how many, one after the other")->delimiter(',')->check(CLI::Range(1, 90));
    app.add_option("--seconds", options.seconds, "at rest that are measured")->check(CLI::Range(1, 3600));
    const std::string hidden;
    app.add_option("--end", options.end)->group(hidden);
    app.add_option("--store", options.store)->group(hidden);
    app.add_option("--domain", options.domain)->group(hidden);
    CLI11_PARSE(app, argc, argv);
    return run(options);
  } catch (const std::exception& error) {
    (void)std::fputs("bench_pairs: ", stderr);
    (void)std::fputs(error.what(), stderr);
    (void)std::fputs("\n", stderr);
    return 1;
  }
}
