// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "link/jacket_link.hpp"
#include "link/wire_link.hpp"

namespace telehug {

struct SimulatorOptions {
  std::filesystem::path program;   // telehug-jacket-sim; empty: the one beside this program
  std::string board;               // as the simulator's --board; empty: its default
  std::filesystem::path firmware;  // empty: the board's
  std::filesystem::path link;      // where the simulated serial port appears; empty: a private place
  std::filesystem::path pins;      // log of the motors that start and end; empty: none
  bool dies_with_this_program = true;
};

// A jacket that is simulated, firmware and all, by a program of its own (telehug-jacket-sim), which this starts, and
// starts again if it ends.
class SimulatedLink final : public JacketLink {
 public:
  static constexpr Duration restart_pause = 1s;

  // Throws std::runtime_error if there is no such program.
  SimulatedLink(SimulatorOptions options, std::unique_ptr<Conversation> conversation);
  ~SimulatedLink() override;
  SimulatedLink(const SimulatedLink&) = delete;
  SimulatedLink& operator=(const SimulatedLink&) = delete;

  void poll(Timestamp now) override;
  bool send(const MotorCommands& commands, Timestamp now) override { return wire_.send(commands, now); }
  bool heat(const HeaterCommands& commands, Timestamp now) override { return wire_.heat(commands, now); }
  void stop_all(Timestamp now) override { wire_.stop_all(now); }
  [[nodiscard]] const LinkStatus& status() const override { return wire_.status(); }

  // Process id of the simulator, 0 while there is none.
  [[nodiscard]] pid_t simulator() const { return child_; }

 private:
  void start();
  void reap(Timestamp now);

  std::filesystem::path private_folder_;  // before options_, which may name a place in it
  SimulatorOptions options_;
  WireLink wire_;
  pid_t child_ = 0;
  Timestamp start_at_;
};

}  // namespace telehug
