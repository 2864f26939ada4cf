// SPDX-License-Identifier: Apache-2.0
#include "gpio/panel_lines.hpp"

namespace telehug {
namespace {

// What is wanted of a chip: nothing if it isn't.
template <typename Line, typename Ask>
Result<std::unique_ptr<Line>> wanted(const PanelOptions::Wire& wire, Ask ask) {
  if (wire.line.empty()) return std::unique_ptr<Line>();
  return ask(wire);
}

template <typename Line>
std::unique_ptr<Line> or_missing(Result<std::unique_ptr<Line>> line, const char* what,
                                 std::vector<std::string>& missing) {
  if (line) return *std::move(line);
  missing.push_back(std::string(what) + " does not work: " + line.error().message);
  return nullptr;
}

Error without(const char* what, const Error& why) {
  return {std::string("the jacket is not driven without ") + what + ": " + why.message};
}

}  // namespace

Result<PanelLines> request_lines(const PanelOptions& options) {
  PanelLines lines;
  if (options.chip.empty()) return lines;
  const bool needed = !options.stop_button.line.empty() || !options.power.line.empty();
  auto chip = open_chip(options.chip);
  if (!chip && needed) return without("its stop button and power line", chip.error());
  if (!chip) {
    lines.missing.push_back("the lines of [gpio] do not work: " + chip.error().message);
    return lines;
  }
  const auto input = [&](Duration debounce) {
    return [&chip, &options, debounce](const PanelOptions::Wire& wire) {
      return (*chip)->input(wire.line,
                            {.active_low = wire.active_low, .pull = options.button_pull, .debounce = debounce});
    };
  };
  const auto output = [&](const PanelOptions::Wire& wire) { return (*chip)->output(wire.line, wire.active_low); };

  auto power = wanted<OutputLine>(options.power, output);
  if (!power) return without("its power line", power.error());
  lines.power = *std::move(power);
  auto stop_button = wanted<InputLine>(options.stop_button, input(Duration::zero()));
  if (!stop_button) return without("its stop button", stop_button.error());
  lines.stop_button = *std::move(stop_button);
  lines.hug_button =
      or_missing(wanted<InputLine>(options.hug_button, input(options.debounce)), "the hug button", lines.missing);
  lines.light = or_missing(wanted<OutputLine>(options.light, output), "the status light", lines.missing);
  return lines;
}

}  // namespace telehug
