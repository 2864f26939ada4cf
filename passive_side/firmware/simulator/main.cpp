// SPDX-License-Identifier: Apache-2.0
//
// telehug-jacket-sim: the jacket's real firmware, run in real time in a simulated ATmega328P behind a pseudo terminal.
#include <fmt/core.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "common/clock.hpp"
#include "common/data_folder.hpp"
#include "simulator/heater_faults.hpp"
#include "simulator/pin_activity.hpp"
#include "simulator/pty_bridge.hpp"
#include "simulator/simulated_jacket.hpp"

namespace telehug {
namespace {

struct Options {
  std::string board{board_wirings().front().name};
  std::string firmware;
  std::string link;
  std::string pins;
  std::string edges;
  unsigned supply_mv = 5000;
  std::vector<std::string> heater_faults;
  bool die_with_parent = false;
};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File open_log(const std::string& path) {
  if (path.empty()) return {nullptr, &std::fclose};
  File file{std::fopen(path.c_str(), "we"), &std::fclose};
  if (!file) throw std::runtime_error("can't write " + path + ": choose a place that this user may write to");
  return file;
}

std::vector<std::string> board_names() {
  std::vector<std::string> names;
  for (const BoardWiring& board : board_wirings())
    names.emplace_back(board.name);
  return names;
}

const BoardWiring& board_of(const Options& options) {
  return *find_board(options.board);  // the command line takes no other
}

std::filesystem::path firmware_of(const Options& options) {
  if (!options.firmware.empty()) return options.firmware;
  return data_folder() / "firmware" / board_of(options).elf;
}

// SIGTERM and SIGINT end the program, SIGUSR1 cuts the firmware's input or joins it again.
int open_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1})
    sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  const int fd = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  if (fd < 0) throw std::runtime_error("can't receive signals");
  return fd;
}

std::int64_t now_ns() {
  return to_ns(SteadyClock{}.now());
}

class Simulator {
 public:
  explicit Simulator(const Options& options)
      : options_(options),
        signals_(open_signals()),
        pins_(open_log(options.pins)),
        edges_(open_log(options.edges)),
        jacket_(firmware_of(options), board_of(options)),
        pty_(options.link),
        activity_([this](const ActivityChange& change) { log(change); }) {
    jacket_.on_edge([this](const PinEdge& edge) { on_edge(edge); });
    jacket_.heaters().set_supply_mv(options.supply_mv);
    for (const std::string& text : options.heater_faults)
      plan(parse_heater_fault(text));
  }
  ~Simulator() { close(signals_); }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  void run() {
    // Listens before it says that it is ready.
    jacket_.run_ms(5);
    say("ready {}\n", options_.link.empty() ? pty_.path() : options_.link);
    auto epoch = SteadyClock{}.now();
    auto epoch_cycle = jacket_.cycle();
    while (!ended_) {
      const auto simulated = epoch + cycles(jacket_.cycle() - epoch_cycle);
      wait_for_input(simulated - SteadyClock{}.now());
      handle_signals();
      // The line to the jacket takes what it can carry in a while; the rest waits in the terminal, as at a real port.
      if (jacket_.bytes_in_flight() < line_bytes_max) jacket_.write(pty_.read());
      const auto behind = SteadyClock{}.now() - (epoch + cycles(jacket_.cycle() - epoch_cycle));
      if (behind > lag_max) {
        epoch = SteadyClock{}.now();
        epoch_cycle = jacket_.cycle();
      }
      if (behind > Duration::zero()) jacket_.run_cycles(slice_cycles);
      activity_.advance(jacket_.cycle());
      pty_.write(jacket_.take_output());
    }
    activity_.end_all(jacket_.cycle(), now_ns());
  }

 private:
  void plan(const HeaterFaultOption& fault) {
    if (fault.heater >= jacket_.heaters().size()) {
      throw std::runtime_error(fmt::format("the board {} has {} heaters: there is no heater {}", options_.board,
                                           jacket_.heaters().size(), fault.heater));
    }
    const double cycle = fault.at_s * 1000 * static_cast<double>(jacket_cycles_per_ms);
    jacket_.heaters().break_at(static_cast<std::uint64_t>(cycle), fault.heater, fault.what);
  }

  static constexpr std::uint64_t slice_cycles = jacket_cycles_per_ms;
  static constexpr std::size_t line_bytes_max = 64;
  static constexpr Duration lag_max = 20ms;  // lost time beyond this is dropped, not caught up with
  static constexpr std::uint64_t ns_per_cycle_x2 = 125;

  static Duration cycles(std::uint64_t count) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(count * ns_per_cycle_x2 / 2));
  }

  template <typename... Arguments>
  static void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::print(format, std::forward<Arguments>(arguments)...);
    std::fflush(stdout);
  }

  void wait_for_input(Duration time) const {
    const bool takes_bytes = jacket_.bytes_in_flight() < line_bytes_max;
    std::array<pollfd, 2> fds{{{signals_, POLLIN, 0}, {takes_bytes ? pty_.fd() : -1, POLLIN, 0}}};
    const auto ns = std::max<std::int64_t>(std::chrono::nanoseconds(time).count(), 0);
    const timespec timeout{ns / 1'000'000'000, ns % 1'000'000'000};
    ppoll(fds.data(), fds.size(), &timeout, nullptr);
  }

  void handle_signals() {
    signalfd_siginfo signal{};
    while (::read(signals_, &signal, sizeof signal) == sizeof signal) {
      if (signal.ssi_signo != SIGUSR1) {
        ended_ = true;
        continue;
      }
      muted_ = !muted_;
      jacket_.mute_input(muted_);
      say("{} {}\n", muted_ ? "muted" : "unmuted", now_ns());
    }
    if (options_.die_with_parent && getppid() != parent_) ended_ = true;
  }

  void on_edge(const PinEdge& edge) {
    const auto time_ns = now_ns();
    if (edges_) {
      fmt::print(edges_.get(), "{},{},{},{}\n", time_ns, edge.cycle, edge.channel, edge.high ? "high" : "low");
    }
    activity_.on_edge(edge, time_ns);
  }

  void log(const ActivityChange& change) {
    if (!pins_) return;
    fmt::print(pins_.get(), "{},{},{},{}\n", change.monotonic_ns, change.cycle, change.channel,
               change.on ? "on" : "off");
    std::fflush(pins_.get());
  }

  Options options_;
  pid_t parent_ = getppid();
  int signals_;
  File pins_;
  File edges_;
  SimulatedJacket jacket_;
  PtyBridge pty_;
  PinActivity activity_;
  bool muted_ = false;
  bool ended_ = false;
};

const Program program{
    .name = "telehug-jacket-sim",
    .purpose =
        "The telehug jacket without a jacket: its firmware, simulated, behind a pseudo terminal.\n"
        "SIGUSR1 cuts the firmware's input, and joins it again.",
    .examples = {{"telehug-jacket-sim --link /tmp/jacket",
                  "for `telehug-passive run --set jacket.link=serial:/tmp/jacket`"},
                 {"telehug-jacket-sim --pins pins.csv", "notes when each motor starts and ends"},
                 {"telehug-jacket-sim --board motors12_heaters2 --heater-fault 0:open@5",
                  "after five seconds the first heater's thermistor is cut"}},
    .exits = {ExitCode::ok, ExitCode::internal, ExitCode::usage},
    .see_also = {"telehug-passive(1)", "telehug(7)"},
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--board", options.board, "What the jacket has")
      ->check(CLI::IsMember(board_names()))
      ->capture_default_str();
  app.add_option("--firmware", options.firmware,
                 "ELF file of the firmware (default: the one of the board, built or installed with this)")
      ->type_name("FILE");
  app.add_option("--link", options.link, "Make this path a symbolic link to the terminal")->type_name("FILE");
  app.add_option("--pins", options.pins,
                 "Write here: monotonic_ns,cycle,channel,on|off for each motor that starts or ends; "
                 "channels 16 and 17 are the heaters")
      ->type_name("FILE");
  app.add_option("--edges", options.edges,
                 "Write here: monotonic_ns,cycle,channel,high|low for each edge of a motor's or heater's pin")
      ->type_name("FILE");
  app.add_option("--supply", options.supply_mv, "Of the microcontroller, in mV")
      ->check(CLI::Range(1800, 5500))
      ->type_name("MV")
      ->capture_default_str();
  app.add_option("--heater-fault", options.heater_faults,
                 "HEATER:open|short|detached|runaway|overvoltage[@SECONDS]; may be given several times")
      ->type_name("FAULT");
  app.add_flag("--die-with-parent", options.die_with_parent, "End when the program that started this one has ended");
}

}  // namespace
}  // namespace telehug

int main(int argc, char** argv) {
  telehug::Options options;
  return telehug::run_program(argc, argv, telehug::program, [&](CLI::App& app, telehug::ExitCode&) {
    telehug::add_options(app, options);
    app.callback([&] { telehug::Simulator(options).run(); });
  });
}
