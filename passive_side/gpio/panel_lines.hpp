// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpio/line.hpp"

namespace telehug {

// Which lines there are, and how they are wired; an empty name: there is none.
struct PanelOptions {
  struct Wire {
    std::string line;
    bool active_low = false;
  };
  std::string chip;  // as open_chip() has it; empty: no lines at all
  Wire stop_button;
  Wire hug_button;
  Wire power;
  Wire light;
  Pull button_pull = Pull::up;
  Duration debounce = 10ms;
  Duration hold_to_resume = 5s;
};

// The requested lines; null: there is none. Both outputs are inactive.
struct PanelLines {
  std::unique_ptr<InputLine> stop_button;  // as it is, bouncing
  std::unique_ptr<InputLine> hug_button;   // debounced
  std::unique_ptr<OutputLine> power;
  std::unique_ptr<OutputLine> light;
  std::vector<std::string> missing;  // sentences: the lines that are wanted, but that one can do without
};

// Safety does not wait for a cable to be found: without the wanted stop button or power line there is an error. Without
// the hug button or the light the jacket works.
[[nodiscard]] Result<PanelLines> request_lines(const PanelOptions& options);

}  // namespace telehug
