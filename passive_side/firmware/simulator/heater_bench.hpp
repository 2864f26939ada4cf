// SPDX-License-Identifier: Apache-2.0
//
// The heaters of the simulated jacket: closes the loop from the microcontroller's pins over the pads back to its ADC.
#pragma once

#include <cstdint>
#include <vector>

#include "simulator/board_wiring.hpp"
#include "simulator/heated_patch.hpp"

struct avr_t;

namespace telehug {

class HeaterBench {
 public:
  HeaterBench(avr_t* avr, const BoardWiring& board);
  HeaterBench(const HeaterBench&) = delete;
  HeaterBench& operator=(const HeaterBench&) = delete;

  // Of the microcontroller and of the dividers.
  void set_supply_mv(unsigned supply_mv);

  // The levels of the heaters' pins, from now on.
  void set_transistor(std::size_t heater, bool high);
  void set_supply_transistor(bool high);

  void break_at(std::uint64_t cycle, std::size_t heater, HeaterBreak what);
  // The next samples of a thermistor are this instead: a disturbance.
  void disturb(std::size_t heater, unsigned millivolts, unsigned samples);

  // As it is now.
  [[nodiscard]] HeatedPatch& patch(std::size_t heater);
  [[nodiscard]] std::size_t size() const { return patches_.size(); }

 private:
  struct Patch {
    HeatedPatch physics;
    std::uint8_t input = 0;
    bool transistor = false;
    unsigned disturbed_mv = 0;
    unsigned samples_disturbed = 0;
  };
  struct Breakage {
    std::uint64_t cycle = 0;
    std::size_t heater = 0;
    HeaterBreak what{};
  };

  void advance();
  void advance_to(std::uint64_t cycle);
  void feed_converter(std::uint32_t input);

  avr_t* avr_;
  unsigned supply_mv_ = 5000;
  std::vector<Patch> patches_;
  std::vector<Breakage> breakages_;  // the next one last
  bool fed_ = false;
  std::uint64_t advanced_to_ = 0;
};

}  // namespace telehug
