// SPDX-License-Identifier: Apache-2.0
//
// An Arduino board that can be written to: a simulated ATmega with a real bootloader in its flash, behind a pseudo
// terminal, in real time.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace telehug {

struct BoardOptions {
  std::string chip = "atmega328p";   // as simavr names it
  std::filesystem::path bootloader;  // Intel hex
  // A cell of the flash that always reads 0xFF.
  std::optional<std::uint32_t> worn_cell;
};

// A pseudo terminal has no DTR, which resets a real board when its port is opened; here the setting of a speed does, as
// avrdude sets it just before. Bytes at another speed than the chip's arrive as other bytes.
class SimulatedBoard {
 public:
  // Throws std::runtime_error if there is no such chip or bootloader.
  explicit SimulatedBoard(BoardOptions options);
  ~SimulatedBoard();
  SimulatedBoard(const SimulatedBoard&) = delete;
  SimulatedBoard& operator=(const SimulatedBoard&) = delete;

  [[nodiscard]] std::string port() const;
  // `size` bytes from address 0.
  [[nodiscard]] std::vector<std::uint8_t> flash(std::size_t size);

 private:
  struct Chip;
  void run();

  std::mutex mutex_;  // over the chip
  std::unique_ptr<Chip> chip_;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace telehug
