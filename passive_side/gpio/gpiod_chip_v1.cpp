// SPDX-License-Identifier: Apache-2.0
//
// libgpiod 1.6. A line belongs to its chip's object, which ends with the last of its lines.
#include <gpiod.h>
#include <poll.h>

#include <cerrno>

#include "gpio/debounced_input.hpp"
#include "gpio/gpio_error.hpp"
#include "gpio/gpiod_chip.hpp"

namespace telehug {
namespace {

constexpr const char* consumer = "telehug-passive";

struct CloseChip {
  void operator()(gpiod_chip* chip) const noexcept { gpiod_chip_close(chip); }
};

struct OpenedChip {
  std::string name;
  std::unique_ptr<gpiod_chip, CloseChip> chip;
};

// A requested line, released with this object.
class Request {
 public:
  Request(std::shared_ptr<OpenedChip> chip, std::string name, gpiod_line* line)
      : chip_(std::move(chip)), name_(std::move(name)), line_(line) {}
  ~Request() { gpiod_line_release(line_); }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  [[nodiscard]] gpiod_line* line() const noexcept { return line_; }
  [[nodiscard]] Error error(int code) const { return line_error(chip_->name, name_, code); }

 private:
  std::shared_ptr<OpenedChip> chip_;
  std::string name_;
  gpiod_line* line_;
};

class Input final : public InputLine {
 public:
  explicit Input(std::unique_ptr<Request> request)
      : request_(std::move(request)), fd_(gpiod_line_event_get_fd(request_->line())) {}

  [[nodiscard]] int fd() const noexcept override { return fd_; }

  [[nodiscard]] Result<std::optional<LevelChange>> next(Timestamp) override {
    pollfd waiting{fd_, POLLIN, 0};
    if (poll(&waiting, 1, 0) < 0 && errno != EINTR) return request_->error(errno);
    if ((waiting.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return request_->error(ENODEV);
    if ((waiting.revents & POLLIN) == 0) return std::optional<LevelChange>();
    gpiod_line_event event{};
    if (gpiod_line_event_read(request_->line(), &event) != 0) return request_->error(errno);
    const auto time = std::chrono::seconds(event.ts.tv_sec) + std::chrono::nanoseconds(event.ts.tv_nsec);
    return std::optional(
        LevelChange{from_ns(std::chrono::nanoseconds(time).count()), event.event_type == GPIOD_LINE_EVENT_RISING_EDGE});
  }

  [[nodiscard]] Result<bool> level() override {
    const int value = gpiod_line_get_value(request_->line());
    if (value < 0) return request_->error(errno);
    return value == 1;
  }

 private:
  std::unique_ptr<Request> request_;
  int fd_;
};

class Output final : public OutputLine {
 public:
  explicit Output(std::unique_ptr<Request> request) : request_(std::move(request)) {}
  ~Output() override { (void)gpiod_line_set_value(request_->line(), 0); }

  [[nodiscard]] Status set(bool active) override {
    if (gpiod_line_set_value(request_->line(), active ? 1 : 0) != 0) return request_->error(errno);
    return Done{};
  }

 private:
  std::unique_ptr<Request> request_;
};

int flags_of(bool active_low, Pull pull) {
  int flags = active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  if (pull == Pull::up) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  if (pull == Pull::down) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
  return flags;
}

class Chip final : public GpioChip {
 public:
  explicit Chip(std::shared_ptr<OpenedChip> chip) : chip_(std::move(chip)) {}

  [[nodiscard]] Result<std::unique_ptr<InputLine>> input(const std::string& name,
                                                         const InputOptions& options) override {
    auto request = this->request(name, GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES, flags_of(options.active_low, options.pull));
    if (!request) return request.error();
    std::unique_ptr<InputLine> line = std::make_unique<Input>(*std::move(request));
    if (options.debounce == Duration::zero()) return line;
    const auto level = line->level();
    if (!level) return level.error();
    return std::unique_ptr<InputLine>(std::make_unique<DebouncedInput>(std::move(line), options.debounce, *level));
  }

  [[nodiscard]] Result<std::unique_ptr<OutputLine>> output(const std::string& name, bool active_low) override {
    auto request = this->request(name, GPIOD_LINE_REQUEST_DIRECTION_OUTPUT, flags_of(active_low, Pull::none));
    if (!request) return request.error();
    return std::unique_ptr<OutputLine>(std::make_unique<Output>(*std::move(request)));
  }

 private:
  // An output is inactive, with its polarity, from this one call on.
  Result<std::unique_ptr<Request>> request(const std::string& name, int type, int flags) {
    const auto number = line_number(name);
    gpiod_line* line = number ? gpiod_chip_get_line(chip_->chip.get(), *number)
                              : gpiod_chip_find_line(chip_->chip.get(), name.c_str());
    if (line == nullptr) return line_error(chip_->name, name, errno);
    const gpiod_line_request_config config{consumer, type, flags};
    if (gpiod_line_request(line, &config, 0) != 0) return line_error(chip_->name, name, errno);
    return std::make_unique<Request>(chip_, name, line);
  }

  std::shared_ptr<OpenedChip> chip_;
};

}  // namespace

Result<std::unique_ptr<GpioChip>> open_gpiod_chip(const std::string& name) {
  // The look-up says "not found" for a path that may not be opened.
  gpiod_chip* chip = name.starts_with('/') ? gpiod_chip_open(name.c_str()) : gpiod_chip_open_lookup(name.c_str());
  if (chip == nullptr) return chip_error(name, errno);
  auto opened = std::make_shared<OpenedChip>();
  opened->name = name;
  opened->chip.reset(chip);
  return std::unique_ptr<GpioChip>(std::make_unique<Chip>(std::move(opened)));
}

}  // namespace telehug
