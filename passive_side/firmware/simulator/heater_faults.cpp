// SPDX-License-Identifier: Apache-2.0
#include "simulator/heater_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace telehug {
namespace {

constexpr std::array<std::pair<std::string_view, HeaterBreak>, 5> names{{{"open", HeaterBreak::open},
                                                                         {"short", HeaterBreak::shorted},
                                                                         {"detached", HeaterBreak::detached},
                                                                         {"runaway", HeaterBreak::runaway},
                                                                         {"overvoltage", HeaterBreak::overvoltage}}};
constexpr double longest_s = 1e6;

}  // namespace

HeaterFaultOption parse_heater_fault(const std::string& text) {
  HeaterFaultOption option;
  std::array<char, 16> what{};
  int end = 0;
  const int found =
      std::sscanf(text.c_str(), "%1zu:%15[a-z]%n@%lf%n", &option.heater, what.data(), &end, &option.at_s, &end);
  const auto* const name = std::ranges::find(names, std::string_view(what.data()), &decltype(names)::value_type::first);
  const bool well_formed = found >= 2 && static_cast<std::size_t>(end) == text.size();
  if (!well_formed || name == names.end() || !(option.at_s >= 0 && option.at_s <= longest_s)) {
    throw std::runtime_error("--heater-fault " + text +
                             " is not understood: write HEATER:open, short, detached, runaway or overvoltage, and "
                             "@SECONDS if it is to come later, such as 0:open@2.5");
  }
  option.what = name->second;
  return option;
}

}  // namespace telehug
