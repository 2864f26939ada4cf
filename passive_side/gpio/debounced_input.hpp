// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "gpio/debouncer.hpp"
#include "gpio/line.hpp"

namespace telehug {

// Debounces a line whose chip does not.
class DebouncedInput final : public InputLine {
 public:
  // active: the level at this moment.
  DebouncedInput(std::unique_ptr<InputLine> line, Duration settle, bool active)
      : line_(std::move(line)), debouncer_(settle, active), told_(active) {}

  [[nodiscard]] int fd() const noexcept override { return line_->fd(); }
  [[nodiscard]] std::optional<Timestamp> due() const noexcept override { return debouncer_.due(); }

  [[nodiscard]] Result<std::optional<LevelChange>> next(Timestamp now) override {
    for (;;) {
      auto change = line_->next(now);
      if (!change) return change;
      // What settled before this change is told first; the change itself is not forgotten.
      if (*change) {
        const auto settles = debouncer_.due();
        debouncer_.level((*change)->active, (*change)->time);
        if (debouncer_.active() != told_) return tell(settles.value_or((*change)->time));
        continue;
      }
      const auto settles = debouncer_.due();
      debouncer_.advance(now);
      if (debouncer_.active() != told_) return tell(settles.value_or(now));
      return std::optional<LevelChange>();
    }
  }

  [[nodiscard]] Result<bool> level() override {
    const auto raw = line_->level();  // is the line still there?
    if (!raw) return raw;
    return told_;
  }

 private:
  std::optional<LevelChange> tell(Timestamp time) {
    told_ = debouncer_.active();
    return LevelChange{time, told_};
  }

  std::unique_ptr<InputLine> line_;
  Debouncer debouncer_;
  bool told_;
};

}  // namespace telehug
