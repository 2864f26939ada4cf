// SPDX-License-Identifier: Apache-2.0
//
// The jacket's real firmware in a simulated ATmega328P, in virtual time: deterministic, some 50 times faster than real.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "simulator/board_wiring.hpp"
#include "simulator/heater_bench.hpp"

namespace telehug {

inline constexpr std::uint64_t jacket_cycles_per_ms = 16'000;
inline constexpr std::size_t jacket_channels = 16;  // of motors
inline constexpr std::size_t jacket_outputs = 18;   // the heaters are channels 16 and 17
inline constexpr std::uint8_t first_heater_channel = 16;

// A motor's or a heater's pin changes its level.
struct PinEdge {
  std::uint64_t cycle = 0;
  std::uint8_t channel = 0;
  bool high = false;
};

class SimulatedJacket {
 public:
  using EdgeListener = std::function<void(const PinEdge&)>;

  // Throws std::runtime_error if the ELF can't be loaded.
  explicit SimulatedJacket(const std::filesystem::path& elf, const BoardWiring& board = board_wirings().front());
  ~SimulatedJacket();
  SimulatedJacket(const SimulatedJacket&) = delete;
  SimulatedJacket& operator=(const SimulatedJacket&) = delete;

  // Runs to the given number of cycles from now (a few more if an instruction straddles it). Throws std::runtime_error
  // if the firmware crashes.
  void run_cycles(std::uint64_t cycles);
  void run_ms(std::uint64_t ms) { run_cycles(ms * jacket_cycles_per_ms); }
  [[nodiscard]] std::uint64_t cycle() const;  // since power-on

  // Puts bytes on the line to the jacket, where they travel one after the other at its baud rate.
  void write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] std::size_t bytes_in_flight() const;
  // Bytes the jacket has sent since the last call.
  [[nodiscard]] std::vector<std::uint8_t> take_output();

  // Muted, bytes to the jacket get lost.
  void mute_input(bool muted);

  // Called for every change of a motor's or a heater's pin. A reset lets go of all pins: they read low.
  void on_edge(EdgeListener listener);
  [[nodiscard]] bool is_high(std::uint8_t channel) const;
  [[nodiscard]] bool armed_led() const;

  // Bytes that a real ATmega328P would have lost: its UART holds two and the one on the way; simavr's holds 64.
  [[nodiscard]] std::uint64_t uart_overruns() const;
  [[nodiscard]] std::uint64_t resets() const;  // after power-on

  // Its heaters with all that can happen to them, and its supply.
  [[nodiscard]] HeaterBench& heaters();

  // Lets the main loop spin on one place, interrupts still served, until the next reset.
  void hang_main_loop();
  // Takes the clock of the timer away, as a stray write of the firmware would.
  void stop_timer();
  // As the reset line does: when a host opens the port of many boards, or the detector of a low supply.
  void reset();

  // Bytes of RAM between the statics and the lowest that the stack has reached since power-on.
  [[nodiscard]] std::size_t untouched_ram() const;

 private:
  struct Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace telehug
