// SPDX-License-Identifier: Apache-2.0
//
// A GPIO chip of the kernel, as it is seen through libgpiod, whose functions fake_gpiod_v1.cpp and fake_gpiod_v2.cpp
// implement over it: "gpiochip0" ("/dev/gpiochip0", label "fakechip") with four lines, "line0" to "line3".
#pragma once

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace telehug {

struct FakeEdge {
  bool rising = false;  // to active
  std::int64_t time_ns = 0;
};

struct FakeLine {
  std::string consumer;  // empty: nobody has requested it
  bool output = false;
  bool active_low = false;
  bool both_edges = false;
  int pull = 0;  // 1 up, -1 down
  unsigned long debounce_us = 0;
  bool high = false;
  std::vector<bool> driven;  // levels, high or not, since the request
  std::deque<FakeEdge> edges;
  std::array<int, 2> pipe{-1, -1};
};

class FakeGpioKernel {
 public:
  static constexpr const char* path = "/dev/gpiochip0";

  static FakeGpioKernel& get() {
    static FakeGpioKernel kernel;
    return kernel;
  }

  std::array<FakeLine, 4> lines;
  int open_error = 0;     // an errno
  int request_error = 0;  // likewise
  bool gone = false;      // the chip was pulled out
  int open_chips = 0;     // objects of the library

  void reset() {
    for (FakeLine& line : lines)
      release(line);
    lines = {};
    open_error = request_error = 0;
    gone = false;
  }

  [[nodiscard]] static std::optional<unsigned> find(const std::string& name) {
    for (unsigned i = 0; i < 4; ++i)
      if (name == "line" + std::to_string(i)) return i;
    return std::nullopt;
  }

  // What every request does; false with errno.
  bool request(unsigned number, const FakeLine& wanted, bool active) {
    if (number >= lines.size()) return fail(EINVAL);
    FakeLine& line = lines[number];
    if (gone) return fail(ENODEV);
    if (!line.consumer.empty()) return fail(EBUSY);
    if (request_error != 0) return fail(request_error);
    const bool was_high = line.high;
    line = wanted;
    line.high = was_high;
    if (line.output) drive(line, active);
    return ::pipe(line.pipe.data()) == 0;
  }
  static void release(FakeLine& line) {
    for (int& end : line.pipe) {
      if (end >= 0) ::close(end);
      end = -1;
    }
    line.consumer.clear();
  }
  static void drive(FakeLine& line, bool active) {
    line.high = active != line.active_low;
    line.driven.push_back(line.high);
  }

  // Somebody moves the wire of an input.
  void move(unsigned number, bool high, std::int64_t time_ns) {
    FakeLine& line = lines[number];
    line.high = high;
    line.edges.push_back({high != line.active_low, time_ns});
    if (::write(line.pipe[1], "e", 1) != 1) ::abort();
  }
  static FakeEdge take(FakeLine& line) {
    char byte = 0;
    if (::read(line.pipe[0], &byte, 1) != 1) ::abort();
    const FakeEdge edge = line.edges.front();
    line.edges.pop_front();
    return edge;
  }

  static bool fail(int error) {
    errno = error;
    return false;
  }
};

}  // namespace telehug
