// SPDX-License-Identifier: Apache-2.0
//
// Lines of a GPIO chip as telehug uses them: a level that is watched, a level that is set. What "active" is in volts is
// settled when the line is requested; from then on nobody speaks of volts. Each of these is one thread's at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/clock.hpp"
#include "common/result.hpp"

namespace telehug {

// The resistor inside the chip, where it has one.
enum class Pull { none, up, down };

struct InputOptions {
  bool active_low = false;
  Pull pull = Pull::none;
  Duration debounce{};  // a level counts after it has been stable for so long; 0: at once
};

struct LevelChange {
  Timestamp time;
  bool active = false;
};

// An error of these means that the line is lost: the chip is gone.
class InputLine {
 public:
  InputLine() = default;
  virtual ~InputLine() = default;
  InputLine(const InputLine&) = delete;
  InputLine& operator=(const InputLine&) = delete;

  // Readable (poll(2)) when next() has something to tell. It is not to be read by anybody else.
  [[nodiscard]] virtual int fd() const noexcept = 0;
  // When next() may have something to tell although nothing is readable.
  [[nodiscard]] virtual std::optional<Timestamp> due() const noexcept { return std::nullopt; }
  // The next change that has not been told yet, without waiting. Changes may be lost when many come at once: level()
  // tells how things stand.
  [[nodiscard]] virtual Result<std::optional<LevelChange>> next(Timestamp now) = 0;
  // Is it active now?
  [[nodiscard]] virtual Result<bool> level() = 0;
};

// Inactive from the request on. When it is destroyed nobody drives the line any more: a resistor must pull it to the
// level that is safe.
class OutputLine {
 public:
  OutputLine() = default;
  virtual ~OutputLine() = default;
  OutputLine(const OutputLine&) = delete;
  OutputLine& operator=(const OutputLine&) = delete;

  [[nodiscard]] virtual Status set(bool active) = 0;
};

// A line is named by its number on the chip ("17") or by its name ("GPIO17"). Lines outlive their chip.
class GpioChip {
 public:
  GpioChip() = default;
  virtual ~GpioChip() = default;
  GpioChip(const GpioChip&) = delete;
  GpioChip& operator=(const GpioChip&) = delete;

  [[nodiscard]] virtual Result<std::unique_ptr<InputLine>> input(const std::string& line,
                                                                 const InputOptions& options) = 0;
  [[nodiscard]] virtual Result<std::unique_ptr<OutputLine>> output(const std::string& line, bool active_low) = 0;
};

// `name`: a chip's path, name or label ("/dev/gpiochip0", "gpiochip0", "pinctrl-bcm2711"), or "simulated:DIR".
[[nodiscard]] Result<std::unique_ptr<GpioChip>> open_chip(const std::string& name);

}  // namespace telehug
