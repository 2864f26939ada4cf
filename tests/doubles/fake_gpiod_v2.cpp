// SPDX-License-Identifier: Apache-2.0
//
// What telehug uses of libgpiod 2, over a fake kernel; linked in place of the library.
#include <gpiod.h>

#include "doubles/fake_gpio_kernel.hpp"

using telehug::FakeEdge;
using telehug::FakeGpioKernel;
using telehug::FakeLine;

struct gpiod_chip {};
struct gpiod_chip_info {};
struct gpiod_line_settings {
  FakeLine line;
  bool active = false;
};
struct gpiod_line_config {
  unsigned number = 0;
  gpiod_line_settings settings;
};
struct gpiod_request_config {
  std::string consumer;
};
struct gpiod_line_request {
  unsigned number = 0;
};
struct gpiod_edge_event {
  FakeEdge edge;
};
struct gpiod_edge_event_buffer {
  gpiod_edge_event event;
};

namespace {
FakeLine& of(const gpiod_line_request* request) {
  return FakeGpioKernel::get().lines[request->number];
}
int refuse() {
  errno = EINVAL;
  return -1;
}
}  // namespace

gpiod_chip* gpiod_chip_open(const char* path) {
  FakeGpioKernel& kernel = FakeGpioKernel::get();
  const bool known = std::string(path) == FakeGpioKernel::path;
  if (!known || kernel.open_error != 0) {
    errno = known ? kernel.open_error : ENOENT;
    return nullptr;
  }
  ++kernel.open_chips;
  return new gpiod_chip;
}
void gpiod_chip_close(gpiod_chip* chip) {
  --FakeGpioKernel::get().open_chips;
  delete chip;
}
gpiod_chip_info* gpiod_chip_get_info(gpiod_chip*) {
  return new gpiod_chip_info;
}
void gpiod_chip_info_free(gpiod_chip_info* info) {
  delete info;
}
const char* gpiod_chip_info_get_name(gpiod_chip_info*) {
  return "gpiochip0";
}
const char* gpiod_chip_info_get_label(gpiod_chip_info*) {
  return "fakechip";
}
int gpiod_chip_get_line_offset_from_name(gpiod_chip*, const char* name) {
  if (const auto number = FakeGpioKernel::find(name)) return static_cast<int>(*number);
  errno = ENOENT;
  return -1;
}
gpiod_line_request* gpiod_chip_request_lines(gpiod_chip*, gpiod_request_config* config, gpiod_line_config* lines) {
  FakeLine wanted = lines->settings.line;
  wanted.consumer = config->consumer;
  if (!FakeGpioKernel::get().request(lines->number, wanted, lines->settings.active)) return nullptr;
  return new gpiod_line_request{lines->number};
}

gpiod_line_settings* gpiod_line_settings_new() {
  return new gpiod_line_settings;
}
void gpiod_line_settings_free(gpiod_line_settings* settings) {
  delete settings;
}
int gpiod_line_settings_set_direction(gpiod_line_settings* settings, gpiod_line_direction direction) {
  settings->line.output = direction == GPIOD_LINE_DIRECTION_OUTPUT;
  return 0;
}
int gpiod_line_settings_set_edge_detection(gpiod_line_settings* settings, gpiod_line_edge edge) {
  settings->line.both_edges = edge == GPIOD_LINE_EDGE_BOTH;
  return 0;
}
int gpiod_line_settings_set_bias(gpiod_line_settings* settings, gpiod_line_bias bias) {
  if (bias == GPIOD_LINE_BIAS_UNKNOWN) return refuse();
  settings->line.pull = bias == GPIOD_LINE_BIAS_PULL_UP ? 1 : bias == GPIOD_LINE_BIAS_PULL_DOWN ? -1 : 0;
  return 0;
}
void gpiod_line_settings_set_active_low(gpiod_line_settings* settings, bool active_low) {
  settings->line.active_low = active_low;
}
void gpiod_line_settings_set_debounce_period_us(gpiod_line_settings* settings, unsigned long period_us) {
  settings->line.debounce_us = period_us;
}
int gpiod_line_settings_set_event_clock(gpiod_line_settings*, gpiod_line_clock clock) {
  return clock == GPIOD_LINE_CLOCK_MONOTONIC ? 0 : refuse();
}
int gpiod_line_settings_set_output_value(gpiod_line_settings* settings, gpiod_line_value value) {
  settings->active = value == GPIOD_LINE_VALUE_ACTIVE;
  return 0;
}

gpiod_line_config* gpiod_line_config_new() {
  return new gpiod_line_config;
}
void gpiod_line_config_free(gpiod_line_config* config) {
  delete config;
}
int gpiod_line_config_add_line_settings(gpiod_line_config* config, const unsigned* offsets, std::size_t count,
                                        gpiod_line_settings* settings) {
  if (count != 1) return refuse();
  config->number = *offsets;
  config->settings = *settings;
  return 0;
}
gpiod_request_config* gpiod_request_config_new() {
  return new gpiod_request_config;
}
void gpiod_request_config_free(gpiod_request_config* config) {
  delete config;
}
void gpiod_request_config_set_consumer(gpiod_request_config* config, const char* consumer) {
  config->consumer = consumer;
}

void gpiod_line_request_release(gpiod_line_request* request) {
  FakeGpioKernel::release(of(request));
  delete request;
}
gpiod_line_value gpiod_line_request_get_value(gpiod_line_request* request, unsigned number) {
  if (number != request->number && refuse() != 0) return GPIOD_LINE_VALUE_ERROR;
  if (FakeGpioKernel::get().gone && !FakeGpioKernel::fail(ENODEV)) return GPIOD_LINE_VALUE_ERROR;
  return of(request).high != of(request).active_low ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}
int gpiod_line_request_set_value(gpiod_line_request* request, unsigned number, gpiod_line_value value) {
  if (number != request->number) return refuse();
  if (FakeGpioKernel::get().gone && !FakeGpioKernel::fail(ENODEV)) return -1;
  FakeGpioKernel::drive(of(request), value == GPIOD_LINE_VALUE_ACTIVE);
  return 0;
}
int gpiod_line_request_get_fd(gpiod_line_request* request) {
  return of(request).pipe[0];
}
int gpiod_line_request_read_edge_events(gpiod_line_request* request, gpiod_edge_event_buffer* buffer,
                                        std::size_t most) {
  if (most != 1) return refuse();
  buffer->event = {FakeGpioKernel::take(of(request))};
  return 1;
}

gpiod_edge_event_buffer* gpiod_edge_event_buffer_new(std::size_t) {
  return new gpiod_edge_event_buffer;
}
void gpiod_edge_event_buffer_free(gpiod_edge_event_buffer* buffer) {
  delete buffer;
}
gpiod_edge_event* gpiod_edge_event_buffer_get_event(gpiod_edge_event_buffer* buffer, unsigned long) {
  return &buffer->event;
}
gpiod_edge_event_type gpiod_edge_event_get_event_type(gpiod_edge_event* event) {
  return event->edge.rising ? GPIOD_EDGE_EVENT_RISING_EDGE : GPIOD_EDGE_EVENT_FALLING_EDGE;
}
std::uint64_t gpiod_edge_event_get_timestamp_ns(gpiod_edge_event* event) {
  return static_cast<std::uint64_t>(event->edge.time_ns);
}
