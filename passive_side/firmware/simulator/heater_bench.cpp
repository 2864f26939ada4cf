// SPDX-License-Identifier: Apache-2.0
#include "simulator/heater_bench.hpp"

#include <avr_adc.h>
#include <sim_avr.h>
#include <sim_io.h>

#include <algorithm>
#include <bit>

namespace telehug {
namespace {

constexpr double cycles_per_s = 16e6;

}  // namespace

HeaterBench::HeaterBench(avr_t* avr, const BoardWiring& board) : avr_(avr), patches_(board.heaters.size()) {
  for (std::size_t i = 0; i < patches_.size(); ++i)
    patches_[i].input = board.heaters[i].thermistor_input;
  set_supply_mv(supply_mv_);
  avr_irq_register_notify(
      avr_io_getirq(avr_, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER),
      [](avr_irq_t*, std::uint32_t value, void* self) {
        const auto mux = std::bit_cast<avr_adc_mux_t>(std::uint64_t{value});
        if (mux.kind == ADC_MUX_SINGLE) static_cast<HeaterBench*>(self)->feed_converter(mux.src);
      },
      this);
}

void HeaterBench::set_supply_mv(unsigned supply_mv) {
  supply_mv_ = supply_mv;
  avr_->vcc = avr_->avcc = avr_->aref = supply_mv;
}

void HeaterBench::set_transistor(std::size_t heater, bool high) {
  if (patches_[heater].transistor == high) return;
  advance();
  patches_[heater].transistor = high;
}

void HeaterBench::set_supply_transistor(bool high) {
  if (fed_ == high) return;
  advance();
  fed_ = high;
}

void HeaterBench::break_at(std::uint64_t cycle, std::size_t heater, HeaterBreak what) {
  breakages_.push_back({cycle, heater, what});
  std::ranges::sort(breakages_, std::ranges::greater{}, &Breakage::cycle);
}

void HeaterBench::disturb(std::size_t heater, unsigned millivolts, unsigned samples) {
  patches_.at(heater).disturbed_mv = millivolts;
  patches_.at(heater).samples_disturbed = samples;
}

HeatedPatch& HeaterBench::patch(std::size_t heater) {
  advance();
  return patches_.at(heater).physics;
}

void HeaterBench::advance() {
  while (!breakages_.empty() && breakages_.back().cycle <= avr_->cycle) {
    advance_to(std::max(breakages_.back().cycle, advanced_to_));
    patches_.at(breakages_.back().heater).physics.break_it(breakages_.back().what);
    breakages_.pop_back();
  }
  advance_to(avr_->cycle);
}

void HeaterBench::advance_to(std::uint64_t cycle) {
  const double seconds = static_cast<double>(cycle - advanced_to_) / cycles_per_s;
  advanced_to_ = cycle;
  for (Patch& patch : patches_)
    patch.physics.advance(seconds, fed_ && (patch.transistor || patch.physics.runs_away()));
}

void HeaterBench::feed_converter(std::uint32_t input) {
  advance();
  for (Patch& patch : patches_) {
    if (patch.input != input) continue;
    unsigned millivolts = patch.physics.thermistor_mv(supply_mv_);
    if (patch.samples_disturbed != 0) {
      --patch.samples_disturbed;
      millivolts = patch.disturbed_mv;
    }
    avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + patch.input), millivolts);
  }
}

}  // namespace telehug
