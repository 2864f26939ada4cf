// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "common/messages.hpp"
#include "demo_record.hpp"
#include "doubles/temporary_folder.hpp"
#include "doubles/unique_domain.hpp"
#include "pairing/pairing.hpp"
#include "service/control_client.hpp"

namespace telehug {

// Asks until it is so; false if that takes too long.
bool eventually(const std::function<bool()>& condition, Duration longest = 20s);

[[nodiscard]] std::string content_of(const std::filesystem::path& file);

// How a program ended by itself, and what it said.
struct Outcome {
  std::optional<int> code;
  std::string text;
};

// The product as it is used: both daemons and the simulated jacket as real processes, over real DDS on loopback, in a
// folder, DDS domain and partition of their own. What a test wants otherwise it changes before it starts the program.
class RunningPair {
 public:
  RunningPair();
  ~RunningPair();
  RunningPair(const RunningPair&) = delete;
  RunningPair& operator=(const RunningPair&) = delete;

  TemporaryFolder folder;

  // What the next start takes.
  std::string camera;  // as --source; at first a finger that rests on the child's picture for ever
  std::filesystem::path picture;
  std::filesystem::path calibration;
  std::string jacket_link;
  std::vector<std::string> jacket_options;  // of telehug-jacket-sim, such as --board
  bool loopback_only = true;
  std::filesystem::path active_config = "/dev/null";  // --config
  std::filesystem::path passive_config = "/dev/null";
  std::vector<std::string> active_settings;  // SECTION.KEY=VALUE
  std::vector<std::string> passive_settings;
  // What stands before a daemon's command line, such as env and its variables.
  std::vector<std::string> active_prefix;
  std::vector<std::string> passive_prefix;

  // Pairs the two sides; with it they speak through DDS Security. Of the PC that is `side`.
  [[nodiscard]] PairStore pairs(Side side) const;
  // `wearer_at`: as in PairStore::grant().
  // `when`: by the clocks of both.
  void pair_up(const std::string& wearer_at = "", WallTime when = wall_time()) const;

  void calibrate(const std::string& source) const;
  void start_jacket();
  void start_passive();
  void start_active();
  // All of them, and waits until the finger is felt. False if it is not.
  bool start_all();

  // Runs a program to its end.
  [[nodiscard]] Outcome run(const std::vector<std::string>& command) const;
  // `telehug COMMAND --socket ... ARGUMENTS`
  [[nodiscard]] Outcome telehug(const std::string& command, Side side,
                                const std::vector<std::string>& arguments = {}) const;
  [[nodiscard]] std::vector<std::string> active_command() const;
  [[nodiscard]] std::vector<std::string> passive_command() const;

  // Null if the daemon does not answer.
  [[nodiscard]] nlohmann::json status(Side side) const;
  // Is this among the problems, each with what to do, that the daemon tells?
  [[nodiscard]] bool complains(Side side, const std::string& text) const;
  [[nodiscard]] std::uint64_t counter(Side side, const std::string& name) const;
  [[nodiscard]] bool camera_open() const;
  [[nodiscard]] std::string jacket_state() const;
  [[nodiscard]] std::filesystem::path socket(Side side) const;
  [[nodiscard]] std::filesystem::path stop_file(Side side) const;
  [[nodiscard]] std::uint32_t domain() const noexcept { return domain_.id(); }
  // Of both sides while they are no pair.
  [[nodiscard]] const std::string& partition() const noexcept { return domain_.partition(); }

  [[nodiscard]] std::vector<PinChange> pins() const;
  // Channels whose pins run now.
  [[nodiscard]] std::set<int> running() const;
  [[nodiscard]] bool felt() const { return !running().empty(); }

  // Does this to the chain while a motor runs. How long after it the last pin fell silent, in ms; nothing if no motor
  // ran or one never stopped.
  [[nodiscard]] std::optional<double> ms_to_silence(const std::function<void()>& blow) const;

  // For a failed test.
  [[nodiscard]] std::string logs() const;

  std::unique_ptr<ChildProcess> jacket;
  std::unique_ptr<ChildProcess> passive;
  std::unique_ptr<ChildProcess> active;

 private:
  void write_tireless_jacket() const;
  [[nodiscard]] std::vector<std::string> command(Side side, std::vector<std::string> settings) const;

  UniqueDomain domain_;
};

}  // namespace telehug
