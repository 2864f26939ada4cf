// SPDX-License-Identifier: Apache-2.0
//
// A programmer on a serial port with an ATmega328P at its other end, as avrdude's stk500v1 sees it: the commands of
// Atmel's application note AVR061 (STK500 Communication Protocol), and the chip's serial programming instructions (data
// sheet, "Serial Programming Instruction Set").
#pragma once

#include <poll.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "simulator/pty_bridge.hpp"

namespace telehug {

struct ProgrammedChip {
  std::array<std::uint8_t, 3> fuses{};  // low, high, extended
  bool takes_fuses = true;
  std::vector<std::uint8_t> flash = std::vector<std::uint8_t>(32768, 0xFF);
  std::vector<std::array<std::uint8_t, 2>> fuse_writes = {};  // which, value; in their order
  bool was_erased = false;
};

class IspProgrammer {
 public:
  explicit IspProgrammer(ProgrammedChip chip) : chip_(std::move(chip)), thread_([this] { run(); }) {}
  ~IspProgrammer() {
    ends_ = true;
    thread_.join();
  }
  IspProgrammer(const IspProgrammer&) = delete;
  IspProgrammer& operator=(const IspProgrammer&) = delete;

  [[nodiscard]] const std::string& port() const { return pty_.path(); }
  [[nodiscard]] ProgrammedChip chip() {
    const std::lock_guard lock(mutex_);
    return chip_;
  }

 private:
  using Bytes = std::vector<std::uint8_t>;
  static constexpr std::uint8_t in_sync = 0x14;
  static constexpr std::uint8_t ok = 0x10;
  static constexpr std::uint8_t end_of_packet = 0x20;

  void run() {
    while (!ends_) {
      pollfd readable{pty_.fd(), POLLIN, 0};
      poll(&readable, 1, 20);
      for (const std::uint8_t byte : pty_.read())
        request_.push_back(byte);
      while (const auto size = size_of_request()) {
        if (request_.size() < *size) break;
        const Bytes request(request_.begin(), request_.begin() + static_cast<std::ptrdiff_t>(*size));
        request_.erase(request_.begin(), request_.begin() + static_cast<std::ptrdiff_t>(*size));
        const std::lock_guard lock(mutex_);
        Bytes answer{in_sync};
        const Bytes content = content_of_answer(request);
        answer.insert(answer.end(), content.begin(), content.end());
        answer.push_back(ok);
        pty_.write(answer);
      }
    }
  }

  // With the end of packet; nothing if the request is too short to tell.
  [[nodiscard]] std::optional<std::size_t> size_of_request() const {
    if (request_.empty()) return std::nullopt;
    switch (request_[0]) {
      case 'A':
        return 3;
      case 'B':
        return 22;
      case 'E':
        return 7;
      case 'U':
        return 4;
      case 'V':
        return 6;
      case 't':
        return 5;
      case 'd':
        if (request_.size() < 4) return std::nullopt;
        return 5 + std::size_t{256} * request_[1] + request_[2];
      default:
        return 2;
    }
  }

  Bytes content_of_answer(const Bytes& request) {
    switch (request[0]) {
      case 'A':  // parameters: of a programmer that is no bootloader
        return {static_cast<std::uint8_t>(request[1] == 0x81 ? 1 : request[1] == 0x82 ? 18 : 2)};
      case 'U':
        address_ = std::size_t{2} * (request[1] + 256U * request[2]);
        return {};
      case 'V':
        return {instruction(request[1], request[2], request[3], request[4])};
      case 'd': {
        const std::size_t size = request.size() - 5;
        for (std::size_t i = 0; i < size; ++i)
          chip_.flash.at(address_ + i) = request[4 + i];
        return {};
      }
      case 't': {
        const auto begin = chip_.flash.begin() + static_cast<std::ptrdiff_t>(address_);
        return {begin, begin + std::ptrdiff_t{256} * request[1] + request[2]};
      }
      case 'u':
        return {0x1E, 0x95, 0x0F};
      default:
        return {};
    }
  }

  // The last byte that the chip sends back.
  std::uint8_t instruction(std::uint8_t first, std::uint8_t second, std::uint8_t third, std::uint8_t fourth) {
    constexpr std::array<std::uint8_t, 3> signature{0x1E, 0x95, 0x0F};
    const auto word = static_cast<unsigned>(first << 8U | second);
    switch (word) {
      case 0x3000:
        return signature.at(third & 3U);
      case 0x5000:
        return chip_.fuses[0];
      case 0x5808:
        return chip_.fuses[1];
      case 0x5008:
        return chip_.fuses[2];
      case 0xACA0:
        return write_fuse(0, fourth);
      case 0xACA8:
        return write_fuse(1, fourth);
      case 0xACA4:
        return write_fuse(2, fourth);
      case 0xAC80:
        chip_.was_erased = true;
        std::fill(chip_.flash.begin(), chip_.flash.end(), 0xFF);
        return 0;
      default:
        return 0;
    }
  }

  std::uint8_t write_fuse(std::uint8_t which, std::uint8_t value) {
    chip_.fuse_writes.push_back({which, value});
    if (chip_.takes_fuses) chip_.fuses.at(which) = value;
    return 0;
  }

  PtyBridge pty_{{}};
  std::mutex mutex_;  // over the chip
  ProgrammedChip chip_;
  std::deque<std::uint8_t> request_;
  std::size_t address_ = 0;  // in bytes
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace telehug
