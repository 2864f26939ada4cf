// SPDX-License-Identifier: Apache-2.0
//
// What telehug uses of libgpiod 1.6, over a fake kernel; linked in place of the library.
#include <gpiod.h>

#include <map>
#include <string>

#include "doubles/fake_gpio_kernel.hpp"

using telehug::FakeGpioKernel;
using telehug::FakeLine;

struct gpiod_line {
  unsigned number;
};
struct gpiod_chip {
  std::array<gpiod_line, 4> lines{{{0}, {1}, {2}, {3}}};
};

namespace {
FakeLine& of(const gpiod_line* line) {
  return FakeGpioKernel::get().lines[line->number];
}
gpiod_chip* open_if(bool known) {
  FakeGpioKernel& kernel = FakeGpioKernel::get();
  if (!known || kernel.open_error != 0) {
    errno = known ? kernel.open_error : ENOENT;
    return nullptr;
  }
  ++kernel.open_chips;
  return new gpiod_chip;
}
}  // namespace

gpiod_chip* gpiod_chip_open(const char* path) {
  return open_if(std::string(path) == FakeGpioKernel::path);
}
gpiod_chip* gpiod_chip_open_lookup(const char* name) {
  return open_if(std::string(name) == "gpiochip0" || std::string(name) == "fakechip");
}
void gpiod_chip_close(gpiod_chip* chip) {
  for (const gpiod_line& line : chip->lines)
    FakeGpioKernel::release(of(&line));
  --FakeGpioKernel::get().open_chips;
  delete chip;
}
gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned number) {
  if (number < chip->lines.size()) return &chip->lines[number];
  errno = EINVAL;
  return nullptr;
}
gpiod_line* gpiod_chip_find_line(gpiod_chip* chip, const char* name) {
  if (const auto number = FakeGpioKernel::find(name)) return &chip->lines[*number];
  errno = ENOENT;
  return nullptr;
}
int gpiod_line_request(gpiod_line* line, const gpiod_line_request_config* config, int value) {
  FakeLine wanted;
  wanted.consumer = config->consumer;
  wanted.output = config->request_type == GPIOD_LINE_REQUEST_DIRECTION_OUTPUT;
  wanted.both_edges = config->request_type == GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES;
  wanted.active_low = (config->flags & GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) != 0;
  wanted.pull = (config->flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP) != 0     ? 1
                : (config->flags & GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN) != 0 ? -1
                                                                                : 0;
  return FakeGpioKernel::get().request(line->number, wanted, value != 0) ? 0 : -1;
}
void gpiod_line_release(gpiod_line* line) {
  FakeGpioKernel::release(of(line));
}
int gpiod_line_get_value(gpiod_line* line) {
  if (FakeGpioKernel::get().gone && !FakeGpioKernel::fail(ENODEV)) return -1;
  return of(line).high != of(line).active_low ? 1 : 0;
}
int gpiod_line_set_value(gpiod_line* line, int value) {
  if (FakeGpioKernel::get().gone && !FakeGpioKernel::fail(ENODEV)) return -1;
  FakeGpioKernel::drive(of(line), value != 0);
  return 0;
}
int gpiod_line_event_get_fd(gpiod_line* line) {
  return of(line).pipe[0];
}
int gpiod_line_event_read(gpiod_line* line, gpiod_line_event* event) {
  const auto edge = FakeGpioKernel::take(of(line));
  event->ts = {edge.time_ns / 1'000'000'000, edge.time_ns % 1'000'000'000};
  event->event_type = edge.rising ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
  return 0;
}
