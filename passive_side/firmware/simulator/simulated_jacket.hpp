// SPDX-License-Identifier: Apache-2.0
//
// The jacket's real firmware in a simulated ATmega328P, in virtual time: deterministic, some 50 times faster than real.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace telehug {

inline constexpr std::uint64_t jacket_cycles_per_ms = 16'000;
inline constexpr std::size_t jacket_channels = 16;

// A motor's pin changes its level.
struct PinEdge {
  std::uint64_t cycle = 0;
  std::uint8_t channel = 0;
  bool high = false;
};

class SimulatedJacket {
 public:
  using EdgeListener = std::function<void(const PinEdge&)>;

  // Throws std::runtime_error if the ELF can't be loaded.
  explicit SimulatedJacket(const std::filesystem::path& elf);
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

  // Called for every change of a motor's pin. A reset lets go of all pins: they read low.
  void on_edge(EdgeListener listener);
  [[nodiscard]] bool is_high(std::uint8_t channel) const;
  [[nodiscard]] bool armed_led() const;

  // Bytes that a real ATmega328P would have lost: its UART holds two and the one on the way; simavr's holds 64.
  [[nodiscard]] std::uint64_t uart_overruns() const;
  [[nodiscard]] std::uint64_t resets() const;  // after power-on

  // Lets the main loop spin on one place, interrupts still served, until the next reset.
  void hang_main_loop();

 private:
  struct Machine;
  std::unique_ptr<Machine> machine_;
};

}  // namespace telehug
