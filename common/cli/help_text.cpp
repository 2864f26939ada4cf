// SPDX-License-Identifier: Apache-2.0
#include "cli/help_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "service/exit_code_text.hpp"

namespace telehug {

std::string examples_text(const std::vector<Example>& examples) {
  constexpr std::size_t widest = 48;  // a longer line has its meaning below it
  std::size_t width = 0;
  for (const Example& example : examples)
    if (example.line.size() <= widest) width = std::max(width, example.line.size());
  std::string text = "Examples:";
  for (const Example& example : examples) {
    if (example.meaning.empty()) {
      text += fmt::format("\n  {}", example.line);
    } else if (example.line.size() <= widest) {
      text += fmt::format("\n  {:<{}}  {}", example.line, width, example.meaning);
    } else {
      text += fmt::format("\n  {}\n      {}", example.line, example.meaning);
    }
  }
  return text;
}

std::string exit_codes_text(const std::vector<ExitCode>& codes) {
  std::string text = "Exit codes:";
  for (const ExitCode code : codes)
    text += fmt::format("\n  {:>2}  {}", to_int(code), exit_code_text(code));
  return text;
}

}  // namespace telehug
