// SPDX-License-Identifier: Apache-2.0
//
// libgpiod 2. A request lives without its chip's object; the kernel debounces.
#include <fcntl.h>
#include <gpiod.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <vector>

#include "gpio/gpio_error.hpp"
#include "gpio/gpiod_chip.hpp"

namespace telehug {
namespace {

constexpr const char* consumer = "telehug-passive";

template <auto end>
struct EndWith {
  template <typename T>
  void operator()(T* object) const noexcept {
    end(object);
  }
};
using ChipHandle = std::unique_ptr<gpiod_chip, EndWith<gpiod_chip_close>>;
using ChipInfo = std::unique_ptr<gpiod_chip_info, EndWith<gpiod_chip_info_free>>;
using Settings = std::unique_ptr<gpiod_line_settings, EndWith<gpiod_line_settings_free>>;
using LineConfig = std::unique_ptr<gpiod_line_config, EndWith<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, EndWith<gpiod_request_config_free>>;
using LineRequest = std::unique_ptr<gpiod_line_request, EndWith<gpiod_line_request_release>>;
using EventBuffer = std::unique_ptr<gpiod_edge_event_buffer, EndWith<gpiod_edge_event_buffer_free>>;

// A requested line, released with this object.
struct Request {
  std::string chip;
  std::string line;
  unsigned number = 0;
  LineRequest request;

  [[nodiscard]] Error error(int code) const { return line_error(chip, line, code); }
};

class Input final : public InputLine {
 public:
  explicit Input(Request request) : request_(std::move(request)), event_(gpiod_edge_event_buffer_new(1)) {}

  [[nodiscard]] int fd() const noexcept override { return gpiod_line_request_get_fd(request_.request.get()); }

  [[nodiscard]] Result<std::optional<LevelChange>> next(Timestamp) override {
    if (!event_) return request_.error(ENOMEM);
    pollfd waiting{fd(), POLLIN, 0};
    if (poll(&waiting, 1, 0) < 0 && errno != EINTR) return request_.error(errno);
    if ((waiting.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return request_.error(ENODEV);
    if ((waiting.revents & POLLIN) == 0) return std::optional<LevelChange>();
    const int count = gpiod_line_request_read_edge_events(request_.request.get(), event_.get(), 1);
    if (count < 0) return request_.error(errno);
    if (count == 0) return std::optional<LevelChange>();
    gpiod_edge_event* event = gpiod_edge_event_buffer_get_event(event_.get(), 0);
    return std::optional(LevelChange{from_ns(static_cast<std::int64_t>(gpiod_edge_event_get_timestamp_ns(event))),
                                     gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE});
  }

  [[nodiscard]] Result<bool> level() override {
    const gpiod_line_value value = gpiod_line_request_get_value(request_.request.get(), request_.number);
    if (value == GPIOD_LINE_VALUE_ERROR) return request_.error(errno);
    return value == GPIOD_LINE_VALUE_ACTIVE;
  }

 private:
  Request request_;
  EventBuffer event_;
};

class Output final : public OutputLine {
 public:
  explicit Output(Request request) : request_(std::move(request)) {}
  ~Output() override { (void)set(false); }

  [[nodiscard]] Status set(bool active) override {
    const auto value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    if (gpiod_line_request_set_value(request_.request.get(), request_.number, value) != 0) return request_.error(errno);
    return Done{};
  }

 private:
  Request request_;
};

gpiod_line_bias bias_of(Pull pull) {
  if (pull == Pull::up) return GPIOD_LINE_BIAS_PULL_UP;
  if (pull == Pull::down) return GPIOD_LINE_BIAS_PULL_DOWN;
  return GPIOD_LINE_BIAS_AS_IS;
}

class Chip final : public GpioChip {
 public:
  Chip(std::string name, ChipHandle chip) : name_(std::move(name)), chip_(std::move(chip)) {}

  [[nodiscard]] Result<std::unique_ptr<InputLine>> input(const std::string& name,
                                                         const InputOptions& options) override {
    const Settings settings(gpiod_line_settings_new());
    if (!settings) return line_error(name_, name, ENOMEM);
    const auto debounce = std::chrono::duration_cast<std::chrono::microseconds>(options.debounce);
    if (gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT) != 0 ||
        gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH) != 0 ||
        gpiod_line_settings_set_bias(settings.get(), bias_of(options.pull)) != 0 ||
        gpiod_line_settings_set_event_clock(settings.get(), GPIOD_LINE_CLOCK_MONOTONIC) != 0) {
      return line_error(name_, name, errno);
    }
    gpiod_line_settings_set_active_low(settings.get(), options.active_low);
    gpiod_line_settings_set_debounce_period_us(settings.get(), static_cast<unsigned long>(debounce.count()));
    auto request = this->request(name, *settings);
    if (!request) return request.error();
    return std::unique_ptr<InputLine>(std::make_unique<Input>(*std::move(request)));
  }

  [[nodiscard]] Result<std::unique_ptr<OutputLine>> output(const std::string& name, bool active_low) override {
    const Settings settings(gpiod_line_settings_new());
    if (!settings) return line_error(name_, name, ENOMEM);
    if (gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_OUTPUT) != 0 ||
        gpiod_line_settings_set_output_value(settings.get(), GPIOD_LINE_VALUE_INACTIVE) != 0) {
      return line_error(name_, name, errno);
    }
    gpiod_line_settings_set_active_low(settings.get(), active_low);
    auto request = this->request(name, *settings);
    if (!request) return request.error();
    return std::unique_ptr<OutputLine>(std::make_unique<Output>(*std::move(request)));
  }

 private:
  // An output is inactive, with its polarity, from this one call on.
  Result<Request> request(const std::string& name, gpiod_line_settings& settings) {
    unsigned number = 0;
    if (const auto given = line_number(name)) {
      number = *given;
    } else {
      const int found = gpiod_chip_get_line_offset_from_name(chip_.get(), name.c_str());
      if (found < 0) return line_error(name_, name, errno);
      number = static_cast<unsigned>(found);
    }
    const LineConfig lines(gpiod_line_config_new());
    const RequestConfig config(gpiod_request_config_new());
    if (!lines || !config) return line_error(name_, name, ENOMEM);
    gpiod_request_config_set_consumer(config.get(), consumer);
    if (gpiod_line_config_add_line_settings(lines.get(), &number, 1, &settings) != 0)
      return line_error(name_, name, errno);
    LineRequest request(gpiod_chip_request_lines(chip_.get(), config.get(), lines.get()));
    if (!request) return line_error(name_, name, errno);
    return Request{name_, name, number, std::move(request)};
  }

  std::string name_;
  ChipHandle chip_;
};

// Version 2 opens paths alone.
std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code failed;
  for (std::filesystem::directory_iterator entry("/dev", failed), none; !failed && entry != none;
       entry.increment(failed))
    if (entry->path().filename().string().starts_with("gpiochip")) paths.push_back(entry->path());
  std::ranges::sort(paths);
  return paths;
}

std::string path_of(const std::string& name) {
  if (name.starts_with('/')) return name;
  if (const auto number = line_number(name)) return "/dev/gpiochip" + name;
  for (const std::string& path : chip_paths()) {
    if (path == "/dev/" + name) return path;
    const ChipHandle chip(gpiod_chip_open(path.c_str()));
    if (!chip) continue;
    const ChipInfo info(gpiod_chip_get_info(chip.get()));
    if (info && (name == gpiod_chip_info_get_label(info.get()) || name == gpiod_chip_info_get_name(info.get())))
      return path;
  }
  return "/dev/" + name;
}

}  // namespace

Result<std::unique_ptr<GpioChip>> open_gpiod_chip(const std::string& name) {
  ChipHandle chip(gpiod_chip_open(path_of(name).c_str()));
  if (!chip) return chip_error(name, errno);
  return std::unique_ptr<GpioChip>(std::make_unique<Chip>(name, std::move(chip)));
}

}  // namespace telehug
